//! Kernels over the cells of one padded block.
//!
//! Every function walks flat rows (see [`mesh::Padded`]) with a body free of branches, so that the compiler
//! vectorises it; each is compiled for several instruction sets and the best one is chosen at run time.
//! Rust never contracts a·b + c, so the results do not depend on that choice.

use mesh::maximum;

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

/// Reductions over a block's new cells.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Extremes {
    /// Largest |v_z| + c, infinite if a cell is not admissible.
    pub speed_z: f64,
    /// Largest |v_r| + c, infinite if a cell is not admissible.
    pub speed_r: f64,
    /// Largest gas fraction.
    pub phi: f64,
    /// Largest energy per volume that the pressure floor added to a cell.
    pub floor: f64,
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
    /// Weights r_j−1/2 (or 1) of the N + 1 r-faces.
    pub face_weight: &'a [f64],
    /// 1/r_j (or 1) of the N rows.
    pub inverse_weight: &'a [f64],
}

/// Conservative update of a block from its face fluxes, gas fraction in the form (27).
///
/// Paper eqs. (23), (27). The pressure's share of the radial momentum is (p₊ − p₋)/Δr: flux and source of the
/// axisymmetric form taken together, with the source the mean of both faces' pressures, so that a uniform
/// pressure exerts exactly no radial force.
///
/// - `old`, `new`: conserved variables `[component][j][i]` without ghosts.
/// - `speeds`: scratch of N² numbers each: |v_z| + c, |v_r| + c, energy added by the floor.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn update(
    old: Rows<'_>,
    z_faces: &FaceRows,
    r_faces: &FaceRows,
    dt: f64,
    metric: &Metric<'_>,
    mixture: &Mixture,
    new: [&mut [f64]; 5],
    speeds: [&mut [f64]; 3],
) -> Extremes {
    let n = metric.n;
    let [rho, mz, mr, energy, phi] = new;
    let [speed_z, speed_r, floor] = speeds;
    for j in 0..n {
        let row = j * n..(j + 1) * n;
        let k = metric.origin + j * metric.stride;
        update_row(
            n,
            old.map(|rows| &rows[row.clone()]),
            FaceSlices::cut(z_faces, k - 1, n),
            FaceSlices::cut(z_faces, k, n),
            FaceSlices::cut(r_faces, k - metric.stride, n),
            FaceSlices::cut(r_faces, k, n),
            RowMetric {
                dt_z: dt * metric.inverse_h[0],
                dt_r: dt * metric.inverse_h[1],
                lower: metric.face_weight[j] * metric.inverse_weight[j],
                upper: metric.face_weight[j + 1] * metric.inverse_weight[j],
            },
            mixture,
            &mut rho[row.clone()],
            &mut mz[row.clone()],
            &mut mr[row.clone()],
            &mut energy[row.clone()],
            &mut phi[row.clone()],
            &mut speed_z[row.clone()],
            &mut speed_r[row.clone()],
            &mut floor[row.clone()],
        );
    }
    Extremes {
        speed_z: maximum(speed_z),
        speed_r: maximum(speed_r),
        phi: maximum(phi),
        floor: maximum(floor),
    }
}

/// [`FaceRows`] cut to the faces of one row of cells.
#[derive(Clone, Copy)]
struct FaceSlices<'a> {
    mass: &'a [f64],
    velocity: &'a [f64],
    pressure: &'a [f64],
    shear: &'a [f64],
    energy: &'a [f64],
    phi: &'a [f64],
}

impl<'a> FaceSlices<'a> {
    #[inline(always)]
    fn cut(faces: &'a FaceRows, at: usize, n: usize) -> Self {
        Self {
            mass: &faces.mass[at..][..n],
            velocity: &faces.velocity[at..][..n],
            pressure: &faces.pressure[at..][..n],
            shear: &faces.shear[at..][..n],
            energy: &faces.energy[at..][..n],
            phi: &faces.phi[at..][..n],
        }
    }
}

/// Time step over cell width, and face weights over the row's weight.
#[derive(Clone, Copy)]
struct RowMetric {
    dt_z: f64,
    dt_r: f64,
    lower: f64,
    upper: f64,
}

#[inline(always)]
fn update_row(
    n: usize,
    old: Rows<'_>,
    west: FaceSlices<'_>,
    east: FaceSlices<'_>,
    south: FaceSlices<'_>,
    north: FaceSlices<'_>,
    metric: RowMetric,
    mixture: &Mixture,
    rho: &mut [f64],
    mz: &mut [f64],
    mr: &mut [f64],
    energy: &mut [f64],
    phi: &mut [f64],
    speed_z: &mut [f64],
    speed_r: &mut [f64],
    floor: &mut [f64],
) {
    let RowMetric { dt_z, dt_r, lower, upper } = metric;
    for k in 0..n {
        let axial = |high: f64, low: f64| dt_z * (high - low);
        let radial = |high: f64, low: f64| dt_r * (upper * high - lower * low);
        let normal = |f: &FaceSlices<'_>| f.mass[k] * f.velocity[k];
        // Both directions are added before they meet the old value, and alike for both components of the
        // momentum: planar flow does not tell z from r, to the last bit.
        let new_rho = old[0][k] - (axial(east.mass[k], west.mass[k]) + radial(north.mass[k], south.mass[k]));
        let force_z = axial(normal(&east), normal(&west)) + axial(east.pressure[k], west.pressure[k]);
        let force_r = radial(normal(&north), normal(&south)) + dt_r * (north.pressure[k] - south.pressure[k]);
        let new_mz = old[1][k] - (force_z + radial(north.shear[k], south.shear[k]));
        let new_mr = old[2][k] - (force_r + axial(east.shear[k], west.shear[k]));
        let new_energy =
            old[3][k] - (axial(east.energy[k], west.energy[k]) + radial(north.energy[k], south.energy[k]));
        let old_phi = old[4][k];
        let carried = |f: &FaceSlices<'_>| f.velocity[k] * (f.phi[k] - old_phi);
        let new_phi =
            old_phi - (axial(carried(&east), carried(&west)) + radial(carried(&north), carried(&south)));

        let [_, v_z, v_r, p, _] = primitive([new_rho, new_mz, new_mr, new_energy, new_phi], mixture);
        let lowest = mixture.pressure_floor(new_phi);
        let lifted = if p < lowest { lowest } else { p };
        let added = mixture.beta1(new_phi) * (lifted - p);
        let sound = (mixture.stiffness(lifted, new_phi) / new_rho).sqrt();
        let sane = (new_rho > 0.0) & (sound < f64::MAX);
        rho[k] = new_rho;
        mz[k] = new_mz;
        mr[k] = new_mr;
        energy[k] = new_energy + added;
        phi[k] = new_phi;
        speed_z[k] = if sane { v_z.abs() + sound } else { f64::INFINITY };
        speed_r[k] = if sane { v_r.abs() + sound } else { f64::INFINITY };
        floor[k] = added;
    }
}
