//! Kernels over the cells of one padded block: primitive variables, predictor, fluxes.
//!
//! Every function walks flat rows (see [`mesh::Padded`]) with a body free of branches, so that the compiler
//! vectorises it; each is compiled for several instruction sets and the best one is chosen at run time.
//! Rust never contracts a·b + c, so the results do not depend on that choice.

use crate::Mixture;
use crate::hllc::{Face, flux_hllc};
use crate::state::primitive;

/// Slices of the five primitive variables ρ, v_z, v_r, p, φ.
pub(crate) type Rows<'a> = [&'a [f64]; 5];

/// Time derivatives of the primitive variables.
///
/// Paper eqs. (7)–(9) in primitive form, with the geometric term of the axisymmetric divergence.
///
/// - `w`: ρ, v_z, v_r, p, φ; `d_z`, `d_r`: their derivatives, per m; `inverse_r`: 1/r, or 0 in planar geometry.
/// - returns: ∂w/∂t.  valid for ρ > 0.  errors: none.
#[inline(always)]
pub(crate) fn rates(
    w: [f64; 5],
    d_z: [f64; 5],
    d_r: [f64; 5],
    inverse_r: f64,
    mixture: &Mixture,
) -> [f64; 5] {
    let [rho, v_z, v_r, p, phi] = w;
    let divergence = d_z[1] + d_r[2] + v_r * inverse_r;
    let advected = |k: usize| v_z * d_z[k] + v_r * d_r[k];
    let inverse_rho = 1.0 / rho;
    [
        -(advected(0) + rho * divergence),
        -(advected(1) + d_z[3] * inverse_rho),
        -(advected(2) + d_r[3] * inverse_rho),
        -(advected(3) + mixture.stiffness(p, phi) * divergence),
        -advected(4),
    ]
}

/// Whether the four face states of a cell, `half` ± half the differences, are fit for Riemann problems:
///
/// - densities and p + π above a thousandth of the cell's own;
/// - impedances ρc above (Δt/h) ρc² of the cell. Where gas lies beyond a face of a mixed cell, a pressure p' in
///   the cell drives the flow p'/(ρc) through the face, and that changes the pressure by (Δt/h) ρc² p'/(ρc):
///   with slopes so steep that the face state is gas while the cell is still stiff, it would overshoot
///   manyfold in every step. Smooth flow never comes near: there the ratio is the Courant number.
///
/// `ratio` is Δt/h along the narrower width.
#[inline(always)]
fn admissible(w: [f64; 5], half: [f64; 5], reach: [f64; 5], ratio: f64, mixture: &Mixture) -> bool {
    let stiffness_pressure = |phi: f64| mixture.beta2(phi) / (1.0 + mixture.beta1(phi));
    let phi_face = half[4] + reach[4];
    let lowest_density = half[0] - reach[0];
    let lowest_pressure = half[3] - reach[3];
    let excess = lowest_pressure + stiffness_pressure(phi_face);
    let carried = ratio * mixture.stiffness(w[3], w[4]);
    let impedance_squared = lowest_density * mixture.stiffness(lowest_pressure, phi_face);
    (lowest_density > 1e-3 * w[0])
        & (excess > 1e-3 * (w[3] + stiffness_pressure(w[4])))
        & (impedance_squared > carried * carried)
}

#[inline(always)]
fn scaled([a, b, c, d, e]: [f64; 5], factor: f64) -> [f64; 5] {
    [a * factor, b * factor, c * factor, d * factor, e * factor]
}

/// The state at mid-step, and the share of its slopes that the cell keeps: all (1), or half of them (MC slopes
/// are then no steeper than minmod's), or none (0, first order), whichever gives admissible face states.
#[inline(always)]
pub(crate) fn half_step(
    w: [f64; 5],
    s_z: [f64; 5],
    s_r: [f64; 5],
    inverse_h: [f64; 2],
    inverse_r: f64,
    half_dt: f64,
    mixture: &Mixture,
) -> ([f64; 5], f64) {
    let rate = rates(w, scaled(s_z, inverse_h[0]), scaled(s_r, inverse_h[1]), inverse_r, mixture);
    let moved = |k: usize, share: f64| w[k] + share * half_dt * rate[k];
    let at =
        |share: f64| [moved(0, share), moved(1, share), moved(2, share), moved(3, share), moved(4, share)];
    let reach = |k: usize| {
        let (a, b) = (s_z[k].abs(), s_r[k].abs());
        0.5 * if a > b { a } else { b }
    };
    let reach = [reach(0), 0.0, 0.0, reach(3), reach(4)];
    let [inverse_hz, inverse_hr] = inverse_h;
    let ratio = 2.0 * half_dt * if inverse_hz > inverse_hr { inverse_hz } else { inverse_hr };
    let whole = admissible(w, at(1.0), reach, ratio, mixture);
    let halved = admissible(w, at(0.5), scaled(reach, 0.5), ratio, mixture);
    let fallback = if halved { 0.5 } else { 0.0 };
    let keep = if whole { 1.0 } else { fallback };
    (at(keep), keep)
}

/// Conserved to primitive variables, in place of rows of equal length.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn to_primitive(rows: [&mut [f64]; 5], mixture: &Mixture) {
    let n = rows[0].len();
    let [rho, a, b, c, phi] = rows;
    to_primitive_body(n, &rho[..n], &mut a[..n], &mut b[..n], &mut c[..n], &phi[..n], mixture);
}

#[inline(always)]
fn to_primitive_body(
    n: usize,
    rho: &[f64],
    a: &mut [f64],
    b: &mut [f64],
    c: &mut [f64],
    phi: &[f64],
    mixture: &Mixture,
) {
    for k in 0..n {
        let w = primitive([rho[k], a[k], b[k], c[k], phi[k]], mixture);
        (a[k], b[k], c[k]) = (w[1], w[2], w[3]);
    }
}

