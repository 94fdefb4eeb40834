//! What the step loops need of either side, and how a side's part of a run ends.
//!
//! | module | is |
//! |---|---|
//! | [`fluid_side`], [`solid_side`] | one medium's part |
//! | [`coupled_solver`] | long and short steps of a solver, whichever medium it is for |
//! | [`cell_exchange`] | the paper's coupling schemes |
//! | [`load`] | a given pressure on a solid without a fluid |
//! | [`wall_faces`] | the faces on the interface, which change with the mesh |
//! | [`past`] | what was done before a run was taken up again |

pub mod cell_exchange;
pub mod coupled_solver;
pub mod fluid_side;
pub mod load;
pub mod past;
pub mod solid_side;
pub mod wall_faces;

use coupler::{Link, LinkCounters};
use serde_json::{Map, Value, json};

use crate::output::{ProgressLine, RunDirectory, summary};
use crate::run::RunError;
use crate::run::process::stop::Stop;
use crate::run::record::timed::Clock;
use crate::run::side::coupled_solver::CoupledSolver;
use crate::run::side::fluid_side::Turn;
use crate::run::side::past::Past;

/// What the loops need of either side; [`fluid_side::FluidSide`] and [`solid_side::SolidSide`] are the two.
pub trait RunSide {
    /// Its solver.
    type Solver: CoupledSolver;
    /// "fluid" or "solid".
    const NAME: &'static str;
    /// The file of its part of the summary.
    const SUMMARY: &'static str;

    /// One step without the other side; `false` when the run is over.
    fn step_alone(&mut self) -> Result<bool, RunError>;
    /// Its part of a coupled step.
    fn turn(&mut self, link: &mut impl Link, stop: &Stop) -> Result<Turn, RunError>;
    /// Writes what is still in memory; after a numerical failure the last good state, too.
    fn close(&mut self, failed: bool) -> Result<(), RunError>;
    /// Leaves what another run can begin with, once this one is complete.
    fn leave(&self, _directory: &RunDirectory) -> Result<(), RunError> {
        Ok(())
    }
    /// Its part of the summary.
    fn summary(&self) -> Map<String, Value>;
    /// Its solver.
    fn solver(&self) -> &Self::Solver;
    /// Where the wall time went.
    fn clock(&self) -> Clock;
    /// Since when, and what was done before.
    fn past(&self) -> &Past;
    /// Keeps a checkpoint of a side that steps alone, if it is time to or the run is stopped.
    fn keep_alone(&mut self, is_stopped: bool) -> Result<(), RunError>;
    /// What a progress line says of it; `cells` are its own and those of the other side that it knows of, `wall` is
    /// left at 0.
    fn line(&self) -> ProgressLine;
}

/// A side's progress.
pub(super) fn line(side: &impl RunSide) -> ProgressLine {
    ProgressLine { wall: side.past().wall().as_secs_f64(), ..side.line() }
}

/// Writes what is left to write of a side, and its part of the summary.
pub(super) fn end<S: RunSide>(
    side: &mut S,
    directory: Option<&RunDirectory>,
    result: Result<Turn, RunError>,
    counters: LinkCounters,
) -> Result<(), RunError> {
    let failed = matches!(&result, Err(error) if error.exit_code() == 3);
    side.close(failed)?;
    if let Some(directory) = directory {
        if matches!(result, Ok(Turn::Over(0))) {
            side.leave(directory)?;
        }
        summary::write(directory, S::SUMMARY, &part(side, &result, counters))?;
    }
    concluded(result)
}

/// A side's part of the summary.
pub(super) fn part<S: RunSide>(
    side: &S,
    result: &Result<Turn, RunError>,
    counters: LinkCounters,
) -> Map<String, Value> {
    let mut part = side.summary();
    part.extend(progress_part(side, result, counters));
    part
}

fn concluded(result: Result<Turn, RunError>) -> Result<(), RunError> {
    match result? {
        Turn::Over(flags) => Stop::error(flags).map_or(Ok(()), Err),
        Turn::Continues => unreachable!("a loop ends with the end"),
    }
}

/// What the summary says of a side's part in the run.
fn progress_part<S: RunSide>(
    side: &S,
    result: &Result<Turn, RunError>,
    counters: LinkCounters,
) -> Map<String, Value> {
    let completed = matches!(result, Ok(Turn::Over(0)));
    let (solver, clock) = (side.solver(), side.clock());
    let counters = side.past().exchanged(counters);
    let mut coupling = json!({
        "exchanges": counters.received,
        "bytes": counters.bytes,
    });
    coupling[S::NAME] = json!({
        "seconds_computing": clock.computing.as_secs_f64(),
        "seconds_adapting": clock.adapting.as_secs_f64(),
        "seconds_recording": clock.recording.as_secs_f64(),
        "seconds_checkpointing": clock.checkpointing.as_secs_f64(),
        "seconds_waited": counters.waited.as_secs_f64(),
        "seconds_exchanging": counters.exchanging.as_secs_f64(),
        "exchange_seconds": {
            "p50": counters.latencies.percentile(0.5),
            "p90": counters.latencies.percentile(0.9),
            "p99": counters.latencies.percentile(0.99),
            "p999": counters.latencies.percentile(0.999),
            "largest": counters.latencies.percentile(1.0),
        },
    });
    let stages: Map<String, Value> =
        solver.stage_seconds().into_iter().map(|(name, seconds)| (name.to_owned(), json!(seconds))).collect();
    let mut part = Map::new();
    part.insert("stage_seconds".to_owned(), json!({ S::NAME: stages }));
    part.insert("completed".to_owned(), json!(completed));
    part.insert("t_end".to_owned(), json!(solver.time()));
    part.insert("steps".to_owned(), json!(solver.steps()));
    part.insert("wall_seconds".to_owned(), json!(side.past().wall().as_secs_f64()));
    part.insert("coupling".to_owned(), coupling);
    if let Err(error) = result {
        part.insert("error".to_owned(), json!(error.to_string()));
    }
    part
}
