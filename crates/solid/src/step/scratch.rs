//! What a thread works in.

use mesh::{AlignedRow, Frame, Padded, Patch, Tile, TileRows};

use crate::components::{PLASTIC_STRAIN, TEMPERATURE};
use crate::state::component::COUNT;
use crate::step::rows::FaceRows;
use crate::step::sweep::SweepScratch;

/// Scratch of one thread.
pub struct BlockScratch<const N: usize> {
    pub(crate) cells: TileRows<N>,
    pub(crate) patch: Patch<N>,
    pub(crate) s_z: Padded<N>,
    pub(crate) s_r: Padded<N>,
    pub(super) half: Padded<N>,
    pub(super) flow: FlowRows,
    pub(crate) inverse_r: Vec<f64>,
    pub(super) z_faces: FaceRows,
    pub(super) r_faces: FaceRows,
    pub(super) sweep: Box<SweepScratch>,
}

/// What flows until mid-step, in padded rows; empty where nothing can yield.
#[derive(Clone, Debug)]
pub(crate) struct FlowRows {
    /// Whether anything may; nothing else means anything otherwise.
    pub acts: bool,
    pub strain: AlignedRow,
    /// Empty where the law has no heat.
    pub temperature: AlignedRow,
    pub increment: AlignedRow,
    pub work: AlignedRow,
}

impl FlowRows {
    fn zeros(components: usize, len: usize, stride: usize) -> Self {
        let row = |is_there: bool| AlignedRow::zeros(if is_there { len } else { 0 }, stride);
        let yields = components > PLASTIC_STRAIN;
        Self {
            acts: false,
            strain: row(yields),
            temperature: row(components > TEMPERATURE),
            increment: row(yields),
            work: row(yields),
        }
    }
}

impl<const N: usize> BlockScratch<N> {
    /// - `components`: of the field.
    pub(crate) fn new(components: usize) -> Self {
        let len = Padded::<N>::LEN;
        let largest = if Tile::holds_four::<N>() { Frame::of(2 * N).len() } else { len };
        Self {
            cells: TileRows::zeros(components),
            patch: Patch::zeros(components),
            s_z: Padded::zeros(COUNT),
            s_r: Padded::zeros(COUNT),
            half: Padded::zeros(COUNT),
            flow: FlowRows::zeros(components, len, Padded::<N>::STRIDE),
            inverse_r: vec![0.0; largest],
            z_faces: FaceRows::zeros(len, Padded::<N>::STRIDE),
            r_faces: FaceRows::zeros(len, Padded::<N>::STRIDE),
            sweep: SweepScratch::zeros(),
        }
    }
}
