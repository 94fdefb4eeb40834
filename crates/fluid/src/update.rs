//! The kernel that advances the cells of a block by their face fluxes; written as those of `rows.rs`.

use mesh::maximum;

use crate::Mixture;
use crate::rows::{FaceRows, Rows};
use crate::state::primitive;

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
