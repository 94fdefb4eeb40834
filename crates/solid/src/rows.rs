//! Kernels over the cells of one padded block; see the fluid's for how such rows are walked.

use mesh::maximum;

use crate::riemann::{FaceState, WaveSpeeds, star};

/// Constants of an isotropic material as the kernels need them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Elasticity {
    /// 1/ρ̄, m³/kg.
    pub inverse_density: f64,
    /// ρ̄c₁², Pa.
    pub p_modulus: f64,
    /// α ρ̄c₁² = ρ̄(c₁² − 2c₂²), Pa (Lamé's λ).
    pub lambda: f64,
    /// ρ̄c₂², Pa (Lamé's μ).
    pub mu: f64,
    /// ρ̄c₁, Pa s/m.
    pub z1: f64,
    /// ρ̄c₂, Pa s/m.
    pub z2: f64,
}

impl Elasticity {
    pub fn new(speeds: WaveSpeeds) -> Self {
        Self {
            inverse_density: 1.0 / speeds.density,
            p_modulus: speeds.p_modulus(),
            lambda: speeds.lambda(),
            mu: speeds.shear_modulus(),
            z1: speeds.z1(),
            z2: speeds.z2(),
        }
    }
}

/// Slices of the six components.
pub(crate) type Rows<'a> = [&'a [f64]; 6];

/// Time derivatives of velocity and stress.
///
/// Paper eqs. (19), (20) unscaled and as corrected: ρ̄∂t v_z = ∂z σ_zz + ∂r σ_zr + σ_zr/r and so on.
///
/// - `w`: v_z, v_r, σ_zz, σ_zr, σ_rr, σ_φφ; `d_z`, `d_r`: derivatives, per m (those not needed are ignored);
///   `inverse_r`: 1/r, or 0 in planar geometry.
/// - returns ∂w/∂t.  errors: none.
#[inline(always)]
pub(crate) fn rates(w: [f64; 6], d_z: [f64; 6], d_r: [f64; 6], inverse_r: f64, e: &Elasticity) -> [f64; 6] {
    let axial = d_z[0];
    let radial = d_r[1];
    let hoop = w[1] * inverse_r;
    [
        e.inverse_density * (d_z[2] + d_r[3] + w[3] * inverse_r),
        e.inverse_density * (d_z[3] + d_r[4] + (w[4] - w[5]) * inverse_r),
        e.p_modulus * axial + e.lambda * (radial + hoop),
        e.mu * (d_z[1] + d_r[0]),
        e.p_modulus * radial + e.lambda * (axial + hoop),
        e.p_modulus * hoop + e.lambda * (axial + radial),
    ]
}

/// State at mid-step in all cells but the outermost layer: MUSCL-Hancock predictor, paper eqs. (24), (25).
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn predict(
    w: Rows<'_>,
    s_z: Rows<'_>,
    s_r: Rows<'_>,
    inverse_r: &[f64],
    inverse_h: [f64; 2],
    half_dt: f64,
    stride: usize,
    elasticity: &Elasticity,
    half: [&mut [f64]; 6],
) {
    let first = stride + 1;
    let n = inverse_r.len() - 2 * first;
    let [h0, h1, h2, h3, h4, h5] = half;
    predict_body(
        n,
        [
            &w[0][first..][..n],
            &w[1][first..][..n],
            &w[2][first..][..n],
            &w[3][first..][..n],
            &w[4][first..][..n],
            &w[5][first..][..n],
        ],
        [&s_z[0][first..][..n], &s_z[1][first..][..n], &s_z[2][first..][..n], &s_z[3][first..][..n]],
        [&s_r[0][first..][..n], &s_r[1][first..][..n], &s_r[3][first..][..n], &s_r[4][first..][..n]],
        &inverse_r[first..][..n],
        inverse_h,
        half_dt,
        elasticity,
        &mut h0[first..][..n],
        &mut h1[first..][..n],
        &mut h2[first..][..n],
        &mut h3[first..][..n],
        &mut h4[first..][..n],
        &mut h5[first..][..n],
    );
}

#[inline(always)]
fn predict_body(
    n: usize,
    w: Rows<'_>,
    z: [&[f64]; 4],
    r: [&[f64]; 4],
    inverse_r: &[f64],
    [inverse_hz, inverse_hr]: [f64; 2],
    half_dt: f64,
    elasticity: &Elasticity,
    h0: &mut [f64],
    h1: &mut [f64],
    h2: &mut [f64],
    h3: &mut [f64],
    h4: &mut [f64],
    h5: &mut [f64],
) {
    for k in 0..n {
        let here = [w[0][k], w[1][k], w[2][k], w[3][k], w[4][k], w[5][k]];
        let d_z = [
            z[0][k] * inverse_hz,
            z[1][k] * inverse_hz,
            z[2][k] * inverse_hz,
            z[3][k] * inverse_hz,
            0.0,
            0.0,
        ];
        let d_r = [
            r[0][k] * inverse_hr,
            r[1][k] * inverse_hr,
            0.0,
            r[2][k] * inverse_hr,
            r[3][k] * inverse_hr,
            0.0,
        ];
        let rate = rates(here, d_z, d_r, inverse_r[k], elasticity);
        h0[k] = here[0] + half_dt * rate[0];
        h1[k] = here[1] + half_dt * rate[1];
        h2[k] = here[2] + half_dt * rate[2];
        h3[k] = here[3] + half_dt * rate[3];
        h4[k] = here[4] + half_dt * rate[4];
        h5[k] = here[5] + half_dt * rate[5];
    }
}

