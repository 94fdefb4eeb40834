//! The answer in words: what hit the wall, what yields, how deep, how sure; and where to look next.

use serde_json::{Map, Value};

use crate::case::format;

/// Above this `surface_still` the depth of the surface is none of a pit.
const ALMOST_STILL: f64 = 0.1;
/// By how much more the wall gets elsewhere than on the axis before that is worth a sentence.
const ELSEWHERE: f64 = 1.05;

/// A peak on the wall of so many times its mean over a while says more of the grid than of the load. Those of jets that land in a point
/// are 3 to 4 times as high, and grow by a tenth to a factor of 2 on a grid twice as fine (`docs/verification/near-wall.md`).
const MOMENTARY: f64 = 1.5;

/// The sentences that `summary.json` keeps as `answer`, from its other keys.
///
/// - `study`: what a study of grid convergence says of the run's numbers, if there is one.
pub fn answer(whole: &Map<String, Value>, study: Option<&str>) -> Vec<String> {
    let summary = Summary(whole);
    let sentences =
        [bubble(summary), wall(summary), elsewhere(summary), solid(summary), sure(summary, study)];
    sentences.into_iter().flatten().collect()
}

/// The sentence that `summary.json` keeps as `look_next`.
pub fn look_next(whole: &Map<String, Value>) -> Option<String> {
    let cells = whole.get("cells")?.as_object()?;
    let files: Vec<String> = ["fluid", "solid"]
        .iter()
        .filter(|side| cells.contains_key(**side))
        .map(|side| format!("{side}.vtkhdf"))
        .collect();
    Some(format!(
        "Look next: pycav report makes a page of it; {} {} the fields, history.h5 the curves.",
        files.join(" and "),
        if files.len() == 1 { "holds" } else { "hold" }
    ))
}

#[derive(Clone, Copy)]
struct Summary<'a>(&'a Map<String, Value>);

impl Summary<'_> {
    fn number(self, key: &str) -> Option<f64> {
        self.0.get(key).and_then(Value::as_f64)
    }

    /// A number with its unit, if it is there.
    fn said(self, key: &str, unit: &str) -> Option<String> {
        self.number(key).map(|value| si(value, unit))
    }
}

/// With three digits, which is more than a run is worth.
fn si(value: f64, unit: &str) -> String {
    format::si(format!("{value:.2e}").parse().unwrap_or(value), unit)
}

/// A plastic strain of a stress that only round-off has lifted above its bound.
const ROUND_OFF: f64 = 1e-12;

/// A share with as many digits as it is worth.
pub fn percent(share: f64) -> String {
    if share > 0.0 && share < 1e-5 {
        return format!("{:.0e} %", 100.0 * share);
    }
    let digits = if share < 0.001 {
        3
    } else if share < 0.1 {
        1
    } else {
        0
    };
    format!("{:.digits$} %", 100.0 * share)
}

/// How many bubbles there are, if there are several.
fn several(summary: Summary<'_>) -> Option<u64> {
    summary.0.get("bubbles").and_then(Value::as_u64).filter(|count| *count > 1)
}

fn bubble(summary: Summary<'_>) -> Option<String> {
    let first = summary.number("initial_equivalent_radius")?;
    let what = match several(summary) {
        Some(count) => format!("All gas of {count} bubbles"),
        None => "The bubble".to_owned(),
    };
    let Some((smallest, time)) = summary.number("min_equivalent_radius").zip(summary.number("collapse_time"))
    else {
        // Without a ball of gas at the start there is none that could collapse: a drop in air, say.
        summary.number("cells_per_radius")?;
        let last = summary.said("final_equivalent_radius", "m")?;
        return Some(format!(
            "{what}, of {} at the start, has no collapse within the run; it ends with {last}.",
            si(first, "m")
        ));
    };
    // Of a bubble that grows first, the largest radius is what its collapse starts from.
    let largest = summary.number("growth_time").zip(summary.number("max_equivalent_radius"));
    let (grows, from, whole) = match largest {
        Some((grown, largest)) => {
            (format!("{what} grows to {} at {}. It", si(largest, "m"), si(grown, "s")), largest, "largest")
        }
        None => (what, first, "first"),
    };
    let mut words = format!(
        "{grows} is smallest at {}: {}, {} of its {whole} radius.",
        si(time, "s"),
        si(smallest, "m"),
        percent(smallest / from)
    );
    if let Some(jet) = summary.number("jet_velocity_peak").filter(|jet| *jet > 0.0) {
        let to = if summary.number("wall_pressure_peak").is_some() { "the wall" } else { "z_min" };
        words += &format!(" On the axis liquid runs towards {to} with up to {}.", si(jet, "m/s"));
    }
    Some(words)
}

