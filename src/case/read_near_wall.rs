//! `[fluid.near_wall]`: how far the grid rises above `levels` next to the wall.

use fluid::NearWall;

use super::keys::adaptation::FILM_CELLS;
use super::keys::grid::{MOST_CELLS, MOST_LEVELS};
use super::reader::{Faults, Table};
use super::shared::Context;
use super::{GridCase, LocalSteps};
use coupler::Scheme;

/// Levels where a shock is about to hit the wall, where a case does not say and asks for local steps: a fine cell more then costs little.
/// Without, all cells would make the steps of the finest.
const SHOCK_LEVELS: usize = 2;

/// How far the grid rises next to the wall, and what the adaptation must know of it.
///
/// - `grid`: the fluid's; none where it is faulty.
pub(super) fn near_wall(
    table: &mut Table<'_>,
    grid: Option<&mut GridCase>,
    context: Context,
    faults: &mut Faults,
) -> NearWall {
    let has_wall = context.scheme != Some(Scheme::None);
    let adapts = grid.as_ref().is_some_and(|grid| grid.adaptation.is_some() && fits(grid, SHOCK_LEVELS));
    let is_asked_for = context.local_steps == LocalSteps::Always;
    let by_default = if is_asked_for && has_wall && adapts { SHOCK_LEVELS } else { 0 };
    let mut given = [None, None, None];
    if let Some(mut table) = table.table("near_wall", faults) {
        given = [
            table.whole("shock_levels", faults),
            table.whole("film_levels", faults),
            table.whole("film_cells", faults),
        ];
        table.finish(faults);
    }
    let number =
        |which: usize, default: usize| given[which].as_ref().map_or(default, |given| given.value) as u8;
    let near = NearWall {
        shock_levels: number(0, by_default),
        film_levels: number(1, 0),
        film_cells: number(2, FILM_CELLS),
        ..NearWall::default()
    };
    let farthest = given.iter().take(2).flatten().max_by_key(|given| given.value);
    if let (Some(given), Some(grid)) = (farthest.filter(|given| given.value > 0), &grid) {
        let what = format!("is {} levels above fluid.levels = {}", given.value, grid.levels);
        if !has_wall {
            let message = format!("{what} at a wall, and scheme = \"none\" has none");
            faults.of(given, message, "couple a solid, or take scheme = \"rigid\"");
        } else if !fits(grid, given.value) {
            let message =
                format!("{what}: more than {MOST_CELLS} cells along one direction, or {MOST_LEVELS} levels");
            faults.of(given, message, "take fewer levels");
        } else if grid.adaptation.is_none() {
            let message = format!("{what}, and the fluid's grid does not adapt");
            faults.of(given, message, "take fluid.adapt = true and more than one level, or remove it");
        }
    }
    if let Some(adaptation) = grid.and_then(|grid| grid.adaptation.as_mut()) {
        adaptation.above = near.levels();
    }
    near
}

/// Whether so many levels more are not absurdly many.
fn fits(grid: &GridCase, above: usize) -> bool {
    grid.levels + above <= MOST_LEVELS && grid.finest().iter().all(|cells| cells << above <= MOST_CELLS)
}
