//! Blocks of cells on a quadtree: geometry, fields, ghost layers. No physics.

mod geometry;
mod limiter;

pub use geometry::{Geometry, Side};
pub use limiter::Limiter;

/// Cells along each direction of a block.
pub const BLOCK: usize = 16;
