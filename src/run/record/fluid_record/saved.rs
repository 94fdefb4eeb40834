//! What a checkpoint holds of the fluid's record.

use fluid::FluidSolver;
use mesh::{BLOCK, Misfit};
use serde::{Deserialize, Serialize};

use super::files::names;
use super::{FluidRecord, Seen};
use crate::case::Case;
use crate::output::RunDirectory;
use crate::run::RunError;
use crate::run::record::interface_history::{InterfaceHistory, InterfaceState};
use crate::run::record::side_files::{FilesState, SideFiles};
use crate::run::record::{StepEnds, Ticker, restore_probes, saved_probes};

/// What of a record changes in time, and what hangs on the state at t = 0.
#[derive(Serialize, Deserialize)]
pub struct FluidRecordState {
    files: FilesState,
    interface: Option<InterfaceState>,
    ticker: Ticker,
    probes: Vec<StepEnds>,
    wall_pressures: Vec<f64>,
    seen: Seen,
}

impl FluidRecord {
    /// Takes up the files of a run, and what was kept of its record; what was written since is forgotten.
    pub fn resume(
        case: &Case,
        directory: &RunDirectory,
        solver: &FluidSolver<BLOCK>,
        saved: FluidRecordState,
    ) -> Result<Self, RunError> {
        let files = SideFiles::resume(case, directory, names(solver), &saved.files)?;
        let mut record = Self::on(case, files, solver)?;
        let FluidRecordState { files, interface, ticker, probes, wall_pressures, seen } = saved;
        match (&mut record.interface, interface) {
            (Some(own), Some(saved)) => own.restore(saved, &record.faces, &mut record.files.history)?,
            (None, None) => {}
            _ => return Err(Misfit("only one of both has a history of the interface".to_owned()).into()),
        }
        record.ticker = ticker;
        restore_probes(&mut record.probes, probes)?;
        record.wall_pressures = wall_pressures;
        record.seen = seen;
        record.files.forget_rows(&files)?;
        Ok(record)
    }

    /// What has to be kept of it.
    pub fn saved(&self) -> FluidRecordState {
        // Field by field, so that a new one cannot be forgotten here.
        let Self {
            files,
            steps: _,
            fixups: _,
            bubbles: _,
            interface,
            conservation: _,
            cut: _,
            ticker,
            probes,
            faces: _,
            wall_pressures,
            // Made anew after each step.
            wall_shears: _,
            wall_heat: _,
            film: _,
            seen,
            cells_per_radius: _,
            ambient_pressure: _,
        } = self;
        FluidRecordState {
            files: files.saved(),
            interface: interface.as_ref().map(InterfaceHistory::saved),
            ticker: *ticker,
            probes: saved_probes(probes),
            wall_pressures: wall_pressures.clone(),
            seen: seen.clone(),
        }
    }
}
