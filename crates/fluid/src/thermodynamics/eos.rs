//! The stiffened-gas equation of state.

use crate::thermodynamics::wave_curve::ln_pressure_ratio;

/// A stiffened gas: p = (γ − 1) ρe − γπ, paper eq. (6). With π = 0 it is the ideal gas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StiffenedGas {
    /// Adiabatic exponent γ > 1.
    pub gamma: f64,
    /// Stiffness π ≥ 0, Pa.
    pub pi: f64,
}

impl StiffenedGas {
    /// β₁ = 1/(γ − 1), the factor of the pressure in ρe = β₁p + β₂.
    ///
    /// Paper: with eq. (10).
    ///
    /// - returns: β₁, dimensionless.
    /// - valid for: γ > 1; otherwise not finite or negative.
    /// - errors: none.
    /// - tested by: energy and pressure are inverses, mixture limits.
    #[inline]
    #[must_use]
    pub fn beta1(self) -> f64 {
        1.0 / (self.gamma - 1.0)
    }

    /// β₂ = γπ/(γ − 1), the energy at p = 0 in ρe = β₁p + β₂.
    ///
    /// Paper: with eq. (10).
    ///
    /// - returns: β₂, J/m³.
    /// - valid for: γ > 1; otherwise not finite or negative.
    /// - errors: none.
    /// - tested by: energy and pressure are inverses, mixture limits.
    #[inline]
    #[must_use]
    pub fn beta2(self) -> f64 {
        self.gamma * self.pi / (self.gamma - 1.0)
    }

    /// Pressure p = (γ − 1) ρe − γπ.
    ///
    /// Menikoff & Plohr (1989); paper: eq. (6).
    ///
    /// - `internal_energy`: ρe, per volume, J/m³. The density does not enter otherwise.
    /// - returns: p, Pa. Rounding of ρe comes through as γπ times the machine precision.
    /// - valid for: any finite argument; the state is admissible if p + π > 0, which is not checked.
    /// - errors: none.
    /// - tested by: energy and pressure are inverses.
    #[inline]
    #[must_use]
    pub fn pressure(self, internal_energy: f64) -> f64 {
        (self.gamma - 1.0) * internal_energy - self.gamma * self.pi
    }

    /// Internal energy per volume ρe = (p + γπ)/(γ − 1) = β₁p + β₂.
    ///
    /// Menikoff & Plohr (1989); paper: eq. (6).
    ///
    /// - `p`: pressure, Pa.
    /// - returns: ρe, J/m³.
    /// - valid for: γ > 1.
    /// - errors: none.
    /// - tested by: energy and pressure are inverses.
    #[inline]
    #[must_use]
    pub fn internal_energy(self, p: f64) -> f64 {
        (p + self.gamma * self.pi) / (self.gamma - 1.0)
    }

    /// Sound speed c = √(γ(p + π)/ρ).
    ///
    /// Menikoff & Plohr (1989); the isentropic derivative dp/dρ of eq. (6) of the paper.
    ///
    /// - `rho`: density, kg/m³. `p`: pressure, Pa.
    /// - returns: c, m/s.
    /// - valid for: ρ > 0 and p + π ≥ 0; otherwise NaN or infinite.
    /// - errors: none.
    /// - tested by: water at two pressures, slope of the isentrope.
    #[inline]
    #[must_use]
    pub fn sound_speed(self, rho: f64, p: f64) -> f64 {
        (self.gamma * (p + self.pi) / rho).sqrt()
    }

    /// Density on the isentrope through (ρ, p) at another pressure, ρ ((p₂ + π)/(p + π))^(1/γ).
    ///
    /// Menikoff & Plohr (1989). Written in the increment p₂ − p, so that small pulses lose no digits and
    /// p₂ = p gives ρ exactly.
    ///
    /// - `rho`, `p`: the given state, kg/m³ and Pa. `p_new`: the other pressure p₂, Pa.
    /// - returns: density at p₂, kg/m³; 0 at p₂ = −π.
    /// - valid for: ρ > 0, p + π > 0, p₂ + π ≥ 0; otherwise NaN.
    /// - errors: none.
    /// - tested by: slope of the isentrope, exact return, wide range.
    #[inline]
    #[must_use]
    pub fn isentropic_density(self, rho: f64, p: f64, p_new: f64) -> f64 {
        rho * (ln_pressure_ratio(p_new + self.pi, p_new - p, p + self.pi) / self.gamma).exp()
    }

