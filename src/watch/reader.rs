//! Looks at the directory of a run, again and again.

use std::path::{Path, PathBuf};

use serde_json::{Map, Value};

use crate::output::progress_file::Standing;
use crate::output::progress_line::ProgressLine;
use crate::output::run_directory::{CASE, FLUID_HISTORY, SOLID_HISTORY};
use crate::output::run_state::{has_checkpoints, summary_of};
use crate::output::{OutputError, RunState};
use crate::run::record::answer::peak_on_the_wall;
use crate::watch::grids::run_in;
use crate::watch::seen::{Seen, Titled};
use crate::watch::series::Series;

const RADIUS: &str = "/bubble/equivalent_radius";
const PRESSURE: &str = "/wall/pressure_axis";
const VON_MISES: &str = "/solid/von_mises_max";
const PLASTIC: &str = "/solid/plastic_strain_max";

/// Looks at a run.
#[derive(Debug)]
pub struct Reader {
    /// What was asked for: a run's directory or a study's.
    asked: PathBuf,
    /// The run looked at last, and its histories.
    run: PathBuf,
    fluid: Series,
    solid: Series,
}

impl Reader {
    /// For the run in a directory, or the runs of a study.
    #[must_use]
    pub fn new(directory: &Path) -> Self {
        Self {
            asked: directory.to_path_buf(),
            run: PathBuf::new(),
            fluid: Series::new(FLUID_HISTORY, "/time", &[RADIUS, PRESSURE]),
            solid: Series::new(SOLID_HISTORY, "/solid/time", &[VON_MISES, PLASTIC]),
        }
    }

    /// Looks.
    ///
    /// - errors: there is no run in the directory, or its summary cannot be read.
    pub fn look(&mut self) -> Result<Seen, OutputError> {
        let (run, grid) = run_in(&self.asked)?;
        if run != self.run {
            *self = Self { run, ..Self::new(&self.asked) };
        }
        let summary = summary_of(&self.run)?;
        let state = RunState::of(&self.run, &summary);
        // A summary that was there before it ended says nothing of how.
        let summary = if state == RunState::Running { summary } else { summary_of(&self.run)? };
        let read = [self.fluid.read(&self.run), self.solid.read(&self.run)];
        let told = Standing::read(&self.run);
        let end = told.as_ref().map(|standing| standing.end).or_else(|| end_of(&self.run));
        let text = |value: &Value| value.as_str().map(str::to_owned);
        let is_over = state != RunState::Running;
        let standing = match (told, self.standing(&summary)) {
            // The last steps before a run was stopped have come too soon to be told.
            (Some(told), Some(own)) if is_over && own.line.time > told.line.time => Some(own),
            (told, own) => told.or(own),
        };
        Ok(Seen {
            directory: self.run.clone(),
            grid,
            state,
            standing,
            curves: self.curves(is_over.then_some(&summary)),
            end,
            error: summary.get("error").filter(|_| is_over).and_then(text),
            answer: (summary.get("answer").and_then(Value::as_array).into_iter().flatten())
                .chain(summary.get("look_next"))
                .filter(|_| is_over)
                .filter_map(text)
                .collect(),
            can_go_on: is_over && state != RunState::Finished && has_checkpoints(&self.run),
            trouble: read.into_iter().find_map(Result::err),
        })
    }

    /// Where the run stands by its histories, and of a run that has ended by its summary.
    fn standing(&self, summary: &Map<String, Value>) -> Option<Standing> {
        let series = if self.fluid.rows() > 0 { &self.fluid } else { &self.solid };
        let cells = |side: &str| summary.get("cells")?.get(side)?.get("final")?.as_u64();
        let [fluid, solid] = ["fluid", "solid"].map(|side| cells(side).unwrap_or(0));
        let line = ProgressLine {
            time: series.last_time(),
            step: series.rows().checked_sub(1)? as u64,
            dt: series.last_step(),
            limited_by: String::new(),
            cells: fluid + solid,
            solid_cells: solid,
            wall: summary.get("wall_seconds").and_then(Value::as_f64).unwrap_or(0.0),
        };
        Some(Standing { line, end: 0.0, left: None })
    }

    /// What there is to draw: the bubble, its pressure on the wall, and what that does to the solid.
    ///
    /// - `summary`: of a run that is over; it knows extremes better than the curves do.
    fn curves(&self, summary: Option<&Map<String, Value>>) -> Vec<Titled> {
        let number = |key: &str| summary?.get(key)?.as_f64();
        let collapse = number("collapse_time").zip(number("min_equivalent_radius")).map(<[f64; 2]>::from);
        let wall = summary.and_then(peak_on_the_wall).map(|[value, time]| [time, value]);
        let titled = |series: &Series, path: &str, title: &'static str, unit: &'static str| {
            let curve = series.curve(path)?.clone();
            curve.last()?;
            let peak = match path {
                RADIUS => collapse,
                PRESSURE => wall,
                _ => None,
            };
            Some(Titled { title, unit, is_least_wanted: path == RADIUS, curve, peak })
        };
        let is_there = |titled: &Titled| titled.curve.largest().is_some_and(|[_, value]| value > 0.0);
        // Where the solid can yield, how far it has is what is asked for; until it does, how near it is.
        let strain = titled(&self.solid, PLASTIC, "largest plastic strain", "").filter(is_there);
        let solid = strain.or_else(|| titled(&self.solid, VON_MISES, "largest von Mises stress", "Pa"));
        let bubble = [
            // Without gas there is no radius.
            titled(&self.fluid, RADIUS, "equivalent radius R(t)", "m").filter(is_there),
            titled(&self.fluid, PRESSURE, "wall pressure on the axis", "Pa").filter(|_| has_wall(&self.run)),
        ];
        bubble.into_iter().flatten().chain(solid).collect()
    }
}

/// A run's case.
fn case_of(directory: &Path) -> Option<toml::Table> {
    toml::from_str(&std::fs::read_to_string(directory.join(CASE)).ok()?).ok()
}

/// Whether `z_min` of the fluid is a wall: of a side that is open the history has the cells' pressure.
fn has_wall(directory: &Path) -> bool {
    let Some(case) = case_of(directory) else { return true };
    let named = |table: &str, key: &str| case.get(table)?.get(key)?.as_str();
    let z_min = case.get("fluid").and_then(|fluid| fluid.get("boundary")?.get("z_min")?.as_str());
    named("coupling", "scheme") != Some("none") || matches!(z_min, Some("wall"))
}

/// When the run in a directory ends by its case, s.
fn end_of(directory: &Path) -> Option<f64> {
    let case = case_of(directory)?;
    let time = case.get("time")?;
    ["end", "longest"].into_iter().find_map(|key| time.get(key)?.as_float())
}
