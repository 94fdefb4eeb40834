//! The kernel that advances the cells of a block by their face fluxes; written as those of `rows.rs`.

use mesh::maximum;

use crate::Mixture;
use crate::rows::{FaceRows, Rows};

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

/// Conservative update of a block of N² cells from its face fluxes, gas fraction in the form (27).
///
/// Paper eqs. (23), (27). The pressure's share of the radial momentum is (p₊ − p₋)/Δr: flux and source of the
/// axisymmetric form taken together, with the source the mean of both faces' pressures, so that a uniform
/// pressure exerts exactly no radial force.
///
/// - `old`, `new`: conserved variables `[component][j][i]` without ghosts.
/// - `speeds`: scratch of N² numbers each: |v_z| + c, |v_r| + c, energy added by the floor.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn update<const N: usize>(
    old: Rows<'_>,
    z_faces: &FaceRows,
    r_faces: &FaceRows,
    dt: f64,
    metric: &Metric<'_>,
    mixture: &Mixture,
    new: [&mut [f64]; 5],
    speeds: [&mut [f64]; 3],
) -> Extremes {
    let [rho, mz, mr, energy, phi] = new;
    let [speed_z, speed_r, floor] = speeds;
    for j in 0..N {
        let at = j * N;
        let k = metric.origin + j * metric.stride;
        update_row::<N>(
            [row(old[0], at), row(old[1], at), row(old[2], at), row(old[3], at), row(old[4], at)],
            FaceSlices::cut(z_faces, k - 1),
            FaceSlices::cut(z_faces, k),
            FaceSlices::cut(r_faces, k - metric.stride),
            FaceSlices::cut(r_faces, k),
            RowMetric {
                dt_z: dt * metric.inverse_h[0],
                dt_r: dt * metric.inverse_h[1],
                lower: metric.face_weight[j] * metric.inverse_weight[j],
                upper: metric.face_weight[j + 1] * metric.inverse_weight[j],
            },
            *mixture,
            row_mut(rho, at),
            row_mut(mz, at),
            row_mut(mr, at),
            row_mut(energy, at),
            row_mut(phi, at),
            row_mut(speed_z, at),
            row_mut(speed_r, at),
            row_mut(floor, at),
        );
    }
    Extremes {
        speed_z: maximum(speed_z),
        speed_r: maximum(speed_r),
        phi: maximum(phi),
        floor: maximum(floor),
    }
}

/// N numbers from `at` on, so that the compiler knows how many.
#[inline(always)]
fn row<const N: usize>(numbers: &[f64], at: usize) -> &[f64; N] {
    numbers[at..].first_chunk().expect("rows are whole")
}

#[inline(always)]
fn row_mut<const N: usize>(numbers: &mut [f64], at: usize) -> &mut [f64; N] {
    numbers[at..].first_chunk_mut().expect("rows are whole")
}

/// [`FaceRows`] cut to the faces of one row of cells.
#[derive(Clone, Copy)]
struct FaceSlices<'a, const N: usize> {
    mass: &'a [f64; N],
    velocity: &'a [f64; N],
    pressure: &'a [f64; N],
    shear: &'a [f64; N],
    energy: &'a [f64; N],
    phi: &'a [f64; N],
}

impl<'a, const N: usize> FaceSlices<'a, N> {
    #[inline(always)]
    fn cut(faces: &'a FaceRows, at: usize) -> Self {
        Self {
            mass: row(&faces.mass, at),
            velocity: row(&faces.velocity, at),
            pressure: row(&faces.pressure, at),
            shear: row(&faces.shear, at),
            energy: row(&faces.energy, at),
            phi: row(&faces.phi, at),
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
fn update_row<const N: usize>(
    old: [&[f64; N]; 5],
    west: FaceSlices<'_, N>,
    east: FaceSlices<'_, N>,
    south: FaceSlices<'_, N>,
    north: FaceSlices<'_, N>,
    metric: RowMetric,
    mixture: Mixture,
    rho: &mut [f64; N],
    mz: &mut [f64; N],
    mr: &mut [f64; N],
    energy: &mut [f64; N],
    phi: &mut [f64; N],
    speed_z: &mut [f64; N],
    speed_r: &mut [f64; N],
    floor: &mut [f64; N],
) {
    let RowMetric { dt_z, dt_r, lower, upper } = metric;
    for k in 0..N {
        let axial = |high: f64, low: f64| dt_z * (high - low);
        let radial = |high: f64, low: f64| dt_r * (upper * high - lower * low);
        let normal = |f: &FaceSlices<'_, N>| f.mass[k] * f.velocity[k];
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
        let carried = |f: &FaceSlices<'_, N>| f.velocity[k] * (f.phi[k] - old_phi);
        let new_phi =
            old_phi - (axial(carried(&east), carried(&west)) + radial(carried(&north), carried(&south)));

        // As `state::primitive`, with one division for 1/ρ and one for 1/β₁, which the sound speed needs as well.
        let inverse_rho = 1.0 / new_rho;
        let (v_z, v_r) = (new_mz * inverse_rho, new_mr * inverse_rho);
        let internal = new_energy - 0.5 * (new_mz * v_z + new_mr * v_r);
        let (beta1, beta2) = (mixture.beta1(new_phi), mixture.beta2(new_phi));
        let inverse_beta1 = 1.0 / beta1;
        let p = (internal - beta2) * inverse_beta1;
        let lowest = mixture.pressure_floor(new_phi);
        let lifted = if p < lowest { lowest } else { p };
        let added = beta1 * (lifted - p);
        let sound = (((1.0 + beta1) * lifted + beta2) * (inverse_beta1 * inverse_rho)).sqrt();
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