/// Rows of star states at faces, indexed by the cell on the lower side of the face.
#[derive(Clone, Debug)]
pub(crate) struct FaceRows {
    /// Normal velocity.
    pub v_n: Vec<f64>,
    /// Tangential velocity.
    pub v_t: Vec<f64>,
    /// Normal stress.
    pub s_nn: Vec<f64>,
    /// Shear stress.
    pub s_nt: Vec<f64>,
}

impl FaceRows {
    pub fn zeros(len: usize) -> Self {
        let row = || vec![0.0; len];
        Self { v_n: row(), v_t: row(), s_nn: row(), s_nt: row() }
    }
}

/// What a face state is made of: v_n, v_t, σ_nn, σ_nt at mid-step and their differences across the cell.
#[derive(Clone, Copy)]
pub(crate) struct Reconstruction<'a> {
    pub half: [&'a [f64]; 4],
    pub differences: [&'a [f64]; 4],
}

impl Reconstruction<'_> {
    /// The state on the lower (`sign` = −1) or upper (+1) face of cell `k`.
    #[inline(always)]
    pub fn face_state(&self, k: usize, sign: f64) -> FaceState {
        let at = |c: usize| self.half[c][k] + 0.5 * sign * self.differences[c][k];
        FaceState { v_n: at(0), v_t: at(1), sigma_nn: at(2), sigma_nt: at(3) }
    }
}

/// The exact linear Riemann solution at the faces between cells `k` and `k + step`, for `k` in `range`.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn faces(
    cells: &Reconstruction<'_>,
    step: usize,
    range: std::ops::Range<usize>,
    elasticity: &Elasticity,
    faces: &mut FaceRows,
) {
    let (first, n) = (range.start, range.len());
    let Reconstruction { half: h, differences: d } = cells;
    let at = first + step;
    faces_body(
        n,
        Reconstruction {
            half: [&h[0][first..][..n], &h[1][first..][..n], &h[2][first..][..n], &h[3][first..][..n]],
            differences: [&d[0][first..][..n], &d[1][first..][..n], &d[2][first..][..n], &d[3][first..][..n]],
        },
        Reconstruction {
            half: [&h[0][at..][..n], &h[1][at..][..n], &h[2][at..][..n], &h[3][at..][..n]],
            differences: [&d[0][at..][..n], &d[1][at..][..n], &d[2][at..][..n], &d[3][at..][..n]],
        },
        elasticity,
        &mut faces.v_n[first..][..n],
        &mut faces.v_t[first..][..n],
        &mut faces.s_nn[first..][..n],
        &mut faces.s_nt[first..][..n],
    );
}

#[inline(always)]
fn faces_body(
    n: usize,
    lower: Reconstruction<'_>,
    upper: Reconstruction<'_>,
    elasticity: &Elasticity,
    v_n: &mut [f64],
    v_t: &mut [f64],
    s_nn: &mut [f64],
    s_nt: &mut [f64],
) {
    for k in 0..n {
        let face = star(lower.face_state(k, 1.0), upper.face_state(k, -1.0), elasticity.z1, elasticity.z2);
        v_n[k] = face.v_n;
        v_t[k] = face.v_t;
        s_nn[k] = face.sigma_nn;
        s_nt[k] = face.sigma_nt;
    }
}

/// What the update needs to know of a block's geometry.
pub(crate) struct Metric<'a> {
    /// Cells along a side.
    pub n: usize,
    /// Stride and flat index of cell (0, 0) of padded rows.
    pub stride: usize,
    /// See `stride`.
    pub origin: usize,
    /// 1/h_z, 1/h_r.
    pub inverse_h: [f64; 2],
    /// 1/r per padded cell, or 0 in planar geometry.
    pub inverse_r: &'a [f64],
}

