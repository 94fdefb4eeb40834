//! What an absorbing side lets in: what has left over it, as it goes on beyond.
//!
//! The equation and where it comes from: docs/theory/absorbing-sides.md.

use std::sync::{Mutex, MutexGuard, PoisonError};

use mesh::{Geometry, Mesh, Side, SideFaces};

use crate::state::component::{S_NORMAL, S_ZR, V_R, V_Z};
use crate::step::rows::Elasticity;
use crate::{Boundary, ElasticState};

/// The incoming characteristics on a face, above those of the initial state: Z₁v_n + σ_nn and Z₂v_t + σ_nt, n outwards, Pa.
type Incoming = [f64; 2];

/// What a face remembers: q delayed by P waves' time to it, q of twice as far within likewise, and what that leaves of q,
/// delayed by S waves' time.
pub(crate) type Filters = [Incoming; 3];

/// How far within q is read, in cells: at the centre of the second cell, and on the face between the third and the fourth.
const DEPTH: f64 = 1.5;

/// What the factor for S waves keeps of q over [`DEPTH`]. With nearly all of it the jagged slopes that limiters make beside the
/// side would feed themselves.
const KEPT: f64 = 0.8;

/// How the incoming characteristics q on the faces of one side of a block follow what leaves, over a step.
///
/// (1 − E₁)(1 − E₂) q = 0: Higdon's (1990) product, for waves that leave at c₁ and at c₂ along the normal. E_j takes q from d = 3h/2
/// within to the face, with the delay d/c_j, by the filter (d/c_j) ∂y/∂t = q − y, implicit in time: it never amplifies. What
/// remains after that way is 1/(1 + d/ℓ) of it in E₁ and [`KEPT`] in E₂.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Absorption {
    normal: usize,
    tangential: usize,
    stress: usize,
    /// ±1: the outward normal along the axis.
    outward: f64,
    impedances: [f64; 2],
    /// Δt/(d/c + Δt) of P and of S waves.
    gains: [f64; 2],
    /// What remains of q over d in E₁.
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
        let axis = side.axis_across();
        let depth = DEPTH * mesh.widths(level)[axis];
        let impedances = [elasticity.z1, elasticity.z2];
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
            impedances,
            gains: impedances.map(|z| dt / (depth / (elasticity.inverse_density * z) + dt)),
            share: range / (range + depth),
        }
    }

    /// What a face remembers after a step.
    ///
    /// - `before`: the same after the step before.
    /// - `change`: since the start, of a component of the cell that has so many between itself and the face, at the step's beginning.
    pub fn follow(&self, before: Filters, change: impl Fn(isize, usize) -> f64) -> Filters {
        let mut after = before;
        for (wave, (velocity, stress)) in
            [(self.normal, self.stress), (self.tangential, S_ZR)].into_iter().enumerate()
        {
            let q = |depth: isize| {
                self.outward * self.impedances[wave] * change(depth, velocity) + change(depth, stress)
            };
            let (near, far) = (q(1), 0.5 * (q(2) + q(3)));
            let delay =
                |row: usize, gain: f64, value: f64| before[row][wave] + gain * (value - before[row][wave]);
            after[0][wave] = delay(0, self.gains[0], near);
            after[1][wave] = delay(1, self.gains[0], far);
            after[2][wave] = delay(2, self.gains[1], near - self.share * after[1][wave]);
        }
        after
    }

    /// The state beyond a face, whose incoming characteristics are those that a step follows; the initial one where they vanish.
    pub fn outer(&self, [of_p, _, of_s]: Filters, initial: ElasticState) -> ElasticState {
        let mut state = initial.to_array();
        let [q_n, q_t] = [0, 1].map(|wave| self.share * of_p[wave] + KEPT * of_s[wave]);
        state[self.normal] += self.outward * (0.5 * q_n) / self.impedances[0];
        state[self.stress] += 0.5 * q_n;
        state[self.tangential] += self.outward * (0.5 * q_t) / self.impedances[1];
        state[S_ZR] += 0.5 * q_t;
        ElasticState::from_array(state)
    }
}

/// [`Filters`] on the faces of the finest level along one side; none where it does not absorb.
pub(crate) type SideFilters = SideFaces<Filters>;

/// What a face sees of those that it consists of.
fn mean(faces: &[Filters]) -> Filters {
    let mut mean = Filters::default();
    for (row, wave) in (0..3).flat_map(|row| [(row, 0), (row, 1)]) {
        mean[row][wave] = faces.iter().map(|face| face[row][wave]).sum::<f64>() / faces.len() as f64;
    }
    mean
}

/// What absorbing sides remember, in the order of [`Side::ALL`].
#[derive(Debug)]
pub(crate) struct SideMemory {
    kept: [SideFilters; 4],
    /// Of steps that are under way. Blocks write their own faces: who comes first does not matter.
    followed: [Mutex<SideFilters>; 4],
}

