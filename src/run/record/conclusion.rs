//! What is made of both sides' parts when a run has ended: one history, one summary.

use std::path::Path;

use mesh::Side;
use serde_json::{Map, Value, json};
use solid::Boundary;

use crate::case::{Case, SolidCase};
use crate::output::run_directory::{
    FLUID_HISTORY, FLUID_SUMMARY, HISTORY, SOLID_HISTORY, SOLID_SUMMARY, SUMMARY,
};
use crate::output::{Join, RunDirectory, join_histories, safe_file, summary};
use crate::run::RunError;
use crate::run::checkpoints::Checkpoints;
use crate::run::record::answer::{answer, look_next};
use crate::run::record::how_sure::how_sure;
use crate::run::record::{equivalent_load, two_collapses};

/// Joins the histories and the parts of the summary.
///
/// - `case`: of which the run was; it warns of what is probably not meant.
/// - `failure`: what the run ended with, as far as whoever concludes knows.
pub fn conclude(
    directory: &RunDirectory,
    case: &Case,
    failure: Option<&RunError>,
) -> Result<Map<String, Value>, RunError> {
    let differing = join_histories(directory.path(), &[FLUID_HISTORY, SOLID_HISTORY], Join::Copy)?;
    if !differing.is_empty() {
        tracing::warn!(?differing, "both sides wrote these, and not the same");
    }
    let mut parts = Vec::new();
    for name in [SOLID_SUMMARY, FLUID_SUMMARY] {
        if directory.file(name).exists() {
            parts.push(summary::read(&directory.file(name))?);
        }
    }
    let completed = !parts.is_empty() && parts.iter().all(|part| part["completed"] == json!(true));
    let mut whole = summary::merge(&parts);
    whole.insert("completed".to_owned(), json!(completed));
    whole.extend(failed_by(&parts, failure));
    whole.extend(summary::origin());
    if let Some(seconds) = compute_seconds(&whole) {
        whole.insert("compute_seconds".to_owned(), seconds);
    }
    for (key, share) in
        [("exchange_share", exchange_share(&whole)), ("exchange_wait_share", exchange_wait_share(&whole))]
    {
        if let Some(share) = share {
            whole["coupling"][key] = json!(share);
        }
    }
    let history = directory.file(HISTORY);
    let collapse_time = whole.get("collapse_time").and_then(Value::as_f64);
    whole.extend(two_collapses::summary(&history, collapse_time, case.ambient_pressure()));
    whole.extend(equivalent_load::summary(&history));
    let number = |key: &str| whole.get(key).and_then(Value::as_f64);
    let per_volume = number("work_on_solid").zip(number("pit_volume"));
    let per_volume = per_volume.map(|(work, volume)| json!((volume > 0.0).then_some(work / volume)));
    let radii = number("initial_equivalent_radius").zip(number("min_equivalent_radius"));
    let cells = radii.and_then(|(first, smallest)| case.cells_per_smallest_radius(first, smallest));
    whole.extend(per_volume.map(|work| ("work_per_pit_volume".to_owned(), work)));
    whole.extend(cells.map(|cells| ("cells_per_smallest_radius".to_owned(), json!(cells))));
    let zone = case.solid.as_ref().and_then(|solid| zone_warning(&whole, solid));
    let strain = case.solid.as_ref().and_then(|solid| strain_warning(&whole, solid));
    let warnings: Vec<String> = warnings(&whole).into_iter().chain(zone).chain(strain).collect();
    for warning in &warnings {
        tracing::warn!("{warning}");
    }
    let of_start = case.warnings().into_iter();
    whole.insert("warnings".to_owned(), of_start.chain(warnings).collect());
    put_answer(directory.path(), &mut whole);
    summary::write(directory, SUMMARY, &whole)?;
    if completed {
        Checkpoints::of(case, directory).keep_newest()?;
        directory.remove_progress()?;
    }
    Ok(whole)
}

