//! What a user says about adaptation; the machinery is in `patch.rs`, `marks.rs` and `remap.rs`.

use std::borrow::Cow;

use crate::{Domain, Side};

/// How a grid adapts.
#[derive(Clone, Debug, PartialEq)]
pub struct Adaptation {
    /// Threshold ε of the details on level L, the finest that details may ask for, relative to each field's reference value; on level
    /// ℓ it is ε 2^(ℓ − L).
    pub epsilon: f64,
    /// Steps between two adaptations.
    pub every: u32,
    /// Bounds of the level, all of which hold.
    pub bounds: Vec<LevelBound>,
    /// How many levels the tree has above L: blocks rise to them only where something besides the details demands it.
    pub above: u8,
    /// Where the answer is, if not everywhere: elsewhere only waves that run towards it count.
    pub interest: Option<RegionOfInterest>,
}

/// A circle in the (z, r) plane; what happens in it is the answer that a run is made for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegionOfInterest {
    /// Centre (z, r), m.
    pub centre: [f64; 2],
    /// Radius, m.
    pub radius: f64,
}

impl RegionOfInterest {
    /// The distance of a rectangle from the circle's centre, m; 0 if that is in it.
    ///
    /// - `low`, `high`: its corners (z, r), m.
    pub fn distance(&self, low: [f64; 2], high: [f64; 2]) -> f64 {
        distance(self.centre, low, high)
    }

    /// The direction from a block to the region: the unit vector from its middle to the circle's centre; `None` if the block has points
    /// in the circle.
    ///
    /// - `low`, `high`: the block's corners (z, r), m.
    pub fn direction_from(&self, low: [f64; 2], high: [f64; 2]) -> Option<[f64; 2]> {
        if self.distance(low, high) < self.radius {
            return None;
        }
        let way = [0, 1].map(|axis| self.centre[axis] - 0.5 * (low[axis] + high[axis]));
        let length = way[0].hypot(way[1]);
        Some(way.map(|part| part / length))
    }
}

impl Adaptation {
    /// By details alone, everywhere alike: threshold ε, and steps between two adaptations.
    pub const fn by_details(epsilon: f64, every: u32) -> Self {
        Self { epsilon, every, bounds: Vec::new(), above: 0, interest: None }
    }

    /// L, the finest level that details may ask for, of a tree whose finest is `finest`.
    pub fn base(&self, finest: u8) -> u8 {
        finest.saturating_sub(self.above)
    }

    /// The same with details that may ask for no level finer than `base`, in a tree whose finest is `finest`.
    pub fn ending_at(&self, base: u8, finest: u8) -> Cow<'_, Self> {
        if base >= self.base(finest) {
            return Cow::Borrowed(self);
        }
        Cow::Owned(Self { above: finest - base, ..self.clone() })
    }
}

/// The distance of a point from a rectangle with the corners `low` and `high`, m.
fn distance(point: [f64; 2], low: [f64; 2], high: [f64; 2]) -> f64 {
    let to_nearest = [0, 1].map(|axis| point[axis].clamp(low[axis], high[axis]) - point[axis]);
    to_nearest[0].hypot(to_nearest[1])
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

impl Zone {
    /// Whether a block has points in the zone; for zones that bound from above that is what keeps them whole.
    ///
    /// - `low`, `high`: the block's corners (z, r), m; `widths`: of its cells, m; `domain`: where the grid is.
    pub fn meets(&self, low: [f64; 2], high: [f64; 2], widths: [f64; 2], domain: &Domain) -> bool {
        match self {
            Self::Within { centre, radius } => distance(*centre, low, high) < *radius,
            // A block is beyond the circle when all of it is: else the circle's rim could never be refined.
            Self::Beyond { centre, radius } => distance(*centre, low, high) >= *radius,
            Self::Box { z, r } => z[0] < high[0] && z[1] > low[0] && r[0] < high[1] && r[1] > low[1],
            Self::Along(side) => {
                let Domain { z, r, .. } = domain;
                let at = |a: f64, b: f64, h: f64| (a - b).abs() < 0.5 * h;
                match side {
                    Side::ZMin => at(low[0], z[0], widths[0]),
                    Side::ZMax => at(high[0], z[1], widths[0]),
                    Side::RMin => at(low[1], r[0], widths[1]),
                    Side::RMax => at(high[1], r[1], widths[1]),
                }
            }
        }
    }
}
