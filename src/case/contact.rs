//! Interfaces with surface tension that meet a wall at t = 0.

use fluid::{Boundary, InitialCondition, Phase};
use mesh::Side;

use super::GridCase;
use super::read_terms::TermsCase;
use super::reader::Faults;

/// Refuses a start in which gas and liquid meet on a wall, and nothing is said of their angle there.
///
/// - `place`: path and span of `[fluid.terms]`.
pub(super) fn check(
    (path, span): (&str, &std::ops::Range<usize>),
    terms: &TermsCase,
    initial: &InitialCondition,
    grid: &GridCase,
    boundary: [Boundary; 4],
    faults: &mut Faults,
) {
    if terms.surface_tension.is_none() || terms.contact_angle.is_some() {
        return;
    }
    let walls = Side::NAMES.into_iter().filter(|(_, side)| boundary[*side as usize].is_wall());
    for (name, side) in walls {
        let Some([z, r]) = meeting(initial, grid, side) else { continue };
        let message = format!(
            "`contact_angle` is missing: with surface tension the angle must be known at which gas and liquid meet {name}, near ({z:.4e}, {r:.4e}) m at t = 0"
        );
        let help = "give `contact_angle = 90` in degrees, move the gas away from the wall, or leave `surface_tension` out";
        faults.at(&format!("{path}.contact_angle"), span, message, help);
    }
}

/// Where along a side the phase first changes in the row of finest cells next to it, m.
fn meeting(initial: &InitialCondition, grid: &GridCase, side: Side) -> Option<[f64; 2]> {
    let [across_cells, along_cells] = match side {
        Side::ZMin | Side::ZMax => grid.finest(),
        Side::RMin | Side::RMax => [grid.finest()[1], grid.finest()[0]],
    };
    let (across, along) = match side {
        Side::ZMin | Side::ZMax => (grid.z, grid.r),
        Side::RMin | Side::RMax => (grid.r, grid.z),
    };
    let place = |range: [f64; 2], cells: usize, k: usize| {
        range[0] + (range[1] - range[0]) * (k as f64 + 0.5) / cells as f64
    };
    let nearest = if matches!(side, Side::ZMin | Side::RMin) { 0 } else { across_cells - 1 };
    let off = place(across, across_cells, nearest);
    let point = |k| match side {
        Side::ZMin | Side::ZMax => [off, place(along, along_cells, k)],
        Side::RMin | Side::RMax => [place(along, along_cells, k), off],
    };
    let first = phase(initial, point(0));
    (1..along_cells).map(point).find(|point| phase(initial, *point) != first)
}

/// The phase that is painted last at a point.
fn phase(initial: &InitialCondition, point: [f64; 2]) -> Phase {
    let painted = initial.regions.iter().rev().find(|region| region.shape.contains(point));
    painted.map_or(initial.ambient.phase, |region| region.state.phase)
}