/// Why a run failed: the cause, where the sides and whoever started them tell of different ends.
///
/// A side that lost the other one says more than nothing, but less than anybody else.
fn failed_by(parts: &[Map<String, Value>], failure: Option<&RunError>) -> Map<String, Value> {
    let of = |part: &Map<String, Value>| {
        let [error, code] = ["error", "exit_code"].map(|key| part.get(key).cloned());
        error.zip(code)
    };
    let stopped = |error: &&RunError| matches!(error, RunError::Interrupted | RunError::Terminated);
    let own = failure
        .filter(|error| !stopped(error))
        .map(|error| (json!(error.to_string()), json!(error.exit_code())));
    let of_sides = || parts.iter().filter_map(of);
    let cause = of_sides().find(|(_, code)| *code != json!(PEER_LOST)).or(own).or_else(|| of_sides().next());
    Map::from_iter(
        cause
            .into_iter()
            .flat_map(|(error, code)| [("error".to_owned(), error), ("exit_code".to_owned(), code)]),
    )
}

/// Makes the answer, from the other keys of a summary and a study beside the run.
fn put_answer(directory: &Path, whole: &mut Map<String, Value>) {
    let completed = whole.get("completed") == Some(&json!(true));
    let study = completed.then(|| how_sure(directory, whole)).flatten();
    let answer = if completed { answer(whole, study.as_deref()) } else { Vec::new() };
    let next = if completed { look_next(whole) } else { None };
    whole.insert("answer".to_owned(), json!(answer));
    whole.insert("look_next".to_owned(), json!(next));
}

/// Makes the answer of a finished run anew, when a study that it belongs to has ended.
///
/// - errors: [`RunError::Output`]: its summary cannot be read or written.
pub fn answer_anew(directory: &Path) -> Result<(), RunError> {
    let path = directory.join(SUMMARY);
    let before = summary::read(&path)?;
    let mut whole = before.clone();
    put_answer(directory, &mut whole);
    if whole != before {
        safe_file::write(&path, summary::text(&path, &whole)?.as_bytes())?;
    }
    Ok(())
}

/// What each side spent computing, as `coupling` has it.
fn compute_seconds(whole: &Map<String, Value>) -> Option<Value> {
    let sides = ["fluid", "solid"].into_iter().filter_map(|side| {
        let seconds = whole.get("coupling")?.get(side)?.get("seconds_computing")?;
        Some((side.to_owned(), seconds.clone()))
    });
    let seconds = Map::from_iter(sides);
    (!seconds.is_empty()).then_some(Value::Object(seconds))
}

/// (wall time − both sides' compute − output) / wall time: what the exchange cost.
///
/// Negative where the sides compute at the same time, see [`exchange_wait_share`].
fn exchange_share(whole: &Map<String, Value>) -> Option<f64> {
    let wall = whole.get("wall_seconds")?.as_f64()?;
    let mut rest = wall;
    for side in ["fluid", "solid"] {
        for key in ["seconds_computing", "seconds_recording", "seconds_checkpointing"] {
            rest -= whole.get("coupling")?.get(side)?.get(key)?.as_f64()?;
        }
    }
    Some(rest / wall)
}

/// What both sides waited for frames that were ready, over the wall time: what the exchange cost, whether the sides take turns or
/// compute at the same time. Never negative.
///
/// From the moment when a frame was complete and its reader asked for it to the moment when the reader had it, added up over the
/// frames both ways. Waits for a processor that the other side is using are in it.
fn exchange_wait_share(whole: &Map<String, Value>) -> Option<f64> {
    let wall = whole.get("wall_seconds")?.as_f64()?;
    let waited = |side: &str| whole.get("coupling")?.get(side)?.get("seconds_exchanging")?.as_f64();
    Some((waited("fluid")? + waited("solid")?) / wall)
}

/// The exit code of a side that lost the other one.
const PEER_LOST: u8 = 4;

