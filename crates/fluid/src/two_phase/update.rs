//! What the five-equation model does to the mixed cells of a block at the end of a step, and to the gas's mass.

use std::hint::select_unpredictable;

use super::closure::{bounded, is_bound, phase_densities};
use super::reconstruction::CellRule;
use super::relaxation::{Advected, relaxed_fractions};
use super::traces::closed;
use super::windows::{LANES, Lane, Window, bits, lanes};
use crate::reconstruction::Rows;
use crate::state::conserved::{ENERGY, MOMENTUM_R, MOMENTUM_Z, PHI, RHO};
use crate::state::finished::finish_cell;
use crate::state::{COUNT, ConservedCell};
use crate::step::face_rows::FaceRows;
use crate::step::update::{FaceSlices, Metric, NewCells, balance, row};
use crate::{Face, Mixture};

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
        gas[k] = mass[k] * select_unpredictable(mass[k] >= 0.0, below[k], above[k]);
    }
}

/// m_g/ρ of the cells.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn gas_shares(gas: &[f64], density: &[f64], shares: &mut [f64]) {
    for (share, (gas, density)) in shares.iter_mut().zip(gas.iter().zip(density)) {
        *share = gas / density;
    }
}

/// Whether a row holds nothing but zeros.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn is_zero(row: &[f64]) -> bool {
    row.iter().fold(true, |found, value| found & (*value == 0.0))
}

/// Advances the gas's mass m_g of a block of N² cells.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn update_gas<const N: usize>(
    old: &[f64],
    [z_faces, r_faces]: [&FaceRows; 2],
    metric: &Metric<'_>,
    new: &mut [f64],
) {
    for j in 0..N {
        let row = metric.row(j);
        let k = metric.origin + j * metric.stride;
        let (west, east) = (&z_faces.gas()[k - 1..][..N], &z_faces.gas()[k..][..N]);
        let (south, north) = (&r_faces.gas()[k - metric.stride..][..N], &r_faces.gas()[k..][..N]);
        let (old, new) = (&old[j * N..][..N], &mut new[j * N..][..N]);
        for i in 0..N {
            new[i] = old[i] - (row.axial(east[i], west[i]) + row.radial(north[i], south[i]));
        }
    }
}

/// What bounding a block's gas came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct BoundedGas {
    /// Whether any is left.
    pub is_left: bool,
    /// Gas fractions that were bounded.
    pub clipped: u64,
    /// Traces that were set to zero.
    pub removed: u64,
    /// Whether a phase has less than no mass somewhere, see [`missing_mass`].
    pub has_missing: bool,
}

/// Bounds the gas fraction, takes out of it and of the gas's mass what means nothing any more, and tells what is left.
///
/// - `density`: ρ; `gas`: m_g.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn bound_gas(phi: &mut [f64], density: &[f64], gas: &mut [f64]) -> BoundedGas {
    // Without an early end these are a few operations on whole lines.
    let (mut is_left, mut has_missing) = (false, false);
    let (mut clipped, mut removed) = (0, 0);
    for value in phi.iter_mut() {
        let kept = without_trace(*value);
        let within = bounded(kept);
        removed += u64::from(kept != *value);
        clipped += u64::from(within != kept);
        *value = within;
        is_left |= within != 0.0;
    }
    for (value, density) in gas.iter_mut().zip(density) {
        let kept = without_trace(*value);
        removed += u64::from(kept != *value);
        has_missing |= missing_mass(*density, kept) != [0.0; 2];
        *value = kept;
        is_left |= kept != 0.0;
    }
    BoundedGas { is_left, clipped, removed, has_missing }
}

/// Takes out of the gas fractions of the paper's mixture what means nothing any more. They are not bounded.
///
/// - returns: whether any is left, and how many were set to zero.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn remove_traces(phi: &mut [f64]) -> (bool, u64) {
    let (mut is_left, mut removed) = (false, 0);
    for value in phi {
        let kept = without_trace(*value);
        removed += u64::from(kept != *value);
        *value = kept;
        is_left |= kept != 0.0;
    }
    (is_left, removed)
}

