//! What has changed phase, as the summary has it.

use fluid::FluidSolver;
use mesh::BLOCK;
use serde_json::{Value, json};

/// Masses in the whole domain, where the phases can change into each other; else nothing.
pub fn summary(solver: &FluidSolver<BLOCK>) -> Vec<(String, Value)> {
    if !solver.changes_phase() {
        return Vec::new();
    }
    let (phases, turn) = (solver.phase_ledger(), solver.mesh().domain().geometry.turn());
    let of = |name: &str, value: Value| (name.to_owned(), value);
    vec![
        of("evaporated_mass", json!(turn * phases.evaporated)),
        of("condensed_mass", json!(turn * phases.condensed)),
        of("cavitated_mass", json!(turn * phases.opened_mass)),
        of("cavitated_cell_steps", json!(phases.opened)),
    ]
}
