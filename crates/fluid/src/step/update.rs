//! The kernel that advances the cells of a block by their face fluxes; written as those of `rows.rs`.

use mesh::maximum;

use serde::{Deserialize, Serialize};

use crate::reconstruction::{Rows, RowsMut, fraction};
use crate::state::conserved::PHI;
use crate::state::finished::{FinishedCell, finish_cell};
use crate::state::{COUNT, ConservedCell};
use crate::step::face_rows::FaceRows;
use crate::{Face, Mixture};

/// Reductions over a block's new cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
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

impl Extremes {
    /// Takes in one more cell.
    pub fn add(&mut self, cell: &FinishedCell) {
        self.speed_z = self.speed_z.max(cell.speed_z);
        self.speed_r = self.speed_r.max(cell.speed_r);
        self.phi = self.phi.max(cell.conserved[PHI]);
    }
}

/// The extremes of the rows that [`update`] writes.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn extremes(phi: &[f64], speeds: [&[f64]; 3]) -> Extremes {
    let [speed_z, speed_r, floor] = speeds;
    Extremes {
        speed_z: maximum(speed_z),
        speed_r: maximum(speed_r),
        phi: maximum(phi),
        floor: maximum(floor),
    }
}

/// What the update needs to know of a block's geometry and of the step.
pub(crate) struct Metric<'a> {
    /// Stride and flat index of cell (0, 0) of padded rows.
    pub stride: usize,
    /// See `stride`.
    pub origin: usize,
    /// Length of the step, s.
    pub dt: f64,
    /// 1/h_z, 1/h_r.
    pub inverse_h: [f64; 2],
    /// Weights r_j−1/2 (or 1) of the N + 1 r-faces.
    pub face_weight: &'a [f64],
    /// 1/r_j (or 1) of the N rows.
    pub inverse_weight: &'a [f64],
}

impl Metric<'_> {
    /// Of row `j`.
    #[inline(always)]
    pub fn row(&self, j: usize) -> RowMetric {
        RowMetric {
            dt_z: self.dt * self.inverse_h[0],
            dt_r: self.dt * self.inverse_h[1],
            lower: self.face_weight[j] * self.inverse_weight[j],
            upper: self.face_weight[j + 1] * self.inverse_weight[j],
        }
    }
}

/// What the update writes of a block's N² cells.
pub(crate) struct NewCells<'a> {
    /// Conserved variables.
    pub conserved: RowsMut<'a>,
    /// |v_z| + c, |v_r| + c, and the energy per volume that the floor added.
    pub speeds: [&'a mut [f64]; 3],
}

/// Conservative update of a block of N² cells from its face fluxes, gas fraction in the form (27).
///
/// Paper eqs. (23), (27). The pressure's share of the radial momentum is (p₊ − p₋)/Δr: flux and source of the
/// axisymmetric form taken together, with the source the mean of both faces' pressures, so that a uniform
/// pressure exerts exactly no radial force.
///
/// - `old`: conserved variables `[component][j][i]` without ghosts; `faces`: along z and r.
/// - `with_gas`: whether gas is in or comes into any cell; without it the gas fraction's rows are neither read nor written. `gas`: its
///   mass m_g after the step, where phases have masses of their own.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn update<const N: usize>(
    old: Rows<'_>,
    faces: [&FaceRows; 2],
    metric: &Metric<'_>,
    (with_gas, gas): (bool, Option<&[f64]>),
    mixture: &Mixture,
    new: NewCells<'_>,
) {
    match (with_gas, gas, mixture.has_covolume()) {
        (true, Some(gas), true) => update_rows::<N, true, true>(old, faces, metric, gas, mixture, new),
        (true, ..) => update_rows::<N, true, false>(old, faces, metric, &[], mixture, new),
        (false, _, true) => update_rows::<N, false, true>(old, faces, metric, &[], mixture, new),
        (false, ..) => update_rows::<N, false, false>(old, faces, metric, &[], mixture, new),
    }
}

