//! What a thread works in.

use mesh::{AlignedRow, FaceState, GHOSTS, Interface, Mesh, Neighbour, Offset, Padded, Patch};

use crate::capillarity::CapillaryRows;
use crate::components::carried::CarriedScratch;
use crate::state::COUNT;
use crate::state::conserved::{GAS, PHI};
use crate::step::face_rows::FaceRows;
use crate::two_phase::GasScratch;

/// Scratch of one thread.
pub struct BlockScratch<const N: usize> {
    pub(crate) cells: Padded<N>,
    pub(crate) patch: Patch<N>,
    pub(crate) s_z: Padded<N>,
    pub(crate) s_r: Padded<N>,
    pub(crate) half: Padded<N>,
    pub(crate) keep: AlignedRow,
    /// Sound speeds at the beginning of the step.
    pub(super) sound: AlignedRow,
    /// m_g/ρ of the padded cells, where phases have masses of their own and there is gas.
    pub(crate) gas_shares: AlignedRow,
    pub(crate) inverse_r: Vec<f64>,
    pub(super) z_faces: FaceRows,
    pub(super) r_faces: FaceRows,
    pub(super) speeds: Padded<N>,
    pub(super) face_weight: Vec<f64>,
    pub(super) inverse_weight: Vec<f64>,
    /// The block at the beginning of the step with what comes into its cells besides; used where there are terms.
    pub(super) with_sources: Vec<f64>,
    /// What terms work in, a part for each.
    pub(crate) works: Vec<Vec<f64>>,
    /// What stages begin with.
    pub(super) spread_work: Vec<f64>,
    /// See [`crate::terms::TermBlock::wall`]; empty where the block has none.
    pub(crate) wall: Vec<FaceState>,
    /// See [`crate::terms::HeatBeyond::Wall`].
    pub(super) wall_temperatures: Vec<f64>,
    /// A part for each component that the mass carries.
    pub(super) carried: Vec<CarriedScratch>,
    pub(crate) gas: GasScratch,
    /// The jumps of pressure across interfaces, where there is surface tension.
    pub(crate) capillary: CapillaryRows,
    /// Whether the rows of the gas fraction may hold anything but zeros.
    pub(crate) has_gas: bool,
}

impl<const N: usize> BlockScratch<N> {
    /// For fields of so many components, the last `carried` of which the mass carries.
    pub(crate) fn new(components: usize, carried: usize) -> Self {
        let len = Padded::<N>::LEN;
        Self {
            cells: Padded::zeros(components),
            patch: Patch::zeros(components),
            s_z: Padded::zeros(COUNT),
            s_r: Padded::zeros(COUNT),
            half: Padded::zeros(COUNT),
            keep: AlignedRow::zeros(len, Padded::<N>::STRIDE),
            sound: AlignedRow::zeros(len, Padded::<N>::STRIDE),
            gas_shares: AlignedRow::zeros(len, Padded::<N>::STRIDE),
            inverse_r: vec![0.0; len],
            z_faces: FaceRows::zeros(len, Padded::<N>::STRIDE),
            r_faces: FaceRows::zeros(len, Padded::<N>::STRIDE),
            speeds: Padded::zeros(3),
            face_weight: vec![0.0; N + 1],
            inverse_weight: vec![0.0; N],
            with_sources: Vec::new(),
            works: Vec::new(),
            spread_work: Vec::new(),
            wall: Vec::with_capacity(N + 2 * GHOSTS),
            wall_temperatures: vec![0.0; N + 2],
            carried: (0..carried).map(|_| CarriedScratch::new::<N>()).collect(),
            gas: GasScratch::new::<N>(),
            capillary: CapillaryRows::default(),
            has_gas: false,
        }
    }

    /// There is no gas in the block; most leave it at that.
    pub(super) fn without_gas(&mut self) {
        if std::mem::take(&mut self.has_gas) {
            for rows in [&mut self.cells, &mut self.s_z, &mut self.s_r, &mut self.half] {
                rows.component_mut(PHI).fill(0.0);
            }
            self.cells.component_mut(GAS).fill(0.0);
        }
        self.z_faces.without_gas();
        self.r_faces.without_gas();
    }
}

/// Takes the states of a block's faces of the wall to another medium, and of as many more at both ends as there are ghosts: of the block of
/// its level beside it, or else the block's last. Nothing where it has none.
pub(crate) fn take_wall<const N: usize>(
    mesh: &Mesh<N>,
    interface: &Interface,
    slot: usize,
    wall: &mut Vec<FaceState>,
) {
    wall.clear();
    let Some(own) = interface.states_of::<N>(slot) else { return };
    let neighbours = mesh.tree().neighbours(slot);
    let beside = |j: i8| {
        let place = Offset::ALL.iter().position(|offset| *offset == Offset { i: 0, j });
        match place.map(|place| neighbours[place]) {
            Some(Neighbour::Same(other)) => interface.states_of::<N>(other),
            _ => None,
        }
    };
    match beside(-1) {
        Some(below) => wall.extend_from_slice(&below[N - GHOSTS..]),
        None => wall.extend([own[0]; GHOSTS]),
    }
    wall.extend_from_slice(own);
    match beside(1) {
        Some(above) => wall.extend_from_slice(&above[..GHOSTS]),
        None => wall.extend([own[N - 1]; GHOSTS]),
    }
}

/// The first components of one block of a field.
pub(crate) fn split_block<const N: usize>(block: &mut [f64]) -> [&mut [f64]; COUNT] {
    let mut rows = block.chunks_exact_mut(N * N);
    std::array::from_fn(|_| rows.next().expect("a block has that many components"))
}
