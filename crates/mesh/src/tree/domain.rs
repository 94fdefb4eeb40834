//! Where the cells lie: a domain, its coarsest grid and the tree of blocks over it.

use std::sync::Arc;

use crate::multiresolution::radial::{RadialRow, RadialTable};
use crate::{BlockId, Geometry, Neighbour, Quadtree, Side};

/// The rectangle that a medium fills.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    /// How the plane is measured.
    pub geometry: Geometry,
    /// Range in z, m.
    pub z: [f64; 2],
    /// Range in r, m.
    pub r: [f64; 2],
}

/// A grid that cannot be cut into blocks.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// The finest grid is no whole number of blocks.
    #[error(
        "{coarsest:?} cells refined {levels} times make {cells} cells along {axis}, which is no whole number \
         of blocks of {block} cells; the nearest that is: {nearest}"
    )]
    NotWholeBlocks {
        /// "z" or "r".
        axis: &'static str,
        /// Cells of the coarsest grid.
        coarsest: [usize; 2],
        /// Levels of refinement.
        levels: u8,
        /// Cells of the finest grid along the axis.
        cells: usize,
        /// Cells along a block.
        block: usize,
        /// The nearest admissible number of finest cells.
        nearest: usize,
    },
    /// Leaves that do not tile the domain.
    #[error("{blocks} blocks do not tile the domain")]
    NoTiling {
        /// How many they are.
        blocks: usize,
    },
}

/// A saved state that belongs to another setup.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct Misfit(pub String);

impl From<MeshError> for Misfit {
    fn from(error: MeshError) -> Self {
        Self(error.to_string())
    }
}

/// Blocks of N × N cells over a domain.
#[derive(Clone, Debug)]
pub struct Mesh<const N: usize> {
    domain: Domain,
    coarsest: [usize; 2],
    tree: Quadtree,
    radial: Arc<RadialTable>,
    generation: u64,
}

impl<const N: usize> Mesh<N> {
    /// A mesh whose leaves all lie on the finest level.
    ///
    /// - `coarsest`: cells of level 0 along z and r; `levels`: the finest level, with `coarsest · 2^levels` cells.
    /// - errors: [`MeshError::NotWholeBlocks`].
    pub fn uniform(
        domain: Domain,
        coarsest: [usize; 2],
        levels: u8,
        periodic: [bool; 2],
    ) -> Result<Self, MeshError> {
        Self::on_level(domain, coarsest, levels, levels, periodic)
    }

    /// A mesh whose leaves all lie on `level`, or on that of the roots if it is finer, and which may be refined
    /// up to the level `levels`.
    ///
    /// - errors: as [`Mesh::uniform`].
    pub fn on_level(
        domain: Domain,
        coarsest: [usize; 2],
        level: u8,
        levels: u8,
        periodic: [bool; 2],
    ) -> Result<Self, MeshError> {
        for (axis, cells) in ["z", "r"].into_iter().zip(coarsest) {
            let cells = cells << levels;
            if cells == 0 || !cells.is_multiple_of(N) {
                let nearest = ((cells + N / 2) / N).max(1) * N;
                return Err(MeshError::NotWholeBlocks { axis, coarsest, levels, cells, block: N, nearest });
            }
        }
        // The roots sit on the coarsest level that is a whole number of blocks in both directions.
        let whole = |level: &u8| coarsest.iter().all(|cells| (cells << level).is_multiple_of(N));
        let root_level = (0..=levels).find(whole).expect("the finest level is whole");
        let roots = coarsest.map(|cells| u32::try_from((cells << root_level) / N).expect("fits 32 bits"));
        let level = level.clamp(root_level, levels);
        let tree = Quadtree::uniform(root_level, roots, level, levels, periodic);
        let fine = (root_level..=levels).map(|level| {
            let h = (domain.r[1] - domain.r[0]) / (coarsest[1] << level) as f64;
            (h, (coarsest[1] << level) / 2)
        });
        let radial = Arc::new(RadialTable::new(&domain, root_level, fine));
        Ok(Self { domain, coarsest, tree, radial, generation: 0 })
    }

