//! What crossed the sides, and what plastic flow took.

use serde::{Deserialize, Serialize};

/// What crossed the sides of the domain since the start, inwards, in the order of [`mesh::Side::ALL`].
///
/// Per radian in axial symmetry, per metre of depth in planar geometry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BoundaryLedger {
    /// Axial momentum (the impulse of the tractions), N s.
    pub momentum: [f64; 4],
    /// Energy (the work of the tractions), J.
    pub energy: [f64; 4],
}

/// What plastic flow did since the start, added up; zeros where nothing can yield.
///
/// Energies per radian in axial symmetry, per metre of depth in planar geometry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PlasticLedger {
    /// Returns of cells onto their yield surface, step by step.
    pub returns: u64,
    /// Of these, those that followed a correction along a level jump or a change of the grid, not a step.
    pub after_corrections: u64,
    /// Plastic work ∫ q dε_p by backward Euler, J: what heats, and what a balance of energy has to count.
    pub work: f64,
    /// Largest rate of plastic strain in a step of a cell, 1/s.
    pub rate_peak: f64,
}
