//! The solid: materials, elastic waves, yield criterion, plasticity, [`SolidSolver`].
//!
//! The algorithm of a step reads in one place, `step/mod.rs`, stage by stage.

#![forbid(unsafe_code)]

mod analysis;
mod boundary;
mod components;
mod diagnostics;
mod error;
mod initial;
mod material;
mod model;
mod options;
mod physics;
pub mod plasticity;
mod reconstruction;
pub mod riemann;
mod setup;
mod solver;
mod state;
mod step;
mod terms;

pub use boundary::coming::ComingWaves;
pub use boundary::participant::{SurfaceTrace, WeakExchange};
pub use diagnostics::ledger::{BoundaryLedger, PlasticLedger};
pub use diagnostics::plastic::PlasticZone;
pub use diagnostics::strain_peak::StrainPeak;
pub use diagnostics::{CELL_FIELDS, MisesPeak, Snapshot, Totals};
pub use error::SolidError;
pub use initial::half_space::{Harmonic, half_space_stress};
pub use material::yield_criterion::{von_mises, yield_function};
pub use material::{Material, MaterialError, MaterialHeat};
pub use options::{Boundary, InitialStress, PotentialPulse};
pub use physics::Solid;
pub use riemann::WaveSpeeds;
pub use setup::SolidSetup;
pub use solver::{SolidSolver, SolidState};
pub use state::ElasticState;
pub use terms::weight::Weight;
