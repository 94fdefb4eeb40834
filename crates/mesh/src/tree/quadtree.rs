//! The quadtree of blocks: leaves in Morton order and their neighbours.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::Tile;

/// A block's place: its refinement level and its position in units of blocks on that level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct BlockId {
    /// Refinement level; level ℓ has 2^ℓ times the coarsest grid's cells in each direction.
    pub level: u8,
    /// Position along z.
    pub i: u32,
    /// Position along r.
    pub j: u32,
}

/// One of the eight directions in which a block has a neighbour, as steps (along z, along r).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Offset {
    /// −1, 0 or 1 along z.
    pub i: i8,
    /// −1, 0 or 1 along r.
    pub j: i8,
}

impl Offset {
    /// All eight: sides first, then corners.
    pub const ALL: [Self; 8] = [
        Self { i: -1, j: 0 },
        Self { i: 1, j: 0 },
        Self { i: 0, j: -1 },
        Self { i: 0, j: 1 },
        Self { i: -1, j: -1 },
        Self { i: 1, j: -1 },
        Self { i: -1, j: 1 },
        Self { i: 1, j: 1 },
    ];
}

/// What lies beyond one side or corner of a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Neighbour {
    /// The domain ends there.
    Boundary,
    /// A leaf of the same level, by its slot.
    Same(usize),
    /// A leaf one level coarser.
    Coarser(usize),
    /// The leaves one level finer that touch: beyond a side the two along it in ascending order, beyond a corner
    /// the one there, twice.
    Finer([usize; 2]),
}

impl Neighbour {
    /// The slots of its leaves.
    pub fn slots(&self) -> impl Iterator<Item = usize> + use<> {
        let [first, second] = match *self {
            Self::Boundary => [None; 2],
            Self::Same(slot) | Self::Coarser(slot) => [Some(slot), None],
            Self::Finer([a, b]) => [Some(a), Some(b)],
        };
        first.into_iter().chain(second)
    }
}

/// A forest of quadtrees over a grid of root blocks, seen through its leaves.
///
/// Leaves are kept in Morton order; the position of a leaf in that order is its *slot*, and all data of
/// blocks are laid out by slot. Neighbours, corners included, differ by one level at most. A coarsest grid
/// smaller than a block only means that the roots sit higher than level 0.
#[derive(Clone, Debug)]
pub struct Quadtree {
    root_level: u8,
    finest: u8,
    roots: [u32; 2],
    periodic: [bool; 2],
    leaves: Vec<BlockId>,
    keys: Vec<u64>,
    neighbours: Vec<[Neighbour; 8]>,
    tiles: Vec<Tile>,
}

impl Quadtree {
    /// A tree whose leaves all lie on `level`, which may be refined up to level `finest`.
    ///
    /// - `roots`: blocks along z and r on `root_level`; `periodic`: whether opposite sides meet, per axis.
    /// - panics if the levels do not ascend or a count is zero: the caller's arithmetic is wrong.
    pub fn uniform(root_level: u8, roots: [u32; 2], level: u8, finest: u8, periodic: [bool; 2]) -> Self {
        assert!(root_level <= level && level <= finest && roots[0] > 0 && roots[1] > 0, "no blocks");
        let scale = 1u32 << (level - root_level);
        let mut leaves: Vec<BlockId> = (0..roots[1] * scale)
            .flat_map(|j| (0..roots[0] * scale).map(move |i| BlockId { level, i, j }))
            .collect();
        leaves.sort_by_key(|id| morton(id, finest));
        let base = Self {
            root_level,
            finest,
            roots,
            periodic,
            leaves: Vec::new(),
            keys: Vec::new(),
            neighbours: Vec::new(),
            tiles: Vec::new(),
        };
        base.with_leaves(leaves)
    }

    /// The same forest with other leaves: in Morton order, without gaps or overlaps, neighbours one level apart
    /// at most.
    pub(crate) fn with_leaves(&self, leaves: Vec<BlockId>) -> Self {
        let keys: Vec<u64> = leaves.iter().map(|id| morton(id, self.finest)).collect();
        debug_assert!(keys.windows(2).all(|pair| pair[0] < pair[1]), "leaves are in Morton order");
        let mut tree = Self { tiles: Tile::all(&leaves), leaves, keys, ..self.shell() };
        tree.neighbours = (tree.leaves.par_iter())
            .with_min_len(64)
            .map(|id| Offset::ALL.map(|offset| tree.find(*id, offset)))
            .collect();
        tree
    }

