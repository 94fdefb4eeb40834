//! The linear-elastic solid: materials, elastic waves, yield criterion, [`SolidSolver`].
//!
//! The algorithm of a step reads in one place, `block.rs`.

mod block;
mod boundary;
mod diagnostics;
mod error;
mod material;
mod options;
mod participant;
mod rows;
mod solver;
mod state;

pub use boundary::SurfaceState;
pub use diagnostics::{MisesPeak, Snapshot, Totals};
pub use error::SolidError;
pub use material::{Material, MaterialError};
pub use options::{Boundary, InitialStress, PotentialPulse};
pub use participant::{Interface, SurfaceTrace};
pub use solver::{BoundaryLedger, SolidSetup, SolidSolver};
pub use state::ElasticState;

/// x
pub fn von_mises(zz: f64, rr: f64, pp: f64, zr: f64) -> f64 {
    (0.5 * ((zz - rr) * (zz - rr) + (zz - pp) * (zz - pp) + (rr - pp) * (rr - pp)) + 3.0 * zr * zr).sqrt()
}
