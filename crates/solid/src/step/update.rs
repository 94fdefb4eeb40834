//! The kernel that advances the cells of a block by their face states; written as those of `rows.rs`.

use mesh::{Blend, maximum};

use crate::material::yield_criterion::von_mises_squared;
use crate::state::component::COUNT;
use crate::step::rows::{Elasticity, FaceRows, Rows};

/// What the update needs to know of a block's geometry.
pub(crate) struct Metric<'a> {
    /// Stride and flat index of cell (0, 0) of padded rows.
    pub stride: usize,
    /// See `stride`.
    pub origin: usize,
    /// 1/h_z, 1/h_r.
    pub inverse_h: [f64; 2],
    /// 1/r per padded cell, or 0 in planar geometry.
    pub inverse_r: &'a [f64],
}

/// Simpson's weights of a face and of the cell in a mean over the cell.
pub(crate) const FACES: f64 = 1.0 / 6.0;
const CELL: f64 = 2.0 / 3.0;

/// Update of a block of N² cells from its face states.
///
/// Paper eq. (23) for (19), (20). The radial divergence of the shear, (r₊f₊ − r₋f₋)/(rΔr), is taken as
/// (f₊ − f₋)/Δr + (f₊ + f₋)/2r, which is the same. The other two terms with 1/r stay accurate on the axis only if both
/// of their parts are means of the same kind. The strain rate v_r/r has Simpson's mean of v_r over the cell,
/// (v₋ + 4v + v₊)/6, as ∂r v_r has its exact mean; with (v₋ + v₊)/2 a wave that passes the axis leaves a stress behind
/// there. The force (σ_rr − σ_φφ)/r has both stresses of the cell, predicted at mid-step; a uniform hydrostatic stress
/// stays exactly at rest.
///
/// - `old`, `new`: state `[component][j][i]` without ghosts; `half`: padded v_r, σ_rr, σ_φφ at mid-step.
/// - returns: the largest squared von Mises stress, infinite if one is not finite.
#[expect(clippy::too_many_arguments, reason = "geometry, law and rows of a block")]
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn update<const N: usize>(
    old: Rows<'_>,
    z_faces: &FaceRows,
    r_faces: &FaceRows,
    half: [&[f64]; 3],
    dt: f64,
    metric: &Metric<'_>,
    elasticity: &Elasticity,
    new: [&mut [f64]; 6],
) -> f64 {
    let [v_z, v_r, s_zz, s_zr, s_rr, s_pp] = new;
    let (mut largest, blend) = ([0.0; N], Blend::new());
    for j in 0..N {
        let at = j * N;
        let k = metric.origin + j * metric.stride;
        update_row::<N>(
            [
                row(old[0], at),
                row(old[1], at),
                row(old[2], at),
                row(old[3], at),
                row(old[4], at),
                row(old[5], at),
            ],
            FaceSlices::cut(z_faces, k - 1),
            FaceSlices::cut(z_faces, k),
            FaceSlices::cut(r_faces, k - metric.stride),
            FaceSlices::cut(r_faces, k),
            half.map(|component| row(component, k)),
            [dt * metric.inverse_h[0], dt * metric.inverse_h[1], dt * metric.inverse_r[k]],
            *elasticity,
            blend,
            row_mut(v_z, at),
            row_mut(v_r, at),
            row_mut(s_zz, at),
            row_mut(s_zr, at),
            row_mut(s_rr, at),
            row_mut(s_pp, at),
            &mut largest,
        );
    }
    maximum(&largest)
}

/// The components of one block of a field.
pub(crate) fn split_block<const N: usize>(block: &mut [f64]) -> [&mut [f64]; COUNT] {
    let mut rows = block.chunks_exact_mut(N * N);
    std::array::from_fn(|_| rows.next().expect("a block has that many components"))
}

/// N numbers from `at` on, so that the compiler knows how many.
#[inline(always)]
pub(crate) fn row<const N: usize>(numbers: &[f64], at: usize) -> &[f64; N] {
    numbers[at..].first_chunk().expect("rows are whole")
}

