//! What a checkpoint holds of the solid's side.

use coupler::{KappaFactor, LinkCounters};
use mesh::CompiledSolver as _;
use serde::{Deserialize, Serialize};
use solid::SolidState;

use super::SolidSide;
use crate::case::{Case, SolidCase};
use crate::output::RunDirectory;
use crate::run::RunError;
use crate::run::record::solid_record::{SolidRecord, SolidRecordState};
use crate::run::setup::solid_solver;
use crate::run::side::InRunState;

/// What of the solid's side changes in time, between two steps of the whole.
#[derive(Serialize, Deserialize)]
pub struct SolidSideState<'a> {
    solver: SolidState<'a>,
    record: Option<SolidRecordState>,
    own: InRunState,
    factor: KappaFactor,
    fluids_step: f64,
    promised: f64,
}

impl SolidSide {
    /// What has to be kept of it; the link's counters are `counters`.
    pub(super) fn saved(&self, counters: LinkCounters) -> SolidSideState<'_> {
        debug_assert!(self.pending.is_none() && self.trial.is_none(), "no step is under way");
        // Field by field, so that a new one cannot be forgotten here.
        let Self {
            own,
            // The weak scheme's scratch.
            exchange: _,
            // It is what the case says.
            load: _,
            scheme: _,
            kappa: _,
            factor,
            // With every trace they are compared with those in it.
            fluid_edges: _,
            pending: _,
            trial: _,
            fluids_step,
            promised,
            coming: _,
            end: _,
            wall: _,
        } = self;
        SolidSideState {
            solver: own.solver.saved(),
            record: own.record.as_ref().map(SolidRecord::saved),
            own: own.saved(counters),
            factor: *factor,
            fluids_step: *fluids_step,
            promised: *promised,
        }
    }

    /// The solid of a case, as it was kept, with its files.
    pub fn resumed(
        case: &Case,
        solid: &SolidCase,
        directory: &RunDirectory,
        saved: SolidSideState<'_>,
    ) -> Result<Self, RunError> {
        let SolidSideState { solver: state, record, own, factor, fluids_step, promised } = saved;
        let mut solver = solid_solver(case, solid)?;
        solver.restore(state)?;
        let record =
            record.map(|record| SolidRecord::resume(case, directory, &solver, record)).transpose()?;
        let mut side = Self::with(case, solver, record);
        side.own.restore(own);
        side.factor = factor;
        side.fluids_step = fluids_step;
        side.promised = promised;
        Ok(side)
    }
}
