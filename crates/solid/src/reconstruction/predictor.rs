//! Slopes and predictor in one pass over the cells of a padded block; written as the kernels of `step/rows.rs`.

use mesh::Limiter;

use crate::step::rows::{Elasticity, Rows};

/// Components whose derivative along z enters the equations: v_z, v_r, σ_zz, σ_zr.
pub(crate) const ALONG_Z: [usize; 4] = [0, 1, 2, 3];
/// Components whose derivative along r enters the equations: v_z, v_r, σ_zr, σ_rr.
pub(crate) const ALONG_R: [usize; 4] = [0, 1, 3, 4];

/// What the predictor needs to know of a block's geometry and of the step.
#[derive(Clone, Copy)]
pub(crate) struct Predictor<'a> {
    pub limiter: Limiter,
    /// Distance between cells that neighbour each other along r.
    pub stride: usize,
    /// 1/h_z, 1/h_r.
    pub inverse_h: [f64; 2],
    /// 1/r per padded cell, or 0 in planar geometry.
    pub inverse_r: &'a [f64],
    /// Half the time step, s.
    pub half_dt: f64,
}

/// What the predictor writes: rows of one length, the cells in the order of theirs.
pub(crate) struct Predicted<'a> {
    /// Differences of the components [`ALONG_Z`] and [`ALONG_R`].
    pub s_z: [&'a mut [f64]; 4],
    pub s_r: [&'a mut [f64]; 4],
    /// The state at mid-step.
    pub half: [&'a mut [f64]; 6],
}

/// Limited differences and the state at mid-step, in all cells but the outermost layer.
///
/// MUSCL-Hancock: [`mesh::limited_differences`] of the components that need it, then the predictor, paper eqs. (24),
/// (25). The differences are made and used in registers.
///
/// - `w`: the cells. `out`: as they are, padded.
/// - tested by: equality with the limiter and, to round-off, the rates, cell by cell.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn predict(w: Rows<'_>, p: Predictor<'_>, elasticity: &Elasticity, out: Predicted<'_>) {
    // The first and the last cell of these rows have neighbours, if not their own; all lines are whole.
    let first = p.stride;
    let n = w[0].len() - 2 * first;
    let Predicted { s_z: [z0, z1, z2, z3], s_r: [r0, r1, r2, r3], half: [h0, h1, h2, h3, h4, h5] } = out;
    let out = Predicted {
        s_z: [&mut z0[first..], &mut z1[first..], &mut z2[first..], &mut z3[first..]],
        s_r: [&mut r0[first..], &mut r1[first..], &mut r2[first..], &mut r3[first..]],
        half: [
            &mut h0[first..],
            &mut h1[first..],
            &mut h2[first..],
            &mut h3[first..],
            &mut h4[first..],
            &mut h5[first..],
        ],
    };
    predict_from(first, n, w, p, *elasticity, out);
}

/// [`predict`] of `n` cells from number `first` on, which all have neighbours; what is written begins with that cell.
#[inline(always)]
pub(crate) fn predict_from(
    first: usize,
    n: usize,
    w: Rows<'_>,
    p: Predictor<'_>,
    e: Elasticity,
    out: Predicted<'_>,
) {
    match p.limiter {
        Limiter::Mc => body(first, n, |a, b| Limiter::Mc.difference(a, b), w, p, e, out),
        Limiter::Minmod => body(first, n, |a, b| Limiter::Minmod.difference(a, b), w, p, e, out),
        Limiter::Eno => body(first, n, |a, b| Limiter::Eno.difference(a, b), w, p, e, out),
        Limiter::None => body(first, n, |a, b| Limiter::None.difference(a, b), w, p, e, out),
    }
}

#[inline(always)]
fn body(
    first: usize,
    n: usize,
    limit: impl Fn(f64, f64) -> f64,
    w: Rows<'_>,
    p: Predictor<'_>,
    e: Elasticity,
    out: Predicted<'_>,
) {
    let Predicted { s_z: [z0, z1, z2, z3], s_r: [r0, r1, r2, r3], half: [h0, h1, h2, h3, h4, h5] } = out;
    cells(
        n,
        limit,
        cut(w, first, n),
        [
            cut(w, first - 1, n),
            cut(w, first + 1, n),
            cut(w, first - p.stride, n),
            cut(w, first + p.stride, n),
        ],
        &p.inverse_r[first..][..n],
        HalfStep::new(p.inverse_h, p.half_dt, e),
        &mut z0[..n],
        &mut z1[..n],
        &mut z2[..n],
        &mut z3[..n],
        &mut r0[..n],
        &mut r1[..n],
        &mut r2[..n],
        &mut r3[..n],
        &mut h0[..n],
        &mut h1[..n],
        &mut h2[..n],
        &mut h3[..n],
        &mut h4[..n],
        &mut h5[..n],
    );
}

/// [`crate::step::rows::rates`] over half a step, from differences across cells: what all cells have alike is multiplied once.
#[derive(Clone, Copy)]
struct HalfStep {
    inverse_h: [f64; 2],
    /// Δt/2 times λ and 2μ.
    lambda: f64,
    two_mu: f64,
    /// Δt/2 times μ/h_z, μ/h_r.
    mu_over_h: [f64; 2],
    /// Δt/2 times 1/ρ̄, 1/(ρ̄h_z), 1/(ρ̄h_r).
    inverse_density: f64,
    per_mass: [f64; 2],
}

impl HalfStep {
    #[inline(always)]
    fn new(inverse_h: [f64; 2], half_dt: f64, e: Elasticity) -> Self {
        let inverse_density = half_dt * e.inverse_density;
        Self {
            inverse_h,
            lambda: half_dt * e.lambda,
            two_mu: half_dt * 2.0 * e.mu,
            mu_over_h: inverse_h.map(|inverse| half_dt * e.mu * inverse),
            inverse_density,
            per_mass: inverse_h.map(|inverse| inverse_density * inverse),
        }
    }

    /// Of velocity and stress.
    ///
    /// - `w`: the cell; `z`, `r`: its differences, of the components [`ALONG_Z`] and [`ALONG_R`].
    #[inline(always)]
    fn changes(&self, w: [f64; 6], z: [f64; 4], r: [f64; 4], inverse_r: f64) -> [f64; 6] {
        let (axial, radial, hoop) = (z[0] * self.inverse_h[0], r[1] * self.inverse_h[1], w[1] * inverse_r);
        let dilatation = self.lambda * ((axial + radial) + hoop);
        let [per_mass_z, per_mass_r] = self.per_mass;
        [
            (per_mass_z * z[2] + per_mass_r * r[2]) + self.inverse_density * (w[3] * inverse_r),
            (per_mass_z * z[3] + per_mass_r * r[3]) + self.inverse_density * ((w[4] - w[5]) * inverse_r),
            dilatation + self.two_mu * axial,
            self.mu_over_h[0] * z[1] + self.mu_over_h[1] * r[0],
            dilatation + self.two_mu * radial,
            dilatation + self.two_mu * hoop,
        ]
    }
}

/// `n` numbers of each row from `at` on.
#[inline(always)]
fn cut<'a>([a, b, c, d, e, f]: Rows<'a>, at: usize, n: usize) -> Rows<'a> {
    [&a[at..][..n], &b[at..][..n], &c[at..][..n], &d[at..][..n], &e[at..][..n], &f[at..][..n]]
}

