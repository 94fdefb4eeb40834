//! Levels above those that details may ask for, next to the wall: where a shock is about to hit it, and where the film of liquid
//! between gas and wall is thin.
//!
//! A captured front is two to three cells wide whatever their width, so a wave whose pressure falls fast behind its front loses
//! as much of its peak as the front is wide; where it enters finer cells it steepens at once. What fine cells on the last
//! millimetres cost is small, as they are there only while the front is.

pub(crate) mod expected;
pub(crate) mod film;
pub(crate) mod shock;

use mesh::{BlockId, Field, Mesh, Side};

use crate::Mixture;

/// How deep the layer along the wall is in which blocks may rise, in cells of the finest level that details may ask for.
const DEPTH: f64 = 8.0;

/// How far blocks next to the wall may rise above the levels that details may ask for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NearWall {
    /// Pressure relative to which a front is a shock, where the pressure before it is lower, Pa.
    pub reference_pressure: f64,
    /// Levels where a shock is about to hit the wall.
    pub shock_levels: u8,
    /// Levels where the film of liquid between gas and wall is thinner than [`NearWall::film_cells`].
    pub film_levels: u8,
    /// Cells that the film should have across.
    pub film_cells: u8,
}

impl NearWall {
    /// How far blocks may rise at all.
    pub fn levels(&self) -> u8 {
        self.shock_levels.max(self.film_levels)
    }
}

/// A rectangle in the (z, r) plane by its lower and upper corner, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rectangle {
    pub low: [f64; 2],
    pub high: [f64; 2],
}

impl Rectangle {
    /// That of a block.
    fn of<const N: usize>(mesh: &Mesh<N>, id: BlockId) -> Self {
        let (low, widths) = (mesh.origin(id), mesh.widths(id.level));
        Self { low, high: [0, 1].map(|axis| low[axis] + N as f64 * widths[axis]) }
    }

    fn meets(&self, other: &Self) -> bool {
        (0..2).all(|axis| self.low[axis] < other.high[axis] && self.high[axis] > other.low[axis])
    }
}

/// The level that shocks and films demand of each block, 0 if they demand none above `base`.
///
/// A block's ancestor (or itself) on each level from `base` on is looked at, coarsest first: so a block once refined stays so as
/// long as what asked for it is there, wherever in the block that is.
///
/// - `base`: the finest level that details may ask for; `travel`: how many of its cells a wave in the block of a slot crosses before
///   the marks are made anew.
pub(crate) fn demanded_levels<const N: usize>(
    near: &NearWall,
    (mesh, field, mixture): (&Mesh<N>, &Field, &Mixture),
    base: u8,
    travel: &(dyn Fn(usize) -> f64 + Sync),
) -> Vec<u8> {
    let h_z = mesh.widths(base)[0];
    let wall = mesh.domain().z[0];
    let depth = DEPTH * h_z;
    let shocks = if near.shock_levels > 0 {
        // Blocks begin to rise when the front is a few cells before the layer's coarsest blocks.
        let farthest = wall + (2.0 * N as f64) * h_z;
        shock::steep_places((mesh, field, mixture), base, farthest, near.reference_pressure, travel)
    } else {
        Vec::new()
    };
    let films = if near.film_levels > 0 {
        film::columns((mesh, field), &mesh.blocks_along(Side::ZMin), |_| f64::from(near.film_cells) * h_z)
    } else {
        Vec::new()
    };
    let rises = |id: BlockId| {
        let block = Rectangle::of(mesh, id);
        let above = id.level - base;
        let is_near = block.low[0] - wall < depth;
        let has_shock = || shocks.iter().any(|shock| shock.meets(&block));
        let has_film = || {
            let least = f64::from(near.film_cells) * mesh.widths(id.level)[0];
            films.iter().any(|film| film.is_in(&block, wall) && film.thickness < least)
        };
        is_near && (above < near.shock_levels && has_shock() || above < near.film_levels && has_film())
    };
    let demand = |id: &BlockId| {
        let mut demanded = 0;
        for level in base..=id.level {
            let coarser = id.level - level;
            if !rises(BlockId { level, i: id.i >> coarser, j: id.j >> coarser }) {
                break;
            }
            demanded = level + 1;
        }
        demanded
    };
    mesh.tree().leaves().iter().map(demand).collect()
}
