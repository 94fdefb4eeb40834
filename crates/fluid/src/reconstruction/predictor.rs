//! Slopes and predictor in one pass over the cells of a padded block; written as the kernels of `step/rows.rs`.

use mesh::Limiter;

use crate::Mixture;
use crate::reconstruction::{Rows, RowsMut, at, cut, fraction};
use crate::state::primitive::{PHI, PRESSURE, RHO, V_R, V_Z};
use crate::step::rows::Prediction;
use crate::two_phase::is_compliant;

/// Cells after which the pass looks whether all of them keep their slopes: whole lines of the cache, few enough that
/// what they need to be done again is still at hand.
const CHUNK: usize = 64;

/// What the predictor needs to know of a block's geometry and of the step.
#[derive(Clone, Copy)]
pub(crate) struct Predictor<'a> {
    pub limiter: Limiter,
    /// Of the gas fraction.
    pub fraction_limiter: Limiter,
    /// Distance between cells that neighbour each other along r.
    pub stride: usize,
    /// 1/h_z, 1/h_r.
    pub inverse_h: [f64; 2],
    /// 1/r per padded cell, or 0 in planar geometry.
    pub inverse_r: &'a [f64],
    /// m_g/ρ of the padded cells; read where there is gas and a covolume.
    pub gas_shares: &'a [f64],
    /// Half the time step, s.
    pub half_dt: f64,
    pub mixture: Mixture,
    /// Whether there is gas in any cell. Without it the rows of the gas fraction are left alone; they must hold zeros.
    pub with_gas: bool,
    /// Whether mixed cells count. Those of the five-equation model that are compliant have face states of their own.
    pub with_mixed: bool,
}

/// What the predictor writes, padded rows.
pub(crate) struct Predicted<'a> {
    /// Limited differences along z and r.
    pub s_z: RowsMut<'a>,
    pub s_r: RowsMut<'a>,
    /// Primitive variables at mid-step.
    pub half: RowsMut<'a>,
    /// The share of its slopes that each cell keeps.
    pub keep: &'a mut [f64],
    /// Sound speeds.
    pub sound: &'a mut [f64],
}

/// Some cells in a row, and what surrounds them.
#[derive(Clone, Copy)]
struct Stencil<'a> {
    here: Rows<'a>,
    /// West, east, south, north.
    around: [Rows<'a>; 4],
    inverse_r: &'a [f64],
    gas_shares: &'a [f64],
}

impl<'a> Stencil<'a> {
    #[inline(always)]
    fn cut(w: &Rows<'a>, p: &Predictor<'a>, at: usize, n: usize) -> Self {
        Self {
            here: cut(w, at, n),
            around: [
                cut(w, at - 1, n),
                cut(w, at + 1, n),
                cut(w, at - p.stride, n),
                cut(w, at + p.stride, n),
            ],
            inverse_r: &p.inverse_r[at..][..n],
            gas_shares: &p.gas_shares[at..][..n],
        }
    }
}

/// Limited differences, primitive variables at mid-step, the share of slopes kept and the sound speed, in all cells but the
/// outermost layer.
///
/// MUSCL-Hancock: [`mesh::limited_differences`], then the predictor, paper eqs. (24), (25) with τ = Δt/2, in both
/// directions at once. The differences are made and used in registers. Nearly all cells keep their slopes; a chunk of
/// cells in which one does not is predicted again by [`half_step`].
///
/// - `w`: the cells. returns: whether all of them keep their slopes, those between the rows included.
/// - tested by: equality with the limiter and [`half_step`], cell by cell.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn predict(w: Rows<'_>, p: Predictor<'_>, out: Predicted<'_>) -> bool {
    // A function of its own for each, so that the compiler sees what it does.
    let mc = |a, b| Limiter::Mc.difference(a, b);
    let minmod = |a, b| Limiter::Minmod.difference(a, b);
    let eno = |a, b| Limiter::Eno.difference(a, b);
    let none = |a, b| Limiter::None.difference(a, b);
    // Without gas all limiters give the gas fraction the same slopes: none.
    match (p.with_gas, p.limiter, p.fraction_limiter) {
        (true, Limiter::Mc, _) => body_of::<true>(mc, mc, w, p, out),
        (true, Limiter::Minmod, Limiter::Mc) => body_of::<true>(minmod, mc, w, p, out),
        (true, Limiter::Minmod, _) => body_of::<true>(minmod, minmod, w, p, out),
        (true, Limiter::Eno, _) => body_of::<true>(eno, eno, w, p, out),
        (true, Limiter::None, _) => body_of::<true>(none, none, w, p, out),
        (false, Limiter::Mc, _) => body_of::<false>(mc, mc, w, p, out),
        (false, Limiter::Minmod, _) => body_of::<false>(minmod, minmod, w, p, out),
        (false, Limiter::Eno, _) => body_of::<false>(eno, eno, w, p, out),
        (false, Limiter::None, _) => body_of::<false>(none, none, w, p, out),
    }
}

