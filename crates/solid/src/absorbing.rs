//! What an absorbing side lets in: what has left over it, as it goes on beyond.
//!
//! The equation and where it comes from: docs/equations.md, "Absorbing sides of the solid".

use std::ops::Range;

use mesh::{BlockId, Geometry, Mesh, Side};
use serde::{Deserialize, Serialize};

use crate::rows::Elasticity;
use crate::state::component::{S_NORMAL, S_ZR, V_R, V_Z};
use crate::{Boundary, ElasticState};

/// The incoming characteristics on a face, above those of the initial state: Z₁v_n + σ_nn and Z₂v_t + σ_nt, n outwards, Pa.
pub(crate) type Incoming = [f64; 2];

/// Incoming characteristics q on the faces of one side of a block, over a step.
///
/// q obeys ∂q/∂t + c₂ ∂q/∂n + c₂ q/ℓ = 0 on the side, the first-order condition of Higdon (1990) for waves that leave at c₂ along
/// the normal and fall off as 1/ℓ. From the cell's centre to the face, over ½h, that is q_face = q_cell(t − τ)/(1 + h/2ℓ) with
/// τ = h/2c₂, the delay taken by τ ∂y/∂t = q_cell − y, implicit in time: a filter that never amplifies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Absorption {
    normal: usize,
    tangential: usize,
    stress: usize,
    /// ±1: the outward normal along the axis.
    outward: f64,
    impedances: [f64; 2],
    /// Δt/(τ + Δt).
    gain: f64,
    /// What of q is left on the face.
    share: f64,
}

impl Absorption {
    /// Of the faces of a side on a level, for a step of length `dt`.
    pub fn new<const N: usize>(
        mesh: &Mesh<N>,
        side: Side,
        level: u8,
        dt: f64,
        elasticity: &Elasticity,
    ) -> Self {
        let axis = axis_across(side);
        let half_width = 0.5 * mesh.widths(level)[axis];
        let delay = half_width / (elasticity.inverse_density * elasticity.z2);
        let domain = mesh.domain();
        let [low, high] = if axis == 0 { domain.z } else { domain.r };
        // Waves from a point fall off as the distance, those from a line as its root.
        let range = match domain.geometry {
            Geometry::Axisymmetric => high - low,
            Geometry::Planar => 2.0 * (high - low),
        };
        Self {
            normal: [V_Z, V_R][axis],
            tangential: [V_R, V_Z][axis],
            stress: S_NORMAL[axis],
            outward: if matches!(side, Side::ZMin | Side::RMin) { -1.0 } else { 1.0 },
            impedances: [elasticity.z1, elasticity.z2],
            gain: dt / (delay + dt),
            share: range / (range + half_width),
        }
    }

    /// The filtered characteristics of the cell beside a face after a step.
    ///
    /// - `before`: the same after the step before.
    /// - `cell`: a component of the cell's state in the middle of the step.
    pub fn follow(&self, before: Incoming, cell: impl Fn(usize) -> f64, initial: ElasticState) -> Incoming {
        let initial = initial.to_array();
        let above = |component: usize| cell(component) - initial[component];
        let pairs = [(self.normal, self.stress), (self.tangential, S_ZR)];
        std::array::from_fn(|wave| {
            let (velocity, stress) = pairs[wave];
            let arriving = self.impedances[wave] * above(velocity) + self.outward * above(stress);
            before[wave] + self.gain * (arriving - before[wave])
        })
    }

    /// The state beyond a face, whose incoming characteristics are those that a step follows; the initial one where they vanish.
    pub fn outer(&self, filtered: Incoming, initial: ElasticState) -> ElasticState {
        let mut state = initial.to_array();
        let [of_p, of_s] = filtered.map(|q| 0.5 * self.share * q);
        state[self.normal] += of_p / self.impedances[0];
        state[self.stress] += self.outward * of_p;
        state[self.tangential] += of_s / self.impedances[1];
        state[S_ZR] += self.outward * of_s;
        ElasticState::from_array(state)
    }
}

/// [`Incoming`] on each face along a side of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SideRow<const N: usize>(pub [Incoming; N]);

impl<const N: usize> Default for SideRow<N> {
    fn default() -> Self {
        Self([[0.0; 2]; N])
    }
}

/// What absorbing sides remember: the filtered characteristics on the faces of the finest level along them.
///
/// A coarser face sees the mean of those that it consists of and sets all of them alike: a grid that adapts has nothing to do here.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct SideMemory {
    finest: u8,
    values: [Vec<Incoming>; 4],
}

impl SideMemory {
    /// Of a solid in its initial state.
    pub fn new<const N: usize>(mesh: &Mesh<N>, kinds: [Boundary; 4]) -> Self {
        let values = Side::ALL.map(|side| vec![[0.0; 2]; faces_along(mesh, side, kinds)]);
        Self { finest: mesh.tree().finest(), values }
    }

