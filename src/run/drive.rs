//! The step loop: of one medium alone, of both in one process, of one of two processes.
//!
//! However a run ends, what was computed is written: histories are flushed, after a numerical failure the last
//! good state becomes a snapshot, and the side's part of the summary says whether the run was completed.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use coupler::{Endpoint, Link, LinkCounters, Participant, ProcessLink, direct_pair};
use serde_json::{Map, Value, json};

use super::RunError;
use super::fluid_side::{Clock, FluidSide, Turn};
use super::solid_side::SolidSide;
use super::stop::Stop;
use crate::case::Case;
use crate::output::run_directory::{FLUID_SUMMARY, SOLID_SUMMARY};
use crate::output::{ProgressLine, RunDirectory, summary};

/// Told of every step.
pub type OnStep<'a> = dyn FnMut(&ProgressLine) + 'a;

/// One medium, or a fluid over a rigid wall.
pub fn alone(
    case: &Case,
    directory: &RunDirectory,
    stop: &Stop,
    on_step: &mut OnStep<'_>,
) -> Result<(), RunError> {
    let begin = Instant::now();
    match (&case.fluid, &case.solid) {
        (Some(fluid), _) => {
            let mut side = FluidSide::new(case, fluid, Some(directory))?;
            let result = loop {
                match side.step_alone() {
                    Err(error) => break Err(error),
                    Ok(None) => break Ok(Turn::Over(0)),
                    Ok(Some(_)) if stop.flags() != 0 => break Ok(Turn::Over(stop.flags())),
                    Ok(Some(_)) => on_step(&fluid_line(&side, 0, begin)),
                }
            };
            end_fluid(&mut side, directory, result, LinkCounters::default(), begin)
        }
        (None, Some(solid)) => {
            let mut side = SolidSide::new(case, solid, Some(directory))?;
            let result = loop {
                match side.step_alone() {
                    Err(error) => break Err(error),
                    Ok(None) => break Ok(Turn::Over(0)),
                    Ok(Some(_)) if stop.flags() != 0 => break Ok(Turn::Over(stop.flags())),
                    Ok(Some(_)) => on_step(&solid_line(&side, begin)),
                }
            };
            end_solid(&mut side, directory, result, LinkCounters::default(), begin)
        }
        (None, None) => unreachable!("a case has at least one medium"),
    }
}

/// Both media in this process, turn by turn through the same frames.
pub fn in_process(
    case: &Case,
    directory: &RunDirectory,
    stop: &Stop,
    on_step: &mut OnStep<'_>,
) -> Result<(), RunError> {
    let (Some(fluid), Some(solid)) = (&case.fluid, &case.solid) else {
        return alone(case, directory, stop, on_step);
    };
    let mut fluid = FluidSide::new(case, fluid, Some(directory))?;
    let mut solid = SolidSide::new(case, solid, Some(directory))?;
    let begin = Instant::now();
    let (mut to_solid, mut to_fluid) = direct_pair(case.hash());
    let solid_cells = solid.solver().mesh().cells() as u64;
    let mut rounds = || -> Result<Turn, RunError> {
        solid.open(&mut to_fluid, stop)?;
        loop {
            if let over @ Turn::Over(_) = fluid.turn(&mut to_solid, stop)? {
                solid.turn(&mut to_fluid, stop)?;
                return Ok(over);
            }
            on_step(&fluid_line(&fluid, solid_cells, begin));
            solid.turn(&mut to_fluid, stop)?;
        }
    };
    let result = rounds();
    let error_of_solid = match &result {
        Ok(turn) => Ok(*turn),
        Err(_) => Ok(Turn::Over(coupler::FrameHeader::STOP_TERMINATE)),
    };
    let fluid_end = end_fluid(&mut fluid, directory, result, to_solid.counters(), begin);
    let solid_end = end_solid(&mut solid, directory, error_of_solid, to_fluid.counters(), begin);
    fluid_end.and(solid_end)
}

/// How a side of a two-process run is called and who it is.
pub struct Joining {
    /// The run's id, the same on both sides.
    pub run_id: String,
    /// Which side.
    pub participant: Participant,
}

