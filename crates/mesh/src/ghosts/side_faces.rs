//! What the faces along the sides of the domain remember while the mesh changes.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::{BlockId, Mesh, Side};

/// A value on each face of the finest level along one side of the domain, or none there.
///
/// A coarser face consists of finest ones: it sees their mean and sets all of them alike, so that a grid that adapts has nothing
/// to do here.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SideFaces<T> {
    finest: u8,
    values: Vec<T>,
}

impl<T> SideFaces<T> {
    /// Of those sides that have some, in the order of [`Side::ALL`].
    ///
    /// - `value`: of the face of the finest level with this number along a side.
    pub fn along_sides<const N: usize>(
        mesh: &Mesh<N>,
        has_some: impl Fn(Side) -> bool,
        value: impl Fn(Side, usize) -> T,
    ) -> [Self; 4] {
        let finest = mesh.tree().finest();
        Side::ALL.map(|side| {
            let blocks = mesh.tree().blocks_on(finest)[1 - side.axis_across()] as usize;
            let faces = if has_some(side) { blocks * N } else { 0 };
            Self { finest, values: (0..faces).map(|along| value(side, along)).collect() }
        })
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// How many faces of the finest level there are.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// The finest level.
    pub fn finest(&self) -> u8 {
        self.finest
    }

    /// Whether two are of the same faces.
    pub fn has_shape_of(&self, other: &Self) -> bool {
        self.finest == other.finest && self.values.len() == other.values.len()
    }

    /// The faces of the finest level that the face number `along` of a level consists of.
    pub fn of(&self, level: u8, along: usize) -> &[T] {
        &self.values[self.range(level, along, 1)]
    }

    /// The same, to be set.
    pub fn of_mut(&mut self, level: u8, along: usize) -> &mut [T] {
        let faces = self.range(level, along, 1);
        &mut self.values[faces]
    }

    fn range(&self, level: u8, first: usize, count: usize) -> Range<usize> {
        let halvings = self.finest - level;
        first << halvings..(first + count) << halvings
    }
}

impl<T: Copy> SideFaces<T> {
    /// Takes the faces along a block from another one of the same shape.
    pub fn copy_block<const N: usize>(&mut self, id: BlockId, side: Side, from: &Self) {
        let faces = self.range(id.level, id.first_face::<N>(side), N);
        self.values[faces.clone()].copy_from_slice(&from.values[faces]);
    }
}

impl BlockId {
    /// The number along a side of the block's first face.
    pub fn first_face<const N: usize>(self, side: Side) -> usize {
        [self.i, self.j][1 - side.axis_across()] as usize * N
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Domain, Geometry};

    #[test]
    fn a_coarse_face_is_the_fine_ones_that_it_consists_of() {
        let domain = Domain { geometry: Geometry::Planar, z: [0.0, 2.0], r: [0.0, 1.0] };
        let mesh = Mesh::<8>::uniform(domain, [16, 8], 2, [false; 2]).expect("a mesh");
        let [low, _, _, far] = SideFaces::along_sides(&mesh, |side| side != Side::ZMin, |_, along| along);
        let finest = mesh.tree().finest();
        assert!(low.is_empty() && !far.is_empty() && !far.has_shape_of(&low));
        assert_eq!((far.finest(), far.len()), (finest, 64));
        assert_eq!(far.of(finest, 5), [5]);
        assert_eq!(far.of(finest - 1, 5), [10, 11]);
        assert_eq!(far.of(finest - 2, 15), [60, 61, 62, 63], "the last one along z");
        let (id, mut taken) = (BlockId { level: finest - 1, i: 1, j: 0 }, far.clone());
        taken.of_mut(0, 0).fill(0);
        (0..16).for_each(|along| taken.of_mut(0, along).fill(0));
        taken.copy_block::<8>(id, Side::RMax, &far);
        let kept: Vec<usize> = (0..64).filter(|along| taken.of(finest, *along) != [0]).collect();
        assert_eq!(kept, (16..32).collect::<Vec<_>>());
        assert_eq!([Side::RMax, Side::ZMax].map(|side| id.first_face::<8>(side)), [8, 0]);
    }
}