    /// [`Quadtree::with_leaves`] for leaves that come from elsewhere; `None` if they are no such leaves.
    pub(crate) fn with_foreign_leaves(&self, leaves: Vec<BlockId>) -> Option<Self> {
        let within = |id: &BlockId| {
            (self.root_level..=self.finest).contains(&id.level) && {
                let [i, j] = self.blocks_on(id.level);
                id.i < i && id.j < j
            }
        };
        if !leaves.iter().all(within) {
            return None;
        }
        // A block's finest cells are one stretch of the order: leaves that do not overlap and have the area of the whole tile
        // it.
        let area = |level: u8| 1_u64 << (2 * u32::from(self.finest - level));
        let keys: Vec<u64> = leaves.iter().map(|id| morton(id, self.finest)).collect();
        let ends = || keys.iter().zip(&leaves).map(|(key, id)| key + area(id.level));
        let are_apart = ends().zip(keys.iter().skip(1)).all(|(end, next)| end <= *next);
        let whole = area(self.root_level) * self.roots.map(u64::from).iter().product::<u64>();
        if !are_apart || leaves.iter().map(|id| area(id.level)).sum::<u64>() != whole {
            return None;
        }
        let tree = Self { leaves, keys, ..self.shell() };
        let is_graded = |id: &BlockId| {
            let coarsest = Offset::ALL.iter().filter_map(|offset| tree.place(*id, *offset));
            let slots = coarsest.filter_map(|there| tree.covering(there));
            slots.into_iter().all(|slot| tree.leaves[slot].level + 1 >= id.level)
        };
        if !tree.leaves.iter().all(is_graded) {
            return None;
        }
        Some(self.with_leaves(tree.leaves))
    }

    /// The forest without its leaves.
    fn shell(&self) -> Self {
        Self { leaves: Vec::new(), keys: Vec::new(), neighbours: Vec::new(), tiles: Vec::new(), ..*self }
    }

    /// The leaves in the order of their slots.
    pub fn leaves(&self) -> &[BlockId] {
        &self.leaves
    }

    /// The level of the roots: no leaf is coarser.
    pub fn root_level(&self) -> u8 {
        self.root_level
    }

    /// The finest level a leaf may have.
    pub fn finest(&self) -> u8 {
        self.finest
    }

    /// What lies around the leaf in `slot`, in the order of [`Offset::ALL`].
    pub fn neighbours(&self, slot: usize) -> &[Neighbour; 8] {
        &self.neighbours[slot]
    }

    /// All leaves, those together that are siblings; in the order of their slots.
    pub fn tiles(&self) -> &[Tile] {
        &self.tiles
    }

    /// Whether opposite sides meet, along z and r.
    pub fn periodic(&self) -> [bool; 2] {
        self.periodic
    }

    /// Blocks along z and r on `level`.
    pub fn blocks_on(&self, level: u8) -> [u32; 2] {
        self.roots.map(|n| n << (level - self.root_level))
    }

    /// The slot of a leaf; `None` if there is no such leaf.
    pub fn slot(&self, id: BlockId) -> Option<usize> {
        self.covering(id).filter(|slot| self.leaves[*slot] == id)
    }

    /// The slot of the leaf that is the block `id` or contains it, or the first of those within it; `None`
    /// outside the domain.
    pub fn covering(&self, id: BlockId) -> Option<usize> {
        let extent = self.blocks_on(id.level);
        if id.i >= extent[0] || id.j >= extent[1] {
            return None;
        }
        // The leaves tile the domain, so one of them holds the first finest block of `id`.
        self.keys.partition_point(|key| *key <= morton(&id, self.finest)).checked_sub(1)
    }

    /// The block of the same level beyond a side or corner; `None` outside the domain.
    fn place(&self, id: BlockId, offset: Offset) -> Option<BlockId> {
        let extent = self.blocks_on(id.level);
        let place = |at: u32, step: i8, extent: u32, periodic: bool| -> Option<u32> {
            let moved = i64::from(at) + i64::from(step);
            if periodic {
                u32::try_from(moved.rem_euclid(i64::from(extent))).ok()
            } else {
                u32::try_from(moved).ok().filter(|m| *m < extent)
            }
        };
        let there = place(id.i, offset.i, extent[0], self.periodic[0]).zip(place(
            id.j,
            offset.j,
            extent[1],
            self.periodic[1],
        ));
        there.map(|(i, j)| BlockId { level: id.level, i, j })
    }

    fn find(&self, id: BlockId, offset: Offset) -> Neighbour {
        let Some(there) = self.place(id, offset) else { return Neighbour::Boundary };
        let slot = self.covering(there).expect("the place is within the domain");
        match self.leaves[slot].level {
            level if level == id.level => Neighbour::Same(slot),
            level if level < id.level => Neighbour::Coarser(slot),
            _ => {
                // The children on the side that faces this block.
                let facing = |step: i8, child: u32| match step {
                    -1 => 1,
                    1 => 0,
                    _ => child,
                };
                Neighbour::Finer([0, 1].map(|child| {
                    let (a, b) = (facing(offset.i, child), facing(offset.j, child));
                    let child = BlockId { level: id.level + 1, i: 2 * there.i + a, j: 2 * there.j + b };
                    self.slot(child).expect("neighbours are one level apart at most")
                }))
            }
        }
    }
}