/// The largest pressure on the wall, at the axis, and its time.
///
/// Of the wall's first cell or of its face: where a jet lands, the face's pressure is the larger one, and that is what is averaged.
pub fn peak_on_the_wall(summary: &Map<String, Value>) -> Option<[f64; 2]> {
    let summary = Summary(summary);
    let of = |key: &str| Some([summary.number(key)?, summary.number(&format!("{key}_time"))?]);
    let cell = of("wall_pressure_peak")?;
    Some(of("wall_pressure_peak_interface").filter(|face| face[0] > cell[0]).unwrap_or(cell))
}

fn wall(summary: Summary<'_>) -> Option<String> {
    let [peak, time] = peak_on_the_wall(summary.0)?;
    let peak = si(peak, "Pa");
    let since = summary.number("collapse_time").map(|collapse| time - collapse);
    let when = match since {
        Some(since) if since > 0.0 => format!(", {} after that", si(since, "s")),
        Some(since) => format!(", {} before that", si(-since, "s")),
        None => String::new(),
    };
    let mut words = format!("The wall is hit with {peak} on the axis at {}{when}", si(time, "s"));
    if let Some((mean, over)) =
        summary.said("wall_pressure_mean_peak", "Pa").zip(summary.said("wall_pressure_mean_time", "s"))
    {
        words += &format!("; averaged over {over} it is {mean}");
    }
    words.push('.');
    if let Some(impulse) = summary.number("load_impulse").filter(|impulse| *impulse > 0.0) {
        words += &format!(" The impulse beyond the pressure far away is {}.", si(impulse, "Pa s"));
    }
    Some(words)
}

fn elsewhere(summary: Summary<'_>) -> Option<String> {
    let [axis, _] = peak_on_the_wall(summary.0)?;
    let anywhere = summary.number("wall_pressure_peak_anywhere")?;
    let time = summary.said("wall_pressure_peak_anywhere_time", "s")?;
    (anywhere > ELSEWHERE * axis)
        .then(|| format!("Elsewhere on the wall it is {} at {time}.", si(anywhere, "Pa")))
}

fn solid(summary: Summary<'_>) -> Option<String> {
    let stress = summary.number("von_mises_peak")?;
    let (said, time) = (si(stress, "Pa"), summary.said("von_mises_peak_time", "s")?);
    if let Some(strain) = summary.number("plastic_strain_peak").filter(|strain| *strain > ROUND_OFF) {
        // A strain below that of the zone's bound has no zone.
        let deep = summary.number("plastic_zone_depth").filter(|deep| *deep > 0.0);
        let deep = deep.map_or(String::new(), |deep| format!(", down to {}", si(deep, "m")));
        let yields = match summary.number("plastic_work") {
            Some(work) if work <= 0.0 => "The solid yields no further than it had before",
            _ => "The solid yields",
        };
        return Some(format!("{yields}{deep}: plastic strain up to {}. {}", percent(strain), pit(summary)));
    }
    let Some(strength) = summary.number("yield_strength") else {
        return Some(format!("The largest von Mises stress in the solid is {said} at {time}."));
    };
    let limit = si(strength, "Pa");
    if stress < strength || summary.0.contains_key("plastic_strain_peak") {
        return Some(format!(
            "The solid stays elastic: the largest von Mises stress, {said} at {time}, is {} of its yield strength {limit}.",
            percent(stress / strength)
        ));
    }
    Some(format!(
        "The solid would yield: the largest von Mises stress, {said} at {time}, is {:.2} times its yield strength {limit}; \
         [solid.plasticity] lets it.",
        stress / strength
    ))
}

/// The pit that stays, once the surface is still.
fn pit(summary: Summary<'_>) -> String {
    let still = summary.number("surface_still").is_some_and(|still| still <= ALMOST_STILL);
    let waits = summary.0.contains_key("settled");
    match summary.said("pit_depth", "m").zip(summary.said("pit_radius", "m")) {
        _ if !still && summary.0.get("settled") != Some(&Value::Bool(true)) => {
            let key = if waits { "time.longest" } else { "time.end" };
            format!(
                "The surface still moves at the end, so no pit is given: make {key} later, by cav run --resume DIR --end TIME."
            )
        }
        Some((depth, radius)) => format!("A pit stays, {depth} deep and {radius} in radius at half of that."),
        None => match summary.said("pit_floor", "m") {
            Some(floor) => format!("No pit deeper than {floor} stays, and no shallower one could be told."),
            None => "No pit stays that could be told.".to_owned(),
        },
    }
}

