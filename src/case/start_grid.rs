//! The blocks that a case's grids have at the start at least.

use std::ops::ControlFlow;

use mesh::{BLOCK, Domain};

use super::{Case, GridCase, Medium};

/// More blocks than any machine can hold.
const ENOUGH: usize = 1 << 22;

/// Cells that the grid of a medium has at the start at least: where level bounds, regions and pulses want them. More than any machine
/// can hold are not counted on.
pub(super) fn least_cells(case: &Case, medium: Medium) -> f64 {
    let Some(grid) = grid_of(case, medium) else { return 0.0 };
    if grid.adaptation.is_none() {
        return grid.cell_count() as f64;
    }
    let in_block = (BLOCK * BLOCK) as f64;
    let [along_z, along_r] = roots(grid);
    let all = along_z.saturating_mul(along_r);
    if all > ENOUGH {
        return all as f64 * in_block;
    }
    let mut blocks = 0usize;
    blocks_at_start(case, medium, |_, _| {
        blocks += 1;
        if blocks > ENOUGH { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    blocks as f64 * in_block
}

/// Visits those blocks by their corners (z, r), m, until it is told to stop. A grid that does not adapt has all of the finest level.
pub(super) fn blocks_at_start(
    case: &Case,
    medium: Medium,
    mut visit: impl FnMut([f64; 2], [f64; 2]) -> ControlFlow<()>,
) {
    let Some(grid) = grid_of(case, medium) else { return };
    let first = if grid.adaptation.is_some() { grid.root_level() } else { grid.levels };
    let [along_z, along_r] = grid.cells_on(first).map(|cells| cells / BLOCK);
    // Depth first: at most three blocks wait on each level.
    let mut waiting: Vec<(usize, [usize; 2])> = Vec::new();
    for root in 0..along_z.saturating_mul(along_r) {
        waiting.push((first, [root % along_z, root / along_z]));
        while let Some((level, [i, j])) = waiting.pop() {
            let place = Place::of(grid, level, [i, j]);
            if level < grid.levels && place.wanted_level(case, grid, medium) > level {
                let quarters = [[0, 0], [1, 0], [0, 1], [1, 1]];
                waiting.extend(quarters.map(|[a, b]| (level + 1, [2 * i + a, 2 * j + b])));
            } else if visit(place.low, place.high).is_break() {
                return;
            }
        }
    }
}

/// Where a block is.
struct Place {
    low: [f64; 2],
    high: [f64; 2],
    /// Of its cells.
    widths: [f64; 2],
}

impl Place {
    fn of(grid: &GridCase, level: usize, [i, j]: [usize; 2]) -> Self {
        let cells = grid.cells_on(level);
        let widths = [(grid.z[1] - grid.z[0]) / cells[0] as f64, (grid.r[1] - grid.r[0]) / cells[1] as f64];
        let low = [grid.z[0] + (i * BLOCK) as f64 * widths[0], grid.r[0] + (j * BLOCK) as f64 * widths[1]];
        Self { low, high: [low[0] + BLOCK as f64 * widths[0], low[1] + BLOCK as f64 * widths[1]], widths }
    }

    /// The level that level bounds, regions and pulses want there.
    fn wanted_level(&self, case: &Case, grid: &GridCase, medium: Medium) -> usize {
        let domain = Domain { geometry: case.geometry, z: grid.z, r: grid.r };
        let asks = match (medium, &case.fluid) {
            (Medium::Fluid, Some(fluid)) => fluid.initial.asks_for_finer(self.low, self.high, self.widths),
            _ => false,
        };
        let finest =
            if asks { case.fluid.as_ref().map_or(grid.levels, |fluid| fluid.first_level()) } else { 0 };
        let mut wanted = finest.max(grid.root_level());
        for bound in grid.adaptation.iter().flat_map(|adaptation| &adaptation.bounds) {
            if bound.zone.meets(self.low, self.high, self.widths, &domain) {
                wanted = wanted.max(usize::from(bound.at_least)).min(usize::from(bound.at_most));
            }
        }
        wanted
    }
}

fn grid_of(case: &Case, medium: Medium) -> Option<&GridCase> {
    match medium {
        Medium::Fluid => case.fluid.as_ref().map(|side| &side.grid),
        Medium::Solid => case.solid.as_ref().map(|side| &side.grid),
    }
}

fn roots(grid: &GridCase) -> [usize; 2] {
    grid.cells_on(grid.root_level()).map(|cells| cells / BLOCK)
}
