//! What a user says about adaptation; the machinery is in `patch.rs`, `marks.rs` and `remap.rs`.

use crate::Side;

/// How a grid adapts.
#[derive(Clone, Debug, PartialEq)]
pub struct Adaptation {
    /// Threshold ε of the details on the finest level, relative to each field's reference value; on level ℓ of
    /// L it is ε 2^(ℓ − L).
    pub epsilon: f64,
    /// Steps between two adaptations.
    pub every: u32,
    /// Bounds of the level, all of which hold.
    pub bounds: Vec<LevelBound>,
}

/// Bounds the level of the blocks that meet a zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelBound {
    /// Where.
    pub zone: Zone,
    /// The coarsest level admitted there.
    pub at_least: u8,
    /// The finest level admitted there; where blocks meet a finer demand by grading, grading wins.
    pub at_most: u8,
}

/// A part of the (z, r) plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Zone {
    /// Within a circle.
    Within {
        /// Centre (z, r), m.
        centre: [f64; 2],
        /// Radius, m.
        radius: f64,
    },
    /// All but a circle.
    Beyond {
        /// Centre (z, r), m.
        centre: [f64; 2],
        /// Radius, m.
        radius: f64,
    },
    /// A rectangle.
    Box {
        /// Range in z, m.
        z: [f64; 2],
        /// Range in r, m.
        r: [f64; 2],
    },
    /// The blocks along a side of the domain.
    Along(Side),
}