/// Primitive variables at mid-step in all cells but the outermost layer, and the share of slopes kept.
///
/// MUSCL-Hancock predictor, paper eqs. (24), (25) with τ = Δt/2, in both directions at once.
///
/// - `w`: the cells; `s_z`, `s_r`: limited differences; `inverse_r`: per cell.
/// - `half`, `keep`: written where differences exist, see [`mesh::limited_differences`].
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn predict(
    w: Rows<'_>,
    s_z: Rows<'_>,
    s_r: Rows<'_>,
    inverse_r: &[f64],
    inverse_h: [f64; 2],
    half_dt: f64,
    stride: usize,
    mixture: &Mixture,
    half: [&mut [f64]; 5],
    keep: &mut [f64],
) {
    let first = stride + 1;
    let n = keep.len() - 2 * first;
    let [h0, h1, h2, h3, h4] = half.map(|row| &mut row[first..][..n]);
    predict_body(
        n,
        w.map(|row| &row[first..][..n]),
        s_z.map(|row| &row[first..][..n]),
        s_r.map(|row| &row[first..][..n]),
        &inverse_r[first..][..n],
        inverse_h,
        half_dt,
        mixture,
        h0,
        h1,
        h2,
        h3,
        h4,
        &mut keep[first..][..n],
    );
}

#[inline(always)]
fn predict_body(
    n: usize,
    w: Rows<'_>,
    s_z: Rows<'_>,
    s_r: Rows<'_>,
    inverse_r: &[f64],
    inverse_h: [f64; 2],
    half_dt: f64,
    mixture: &Mixture,
    h0: &mut [f64],
    h1: &mut [f64],
    h2: &mut [f64],
    h3: &mut [f64],
    h4: &mut [f64],
    keep: &mut [f64],
) {
    for k in 0..n {
        let at = |rows: &Rows<'_>| [rows[0][k], rows[1][k], rows[2][k], rows[3][k], rows[4][k]];
        let (half, kept) = half_step(at(&w), at(&s_z), at(&s_r), inverse_h, inverse_r[k], half_dt, mixture);
        [h0[k], h1[k], h2[k], h3[k], h4[k]] = half;
        keep[k] = kept;
    }
}

/// Rows of [`Face`]s, one number each, indexed by the cell on the lower side of the face.
#[derive(Clone, Debug)]
pub(crate) struct FaceRows {
    pub mass: Vec<f64>,
    pub velocity: Vec<f64>,
    pub pressure: Vec<f64>,
    pub shear: Vec<f64>,
    pub energy: Vec<f64>,
    pub phi: Vec<f64>,
}

impl FaceRows {
    pub fn zeros(len: usize) -> Self {
        let row = || vec![0.0; len];
        Self { mass: row(), velocity: row(), pressure: row(), shear: row(), energy: row(), phi: row() }
    }

    pub fn set(&mut self, k: usize, face: Face) {
        self.mass[k] = face.mass;
        self.velocity[k] = face.velocity;
        self.pressure[k] = face.pressure;
        self.shear[k] = face.shear;
        self.energy[k] = face.energy;
        self.phi[k] = face.phi;
    }
}

/// The reconstructed cells on whose faces Riemann problems are solved.
#[derive(Clone, Copy)]
pub(crate) struct Reconstruction<'a> {
    /// Mid-step states ρ, normal velocity, tangential velocity, p, φ.
    pub half: Rows<'a>,
    /// Limited differences across the cells in the same order.
    pub differences: Rows<'a>,
    /// The share of its slopes that each cell keeps, see [`half_step`].
    pub keep: &'a [f64],
}

impl Reconstruction<'_> {
    /// The state on the lower (`sign` = −1) or upper (+1) face of cell `k`.
    #[inline(always)]
    pub fn face_state(&self, k: usize, sign: f64) -> [f64; 5] {
        let weight = 0.5 * sign * self.keep[k];
        let at = |c: usize| self.half[c][k] + weight * self.differences[c][k];
        [at(0), at(1), at(2), at(3), at(4)]
    }
}

/// HLLC at the faces between cells `k` and `k + step`, for `k` in `range`.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn hllc_faces(
    cells: &Reconstruction<'_>,
    step: usize,
    range: std::ops::Range<usize>,
    mixture: &Mixture,
    faces: &mut FaceRows,
) {
    let (first, n) = (range.start, range.len());
    let cut = |at: usize| Reconstruction {
        half: cells.half.map(|row| &row[at..][..n]),
        differences: cells.differences.map(|row| &row[at..][..n]),
        keep: &cells.keep[at..][..n],
    };
    hllc_body(
        n,
        cut(first),
        cut(first + step),
        mixture,
        &mut faces.mass[first..][..n],
        &mut faces.velocity[first..][..n],
        &mut faces.pressure[first..][..n],
        &mut faces.shear[first..][..n],
        &mut faces.energy[first..][..n],
        &mut faces.phi[first..][..n],
    );
}

#[inline(always)]
fn hllc_body(
    n: usize,
    lower: Reconstruction<'_>,
    upper: Reconstruction<'_>,
    mixture: &Mixture,
    mass: &mut [f64],
    velocity: &mut [f64],
    pressure: &mut [f64],
    shear: &mut [f64],
    energy: &mut [f64],
    phi: &mut [f64],
) {
    for k in 0..n {
        let face = flux_hllc(lower.face_state(k, 1.0), upper.face_state(k, -1.0), mixture);
        mass[k] = face.mass;
        velocity[k] = face.velocity;
        pressure[k] = face.pressure;
        shear[k] = face.shear;
        energy[k] = face.energy;
        phi[k] = face.phi;
    }
}