    /// The same domain under other leaves.
    pub(crate) fn with_leaves(&self, leaves: Vec<BlockId>) -> Self {
        Self {
            domain: self.domain,
            coarsest: self.coarsest,
            tree: self.tree.with_leaves(leaves),
            radial: Arc::clone(&self.radial),
            generation: self.generation + 1,
        }
    }

    /// The same domain under the leaves that another mesh of it had, and with its generation.
    ///
    /// - errors: [`MeshError::NoTiling`]: they are no such leaves.
    pub fn restored(&self, leaves: Vec<BlockId>, generation: u64) -> Result<Self, MeshError> {
        let blocks = leaves.len();
        let tree = self.tree.with_foreign_leaves(leaves).ok_or(MeshError::NoTiling { blocks })?;
        let Self { domain, coarsest, tree: _, radial, generation: _ } = self;
        Ok(Self { domain: *domain, coarsest: *coarsest, tree, radial: Arc::clone(radial), generation })
    }

    /// A number that grows whenever the leaves change.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    /// The domain.
    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    /// The tree of blocks.
    pub fn tree(&self) -> &Quadtree {
        &self.tree
    }

    /// Number of blocks.
    pub fn blocks(&self) -> usize {
        self.tree.leaves().len()
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.blocks() * N * N
    }

    /// Cell widths (h_z, h_r) on a level, m.
    pub fn widths(&self, level: u8) -> [f64; 2] {
        let [z, r] = [self.domain.z, self.domain.r];
        let cells = self.coarsest.map(|n| (n << level) as f64);
        [(z[1] - z[0]) / cells[0], (r[1] - r[0]) / cells[1]]
    }

    /// Positions of the lower faces of a block's first cell, (z, r), m.
    pub fn origin(&self, id: BlockId) -> [f64; 2] {
        let [hz, hr] = self.widths(id.level);
        [
            self.domain.z[0] + (id.i as usize * N) as f64 * hz,
            self.domain.r[0] + (id.j as usize * N) as f64 * hr,
        ]
    }

    /// Centre of cell (i, j) of a block, m. Formed from the global index, so that equal cells of different
    /// block sizes have bitwise equal centres.
    pub fn centre(&self, id: BlockId, i: usize, j: usize) -> [f64; 2] {
        let [hz, hr] = self.widths(id.level);
        [
            self.domain.z[0] + ((id.i as usize * N + i) as f64 + 0.5) * hz,
            self.domain.r[0] + ((id.j as usize * N + j) as f64 + 0.5) * hr,
        ]
    }

    /// The cell that holds the centre of cell (i, j) of the block in `slot`: (slot, i, j). `i` and `j` may lie beyond the
    /// block; periodic sides continue on the other one. `None` outside the domain.
    pub fn cell_at(&self, slot: usize, i: isize, j: isize) -> Option<(usize, usize, usize)> {
        let id = self.tree.leaves()[slot];
        let widths = self.widths(id.level);
        let (first, index) = ([id.i, id.j], [i, j]);
        let mut point = [0.0; 2];
        for (axis, [low, high]) in [self.domain.z, self.domain.r].into_iter().enumerate() {
            let offset = (i64::from(first[axis]) * N as i64 + index[axis] as i64) as f64 + 0.5;
            let x = low + offset * widths[axis];
            let is_wrapped = self.tree.periodic()[axis];
            point[axis] = if is_wrapped { low + (x - low).rem_euclid(high - low) } else { x };
        }
        self.locate(point)
    }

    /// Weight of the metric at radius `r`: r itself (per radian) or 1.
    pub fn weight(&self, r: f64) -> f64 {
        match self.domain.geometry {
            Geometry::Axisymmetric => r,
            Geometry::Planar => 1.0,
        }
    }

    /// The rows of cells from number `first` on, counted from the domain's r_min, whose children are of the level
    /// `fine`.
    #[inline]
    pub(crate) fn radial(&self, fine: u8, first: i64) -> &[RadialRow] {
        self.radial.from(fine, first)
    }

