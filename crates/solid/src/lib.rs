//! The linear-elastic solid: materials, elastic waves, yield criterion, `SolidSolver`.

pub mod eigen;
mod options;
pub mod riemann;
mod yield_criterion;

pub use options::{Boundary, InitialStress, PotentialPulse};
pub use riemann::WaveSpeeds;
pub use yield_criterion::{von_mises, yield_function};
