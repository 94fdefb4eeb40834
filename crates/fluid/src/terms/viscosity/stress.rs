//! Viscous stresses on the faces of a padded block.

use std::ops::Range;

/// What stresses are made of, padded rows.
#[derive(Clone, Copy)]
pub(super) struct Motion<'a> {
    /// v_z, v_r, m/s.
    pub velocity: [&'a [f64]; 2],
    /// μ, Pa s.
    pub shear: &'a [f64],
    /// κ, Pa s.
    pub bulk: &'a [f64],
    /// kg/m³.
    pub density: &'a [f64],
    /// Distance between cells that neighbour each other along r.
    pub stride: usize,
    /// 1/h_z, 1/h_r.
    pub inverse_h: [f64; 2],
    /// 1/r, or 0 in planar geometry.
    pub inverse_r: &'a [f64],
    /// The largest (4μ/3 + κ)/ρ that the step is stable with, m²/s.
    pub most: f64,
}

/// Stresses on faces normal to n, one number each, indexed by the cell on the lower side.
pub(super) struct FaceStress<'a> {
    /// τ_nn, Pa.
    pub normal: &'a mut [f64],
    /// τ_nt, Pa.
    pub shear: &'a mut [f64],
    /// τ_rr − τ_φφ on faces normal to r, Pa.
    pub hoop: &'a mut [f64],
}

/// The share of their viscosity with which two cells meet.
///
/// - `most`: the most that 4μ/3 + κ may be, Pa s; `longitudinal`: what it is.
#[inline(always)]
pub(super) fn share(most: f64, longitudinal: f64) -> f64 {
    if longitudinal > most { most / longitudinal } else { 1.0 }
}

/// The stresses on the faces normal to an axis (0: z, 1: r).
///
/// τ_nn = 2μ ∂n u + (κ − ⅔μ) ∇·v, τ_nt = μ(∂n w + ∂t u), with differences across the face, and along it the mean of both cells'
/// central ones. v_r/r is the mean of both cells', too: even on the axis. μ is the mean of both cells', but no more than the lighter one
/// bears in a step.
///
/// - `range`: of the cells below the faces.
pub(super) fn stresses(m: &Motion<'_>, axis: usize, range: Range<usize>, out: &mut FaceStress<'_>) {
    let (step, along) = if axis == 0 { (1, m.stride) } else { (m.stride, 1) };
    let [u, w] = [m.velocity[axis], m.velocity[1 - axis]];
    let (across, sideways) = (m.inverse_h[axis], 0.25 * m.inverse_h[1 - axis]);
    let v_r = m.velocity[1];
    let FaceStress { normal, shear, hoop } = out;
    for k in range {
        let n = k + step;
        let slope = |v: &[f64]| across * (v[n] - v[k]);
        let slide = |v: &[f64]| sideways * ((v[k + along] - v[k - along]) + (v[n + along] - v[n - along]));
        let stretch = slope(u);
        let around = 0.5 * (v_r[k] * m.inverse_r[k] + v_r[n] * m.inverse_r[n]);
        let divergence = stretch + slide(w) + around;
        let [mu, kappa] = [m.shear, m.bulk].map(|row| 0.5 * (row[k] + row[n]));
        let least = if m.density[k] < m.density[n] { m.density[k] } else { m.density[n] };
        let share = share(m.most * least, 4.0 / 3.0 * mu + kappa);
        let (mu, kappa) = (share * mu, share * kappa);
        normal[k] = 2.0 * mu * stretch + (kappa - 2.0 / 3.0 * mu) * divergence;
        shear[k] = mu * (slope(w) + slide(u));
        hoop[k] = 2.0 * mu * (stretch - around);
    }
}

/// How the work of a face's stresses is divided between the cells on both sides.
///
/// Half of the way from one cell's centre to the other's lies in either. If both halves are deformed alike friction has μ_k/(μ_k + μ_n) of its
/// work in cell k, and in a cell of gas beside liquid nearly none. That much of the difference of the velocities lies between cell k and the
/// face:
///
/// v_f = v_k + η_k/(η_k + η_n) (v_n − v_k),   η = 4μ/3 + κ,
///
/// and the energy that crosses is −τ v_f. With one viscosity it is the mean.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts<'a> {
    /// μ of the padded cells, Pa s.
    pub shear: &'a [f64],
    /// κ, likewise.
    pub bulk: &'a [f64],
}

impl Parts<'_> {
    /// η_k/(η_k + η_n) of the face between `k` and `n`.
    #[inline(always)]
    pub fn of(&self, k: usize, n: usize) -> f64 {
        let [own, other] = [k, n].map(|k| 4.0 / 3.0 * self.shear[k] + self.bulk[k]);
        if own == other { 0.5 } else { own / (own + other) }
    }

    /// A component of the velocity on the face above cell `k`, m/s.
    #[inline(always)]
    pub fn velocity(&self, k: usize, step: usize, v: &[f64]) -> f64 {
        let n = k + step;
        0.5 * (v[k] + v[n]) + (self.of(k, n) - 0.5) * (v[n] - v[k])
    }

    /// Twice τ_rr − τ_φφ of cell `k`, Pa: with the faces' τ_rr, and as much of their τ_φφ as the cell's own viscosity makes.
    ///
    /// - `normal`, `hoop`: τ_rr and τ_rr − τ_φφ of the faces along r.
    #[inline(always)]
    pub fn hoop(&self, k: usize, stride: usize, normal: &[f64], hoop: &[f64]) -> f64 {
        let below = k - stride;
        let foreign =
            |face: usize, other: usize| (1.0 - 2.0 * self.of(k, other)) * (normal[face] - hoop[face]);
        (hoop[k] + hoop[below]) + (foreign(k, k + stride) + foreign(below, below))
    }
}