/// What is to be said of a peak on the wall that is over at once.
fn momentary(summary: Summary<'_>) -> Option<String> {
    let [peak, _] = peak_on_the_wall(summary.0)?;
    let mean = summary.number("wall_pressure_mean_peak").filter(|mean| *mean > 0.0)?;
    (peak > MOMENTARY * mean).then(|| {
        let times = peak / mean;
        format!("a peak on the wall {times:.1} times its mean, which grows with the resolution (quote the mean, or the impulse)")
    })
}

/// Fewer cells than this across a film of liquid do not resolve it.
const RESOLVED_FILM: f64 = 4.0;

/// How many cells there are along the bubble's radius, at first and at its smallest, and in a film that is too thin for them.
fn cells(summary: Summary<'_>) -> Option<String> {
    let count = |cells: f64| if cells < 9.5 { format!("{cells:.1}") } else { format!("{cells:.0}") };
    let cells = summary.number("cells_per_radius")?;
    let mut words = format!("{} cells per radius", count(cells));
    if let Some(smallest) = summary.number("cells_per_smallest_radius") {
        words += &format!(", {} where it is smallest", count(smallest));
    }
    if let Some(film) = summary.number("film_cells_min").filter(|film| *film < RESOLVED_FILM) {
        words += &format!(", {} across the film of liquid at the wall", count(film));
    }
    Some(words)
}

