//! The state of a run after a step, as a side's process tells it to the launcher.

use serde::{Deserialize, Serialize};

/// The state of a run after a step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ProgressLine {
    /// Simulated time in s.
    pub time: f64,
    /// Steps done.
    pub step: u64,
    /// Length of the last step in s.
    pub dt: f64,
    /// The side that limits the step.
    pub limited_by: String,
    /// Cells of both sides.
    pub cells: u64,
    /// Of these the solid's.
    pub solid_cells: u64,
    /// Wall time since the start in s.
    pub wall: f64,
}

#[derive(Serialize, Deserialize)]
struct Tagged {
    progress: ProgressLine,
}

impl ProgressLine {
    /// As one line of JSON, without line end: what a side's process tells the launcher.
    pub fn to_json(&self) -> String {
        serde_json::to_string(&Tagged { progress: self.clone() }).expect("numbers and a text can be written")
    }

    /// From a line made by [`to_json`](Self::to_json); `None` for any other line.
    pub fn from_json(line: &str) -> Option<Self> {
        serde_json::from_str::<Tagged>(line).ok().map(|tagged| tagged.progress)
    }
}

#[cfg(test)]
impl ProgressLine {
    /// One for tests.
    pub(super) fn example() -> Self {
        Self {
            time: 1.25e-5,
            step: 340,
            dt: 3.1e-8,
            limited_by: "fluid".to_owned(),
            cells: 131_072,
            solid_cells: 65_536,
            wall: 10.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_survives_the_way_through_json_and_other_lines_are_no_progress() {
        let line = ProgressLine::example();
        let text = line.to_json();
        assert!(!text.contains('\n'));
        assert_eq!(ProgressLine::from_json(&text), Some(line));
        assert_eq!(ProgressLine::from_json("{\"time\": 1.0}"), None);
        assert_eq!(ProgressLine::from_json("step 3"), None);
    }
}
