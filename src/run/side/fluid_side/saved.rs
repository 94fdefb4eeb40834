//! What a checkpoint holds of the fluid's side.

use coupler::{FrameHeader, LinkCounters};
use fluid::FluidState;
use mesh::{BLOCK, CompiledSolver as _, Misfit};
use serde::{Deserialize, Serialize};

use super::FluidSide;
use crate::case::{Case, FluidCase};
use crate::output::RunDirectory;
use crate::run::RunError;
use crate::run::record::fluid_record::FluidRecord;
use crate::run::record::fluid_record::saved::FluidRecordState;
use crate::run::setup::fluid_solver;
use crate::run::side::InRunState;
use crate::run::side::cell_exchange::{CellExchange, CellsState};

const STOPPED: u32 = FrameHeader::STOP_INTERRUPT | FrameHeader::STOP_TERMINATE;

/// What of the fluid's side changes in time, between two steps of the whole.
#[derive(Serialize, Deserialize)]
pub struct FluidSideState<'a> {
    solver: FluidState<'a, BLOCK>,
    record: Option<FluidRecordState>,
    own: InRunState,
    cells: Option<CellsState>,
    answer: FrameHeader,
}

impl FluidSide {
    /// What has to be kept of it; the link's counters are `counters`.
    pub(super) fn saved(&self, counters: LinkCounters) -> FluidSideState<'_> {
        debug_assert!(self.pending.is_none(), "no step is under way");
        // Field by field, so that a new one cannot be forgotten here.
        let Self {
            own,
            cells,
            pending: _,
            answer,
            // Made with each step.
            sent: _,
            sound: _,
            limited_by: _,
            tells_of_checkpoint: _,
            is_resumed: _,
        } = self;
        FluidSideState {
            solver: own.solver.saved(),
            record: own.record.as_ref().map(FluidRecord::saved),
            own: own.saved(counters),
            cells: cells.as_ref().map(CellExchange::saved),
            // A wish to stop is fulfilled with this.
            answer: FrameHeader { flags: answer.flags & !STOPPED, ..*answer },
        }
    }

    /// The fluid of a case, as it was kept, with its files.
    pub fn resumed(
        case: &Case,
        fluid: &FluidCase,
        directory: &RunDirectory,
        saved: FluidSideState<'_>,
    ) -> Result<Self, RunError> {
        let FluidSideState { solver: state, record, own, cells, answer } = saved;
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
        side.own.restore(own);
        side.answer = answer;
        side.is_resumed = true;
        Ok(side)
    }
}