/// Share of the collapse's energy above which what the pressure floor added is worth a warning.
const FLOOR_BUDGET: f64 = 0.01;

/// Share of the fluid's cell updates above which those done again at first order are worth a warning.
const REDONE_BUDGET: f64 = 1e-3;

/// Likewise above which gas that had to expand in liquid under tension is.
const EXPANDED_BUDGET: f64 = 1e-3;

/// What of a run's corrections is too much to be passed over.
fn warnings(whole: &Map<String, Value>) -> Vec<String> {
    let share = whole.get("fixups").and_then(|fixups| fixups.get("floor_energy_share")?.as_f64());
    let floor = share.filter(|share| *share > FLOOR_BUDGET).map(|share| {
        format!(
            "the pressure floor added {:.2} % of the energy of the collapse (the pressure far away times the gas's largest volume); \
             more than {:.0} % is too much to trust what follows the collapse: refine, or use model = \"five-equation\" where it is another",
            100.0 * share,
            100.0 * FLOOR_BUDGET
        )
    });
    let number = |path: [&str; 2]| whole.get(path[0])?.get(path[1])?.as_f64();
    let redone = number(["fixups", "redone"]).zip(number(["cell_updates", "fluid"]));
    let redone = redone.map(|(redone, updates)| redone / updates).filter(|share| *share > REDONE_BUDGET).map(|share| {
        format!(
            "{:.2} % of the fluid's cell updates had to be done again at first order; more than {:.1} % says that the \
             solution is not resolved: refine, or take a smaller time.cfl",
            100.0 * share,
            100.0 * REDONE_BUDGET
        )
    });
    let unsettled =
        number(["coupling_iterations", "unsettled_steps"]).filter(|steps| *steps > 0.0).map(|steps| {
            format!(
                "in {steps:.0} steps the iteration of scheme = \"strong\" ended before coupling.tolerance: \
             allow more coupling.max_iterations, or take a smaller time.cfl"
            )
        });
    let expanded = number(["fixups", "expanded_cells"]).zip(number(["cell_updates", "fluid"]));
    let foam = expanded.map(|(cells, updates)| cells / updates).filter(|share| *share > EXPANDED_BUDGET).map(|share| {
        format!(
            "in {:.2} % of the fluid's cell updates gas expanded in liquid under tension (fixups.expanded_cells): traces of gas beside an \
             interface open there into a foam that hangs on the grid; do not trust the gas's volume from then on, nor what comes of it",
            100.0 * share
        )
    });
    floor.into_iter().chain(redone).chain(foam).chain(unsettled).chain(surface_warnings(whole)).collect()
}

/// Depth of a pit over its radius above which strains are no longer small.
const DEEPEST_OF_RADIUS: f64 = 0.05;

/// What has to be said of the solid's surface.
fn surface_warnings(whole: &Map<String, Value>) -> impl Iterator<Item = String> {
    let number = |key: &str| whole.get(key).and_then(Value::as_f64);
    let slope = number("pit_depth").zip(number("pit_radius")).map(|(depth, radius)| depth / radius);
    let deep = slope.filter(|slope| *slope > DEEPEST_OF_RADIUS).map(|slope| {
        format!(
            "the pit is {:.1} % of its radius deep; above {:.0} % strains are no longer small, and the solid's equations are \
             for small ones",
            100.0 * slope,
            100.0 * DEEPEST_OF_RADIUS
        )
    });
    // One that was stopped before has not come so far.
    let is_not_still =
        whole.get("settled") == Some(&json!(false)) && whole.get("completed") == Some(&json!(true));
    let moves = is_not_still.then(|| {
        format!(
            "the surface was not still at time.longest: surface_still = {:.2e} (see docs/reference/output-summary.md); make time.longest later, by cav run --resume DIR --end TIME",
            number("surface_still").unwrap_or(f64::NAN)
        )
    });
    deep.into_iter().chain(moves)
}

