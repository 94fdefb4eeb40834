//! The meshes of snapshots: quadrilaterals in the plane of a section, x is the axial coordinate z, y the radial coordinate r.

use std::fmt::Debug;

/// What a file asks of a mesh, piece by piece: written out it takes more memory than the state of its cells.
pub trait CellMesh: Debug + Send + Sync {
    /// How many points there are.
    fn points(&self) -> usize;
    /// How many cells there are.
    fn cells(&self) -> usize;
    /// The coordinates of a point, x y z; the third is 0.
    fn point(&self, point: usize) -> [f64; 3];
    /// The points of a cell, counted around it.
    fn corners(&self, cell: usize) -> [usize; 4];
}

/// A mesh of any quadrilaterals.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OwnedQuadMesh {
    /// Coordinates, x y z of one point after the other; the third is 0.
    pub points: Vec<f64>,
    /// Points of each cell, counted around it.
    pub quads: Vec<[usize; 4]>,
}

impl CellMesh for OwnedQuadMesh {
    fn points(&self) -> usize {
        self.points.len() / 3
    }

    fn cells(&self) -> usize {
        self.quads.len()
    }

    fn point(&self, point: usize) -> [f64; 3] {
        std::array::from_fn(|axis| self.points[3 * point + axis])
    }

    fn corners(&self, cell: usize) -> [usize; 4] {
        self.quads[cell]
    }
}

/// A mesh of blocks of N × N rectangular cells, each with (N + 1)² points of its own.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct BlockMesh<const N: usize> {
    /// The corner (z, r) of smallest coordinates of each block, and the widths of its cells, m.
    pub blocks: Vec<[[f64; 2]; 2]>,
}

impl<const N: usize> BlockMesh<N> {
    const ROW: usize = N + 1;
}

impl<const N: usize> CellMesh for BlockMesh<N> {
    fn points(&self) -> usize {
        self.blocks.len() * Self::ROW * Self::ROW
    }

    fn cells(&self) -> usize {
        self.blocks.len() * N * N
    }

    fn point(&self, point: usize) -> [f64; 3] {
        let (block, within) = (point / (Self::ROW * Self::ROW), point % (Self::ROW * Self::ROW));
        let ([z, r], [h_z, h_r]) = (self.blocks[block][0], self.blocks[block][1]);
        let (i, j) = (within % Self::ROW, within / Self::ROW);
        [z + i as f64 * h_z, r + j as f64 * h_r, 0.0]
    }

    fn corners(&self, cell: usize) -> [usize; 4] {
        let (block, within) = (cell / (N * N), cell % (N * N));
        let low = (block * Self::ROW + within / N) * Self::ROW + within % N;
        [low, low + 1, low + Self::ROW + 1, low + Self::ROW]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_have_their_cells_in_rows_and_points_of_their_own() {
        let mesh = BlockMesh::<2> { blocks: vec![[[0.0, 0.0], [1.0, 1.0]], [[2.0, 0.5], [0.5, 0.25]]] };
        assert_eq!((mesh.points(), mesh.cells()), (18, 8));
        assert_eq!(mesh.corners(3), [4, 5, 8, 7]);
        // The second cell of the second row of the second block.
        let corners = mesh.corners(7).map(|point| mesh.point(point));
        assert_eq!(corners, [[2.5, 0.75, 0.0], [3.0, 0.75, 0.0], [3.0, 1.0, 0.0], [2.5, 1.0, 0.0]]);
        assert_eq!(mesh.point(17), [3.0, 1.0, 0.0]);
    }
}
