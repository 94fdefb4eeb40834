//! What the five-equation model does to the mixed cells of a block at the end of a step, and to the gas's mass.

use mesh::Padded;

use super::closure::{Compression, bounded, is_mixed, relaxed_fraction};
use super::mixed::MixedCells;
use super::reconstruction::Stencil;
use crate::rows::{FaceRows, Rows};
use crate::state::conserved::{ENERGY, PHI};
use crate::update::{FaceValues, Metric, balance, settled};

/// The gas's mass fluxes of one direction: the mass flux times the gas's part of the mass in the cell it comes from.
///
/// - `gas_shares`: m_g/ρ of the padded cells; `step`: distance of the cells on both sides of a face.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn gas_fluxes(gas_shares: &[f64], step: usize, faces: &mut FaceRows) {
    let n = gas_shares.len() - step;
    let (below, above) = (&gas_shares[..n], &gas_shares[step..]);
    let (gas, mass) = faces.gas_mut();
    let (gas, mass) = (&mut gas[..n], &mass[..n]);
    for k in 0..n {
        gas[k] = mass[k] * if mass[k] >= 0.0 { below[k] } else { above[k] };
    }
}

/// m_g/ρ of the cells.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn gas_shares(gas: &[f64], density: &[f64], shares: &mut [f64]) {
    for (share, (gas, density)) in shares.iter_mut().zip(gas.iter().zip(density)) {
        *share = gas / density;
    }
}

/// Advances the gas's mass m_g of a block of N² cells.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn update_gas<const N: usize>(
    old: &[f64],
    z_faces: &FaceRows,
    r_faces: &FaceRows,
    dt: f64,
    metric: &Metric<'_>,
    new: &mut [f64],
) {
    for j in 0..N {
        let row = metric.row(j, dt);
        let k = metric.origin + j * metric.stride;
        let (west, east) = (&z_faces.gas()[k - 1..][..N], &z_faces.gas()[k..][..N]);
        let (south, north) = (&r_faces.gas()[k - metric.stride..][..N], &r_faces.gas()[k..][..N]);
        let (old, new) = (&old[j * N..][..N], &mut new[j * N..][..N]);
        for i in 0..N {
            new[i] = old[i] - (row.axial(east[i], west[i]) + row.radial(north[i], south[i]));
        }
    }
}

/// Bounds the gas fraction, takes out of it and of the gas's mass what means nothing any more, and tells whether any gas is left.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn settle_gas(phi: &mut [f64], gas: &mut [f64]) -> bool {
    // Without an early end these are a few operations on whole lines.
    let mut is_left = false;
    for value in phi.iter_mut() {
        *value = bounded(without_trace(*value));
        is_left |= *value != 0.0;
    }
    for value in gas.iter_mut() {
        *value = without_trace(*value);
        is_left |= *value != 0.0;
    }
    is_left
}

/// Zero in the place of numbers that would end as subnormal ones, which are slow.
#[inline(always)]
fn without_trace(value: f64) -> f64 {
    const NOTHING: f64 = 1e-40;
    if value.abs() < NOTHING { 0.0 } else { value }
}

/// Where a mixed cell's step went beyond what the scheme can take; such cells are done again at first order.
///
/// A density, or the mass of a phase, that falls below a fifth; a phase that leaves more than it had; a volume that
/// changes by more than half; no internal energy left.
const LEAST_SHARE: f64 = 0.2;
const LEAST_VOLUME: f64 = -1e-9;
const LARGEST_CHANGE: f64 = 0.5;

/// Redoes the update of the listed cells of a block with the closure's gas fraction.
///
/// - `old`: conserved variables of the block; `pressure`: of its padded cells at the beginning of the step.
/// - `gas`: m_g before and after the step.
/// - `mark`: called with the index of each cell that should be done again at first order.
pub(crate) fn update_mixed<const N: usize>(
    mixed: &MixedCells,
    old: Rows<'_>,
    pressure: &[f64],
    gas: [&[f64]; 2],
    faces: [&FaceRows; 2],
    metric: &Metric<'_>,
    stencil: &Stencil<'_>,
    new: &mut [&mut [f64]; 5],
    speeds: &mut [&mut [f64]; 3],
    mut mark: impl FnMut(usize),
) {
    let Stencil { mixture, options, dt, .. } = *stencil;
    for &k in mixed.cells() {
        let Some((i, j)) = inner::<N>(k) else { continue };
        let at = j * N + i;
        if !is_mixed(old[PHI][at]) {
            continue;
        }
        let row = metric.row(j, dt);
        let [west, east] = [k - 1, k].map(|face| FaceValues::of(faces[0], face));
        let [south, north] = [k - metric.stride, k].map(|face| FaceValues::of(faces[1], face));
        let before = old.map(|component| component[at]);
        let mut u = balance(before, [west, east, south, north], row);
        let volume = row.axial(east.velocity, west.velocity) + row.radial(north.velocity, south.velocity);
        let carried = |face: &FaceValues| face.velocity * face.phi;
        let gas_volume =
            row.axial(carried(&east), carried(&west)) + row.radial(carried(&north), carried(&south));
        let phi = before[PHI];
        let compression = Compression::at(pressure[k], phi, mixture, options.has_closure);
        u[PHI] = if options.has_closure {
            relaxed_fraction(u[PHI], phi, pressure[k], volume, gas_volume, &compression, mixture)
        } else {
            bounded(u[PHI])
        };
        let [gas_before, gas_after] = gas.map(|row| row[at]);
        let falls = |before: f64, after: f64| after < LEAST_SHARE * before.max(0.0);
        let is_drained = falls(before[0], u[0])
            || falls(gas_before, gas_after)
            || falls(before[0] - gas_before, u[0] - gas_after)
            || phi - gas_volume < LEAST_VOLUME
            || (1.0 - phi) - (volume - gas_volume) < LEAST_VOLUME;
        let internal = u[ENERGY] - 0.5 * (u[1] * u[1] + u[2] * u[2]) / u[0];
        if is_drained || volume.abs() > LARGEST_CHANGE || !(internal > 0.0) {
            mark(at);
        }
        let cell = settled(u, mixture);
        for (row, value) in new.iter_mut().zip(cell.conserved) {
            row[at] = value;
        }
        for (row, value) in speeds.iter_mut().zip([cell.speed_z, cell.speed_r, cell.floor]) {
            row[at] = value;
        }
    }
}

/// Column and row of a padded cell that is one of the block's own.
fn inner<const N: usize>(k: usize) -> Option<(usize, usize)> {
    let inside = |x: usize| x.checked_sub(mesh::GHOSTS).filter(|x| *x < N);
    Some((inside(k % Padded::<N>::STRIDE)?, inside(k / Padded::<N>::STRIDE)?))
}
