//! What multiresolution analysis must know of a solid: which details matter, how fields meet the sides.

use mesh::{MOST_COMPONENTS, Multiresolution, Side};

use crate::Boundary;
use crate::boundary::parity;
use crate::components::PLASTIC_STRAIN;

/// The solid's part in multiresolution analysis.
#[derive(Clone, Debug)]
pub struct Analysis {
    pub(crate) boundaries: [Boundary; 4],
    /// Reference value of the stresses, Pa.
    pub(crate) stress_scale: f64,
    /// ρ̄c₁, with which velocities count as stresses, Pa s/m.
    pub(crate) impedance: f64,
    /// What details of plastic strain count as stresses, Pa; 0 where nothing can yield.
    pub(crate) strain_modulus: f64,
}

impl Multiresolution for Analysis {
    fn parity(&self, side: Side, component: usize) -> Option<f64> {
        match self.boundaries[side as usize] {
            Boundary::Periodic => None,
            kind => parity(kind, side, component),
        }
    }

    fn counts_beside(&self, side: Side) -> bool {
        self.boundaries[side as usize] != Boundary::NonReflecting
    }

    /// All states are admissible: ghosts beyond level jumps may lie outside the yield surface, as the states at mid-step are
    /// returned. Of cells that stay see [`crate::components::admissible::Admissible`].
    fn share(&self, _: &[f64], _: &[[f64; MOST_COMPONENTS]; 4]) -> f64 {
        1.0
    }

    /// The largest of |δσ|/σ_ref over the stresses, ρ̄c₁|δv|/σ_ref, and 3μ|δε_p|/σ_ref.
    #[inline(always)]
    fn significance(&self, _: &[f64], detail: &[f64]) -> f64 {
        let velocity = self.impedance * detail[0].abs().max(detail[1].abs());
        let slow = velocity.max(self.strain_modulus * detail[PLASTIC_STRAIN].abs());
        detail[2..6].iter().fold(slow, |largest, stress| stress.abs().max(largest)) / self.stress_scale
    }
}