#[inline(always)]
fn update_rows<const N: usize, const WITH_GAS: bool, const B: bool>(
    [old_rho, old_mz, old_mr, old_energy, old_phi]: Rows<'_>,
    faces: [&FaceRows; 2],
    metric: &Metric<'_>,
    gas: &[f64],
    mixture: &Mixture,
    new: NewCells<'_>,
) {
    let NewCells { conserved: [rho, mz, mr, energy, phi], speeds: [speed_z, speed_r, floor] } = new;
    let (z_faces, r_faces) = (faces[0].fluxes(), faces[1].fluxes());
    let cells = N * N;
    let old = (old_rho[..cells].chunks_exact(N).zip(old_mz[..cells].chunks_exact(N)))
        .zip(old_mr[..cells].chunks_exact(N).zip(old_energy[..cells].chunks_exact(N)))
        .zip(old_phi[..cells].chunks_exact(N));
    let momenta = mz[..cells].chunks_exact_mut(N).zip(mr[..cells].chunks_exact_mut(N));
    let state = (rho[..cells].chunks_exact_mut(N).zip(momenta))
        .zip(energy[..cells].chunks_exact_mut(N).zip(phi[..cells].chunks_exact_mut(N)));
    let speeds = (speed_z[..cells].chunks_exact_mut(N).zip(speed_r[..cells].chunks_exact_mut(N)))
        .zip(floor[..cells].chunks_exact_mut(N));
    // One step through all rows together: cut one by one, they would take as long as what is done with them.
    let along_z = face_rows::<N>(z_faces, metric.origin - 1, metric.stride);
    let below = face_rows::<N>(r_faces, metric.origin - metric.stride, metric.stride);
    let above = face_rows::<N>(r_faces, metric.origin, metric.stride);
    let faces = along_z.zip(below.zip(above));
    for (j, (((faces, old), state), speeds)) in faces.zip(old).zip(state).zip(speeds).enumerate() {
        let (z, (south, north)) = faces;
        let (((rho_0, mz_0), (mr_0, energy_0)), phi_0) = old;
        let ((rho, (mz, mr)), (energy, phi)) = state;
        let ((speed_z, speed_r), floor) = speeds;
        update_row::<N, WITH_GAS, B>(
            [row(rho_0, 0), row(mz_0, 0), row(mr_0, 0), row(energy_0, 0), row(phi_0, 0)],
            FaceSlices::cut(z, 0),
            FaceSlices::cut(z, 1),
            FaceSlices::cut(south, 0),
            FaceSlices::cut(north, 0),
            metric.row(j),
            if WITH_GAS && B { row(gas, j * N) } else { &[0.0; N] },
            *mixture,
            row_mut(rho, 0),
            row_mut(mz, 0),
            row_mut(mr, 0),
            row_mut(energy, 0),
            row_mut(phi, 0),
            row_mut(speed_z, 0),
            row_mut(speed_r, 0),
            row_mut(floor, 0),
        );
    }
}

/// The rows of faces of a block's N rows of cells, from the face `first` on: each as long as the rows are apart.
#[inline(always)]
fn face_rows<const N: usize>(
    fluxes: [&[f64]; 6],
    first: usize,
    stride: usize,
) -> impl Iterator<Item = [&[f64]; 6]> {
    let [a, b, c, d, e, f] = fluxes.map(|flux| flux[first..][..N * stride].chunks_exact(stride));
    let pairs = a.zip(b).zip(c.zip(d)).zip(e.zip(f));
    pairs.map(|(((a, b), (c, d)), (e, f))| [a, b, c, d, e, f])
}

/// N numbers from `at` on, so that the compiler knows how many.
#[inline(always)]
pub(crate) fn row<const N: usize>(numbers: &[f64], at: usize) -> &[f64; N] {
    numbers[at..].first_chunk().expect("rows are whole")
}

#[inline(always)]
fn row_mut<const N: usize>(numbers: &mut [f64], at: usize) -> &mut [f64; N] {
    numbers[at..].first_chunk_mut().expect("rows are whole")
}

/// [`FaceRows::fluxes`] cut to the faces of one row of cells.
#[derive(Clone, Copy)]
pub(crate) struct FaceSlices<'a, const N: usize> {
    mass: &'a [f64; N],
    velocity: &'a [f64; N],
    pressure: &'a [f64; N],
    shear: &'a [f64; N],
    energy: &'a [f64; N],
    phi: &'a [f64; N],
}