#[inline(always)]
fn body_of<const WITH_GAS: bool>(
    limit: impl Fn(f64, f64) -> f64 + Copy,
    limit_fraction: impl Fn(f64, f64) -> f64 + Copy,
    w: Rows<'_>,
    p: Predictor<'_>,
    out: Predicted<'_>,
) -> bool {
    if p.mixture.has_covolume() {
        body::<WITH_GAS, true>(limit, limit_fraction, w, p, out)
    } else {
        body::<WITH_GAS, false>(limit, limit_fraction, w, p, out)
    }
}

#[inline(always)]
fn body<const WITH_GAS: bool, const B: bool>(
    limit: impl Fn(f64, f64) -> f64 + Copy,
    limit_fraction: impl Fn(f64, f64) -> f64 + Copy,
    w: Rows<'_>,
    p: Predictor<'_>,
    out: Predicted<'_>,
) -> bool {
    let mut all_keep = true;
    let Predicted { s_z, s_r, half, keep, sound } = out;
    let ([z0, z1, z2, z3, z4], [r0, r1, r2, r3, r4], [h0, h1, h2, h3, h4]) = (s_z, s_r, half);
    // The first and the last cell of these rows have neighbours, if not their own; all lines are whole.
    let end = keep.len() - p.stride;
    let mut first = p.stride;
    while first < end {
        let n = CHUNK.min(end - first);
        let cells = Stencil::cut(&w, &p, first, n);
        differences_and_half::<WITH_GAS, B>(
            n,
            limit,
            limit_fraction,
            cells,
            &p,
            &mut z0[first..][..n],
            &mut z1[first..][..n],
            &mut z2[first..][..n],
            &mut z3[first..][..n],
            &mut z4[first..][..n],
            &mut r0[first..][..n],
            &mut r1[first..][..n],
            &mut r2[first..][..n],
            &mut r3[first..][..n],
            &mut r4[first..][..n],
            &mut h0[first..][..n],
            &mut h1[first..][..n],
            &mut h2[first..][..n],
            &mut h3[first..][..n],
            &mut h4[first..][..n],
            &mut keep[first..][..n],
            &mut sound[first..][..n],
        );
        let dropped: u64 = keep[first..][..n].iter().map(|share| u64::from(*share == 0.0)).sum();
        let [_, _, _, pressure, phi] = cells.here;
        let counts = |k: usize| keep[first + k] == 0.0 && !is_compliant(pressure[k], phi[k], &p.mixture);
        all_keep &= dropped == 0;
        if dropped > 0 && (p.with_mixed || (0..n).any(counts)) {
            half_again(
                cells,
                cut(&[&*z0, &*z1, &*z2, &*z3, &*z4], first, n),
                cut(&[&*r0, &*r1, &*r2, &*r3, &*r4], first, n),
                &p,
                [
                    &mut h0[first..][..n],
                    &mut h1[first..][..n],
                    &mut h2[first..][..n],
                    &mut h3[first..][..n],
                    &mut h4[first..][..n],
                ],
                &mut keep[first..][..n],
            );
        }
        first += n;
    }
    all_keep
}

