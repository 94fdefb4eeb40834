//! The jump of pressure that a face carries, in the states of its Riemann problem and in its fluxes.

use crate::Mixture;
use crate::riemann::hllc::Face;
use crate::state::primitive::{PHI, PRESSURE, RHO};
use crate::two_phase::FaceState;

/// ψ = φβ₁(1)/β₁(φ), β₁ of the free volumes: how much of Laplace's jump the pressure of a mixed cell has risen by.
///
/// Where gas at p + J and liquid at p are mixed, ρe = β₁(p + ψJ) + β₂. So a step of J that moves with uniform velocity keeps its
/// pressures on both sides, whatever the gas fraction of the cells between is.
///
/// - `gas`: m_g, kg/m³; like ρ without a say where no phase has a covolume.
#[inline(always)]
pub(crate) fn share_of_jump(phi: f64, rho: f64, gas: f64, mixture: &Mixture) -> f64 {
    let of_gas = phi * mixture.beta1(1.0);
    if mixture.has_covolume() {
        let bound = mixture.beta1(1.0) - mixture.free_betas::<true>(1.0, gas, gas)[0];
        (of_gas - bound) / mixture.free_betas::<true>(phi, rho, gas)[0]
    } else {
        of_gas / mixture.beta1(phi)
    }
}

/// ψ on the side of a face.
#[inline(always)]
fn share_beside(FaceState { w, gas_share }: &FaceState, mixture: &Mixture) -> f64 {
    share_of_jump(w[PHI], w[RHO], w[RHO] * gas_share, mixture)
}

/// The tension beside a face.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Tension {
    /// J = σκ of the cells below and above, Pa; both 0 where there is no interface.
    pub of_cells: [f64; 2],
    /// The gas fraction between them at which J passes from the one to the other.
    pub passes_at: f64,
}

impl Tension {
    /// One J for both cells, Pa; `phi`: their gas fractions.
    pub fn even(own: f64, phi: [f64; 2]) -> Self {
        Self { of_cells: [own; 2], passes_at: 0.5 * (phi[0] + phi[1]) }
    }

    /// What the pressure rises by from the cell below to the one above where the liquid's is the same, and the force of tension, σκ∇φ,
    /// is all there is:
    ///
    /// [(ψ − φ) J] + ∫ J dφ = J_above (ψ_above − φ) − J_below (ψ_below − φ) with φ = `passes_at`.
    ///
    /// The mixture's mean pressure is p_l + φJ, while the one that its energy has is p_l + ψJ, see [`share_of_jump`]. Where J does not
    /// change this is J(ψ_above − ψ_below). Where it does, cells that liquid and gas share would follow the gas's pressure without
    /// the first term, though most of their mass is liquid.
    ///
    /// - `shares`: ψ below and above. returns: Pa.
    #[inline(always)]
    pub fn rise(&self, [below, above]: [f64; 2]) -> f64 {
        let [j_below, j_above] = self.of_cells;
        j_above * (above - self.passes_at) - j_below * (below - self.passes_at)
    }
}

/// The faces of a padded block along one axis, indexed by the cell below them.
#[derive(Clone, Copy)]
pub(crate) struct FaceJumps<'a> {
    pub tension: &'a [Tension],
    /// [`Tension::rise`] between the cells, Pa.
    pub jump: &'a [f64],
    /// ψ of the cells.
    pub share: &'a [f64],
    /// Distance of the cells on both sides of a face.
    pub step: usize,
}

/// What the pressures of a face's Riemann problem are beside those of the cells, on the lower and the upper side, Pa.
#[derive(Clone, Copy, Debug)]
struct Gauge {
    /// What is added.
    shifts: [f64; 2],
    /// What of it belongs to the gas fraction on the face.
    own: [f64; 2],
}

impl FaceJumps<'_> {
    /// Whether the face above cell `k` carries a jump.
    #[inline(always)]
    pub fn has(&self, k: usize) -> bool {
        self.tension[k].of_cells != [0.0; 2]
    }

    fn gauge(&self, k: usize, [lower, upper]: &[FaceState; 2], mixture: &Mixture) -> Gauge {
        let [below, above] = [lower, upper].map(|side| share_beside(side, mixture));
        let tension = &self.tension[k];
        let across = tension.rise([below, above]);
        let [j_below, j_above] = tension.of_cells;
        let own = [j_below * (below - self.share[k]), j_above * (above - self.share[k + self.step])];
        // The side of more gas keeps its pressure: to the liquid's stiffness the jump is nothing.
        let shifts = if below >= above { [own[0], own[1] - across] } else { [own[0] + across, own[1]] };
        Gauge { shifts, own }
    }

    /// The states between which the Riemann problem of a face is one without tension.
    ///
    /// - `states`: with pressures that have the jump's part of the cells' means; on the lower and upper side of the face above `k`.
    pub fn level(&self, k: usize, mut states: [FaceState; 2], mixture: &Mixture) -> [FaceState; 2] {
        let Gauge { shifts, .. } = self.gauge(k, &states, mixture);
        for (state, shift) in states.iter_mut().zip(shifts) {
            state.w[PRESSURE] += shift;
        }
        states
    }

    /// The fluxes with the jump: the pressure is the mean of what both cells feel, ½ jump above the lower one's and as much below the
    /// upper one's; the energy that crosses is the fluid's own, and the work that of the mean.
    ///
    /// - `states`: as [`FaceJumps::level`] got them; `face`: the solution of what it made.
    pub fn settle(&self, k: usize, states: &[FaceState; 2], mut face: Face, mixture: &Mixture) -> Face {
        let Gauge { shifts, own } = self.gauge(k, states, mixture);
        let from = usize::from(face.velocity < 0.0);
        let FaceState { w, gas_share } = states[from];
        let rho = w[RHO] * face.compression;
        let [beta1, _] = mixture.free_betas::<true>(w[PHI], rho, rho * gas_share);
        let foreign = beta1 * (shifts[from] - own[from]);
        let mean = face.pressure - shifts[0] + 0.5 * self.jump[k];
        face.energy += face.velocity * ((mean - face.pressure) - foreign);
        face.pressure = mean;
        face
    }
}
