//! The gas fraction of a block and of a wide rim around it.

use mesh::{Field, Mesh, Neighbour, Offset, Padded, Side};

use crate::Boundary;
use crate::state::conserved::PHI;

/// Cells along a column from its middle to each end: a step two cells wide whose middle is four cells away lies within.
pub(super) const REACH: usize = 6;

/// Layers around a block: a column of the second ghost layer lies within.
pub(super) const RIM: usize = REACH + mesh::GHOSTS;

/// φ of N × N cells and of [`RIM`] layers around them.
#[derive(Clone, Debug, Default)]
pub(crate) struct WidePatch {
    pub phi: Vec<f64>,
    /// Distance of cells that neighbour each other along r.
    pub stride: usize,
}

impl WidePatch {
    /// The flat index of cell (i, j) of the block.
    pub fn index(&self, i: isize, j: isize) -> usize {
        let rim = RIM as isize;
        ((j + rim) * self.stride as isize + i + rim) as usize
    }

    /// Takes φ from the blocks around, beyond walls and the axis from the mirror image, beyond open sides from the nearest cell.
    ///
    /// Cells of other levels count as they are: the interface is on the finest one, and what is beside it there is of one phase.
    ///
    /// - `padded`: φ of the block with its ghosts; `kinds`: of the domain's sides.
    pub fn fill<const N: usize>(
        &mut self,
        mesh: &Mesh<N>,
        field: &Field,
        slot: usize,
        kinds: [Boundary; 4],
        padded: &[f64],
    ) {
        const { assert!(N >= RIM, "the rim lies within the blocks around") };
        self.stride = N + 2 * RIM;
        self.phi.resize(self.stride * self.stride, 0.0);
        let n = N as isize;
        for j in 0..n {
            let (to, from) = (self.index(0, j), Padded::<N>::index(0, j));
            self.phi[to..][..N].copy_from_slice(&padded[from..][..N]);
        }
        for (neighbour, offset) in mesh.tree().neighbours(slot).iter().zip(Offset::ALL) {
            let same = if let Neighbour::Same(other) = neighbour { Some(*other) } else { None };
            for j in rim_span(n, offset.j) {
                for i in rim_span(n, offset.i) {
                    let phi = match same {
                        Some(other) => {
                            let [i, j] =
                                [(i, offset.i), (j, offset.j)].map(|(x, by)| x - isize::from(by) * n);
                            field.component(other, PHI)[j as usize * N + i as usize]
                        }
                        None => phi_beyond(mesh, field, slot, kinds, [i, j]),
                    };
                    let to = self.index(i, j);
                    self.phi[to] = phi;
                }
            }
        }
    }
}

/// The cells of the rim in one direction.
fn rim_span(n: isize, step: i8) -> std::ops::Range<isize> {
    let rim = RIM as isize;
    match step {
        -1 => -rim..0,
        0 => 0..n,
        _ => n..n + rim,
    }
}

/// φ where the block beyond is of another level or there is none.
fn phi_beyond<const N: usize>(
    mesh: &Mesh<N>,
    field: &Field,
    slot: usize,
    kinds: [Boundary; 4],
    cell: [isize; 2],
) -> f64 {
    let n = N as isize;
    let mut within = cell;
    for side in Side::ALL {
        let axis = side.axis_across();
        let x = cell[axis];
        let is_low = matches!(side, Side::ZMin | Side::RMin);
        let is_beyond = if is_low { x < 0 } else { x >= n };
        if !is_beyond || !mesh.touches(slot, side) {
            continue;
        }
        let mirrors = kinds[side as usize] == Boundary::Axis || kinds[side as usize].is_wall();
        within[axis] = match (mirrors, is_low) {
            (true, true) => -1 - x,
            (true, false) => 2 * n - 1 - x,
            (false, true) => 0,
            (false, false) => n - 1,
        };
    }
    let found = mesh.cell_at(slot, within[0], within[1]);
    found.map_or(0.0, |(slot, i, j)| field.component(slot, PHI)[j * N + i])
}