/// One side of a run in two processes: connects, makes its part of every step, ends.
///
/// - `directory`: prepared by whoever leads; opened once the peer is there.
pub fn joined(
    case: &Case,
    joining: Joining,
    directory: impl FnOnce() -> Result<RunDirectory, RunError> + Send,
    stop: &Stop,
    on_step: &mut OnStep<'_>,
) -> Result<(), RunError> {
    let (Some(fluid), Some(solid)) = (&case.fluid, &case.solid) else {
        unreachable!("only coupled cases run in two processes");
    };
    let connected = Arc::new(AtomicBool::new(false));
    let mut endpoint = Endpoint::new(joining.run_id, joining.participant, case.hash());
    endpoint.connect_timeout = Duration::from_secs_f64(case.coupling.connect_timeout);
    endpoint.patience = Duration::from_secs_f64(case.coupling.patience);
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
    let begin = Instant::now();
    match joining.participant {
        Participant::Fluid => {
            let solid_cells = solid.grid.cell_count() as u64;
            let mut side = told(FluidSide::new(case, fluid, Some(&directory)), &mut link)?;
            let result = loop {
                match side.turn(&mut link, stop) {
                    Ok(Turn::Continues) => on_step(&fluid_line(&side, solid_cells, begin)),
                    other => break other,
                }
            };
            let result = tell(result, &mut link, side.solver().steps());
            end_fluid(&mut side, &directory, result, link.counters(), begin)
        }
        Participant::Solid => {
            let mut side = told(SolidSide::new(case, solid, Some(&directory)), &mut link)?;
            let mut rounds = || -> Result<Turn, RunError> {
                side.open(&mut link, stop)?;
                loop {
                    match side.turn(&mut link, stop)? {
                        Turn::Continues => on_step(&solid_line(&side, begin)),
                        over => return Ok(over),
                    }
                }
            };
            let result = rounds();
            let result = tell(result, &mut link, side.solver().steps());
            end_solid(&mut side, &directory, result, link.counters(), begin)
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
        && !matches!(error, RunError::Coupler(_))
        && let Err(unsaid) = link.send_fault(error.fault(), step)
    {
        tracing::warn!(%unsaid, "the peer could not be told");
    }
    result
}

fn end_fluid(
    side: &mut FluidSide,
    directory: &RunDirectory,
    result: Result<Turn, RunError>,
    counters: LinkCounters,
    begin: Instant,
) -> Result<(), RunError> {
    let failed = matches!(&result, Err(error) if error.exit_code() == 3);
    side.close(failed)?;
    let (solver, clock) = (side.solver(), side.clock());
    let mut part = side.summary();
    part.extend(progress_part("fluid", solver.time(), solver.steps(), &result, begin, clock, counters));
    summary::write(directory, FLUID_SUMMARY, &part)?;
    concluded(result)
}

fn end_solid(
    side: &mut SolidSide,
    directory: &RunDirectory,
    result: Result<Turn, RunError>,
    counters: LinkCounters,
    begin: Instant,
) -> Result<(), RunError> {
    let failed = matches!(&result, Err(error) if error.exit_code() == 3);
    side.close(failed)?;
    let (solver, clock) = (side.solver(), side.clock());
    let mut part = side.summary();
    part.extend(progress_part("solid", solver.time(), solver.steps(), &result, begin, clock, counters));
    summary::write(directory, SOLID_SUMMARY, &part)?;
    concluded(result)
}

fn concluded(result: Result<Turn, RunError>) -> Result<(), RunError> {
    match result? {
        Turn::Over(flags) => Stop::error(flags).map_or(Ok(()), Err),
        Turn::Continues => unreachable!("a loop ends with the end"),
    }
}

/// What the summary says of a side's part in the run.
fn progress_part(
    side: &str,
    time: f64,
    steps: u64,
    result: &Result<Turn, RunError>,
    begin: Instant,
    clock: Clock,
    counters: LinkCounters,
) -> Map<String, Value> {
    let completed = matches!(result, Ok(Turn::Over(0)));
    let mut coupling = json!({
        "exchanges": counters.received,
        "bytes": counters.bytes,
    });
    coupling[side] = json!({
        "seconds_computing": clock.computing.as_secs_f64(),
        "seconds_recording": clock.recording.as_secs_f64(),
        "seconds_waited": counters.waited.as_secs_f64(),
        "seconds_exchanging": counters.exchanging.as_secs_f64(),
    });
    let mut part = Map::new();
    part.insert("completed".to_owned(), json!(completed));
    part.insert("t_end".to_owned(), json!(time));
    part.insert("steps".to_owned(), json!(steps));
    part.insert("wall_seconds".to_owned(), json!(begin.elapsed().as_secs_f64()));
    part.insert("coupling".to_owned(), coupling);
    if let Err(error) = result {
        part.insert("error".to_owned(), json!(error.to_string()));
    }
    part
}

fn fluid_line(side: &FluidSide, other_cells: u64, begin: Instant) -> ProgressLine {
    let solver = side.solver();
    ProgressLine {
        time: solver.time(),
        step: solver.steps(),
        dt: side.last_dt(),
        limited_by: side.limited_by().to_owned(),
        cells: solver.mesh().cells() as u64 + other_cells,
        wall: begin.elapsed().as_secs_f64(),
    }
}

fn solid_line(side: &SolidSide, begin: Instant) -> ProgressLine {
    let solver = side.solver();
    ProgressLine {
        time: solver.time(),
        step: solver.steps(),
        dt: side.last_dt(),
        limited_by: "solid".to_owned(),
        cells: solver.mesh().cells() as u64,
        wall: begin.elapsed().as_secs_f64(),
    }
}
