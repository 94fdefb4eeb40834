//! What a thread works in where there is gas.

use mesh::{Frame, Marks, Mesh};

use super::mixed::MixedCells;

/// Scratch of one thread.
pub(crate) struct GasScratch {
    pub(super) mixed: MixedCells,
    /// Which padded cells fall back in this step, and which cells of the block should.
    pub(super) is_marked: Vec<bool>,
    pub(super) marked: Vec<usize>,
}

impl GasScratch {
    /// For rows of a frame.
    pub fn new(frame: Frame) -> Self {
        let len = frame.len();
        Self { mixed: MixedCells::new(frame), is_marked: vec![false; len], marked: Vec::with_capacity(len) }
    }

    /// Takes notice of the cells of a block that fall back in this step, and tells their padded places.
    pub fn mark<const N: usize>(
        &mut self,
        mesh: &Mesh<N>,
        slot: usize,
        marks: &Marks<N>,
    ) -> impl Iterator<Item = usize> + '_ {
        super::marks::padded_marks(mesh, slot, marks, &mut self.is_marked);
        self.is_marked.iter().enumerate().filter(|(_, is_marked)| **is_marked).map(|(k, _)| k)
    }
}
