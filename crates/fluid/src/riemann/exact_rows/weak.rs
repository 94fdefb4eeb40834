//! Faces between whose states there are weak waves only, all slower than the sound: the Riemann solution by series, without a root and with
//! one division after the acoustic guess. That is all of smooth flow.
//!
//! With x = (p − p_K)/P_K the wave curves are f = c x/γ (1 + ax)^(−1/2) of shocks and 2c/(γ − 1) ((1 + x)^m − 1) of rarefactions, with
//! a = (γ + 1)/(2γ) and m = 1 − a; what they squeeze by is (1 + ax)/(1 + mx) and (1 + x)^(1/γ).

use std::hint::select_unpredictable;

use super::liquid::Liquid;
use super::{Chunk, LANES, LAST_STEP, LEFT_OVER, Lane, Sides};
use crate::Mixture;

/// Changes of the pressure, as a share of p + π, below which a wave is weak.
pub(super) const WEAK: f64 = 1.0 / 512.0;

/// The solution of such faces.
#[derive(Clone, Copy)]
pub(super) struct Weak {
    /// 1 where both waves of the acoustic guess are weak and both states slower than half their sound, so that no wave
    /// stands at the face, and the solution has converged; else 0.
    pub is_weak: Lane,
    /// Pressure and velocity of the contact.
    pub p: Lane,
    pub u: Lane,
}

impl Weak {
    pub const ZERO: Self = Self { is_weak: [0.0; LANES], p: [0.0; LANES], u: [0.0; LANES] };
}

/// The wave curve of one side at the acoustic guess: f, P f' and −P f''/f'.
///
/// What the series leave out of f is 10⁻¹⁴ of it and thus 10⁻¹⁷ of P, of the first derivative 3·10⁻⁹, of the second
/// 10⁻³: less than a guess that is 4·10⁻⁶ off asks of one step to be exact.
#[inline(always)]
fn curve<const ONE_LAW: bool>(s: &Sides, k: usize, p: f64, shifted: f64, liquid: &Liquid) -> [f64; 3] {
    let m = if ONE_LAW { liquid.m } else { s.m[k] };
    let a = 1.0 - m;
    let per_gamma = s.c[k] * (1.0 - 2.0 * m);
    let x = (p - s.p[k]) * s.inverse_base[k];
    let lever = shifted * s.inverse_base[k];
    let shock = x > 0.0;
    // (1 + t)^-½ with t = ax, and ((1 + x)^m − 1)/(mx).
    let t = a * x;
    let of_shock = 1.0 + t * (-1.0 / 2.0 + t * (3.0 / 8.0 + t * (-5.0 / 16.0 + t * (35.0 / 128.0))));
    let [c1, c2, c3, c4] = [(m - 1.0) / 2.0, (m - 2.0) / 3.0, (m - 3.0) / 4.0, (m - 4.0) / 5.0];
    let of_fan = 1.0 + x * (c1 + x * (c1 * c2 + x * (c1 * c2 * c3 + x * (c1 * c2 * c3 * c4))));
    let bend = if shock { (9.0 / 8.0) * (a * a) } else { 0.5 * (a * (1.0 + a)) };
    let f = per_gamma * (x * if shock { of_shock } else { of_fan });
    let slope = per_gamma * (1.0 - x * (a - x * bend)) * lever;
    // a times P over the side's own P, which is the same where both have one law.
    let bent = if ONE_LAW { a } else { a * (1.0 - (s.offset[k] * s.inverse_base[k]) * (1.0 - x)) };
    [f, slope, bent]
}

