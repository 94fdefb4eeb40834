//! What a checkpoint holds of the fluid's side.

use std::time::Instant;

use coupler::{FrameHeader, LinkCounters, Meeting, Participant};
use fluid::FluidState;
use mesh::{BLOCK, Misfit};
use serde::{Deserialize, Serialize};

use super::FluidSide;
use crate::case::{Case, FluidCase};
use crate::output::RunDirectory;
use crate::run::RunError;
use crate::run::record::fluid_record::FluidRecord;
use crate::run::record::fluid_record::saved::FluidRecordState;
use crate::run::record::timed::Clock;
use crate::run::schedule::Progressed;
use crate::run::setup::fluid_solver;
use crate::run::side::cell_exchange::{CellExchange, CellsState};
use crate::run::side::past::{Done, Past};

const STOPPED: u32 = FrameHeader::STOP_INTERRUPT | FrameHeader::STOP_TERMINATE;

/// What of the fluid's side changes in time, between two steps of the whole.
#[derive(Serialize, Deserialize)]
pub struct FluidSideState<'a> {
    solver: FluidState<'a, BLOCK>,
    record: Option<FluidRecordState>,
    schedule: Progressed,
    floored: u64,
    cells: Option<CellsState>,
    answer: FrameHeader,
    last_dt: f64,
    clock: Clock,
    done: Done,
}

impl FluidSide {
    /// What has to be kept of it; the link's counters are `counters`.
    fn saved(&self, counters: LinkCounters) -> FluidSideState<'_> {
        debug_assert!(self.pending.is_none(), "no step is under way");
        // Field by field, so that a new one cannot be forgotten here.
        let Self {
            solver,
            record,
            schedule,
            rule: _,
            meeting,
            cells,
            star: _,
            edges: _,
            pending: _,
            answer,
            // Made with each step.
            sent: _,
            limited_by: _,
            last_dt,
            clock,
            memory: _,
            keeper: _,
            tells_of_checkpoint: _,
            is_resumed: _,
            past,
        } = self;
        FluidSideState {
            solver: solver.saved(),
            record: record.as_ref().map(FluidRecord::saved),
            schedule: schedule.saved(),
            floored: meeting.saved(),
            cells: cells.as_ref().map(CellExchange::saved),
            // A wish to stop is fulfilled with this.
            answer: FrameHeader { flags: answer.flags & !STOPPED, ..*answer },
            last_dt: *last_dt,
            clock: *clock,
            done: past.saved(counters),
        }
    }

    /// The fluid of a case, as it was kept, with its files.
    pub fn resumed(
        case: &Case,
        fluid: &FluidCase,
        directory: &RunDirectory,
        saved: FluidSideState<'_>,
    ) -> Result<Self, RunError> {
        let FluidSideState { solver: state, record, schedule, floored, cells, answer, last_dt, clock, done } =
            saved;
        let mut solver = fluid_solver(case, fluid)?;
        solver.restore(state)?;
        let record =
            record.map(|record| FluidRecord::resume(case, directory, &solver, record)).transpose()?;
        let mut side = Self::with(case, solver, record);
        match (&mut side.cells, cells) {
            (Some(own), Some(saved)) => own.restore(saved)?,
            (None, None) => {}
            _ => return Err(Misfit("it is of another coupling scheme".to_owned()).into()),
        }
        side.schedule.restore(schedule);
        side.meeting = Meeting::restored(floored);
        side.answer = answer;
        side.last_dt = last_dt;
        side.clock = clock;
        side.past = Past::after(done);
        side.is_resumed = true;
        Ok(side)
    }

    /// Keeps a checkpoint, if this run keeps any; whether it did.
    pub(in crate::run) fn keep(&mut self, counters: LinkCounters) -> Result<bool, RunError> {
        let Some(mut keeper) = self.keeper.take() else { return Ok(false) };
        let start = Instant::now();
        if let Some(record) = &mut self.record {
            record.settle()?;
        }
        let kept = keeper.write(Participant::Fluid, self.solver.steps(), &self.saved(counters));
        self.keeper = Some(keeper);
        self.clock.checkpointing += start.elapsed();
        Ok(kept.map(|()| true)?)
    }
}
