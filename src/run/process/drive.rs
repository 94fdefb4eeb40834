//! The step loop: of all media in one process, of one of two processes.
//!
//! However a run ends, what was computed is written: histories are flushed, after a numerical failure the last
//! good state becomes a snapshot, and the side's part of the summary says whether the run was completed.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use coupler::{Endpoint, Link, Participant, ProcessLink, Scheme};

use crate::case::Case;
use crate::output::{ProgressLine, RunDirectory};
use crate::run::RunError;
use crate::run::checkpoints::{Checkpoints, Keeper};
use crate::run::process::session::{Session, Solvers};
use crate::run::process::stop::Stop;
use crate::run::side::fluid_side::{FluidSide, Turn};
use crate::run::side::solid_side::SolidSide;
use crate::run::side::{RunSide, end, line};

/// Told of every step.
pub type OnStep<'a> = dyn FnMut(&ProgressLine) + 'a;

/// All media of a case in this process, through the same frames; see [`Session::step`].
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
            let saved = keeping.from.map(|step| checkpoints.read(Participant::Fluid, step));
            let resumed = |saved| FluidSide::resumed(case, fluid, &directory, saved);
            let side = begun(saved, resumed, || FluidSide::new(case, fluid, Some(&directory)));
            conducted(side, &mut link, &directory, keeper, |side, link| turns(side, link, stop, on_step))
        }
        Participant::Solid => {
            let solid = case.solid.as_ref().ok_or(RunError::NoPeer { side })?;
            let saved = keeping.from.map(|step| checkpoints.read(Participant::Solid, step));
            let resumed = |saved| SolidSide::resumed(case, solid, &directory, saved);
            let side = begun(saved, resumed, || SolidSide::new(case, solid, Some(&directory)));
            conducted(side, &mut link, &directory, keeper, |side, link| {
                side.open(link, stop)?;
                turns(side, link, stop, on_step)
            })
        }
    }
}

/// Steps of a side until the run is over.
fn turns<S: RunSide>(
    side: &mut S,
    link: &mut ProcessLink,
    stop: &Stop,
    on_step: &mut OnStep<'_>,
) -> Result<Turn, RunError> {
    loop {
        match side.turn(link, stop)? {
            Turn::Continues => on_step(&line(side)),
            over => return Ok(over),
        }
    }
}

/// A side through its steps to its end; the peer is told of what fails.
fn conducted<S: RunSide>(
    side: Result<S, RunError>,
    link: &mut ProcessLink,
    directory: &RunDirectory,
    keeper: Option<Keeper>,
    steps: impl FnOnce(&mut S, &mut ProcessLink) -> Result<Turn, RunError>,
) -> Result<(), RunError> {
    let mut side = keeping_by(keeper, told(side, link)?);
    let result = steps(&mut side, link);
    let result = tell(result, link, side.solver().steps());
    end(&mut side, Some(directory), result, link.counters())
}

/// A side as it was kept, or at t = 0.
fn begun<S, T>(
    saved: Option<Result<T, RunError>>,
    resumed: impl FnOnce(T) -> Result<S, RunError>,
    new: impl FnOnce() -> Result<S, RunError>,
) -> Result<S, RunError> {
    saved.map_or_else(new, |saved| saved.and_then(resumed))
}

/// A side that keeps checkpoints, if there is what keeps them.
fn keeping_by<S: RunSide>(keeper: Option<Keeper>, mut side: S) -> S {
    if let Some(keeper) = keeper {
        side.keep_with(keeper);
    }
    side
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
