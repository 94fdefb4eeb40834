//! The linear-elastic solid: materials, elastic waves, yield criterion, [`SolidSolver`].
//!
//! The algorithm of a step reads in one place, `step/mod.rs`, stage by stage.

#![forbid(unsafe_code)]

mod absorbing;
mod analysis;
mod boundary;
mod diagnostics;
#[cfg(test)]
mod eigen;
mod error;
mod initial;
mod ledger;
mod material;
mod model;
mod options;
mod outer_states;
mod participant;
mod physics;
pub mod plasticity;
mod predictor;
mod reflux;
mod report;
pub mod riemann;
mod rows;
mod setup;
mod solver;
mod state;
mod step;
mod update;
mod yield_criterion;

pub use diagnostics::{CELL_FIELDS, MisesPeak, Snapshot, Totals};
pub use error::SolidError;
pub use ledger::BoundaryLedger;
pub use material::{Material, MaterialError};
pub use options::{Boundary, InitialStress, PotentialPulse};
pub use participant::{SurfaceTrace, WeakExchange};
pub use physics::Solid;
pub use riemann::WaveSpeeds;
pub use setup::SolidSetup;
pub use solver::{SolidSolver, SolidState};
pub use state::ElasticState;
pub use yield_criterion::{von_mises, yield_function};