    /// Volume of a cell of row `j` of a block: ‖V‖ = r_j h_r h_z (per radian), planar h_r h_z; paper eq. (23).
    pub fn volume(&self, id: BlockId, j: usize) -> f64 {
        let [hz, hr] = self.widths(id.level);
        self.weight(self.centre(id, 0, j)[1]) * hr * hz
    }

    /// 1/r at the centres of row `j` of a block, which may lie beyond it; in planar geometry 0.
    pub(crate) fn inverse_radius(&self, id: BlockId, j: isize) -> f64 {
        match self.domain.geometry {
            // From the number that the row has in the whole domain: blocks that share it agree to the last bit.
            Geometry::Axisymmetric => {
                let row = (i64::from(id.j) * N as i64 + j as i64) as f64 + 0.5;
                1.0 / (self.domain.r[0] + row * self.widths(id.level)[1])
            }
            Geometry::Planar => 0.0,
        }
    }

    /// Slots of the blocks that touch a side of the domain, ordered along that side.
    pub fn blocks_along(&self, side: Side) -> Vec<usize> {
        self.ordered(1 - side.axis_across(), |slot| self.touches(slot, side))
    }

    /// Slots of the blocks of which something holds, ordered along an axis (0: z, 1: r).
    fn ordered(&self, axis: usize, holds: impl Fn(usize) -> bool) -> Vec<usize> {
        let mut slots: Vec<usize> = (0..self.blocks()).filter(|slot| holds(*slot)).collect();
        let along = |slot: usize| self.origin(self.tree.leaves()[slot])[axis];
        slots.sort_by(|a, b| along(*a).total_cmp(&along(*b)));
        slots
    }

    /// The row of a block's cells that begins on the axis, r = 0; in domains elsewhere, the row at the side that is nearest to it. `None` of
    /// blocks that have it not.
    pub fn axis_row(&self, slot: usize) -> Option<usize> {
        let id = self.tree.leaves()[slot];
        let [low, high] = self.domain.r;
        let axis = 0.0_f64.clamp(low, high);
        // Where it falls on a face that round-off has moved.
        let nudge = if axis < high { 1e-6 } else { -1e-6 };
        let row = ((axis - self.origin(id)[1]) / self.widths(id.level)[1] + nudge).floor();
        (0.0..N as f64).contains(&row).then_some(row as usize)
    }

    /// Slots of the blocks that have a row on the axis ([`Mesh::axis_row`]), ordered along it.
    pub fn blocks_on_axis(&self) -> Vec<usize> {
        self.ordered(0, |slot| self.axis_row(slot).is_some())
    }

    /// Whether the block in `slot` touches a side of the domain.
    pub fn touches(&self, slot: usize, side: Side) -> bool {
        self.tree.neighbours(slot)[side as usize] == Neighbour::Boundary
    }

    /// The cell (slot, i, j) that contains a point of the closed domain; `None` outside it.
    pub fn locate(&self, point: [f64; 2]) -> Option<(usize, usize, usize)> {
        let finest = self.tree.finest();
        let widths = self.widths(finest);
        let ranges = [self.domain.z, self.domain.r];
        let mut index = [0usize; 2];
        for axis in 0..2 {
            let [low, high] = ranges[axis];
            if !(point[axis] >= low && point[axis] <= high) {
                return None;
            }
            let count = self.coarsest[axis] << finest;
            index[axis] = (((point[axis] - low) / widths[axis]) as usize).min(count - 1);
        }
        let place = BlockId { level: finest, i: (index[0] / N) as u32, j: (index[1] / N) as u32 };
        let slot = self.tree.covering(place)?;
        let leaf = self.tree.leaves()[slot];
        let [i, j] = index.map(|index| index >> (finest - leaf.level));
        Some((slot, i - leaf.i as usize * N, j - leaf.j as usize * N))
    }

