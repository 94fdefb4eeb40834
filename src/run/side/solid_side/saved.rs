//! What a checkpoint holds of the solid's side.

use std::time::Instant;

use coupler::{KappaFactor, LinkCounters, Meeting, Participant};
use serde::{Deserialize, Serialize};
use solid::SolidState;

use super::SolidSide;
use crate::case::{Case, SolidCase};
use crate::output::RunDirectory;
use crate::run::RunError;
use crate::run::record::solid_record::{SolidRecord, SolidRecordState};
use crate::run::record::timed::Clock;
use crate::run::schedule::Progressed;
use crate::run::setup::solid_solver;
use crate::run::side::past::{Done, Past};

/// What of the solid's side changes in time, between two steps of the whole.
#[derive(Serialize, Deserialize)]
pub struct SolidSideState<'a> {
    solver: SolidState<'a>,
    record: Option<SolidRecordState>,
    schedule: Progressed,
    floored: u64,
    factor: KappaFactor,
    fluids_step: f64,
    promised: f64,
    last_dt: f64,
    clock: Clock,
    done: Done,
}

impl SolidSide {
    /// What has to be kept of it; the link's counters are `counters`.
    fn saved(&self, counters: LinkCounters) -> SolidSideState<'_> {
        debug_assert!(self.pending.is_none() && self.trial.is_none(), "no step is under way");
        // Field by field, so that a new one cannot be forgotten here.
        let Self {
            solver,
            record,
            // The weak scheme's scratch.
            exchange: _,
            meeting,
            // It is what the case says.
            load: _,
            schedule,
            rule: _,
            scheme: _,
            star: _,
            kappa: _,
            factor,
            edges: _,
            // With every trace they are compared with those in it.
            fluid_edges: _,
            pending: _,
            trial: _,
            fluids_step,
            promised,
            end: _,
            last_dt,
            clock,
            memory: _,
            keeper: _,
            wall: _,
            past,
        } = self;
        SolidSideState {
            solver: solver.saved(),
            record: record.as_ref().map(SolidRecord::saved),
            schedule: schedule.saved(),
            floored: meeting.saved(),
            factor: *factor,
            fluids_step: *fluids_step,
            promised: *promised,
            last_dt: *last_dt,
            clock: *clock,
            done: past.saved(counters),
        }
    }

    /// The solid of a case, as it was kept, with its files.
    pub fn resumed(
        case: &Case,
        solid: &SolidCase,
        directory: &RunDirectory,
        saved: SolidSideState<'_>,
    ) -> Result<Self, RunError> {
        let SolidSideState {
            solver: state,
            record,
            schedule,
            floored,
            factor,
            fluids_step,
            promised,
            last_dt,
            clock,
            done,
        } = saved;
        let mut solver = solid_solver(case, solid)?;
        solver.restore(state)?;
        let record =
            record.map(|record| SolidRecord::resume(case, directory, &solver, record)).transpose()?;
        let mut side = Self::with(case, solver, record);
        side.schedule.restore(schedule);
        side.meeting = Meeting::restored(floored);
        side.factor = factor;
        side.fluids_step = fluids_step;
        side.promised = promised;
        side.last_dt = last_dt;
        side.clock = clock;
        side.past = Past::after(done);
        Ok(side)
    }

    /// Keeps a checkpoint, named by the fluid's `step` in a coupled run, if this run keeps any.
    pub(in crate::run) fn keep(&mut self, step: u64, counters: LinkCounters) -> Result<(), RunError> {
        let Some(mut keeper) = self.keeper.take() else { return Ok(()) };
        let start = Instant::now();
        if let Some(record) = &mut self.record {
            record.settle()?;
        }
        let kept = keeper.write(Participant::Solid, step, &self.saved(counters));
        self.keeper = Some(keeper);
        self.clock.checkpointing += start.elapsed();
        Ok(kept?)
    }
}
