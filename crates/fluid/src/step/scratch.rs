//! What a thread works in.

use mesh::{AlignedRow, FaceState, Frame, GHOSTS, Interface, Mesh, Neighbour, Offset, Patch, Tile, TileRows};

use crate::capillarity::CapillaryRows;
use crate::components::carried::CarriedScratch;
use crate::state::COUNT;
use crate::state::conserved::PHI;
use crate::step::face_rows::{FaceRows, used_faces};
use crate::two_phase::GasScratch;

/// Scratch of one thread, for a block.
pub struct BlockScratch<const N: usize> {
    /// That for a tile of four blocks.
    pub(crate) of_four: Option<Box<Self>>,
    pub(crate) cells: TileRows<N>,
    pub(crate) patch: Patch<N>,
    pub(crate) s_z: TileRows<N>,
    pub(crate) s_r: TileRows<N>,
    pub(crate) half: TileRows<N>,
    pub(crate) keep: AlignedRow,
    /// Sound speeds at the beginning of the step.
    pub(super) sound: AlignedRow,
    /// m_g/ρ of the padded cells, where phases have masses of their own and there is gas.
    pub(crate) gas_shares: AlignedRow,
    pub(crate) inverse_r: Vec<f64>,
    /// 1 at the cells above which faces along z and r count, else 0.
    pub(super) used_faces: [AlignedRow; 2],
    pub(super) z_faces: FaceRows,
    pub(super) r_faces: FaceRows,
    pub(super) speeds: TileRows<N>,
    /// Of each row of blocks by itself.
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
        let of_four = Tile::holds_four::<N>().then(|| Box::new(Self::of(2, components, carried)));
        Self { of_four, ..Self::of(1, components, carried) }
    }

    /// For so many blocks along each side.
    fn of(across: usize, components: usize, carried: usize) -> Self {
        let frame = Frame::of(across * N);
        let (len, stride) = (frame.len(), frame.stride());
        Self {
            of_four: None,
            cells: TileRows::zeros(components),
            patch: Patch::zeros(components),
            s_z: TileRows::zeros(COUNT),
            s_r: TileRows::zeros(COUNT),
            half: TileRows::zeros(COUNT),
            keep: AlignedRow::zeros(len, stride),
            sound: AlignedRow::zeros(len, stride),
            gas_shares: AlignedRow::zeros(len, stride),
            inverse_r: vec![0.0; len],
            used_faces: [1, stride].map(|step| used_faces(frame, step)),
            z_faces: FaceRows::zeros(len, stride),
            r_faces: FaceRows::zeros(len, stride),
            speeds: TileRows::zeros(3),
            face_weight: vec![0.0; across * (N + 1)],
            inverse_weight: vec![0.0; across * N],
            with_sources: Vec::new(),
            works: Vec::new(),
            spread_work: Vec::new(),
            wall: Vec::with_capacity(N + 2 * GHOSTS),
            wall_temperatures: vec![0.0; N + 2],
            carried: (0..carried).map(|_| CarriedScratch::new::<N>()).collect(),
            gas: GasScratch::new(frame),
            capillary: CapillaryRows::default(),
            has_gas: false,
        }
    }

    /// There is no gas in the block; most leave it at that.
    ///
    /// - `gas`: the component of its mass, if it has one.
    pub(super) fn without_gas(&mut self, gas: Option<usize>) {
        if std::mem::take(&mut self.has_gas) {
            for rows in [&mut self.cells, &mut self.s_z, &mut self.s_r, &mut self.half] {
                rows.component_mut(PHI).fill(0.0);
            }
            if let Some(gas) = gas {
                self.cells.component_mut(gas).fill(0.0);
            }
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