impl<'a, const N: usize> FaceSlices<'a, N> {
    #[inline(always)]
    pub fn cut([mass, velocity, pressure, shear, energy, phi]: [&'a [f64]; 6], at: usize) -> Self {
        Self {
            mass: row(mass, at),
            velocity: row(velocity, at),
            pressure: row(pressure, at),
            shear: row(shear, at),
            energy: row(energy, at),
            phi: row(phi, at),
        }
    }

    #[inline(always)]
    pub fn at(&self, k: usize) -> Face {
        Face {
            mass: self.mass[k],
            velocity: self.velocity[k],
            pressure: self.pressure[k],
            shear: self.shear[k],
            energy: self.energy[k],
            phi: self.phi[k],
            // Rows have none: nothing of the balance asks for it.
            compression: 1.0,
        }
    }
}

/// What the balance of one row of cells needs: time step over cell width, and face weights over the row's weight.
#[derive(Clone, Copy)]
pub(crate) struct RowMetric {
    dt_z: f64,
    dt_r: f64,
    lower: f64,
    upper: f64,
}

impl RowMetric {
    /// Δt/h_z times the difference of a flux along z.
    #[inline(always)]
    pub fn axial(&self, high: f64, low: f64) -> f64 {
        self.dt_z * (high - low)
    }

    /// Δt/h_r times the weighted difference of a flux along r.
    #[inline(always)]
    pub fn radial(&self, high: f64, low: f64) -> f64 {
        self.dt_r * (self.upper * high - self.lower * low)
    }

    /// Δt/r times a value; nothing in planar geometry.
    #[inline(always)]
    pub fn around(&self, value: f64) -> f64 {
        self.dt_r * (self.upper - self.lower) * value
    }
}

/// One cell's conserved variables after the step, paper eqs. (23), (27), before anything is corrected.
///
/// Both directions are added before they meet the old value, and alike for both components of the momentum: planar
/// flow does not tell z from r, to the last bit.
///
/// - `faces`: west, east, south, north.
#[inline(always)]
pub(crate) fn balance(
    old: ConservedCell,
    [west, east, south, north]: [Face; 4],
    row: RowMetric,
) -> ConservedCell {
    let normal = |f: &Face| f.mass * f.velocity;
    let force_z = row.axial(normal(&east), normal(&west)) + row.axial(east.pressure, west.pressure);
    let force_r = row.radial(normal(&north), normal(&south)) + row.dt_r * (north.pressure - south.pressure);
    let [rho, mz, mr, energy, phi] = old;
    let carried = |f: &Face| f.velocity * (f.phi - phi);
    [
        rho - (row.axial(east.mass, west.mass) + row.radial(north.mass, south.mass)),
        mz - (force_z + row.radial(north.shear, south.shear)),
        mr - (force_r + row.axial(east.shear, west.shear)),
        energy - (row.axial(east.energy, west.energy) + row.radial(north.energy, south.energy)),
        phi - (row.axial(carried(&east), carried(&west)) + row.radial(carried(&north), carried(&south))),
    ]
}

// A flat list of what is written: of slices in a struct or an array the compiler does not know that they are apart. With
// two arrays here a step of 512 x 512 cells takes 57 instead of 43 ns per cell (1.3 times).
#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias")]
#[inline(always)]
fn update_row<const N: usize, const WITH_GAS: bool, const B: bool>(
    old: [&[f64; N]; COUNT],
    west: FaceSlices<'_, N>,
    east: FaceSlices<'_, N>,
    south: FaceSlices<'_, N>,
    north: FaceSlices<'_, N>,
    metric: RowMetric,
    gas: &[f64; N],
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
    for k in 0..N {
        let faces = [west.at(k), east.at(k), south.at(k), north.at(k)];
        let [rho_0, mz_0, mr_0, energy_0, phi_0] = old;
        let before = [rho_0[k], mz_0[k], mr_0[k], energy_0[k], phi_0[k]];
        let mut after = balance(before, faces, metric);
        after[PHI] = fraction::<WITH_GAS>(after[PHI]);
        let gas = if WITH_GAS && B { gas[k] } else { 0.0 };
        let cell = finish_cell::<B>(after, gas, &mixture);
        [rho[k], mz[k], mr[k], energy[k], _] = cell.conserved;
        if WITH_GAS {
            phi[k] = cell.conserved[PHI];
        }
        speed_z[k] = cell.speed_z;
        speed_r[k] = cell.speed_r;
        floor[k] = cell.floor;
    }
}
