//! A listing for people.

use std::collections::BTreeMap;

use crate::output::RunState;
use crate::output::progress::engineering;
use crate::runs::flat::Scalar;
use crate::runs::listing::{Entry, Listing};

/// Between two columns.
const GAP: usize = 2;

/// Columns that no width takes away, and that are shown even if all runs have the same there.
const ALWAYS: [&str; 2] = ["path", "state"];

/// Heading in two lines, cells, width with the gap behind it.
type Column = ([String; 2], Vec<String>, usize);

impl Listing {
    /// A line for each run, with what all have in common told once, and how many there are.
    ///
    /// - `columns`: the most wanted first; `width`: of the terminal, into which as many of them are put as it holds; `are_chosen`: all of
    ///   them are wanted, however wide.
    #[must_use]
    pub fn table(&self, columns: &[String], width: Option<usize>, are_chosen: bool) -> String {
        if self.entries.is_empty() {
            return self.ending(&[]);
        }
        let cells = |key: &String| -> Vec<String> {
            self.entries.iter().map(|entry| self.cell(entry, key)).collect()
        };
        let headings = headings(columns);
        let (mut shown, mut left_out, mut common, mut taken) = (Vec::new(), Vec::new(), Vec::new(), 0);
        for (key, heading) in columns.iter().zip(headings.iter().map(|heading| in_two(heading))) {
            let cells = cells(key);
            let is_always = are_chosen || ALWAYS.contains(&&**key);
            if !is_always && cells.len() > 1 && cells.iter().all(|cell| *cell == cells[0]) {
                let told = if cells[0].is_empty() { "unknown" } else { &cells[0] };
                common.push(format!("{key} {}", shortened(told)));
                continue;
            }
            let cells: Vec<String> = cells.iter().map(|cell| shortened(cell)).collect();
            let own = cells.iter().chain(&heading).map(|cell| cell.chars().count()).max().unwrap_or(0) + GAP;
            // Once one has no room, narrower ones behind it do not jump the queue.
            let has_room = width.is_none_or(|width| taken + own <= width + GAP) && left_out.is_empty();
            if is_always || has_room {
                taken += own;
                shown.push((heading, cells, own));
            } else {
                left_out.push(key.as_str());
            }
        }
        let shown_in_two = shown.iter().any(|(heading, _, _)| !heading[0].is_empty());
        let mut text = String::new();
        let mut line = |of: &dyn Fn(&Column) -> String| {
            let parts: Vec<String> = shown
                .iter()
                .map(|column| {
                    let cell = of(column);
                    let pad = " ".repeat(column.2.saturating_sub(cell.chars().count()));
                    cell + &pad
                })
                .collect();
            text += parts.concat().trim_end();
            text.push('\n');
        };
        for row in 0..2 {
            // Where no heading needs two lines one is enough.
            if row == 1 || shown_in_two {
                line(&|(heading, _, _)| heading[row].clone());
            }
        }
        (0..self.entries.len()).for_each(|row| line(&|(_, cells, _)| cells[row].clone()));
        if !common.is_empty() {
            text += &format!("In all of them: {}.\n", common.join(", "));
        }
        text + &self.ending(&left_out)
    }

    /// How many runs there are of each state, what has no room, what helps.
    fn ending(&self, left_out: &[&str]) -> String {
        let mut states: BTreeMap<RunState, usize> = BTreeMap::new();
        self.entries.iter().for_each(|entry| *states.entry(entry.state).or_default() += 1);
        let states: Vec<String> =
            states.iter().map(|(state, count)| format!("{count} {}", state.name())).collect();
        let of_all = match (self.entries.len(), self.count) {
            (_, 0) => format!("There are no runs in {}", self.folder.display()),
            (0, all) => format!("None of the {all} runs in {} is like that", self.folder.display()),
            (shown, all) if shown == all => format!("{all} {}: {}", runs(all), states.join(", ")),
            (shown, all) => format!("{shown} of {all} {}: {}", runs(all), states.join(", ")),
        };
        let mut text = format!("{of_all}.\n");
        if !left_out.is_empty() {
            text +=
                &format!("No room for: {}; --columns, --csv and --json have them.\n", left_out.join(", "));
        }
        if self.entries.iter().any(|entry| entry.state == RunState::Interrupted) {
            text += "Go on with one that was interrupted: cav run --resume DIR\n";
        }
        text
    }

