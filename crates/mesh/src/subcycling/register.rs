//! Flux registers: what passes a face between levels, as the finer side has it.

use crate::{Field, Frame, Mesh, Neighbour, Side};

/// Values of some quantities on the outer faces of the blocks, kept where a block meets another level.
///
/// A coarse block first steps with its own face values; then [`FluxRegister::for_corrected_faces`] gives, face by face, the
/// mean of the finer side's values minus its own, and the solver corrects the cell behind the face. What leaves
/// one side then enters the other, to round-off.
#[derive(Clone, Debug)]
pub struct FluxRegister<const N: usize> {
    values: Field,
}

/// A face on which a coarse block has passed something else than its finer neighbours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CorrectedFace<const K: usize> {
    /// The block's side.
    pub side: Side,
    /// −1 where the side looks towards smaller coordinates, else 1.
    pub outward: f64,
    /// The cell (i, j) behind the face.
    pub cell: [usize; 2],
    /// The mean of the finer side's values minus the block's own; the mean is weighted with the areas of the fine faces.
    pub difference: [f64; K],
}

impl<const N: usize> FluxRegister<N> {
    /// For a mesh of that many blocks, and so many quantities.
    pub fn new(blocks: usize, quantities: usize) -> Self {
        Self { values: Field::zeros(blocks, N, quantities * Side::ALL.len()) }
    }

    /// Makes room for so many blocks; nothing is kept.
    pub fn resize(&mut self, blocks: usize) {
        self.values.resize(blocks);
    }

    /// The values of all blocks, to hand them to the threads that work on the blocks.
    pub fn values_mut(&mut self) -> &mut Field {
        &mut self.values
    }

    /// The values of all blocks.
    pub fn values(&self) -> &Field {
        &self.values
    }

    /// The sides of a block whose values are kept: those that meet another level, and those of the domain.
    pub fn recorded(mesh: &Mesh<N>, slot: usize) -> impl Iterator<Item = Side> {
        let is_kept = move |side: &Side| Self::is_needed(mesh, slot, *side) || mesh.touches(slot, *side);
        Side::ALL.into_iter().filter(is_kept)
    }

    /// Keeps the values on the sides of a block that [`FluxRegister::recorded`] names.
    ///
    /// - `at`: where the block lies in padded rows; `block`: its part of the register; `first`: the number of the first quantity;
    ///   `values`: what passes the outer face of a side above the padded cell `k`.
    pub fn record<const K: usize>(
        mesh: &Mesh<N>,
        (slot, at): (usize, Frame),
        block: &mut [f64],
        first: usize,
        values: impl Fn(Side, usize) -> [f64; K],
    ) {
        for side in Self::recorded(mesh, slot) {
            let rows = &mut Self::rows(block, side)[first * N..];
            for along in 0..N {
                let (n, along_side) = (N as isize, along as isize);
                let k = match side {
                    Side::ZMin => at.index(-1, along_side),
                    Side::ZMax => at.index(n - 1, along_side),
                    Side::RMin => at.index(along_side, -1),
                    Side::RMax => at.index(along_side, n - 1),
                };
                for (quantity, value) in values(side, k).into_iter().enumerate() {
                    rows[quantity * N + along] = value;
                }
            }
        }
    }

    /// Whether a block has faces to correct on any side.
    pub fn is_due(mesh: &Mesh<N>, slot: usize) -> bool {
        Side::ALL.into_iter().any(|side| Self::is_corrected(mesh, slot, side))
    }

    /// Calls `correct` for every face of a block that has finer neighbours beyond it, side by side.
    ///
    /// - `finer`: what the finer side has passed; this register, unless levels step by themselves. `first`: the number of the first
    ///   of the K quantities.
    pub fn for_corrected_faces<const K: usize>(
        &self,
        finer: &Self,
        mesh: &Mesh<N>,
        slot: usize,
        first: usize,
        mut correct: impl FnMut(CorrectedFace<K>),
    ) {
        self.for_corrected_sides(finer, mesh, slot, first, |side, outward, differences: &[[f64; N]; K]| {
            for along in 0..N {
                let cell = match side {
                    Side::ZMin => [0, along],
                    Side::ZMax => [N - 1, along],
                    Side::RMin => [along, 0],
                    Side::RMax => [along, N - 1],
                };
                let difference = differences.map(|row| row[along]);
                correct(CorrectedFace { side, outward, cell, difference });
            }
        });
    }

