//! Which files the fluid's side writes, and which fields.

use fluid::FluidSolver;
use mesh::BLOCK;

use crate::output::run_directory::{FLUID_FIELDS, FLUID_HISTORY};
use crate::run::record::side_files::SideNames;

/// The files of the record, and the fields that the fluid has.
pub(super) fn names(solver: &FluidSolver<BLOCK>) -> SideNames<fluid::Snapshot> {
    let fields = fluid::CELL_FIELDS.iter().filter(|field| solver.has_field(field.name));
    SideNames { history: FLUID_HISTORY, snapshots: FLUID_FIELDS, fields: fields.collect() }
}