/// One step of Halley's from the acoustic guesses of a chunk, at the faces that are weak.
///
/// - `ONE_LAW`: whether all states are pure liquid without a covolume.
/// - returns: how many are.
#[inline(always)]
pub(super) fn solve<const ONE_LAW: bool>(n: usize, chunk: &mut Chunk, liquid: &Liquid) -> usize {
    let Chunk { left, right, p, shifted, weak: Weak { is_weak, p: p_star, u: u_star }, .. } = chunk;
    let mut found = 0;
    for k in 0..n.min(LANES) {
        let [f_l, slope_l, bent_l] = curve::<ONE_LAW>(left, k, p[k], shifted[k], liquid);
        let [f_r, slope_r, bent_r] = curve::<ONE_LAW>(right, k, p[k], shifted[k], liquid);
        let inverse = 1.0 / (slope_l + slope_r);
        let newton = ((f_l + f_r) + (right.u[k] - left.u[k])) * inverse;
        let mean = 0.5 * (bent_l + bent_r);
        let bent =
            if ONE_LAW { mean } else { mean + 0.5 * ((bent_r - bent_l) * (slope_r - slope_l)) * inverse };
        // −2x/(2 + bent x).
        let turn = 0.5 * bent * newton;
        let step = newton * (turn * (1.0 - turn) - 1.0);
        // The curves at its end by their Taylor series: what they lack is of the order of step³ as well.
        let moved = |f: f64, slope: f64, bent: f64| f + step * (slope * (1.0 - 0.5 * step * bent));
        p_star[k] = p[k] + shifted[k] * step;
        u_star[k] =
            0.5 * ((left.u[k] - moved(f_l, slope_l, bent_l)) + (right.u[k] + moved(f_r, slope_r, bent_r)));

        let size = step.abs();
        let ahead = shifted[k] + shifted[k] * step;
        let smaller = if p_star[k].abs() < ahead { p_star[k].abs() } else { ahead };
        let converged = (size <= LAST_STEP) | (size * size * size * ahead <= LEFT_OVER * smaller);
        is_weak[k] = if converged { is_weak[k] } else { 0.0 };
        found += u64::from(is_weak[k] != 0.0);
    }
    found as usize
}

/// The fluxes at x/t = 0 of the faces that are weak, and ρ*/ρ; those of the others are left alone if there are `OTHERS`.
// A flat list of what is written, as in `step/rows.rs`.
#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias")]
#[inline(always)]
pub(super) fn fluxes<const WITH_GAS: bool, const B: bool, const OTHERS: bool>(
    n: usize,
    chunk: &Chunk,
    mixture: &Mixture,
    liquid: &Liquid,
    mass: &mut [f64],
    velocity: &mut [f64],
    pressure: &mut [f64],
    shear: &mut [f64],
    energy: &mut [f64],
    phi: &mut [f64],
    compression: &mut Lane,
) {
    let Chunk { left, right, weak: Weak { is_weak, p, u }, .. } = chunk;
    for k in 0..n.min(LANES) {
        let (p, u) = (p[k], u[k]);
        let from_left = u >= 0.0;
        let pick = |l: f64, r: f64| select_unpredictable(from_left, l, r);
        let pick_lane = |l: &Lane, r: &Lane| pick(l[k], r[k]);
        let x_of = |s: &Sides| (p - s.p[k]) * s.inverse_base[k];
        let x = pick(x_of(left), x_of(right));
        let (rho, v) = (pick_lane(&left.rho, &right.rho), pick_lane(&left.v, &right.v));
        let phi_side = if WITH_GAS { pick_lane(&left.phi, &right.phi) } else { 0.0 };
        let m = if WITH_GAS || B { pick_lane(&left.m, &right.m) } else { liquid.m };

        let per_gamma = 1.0 - 2.0 * m;
        // 1 + x/γ (1 + …), and what is in the brackets agrees in its first two terms.
        let t = m * x;
        let of_shock = 1.0 - t * (1.0 - t * (1.0 - t * (1.0 - t)));
        let [c2, c3, c4] = [(per_gamma - 2.0) / 3.0, (per_gamma - 3.0) / 4.0, (per_gamma - 4.0) / 5.0];
        let of_fan = 1.0 - t * (1.0 + x * (c2 + x * (c2 * c3 + x * (c2 * c3 * c4))));
        let growth = (per_gamma * x) * if x > 0.0 { of_shock } else { of_fan };
        let gas = if B { pick_lane(&left.gas_share, &right.gas_share) } else { 0.0 };
        let compressed = if B {
            // Waves cross the whole volume; 1 − bρ* is the free share over this.
            (1.0 + growth) / (1.0 + growth * (1.0 - pick_lane(&left.free, &right.free)))
        } else {
            1.0 + growth
        };
        let rho = rho * compressed;
        let [b1, b2] = mixture.free_betas::<B>(phi_side, rho, rho * gas);
        let total = b1 * p + b2 + 0.5 * rho * (u * u + v * v);
        let counts = !OTHERS || is_weak[k] != 0.0;
        let keep = |own: f64, other: f64| if counts { own } else { other };
        mass[k] = keep(rho * u, mass[k]);
        velocity[k] = keep(u, velocity[k]);
        pressure[k] = keep(p, pressure[k]);
        shear[k] = keep(rho * u * v, shear[k]);
        energy[k] = keep(u * (total + p), energy[k]);
        phi[k] = keep(phi_side, phi[k]);
        compression[k] = keep(compressed, compression[k]);
    }
}
