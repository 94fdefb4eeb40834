//! One block with its ghost layers (halo).

use crate::ghosts::assemble::assemble;
use crate::{AlignedRow, Field, Frame, Mesh, Multiresolution, Patch, Side, Tile};

/// Ghost layers on each side: what a slope in a neighbouring cell needs.
pub const GHOSTS: usize = 2;

/// Several components of one block with ghosts, laid out `[component][j][i]` with N + 4 cells along each side.
///
/// Kernels walk one component as one flat row of (N + 4)² numbers, in which the neighbours of `k` are `k ± 1`
/// along z and `k ± STRIDE` along r; what they compute in passing for the ghosts at the ends of a row is not used.
#[derive(Clone, Debug)]
pub struct Padded<const N: usize> {
    components: usize,
    data: AlignedRow,
}

impl<const N: usize> Padded<N> {
    /// Distance between cells that neighbour each other along r.
    pub const STRIDE: usize = N + 2 * GHOSTS;
    /// Numbers per component.
    pub const LEN: usize = Self::STRIDE * Self::STRIDE;

    /// All zero.
    pub fn zeros(components: usize) -> Self {
        Self { components, data: AlignedRow::zeros(components * Self::LEN, Self::STRIDE) }
    }

    /// Flat index of cell (i, j) of the block; ghosts have i or j in −2..0 and N..N + 2.
    #[inline(always)]
    pub const fn index(i: isize, j: isize) -> usize {
        Frame::of(N).index(i, j)
    }

    /// Numbers per cell.
    pub fn components(&self) -> usize {
        self.components
    }

    /// Everything, component after component.
    pub(crate) fn as_slice(&self) -> &[f64] {
        &self.data
    }

    /// One component.
    pub fn component(&self, component: usize) -> &[f64] {
        &self.data[component * Self::LEN..(component + 1) * Self::LEN]
    }

    /// One component, to write.
    pub fn component_mut(&mut self, component: usize) -> &mut [f64] {
        &mut self.data[component * Self::LEN..(component + 1) * Self::LEN]
    }

    /// The first C components, each a flat row.
    pub fn split<const C: usize>(&self) -> [&[f64]; C] {
        assert!(C <= self.components, "no more rows than components");
        let mut rows = self.data.chunks_exact(Self::LEN);
        std::array::from_fn(|_| rows.next().expect("asserted above"))
    }

    /// The first C components, each a flat row, to write.
    pub fn split_mut<const C: usize>(&mut self) -> [&mut [f64]; C] {
        assert!(C <= self.components, "no more rows than components");
        let mut rows = self.data.chunks_exact_mut(Self::LEN);
        std::array::from_fn(|_| rows.next().expect("asserted above"))
    }

    /// Divides a component by another one, cell by cell, ghosts included.
    pub fn divide(&mut self, component: usize, by: usize) {
        assert!(component > by, "the divisor comes first");
        let (before, rows) = self.data.split_at_mut(component * Self::LEN);
        for (value, by) in rows[..Self::LEN].iter_mut().zip(&before[by * Self::LEN..][..Self::LEN]) {
            *value /= by;
        }
    }

    /// Copies the block in `slot` and fills the ghost cells that other blocks own: cells of the same level are
    /// copied, finer ones projected, and from coarser ones predicted. Ghosts beyond the domain are set to the
    /// nearest cell of the block, so that they hold finite numbers; [`Padded::reflect`] and
    /// [`Padded::extrapolate`] overwrite them.
    ///
    /// - `rule`: what prediction must know of the fields; `patch`: scratch for it.
    pub fn assemble(
        &mut self,
        mesh: &Mesh<N>,
        field: &Field,
        slot: usize,
        rule: &impl Multiresolution,
        patch: &mut Patch<N>,
    ) {
        self.assemble_first(field.components(), mesh, field, slot, rule, patch);
    }

