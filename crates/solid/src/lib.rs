//! The linear-elastic solid: materials, elastic waves, yield criterion, `SolidSolver`.

mod material;
mod options;

pub use material::{Material, MaterialError};
pub use options::{Boundary, InitialStress, PotentialPulse};