#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias; the fluid has measured it")]
#[inline(always)]
fn cells(
    n: usize,
    limit: impl Fn(f64, f64) -> f64,
    w: Rows<'_>,
    [west, east, south, north]: [Rows<'_>; 4],
    inverse_r: &[f64],
    half_step: HalfStep,
    z0: &mut [f64],
    z1: &mut [f64],
    z2: &mut [f64],
    z3: &mut [f64],
    r0: &mut [f64],
    r1: &mut [f64],
    r2: &mut [f64],
    r3: &mut [f64],
    h0: &mut [f64],
    h1: &mut [f64],
    h2: &mut [f64],
    h3: &mut [f64],
    h4: &mut [f64],
    h5: &mut [f64],
) {
    for k in 0..n {
        let here = [w[0][k], w[1][k], w[2][k], w[3][k], w[4][k], w[5][k]];
        let along_z = |c: usize| limit(here[c] - west[c][k], east[c][k] - here[c]);
        let along_r = |c: usize| limit(here[c] - south[c][k], north[c][k] - here[c]);
        let z = [along_z(ALONG_Z[0]), along_z(ALONG_Z[1]), along_z(ALONG_Z[2]), along_z(ALONG_Z[3])];
        let r = [along_r(ALONG_R[0]), along_r(ALONG_R[1]), along_r(ALONG_R[2]), along_r(ALONG_R[3])];
        let change = half_step.changes(here, z, r, inverse_r[k]);
        (z0[k], z1[k], z2[k], z3[k]) = (z[0], z[1], z[2], z[3]);
        (r0[k], r1[k], r2[k], r3[k]) = (r[0], r[1], r[2], r[3]);
        h0[k] = here[0] + change[0];
        h1[k] = here[1] + change[1];
        h2[k] = here[2] + change[2];
        h3[k] = here[3] + change[3];
        h4[k] = here[4] + change[4];
        h5[k] = here[5] + change[5];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::WaveSpeeds;
    use crate::step::rows::rates;

    #[test]
    fn one_pass_equals_limiter_and_rates_cell_by_cell() {
        let stride = 12;
        let len = stride * stride;
        let row = |rate: f64| -> Vec<f64> { (0..len).map(|k| ((k * k) as f64 * rate).sin()).collect() };
        let w: [Vec<f64>; 6] = [0.37, 0.21, 0.53, 0.71, 0.11, 0.93].map(row);
        let inverse_r = row(0.07);
        let e = Elasticity::new(WaveSpeeds { density: 7.8, c1: 5.9, c2: 3.4 });
        for (name, limiter) in Limiter::NAMES {
            let zeros = || vec![0.0; len];
            let (mut s_z, mut s_r) = (ALONG_Z.map(|_| zeros()), ALONG_R.map(|_| zeros()));
            let mut half: [Vec<f64>; 6] = std::array::from_fn(|_| zeros());
            predict(
                w.each_ref().map(|row| &row[..]),
                Predictor { limiter, stride, inverse_h: [3.0, 5.0], inverse_r: &inverse_r, half_dt: 0.1 },
                &e,
                Predicted {
                    s_z: s_z.each_mut().map(|row| &mut row[..]),
                    s_r: s_r.each_mut().map(|row| &mut row[..]),
                    half: half.each_mut().map(|row| &mut row[..]),
                },
            );
            for k in stride + 1..len - stride - 1 {
                let here: [f64; 6] = std::array::from_fn(|c| w[c][k]);
                let slope =
                    |c: usize, by: usize| limiter.difference(w[c][k] - w[c][k - by], w[c][k + by] - w[c][k]);
                assert_eq!(s_z.each_ref().map(|row| row[k]), ALONG_Z.map(|c| slope(c, 1)), "{name}");
                assert_eq!(s_r.each_ref().map(|row| row[k]), ALONG_R.map(|c| slope(c, stride)), "{name}");
                let rate = rates(
                    here,
                    std::array::from_fn(|c| slope(c, 1) * 3.0),
                    std::array::from_fn(|c| slope(c, stride) * 5.0),
                    inverse_r[k],
                    &e,
                );
                for c in 0..6 {
                    let wanted = here[c] + 0.1 * rate[c];
                    let scale = if c < 2 { 1.0 } else { 0.1 * e.p_modulus * 5.0 };
                    let off = (half[c][k] - wanted).abs() / scale;
                    assert!(off < 1e-14, "{name}, component {c}: {off:e}");
                }
            }
        }
    }
}
