//! Viscous stresses on the faces of a padded block.

use std::ops::Range;

use super::longitudinal;

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
    /// Whether cells may have more; if not no [`share`] is looked for.
    pub may_be_bounded: bool,
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

/// A component of the velocity in the cells about some faces, in rows of as many.
#[derive(Clone, Copy)]
struct AboutFaces<'a> {
    /// On the lower and the upper side.
    low: &'a [f64],
    high: &'a [f64],
    /// Beside those on the lower side along the face: before and after it.
    before_low: &'a [f64],
    after_low: &'a [f64],
    /// Likewise on the upper side.
    before_high: &'a [f64],
    after_high: &'a [f64],
}

impl<'a> AboutFaces<'a> {
    /// - `faces`: by the cells below them; `step`: from there to those above; `along`: to those beside them.
    #[inline(always)]
    fn cut(row: &'a [f64], faces: &Range<usize>, step: usize, along: usize) -> Self {
        let of = |first: usize| &row[first..][..faces.len()];
        let low = faces.start;
        Self {
            low: of(low),
            high: of(low + step),
            before_low: of(low - along),
            after_low: of(low + along),
            before_high: of(low + step - along),
            after_high: of(low + step + along),
        }
    }

    /// The difference across face `k`.
    #[inline(always)]
    fn across(&self, k: usize) -> f64 {
        self.high[k] - self.low[k]
    }

    /// Four times the mean difference from cell to cell along it.
    #[inline(always)]
    fn along(&self, k: usize) -> f64 {
        (self.after_low[k] - self.before_low[k]) + (self.after_high[k] - self.before_high[k])
    }
}

/// The stresses on the faces normal to an axis (0: z, 1: r).
///
/// τ_nn = 2μ ∂n u + (κ − ⅔μ) ∇·v, τ_nt = μ(∂n w + ∂t u), with differences across the face, and along it the mean of both cells'
/// central ones. v_r/r is the mean of both cells', too: even on the axis. μ is the mean of both cells', but no more than the lighter one
/// bears in a step.
///
/// - `range`: of the cells below the faces.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn stresses(m: &Motion<'_>, axis: usize, range: Range<usize>, out: &mut FaceStress<'_>) {
    let FaceStress { normal, shear, hoop } = out;
    let [normal, shear, hoop] = [normal, shear, hoop].map(|row| &mut row[range.clone()]);
    if m.may_be_bounded {
        stresses_body::<true>(m, axis, &range, normal, shear, hoop);
    } else {
        stresses_body::<false>(m, axis, &range, normal, shear, hoop);
    }
}

// The rows that are written as arguments of their own: so it is known that they are no others.
#[inline(always)]
fn stresses_body<const BOUNDED: bool>(
    m: &Motion<'_>,
    axis: usize,
    faces: &Range<usize>,
    normal: &mut [f64],
    shear: &mut [f64],
    hoop: &mut [f64],
) {
    let count = faces.len();
    let (normal, shear, hoop) = (&mut normal[..count], &mut shear[..count], &mut hoop[..count]);
    let (step, along) = if axis == 0 { (1, m.stride) } else { (m.stride, 1) };
    let (across, sideways) = (m.inverse_h[axis], 0.25 * m.inverse_h[1 - axis]);
    let [u, w] = [axis, 1 - axis].map(|own| AboutFaces::cut(m.velocity[own], faces, step, along));
    let radial = if axis == 0 { w } else { u };
    // On both sides.
    let both = |row| [faces.start, faces.start + step].map(|first| &(row as &[f64])[first..][..count]);
    let [inverse_r, mu, kappa, density] = [m.inverse_r, m.shear, m.bulk, m.density].map(both);
    for k in 0..count {
        let mean = |[low, high]: [&[f64]; 2]| 0.5 * (low[k] + high[k]);
        let stretch = across * u.across(k);
        let around = 0.5 * (radial.low[k] * inverse_r[0][k] + radial.high[k] * inverse_r[1][k]);
        let divergence = stretch + sideways * w.along(k) + around;
        let (mu, kappa) = (mean(mu), mean(kappa));
        let least = if density[0][k] < density[1][k] { density[0][k] } else { density[1][k] };
        let share = if BOUNDED { share(m.most * least, longitudinal([mu, kappa])) } else { 1.0 };
        let (mu, kappa) = (share * mu, share * kappa);
        normal[k] = 2.0 * mu * stretch + (kappa - 2.0 / 3.0 * mu) * divergence;
        shear[k] = mu * (across * w.across(k) + sideways * u.along(k));
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
    /// Whether all of them are known to have the same ones.
    pub are_one: bool,
}

/// η_k/(η_k + η_n) of two cells with these η.
#[inline(always)]
pub(super) fn part([own, other]: [f64; 2]) -> f64 {
    if own == other { 0.5 } else { own / (own + other) }
}

/// The same where they may be known to be equal.
#[inline(always)]
pub(super) fn part_if<const DIFFER: bool>(of: [f64; 2]) -> f64 {
    if DIFFER { part(of) } else { 0.5 }
}

/// [`Parts::velocity`] between these two.
#[inline(always)]
pub(super) fn velocity_between(part: f64, [own, other]: [f64; 2]) -> f64 {
    0.5 * (own + other) + (part - 0.5) * (other - own)
}

impl Parts<'_> {
    /// η_k/(η_k + η_n) of the face between `k` and `n`.
    #[inline(always)]
    pub fn of(&self, k: usize, n: usize) -> f64 {
        part([k, n].map(|k| longitudinal([self.shear[k], self.bulk[k]])))
    }

    /// A component of the velocity on the face above cell `k`, m/s.
    #[inline(always)]
    pub fn velocity(&self, k: usize, step: usize, v: &[f64]) -> f64 {
        velocity_between(self.of(k, k + step), [v[k], v[k + step]])
    }

    /// Twice τ_rr − τ_φφ of cell `k`, Pa: with the faces' τ_rr, and as much of their τ_φφ as the cell's own viscosity makes.
    ///
    /// - `normal`, `hoop`: τ_rr and τ_rr − τ_φφ of the faces along r.
    #[inline(always)]
    pub fn hoop(&self, k: usize, stride: usize, normal: &[f64], hoop: &[f64]) -> f64 {
        let below = k - stride;
        let parts = [k + stride, below].map(|other| self.of(k, other));
        hoop_of(parts, [normal[k], normal[below]], [hoop[k], hoop[below]])
    }
}

/// [`Parts::hoop`] of a cell, of the faces above and below it.
#[inline(always)]
pub(super) fn hoop_of(parts: [f64; 2], normal: [f64; 2], hoop: [f64; 2]) -> f64 {
    let foreign = |face: usize| (1.0 - 2.0 * parts[face]) * (normal[face] - hoop[face]);
    (hoop[0] + hoop[1]) + (foreign(0) + foreign(1))
}
