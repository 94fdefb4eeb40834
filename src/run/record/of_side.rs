//! What is written of a side, whichever medium it is.

use serde_json::{Map, Value};

use crate::output::{HistoryFile, OutputError};
use crate::run::record::side_files::SideFiles;
use crate::run::schedule::Plan;

/// All that is written of a solver: histories, snapshots, its part of the summary.
pub trait Record: Sized {
    /// Whose record it is.
    type Solver;
    /// What its snapshots hold.
    type Snapshot: mesh::CellSnapshot + 'static;

    /// Takes notice of the state after a step of length `dt`, and writes the rows that are due.
    fn follow(&mut self, solver: &Self::Solver, dt: f64) -> Result<(), OutputError>;
    /// Writes a snapshot.
    fn snapshot(&mut self, solver: &Self::Solver) -> Result<(), OutputError>;
    /// Its part of the summary.
    fn summary(&self, solver: &Self::Solver) -> Map<String, Value>;
    /// Its files.
    fn files(&self) -> &SideFiles<Self::Snapshot>;
    /// Its files, to be written to.
    fn files_mut(&mut self) -> &mut SideFiles<Self::Snapshot>;
    /// With the snapshot of the state at t = 0, all of it in the files.
    fn begun(mut self, solver: &Self::Solver) -> Result<Self, OutputError> {
        self.snapshot(solver)?;
        self.flush()?;
        Ok(self)
    }

    /// Takes notice of a finished step.
    fn after_step(&mut self, solver: &Self::Solver, plan: Plan) -> Result<(), OutputError> {
        self.follow(solver, plan.dt)?;
        if plan.snapshot {
            self.snapshot(solver)?;
        }
        self.files_mut().after_step()
    }

    /// The histories.
    fn history(&self) -> &HistoryFile {
        &self.files().history
    }

    /// Writes a batch of the histories.
    fn flush(&mut self) -> Result<(), OutputError> {
        self.files_mut().history.flush()
    }

    /// Brings everything so far to the disk.
    fn settle(&mut self) -> Result<(), OutputError> {
        self.files_mut().settle()
    }

    /// Writes what is still in memory; after a numerical failure the last good state as a snapshot, too.
    fn close(&mut self, solver: &Self::Solver, failed: bool) -> Result<(), OutputError> {
        if failed {
            self.snapshot(solver)?;
        }
        self.files_mut().close()
    }
}
