//! Flux registers: what passes a face between levels, as the finer side has it.

use crate::{Field, Mesh, Neighbour, Side};

/// Values of K quantities on the outer faces of the blocks, kept where a block meets another level.
///
/// A coarse block first steps with its own face values; then [`FluxRegister::difference`] gives, face by face, the
/// mean of the finer side's values minus its own, and the solver corrects the cell behind the face. What leaves
/// one side then enters the other, to round-off.
#[derive(Clone, Debug)]
pub struct FluxRegister<const N: usize, const K: usize> {
    values: Field,
}

impl<const N: usize, const K: usize> FluxRegister<N, K> {
    /// For a mesh of that many blocks.
    pub fn new(blocks: usize) -> Self {
        Self { values: Field::zeros(blocks, N, K * Side::ALL.len()) }
    }

    /// The values of all blocks, to hand them to the threads that work on the blocks.
    pub fn values_mut(&mut self) -> &mut Field {
        &mut self.values
    }

    /// The rows of one side in a block's part of the register: quantity by quantity, along the side.
    pub fn rows(block: &mut [f64], side: Side) -> &mut [f64] {
        let len = K * N;
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

    fn value(&self, slot: usize, side: Side, quantity: usize, along: usize) -> f64 {
        self.values.component(slot, side as usize * K + quantity)[along]
    }

    /// The mean of the finer side's values on one face of a coarse block minus the block's own, quantity by
    /// quantity. The mean is weighted with the areas of the fine faces.
    ///
    /// - `slot`, `side`: one for which [`FluxRegister::is_corrected`] holds, else the difference is zero.
    pub fn difference(&self, mesh: &Mesh<N>, slot: usize, side: Side, along: usize) -> [f64; K] {
        let Neighbour::Finer(children) = mesh.tree().neighbours(slot)[side as usize] else { return [0.0; K] };
        let (child, first) = (children[along / (N / 2)], 2 * (along % (N / 2)));
        let (opposite, lower_share) = match side {
            Side::ZMin => (Side::ZMax, true),
            Side::ZMax => (Side::ZMin, true),
            Side::RMin => (Side::RMax, false),
            Side::RMax => (Side::RMin, false),
        };
        // Faces across z lie along r and have areas like the halves of the cell behind them.
        let lower_share = if lower_share {
            let id = mesh.tree().leaves()[slot];
            mesh.lower_share(id.level + 1, i64::from(id.j) * N as i64 + along as i64)
        } else {
            0.5
        };
        std::array::from_fn(|quantity| {
            let [low, high] = [0, 1].map(|k| self.value(child, opposite, quantity, first + k));
            high + lower_share * (low - high) - self.value(slot, side, quantity, along)
        })
    }
}