/// What the gas and the liquid of a cell lack of a mass of zero where one of them has fallen below its bound, kg/m³.
///
/// In first order, with face velocities that let less out of a cell than it holds, no phase's mass falls below zero. Second order
/// is done again at first where it takes too much ([`update_mixed`]); what is left is the little that prediction on a finer grid
/// may take a pure cell below, as it may take φ: 10⁻⁷ of the missing phase's density, 10⁻⁴ kg/m³ of water in gas of 0.02 kg/m³.
/// That moves with the flow and adds up to nothing; lifting it would make gas of liquid. So the bounds lie below it, for gas
/// −10⁻⁹ ρ, for liquid, which is missing where ρ is the gas's, −ρ/10.
#[inline(always)]
pub(crate) fn missing_mass(density: f64, gas: f64) -> [f64; 2] {
    let of_gas = if gas < -LEAST_GAS * density { -gas } else { 0.0 };
    let of_liquid = if gas - density > LEAST_LIQUID * density { gas - density } else { 0.0 };
    [of_gas, of_liquid]
}

/// See [`missing_mass`].
const LEAST_GAS: f64 = 1e-9;
/// See [`missing_mass`].
const LEAST_LIQUID: f64 = 0.1;

/// Zero in the place of a trace of gas, φ or kg/m³, that nothing can feel: no cell's law changes by a bit, nor, after all
/// steps of a run, the mass of the gas: 10¹² of them amount to 10⁻⁸ kg/m³ in one cell. Else advection would leave none of the
/// liquid without. They are counted.
#[inline(always)]
fn without_trace(value: f64) -> f64 {
    const NOTHING: f64 = 1e-20;
    if value.abs() < NOTHING { 0.0 } else { value }
}

/// A block at the beginning of a step.
pub(crate) struct OldCells<'a> {
    /// Conserved variables without ghosts.
    pub conserved: Rows<'a>,
    /// Pressure and φ of the padded cells.
    pub padded: [&'a [f64]; 2],
    /// m_g before and after the step.
    pub gas: [&'a [f64]; 2],
}

/// Where a mixed cell's step went beyond what the scheme can take; such cells are done again at first order.
///
/// A density, or the mass of a phase, that falls below a fifth; a phase that leaves more than it had; a volume that
/// changes by more than half; no internal energy left.
const LEAST_SHARE: f64 = 0.2;
const LEAST_VOLUME: f64 = -1e-9;
const LARGEST_CHANGE: f64 = 0.5;

/// Redoes the update of a block's mixed cells with the closure's gas fraction.
///
/// - `windows`: the cells that hold both phases, see [`super::mixed::MixedCells::mixed`].
/// - `marked`: the indices of the cells that should be done again at first order, written.
/// - returns: how many cells' gas fractions were bounded.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn update_mixed<const N: usize>(
    windows: &[Window],
    old: &OldCells<'_>,
    faces: [&FaceRows; 2],
    metric: &Metric<'_>,
    rule: &CellRule<'_>,
    new: &mut NewCells<'_>,
    marked: &mut Vec<usize>,
) -> u64 {
    let CellRule { mixture, options, .. } = *rule;
    marked.clear();
    let mut clipped = 0;
    let faces = faces.map(FaceRows::fluxes);
    // A loop over a SIMD batch of which the compiler knows the length it unrolls, and then finds no vectors in it.
    let batch = std::hint::black_box(LANES);
    for window in windows {
        let k = window.first;
        let (i, j) = ((k - metric.origin) % metric.stride, (k - metric.origin) / metric.stride);
        let at = j * N + i;
        let widths = metric.row(j);
        let [west, east] = [k - 1, k].map(|face| FaceSlices::<LANES>::cut(faces[0], face));
        let [south, north] = [k - metric.stride, k].map(|face| FaceSlices::<LANES>::cut(faces[1], face));
        let before = old.conserved.map(|component| row::<LANES>(component, at));
        let [gas_before, gas_after] = old.gas.map(|component| row::<LANES>(component, at));
        let mut u = [[0.0; LANES]; COUNT];
        let (mut is_chosen, mut changes) = ([false; LANES], [0.0; LANES]);
        let is_closed = closed(*window, old.padded, metric.stride, mixture);
        let mut cells = Advected::<LANES>::ZERO;
        for k in 0..LANES {
            let [west, east, south, north] = [west.at(k), east.at(k), south.at(k), north.at(k)];
            let own = lane(&before, k);
            let after = balance(own, [west, east, south, north], widths);
            [u[RHO][k], u[MOMENTUM_Z][k], u[MOMENTUM_R][k], u[ENERGY][k], u[PHI][k]] = after;
            let carried = |face: Face| face.velocity * face.phi;
            let volume =
                widths.axial(east.velocity, west.velocity) + widths.radial(north.velocity, south.velocity);
            is_chosen[k] = window.has(k);
            // What is not chosen has nothing to relax, and gas that stays closed only goes with the flow.
            cells.volume[k] = if is_chosen[k] & !is_closed[k] { volume } else { 0.0 };
            changes[k] = volume;
            cells.gas[k] =
                widths.axial(carried(east), carried(west)) + widths.radial(carried(north), carried(south));
        }
        let pressure = rule.of_gas(*window, row::<LANES>(old.padded[0], k));
        (cells.phi, cells.p, cells.fraction) = (*before[PHI], pressure, u[PHI]);
        if mixture.has_covolume() {
            take_covolumes(mixture, [before[RHO], gas_before], [&u[RHO], gas_after], &mut cells);
        }
        u[PHI] = if options.has_closure {
            relaxed_fractions(&cells, mixture)
        } else {
            cells.fraction.map(bounded)
        };
        let mut after = [[0.0; LANES]; COUNT + 3];
        finish_lanes(batch, &u, gas_after, mixture, &mut after);
        let (mut is_marked, mut is_clipped) = ([false; LANES], [false; LANES]);
        for k in 0..LANES {
            // No other cell ends just there.
            is_clipped[k] = is_bound(u[PHI][k]);
            let (rho, gas, change) = (before[RHO][k], gas_before[k], changes[k]);
            let falls =
                |before: f64, after: f64| after < LEAST_SHARE * if before > 0.0 { before } else { 0.0 };
            let is_drained = falls(rho, u[RHO][k])
                | falls(gas, gas_after[k])
                | falls(rho - gas, u[RHO][k] - gas_after[k])
                | (cells.phi[k] - cells.gas[k] < LEAST_VOLUME)
                | ((1.0 - cells.phi[k]) - (change - cells.gas[k]) < LEAST_VOLUME);
            let [rho, mz, mr, energy, _] = lane(&u.each_ref(), k);
            let internal = energy - 0.5 * (mz * mz + mr * mr) / rho;
            is_marked[k] = is_drained | (change.abs() > LARGEST_CHANGE) | !(internal > 0.0);
        }
        let put = |row: &mut [f64], values: &Lane| {
            let row = &mut row[at..][..LANES];
            for k in 0..LANES {
                row[k] = if is_chosen[k] { values[k] } else { row[k] };
            }
        };
        let (new_values, new_speeds) = after.split_at(COUNT);
        new.conserved.iter_mut().zip(new_values).for_each(|(row, values)| put(row, values));
        new.speeds.iter_mut().zip(new_speeds).for_each(|(row, values)| put(row, values));
        marked.extend(lanes(window.listed & bits(is_marked)).map(|lane| at + lane));
        clipped += u64::from((window.listed & bits(is_clipped)).count_ones());
    }
    clipped
}