// A flat list of what is written: of slices in a struct or an array the compiler does not know that they are apart. With
// `Predicted` here a step of 512 x 512 cells takes 64 instead of 43 ns per cell (1.5 times).
#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias")]
#[inline(always)]
fn differences_and_half<const WITH_GAS: bool, const B: bool>(
    n: usize,
    limit: impl Fn(f64, f64) -> f64,
    limit_fraction: impl Fn(f64, f64) -> f64,
    cells: Stencil<'_>,
    p: &Predictor<'_>,
    z0: &mut [f64],
    z1: &mut [f64],
    z2: &mut [f64],
    z3: &mut [f64],
    z4: &mut [f64],
    r0: &mut [f64],
    r1: &mut [f64],
    r2: &mut [f64],
    r3: &mut [f64],
    r4: &mut [f64],
    h0: &mut [f64],
    h1: &mut [f64],
    h2: &mut [f64],
    h3: &mut [f64],
    h4: &mut [f64],
    keep: &mut [f64],
    sound: &mut [f64],
) {
    let Stencil { here: w, around: [west, east, south, north], inverse_r, gas_shares } = cells;
    let (inverse_h, half_dt, mixture) = (p.inverse_h, p.half_dt, p.mixture);
    for k in 0..n {
        let phi = fraction::<WITH_GAS>(w[PHI][k]);
        let here = [w[RHO][k], w[V_Z][k], w[V_R][k], w[PRESSURE][k], phi];
        let along_z = |c: usize| limit(here[c] - west[c][k], east[c][k] - here[c]);
        let along_r = |c: usize| limit(here[c] - south[c][k], north[c][k] - here[c]);
        let fraction_along_z = limit_fraction(phi - west[PHI][k], east[PHI][k] - phi);
        let fraction_along_r = limit_fraction(phi - south[PHI][k], north[PHI][k] - phi);
        let (z_phi, r_phi) = (fraction::<WITH_GAS>(fraction_along_z), fraction::<WITH_GAS>(fraction_along_r));
        let s_z = [along_z(RHO), along_z(V_Z), along_z(V_R), along_z(PRESSURE), z_phi];
        let s_r = [along_r(RHO), along_r(V_Z), along_r(V_R), along_r(PRESSURE), r_phi];
        let bound = if WITH_GAS && B {
            mixture.bound_beta1::<B>(gas_shares[k])
        } else {
            mixture.bound_beta1::<B>(0.0)
        };
        let (half, kept, speed) =
            Prediction::<B>::new(here, s_z, s_r, inverse_h, inverse_r[k], half_dt, bound, &mixture)
                .whole_half_step::<WITH_GAS>();
        [z0[k], z1[k], z2[k], z3[k], _] = s_z;
        [r0[k], r1[k], r2[k], r3[k], _] = s_r;
        [h0[k], h1[k], h2[k], h3[k], _] = half;
        if WITH_GAS {
            (z4[k], r4[k], h4[k]) = (s_z[PHI], s_r[PHI], half[PHI]);
        }
        (keep[k], sound[k]) = (kept, speed);
    }
}

