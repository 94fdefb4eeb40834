//! The linear-elastic solid: materials, elastic waves, yield criterion, `SolidSolver`.

mod options;

pub use options::{Boundary, InitialStress, PotentialPulse};
