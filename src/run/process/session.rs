//! A run in this process, step by step: what `cav run --in-process` and Python drive.

use std::time::Duration;

use coupler::{DirectLink, FrameHeader, Link, LinkCounters, Participant, direct_pair};
use fluid::FluidSolver;
use mesh::BLOCK;
use serde_json::{Map, Value};
use solid::SolidSolver;
use tracing::dispatcher;

use crate::case::Case;
use crate::output::{HistoryFile, ProgressLine, RunDirectory, summary};
use crate::run::RunError;
use crate::run::checkpoints::{Checkpoints, Keeper};
use crate::run::process::stop::Stop;
use crate::run::record::fluid_record::FluidRecord;
use crate::run::record::of_side::Record;
use crate::run::record::solid_record::SolidRecord;
use crate::run::schedule::Schedule;
use crate::run::setup::{fluid_solver, solid_and_displacement};
use crate::run::side::fluid_side::{FluidSide, Turn};
use crate::run::side::solid_side::SolidSide;
use crate::run::side::{RunSide, end, line, part};

/// A run in this process. Between two steps both media are at the same time.
pub struct Session {
    sides: Sides,
}

enum Sides {
    Fluid(Box<FluidSide>),
    Solid(Box<SolidSide>),
    Both(Box<Coupled>),
}

struct Coupled {
    fluid: FluidSide,
    solid: SolidSide,
    to_solid: DirectLink,
    to_fluid: DirectLink,
    /// Whether the solid has said its first word.
    met: bool,
}

impl Coupled {
    /// One step: the fluid begins it, the solid makes its own, the fluid completes it. What of the longer step does not
    /// depend on the other side goes on beside that one's turn, so that neither leaves threads without work.
    fn step(&mut self, stop: &Stop) -> Result<Turn, RunError> {
        if !self.met {
            self.solid.open(&mut self.to_fluid, stop)?;
            self.fluid.complete(&mut self.to_solid)?;
            self.met = true;
        }
        let turn = self.fluid.begin(&mut self.to_solid, stop)?;
        both(|| self.fluid.meanwhile(), || self.solid.answer(&mut self.to_fluid, stop))?;
        if turn == Turn::Continues {
            while !both(|| self.fluid.complete(&mut self.to_solid), || self.solid.meanwhile())?.0 {
                self.solid.answer(&mut self.to_fluid, stop)?;
            }
            self.solid.settle(&mut self.to_fluid)?;
        }
        Ok(turn)
    }
}

/// Solvers that have been made otherwise than by the case, in their initial states.
#[derive(Default)]
pub struct Solvers {
    /// The fluid.
    pub fluid: Option<FluidSolver<BLOCK>>,
    /// The solid.
    pub solid: Option<SolidSolver<BLOCK>>,
}

/// Does both, at the same time where there are threads for it; the first one's error counts.
fn both<A: Send, B: Send>(
    first: impl FnOnce() -> Result<A, RunError> + Send,
    second: impl FnOnce() -> Result<B, RunError> + Send,
) -> Result<(A, B), RunError> {
    // On whatever threads: their messages go where those of this one go.
    let log = dispatcher::get_default(Clone::clone);
    let first = || dispatcher::with_default(&log, first);
    let second = || dispatcher::with_default(&log, second);
    let (first, second) = rayon::join(first, second);
    Ok((first?, second?))
}

