//! Where the cells of padded rows lie.

use crate::ghosts::{cell_below, extrapolate, ghost_range, mirror};
use crate::{GHOSTS, Side};

/// Where n × n cells lie in rows of numbers `[j][i]` with [`GHOSTS`] layers around them, walked as [`crate::Padded`] says: the rows of a
/// block or of a tile, or of a block within a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    cells: usize,
    stride: usize,
    origin: usize,
}

impl Frame {
    /// Of n × n cells.
    pub const fn of(cells: usize) -> Self {
        let stride = cells + 2 * GHOSTS;
        Self { cells, stride, origin: GHOSTS * (stride + 1) }
    }

    /// Of n × n of these cells, a block of a tile; `place`: how many such blocks come before it along z and along r.
    pub const fn part(self, n: usize, place: [usize; 2]) -> Self {
        Self { cells: n, stride: self.stride, origin: self.origin + (place[1] * self.stride + place[0]) * n }
    }

    /// n.
    #[inline(always)]
    pub const fn cells(self) -> usize {
        self.cells
    }

    /// Distance between cells that neighbour each other along r.
    #[inline(always)]
    pub const fn stride(self) -> usize {
        self.stride
    }

    /// The number of cell (0, 0).
    #[inline(always)]
    pub const fn origin(self) -> usize {
        self.origin
    }

    /// Numbers in a row of all cells and ghosts, of a part those of the whole.
    #[inline(always)]
    pub const fn len(self) -> usize {
        self.stride * self.stride
    }

    /// Whether there are none.
    pub const fn is_empty(self) -> bool {
        self.stride == 0
    }

    /// The number of cell (i, j); ghosts have i or j in −2..0 and n..n + 2.
    #[inline(always)]
    pub const fn index(self, i: isize, j: isize) -> usize {
        (self.origin as isize + j * self.stride as isize + i) as usize
    }

    /// The number of the cell at a depth below a side, see [`cell_below`].
    #[inline(always)]
    pub fn below(self, side: Side, depth: isize, along: isize) -> usize {
        let (i, j) = cell_below(self.cells, side, depth, along);
        self.index(i, j)
    }

    /// Fills the ghosts beyond a side by reflection, times `parity` (±1).
    pub fn reflect(self, row: &mut [f64], side: Side, parity: f64) {
        mirror(row, self, side, ghost_range(self.cells), parity);
    }

    /// Fills the ghosts beyond a side by continuing the inner differences: by the parabola through three cells where the data are
    /// smooth, see `continued`.
    pub fn extrapolate(self, row: &mut [f64], side: Side) {
        extrapolate(row, self, side);
    }
}