    /// [`Mesh::locate`], and the place of the point in the cell: so many of its widths from its centre, along z and r.
    pub fn place_in_cell(&self, point: [f64; 2]) -> Option<((usize, usize, usize), [f64; 2])> {
        let (slot, i, j) = self.locate(point)?;
        let id = self.tree.leaves()[slot];
        let (centre, widths) = (self.centre(id, i, j), self.widths(id.level));
        let within = std::array::from_fn(|axis| (point[axis] - centre[axis]) / widths[axis]);
        Some(((slot, i, j), within))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn domain() -> Domain {
        Domain { geometry: Geometry::Axisymmetric, z: [0.01, 0.06], r: [0.0, 0.05] }
    }

    #[test]
    fn a_coarsest_grid_smaller_than_a_block_puts_the_roots_higher() {
        let mesh = Mesh::<16>::uniform(domain(), [4, 4], 6, [false; 2]).unwrap();
        assert_eq!(mesh.cells(), 256 * 256);
        assert_eq!(mesh.tree().blocks_on(2), [1, 1]);
        let mesh = Mesh::<16>::uniform(domain(), [3, 5], 4, [false; 2]).unwrap();
        assert_eq!(mesh.tree().blocks_on(4), [3, 5]);
    }

    #[test]
    fn a_grid_that_is_no_whole_number_of_blocks_names_the_nearest() {
        let error = Mesh::<16>::uniform(domain(), [5, 8], 1, [false; 2]).unwrap_err();
        assert!(matches!(error, MeshError::NotWholeBlocks { axis: "z", cells: 10, nearest: 16, .. }));
        let error = Mesh::<16>::uniform(domain(), [16, 25], 1, [false; 2]).unwrap_err();
        assert!(matches!(error, MeshError::NotWholeBlocks { axis: "r", cells: 50, nearest: 48, .. }));
    }

    #[test]
    fn volumes_add_up_to_the_cylinder() {
        let mesh = Mesh::<8>::uniform(domain(), [2, 3], 4, [false; 2]).unwrap();
        let total: f64 = (mesh.tree().leaves().iter())
            .map(|id| (0..8).map(|j| 8.0 * mesh.volume(*id, j)).sum::<f64>())
            .sum();
        assert!((total / (0.05 * 0.05 * 0.05 / 2.0) - 1.0).abs() < 1e-13);
    }

    #[test]
    fn points_are_found_in_their_cells() {
        let mesh = Mesh::<8>::uniform(domain(), [1, 1], 5, [false; 2]).unwrap();
        for slot in [0, 3, 7, 15] {
            let id = mesh.tree().leaves()[slot];
            assert_eq!(mesh.locate(mesh.centre(id, 5, 2)), Some((slot, 5, 2)));
        }
        assert_eq!(mesh.locate([0.06, 0.05]), Some((15, 7, 7)));
        assert_eq!(mesh.locate([0.0099, 0.0]), None);
        assert_eq!(mesh.locate([f64::NAN, 0.0]), None);
    }

    #[test]
    fn blocks_along_a_side_are_ordered() {
        let mesh = Mesh::<8>::uniform(domain(), [1, 1], 5, [false; 2]).unwrap();
        let along = mesh.blocks_along(Side::ZMin);
        let r: Vec<u32> = along.iter().map(|slot| mesh.tree().leaves()[*slot].j).collect();
        assert_eq!(r, [0, 1, 2, 3]);
        assert!(along.iter().all(|slot| mesh.touches(*slot, Side::ZMin)));
    }

    #[test]
    fn the_axis_is_where_r_is_zero_or_nearest_to_it() {
        for (r, expected) in
            [([0.0, 4.0], 0), ([-4.0, 4.0], 16), ([-1.0, 3.0], 8), ([1.0, 5.0], 0), ([-5.0, -1.0], 31)]
        {
            let mesh = Mesh::<8>::uniform(
                Domain { geometry: Geometry::Planar, z: [0.0, 4.0], r },
                [1, 1],
                5,
                [false; 2],
            )
            .unwrap();
            let slots = mesh.blocks_on_axis();
            let z: Vec<u32> = slots.iter().map(|slot| mesh.tree().leaves()[*slot].i).collect();
            assert_eq!(z, [0, 1, 2, 3], "{r:?}");
            for slot in slots {
                let row = mesh.axis_row(slot).unwrap() + 8 * mesh.tree().leaves()[slot].j as usize;
                assert_eq!(row, expected, "{r:?}");
            }
        }
    }
}
