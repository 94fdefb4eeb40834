//! What there is to see of a run.

use std::path::PathBuf;

use crate::output::RunState;
use crate::output::progress_file::Standing;
use crate::watch::curve::Curve;

/// A run as it was when it was last looked at.
#[derive(Debug, Clone, PartialEq)]
pub struct Seen {
    /// Its directory.
    pub directory: PathBuf,
    /// Its number and that of the grids, if it is one of a study's.
    pub grid: Option<[usize; 2]>,
    /// What has become of it.
    pub state: RunState,
    /// Where it stands; of a run that does not say so what its histories and its summary know, 0 for what they do not.
    pub standing: Option<Standing>,
    /// What is drawn, from the top.
    pub curves: Vec<Titled>,
    /// Simulated time at which it ends at the latest, if that is known; s.
    pub end: Option<f64>,
    /// Why it failed.
    pub error: Option<String>,
    /// What it found, in sentences.
    pub answer: Vec<String>,
    /// Whether there is a checkpoint to go on from.
    pub can_go_on: bool,
    /// Why it could not be looked at as a whole.
    pub trouble: Option<String>,
}

/// A curve with what it shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Titled {
    /// What it is.
    pub title: &'static str,
    /// Unit of its values.
    pub unit: &'static str,
    /// Which of its values is worth a word: the smallest, or else the largest.
    pub is_least_wanted: bool,
    /// The curve.
    pub curve: Curve,
    /// Time and value of the extreme that the run's end tells of.
    pub peak: Option<[f64; 2]>,
}

impl Titled {
    /// The value worth a word, what it is called, and when it was.
    #[must_use]
    pub fn extreme(&self) -> Option<(&'static str, [f64; 2])> {
        if self.is_least_wanted {
            // Of a bubble that grows first the curve is least at its start.
            self.peak.or(self.curve.least()).map(|point| ("smallest", point))
        } else {
            let largest = self.curve.largest();
            let of_end = self.peak.filter(|[_, peak]| largest.is_none_or(|[_, value]| *peak > value));
            of_end.or(largest).map(|point| ("largest", point))
        }
    }
}

impl Seen {
    /// The directory's name, with the grid's number if it is one of several.
    #[must_use]
    pub fn name(&self) -> String {
        let directory = self.directory.display();
        match self.grid {
            Some([number, count]) => {
                format!("{directory} (grid {number} of 0 to {})", count.saturating_sub(1))
            }
            None => directory.to_string(),
        }
    }

    /// Simulated time at which it ends or has ended, if that is known, s: what waits for a still surface may be finished long before
    /// the latest time.
    #[must_use]
    pub fn ends(&self) -> Option<f64> {
        let reached = self.standing.as_ref().map(|standing| standing.line.time);
        reached.filter(|_| self.state == RunState::Finished).or(self.end)
    }

    /// What can be done about a run that has not reached its end.
    #[must_use]
    pub fn remedy(&self) -> Option<String> {
        let is_over = matches!(self.state, RunState::Failed | RunState::Interrupted);
        (is_over && self.can_go_on)
            .then(|| format!("go on with: cav run --resume {}", self.directory.display()))
    }

    /// Where it stands, as parts of a line.
    #[must_use]
    pub fn facts(&self) -> Vec<String> {
        use crate::output::progress::engineering;
        let Some(Standing { line, left, .. }) = &self.standing else {
            return vec!["no step is in the files yet".to_owned()];
        };
        let time = engineering(line.time, "s");
        let time = match self.ends() {
            Some(end) if end > 0.0 => {
                format!(
                    "t = {time} of {} ({:.0} %)",
                    engineering(end, "s"),
                    100.0 * (line.time / end).min(1.0)
                )
            }
            _ => format!("t = {time}"),
        };
        let by = if line.limited_by.is_empty() { String::new() } else { format!(" ({})", line.limited_by) };
        let mut facts =
            vec![time, format!("step {}", line.step), format!("Δt = {}{by}", engineering(line.dt, "s"))];
        if line.cells > 0 {
            let fluid = line.cells.saturating_sub(line.solid_cells);
            let cells =
                [("fluid", fluid), ("solid", line.solid_cells)].into_iter().filter(|(_, cells)| *cells > 0);
            let cells: Vec<String> = cells.map(|(side, cells)| format!("{side} {cells}")).collect();
            facts.push(format!("cells: {}", cells.join(", ")));
        }
        match (self.state, left) {
            (RunState::Running, Some(left)) => {
                let left = std::time::Duration::from_secs(left.clamp(0.0, 1e15).round() as u64);
                facts.push(format!("{} left", humantime::format_duration(left)));
            }
            (RunState::Running, None) => facts.push("time left not known yet".to_owned()),
            _ if line.wall > 0.0 => facts.push(format!("took {:.1} s", line.wall)),
            _ => {}
        }
        facts
    }
}
