//! The quadtree of blocks: leaves in Morton order and their neighbours.

/// A block's place: its refinement level and its position in units of blocks on that level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
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
}

/// A forest of quadtrees over a grid of root blocks, seen through its leaves.
///
/// Leaves are kept in Morton order; the position of a leaf in that order is its *slot*, and all data of
/// blocks are laid out by slot. A coarsest grid smaller than a block only means that the roots sit higher
/// than level 0.
#[derive(Clone, Debug)]
pub struct Quadtree {
    root_level: u8,
    roots: [u32; 2],
    periodic: [bool; 2],
    leaves: Vec<BlockId>,
    neighbours: Vec<[Neighbour; 8]>,
}

impl Quadtree {
    /// A tree whose leaves all lie on `level`.
    ///
    /// - `roots`: blocks along z and r on `root_level`; `periodic`: whether opposite sides meet, per axis.
    /// - panics if `level < root_level` or a count is zero: the caller's arithmetic is wrong.
    pub fn uniform(root_level: u8, roots: [u32; 2], level: u8, periodic: [bool; 2]) -> Self {
        assert!(level >= root_level && roots[0] > 0 && roots[1] > 0, "no blocks");
        let scale = 1u32 << (level - root_level);
        let mut leaves: Vec<BlockId> = (0..roots[1] * scale)
            .flat_map(|j| (0..roots[0] * scale).map(move |i| BlockId { level, i, j }))
            .collect();
        leaves.sort_by_key(morton);
        let mut tree = Self { root_level, roots, periodic, leaves, neighbours: Vec::new() };
        tree.neighbours = tree.leaves.iter().map(|id| Offset::ALL.map(|o| tree.find(*id, o))).collect();
        tree
    }

    /// The leaves in the order of their slots.
    pub fn leaves(&self) -> &[BlockId] {
        &self.leaves
    }

    /// What lies around the leaf in `slot`, in the order of [`Offset::ALL`].
    pub fn neighbours(&self, slot: usize) -> &[Neighbour; 8] {
        &self.neighbours[slot]
    }

    /// Blocks along z and r on `level`.
    pub fn blocks_on(&self, level: u8) -> [u32; 2] {
        self.roots.map(|n| n << (level - self.root_level))
    }

    /// The slot of a leaf; `None` if there is no such leaf.
    pub fn slot(&self, id: BlockId) -> Option<usize> {
        self.leaves.binary_search_by_key(&morton(&id), morton).ok()
    }

    fn find(&self, id: BlockId, offset: Offset) -> Neighbour {
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
        match there {
            None => Neighbour::Boundary,
            Some((i, j)) => {
                let slot = self.slot(BlockId { level: id.level, i, j });
                Neighbour::Same(slot.expect("a uniform tree has a leaf wherever the domain is"))
            }
        }
    }
}

/// The Morton (Z-order) key of a block on its own level: bits of i and j interleaved.
fn morton(id: &BlockId) -> u64 {
    spread(id.i) | (spread(id.j) << 1)
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
            let tree = Quadtree::uniform(2, [3, 2], 4, periodic);
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
    fn slots_follow_morton_order() {
        let tree = Quadtree::uniform(0, [2, 2], 1, [false, false]);
        let first: Vec<_> = tree.leaves()[..4].iter().map(|b| (b.i, b.j)).collect();
        assert_eq!(first, [(0, 0), (1, 0), (0, 1), (1, 1)]);
        for (slot, id) in tree.leaves().iter().enumerate() {
            assert_eq!(tree.slot(*id), Some(slot));
        }
        assert_eq!(tree.slot(BlockId { level: 1, i: 4, j: 0 }), None);
    }
}