fn sure(summary: Summary<'_>, study: Option<&str>) -> Option<String> {
    let cells = cells(summary);
    let warnings = summary.0.get("warnings").and_then(Value::as_array).map_or(0, Vec::len);
    let peak = momentary(summary);
    let held = match warnings {
        0 => peak.is_none().then(|| "no warning".to_owned()),
        1 => Some("one warning".to_owned()),
        more => Some(format!("{more} warnings")),
    };
    let words = [cells, held, peak].into_iter().flatten().collect::<Vec<_>>().join(", ");
    Some(match study {
        Some(study) => format!("How sure: {words}. {study}"),
        None => {
            format!("How sure: {words}; cav run CASE --refine 3 says how far these numbers are converged.")
        }
    })
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn told(summary: &Value) -> String {
        answer(summary.as_object().expect("an object"), None).join("\n")
    }

    #[test]
    fn an_answer_says_what_hit_the_wall_and_what_stays() {
        let mut summary = json!({
            "initial_equivalent_radius": 1e-3, "min_equivalent_radius": 7.8e-5, "collapse_time": 7.82e-6,
            "jet_velocity_peak": 1791.0, "wall_pressure_peak": 4.46e8, "wall_pressure_peak_time": 8.268e-6,
            "wall_pressure_peak_anywhere": 4.5e8, "wall_pressure_peak_anywhere_time": 8.3e-6,
            "wall_pressure_mean_peak": 4.18e8, "wall_pressure_mean_time": 8.3e-8, "load_impulse": 695.8,
            "von_mises_peak": 7.9e7, "von_mises_peak_time": 8.4e-6, "yield_strength": 3.4e7,
            "plastic_strain_peak": 0.01166, "plastic_zone_depth": 1.9e-3, "pit_depth": 1.193e-5, "pit_radius": 7.443e-4,
            "surface_still": 0.0127, "cells_per_radius": 40.0, "cells_per_smallest_radius": 3.12, "warnings": [], "cells": {"fluid": {}, "solid": {}},
        });
        let text = told(&summary);
        for words in [
            "smallest at 7.82 µs: 78 µm, 7.8 % of its first radius",
            "1.79 km/s",
            "446 MPa on the axis at 8.27 µs, 448 ns after",
            "averaged over 83 ns it is 418 MPa",
            "pressure far away is 696 Pa s",
            "yields, down to 1.9 mm: plastic strain up to 1.2 %",
            "A pit stays, 11.9 µm deep and 744 µm in radius",
            "How sure: 40 cells per radius, 3.1 where it is smallest, no warning; cav run",
        ] {
            assert!(text.contains(words), "{words}\n{text}");
        }
        assert!(!text.contains("Elsewhere") && !text.contains("Look next"), "{text}");
        for (face, said) in [
            (4.44e8, "hit with 446 MPa on the axis at 8.27"),
            (4.5e8, "hit with 450 MPa on the axis at 8.25"),
        ] {
            summary["wall_pressure_peak_interface"] = json!(face);
            summary["wall_pressure_peak_interface_time"] = json!(8.25e-6);
            assert!(told(&summary).contains(said), "{face}");
        }
        summary["bubbles"] = json!(2);
        summary.as_object_mut().expect("an object").remove("cells_per_smallest_radius");
        let both = told(&summary);
        assert!(
            both.contains("All gas of 2 bubbles is smallest")
                && both.contains("40 cells per radius, no warning"),
            "{both}"
        );
        summary["bubbles"] = json!(1);
        summary["cells_per_smallest_radius"] = json!(3.12);
        summary["wall_pressure_peak_interface"] = json!(9.2e8);
        summary["wall_pressure_peak_anywhere"] = json!(9e8);
        assert!(!told(&summary).contains("Elsewhere"), "it is less than on the axis");
        let words = "3.1 where it is smallest, a peak on the wall 2.2 times its mean, which grows with the resolution";
        assert!(told(&summary).contains(words), "{}", told(&summary));
        summary["wall_pressure_peak_interface"] = json!(4.44e8);
        let whole = summary.as_object().expect("an object");
        assert!(
            look_next(whole)
                .is_some_and(|next| next.contains("fluid.vtkhdf and solid.vtkhdf hold the fields"))
        );
        let alone = json!({"cells": {"solid": 1}});
        let next = alone.as_object().and_then(look_next);
        assert!(next.is_some_and(|next| next.contains("; solid.vtkhdf holds the fields")));
        assert!(text.contains("cav run CASE --refine 3"));
        let text = answer(whole, Some("By a study: all of it.")).join("\n");
        assert!(text.contains("no warning. By a study: all of it.") && !text.contains("--refine"), "{text}");
        summary["growth_time"] = json!(1e-6);
        summary["max_equivalent_radius"] = json!(1.56e-3);
        let grown = told(&summary);
        assert!(grown.contains("runs towards the wall with up to 1.79 km/s"), "{grown}");
        let mut free = summary.clone();
        free["wall_pressure_peak"] = Value::Null;
        assert!(told(&free).contains("runs towards z_min with up to 1.79 km/s"), "{}", told(&free));
        let words = "The bubble grows to 1.56 mm at 1 µs. It is smallest at 7.82 µs: 78 µm, 5.0 % of its largest radius.";
        assert!(grown.contains(words), "{grown}");
        summary["surface_still"] = json!(0.3);
        summary["wall_pressure_peak_anywhere"] = json!(6e8);
        summary["warnings"] = json!(["one"]);
        let text = told(&summary);
        for words in ["no pit is given", "Elsewhere on the wall it is 600 MPa at 8.3 µs", "one warning"] {
            assert!(text.contains(words), "{words}\n{text}");
        }
    }

    #[test]
    fn a_solid_stays_elastic_or_would_yield() {
        let mut summary = json!({"von_mises_peak": 6.114e7, "von_mises_peak_time": 3.6e-5, "yield_strength": 2.861e8,
            "plastic_strain_peak": 0.0, "cells": {"solid": {}}});
        assert!(
            told(&summary)
                .contains("stays elastic: the largest von Mises stress, 61.1 MPa at 36 µs, is 21 % of")
        );
        // The same law lets a stress rise above its first yield strength only by yielding; without a law nothing does.
        summary.as_object_mut().expect("an object").remove("plastic_strain_peak");
        summary["von_mises_peak"] = json!(5.722e8);
        assert!(
            told(&summary)
                .contains("would yield: the largest von Mises stress, 572 MPa at 36 µs, is 2.00 times")
        );
        summary.as_object_mut().expect("an object").remove("yield_strength");
        assert!(told(&summary).contains("The largest von Mises stress in the solid is 572 MPa"));
        assert!(!told(&summary).contains("wall"), "no fluid, no wall pressure");
    }

    #[test]
    fn a_bubble_that_does_not_collapse_is_said_not_to() {
        let mut summary = json!({"initial_equivalent_radius": 1e-3, "final_equivalent_radius": 8e-4, "min_equivalent_radius": null,
            "collapse_time": null, "cells_per_radius": 20.0, "cells": {"fluid": {}}});
        assert!(told(&summary).contains(
            "The bubble, of 1 mm at the start, has no collapse within the run; it ends with 800 µm."
        ));
        // The air about a drop is no bubble.
        summary.as_object_mut().expect("an object").remove("cells_per_radius");
        assert!(!told(&summary).contains("bubble"), "{}", told(&summary));
    }
}
