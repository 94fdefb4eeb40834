//! The calibration kernel.

use std::hint::black_box;
use std::time::Instant;

/// The unit that machines are compared in: HLLC for an ideal gas as textbooks print it, over one row of faces,
/// one face after the other, with branches, for whatever instruction set the build is for.
///
/// Toro (2009) sect. 10.4, wave speeds of Davis (1988). It must not be improved, or old numbers lose their unit.
pub struct Calibration {
    density: Vec<f64>,
    normal: Vec<f64>,
    tangential: Vec<f64>,
    pressure: Vec<f64>,
    flux: Vec<[f64; 4]>,
}

impl Calibration {
    pub const FACES: usize = 4096;
    const GAMMA: f64 = 1.4;
    /// Rows per timing.
    const REPEATS: usize = 400;

    pub fn new() -> Self {
        // Subsonic and supersonic faces, both directions, in runs of some ten.
        let wave = |rate: f64, mean: f64, size: f64| -> Vec<f64> {
            (0..=Self::FACES).map(|k| mean + size * (rate * k as f64).sin()).collect()
        };
        Self {
            density: wave(0.11, 1.0, 0.3),
            normal: wave(0.071, 0.0, 1.6),
            tangential: wave(0.053, 0.2, 0.1),
            pressure: wave(0.097, 1.0, 0.4),
            flux: vec![[0.0; 4]; Self::FACES],
        }
    }

    pub fn nanoseconds_per_face(&mut self) -> f64 {
        let start = Instant::now();
        for _ in 0..Self::REPEATS {
            black_box(&mut *self).row();
        }
        black_box(&self.flux);
        start.elapsed().as_secs_f64() * 1e9 / (Self::REPEATS * Self::FACES) as f64
    }

    #[inline(never)]
    fn row(&mut self) {
        for k in 0..Self::FACES {
            let state = |k: usize| [self.density[k], self.normal[k], self.tangential[k], self.pressure[k]];
            self.flux[k] = Self::flux(state(k), state(k + 1));
        }
    }

    fn flux(left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        let sound = |[rho, _, _, p]: [f64; 4]| (Self::GAMMA * p / rho).sqrt();
        let energy = |[rho, u, v, p]: [f64; 4]| p / (Self::GAMMA - 1.0) + 0.5 * rho * (u * u + v * v);
        let physical = |w: [f64; 4]| {
            let [rho, u, v, p] = w;
            [rho * u, rho * u * u + p, rho * u * v, u * (energy(w) + p)]
        };
        let ([rho_l, u_l, _, p_l], [rho_r, u_r, _, p_r]) = (left, right);
        let (c_l, c_r) = (sound(left), sound(right));
        let s_l = (u_l - c_l).min(u_r - c_r);
        let s_r = (u_l + c_l).max(u_r + c_r);
        if s_l >= 0.0 {
            return physical(left);
        }
        if s_r <= 0.0 {
            return physical(right);
        }
        let s_m = (p_r - p_l + rho_l * u_l * (s_l - u_l) - rho_r * u_r * (s_r - u_r))
            / (rho_l * (s_l - u_l) - rho_r * (s_r - u_r));
        let (w, s) = if s_m >= 0.0 { (left, s_l) } else { (right, s_r) };
        let [rho, u, v, p] = w;
        let factor = rho * (s - u) / (s - s_m);
        let total = energy(w);
        let star = [
            factor,
            factor * s_m,
            factor * v,
            factor * (total / rho + (s_m - u) * (s_m + p / (rho * (s - u)))),
        ];
        let own = [rho, rho * u, rho * v, total];
        let mut flux = physical(w);
        for (f, (star, own)) in flux.iter_mut().zip(star.into_iter().zip(own)) {
            *f += s * (star - own);
        }
        flux
    }
}
