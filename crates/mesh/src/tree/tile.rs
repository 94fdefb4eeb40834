//! Tiles: blocks that are stepped as one.

use std::ops::Range;

use crate::{BlockId, Frame, Mesh, Neighbour, Offset, Side};

/// A block, or four siblings: as one they have fewer ghosts than each by itself. Of four blocks of 16² cells these are 576, of the
/// four together 272.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    first: usize,
    /// Blocks along a side: 1 or 2.
    along: usize,
}

impl Tile {
    /// The most cells along a side of a tile: more do not stay in the second-level cache from stage to stage.
    pub const MOST_CELLS: usize = 32;

    /// Whether four blocks of N × N cells fit into one.
    pub const fn holds_four<const N: usize>() -> bool {
        2 * N <= Self::MOST_CELLS
    }

    /// A block by itself.
    pub const fn one(slot: usize) -> Self {
        Self { first: slot, along: 1 }
    }

    /// All of a tree in the order of the slots.
    pub(crate) fn all(leaves: &[BlockId]) -> Vec<Self> {
        let mut tiles = Vec::with_capacity(leaves.len() / 2);
        let mut slot = 0;
        while let Some(id) = leaves.get(slot) {
            let is_sibling = |(number, other): (u32, &BlockId)| {
                *other == BlockId { i: id.i + number % 2, j: id.j + number / 2, ..*id }
            };
            let begins = id.i.is_multiple_of(2) && id.j.is_multiple_of(2);
            let four = leaves.get(slot..slot + 4).filter(|_| begins);
            let is_four = four.is_some_and(|four| (0..).zip(four).all(is_sibling));
            let tile = Self { first: slot, along: if is_four { 2 } else { 1 } };
            slot += tile.blocks();
            tiles.push(tile);
        }
        tiles
    }

    /// The slot of its first block, that with the smallest coordinates.
    #[inline(always)]
    pub const fn first(&self) -> usize {
        self.first
    }

    /// Whether it is a block by itself.
    #[inline(always)]
    pub const fn is_one(&self) -> bool {
        self.along == 1
    }

    /// How many blocks it has.
    #[inline(always)]
    pub const fn blocks(&self) -> usize {
        self.along * self.along
    }

    /// The slots of its blocks: along z first, then along r.
    #[inline(always)]
    pub fn slots(&self) -> Range<usize> {
        self.first..self.first + self.blocks()
    }

    /// Where its block of that number is: blocks along z and r.
    #[inline(always)]
    pub const fn place(&self, number: usize) -> [usize; 2] {
        [number % self.along, number / self.along]
    }

    /// Where its cells lie in padded rows.
    #[inline(always)]
    pub const fn frame<const N: usize>(&self) -> Frame {
        Frame::of(self.along * N)
    }

    /// Where the cells of its block of that number lie there.
    #[inline(always)]
    pub const fn frame_of<const N: usize>(&self, number: usize) -> Frame {
        self.frame::<N>().part(N, self.place(number))
    }

    /// The slots of its blocks on a side, along it.
    pub fn slots_on(&self, side: Side) -> impl Iterator<Item = usize> + use<> {
        let (first, step) = match side {
            Side::ZMin => (self.first, self.along),
            Side::ZMax => (self.first + self.along - 1, self.along),
            Side::RMin => (self.first, 1),
            Side::RMax => (self.first + self.along * (self.along - 1), 1),
        };
        (0..self.along).map(move |number| first + number * step)
    }

    /// The slot of its first block on a side.
    pub const fn first_on(&self, side: Side) -> usize {
        match side {
            Side::ZMin | Side::RMin => self.first,
            Side::ZMax => self.first + self.along - 1,
            Side::RMax => self.first + self.along * (self.along - 1),
        }
    }

    /// Whether what lies in a direction from one of its blocks is beyond the tile, and not beside another block of it.
    pub const fn is_outward(&self, number: usize, offset: Offset) -> bool {
        const fn leaves(place: usize, step: i8, along: usize) -> bool {
            match step {
                -1 => place == 0,
                0 => true,
                _ => place + 1 == along,
            }
        }
        let [i, j] = self.place(number);
        leaves(i, offset.i, self.along) && leaves(j, offset.j, self.along)
    }
}