    /// Whether it is that of a mesh with these sides.
    pub fn fits<const N: usize>(&self, mesh: &Mesh<N>, kinds: [Boundary; 4]) -> bool {
        self.finest == mesh.tree().finest()
            && Side::ALL
                .into_iter()
                .all(|side| self.values[side as usize].len() == faces_along(mesh, side, kinds))
    }

    /// Of the face number `along` of a level on a side.
    pub fn at(&self, side: Side, level: u8, along: usize) -> Incoming {
        let faces = &self.values[side as usize][self.faces(level, along)];
        let sum = faces.iter().fold([0.0; 2], |sum, q| [sum[0] + q[0], sum[1] + q[1]]);
        sum.map(|sum| sum / faces.len() as f64)
    }

    /// Sets that face.
    pub fn set(&mut self, side: Side, level: u8, along: usize, value: Incoming) {
        let faces = self.faces(level, along);
        self.values[side as usize][faces].fill(value);
    }

    fn faces(&self, level: u8, along: usize) -> Range<usize> {
        let halvings = self.finest - level;
        along << halvings..(along + 1) << halvings
    }
}

/// Faces of the finest level along a side; none where it does not absorb.
fn faces_along<const N: usize>(mesh: &Mesh<N>, side: Side, kinds: [Boundary; 4]) -> usize {
    if kinds[side as usize] != Boundary::Absorbing {
        return 0;
    }
    mesh.tree().blocks_on(mesh.tree().finest())[1 - axis_across(side)] as usize * N
}

/// The number along a side of the first face of a block.
pub(crate) fn first_face<const N: usize>(id: BlockId, side: Side) -> usize {
    [id.i, id.j][1 - axis_across(side)] as usize * N
}

/// The axis across a side: 0 z, 1 r.
pub(crate) fn axis_across(side: Side) -> usize {
    usize::from(matches!(side, Side::RMin | Side::RMax))
}

#[cfg(test)]
mod tests {
    use mesh::Domain;

    use super::*;
    use crate::WaveSpeeds;

    const STEEL: WaveSpeeds = WaveSpeeds { density: 7800.0, c1: 5990.0, c2: 3458.0 };
    const KINDS: [Boundary; 4] =
        [Boundary::Absorbing, Boundary::Interface, Boundary::Axis, Boundary::Absorbing];

    fn mesh() -> Mesh<8> {
        let domain = Domain { geometry: Geometry::Axisymmetric, z: [-2.0, 0.0], r: [0.0, 1.0] };
        Mesh::uniform(domain, [32, 16], 1, [false; 2]).expect("a mesh")
    }

    /// The Riemann problem with the outer state has the incoming characteristics that were followed, whatever leaves.
    #[test]
    fn the_outer_state_has_the_incoming_characteristics() {
        let e = Elasticity::new(STEEL);
        let initial = ElasticState { stress_zz: -5e7, stress_rr: -1e7, v_z: 0.5, ..ElasticState::default() };
        for side in [Side::ZMin, Side::ZMax, Side::RMin, Side::RMax] {
            let absorption = Absorption::new(&mesh(), side, 1, 1e-6, &e);
            let followed = [3e6, -2e6];
            let outer = absorption.outer(followed, initial).to_array();
            // With a cell of that state an endless step follows what is left of the same.
            let endless = Absorption { gain: 1.0, ..absorption };
            let back = endless.follow([1e9; 2], |component| outer[component], initial);
            for (back, followed) in back.into_iter().zip(followed) {
                assert!((back / (absorption.share * followed) - 1.0).abs() < 1e-6, "{side:?}");
            }
            assert_eq!(absorption.outer([0.0; 2], initial), initial);
            assert_eq!(absorption.follow([0.0; 2], |c| initial.to_array()[c], initial), [0.0; 2]);
        }
    }

    #[test]
    fn coarse_faces_see_means_and_set_all() {
        let mut memory = SideMemory::new(&mesh(), KINDS);
        assert!(memory.fits(&mesh(), KINDS) && !memory.fits(&mesh(), [Boundary::Free; 4]));
        let finest = mesh().tree().finest();
        memory.set(Side::RMax, finest, 6, [1.0, 2.0]);
        memory.set(Side::RMax, finest, 7, [3.0, -2.0]);
        assert_eq!(memory.at(Side::RMax, finest - 1, 3), [2.0, 0.0]);
        memory.set(Side::RMax, finest - 1, 3, [5.0, 6.0]);
        assert_eq!([6, 7].map(|along| memory.at(Side::RMax, finest, along)), [[5.0, 6.0]; 2]);
        assert_eq!(memory.at(Side::RMax, finest, 8), [0.0; 2]);
    }
}
