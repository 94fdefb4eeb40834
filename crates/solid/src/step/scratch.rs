//! What a thread works in.

use mesh::{Padded, Patch};

use crate::components::acting;
use crate::state::component::COUNT;
use crate::step::rows::FaceRows;

/// Scratch of one thread.
pub struct BlockScratch<const N: usize> {
    pub(crate) cells: Padded<N>,
    pub(crate) patch: Patch<N>,
    pub(crate) s_z: Padded<N>,
    pub(crate) s_r: Padded<N>,
    pub(super) half: Padded<N>,
    /// Plastic strain and temperature at mid-step; empty where nothing can yield.
    pub(super) flow: Vec<f64>,
    pub(crate) inverse_r: Vec<f64>,
    pub(super) z_faces: FaceRows,
    pub(super) r_faces: FaceRows,
}

impl<const N: usize> BlockScratch<N> {
    /// - `components`: of the field.
    pub(crate) fn new(components: usize) -> Self {
        let len = Padded::<N>::LEN;
        Self {
            cells: Padded::zeros(components),
            patch: Patch::zeros(components),
            s_z: Padded::zeros(COUNT),
            s_r: Padded::zeros(COUNT),
            half: Padded::zeros(COUNT),
            flow: vec![0.0; (acting(components) - COUNT) * len],
            inverse_r: vec![0.0; len],
            z_faces: FaceRows::zeros(len, Padded::<N>::STRIDE),
            r_faces: FaceRows::zeros(len, Padded::<N>::STRIDE),
        }
    }
}

/// The components of one block of a field.
pub(crate) fn split_block<const N: usize>(block: &mut [f64]) -> [&mut [f64]; COUNT] {
    let mut rows = block.chunks_exact_mut(N * N);
    std::array::from_fn(|_| rows.next().expect("a block has that many components"))
}
