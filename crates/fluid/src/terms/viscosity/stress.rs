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