/// The share of Young's modulus in a von Mises stress above which elastic strains are no longer small.
const LARGEST_STRAIN: f64 = 0.05;

/// What has to be said of an elastic solid that is soft for what acts on it; of one that yields its pit says so.
fn strain_warning(whole: &Map<String, Value>, solid: &SolidCase) -> Option<String> {
    let stress =
        whole.get("von_mises_peak").and_then(Value::as_f64).filter(|_| solid.plasticity.is_none())?;
    let strain = stress / solid.material.young();
    (strain > LARGEST_STRAIN).then(|| {
        format!(
            "the largest von Mises stress is {:.0} % of Young's modulus; above {:.0} % strains are no longer small, and the solid's equations \
             are for small ones",
            100.0 * strain,
            100.0 * LARGEST_STRAIN
        )
    })
}

/// What has to be said of a plastic zone that reaches the sides of the solid beyond which there is more of it.
fn zone_warning(whole: &Map<String, Value>, solid: &SolidCase) -> Option<String> {
    let number = |key: &str| whole.get(key).and_then(Value::as_f64);
    let ([low, high], [_, far]) = (solid.grid.z, solid.grid.r);
    let reached = [
        ("z_min", Side::ZMin, number("plastic_zone_depth")?, high - low),
        ("r_max", Side::RMax, number("plastic_zone_radius")?, far),
    ];
    let goes_on =
        |side: Side| matches!(solid.boundary[side as usize], Boundary::Absorbing | Boundary::NonReflecting);
    // A zone ends with a cell.
    let (name, ..) =
        reached.into_iter().find(|(_, side, zone, whole)| goes_on(*side) && *zone > 0.999 * whole)?;
    Some(format!(
        "the plastic zone reaches solid.boundary.{name}, which absorbs waves as an elastic solid beyond it does: make the solid larger"
    ))
}

