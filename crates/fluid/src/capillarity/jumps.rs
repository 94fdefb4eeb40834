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

/// The faces of a padded block along one axis, indexed by the cell below them.
#[derive(Clone, Copy)]
pub(crate) struct FaceJumps<'a> {
    /// J = σκ on the faces, Pa; 0 where there is no interface.
    pub tension: &'a [f64],
    /// J(ψ_above − ψ_below), Pa.
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
        self.tension[k] != 0.0
    }

    fn gauge(&self, k: usize, [lower, upper]: &[FaceState; 2], mixture: &Mixture) -> Gauge {
        let [below, above] = [lower, upper].map(|side| share_beside(side, mixture));
        let across = self.tension[k] * (above - below);
        let own =
            [below - self.share[k], above - self.share[k + self.step]].map(|part| self.tension[k] * part);
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
