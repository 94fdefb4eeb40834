//! The curvature in the cells of a block and around it.

use mesh::{BlockId, Geometry, Mesh};

use super::curvature::{of_heights, without_heights};
use super::patch::WidePatch;
use super::place::CellPlace;

/// What the curvature in a block's cells is made of.
#[derive(Clone, Copy)]
pub(super) struct BlockCurvature<'a, const N: usize> {
    pub mesh: &'a Mesh<N>,
    pub id: BlockId,
    /// Holds the block's gas fractions.
    pub patch: &'a WidePatch,
}

impl<const N: usize> BlockCurvature<'_, N> {
    /// κ of cell (i, j), 1/m.
    pub fn at(&self, cell: [isize; 2]) -> f64 {
        self.of_heights(cell).unwrap_or_else(|| self.without_heights(cell))
    }

    /// See [`of_heights`].
    pub fn of_heights(&self, cell: [isize; 2]) -> Option<f64> {
        let (k, place) = self.place_of(cell);
        of_heights(&self.patch.phi, self.patch.stride, k, &place)
    }

    /// See [`without_heights`].
    pub fn without_heights(&self, cell: [isize; 2]) -> f64 {
        let (k, place) = self.place_of(cell);
        without_heights(&self.patch.phi, self.patch.stride, k, &place)
    }

    /// A cell's index in the patch and its place. A cell beyond the axis is the image of one before it and has its curvature to the last
    /// bit: with another one the states on the axis would be no mirror images, and push the cells there.
    fn place_of(&self, [i, j]: [isize; 2]) -> (usize, CellPlace) {
        let domain = self.mesh.domain();
        let widths = self.mesh.widths(self.id.level);
        let is_axial = domain.geometry == Geometry::Axisymmetric;
        // From the global index: blocks on both sides of a face have it to the last bit.
        let first = self.id.j as isize * N as isize;
        let row = first + j;
        let is_image = is_axial && domain.r[0] == 0.0 && row < 0;
        let row = if is_image { -1 - row } else { row };
        let radius = is_axial.then(|| domain.r[0] + (row as f64 + 0.5) * widths[1]);
        (self.patch.index(i, row - first), CellPlace { widths, radius })
    }
}