    /// The mixture of two stiffened gases by linear β₁ and β₂: a stiffened gas again.
    ///
    /// Saurel & Abgrall (1999); paper: eqs. (10) and (11). Pressure and velocity then stay uniform across a
    /// moving contact (Abgrall 1996).
    ///
    /// - `phi`: gas fraction, 0 (liquid) to 1 (gas).
    /// - `gas`, `liquid`: the pure fluids.
    /// - returns: γ = 1 + 1/β₁ and π = β₂/(1 + β₁). At φ = 0 and 1 the pure fluid to round-off.
    /// - valid for: 0 ≤ φ ≤ 1; a slightly larger φ gives a β₂ slightly below zero, which is not checked.
    /// - errors: none.
    /// - tested by: mixture limits, linear energy at fixed pressure.
    #[inline]
    #[must_use]
    pub fn mixture(phi: f64, gas: Self, liquid: Self) -> Self {
        let beta1 = phi * gas.beta1() + (1.0 - phi) * liquid.beta1(); // (10)
        let beta2 = phi * gas.beta2() + (1.0 - phi) * liquid.beta2();
        Self { gamma: 1.0 + 1.0 / beta1, pi: beta2 / (1.0 + beta1) } // (11)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const WATER: StiffenedGas = StiffenedGas { gamma: 7.15, pi: 3e8 };
    const GAS: StiffenedGas = StiffenedGas { gamma: 1.4, pi: 0.0 };

    #[test]
    fn energy_and_pressure_are_inverses() {
        for law in [WATER, GAS] {
            for p in [-1e4, 0.0, 2118.0, 1e5, 5e7, 1e10] {
                let energy = law.internal_energy(p);
                assert_relative_eq!(energy, law.beta1() * p + law.beta2(), max_relative = 1e-15);
                // Round-off of the energy comes back multiplied by gamma - 1.
                let round_off = 4.0 * f64::EPSILON * (p.abs() + law.gamma * law.pi);
                assert!((law.pressure(energy) - p).abs() <= round_off);
            }
        }
        // Ideal gas: p = 0.4 rho e; water at rest stores gamma pi / (gamma - 1).
        assert_relative_eq!(GAS.pressure(2.5e5), 1e5, max_relative = 1e-15);
        assert_relative_eq!(WATER.internal_energy(0.0), 7.15 * 3e8 / 6.15, max_relative = 1e-15);
    }

    #[test]
    fn sound_speed_of_water() {
        assert_relative_eq!(WATER.sound_speed(1000.0, 1e5), 1464.82592822492, max_relative = 1e-14);
        assert_relative_eq!(WATER.sound_speed(1000.0, 5e7), 1581.92920195564, max_relative = 1e-14);
    }

    #[test]
    fn isentrope_has_slope_c_squared_and_returns_its_own_point() {
        let (rho, p) = (1000.0, 1e5);
        let c = WATER.sound_speed(rho, p);
        let dp = 1e-3; // rho changes in the thirteenth digit only
        let drho = dp / (c * c);
        let got = WATER.isentropic_density(rho, p, p + dp) - rho;
        assert!((got - drho).abs() <= 2.0 * f64::EPSILON * rho, "{got} {drho}");
        assert_eq!(WATER.isentropic_density(rho, p, p), rho);
        assert_eq!(WATER.isentropic_density(rho, p, -3e8), 0.0);
        let far = 0.0266 * (1e6_f64 / 2118.0).powf(1.0 / 1.4);
        assert_relative_eq!(GAS.isentropic_density(0.0266, 2118.0, 1e6), far, max_relative = 1e-14);
        let low = 0.0266 * (1e-6_f64 / 2118.0).powf(1.0 / 1.4);
        assert_relative_eq!(GAS.isentropic_density(0.0266, 2118.0, 1e-6), low, max_relative = 1e-14);
    }

    #[test]
    fn mixture_interpolates_the_energy_at_fixed_pressure() {
        for (phi, pure) in [(0.0, WATER), (1.0, GAS)] {
            let mixture = StiffenedGas::mixture(phi, GAS, WATER);
            assert_relative_eq!(mixture.gamma, pure.gamma, max_relative = 1e-15);
            assert_relative_eq!(mixture.pi, pure.pi, max_relative = 1e-15);
        }
        for phi in [1e-6, 0.25, 0.5, 0.999] {
            let mixture = StiffenedGas::mixture(phi, GAS, WATER);
            for p in [2118.0, 5e7] {
                let energy = phi * GAS.internal_energy(p) + (1.0 - phi) * WATER.internal_energy(p);
                assert_relative_eq!(mixture.internal_energy(p), energy, max_relative = 1e-14);
            }
        }
    }
}
