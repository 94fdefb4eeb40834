//! The paper's mixture of two stiffened gases, as kernels use it.

use crate::{NobleAbelStiffenedGas, StiffenedGas};

/// β₁ = 1/(γ − 1) and β₂ = γπ/(γ − 1) as linear functions of the gas fraction φ, paper eq. (10).
///
/// At uniform pressure and velocity the energy β₁p + β₂ + ρv²/2 is then linear in φ and ρ, so that averages
/// of cells that differ only in φ and ρ have the same pressure and velocity (Abgrall 1996).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mixture {
    beta1_liquid: f64,
    beta1_difference: f64,
    beta2_liquid: f64,
    beta2_difference: f64,
    /// The liquid (φ = 0).
    pub liquid: NobleAbelStiffenedGas,
    /// The gas (φ = 1).
    pub gas: NobleAbelStiffenedGas,
}

impl Mixture {
    /// The mixture of a liquid (φ = 0) and a gas (φ = 1).
    pub fn new(liquid: impl Into<NobleAbelStiffenedGas>, gas: impl Into<NobleAbelStiffenedGas>) -> Self {
        let (liquid, gas) = (liquid.into(), gas.into());
        let beta1 = |s: NobleAbelStiffenedGas| 1.0 / (s.gamma - 1.0);
        let beta2 = |s: NobleAbelStiffenedGas| s.gamma * s.pi / (s.gamma - 1.0);
        Self {
            beta1_liquid: beta1(liquid),
            beta1_difference: beta1(gas) - beta1(liquid),
            beta2_liquid: beta2(liquid),
            beta2_difference: beta2(gas) - beta2(liquid),
            liquid,
            gas,
        }
    }

    /// β₁(φ).
    #[inline(always)]
    pub fn beta1(&self, phi: f64) -> f64 {
        self.beta1_liquid + phi * self.beta1_difference
    }

    /// β₂(φ), Pa.
    #[inline(always)]
    pub fn beta2(&self, phi: f64) -> f64 {
        self.beta2_liquid + phi * self.beta2_difference
    }

    /// ρc² = γ(φ)(p + π(φ)) = ((1 + β₁) p + β₂)/β₁ of the frozen mixture, Pa.
    #[inline(always)]
    pub fn bulk_modulus(&self, pressure: f64, phi: f64) -> f64 {
        let beta1 = self.beta1(phi);
        ((1.0 + beta1) * pressure + self.beta2(phi)) / beta1
    }

    /// The stiffened gas that the mixture behaves as, paper eq. (11).
    #[inline]
    pub fn at(&self, phi: f64) -> StiffenedGas {
        let (beta1, beta2) = (self.beta1(phi), self.beta2(phi));
        StiffenedGas { gamma: 1.0 + 1.0 / beta1, pi: beta2 / (1.0 + beta1) }
    }

    /// φ of a mixture with the internal energy ρe (J/m³) at a pressure: ρe = β₁(φ) p + β₂(φ) is linear in φ.
    pub(crate) fn fraction_of(&self, internal: f64, pressure: f64) -> f64 {
        (internal - self.beta1_liquid * pressure - self.beta2_liquid)
            / (self.beta1_difference * pressure + self.beta2_difference)
    }

    /// Whether one of the phases has temperatures.
    pub(crate) fn has_temperature(&self) -> bool {
        self.liquid.heat.is_some() || self.gas.heat.is_some()
    }

    /// Whether a cell of this gas fraction cannot bear tension.
    pub(crate) fn has_gas_floor(phi: f64) -> bool {
        phi > GAS_FLOOR_FRACTION
    }

    /// The lowest pressure that a cell may hold: 1e-4 Pa above vacuum where there is gas, else a tension of
    /// 0.9 π of the liquid. What lies below is lifted and counted, see [`crate::Fixups`].
    #[inline(always)]
    pub fn pressure_floor(&self, phi: f64) -> f64 {
        if phi > GAS_FLOOR_FRACTION { 1e-4 - self.gas.pi } else { 1e-6 - 0.9 * self.liquid.pi }
    }
}

/// Above this gas fraction a cell cannot bear tension.
const GAS_FLOOR_FRACTION: f64 = 1e-3;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pure_phases_are_themselves_and_bulk_modulus_is_gamma_p_plus_pi() {
        let liquid = StiffenedGas { gamma: 7.15, pi: 3e8 };
        let gas = StiffenedGas { gamma: 1.4, pi: 0.0 };
        let mixture = Mixture::new(liquid, gas);
        for (phi, pure) in [(0.0, liquid), (1.0, gas)] {
            let at = mixture.at(phi);
            approx::assert_relative_eq!(at.gamma, pure.gamma, max_relative = 1e-14);
            approx::assert_relative_eq!(at.pi, pure.pi, epsilon = 1e-6, max_relative = 1e-14);
        }
        for phi in [0.0, 0.3, 1.0] {
            let at = mixture.at(phi);
            approx::assert_relative_eq!(
                mixture.bulk_modulus(5e6, phi),
                at.gamma * (5e6 + at.pi),
                max_relative = 1e-13
            );
        }
    }
}
