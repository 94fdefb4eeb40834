//! The faces between the two media, as one side has them.

use serde::{Deserialize, Serialize};

use crate::{Mesh, Misfit, Side};

/// The state of a face between the media during a step: means over it of p*, v*, the power, and where there is friction σ_zr*, v_r*.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FaceState {
    /// Mean pressure, Pa.
    pub pressure: f64,
    /// Mean velocity along +z, m/s.
    pub velocity: f64,
    /// Mean of what the upper medium does to the lower one, W/m²: p*v* − σ_zr* v_r*.
    pub power: f64,
    /// Mean shear stress σ_zr*, Pa; 0 without friction.
    pub shear: f64,
    /// Mean velocity of the wall along +r, m/s: what a viscous fluid sticks to.
    pub tangential_velocity: f64,
}

impl From<[f64; 3]> for FaceState {
    /// From p*, v*, p*v*.
    fn from([pressure, velocity, power]: [f64; 3]) -> Self {
        Self { pressure, velocity, power, ..Self::default() }
    }
}

impl From<[f64; 5]> for FaceState {
    /// From p*, v*, the power, σ_zr*, v_r*.
    fn from([pressure, velocity, power, shear, tangential_velocity]: [f64; 5]) -> Self {
        Self { pressure, velocity, power, shear, tangential_velocity }
    }
}

/// The blocks along the side that may meet another medium, and the faces on it if it does, in the order of r.
#[derive(Clone, Debug)]
pub struct Interface {
    side: Side,
    is_there: bool,
    blocks: Vec<usize>,
    /// Of each block of the mesh, if it has faces.
    first: Vec<Option<usize>>,
    states: Vec<FaceState>,
}

/// How fast a wall slides, face by face.
pub(super) struct Sliding {
    edges: Vec<f64>,
    velocities: Vec<f64>,
}

impl Interface {
    /// - `is_there`: whether another medium is beyond the side.
    pub(super) fn new<const N: usize>(mesh: &Mesh<N>, side: Side, is_there: bool) -> Self {
        let mut interface =
            Self { side, is_there, blocks: Vec::new(), first: Vec::new(), states: Vec::new() };
        interface.index(mesh);
        interface
    }

    /// Numbers the faces anew; what they had is gone.
    pub(super) fn index<const N: usize>(&mut self, mesh: &Mesh<N>) {
        self.blocks = mesh.blocks_along(self.side);
        self.first = vec![None; mesh.blocks()];
        let mut faces = 0;
        if self.is_there {
            for slot in &self.blocks {
                self.first[*slot] = Some(faces);
                faces += N;
            }
        }
        self.states = vec![FaceState::default(); faces];
    }

    /// Takes up what the faces had.
    pub(super) fn restore(&mut self, states: Vec<FaceState>) -> Result<(), Misfit> {
        if states.len() != self.states.len() {
            return Err(Misfit(format!("{} faces of the interface are not the grid's", states.len())));
        }
        self.states = states;
        Ok(())
    }

    /// Slots of the blocks along the side, ascending in r; with or without another medium.
    pub fn blocks(&self) -> &[usize] {
        &self.blocks
    }

    /// How many faces there are; none without another medium.
    pub fn faces(&self) -> usize {
        self.states.len()
    }

    /// The number of a block's first face, if it has any.
    pub fn first_face(&self, slot: usize) -> Option<usize> {
        self.first[slot]
    }

    /// The states of all faces.
    pub fn states(&self) -> &[FaceState] {
        &self.states
    }

    /// The states of a block's faces.
    pub fn states_of<const N: usize>(&self, slot: usize) -> Option<&[FaceState]> {
        self.first[slot].map(|first| &self.states[first..first + N])
    }

    /// Sets the state of a face.
    pub fn set(&mut self, face: usize, state: FaceState) {
        self.states[face] = state;
    }

    /// Sets the states of all faces.
    pub fn set_all(&mut self, state: impl Fn(usize) -> FaceState) {
        for (face, own) in self.states.iter_mut().enumerate() {
            *own = state(face);
        }
    }

    /// Sets the states of all faces from rows of p*, v*, p*v*.
    pub fn set_rows(&mut self, [pressure, velocity, power]: [&[f64]; 3]) {
        self.set_all(|face| [pressure[face], velocity[face], power[face]].into());
    }

    /// Sets what friction makes of all faces, from rows of σ_zr* and v_r*.
    pub fn set_friction(&mut self, [shear, tangential_velocity]: [&[f64]; 2]) {
        for (face, state) in self.states.iter_mut().enumerate() {
            (state.shear, state.tangential_velocity) = (shear[face], tangential_velocity[face]);
        }
    }

    /// How fast the wall slides on each face, with the faces' outer radii; `None` where it does not.
    pub(super) fn sliding<const N: usize>(&self, mesh: &Mesh<N>) -> Option<Sliding> {
        let velocities: Vec<f64> = self.states.iter().map(|state| state.tangential_velocity).collect();
        let slides = velocities.iter().any(|velocity| *velocity != 0.0);
        slides.then(|| Sliding { edges: self.edges(mesh), velocities })
    }

    /// Gives faces how fast the wall slid on those that were where their middles are: it is what the fluid sticks to in the next step.
    pub(super) fn slide<const N: usize>(&mut self, mesh: &Mesh<N>, before: &Sliding) {
        let mut low = mesh.domain().r[0];
        for (edge, state) in self.edges(mesh).into_iter().zip(&mut self.states) {
            let middle = 0.5 * (low + edge);
            let face = before.edges.partition_point(|edge| *edge <= middle).min(before.velocities.len() - 1);
            state.tangential_velocity = before.velocities[face];
            low = edge;
        }
    }

    /// The states of all faces, to be changed one number at a time.
    pub fn states_mut(&mut self) -> &mut [FaceState] {
        &mut self.states
    }

    /// The outer radius of each cell along the side, with or without another medium, ascending, m; the first one begins at the
    /// domain's r_min.
    pub fn edges<const N: usize>(&self, mesh: &Mesh<N>) -> Vec<f64> {
        let of_block = |slot: &usize| {
            let id = mesh.tree().leaves()[*slot];
            let h_r = mesh.widths(id.level)[1];
            (0..N).map(move |j| mesh.centre(id, 0, j)[1] + 0.5 * h_r)
        };
        self.blocks.iter().flat_map(of_block).collect()
    }
}
