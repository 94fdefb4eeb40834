//! Cell averages of several components on all blocks: a structure of arrays, block by block.

use serde::{Deserialize, Serialize};

use crate::AlignedRow;

/// Cell averages, one allocation, laid out `[slot][component][j][i]` without ghosts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Field {
    components: usize,
    cells: usize,
    data: AlignedRow,
}

impl Field {
    /// All zero: `blocks` blocks of `cells` = N² cells with `components` numbers each.
    pub fn zeros(blocks: usize, cells: usize, components: usize) -> Self {
        Self { components, cells, data: AlignedRow::zeros(blocks * cells * components, 0) }
    }

    /// Makes room for so many blocks. What they hold then is not said: memory at hand is used again as it is.
    pub fn resize(&mut self, blocks: usize) {
        self.data.resize(blocks * self.block_len());
    }

    /// Whether it holds so many blocks of `cells` cells with `components` numbers each.
    pub fn has_shape(&self, blocks: usize, cells: usize, components: usize) -> bool {
        self.components == components
            && self.cells == cells
            && Some(self.data.len()) == cells.checked_mul(components).and_then(|n| n.checked_mul(blocks))
    }

    /// Numbers per cell.
    pub fn components(&self) -> usize {
        self.components
    }

    /// One block: `[component][j][i]`.
    pub fn block(&self, slot: usize) -> &[f64] {
        let len = self.block_len();
        &self.data[slot * len..(slot + 1) * len]
    }

    /// One block, to write.
    pub fn block_mut(&mut self, slot: usize) -> &mut [f64] {
        let len = self.block_len();
        &mut self.data[slot * len..(slot + 1) * len]
    }

    /// One component of one block: `[j][i]`.
    pub fn component(&self, slot: usize, component: usize) -> &[f64] {
        &self.block(slot)[component * self.cells..(component + 1) * self.cells]
    }

    /// Numbers in a block.
    pub fn block_len(&self) -> usize {
        self.components * self.cells
    }

    /// Everything, block after block.
    pub fn as_slice(&self) -> &[f64] {
        &self.data
    }

    /// Everything, to write.
    pub fn as_mut_slice(&mut self) -> &mut [f64] {
        &mut self.data
    }
}