impl Session {
    /// A case at t = 0. With a directory it writes what happens there; without one, histories stay in memory.
    ///
    /// - `solvers`: take the place of those that the case's initial conditions would make.
    ///
    /// - errors: see [`RunError`]; with scheme `"external"` the other side is not in this process.
    pub fn new(case: &Case, directory: Option<&RunDirectory>, solvers: Solvers) -> Result<Self, RunError> {
        RunError::unless_whole(case)?;
        case.fits_memory([true; 2])?;
        let fluid = |fluid| {
            let solver = solvers.fluid.map_or_else(|| fluid_solver(case, fluid), Ok)?;
            let record = FluidRecord::create(case, directory, &solver)?;
            Ok(FluidSide::with(case, solver, Some(record)))
        };
        let solid = |solid| {
            let made = solvers.solid.map(|solver| (solver, None));
            let (solver, displacement) = made.map_or_else(|| solid_and_displacement(case, solid), Ok)?;
            let record = SolidRecord::create(case, directory, &solver, displacement.as_deref())?;
            Ok(SolidSide::with(case, solver, Some(record)))
        };
        let (fluid, solid) = both(
            || case.fluid.as_ref().map(fluid).transpose(),
            || case.solid.as_ref().map(solid).transpose(),
        )?;
        Ok(Self::of(case, fluid, solid))
    }

    /// A run that goes on from the checkpoint of a step.
    pub fn resume(case: &Case, directory: &RunDirectory, step: u64) -> Result<Self, RunError> {
        let checkpoints = Checkpoints::of(case, directory);
        let fluid = |fluid| {
            let saved = checkpoints.read(Participant::Fluid, step)?;
            FluidSide::resumed(case, fluid, directory, saved)
        };
        let solid = |solid| {
            let saved = checkpoints.read(Participant::Solid, step)?;
            SolidSide::resumed(case, solid, directory, saved)
        };
        let (fluid, solid) = both(
            || case.fluid.as_ref().map(fluid).transpose(),
            || case.solid.as_ref().map(solid).transpose(),
        )?;
        Ok(Self::of(case, fluid, solid))
    }

    fn of(case: &Case, fluid: Option<FluidSide>, solid: Option<SolidSide>) -> Self {
        let sides = match (fluid, solid) {
            (Some(fluid), Some(solid)) => {
                let (to_solid, to_fluid) = direct_pair(case.hash());
                Sides::Both(Box::new(Coupled { fluid, solid, to_solid, to_fluid, met: false }))
            }
            (Some(fluid), None) => Sides::Fluid(Box::new(fluid)),
            (None, Some(solid)) => Sides::Solid(Box::new(solid)),
            (None, None) => unreachable!("a case has at least one medium"),
        };
        Self { sides }
    }

    /// Keeps checkpoints in the run's directory from now on: one after `every` of wall time, and when it is stopped.
    pub fn keep_checkpoints(&mut self, case: &Case, directory: &RunDirectory, every: Duration) {
        let keeper = || Keeper::new(Checkpoints::of(case, directory), every);
        match &mut self.sides {
            Sides::Fluid(side) => side.keep_with(keeper()),
            Sides::Solid(side) => side.keep_with(keeper()),
            Sides::Both(both) => {
                both.fluid.keep_with(keeper());
                both.solid.keep_with(keeper());
            }
        }
    }

    /// Makes a step of all media. [`Turn::Over`] if there was none left to make or `stop` asked for the end.
    pub fn step(&mut self, stop: &Stop) -> Result<Turn, RunError> {
        match &mut self.sides {
            Sides::Fluid(side) => step_alone(side.as_mut(), stop),
            Sides::Solid(side) => step_alone(side.as_mut(), stop),
            Sides::Both(both) => both.step(stop),
        }
    }

    /// Makes no further step, and keeps a checkpoint of those made if any are kept: for a run that is broken off between two.
    ///
    /// - `stop`: has asked for the end.
    pub fn halt(&mut self, stop: &Stop) -> Result<Turn, RunError> {
        match &mut self.sides {
            Sides::Fluid(side) => halt_alone(side.as_mut(), stop),
            Sides::Solid(side) => halt_alone(side.as_mut(), stop),
            // Both learn of it before they begin a step.
            Sides::Both(both) => both.step(stop),
        }
    }