/// The Morton (Z-order) key of a block's first cell on level `finest`: bits of i and j interleaved.
fn morton(id: &BlockId, finest: u8) -> u64 {
    let shift = finest - id.level;
    spread(id.i << shift) | (spread(id.j << shift) << 1)
}

fn spread(x: u32) -> u64 {
    let mut x = u64::from(x);
    x = (x | (x << 16)) & 0x0000_ffff_0000_ffff;
    x = (x | (x << 8)) & 0x00ff_00ff_00ff_00ff;
    x = (x | (x << 4)) & 0x0f0f_0f0f_0f0f_0f0f;
    x = (x | (x << 2)) & 0x3333_3333_3333_3333;
    (x | (x << 1)) & 0x5555_5555_5555_5555
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_leaf_is_its_neighbours_neighbour() {
        for periodic in [[false, false], [true, false], [true, true]] {
            let tree = Quadtree::uniform(2, [3, 2], 4, 4, periodic);
            assert_eq!(tree.leaves().len(), 12 * 8);
            for slot in 0..tree.leaves().len() {
                for (k, offset) in Offset::ALL.iter().enumerate() {
                    let back = Offset { i: -offset.i, j: -offset.j };
                    let kb = Offset::ALL.iter().position(|o| *o == back).unwrap();
                    if let Neighbour::Same(other) = tree.neighbours(slot)[k] {
                        assert_eq!(tree.neighbours(other)[kb], Neighbour::Same(slot));
                    } else {
                        let id = tree.leaves()[slot];
                        let outside = |at: u32, step: i8, n: u32, periodic: bool| {
                            !periodic && ((at == 0 && step < 0) || (at + 1 == n && step > 0))
                        };
                        assert!(
                            outside(id.i, offset.i, 12, periodic[0])
                                || outside(id.j, offset.j, 8, periodic[1])
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn leaves_from_elsewhere_are_taken_only_if_they_tile_the_domain_in_order_and_are_graded() {
        let tree = Quadtree::uniform(1, [3, 2], 2, 4, [true, false]);
        let refined = |tree: &Quadtree, slot: usize| {
            let id = tree.leaves()[slot];
            let mut leaves = tree.leaves().to_vec();
            let child = |k: u32| BlockId { level: id.level + 1, i: 2 * id.i + k % 2, j: 2 * id.j + k / 2 };
            leaves.splice(slot..=slot, (0..4).map(child));
            leaves
        };
        let good = tree.with_foreign_leaves(refined(&tree, 5)).expect("one level finer");
        assert_eq!(good.neighbours, tree.with_leaves(refined(&tree, 5)).neighbours);
        let two_finer = (0..4).find_map(|k| good.with_foreign_leaves(refined(&good, 5 + k)));
        assert!(two_finer.is_none(), "its coarse neighbours are two levels coarser");

        let change = |change: &dyn Fn(&mut Vec<BlockId>)| {
            let mut leaves = tree.leaves().to_vec();
            change(&mut leaves);
            tree.with_foreign_leaves(leaves).is_some()
        };
        assert!(change(&|_| {}));
        assert!(!change(&|leaves| leaves.swap(3, 4)), "out of order");
        assert!(!change(&|leaves| leaves.truncate(5)), "a gap");
        assert!(!change(&|leaves| leaves[7] = leaves[6]), "twice the same");
        assert!(!change(&|leaves| leaves[0].level = 9), "a level there is not");
        assert!(!change(&|leaves| leaves[0].level = 0), "coarser than the roots");
        assert!(!change(&|leaves| leaves[2].i = u32::MAX), "outside");
        assert!(!change(&|leaves| leaves.clear()), "none");
    }

    #[test]
    fn slots_follow_morton_order() {
        let tree = Quadtree::uniform(0, [2, 2], 1, 1, [false, false]);
        let first: Vec<_> = tree.leaves()[..4].iter().map(|b| (b.i, b.j)).collect();
        assert_eq!(first, [(0, 0), (1, 0), (0, 1), (1, 1)]);
        for (slot, id) in tree.leaves().iter().enumerate() {
            assert_eq!(tree.slot(*id), Some(slot));
        }
        assert_eq!(tree.slot(BlockId { level: 1, i: 4, j: 0 }), None);
    }
}
