//! Domain and cells of a side.

use coupler::Scheme;
use mesh::{BLOCK, Geometry, Side};

use super::GridCase;
use super::keys::grid::{MOST_CELLS, MOST_LEVELS};
use super::read_adaptation::{Asked, Levels, adaptation};
use super::reader::{Faults, Given, Table};
use super::shared::Context;

/// Where a side's ranges stand, for what is found out when both sides are known.
pub(super) struct GridPlace {
    pub z: Given<[f64; 2]>,
    pub r: Given<[f64; 2]>,
    /// What it says of the thresholds of adaptation.
    pub asked: Asked,
}

/// Domain and cells of a side.
///
/// - `towards_wall`: the side of the domain where the other medium or the rigid wall is, if any.
pub(super) fn grid(
    table: &mut Table<'_>,
    context: Context,
    towards_wall: Side,
    faults: &mut Faults,
) -> Option<(GridCase, GridPlace)> {
    let z = table.range("z", faults);
    let mut r = table.range("r", faults);
    if let Some(given) = &r
        && context.geometry == Geometry::Axisymmetric
        && given.value[0] != 0.0
    {
        let start = given.value[0];
        let message = if start < 0.0 {
            format!("axisymmetric geometry has no negative r, got {start:?} m")
        } else {
            format!("an axisymmetric domain must start at the axis r = 0, got {start:?} m")
        };
        faults.of(given, message, "start at r = 0.0, or take geometry = \"planar\"");
        r = None;
    }
    let cells = table.whole_pair("cells", faults);
    let levels = table.whole("levels", faults);
    let levels = match levels {
        Some(given) => Some(given.value),
        // Present and faulty, or absent: then there is one level.
        None => (!table.has("levels")).then_some(0),
    };
    let sound = cells.as_ref().zip(levels).filter(|(cells, levels)| fits(cells, *levels, faults));
    let levels = match sound {
        Some((cells, levels)) => Levels { roots: root_level(cells.value, levels), finest: levels },
        // Whatever they were meant to be, more there cannot be.
        None => Levels { roots: 0, finest: MOST_LEVELS },
    };
    let interface = (context.scheme != Some(Scheme::None)).then_some(towards_wall);
    let grid = sound.zip(z.as_ref().zip(r.as_ref())).map(|((cells, levels), (z, r))| GridCase {
        z: z.value,
        r: r.value,
        cells: cells.value,
        levels,
        adaptation: None,
    });
    let has_interfaces = towards_wall == Side::ZMin;
    let (adaptation, asked) = adaptation(table, levels, has_interfaces, interface, faults);
    Some((GridCase { adaptation, ..grid? }, GridPlace { z: z?, r: r?, asked }))
}

/// The level of the coarsest blocks: the first whose cells fill whole blocks in both directions.
pub(super) fn root_level(cells: [usize; 2], levels: usize) -> usize {
    let whole = |level: &usize| cells.iter().all(|cells| (cells << level).is_multiple_of(BLOCK));
    (0..levels).find(whole).unwrap_or(levels)
}

/// Whether the finest grid is a whole number of blocks and not absurdly large.
fn fits(cells: &Given<[usize; 2]>, levels: usize, faults: &mut Faults) -> bool {
    let finest = cells.value.map(|cells| cells << levels);
    let formula = format!("{} x {} cells (cells * 2^levels)", finest[0], finest[1]);
    if finest.iter().any(|cells| *cells > MOST_CELLS) {
        let message = format!("the finest grid has {formula}, more than {MOST_CELLS} along one direction");
        faults.of(cells, message, "take fewer cells or levels");
        return false;
    }
    if finest.iter().all(|cells| cells.is_multiple_of(BLOCK)) {
        return true;
    }
    let step = BLOCK >> levels.min(BLOCK.ilog2() as usize);
    let nearest = cells.value.map(|cells| ((cells + step / 2) / step).max(1) * step);
    let mut help = format!(
        "the nearest that is: cells = [{}, {}], finest {} x {}",
        nearest[0],
        nearest[1],
        nearest[0] << levels,
        nearest[1] << levels
    );
    let whole = |levels: &usize| cells.value.iter().all(|cells| (cells << levels).is_multiple_of(BLOCK));
    if let Some(levels) = (levels..=MOST_LEVELS).find(whole) {
        help += &format!("; or levels = {levels} with the cells as they are");
    }
    let message = format!("the finest grid has {formula}, no whole number of blocks of {BLOCK} x {BLOCK}");
    faults.of(cells, message, help);
    false
}