    /// [`Padded::assemble`] of the first so many components; what the others hold counts for nothing.
    pub fn assemble_first(
        &mut self,
        components: usize,
        mesh: &Mesh<N>,
        field: &Field,
        slot: usize,
        rule: &impl Multiresolution,
        patch: &mut Patch<N>,
    ) {
        debug_assert_eq!(field.components(), self.components, "same components");
        let rows = (&mut *self.data, Frame::of(N));
        assemble(rows, components, (mesh, field), Tile::one(slot), rule, patch);
    }

    /// Fills the ghosts beyond a side of one component by reflection, times `parity` (±1).
    pub fn reflect(row: &mut [f64], side: Side, parity: f64) {
        Frame::of(N).reflect(row, side, parity);
    }

    /// Fills the ghosts beyond a side of one component by continuing its inner differences: by the parabola through three
    /// cells where the data are smooth, see `continued`.
    pub fn extrapolate(row: &mut [f64], side: Side) {
        Frame::of(N).extrapolate(row, side);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Domain, Geometry};

    /// A field whose values name their place: 1000·(global j) + global i.
    fn labelled<const N: usize>(mesh: &Mesh<N>, extent: [usize; 2]) -> Field {
        let tree = mesh.tree();
        let mut field = Field::zeros(tree.leaves().len(), N * N, 1);
        for (slot, id) in tree.leaves().iter().enumerate() {
            for j in 0..N {
                for i in 0..N {
                    let place = [id.i as usize * N + i, id.j as usize * N + j];
                    assert!(place[0] < extent[0] && place[1] < extent[1]);
                    field.block_mut(slot)[j * N + i] = (1000 * place[1] + place[0]) as f64;
                }
            }
        }
        field
    }

    #[test]
    fn ghosts_are_the_cells_of_the_neighbours_corners_included() {
        let domain = Domain { geometry: Geometry::Planar, z: [0.0, 1.0], r: [0.0, 1.0] };
        let mesh = Mesh::<8>::uniform(domain, [24, 24], 0, [true, true]).unwrap();
        let field = labelled(&mesh, [24, 24]);
        let (mut padded, mut patch) = (Padded::<8>::zeros(1), Patch::zeros(1));
        for (slot, id) in mesh.tree().leaves().iter().enumerate() {
            padded.assemble(&mesh, &field, slot, &crate::multiresolution::Plain, &mut patch);
            for j in -2..10_isize {
                for i in -2..10_isize {
                    let gi = (id.i as isize * 8 + i).rem_euclid(24);
                    let gj = (id.j as isize * 8 + j).rem_euclid(24);
                    assert_eq!(padded.component(0)[Padded::<8>::index(i, j)], (1000 * gj + gi) as f64);
                }
            }
        }
    }

    #[test]
    fn reflection_mirrors_both_layers_with_parity() {
        let mut row: Vec<f64> = (0..Padded::<8>::LEN).map(|k| k as f64).collect();
        for side in Side::ALL {
            Padded::<8>::reflect(&mut row, side, -1.0);
        }
        let at = |i, j| row[Padded::<8>::index(i, j)];
        assert_eq!(at(-1, 3), -at(0, 3));
        assert_eq!(at(-2, 3), -at(1, 3));
        assert_eq!(at(9, 3), -at(6, 3));
        assert_eq!(at(3, -2), -at(3, 1));
        assert_eq!(at(3, 8), -at(3, 7));
        assert_eq!(at(-1, -1), at(0, 0));
    }

    #[test]
    fn extrapolation_continues_a_line_and_flattens_an_extremum() {
        let mut row = vec![0.0; Padded::<8>::LEN];
        for j in -2..10 {
            for i in -2..10 {
                row[Padded::<8>::index(i, j)] =
                    if j == 5 { [1.0, 3.0, 2.0][i.clamp(0, 2) as usize] } else { 3.0 * i as f64 };
            }
        }
        Padded::<8>::extrapolate(&mut row, Side::ZMin);
        assert_eq!(row[Padded::<8>::index(-1, 2)], -3.0);
        assert_eq!(row[Padded::<8>::index(-2, 2)], -6.0);
        assert_eq!(row[Padded::<8>::index(-1, 5)], 1.0);
    }
}