/// Update of a block from its face states.
///
/// Paper eq. (23) for (19), (20). A radial divergence (r₊f₊ − r₋f₋)/(rΔr) is taken as (f₊ − f₋)/Δr + (f₊ + f₋)/2r,
/// which is the same and keeps a uniform hydrostatic stress exactly at rest. The hoop stress of the source is
/// the predicted one at mid-step.
///
/// - `old`, `new`: state `[component][j][i]` without ghosts; `hoop`: padded σ_φφ at mid-step.
/// - `mises`: N² numbers, the squared von Mises stress of the new state.
/// - returns: the largest squared von Mises stress, and whether all is finite.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn update(
    old: Rows<'_>,
    z_faces: &FaceRows,
    r_faces: &FaceRows,
    hoop: &[f64],
    dt: f64,
    metric: &Metric<'_>,
    elasticity: &Elasticity,
    new: [&mut [f64]; 6],
    mises: &mut [f64],
) -> f64 {
    let n = metric.n;
    let [v_z, v_r, s_zz, s_zr, s_rr, s_pp] = new;
    for j in 0..n {
        let row = j * n..(j + 1) * n;
        let k = metric.origin + j * metric.stride;
        let south = k - metric.stride;
        update_row(
            n,
            [
                &old[0][row.clone()],
                &old[1][row.clone()],
                &old[2][row.clone()],
                &old[3][row.clone()],
                &old[4][row.clone()],
                &old[5][row.clone()],
            ],
            FaceSlices::cut(z_faces, k - 1, n),
            FaceSlices::cut(z_faces, k, n),
            FaceSlices::cut(r_faces, south, n),
            FaceSlices::cut(r_faces, k, n),
            &hoop[k..][..n],
            [dt * metric.inverse_h[0], dt * metric.inverse_h[1], dt * metric.inverse_r[k]],
            elasticity,
            &mut v_z[row.clone()],
            &mut v_r[row.clone()],
            &mut s_zz[row.clone()],
            &mut s_zr[row.clone()],
            &mut s_rr[row.clone()],
            &mut s_pp[row.clone()],
            &mut mises[row.clone()],
        );
    }
    maximum(mises)
}

#[derive(Clone, Copy)]
struct FaceSlices<'a> {
    v_n: &'a [f64],
    v_t: &'a [f64],
    s_nn: &'a [f64],
    s_nt: &'a [f64],
}

impl<'a> FaceSlices<'a> {
    #[inline(always)]
    fn cut(faces: &'a FaceRows, at: usize, n: usize) -> Self {
        Self {
            v_n: &faces.v_n[at..][..n],
            v_t: &faces.v_t[at..][..n],
            s_nn: &faces.s_nn[at..][..n],
            s_nt: &faces.s_nt[at..][..n],
        }
    }
}

#[inline(always)]
fn update_row(
    n: usize,
    old: Rows<'_>,
    west: FaceSlices<'_>,
    east: FaceSlices<'_>,
    south: FaceSlices<'_>,
    north: FaceSlices<'_>,
    hoop_stress: &[f64],
    [dt_z, dt_r, dt_over_r]: [f64; 3],
    e: &Elasticity,
    v_z: &mut [f64],
    v_r: &mut [f64],
    s_zz: &mut [f64],
    s_zr: &mut [f64],
    s_rr: &mut [f64],
    s_pp: &mut [f64],
    mises: &mut [f64],
) {
    for k in 0..n {
        let mean = |high: f64, low: f64| 0.5 * dt_over_r * (high + low);
        let axial = dt_z * (east.v_n[k] - west.v_n[k]);
        let radial = dt_r * (north.v_n[k] - south.v_n[k]);
        let hoop = mean(north.v_n[k], south.v_n[k]);
        let shear = dt_z * (east.v_t[k] - west.v_t[k]) + dt_r * (north.v_t[k] - south.v_t[k]);
        let force_z = dt_z * (east.s_nn[k] - west.s_nn[k])
            + dt_r * (north.s_nt[k] - south.s_nt[k])
            + mean(north.s_nt[k], south.s_nt[k]);
        let force_r = dt_z * (east.s_nt[k] - west.s_nt[k])
            + dt_r * (north.s_nn[k] - south.s_nn[k])
            + (mean(north.s_nn[k], south.s_nn[k]) - dt_over_r * hoop_stress[k]);

        v_z[k] = old[0][k] + e.inverse_density * force_z;
        v_r[k] = old[1][k] + e.inverse_density * force_r;
        let zz = old[2][k] + (e.p_modulus * axial + e.lambda * (radial + hoop));
        let zr = old[3][k] + e.mu * shear;
        let rr = old[4][k] + (e.p_modulus * radial + e.lambda * (axial + hoop));
        let pp = old[5][k] + (e.p_modulus * hoop + e.lambda * (axial + radial));
        s_zz[k] = zz;
        s_zr[k] = zr;
        s_rr[k] = rr;
        s_pp[k] = pp;
        let squared =
            0.5 * ((zz - rr) * (zz - rr) + (zz - pp) * (zz - pp) + (rr - pp) * (rr - pp)) + 3.0 * (zr * zr);
        mises[k] = if squared < f64::MAX { squared } else { f64::INFINITY };
    }
}
