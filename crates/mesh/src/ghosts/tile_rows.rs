//! A tile with its ghost layers (halo): what a step of several blocks works in.

use crate::ghosts::assemble::assemble;
use crate::{AlignedRow, Field, Frame, Mesh, Multiresolution, Patch, Tile};

/// Several components of a tile with ghosts, laid out as [`crate::Padded`]: `[component][j][i]`, in memory for the largest tile.
#[derive(Clone, Debug)]
pub struct TileRows<const N: usize> {
    components: usize,
    frame: Frame,
    data: AlignedRow,
}

impl<const N: usize> TileRows<N> {
    /// All zero, the frame of one block.
    pub fn zeros(components: usize) -> Self {
        let largest = Frame::of(2 * N);
        // Rows of both frames begin lines in the same place: their strides are 4 more than a multiple of 8.
        let data = AlignedRow::zeros(components * largest.len(), largest.stride());
        Self { components, frame: Frame::of(N), data }
    }

    /// Numbers per cell.
    pub fn components(&self) -> usize {
        self.components
    }

    /// Where the cells lie in each row.
    pub fn frame(&self) -> Frame {
        self.frame
    }

    /// Takes the frame of a tile; what the rows hold then means nothing.
    pub fn lay_out(&mut self, tile: Tile) {
        self.frame = tile.frame::<N>();
    }

    /// One component.
    pub fn component(&self, component: usize) -> &[f64] {
        &self.data[component * self.frame.len()..][..self.frame.len()]
    }

    /// One component, to write.
    pub fn component_mut(&mut self, component: usize) -> &mut [f64] {
        let len = self.frame.len();
        &mut self.data[component * len..][..len]
    }

    /// The first C components, each a flat row.
    pub fn split<const C: usize>(&self) -> [&[f64]; C] {
        assert!(C <= self.components, "no more rows than components");
        let mut rows = self.data.chunks_exact(self.frame.len());
        std::array::from_fn(|_| rows.next().expect("asserted above"))
    }

    /// The first C components, each a flat row, to write.
    pub fn split_mut<const C: usize>(&mut self) -> [&mut [f64]; C] {
        assert!(C <= self.components, "no more rows than components");
        let mut rows = self.data.chunks_exact_mut(self.frame.len());
        std::array::from_fn(|_| rows.next().expect("asserted above"))
    }

    /// Divides a component by another one, cell by cell, ghosts included.
    pub fn divide(&mut self, component: usize, by: usize) {
        assert!(component > by, "the divisor comes first");
        let len = self.frame.len();
        let (before, rows) = self.data.split_at_mut(component * len);
        for (value, by) in rows[..len].iter_mut().zip(&before[by * len..][..len]) {
            *value /= by;
        }
    }

    /// Copies the blocks of a tile, the first so many components of the field, and fills the ghost cells that other blocks own, as
    /// [`crate::Padded::assemble`] does for one: bitwise the same in every cell.
    pub fn assemble(
        &mut self,
        components: usize,
        mesh: &Mesh<N>,
        field: &Field,
        tile: Tile,
        rule: &impl Multiresolution,
        patch: &mut Patch<N>,
    ) {
        debug_assert_eq!(field.components(), self.components, "same components");
        self.lay_out(tile);
        let data = &mut self.data[..self.components * self.frame.len()];
        assemble((data, self.frame), components, (mesh, field), tile, rule, patch);
    }
}

#[cfg(test)]
mod tests;