    /// Writes what is left to write, and with a directory each side's part of the summary.
    ///
    /// - `result`: what the last step came to; its error is passed on.
    pub fn end(
        &mut self,
        directory: Option<&RunDirectory>,
        result: Result<Turn, RunError>,
    ) -> Result<(), RunError> {
        match &mut self.sides {
            Sides::Fluid(side) => end(side.as_mut(), directory, result, LinkCounters::default()),
            Sides::Solid(side) => end(side.as_mut(), directory, result, LinkCounters::default()),
            Sides::Both(both) => {
                let result_of_solid = match &result {
                    Ok(turn) => Ok(*turn),
                    Err(_) => Ok(Turn::Over(FrameHeader::STOP_TERMINATE)),
                };
                let Coupled { fluid, solid, to_solid, to_fluid, .. } = both.as_mut();
                let (of_fluid, of_solid) = (to_solid.counters(), to_fluid.counters());
                self::both(
                    || end(fluid, directory, result, of_fluid),
                    || end(solid, directory, result_of_solid, of_solid),
                )
                .map(|_| ())
            }
        }
    }

    /// The summary as far as it is known, `completed` if the last step came to `result`.
    pub fn summary(&self, result: &Result<Turn, RunError>) -> Map<String, Value> {
        match &self.sides {
            Sides::Fluid(side) => part(side.as_ref(), result, LinkCounters::default()),
            Sides::Solid(side) => part(side.as_ref(), result, LinkCounters::default()),
            Sides::Both(both) => summary::merge(&[
                part(&both.solid, result, both.to_fluid.counters()),
                part(&both.fluid, result, both.to_solid.counters()),
            ]),
        }
    }

    /// How far the run is.
    pub fn line(&self) -> ProgressLine {
        match &self.sides {
            Sides::Fluid(side) => line(side.as_ref()),
            Sides::Solid(side) => line(side.as_ref()),
            Sides::Both(both) => line(&both.fluid),
        }
    }

    /// When steps have to land.
    pub fn schedule_mut(&mut self) -> &mut Schedule {
        match &mut self.sides {
            Sides::Fluid(side) => side.schedule_mut(),
            Sides::Solid(side) => side.schedule_mut(),
            Sides::Both(both) => both.fluid.schedule_mut(),
        }
    }

    /// The fluid's side.
    pub fn fluid(&self) -> Option<&FluidSide> {
        match &self.sides {
            Sides::Fluid(side) => Some(side),
            Sides::Solid(_) => None,
            Sides::Both(both) => Some(&both.fluid),
        }
    }

    /// The solid's side.
    pub fn solid(&self) -> Option<&SolidSide> {
        match &self.sides {
            Sides::Fluid(_) => None,
            Sides::Solid(side) => Some(side),
            Sides::Both(both) => Some(&both.solid),
        }
    }

    /// The histories of both sides.
    pub fn histories(&self) -> impl Iterator<Item = &HistoryFile> {
        let fluid = self.fluid().and_then(|side| side.record()).map(Record::history);
        let solid = self.solid().and_then(|side| side.record()).map(Record::history);
        fluid.into_iter().chain(solid)
    }

    /// Writes the rows of the histories that are still in memory.
    pub fn flush(&mut self) -> Result<(), RunError> {
        match &mut self.sides {
            Sides::Fluid(side) => side.flush(),
            Sides::Solid(side) => side.flush(),
            Sides::Both(both) => both.fluid.flush().and_then(|()| both.solid.flush()),
        }
    }
}

fn step_alone(side: &mut impl RunSide, stop: &Stop) -> Result<Turn, RunError> {
    if !side.step_alone()? {
        return Ok(Turn::Over(0));
    }
    let flags = stop.flags();
    side.keep_alone(flags != 0)?;
    Ok(if flags == 0 { Turn::Continues } else { Turn::Over(flags) })
}

fn halt_alone(side: &mut impl RunSide, stop: &Stop) -> Result<Turn, RunError> {
    if side.solver().steps() > 0 {
        side.keep_alone(true)?;
    }
    Ok(Turn::Over(stop.flags()))
}
