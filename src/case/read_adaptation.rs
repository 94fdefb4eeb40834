//! How the grid of a side adapts: `adapt`, `epsilon`, `adapt_every` and `[[....refine]]`.

use mesh::{Adaptation, LevelBound, Side, Zone};

use super::keys::adaptation::DEFAULT_ADAPT_EVERY;
use super::reader::{Faults, Given, LARGEST, Table};

/// The error that adaptation may add where a case says nothing and prescribes no wave: about that of a collapse between grids twice as
/// fine as one another.
pub const DEFAULT_ERROR: f64 = 1e-2;

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

/// What a side's table asks of the thresholds; what it does not, `thresholds` settles.
#[derive(Default)]
pub(super) struct Asked {
    /// The error that adaptation may add.
    pub error: Option<Given<f64>>,
    /// The threshold of all details, or of those of interfaces.
    pub epsilon: Option<Given<f64>>,
    /// That of waves, where it differs.
    pub epsilon_waves: Option<Given<f64>>,
}

impl Asked {
    /// - `has_interfaces`: whether the side knows anything but waves.
    fn read(table: &mut Table<'_>, has_interfaces: bool, faults: &mut Faults) -> Self {
        let mut share = |key: &'static str, help: &str| table.within(key, help, faults);
        let error =
            share("error", "0.01 is the default where no wave is prescribed; a smaller one keeps more cells");
        let epsilon = share(
            "epsilon",
            "by default it follows from `error`, 0.0003 for 0.01; a smaller one keeps more cells",
        );
        let epsilon_waves = if has_interfaces {
            share(
                "epsilon_waves",
                "by default it follows from `error`, 0.0001 for 0.01; a smaller one keeps more cells",
            )
        } else {
            None
        };
        if let Some(error) = &error
            && (epsilon.is_some() || epsilon_waves.is_some())
        {
            let message = "`error` sets the thresholds, and thresholds are given, too";
            faults.of(error, message.to_owned(), "give `error` alone, or `epsilon` and `epsilon_waves`");
        }
        Self { error, epsilon, epsilon_waves }
    }
}

/// How a grid adapts; `None` where all its cells are on the finest level.
///
/// The thresholds are not settled yet: that takes both sides.
///
/// - `has_interfaces`: whether the side knows anything but waves; `interface`: the side that meets the other medium or the rigid wall.
pub(super) fn adaptation(
    table: &mut Table<'_>,
    levels: Levels,
    has_interfaces: bool,
    interface: Option<Side>,
    faults: &mut Faults,
) -> (Option<Adaptation>, Asked) {
    let adapt = table.flag("adapt", faults);
    let asked = Asked::read(table, has_interfaces, faults);
    let every = table.whole("adapt_every", faults);
    let bounds: Vec<LevelBound> = (table.tables("refine", faults).into_iter())
        .flat_map(|table| bounds(table, levels, interface, faults))
        .collect();
    let adaptation = (adapt && levels.roots < levels.finest).then(|| Adaptation {
        bounds,
        ..Adaptation::by_details(DEFAULT_ERROR, every.map_or(DEFAULT_ADAPT_EVERY, |given| given.value) as u32)
    });
    (adaptation, asked)
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
    let centre = table.required_pair("centre", faults);
    let radius = table.required_positive("radius", faults);
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
    let [at_least, at_most] = ["at_least", "at_most"].map(|key| {
        let given = table.whole(key, faults)?;
        if given.value > levels.finest {
            let message = format!("must be from 0 to {}, got {}", levels.finest, given.value);
            faults.of(
                &given,
                message,
                "that is as far as `levels` goes: raise it, or take a coarser level here",
            );
        }
        Some(given)
    });
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
            let centre = table.required_pair("centre", faults);
            let radius = table.required_positive("radius", faults);
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
