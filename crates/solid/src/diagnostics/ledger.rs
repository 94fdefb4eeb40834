//! What crossed the sides.

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
