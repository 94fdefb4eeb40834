//! The linear-elastic solid: materials, elastic waves, yield criterion, [`SolidSolver`].
//!
//! The algorithm of a step reads in one place, `block.rs`.

#![forbid(unsafe_code)]

mod absorbing;
mod adapt;
mod analysis;
mod block;
mod boundary;
mod diagnostics;
#[cfg(test)]
mod eigen;
mod error;
mod material;
mod options;
mod participant;
mod predictor;
mod reflux;
pub mod riemann;
mod rows;
mod saved;
mod solver;
mod state;
mod steps;
mod update;
mod yield_criterion;

pub use boundary::SurfaceState;
pub use diagnostics::{MisesPeak, Snapshot, Totals};
pub use error::SolidError;
pub use material::{Material, MaterialError};
pub use options::{Boundary, InitialStress, PotentialPulse};
pub use participant::{Interface, SurfaceTrace};
pub use riemann::WaveSpeeds;
pub use saved::SolidState;
pub use solver::{BoundaryLedger, SolidSetup, SolidSolver};
pub use state::ElasticState;
pub use yield_criterion::{von_mises, yield_function};