#[inline(always)]
fn half_again(
    cells: Stencil<'_>,
    s_z: Rows<'_>,
    s_r: Rows<'_>,
    p: &Predictor<'_>,
    [h0, h1, h2, h3, h4]: RowsMut<'_>,
    keep: &mut [f64],
) {
    let (inverse_h, half_dt, mixture) = (p.inverse_h, p.half_dt, p.mixture);
    for k in 0..keep.len() {
        let (w, s_z, s_r) = (at(&cells.here, k), at(&s_z, k), at(&s_r, k));
        let bound = mixture.bound_beta1::<true>(if p.with_gas { cells.gas_shares[k] } else { 0.0 });
        let (half, kept) =
            Prediction::<true>::new(w, s_z, s_r, inverse_h, cells.inverse_r[k], half_dt, bound, &mixture)
                .half_step();
        [h0[k], h1[k], h2[k], h3[k], h4[k]] = half;
        keep[k] = kept;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NobleAbelStiffenedGas;
    use crate::state::PrimitiveCell;

    #[test]
    fn one_pass_equals_limiter_and_half_step_cell_by_cell() {
        let (stride, half_dt, inverse_h) = (12, 1e-8, [3e4, 5e4]);
        let len = stride * stride;
        let mixture = Mixture::water_and_air();
        let wave = |rate: f64, k: usize| ((k * k) as f64 * rate).sin();
        // Smooth liquid in the lower half, anything in the upper one.
        let row = |low: f64, high: f64, rate: f64| -> Vec<f64> {
            let size = |k: usize| if k < len / 2 { 1e-3 } else { 0.5 };
            (0..len).map(|k| low + (high - low) * (0.5 + size(k) * wave(rate, k))).collect()
        };
        let w = [
            row(1.0, 1000.0, 0.37),
            row(-9.0, 9.0, 0.21),
            row(-9.0, 9.0, 0.53),
            row(1e5, 1e7, 0.71),
            row(0.0, 1.0, 0.11),
        ];
        let inverse_r = row(10.0, 30.0, 0.07);
        let mut shares = [0; 3];
        let sharper = [("minmod", Limiter::Minmod, Limiter::Mc)];
        let limiters = Limiter::NAMES.map(|(name, limiter)| (name, limiter, limiter));
        for (name, limiter, fraction_limiter) in limiters.into_iter().chain(sharper) {
            let of_component = |c: usize| if c == PHI { fraction_limiter } else { limiter };
            let rows = || -> [Vec<f64>; 5] { std::array::from_fn(|_| vec![0.0; len]) };
            let (mut s_z, mut s_r, mut half, mut keep) = (rows(), rows(), rows(), vec![0.0; len]);
            let mut sound = vec![0.0; len];
            predict(
                w.each_ref().map(|row| &row[..]),
                Predictor {
                    limiter,
                    fraction_limiter,
                    stride,
                    inverse_h,
                    inverse_r: &inverse_r,
                    gas_shares: &w[PHI],
                    half_dt,
                    mixture,
                    with_gas: true,
                    with_mixed: true,
                },
                Predicted {
                    s_z: s_z.each_mut().map(|row| &mut row[..]),
                    s_r: s_r.each_mut().map(|row| &mut row[..]),
                    half: half.each_mut().map(|row| &mut row[..]),
                    keep: &mut keep,
                    sound: &mut sound,
                },
            );
            for k in stride + 1..len - stride - 1 {
                let here: PrimitiveCell = std::array::from_fn(|c| w[c][k]);
                let slopes = |by: usize| -> PrimitiveCell {
                    std::array::from_fn(|c| {
                        of_component(c).difference(here[c] - w[c][k - by], w[c][k + by] - here[c])
                    })
                };
                let (z, r) = (slopes(1), slopes(stride));
                assert_eq!(s_z.each_ref().map(|row| row[k]), z, "{name}");
                assert_eq!(s_r.each_ref().map(|row| row[k]), r, "{name}");
                let (state, kept) =
                    Prediction::<true>::new(here, z, r, inverse_h, inverse_r[k], half_dt, 0.0, &mixture)
                        .half_step();
                assert_eq!((half.each_ref().map(|row| row[k]), keep[k]), (state, kept), "{name}, cell {k}");
                let bulk_modulus = mixture.bulk_modulus(here[RHO], here[PRESSURE], here[PHI], 0.0);
                approx::assert_relative_eq!(sound[k].powi(2), bulk_modulus / here[RHO], max_relative = 1e-13);
                shares[(2.0 * kept) as usize] += 1;
            }
        }
        assert!(shares.iter().all(|count| *count > 10), "{shares:?}");
    }
    /// Where there is no gas its share is what the scratch of a thread happens to hold.
    #[test]
    fn without_gas_its_share_has_no_say() {
        let (stride, len) = (12, 144);
        let Mixture { liquid, gas, .. } = Mixture::water_and_air();
        let mixture = Mixture::new(NobleAbelStiffenedGas { covolume: 6.61e-4, ..liquid }, gas);
        assert!(mixture.has_covolume());
        let row = |low: f64, high: f64, rate: f64| -> Vec<f64> {
            (0..len).map(|k| low + (high - low) * (0.5 + 0.5 * ((k * k) as f64 * rate).sin())).collect()
        };
        let w = [
            row(1000.0, 1010.0, 0.37),
            row(-9.0, 9.0, 0.21),
            row(-9.0, 9.0, 0.53),
            row(1e5, 1e7, 0.71),
            vec![0.0; len],
        ];
        let inverse_r = row(10.0, 30.0, 0.07);
        let (none, left) = (vec![0.0; len], row(-0.5, 1.0, 0.3));
        for (name, limiter) in Limiter::NAMES {
            let found = [&none, &left].map(|gas_shares| {
                let rows = || -> [Vec<f64>; 5] { std::array::from_fn(|_| vec![0.0; len]) };
                let (mut s_z, mut s_r, mut half) = (rows(), rows(), rows());
                let (mut keep, mut sound) = (vec![0.0; len], vec![0.0; len]);
                let p = Predictor {
                    limiter,
                    fraction_limiter: limiter,
                    stride,
                    inverse_h: [3e4, 5e4],
                    inverse_r: &inverse_r,
                    gas_shares,
                    half_dt: 1e-8,
                    mixture,
                    with_gas: false,
                    with_mixed: false,
                };
                let out = Predicted {
                    s_z: s_z.each_mut().map(|row| &mut row[..]),
                    s_r: s_r.each_mut().map(|row| &mut row[..]),
                    half: half.each_mut().map(|row| &mut row[..]),
                    keep: &mut keep,
                    sound: &mut sound,
                };
                predict(w.each_ref().map(|row| &row[..]), p, out);
                (half, sound)
            });
            assert_eq!(found[0], found[1], "{name}");
            assert!(found[0].1[len / 2] > 1000.0, "{name}");
        }
    }
}