#[inline(always)]
pub(crate) fn row_mut<const N: usize>(numbers: &mut [f64], at: usize) -> &mut [f64; N] {
    numbers[at..].first_chunk_mut().expect("rows are whole")
}

/// [`FaceRows`] cut to the faces of one row of cells.
#[derive(Clone, Copy)]
pub(crate) struct FaceSlices<'a, const N: usize> {
    v_n: &'a [f64; N],
    v_t: &'a [f64; N],
    s_nn: &'a [f64; N],
    s_nt: &'a [f64; N],
}

impl<'a, const N: usize> FaceSlices<'a, N> {
    #[inline(always)]
    fn cut(faces: &'a FaceRows, at: usize) -> Self {
        Self::of([&faces.v_n, &faces.v_t, &faces.s_nn, &faces.s_nt], at)
    }

    /// Of rows of v_n, v_t, σ_nn, σ_nt.
    #[inline(always)]
    pub fn of([v_n, v_t, s_nn, s_nt]: [&'a [f64]; 4], at: usize) -> Self {
        Self { v_n: row(v_n, at), v_t: row(v_t, at), s_nn: row(s_nn, at), s_nt: row(s_nt, at) }
    }
}

#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias; the fluid has measured it")]
#[inline(always)]
pub(crate) fn update_row<const N: usize>(
    old: [&[f64; N]; 6],
    west: FaceSlices<'_, N>,
    east: FaceSlices<'_, N>,
    south: FaceSlices<'_, N>,
    north: FaceSlices<'_, N>,
    [half_v_r, half_s_rr, half_s_pp]: [&[f64; N]; 3],
    [dt_z, dt_r, dt_over_r]: [f64; 3],
    e: Elasticity,
    blend: Blend,
    v_z: &mut [f64; N],
    v_r: &mut [f64; N],
    s_zz: &mut [f64; N],
    s_zr: &mut [f64; N],
    s_rr: &mut [f64; N],
    s_pp: &mut [f64; N],
    largest: &mut [f64; N],
) {
    let two_mu = 2.0 * e.mu;
    for k in 0..N {
        let mean = |high: f64, low: f64| 0.5 * dt_over_r * (high + low);
        let axial = dt_z * (east.v_n[k] - west.v_n[k]);
        let radial = dt_r * (north.v_n[k] - south.v_n[k]);
        let hoop = dt_over_r * (FACES * (north.v_n[k] + south.v_n[k]) + CELL * half_v_r[k]);
        let shear = dt_z * (east.v_t[k] - west.v_t[k]) + dt_r * (north.v_t[k] - south.v_t[k]);
        let force_z = dt_z * (east.s_nn[k] - west.s_nn[k])
            + dt_r * (north.s_nt[k] - south.s_nt[k])
            + mean(north.s_nt[k], south.s_nt[k]);
        let force_r = dt_z * (east.s_nt[k] - west.s_nt[k])
            + dt_r * (north.s_nn[k] - south.s_nn[k])
            + dt_over_r * (half_s_rr[k] - half_s_pp[k]);

        v_z[k] = old[0][k] + e.inverse_density * force_z;
        v_r[k] = old[1][k] + e.inverse_density * force_r;
        let dilatation = e.lambda * ((axial + radial) + hoop);
        let zz = old[2][k] + (dilatation + two_mu * axial);
        let zr = old[3][k] + e.mu * shear;
        let rr = old[4][k] + (dilatation + two_mu * radial);
        let pp = old[5][k] + (dilatation + two_mu * hoop);
        s_zz[k] = zz;
        s_zr[k] = zr;
        s_rr[k] = rr;
        s_pp[k] = pp;
        let squared = von_mises_squared(zz, zr, rr, pp);
        // A NaN counts as infinite.
        let squared = if squared < f64::MAX { squared } else { f64::INFINITY };
        largest[k] = blend.larger(squared, largest[k]);
    }
}