impl SideMemory {
    /// Of a solid in its initial state.
    pub fn new<const N: usize>(mesh: &Mesh<N>, kinds: [Boundary; 4]) -> Self {
        let absorbs = |side: Side| kinds[side as usize] == Boundary::Absorbing;
        let kept = SideFaces::along_sides(mesh, absorbs, |_, _| Filters::default());
        Self { followed: kept.clone().map(Mutex::new), kept }
    }

    /// What is kept between two steps.
    pub fn kept(&self) -> &[SideFilters; 4] {
        &self.kept
    }

    /// Takes up what was kept; `false` if that is of other sides.
    pub fn restore(&mut self, kept: [SideFilters; 4]) -> bool {
        let fits = kept.iter().zip(&self.kept).all(|(kept, own)| kept.has_shape_of(own));
        if fits {
            self.kept = kept;
        }
        fits
    }

    /// Of the face number `along` of a level on a side.
    pub fn at(&self, side: Side, level: u8, along: usize) -> Filters {
        mean(self.kept[side as usize].of(level, along))
    }

    /// Where blocks that step write what their faces are to remember.
    pub fn follow(&self, side: Side) -> MutexGuard<'_, SideFilters> {
        self.followed[side as usize].lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Keeps what the faces of a block have followed in its step, which has ended.
    pub fn take_over<const N: usize>(&mut self, mesh: &Mesh<N>, slot: usize) {
        let id = mesh.tree().leaves()[slot];
        for side in Side::ALL {
            let kept = &mut self.kept[side as usize];
            if kept.is_empty() || !mesh.touches(slot, side) {
                continue;
            }
            let followed = self.followed[side as usize].get_mut().unwrap_or_else(PoisonError::into_inner);
            kept.copy_block::<N>(id, side, followed);
        }
    }
}

#[cfg(test)]
mod tests {
    use mesh::Domain;

    use super::*;
    use crate::WaveSpeeds;

    const STEEL: WaveSpeeds = WaveSpeeds { density: 7800.0, c1: 5990.0, c2: 3458.0 };

    fn mesh() -> Mesh<8> {
        let domain = Domain { geometry: Geometry::Axisymmetric, z: [-2.0, 0.0], r: [0.0, 1.0] };
        Mesh::uniform(domain, [32, 16], 1, [false; 2]).expect("a mesh")
    }

    /// Of a state that stays, q on the face goes on as it falls off within; without one above the initial state nothing is let in.
    #[test]
    fn a_state_that_stays_goes_on() {
        let e = Elasticity::new(STEEL);
        let initial = ElasticState { stress_zz: -5e7, stress_rr: -1e7, v_z: 0.5, ..ElasticState::default() };
        for side in Side::ALL {
            let absorption = Absorption::new(&mesh(), side, 1, 1e-6, &e);
            // Falls off by the share of E₁ over each depth.
            let falls = |depth: isize, component: usize| {
                let over = (depth as f64 + 0.5) / DEPTH;
                let above = [1.0, -2.0, 3e6, 2e6, -1e6, 0.0][component];
                above * (1.0 + (1.0 / absorption.share - 1.0) * over)
            };
            let mut filters = Filters::default();
            for _ in 0..4000 {
                filters = absorption.follow(filters, falls);
            }
            let outer = absorption.outer(filters, initial).to_array();
            // The outer state has the incoming characteristics that the face is to have.
            let endless = Absorption { gains: [1.0; 2], ..absorption };
            let change = |_, component: usize| outer[component] - initial.to_array()[component];
            let beyond = endless.follow(Filters::default(), change);
            for wave in [0, 1] {
                let want = absorption.share * filters[0][wave] + KEPT * filters[2][wave];
                assert!((beyond[0][wave] / want - 1.0).abs() < 1e-9, "{side:?}");
                // E₁ alone is right; nothing is left to E₂.
                assert!((want / (absorption.share * filters[0][wave]) - 1.0).abs() < 0.03, "{side:?}");
            }
            assert_eq!(absorption.outer(Filters::default(), initial), initial);
            let rest = absorption.follow(Filters::default(), |_, _| 0.0);
            assert_eq!(rest, Filters::default());
        }
    }

    #[test]
    fn coarse_faces_see_means_and_set_all() {
        let kinds = [Boundary::Absorbing, Boundary::Interface, Boundary::Axis, Boundary::Absorbing];
        let mut memory = SideMemory::new(&mesh(), kinds);
        let finest = mesh().tree().finest();
        let all = |value: f64| [[value; 2]; 3];
        let slot = mesh().blocks_along(Side::RMax)[0];
        {
            let mut followed = memory.follow(Side::RMax);
            followed.of_mut(finest, 6).fill(all(1.0));
            followed.of_mut(finest, 7).fill(all(3.0));
        }
        assert_eq!(memory.at(Side::RMax, finest, 6), all(0.0), "the step has not ended");
        memory.take_over(&mesh(), slot);
        assert_eq!(memory.at(Side::RMax, finest, 6), all(1.0));
        assert_eq!(memory.at(Side::RMax, finest - 1, 3), all(2.0));
        assert!(!memory.restore(Default::default()) && memory.restore(memory.kept().clone()));
    }
}