    /// Calls `correct(side, outward, differences)` for every side of a block that has finer neighbours beyond it, with
    /// what [`CorrectedFace`] holds: quantity by quantity, along the side.
    pub fn for_corrected_sides<const K: usize>(
        &self,
        finer: &Self,
        mesh: &Mesh<N>,
        slot: usize,
        first: usize,
        mut correct: impl FnMut(Side, f64, &[[f64; N]; K]),
    ) {
        for side in Side::ALL {
            if let Neighbour::Finer(children) = mesh.tree().neighbours(slot)[side as usize] {
                let outward = if matches!(side, Side::ZMin | Side::RMin) { -1.0 } else { 1.0 };
                correct(side, outward, &self.differences(finer, mesh, (slot, side), first, children));
            }
        }
    }

    /// A quantity along one side of a block, of those that are kept.
    pub fn row(&self, slot: usize, side: Side, quantity: usize) -> &[f64; N] {
        let quantities = self.values.components() / Side::ALL.len();
        (self.values.component(slot, side as usize * quantities + quantity))
            .first_chunk()
            .expect("a row has as many faces as a block has cells along a side")
    }

    /// All quantities along one side of a block, one after the other, of those that are kept.
    pub fn side(&self, slot: usize, side: Side) -> &[f64] {
        let block = self.values.block(slot);
        let len = block.len() / Side::ALL.len();
        &block[side as usize * len..][..len]
    }

    /// The rows of one side in a block's part of the register: quantity by quantity, along the side.
    pub fn rows(block: &mut [f64], side: Side) -> &mut [f64] {
        let len = block.len() / Side::ALL.len();
        &mut block[side as usize * len..(side as usize + 1) * len]
    }

    /// Whether a block's values on a side will be asked for.
    pub fn is_needed(mesh: &Mesh<N>, slot: usize, side: Side) -> bool {
        matches!(mesh.tree().neighbours(slot)[side as usize], Neighbour::Finer(_) | Neighbour::Coarser(_))
    }

    /// Whether a block has finer neighbours beyond a side, and so faces to correct.
    pub fn is_corrected(mesh: &Mesh<N>, slot: usize, side: Side) -> bool {
        matches!(mesh.tree().neighbours(slot)[side as usize], Neighbour::Finer(_))
    }

    /// The mean of the finer side's values minus the block's own on the faces of a coarse block, quantity by quantity. The
    /// mean is weighted with the areas of the fine faces.
    ///
    /// - `first`: the number of the first quantity; `children`: the finer blocks beyond the side, see [`Neighbour::Finer`].
    fn differences<const K: usize>(
        &self,
        finer: &Self,
        mesh: &Mesh<N>,
        (slot, side): (usize, Side),
        first: usize,
        children: [usize; 2],
    ) -> [[f64; N]; K] {
        let opposite = match side {
            Side::ZMin => Side::ZMax,
            Side::ZMax => Side::ZMin,
            Side::RMin => Side::RMax,
            Side::RMax => Side::RMin,
        };
        // Faces across z lie along r and have areas like the halves of the cell behind them.
        let mut lower_shares = [0.5; N];
        if matches!(side, Side::ZMin | Side::ZMax) {
            let id = mesh.tree().leaves()[slot];
            let rows = mesh.radial(id.level + 1, i64::from(id.j) * N as i64);
            for (share, row) in lower_shares.iter_mut().zip(rows) {
                *share = row.lower_share;
            }
        }
        std::array::from_fn(|quantity| {
            let own = self.row(slot, side, first + quantity);
            let fine = children.map(|child| finer.row(child, opposite, first + quantity));
            std::array::from_fn(|along| {
                let (child, at) = (fine[along / (N / 2)], 2 * (along % (N / 2)));
                let (low, high) = (child[at], child[at + 1]);
                high + lower_shares[along] * (low - high) - own[along]
            })
        })
    }
}
