//! How the grid of a side adapts: `adapt`, `epsilon`, `adapt_every` and `[[....refine]]`.

use mesh::{Adaptation, LevelBound, Side, Zone};

use super::reader::{Faults, Given, LARGEST, Table};

/// Threshold of the details where a case does not say and its fluid begins with jumps (regions, an inflow history):
/// there the scheme's own error is of first order.
pub const EPSILON_WITH_JUMPS: f64 = 3e-4;
/// Threshold of the details where a case does not say and all is smooth: the scheme's own error is then of second
/// order and much smaller. It is that of waves of 20 cells per width. See docs/adaptation.md for what both
/// cost and lose.
pub const EPSILON_IF_SMOOTH: f64 = 1e-6;
/// Cells per width of a wave for which [`EPSILON_IF_SMOOTH`] is meant.
const CELLS_IF_SMOOTH: f64 = 20.0;
/// Bounds of the threshold that follows the cells per width.
const SMOOTH_EPSILONS: [f64; 2] = [1e-9, 1e-5];
/// Steps between two adaptations where a case does not say.
pub const DEFAULT_ADAPT_EVERY: usize = 8;
/// More steps than this between two adaptations are a mistake.
const MOST_STEPS: usize = 1000;

/// The shapes of zones by name.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Sphere,
    Box,
    Interface,
    Outer,
}

/// The levels of a side's blocks.
#[derive(Clone, Copy)]
pub(super) struct Levels {
    /// The coarsest there are.
    pub roots: usize,
    /// The finest there are.
    pub finest: usize,
}

/// The threshold of the details where a case does not say.
///
/// Of smooth waves it falls as the scheme's own error does, ε = 10⁻⁶ (20 h/a)² with the cells' width h and the waves' a, so that
/// refinement keeps its order (Harten 1995; Cohen, Kaber, Müller & Postel 2003 choose ε likewise by the order and the finest
/// level). Of two digits.
///
/// - `has_jumps`: whether the fluid begins with jumps; `cells`: the finest cells per width of the narrowest wave, where known.
pub(super) fn default_epsilon(has_jumps: bool, cells: Option<f64>) -> f64 {
    if has_jumps {
        return EPSILON_WITH_JUMPS;
    }
    let [least, most] = SMOOTH_EPSILONS;
    let epsilon =
        cells.map_or(EPSILON_IF_SMOOTH, |cells| EPSILON_IF_SMOOTH * (CELLS_IF_SMOOTH / cells).powi(2));
    format!("{:.1e}", epsilon.clamp(least, most)).parse().unwrap_or(EPSILON_IF_SMOOTH)
}

/// How a grid adapts; `None` where all its cells are on the finest level.
///
/// - `default`: the threshold where the case does not say; `interface`: the side that meets the other medium or the rigid wall.
pub(super) fn adaptation(
    table: &mut Table<'_>,
    levels: Levels,
    default: f64,
    interface: Option<Side>,
    faults: &mut Faults,
) -> Option<Adaptation> {
    let adapt = table.boolean("adapt", faults).is_none_or(|given| given.value);
    let epsilon = table.number("epsilon", "1", faults);
    if let Some(epsilon) = &epsilon
        && !(epsilon.value > 0.0 && epsilon.value < 1.0)
    {
        let message = format!("must lie in (0, 1), got {:?}", epsilon.value);
        let help = format!("{default:?} is the default; a smaller one keeps more cells");
        faults.of(epsilon, message, help);
    }
    let every = table.whole("adapt_every", 1..=MOST_STEPS, faults);
    let bounds: Vec<LevelBound> = (table.tables("refine", faults).into_iter())
        .flat_map(|table| bounds(table, levels, interface, faults))
        .collect();
    (adapt && levels.roots < levels.finest).then(|| Adaptation {
        epsilon: epsilon.map_or(default, |given| given.value),
        every: every.map_or(DEFAULT_ADAPT_EVERY, |given| given.value) as u32,
        bounds,
    })
}

/// One element of `[[....refine]]`; none where it is faulty.
fn bounds(
    mut table: Table<'_>,
    levels: Levels,
    interface: Option<Side>,
    faults: &mut Faults,
) -> Vec<LevelBound> {
    let kind = kind(&mut table, faults);
    if kind.as_ref().is_some_and(|kind| kind.value == Kind::Outer) {
        let outer = outer(&mut table, levels, faults);
        table.finish(faults);
        return outer.unwrap_or_default();
    }
    bound(table, kind, levels, interface, faults).into_iter().collect()
}