/// What covolumes make of the closure: the phases' densities before the step, and what they bind after it.
///
/// - `before`, `after`: ρ and m_g.
#[inline(always)]
fn take_covolumes(
    mixture: &Mixture,
    [rho, gas]: [&Lane; 2],
    [rho_after, gas_after]: [&Lane; 2],
    cells: &mut Advected<LANES>,
) {
    for k in 0..LANES {
        let [rho_g, rho_l] = phase_densities(rho[k], gas[k] / rho[k], cells.phi[k], mixture);
        (cells.densities[0][k], cells.densities[1][k]) = (rho_g, rho_l);
        cells.bound[0][k] = mixture.gas.covolume * gas_after[k];
        cells.bound[1][k] = mixture.liquid.covolume * (rho_after[k] - gas_after[k]);
    }
}

/// The variables of one lane.
#[inline(always)]
fn lane([rho, mz, mr, energy, phi]: &[&Lane; COUNT], k: usize) -> ConservedCell {
    [rho[k], mz[k], mr[k], energy[k], phi[k]]
}

/// [`finish_cell`] of the first `n` lanes: what is conserved, and the two speeds and the floor's energy.
#[inline(always)]
fn finish_lanes(n: usize, u: &[Lane; COUNT], gas: &Lane, mixture: &Mixture, after: &mut [Lane; COUNT + 3]) {
    let [rho, mz, mr, energy, phi, speed_z, speed_r, floor] = after;
    for k in 0..n.min(LANES) {
        let cell = finish_cell::<true>(lane(&u.each_ref(), k), gas[k], mixture);
        [rho[k], mz[k], mr[k], energy[k], phi[k]] = cell.conserved;
        (speed_z[k], speed_r[k], floor[k]) = (cell.speed_z, cell.speed_r, cell.floor);
    }
}