/// What a run says when it has ended: the answer, what is to be distrusted, where it lies.
///
/// - `case`: what it warned of was said at the start.
pub fn closing_words(whole: &Map<String, Value>, case: &Case, directory: &Path) -> String {
    let number = |key: &str| whole.get(key).and_then(Value::as_f64);
    let mut words = vec![format!(
        "done: {} steps in {:.1} s",
        whole.get("steps").and_then(Value::as_u64).unwrap_or(0),
        number("wall_seconds").unwrap_or(f64::NAN)
    )];
    let texts = |key: &str| {
        let list = whole.get(key).and_then(Value::as_array).into_iter().flatten();
        list.filter_map(Value::as_str).map(str::to_owned).collect::<Vec<_>>()
    };
    words.extend(texts("answer"));
    words.extend(whole.get("look_next").and_then(Value::as_str).map(str::to_owned));
    let said = case.warnings();
    let of_end = texts("warnings").into_iter().filter(|warning| !said.contains(warning));
    words.extend(of_end.map(|warning| format!("warning: {warning}")));
    words.push(format!("see {}", directory.display()));
    words.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A side's part, or the whole, of a run that failed.
    fn failed(error: &str, code: u8) -> Map<String, Value> {
        Map::from_iter([("error".to_owned(), json!(error)), ("exit_code".to_owned(), json!(code))])
    }

    #[test]
    fn a_failure_is_told_by_its_cause_and_not_by_what_it_did_to_the_other_side() {
        let child = |what: &str, code| RunError::Child {
            side: "solid",
            pid: 7,
            what: what.to_owned(),
            log: "log",
            code,
        };
        let [lost, bad] = [failed("the solid has gone", 4), failed("density below zero", 3)];
        let fine = Map::new();
        let ended = child("ended with exit code 3", 3);
        for sides in [[lost.clone(), bad.clone()], [bad.clone(), lost.clone()], [fine.clone(), bad.clone()]] {
            assert_eq!(failed_by(&sides, Some(&ended)), bad);
            assert_eq!(failed_by(&sides, None), bad);
        }
        // A process that is killed leaves no part of its own.
        let killed = child("was killed by signal 9", 4);
        assert_eq!(failed_by(std::slice::from_ref(&lost), Some(&killed)), failed(&killed.to_string(), 4));
        assert_eq!(failed_by(std::slice::from_ref(&lost), None), lost);
        // Nothing was made yet.
        let unmet = RunError::NoPeer { side: "fluid" };
        assert_eq!(failed_by(&[], Some(&unmet)), failed(&unmet.to_string(), 2));
        // To be stopped is no failure.
        assert_eq!(failed_by(&[fine.clone(), fine], Some(&RunError::Interrupted)), Map::new());
        assert_eq!(failed_by(&[], Some(&RunError::Terminated)), Map::new());
    }

    #[test]
    fn foam_in_tension_is_warned_of() {
        let told = |cells: u64| {
            let whole =
                json!({ "fixups": { "expanded_cells": cells }, "cell_updates": { "fluid": 1_000_000 } });
            warnings(whole.as_object().expect("an object"))
        };
        assert_eq!(told(100), Vec::<String>::new());
        assert!(told(1900)[0].starts_with("in 0.19 % of the fluid's cell updates"), "{:?}", told(1900));
    }

    #[test]
    fn plastic_zones_that_reach_sides_that_absorb_and_large_elastic_strains_are_warned_of() {
        let solid = |sets: &[&str]| {
            let text = "[time]\nend = 1e-7\n[solid]\nz = [-4e-3, 0.0]\nr = [0.0, 3e-3]\ncells = [64, 48]\nmaterial = \"structural-steel\"\n\
                        [coupling]\nscheme = \"load\"\n[coupling.load]\namplitude = 1e9\nradius = 1e-3\nhistory = [[0.0, 0.0], [1e-8, 1.0]]\n";
            let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
            let case = Case::from_toml(text, "zone", &sets).unwrap_or_else(|errors| panic!("{errors}"));
            case.solid.expect("a solid")
        };
        let told = |solid: &SolidCase, depth: f64, radius: f64| {
            let whole = json!({ "plastic_zone_depth": depth, "plastic_zone_radius": radius });
            zone_warning(whole.as_object().expect("an object"), solid)
        };
        let open = solid(&[]);
        assert_eq!(told(&open, 3.9e-3, 2.9e-3), None);
        for (depth, radius, name) in [(4e-3, 1e-3, "z_min"), (1e-3, 3e-3, "r_max")] {
            assert!(told(&open, depth, radius).is_some_and(|words| words.contains(name)));
        }
        let closed = solid(&["solid.boundary.z_min=\"fixed\"", "solid.boundary.r_max=\"free\""]);
        assert_eq!(told(&closed, 4e-3, 3e-3), None);
        let strained = |stress: f64| {
            let whole = json!({ "von_mises_peak": stress });
            strain_warning(whole.as_object().expect("an object"), &open)
        };
        let young = open.material.young();
        assert_eq!(strained(0.04 * young), None);
        assert!(strained(0.06 * young).is_some_and(|words| words.contains("6 % of Young's modulus")));
    }

    #[test]
    fn what_sides_wait_for_frames_that_are_ready_is_no_less_than_nothing_also_where_they_compute_at_the_same_time()
     {
        let side = json!({
            "seconds_computing": 9.0,
            "seconds_recording": 0.5,
            "seconds_checkpointing": 0.0,
            "seconds_exchanging": 0.1,
        });
        let whole = json!({ "wall_seconds": 10.0, "coupling": { "fluid": side, "solid": side } });
        let whole = whole.as_object().expect("an object");
        assert!(exchange_share(whole).is_some_and(|share| share < -0.8));
        assert!(exchange_wait_share(whole).is_some_and(|share| (share - 0.02).abs() < 1e-15));
    }
}