/// A region around a circle in which each doubling of the distance from its centre is one level coarser: cells there are as wide
/// as they are far away, so that far sides cost little.
fn outer(table: &mut Table<'_>, levels: Levels, faults: &mut Faults) -> Option<Vec<LevelBound>> {
    let centre = table.required_pair("centre", "m, as [z, r]", faults);
    let radius = table.required_positive("radius", "m", faults);
    let (centre, radius) = (centre?.value, radius?);
    let coarser = 1..=levels.finest.saturating_sub(levels.roots);
    let ring = |halvings: usize| LevelBound {
        zone: Zone::Beyond { centre, radius: (radius * f64::powi(2.0, halvings as i32 - 1)).min(LARGEST) },
        at_least: levels.roots as u8,
        at_most: (levels.finest - halvings) as u8,
    };
    Some(coarser.map(ring).collect())
}

/// A zone and the levels in it.
fn bound(
    mut table: Table<'_>,
    kind: Option<Given<Kind>>,
    levels: Levels,
    interface: Option<Side>,
    faults: &mut Faults,
) -> Option<LevelBound> {
    let zone = kind.and_then(|kind| zone(&mut table, &kind, interface, faults));
    let at_least = table.whole("at_least", 0..=levels.finest, faults);
    let at_most = table.whole("at_most", 0..=levels.finest, faults);
    if !table.has("at_least") && !table.has("at_most") {
        let help =
            format!("give `at_least = ...`, `at_most = ...` or both, levels from 0 to {}", levels.finest);
        faults.at(&table.path, &table.span, "neither at_least nor at_most is given", help);
    }
    if let (Some(least), Some(most)) = (&at_least, &at_most)
        && least.value > most.value
    {
        let message = format!("at_least = {} is above at_most = {}", least.value, most.value);
        faults.of(least, message, "give at_least the coarser level, or remove one of the two");
    }
    table.finish(faults);
    // There is nothing coarser than the roots.
    let level = |given: Option<usize>, default| given.unwrap_or(default).max(levels.roots) as u8;
    Some(LevelBound {
        zone: zone?,
        at_least: level(at_least.map(|given| given.value), levels.roots),
        at_most: level(at_most.map(|given| given.value), levels.finest),
    })
}

fn kind(table: &mut Table<'_>, faults: &mut Faults) -> Option<Given<Kind>> {
    const KINDS: [(&str, Kind); 4] = [
        ("sphere", Kind::Sphere),
        ("box", Kind::Box),
        ("interface", Kind::Interface),
        ("outer", Kind::Outer),
    ];
    if !table.has("shape") {
        let help = "give `shape = ` one of \"sphere\", \"box\", \"interface\", \"outer\"";
        table.missing("shape", help, faults);
    }
    table.choice("shape", &KINDS, faults)
}

fn zone(
    table: &mut Table<'_>,
    kind: &Given<Kind>,
    interface: Option<Side>,
    faults: &mut Faults,
) -> Option<Zone> {
    match kind.value {
        Kind::Sphere => {
            let centre = table.required_pair("centre", "m, as [z, r]", faults);
            let radius = table.required_positive("radius", "m", faults);
            let inside = table.choice("where", &[("inside", true), ("outside", false)], faults);
            let (centre, radius) = (centre?.value, radius?);
            Some(if inside.is_none_or(|given| given.value) {
                Zone::Within { centre, radius }
            } else {
                Zone::Beyond { centre, radius }
            })
        }
        Kind::Box => {
            let (z, r) = (table.range("z", faults), table.range("r", faults));
            Some(Zone::Box { z: z?.value, r: r?.value })
        }
        Kind::Interface => {
            if interface.is_none() {
                let help = "take shape = \"box\" with the ranges z and r, or couple two media";
                faults.of(kind, "scheme = \"none\" has no interface", help);
            }
            interface.map(Zone::Along)
        }
        Kind::Outer => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_threshold_of_smooth_waves_falls_with_the_square_of_the_cells_width() {
        let of = |cells| default_epsilon(false, Some(cells));
        assert_eq!([10.0, 20.0, 19.999_999_9, 40.0, 80.0].map(of), [4e-6, 1e-6, 1e-6, 2.5e-7, 6.2e-8]);
        assert_eq!([1e-3, 1e9].map(of), [1e-5, 1e-9]);
        assert_eq!(default_epsilon(false, None), EPSILON_IF_SMOOTH);
        assert_eq!(default_epsilon(true, Some(40.0)), EPSILON_WITH_JUMPS);
    }
}
