//! The step loop: of all media in one process, of one of two processes.
//!
//! However a run ends, what was computed is written: histories are flushed, after a numerical failure the last
//! good state becomes a snapshot, and the side's part of the summary says whether the run was completed.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use coupler::{Endpoint, Link, LinkCounters, Participant, ProcessLink, Scheme};
use serde_json::{Map, Value, json};

use super::RunError;
use super::checkpoints::{Checkpoints, Keeper};
use super::fluid_side::{FluidSide, Turn};
use super::past::Past;
use super::session::{Session, Solvers};
use super::solid_side::SolidSide;
use super::stop::Stop;
use super::timed::Clock;
use crate::case::Case;
use crate::output::{ProgressLine, RunDirectory, summary};

/// Told of every step.
pub type OnStep<'a> = dyn FnMut(&ProgressLine) + 'a;

/// What the loops need of either side; [`FluidSide`] and [`SolidSide`] are the two.
pub trait RunSide {
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
    /// Its part of the summary.
    fn summary(&self) -> Map<String, Value>;
    /// How long the stages of its blocks' steps have taken since the run, or its going on, began, s.
    fn stage_seconds(&self) -> Vec<(&'static str, f64)>;
    /// Simulated time and steps so far.
    fn reached(&self) -> (f64, u64);
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

/// All media of a case in this process, turn by turn through the same frames.
pub fn in_process(
    case: &Case,
    directory: &RunDirectory,
    keeping: Keeping,
    stop: &Stop,
    on_step: &mut OnStep<'_>,
) -> Result<(), RunError> {
    let mut session = match keeping.from {
        Some(step) => Session::resume(case, directory, step)?,
        None => Session::new(case, Some(directory), Solvers::default())?,
    };
    if let Some(every) = keeping.every {
        session.keep_checkpoints(case, directory, every);
    }
    let result = loop {
        match session.step(stop) {
            Ok(Turn::Continues) => on_step(&session.line()),
            other => break other,
        }
    };
    session.end(Some(directory), result)
}

/// Where a run begins, and how often it keeps a checkpoint.
#[derive(Clone, Copy, Debug, Default)]
pub struct Keeping {
    /// The step of the checkpoint to go on from; `None` at t = 0.
    pub from: Option<u64>,
    /// After how much wall time each; `None` for none at all.
    pub every: Option<Duration>,
}

/// How a side of a two-process run is called and who it is.
pub struct Joining {
    /// The run's id, the same on both sides.
    pub run_id: String,
    /// Which side.
    pub participant: Participant,
    /// Told what the user should know while this side waits.
    pub notice: Option<coupler::Notice>,
}

/// One side of a run in two processes: connects, makes its part of every step, ends.
///
/// - `directory`: prepared by whoever leads; opened once the peer is there.
pub fn joined(
    case: &Case,
    joining: Joining,
    directory: impl FnOnce() -> Result<RunDirectory, RunError> + Send,
    keeping: Keeping,
    stop: &Stop,
    on_step: &mut OnStep<'_>,
) -> Result<(), RunError> {
    let connected = Arc::new(AtomicBool::new(false));
    let mut endpoint = Endpoint::new(joining.run_id, joining.participant, case.hash());
    endpoint.connect_timeout = Duration::from_secs_f64(case.coupling.connect_timeout);
    endpoint.patience = Duration::from_secs_f64(case.coupling.patience);
    endpoint.notice = joining.notice;
    endpoint.interrupt = Some(stop.hook(Arc::clone(&connected)));
    let mut link = match ProcessLink::connect(endpoint) {
        // A request to stop that came while waiting is no failure of the coupling.
        Err(coupler::CouplerError::Interrupted { .. }) if stop.flags() != 0 => {
            return Err(Stop::error(stop.flags()).unwrap_or(RunError::Terminated));
        }
        other => other?,
    };
    connected.store(true, Ordering::Relaxed);
    let directory = directory()?;
    let checkpoints = Checkpoints::of(case, &directory);
    // A program elsewhere keeps none.
    let every = keeping.every.filter(|_| case.coupling.scheme != Scheme::External);
    let keeper = every.map(|every| Keeper::new(checkpoints.clone(), every));
    let side = joining.participant.name();
    match joining.participant {
        Participant::Fluid => {
            let fluid = case.fluid.as_ref().ok_or(RunError::NoPeer { side })?;
            let side = match keeping.from {
                Some(step) => (checkpoints.read(Participant::Fluid, step))
                    .and_then(|saved| FluidSide::resumed(case, fluid, &directory, saved)),
                None => FluidSide::new(case, fluid, Some(&directory)),
            };
            let mut side = told(side, &mut link)?;
            if let Some(keeper) = keeper {
                side.keep_with(keeper);
            }
            let result = loop {
                match side.turn(&mut link, stop) {
                    Ok(Turn::Continues) => on_step(&line(&side)),
                    other => break other,
                }
            };
            let result = tell(result, &mut link, side.solver().steps());
            end(&mut side, Some(&directory), result, link.counters())
        }
        Participant::Solid => {
            let solid = case.solid.as_ref().ok_or(RunError::NoPeer { side })?;
            let side = match keeping.from {
                Some(step) => (checkpoints.read(Participant::Solid, step))
                    .and_then(|saved| SolidSide::resumed(case, solid, &directory, saved)),
                None => SolidSide::new(case, solid, Some(&directory)),
            };
            let mut side = told(side, &mut link)?;
            if let Some(keeper) = keeper {
                side.keep_with(keeper);
            }
            let mut rounds = || -> Result<Turn, RunError> {
                side.open(&mut link, stop)?;
                loop {
                    match side.turn(&mut link, stop)? {
                        Turn::Continues => on_step(&line(&side)),
                        over => return Ok(over),
                    }
                }
            };
            let result = rounds();
            let result = tell(result, &mut link, side.solver().steps());
            end(&mut side, Some(&directory), result, link.counters())
        }
    }
}

/// Passes a side on, or tells the peer why there is none.
fn told<S>(side: Result<S, RunError>, link: &mut ProcessLink) -> Result<S, RunError> {
    tell(side, link, 0)
}

/// Tells the peer of an error that it cannot know of.
fn tell<T>(result: Result<T, RunError>, link: &mut ProcessLink, step: u64) -> Result<T, RunError> {
    if let Err(error) = &result
        && !matches!(error, RunError::Coupler(error) if !error.is_refusal())
        && let Err(unsaid) = link.send_fault(error.fault(), step)
    {
        tracing::warn!(%unsaid, "the peer could not be told");
    }
    result
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
    let ((time, steps), clock) = (side.reached(), side.clock());
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
        side.stage_seconds().into_iter().map(|(name, seconds)| (name.to_owned(), json!(seconds))).collect();
    let mut part = Map::new();
    part.insert("stage_seconds".to_owned(), json!({ S::NAME: stages }));
    part.insert("completed".to_owned(), json!(completed));
    part.insert("t_end".to_owned(), json!(time));
    part.insert("steps".to_owned(), json!(steps));
    part.insert("wall_seconds".to_owned(), json!(side.past().wall().as_secs_f64()));
    part.insert("coupling".to_owned(), coupling);
    if let Err(error) = result {
        part.insert("error".to_owned(), json!(error.to_string()));
    }
    part
}