    /// A value as people read it.
    fn cell(&self, entry: &Entry, key: &str) -> String {
        if key == "answer" {
            return self.answer(entry).join(" ");
        }
        let value = self.value(entry, key);
        match (key, value) {
            ("state", _) => match (entry.state, entry.progress) {
                (RunState::Running | RunState::Interrupted, Some(share)) => {
                    format!("{} {:.0} %", entry.state.name(), 100.0 * share)
                }
                _ => entry.state.name().to_owned(),
            },
            // To the minute, in Greenwich.
            ("started", Some(Scalar::Text(when))) => when.replace('T', " ").chars().take(16).collect(),
            (_, Some(value @ (Scalar::Float(_) | Scalar::Integer(_)))) => {
                match (self.unit_of(entry, key), value.number()) {
                    ("1", Some(share)) => format!("{:.3} %", 100.0 * share),
                    (unit @ ("Pa" | "Pa s" | "m" | "s" | "m/s" | "J" | "J/m"), Some(number)) => {
                        engineering(number, unit)
                    }
                    _ => rounded(&value),
                }
            }
            (_, value) => value.map_or_else(String::new, |value| value.to_string()),
        }
    }
}

fn runs(count: usize) -> &'static str {
    if count == 1 { "run" } else { "runs" }
}

/// Longer lists are cut in a table for people.
const LONGEST_LIST: usize = 40;

/// A cell, of a long list its beginning: a table of an inflow has thousands of characters. Sentences stay whole.
fn shortened(cell: &str) -> String {
    if cell.starts_with(['[', '{']) && cell.chars().count() > LONGEST_LIST {
        cell.chars().take(LONGEST_LIST - 1).chain(['…']).collect()
    } else {
        cell.to_owned()
    }
}

/// A number to six figures: what a case says is seldom longer, what is computed seldom more certain.
fn rounded(value: &Scalar) -> String {
    match value {
        Scalar::Float(number) => {
            let short: f64 = format!("{number:.5e}").parse().unwrap_or(*number);
            Scalar::Float(short).to_string()
        }
        other => other.to_string(),
    }
}

/// The last part of each key; more of it where two would be the same.
fn headings(columns: &[String]) -> Vec<String> {
    let ends = |key: &str, parts: usize| -> String {
        let all: Vec<&str> = key.split('.').collect();
        all[all.len().saturating_sub(parts)..].join(".")
    };
    let heading = |key: &String| -> String {
        let words = key.split('.').count();
        // The number of a part of a list says nothing without its name.
        let least = 1 + usize::from(
            key.rsplit('.').next().is_some_and(|end| end.parse::<u32>().is_ok() || end == "name"),
        );
        let is_clear = |parts: &usize| {
            columns.iter().filter(|other| ends(other, *parts) == ends(key, *parts)).count() == 1
        };
        ends(key, (least..words).find(is_clear).unwrap_or(words))
    };
    columns
        .iter()
        .map(|key| if key == "started" { "started (UTC)".to_owned() } else { heading(key) })
        .collect()
}

/// Longer headings take two lines.
const LONGEST_HEADING: usize = 10;

/// A heading in two lines of about one length, broken behind what joins its words; the first is empty of a short one.
fn in_two(heading: &str) -> [String; 2] {
    let breaks = heading.match_indices(['_', '.', ' ']).map(|(at, _)| at + 1);
    let wider = |at: &usize| heading[..*at].chars().count().max(heading[*at..].chars().count());
    let best = if heading.len() > LONGEST_HEADING { breaks.min_by_key(wider) } else { None };
    let (first, second) = heading.split_at(best.unwrap_or(0));
    [first, second].map(|line| line.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_are_short_and_tell_columns_apart() {
        let keys = [
            "path",
            "fluid.levels",
            "solid.levels",
            "fluid.region.0.radius",
            "fluid.region.0.centre.0",
            "solid.material.name",
        ];
        let expected = ["path", "fluid.levels", "solid.levels", "radius", "centre.0", "material.name"];
        assert_eq!(headings(&keys.map(str::to_owned)), expected);
    }

    #[test]
    fn long_headings_take_two_lines() {
        for (heading, lines) in [
            ("wall_pressure_peak", ["wall_", "pressure_peak"]),
            ("min_equivalent_radius", ["min_equivalent_", "radius"]),
            ("fluid.levels", ["fluid.", "levels"]),
            ("started (UTC)", ["started", "(UTC)"]),
            ("radius", ["", "radius"]),
            ("verylongwithoutend", ["", "verylongwithoutend"]),
        ] {
            assert_eq!(in_two(heading), lines);
        }
    }

    #[test]
    fn long_lists_are_cut_and_sentences_are_not() {
        let list = format!("[[0.0,1e5]{}]", ",[1e-6,µ]".repeat(500));
        let cut = shortened(&list);
        assert_eq!(cut.chars().count(), 40);
        assert!(cut.starts_with("[[0.0,1e5],[1e-6,") && cut.ends_with('…'), "{cut}");
        for whole in ["[1.0,2.0,3.0,4.0]".to_owned(), "The wall is hit. ".repeat(20), String::new()] {
            assert_eq!(shortened(&whole), whole);
        }
    }

    #[test]
    fn numbers_of_cases_are_rounded_to_six_figures() {
        for (number, text) in
            [(0.010000000000000002, "0.01"), (123456.78, "123457"), (5e7, "5e7"), (1.0 / 3.0, "0.333333")]
        {
            assert_eq!(rounded(&Scalar::Float(number)), text);
        }
    }
}