impl<const N: usize> Mesh<N> {
    /// The first block of a tile.
    pub fn first_of(&self, tile: Tile) -> BlockId {
        self.tree().leaves()[tile.first]
    }

    /// Whether a tile touches a side of the domain.
    pub fn tile_touches(&self, tile: Tile, side: Side) -> bool {
        self.touches(tile.first_on(side), side)
    }

    /// What lies around a tile: the number of the block that it lies beside, the direction, and the neighbour there.
    pub(crate) fn around(&self, tile: Tile) -> impl Iterator<Item = (usize, Offset, Neighbour)> {
        tile.slots().enumerate().flat_map(move |(number, slot)| {
            let all = Offset::ALL.into_iter().zip(*self.tree().neighbours(slot));
            all.filter(move |(offset, _)| tile.is_outward(number, *offset))
                .map(move |(offset, neighbour)| (number, offset, neighbour))
        })
    }

    /// Fills a padded row of a tile with 1/r at the cells' centres, in planar geometry with 0.
    pub fn inverse_radii(&self, tile: Tile, cells: &mut [f64]) {
        let (id, frame) = (self.first_of(tile), tile.frame::<N>());
        let rows = cells[..frame.len()].chunks_exact_mut(frame.stride());
        for (j, row) in (-(crate::GHOSTS as isize)..).zip(rows) {
            row.fill(self.inverse_radius(id, j));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Domain, Geometry, Quadtree};

    fn mesh(cells: [usize; 2]) -> Mesh<8> {
        let domain = Domain { geometry: Geometry::Planar, z: [0.0, 1.0], r: [0.0, 1.0] };
        Mesh::uniform(domain, cells, 0, [false; 2]).expect("a mesh")
    }

    #[test]
    fn four_siblings_make_a_tile_and_blocks_without_siblings_one_each() {
        // Five by four blocks: the last column has no siblings along z.
        let mesh = mesh([40, 32]);
        let tiles = mesh.tree().tiles();
        let count = |blocks: usize| tiles.iter().filter(|tile| tile.blocks() == blocks).count();
        assert_eq!([count(4), count(1)], [4, 4]);
        let slots: Vec<usize> = tiles.iter().flat_map(Tile::slots).collect();
        assert_eq!(slots, Vec::from_iter(0..20), "each block once, in order");
        for tile in tiles {
            for (number, slot) in tile.slots().enumerate() {
                let (id, [i, j]) = (mesh.tree().leaves()[slot], tile.place(number));
                let first = mesh.first_of(*tile);
                assert_eq!([id.i, id.j], [first.i + i as u32, first.j + j as u32]);
            }
            for side in Side::ALL {
                assert_eq!(tile.slots_on(side).next(), Some(tile.first_on(side)));
            }
        }
    }

    #[test]
    fn a_refined_block_leaves_its_siblings_alone_and_its_children_together() {
        let tree = Quadtree::uniform(2, [1, 1], 4, 5, [false; 2]);
        let mut leaves = tree.leaves().to_vec();
        let id = leaves[5];
        let child = |k: u32| BlockId { level: id.level + 1, i: 2 * id.i + k % 2, j: 2 * id.j + k / 2 };
        leaves.splice(5..=5, (0..4).map(child));
        let refined = tree.with_leaves(leaves);
        let blocks: Vec<usize> = refined.tiles().iter().map(Tile::blocks).collect();
        assert_eq!(blocks, [4, 1, 4, 1, 1, 4, 4]);
    }

    #[test]
    fn surroundings_are_told_once() {
        let mesh = mesh([32, 32]);
        for tile in mesh.tree().tiles() {
            let around: Vec<_> = mesh.around(*tile).collect();
            // Two blocks on each side, one at each corner.
            assert_eq!(around.len(), 4 * 2 + 4);
            let is_inner = |(_, _, neighbour): &(usize, Offset, Neighbour)| {
                neighbour.slots().any(|other| tile.slots().contains(&other))
            };
            assert!(!around.iter().any(is_inner));
            let touched = Side::ALL.into_iter().filter(|side| mesh.tile_touches(*tile, *side)).count();
            assert_eq!(touched, 2);
        }
    }
}
