//! The pressure and the density of a bubble's gas and vapour from what it is in equilibrium with.

use crate::NobleAbelStiffenedGas;

/// Specific gas constant of air, J/(kg K).
const AIR: f64 = 287.05;
/// The same of water's vapour.
const WATER_VAPOUR: f64 = 461.52;

/// What is in a bubble, and around it: non-condensable gas of a fixed mass, and vapour.
///
/// The gas is described by the radius R_n at which it would be in equilibrium with the liquid at the temperature T. From there it
/// goes along its isentrope p (v − b)^γ = const, v = 1/ρ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BubbleContent {
    /// Pressure of the liquid far away p∞, Pa.
    pub far_pressure: f64,
    /// The gas: γ, covolume b (the hard core), and the heat capacity that gives its density, else it has that of air. π is 0.
    pub gas: NobleAbelStiffenedGas,
    /// Surface tension σ, N/m.
    pub surface_tension: f64,
    /// Pressure of the vapour p_v, Pa.
    pub vapour_pressure: f64,
    /// Temperature T of the gas in equilibrium, and of the vapour, K.
    pub temperature: f64,
}

/// Pressure and density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GasState {
    /// Pa.
    pub pressure: f64,
    /// kg/m³.
    pub density: f64,
}

impl std::ops::Add for GasState {
    type Output = Self;

    /// Dalton's law: partial pressures and partial densities add up.
    fn add(self, other: Self) -> Self {
        Self { pressure: self.pressure + other.pressure, density: self.density + other.density }
    }
}

impl BubbleContent {
    /// Gas alone without surface tension, at 293.15 K.
    ///
    /// - `far_pressure`: Pa.
    #[must_use]
    pub const fn dry(far_pressure: f64, gas: NobleAbelStiffenedGas) -> Self {
        Self { far_pressure, gas, surface_tension: 0.0, vapour_pressure: 0.0, temperature: 293.15 }
    }

    /// The gas at the radius R_n of equilibrium: p_n = p∞ + 2σ/R_n − p_v (Laplace), ρ_n at T.
    ///
    /// - `equilibrium_radius`: R_n > 0, m.
    /// - valid for: p_n > 0, which is not checked. errors: none. tested by: known bubbles.
    #[must_use]
    pub fn in_equilibrium(&self, equilibrium_radius: f64) -> GasState {
        let pressure =
            self.far_pressure + 2.0 * self.surface_tension / equilibrium_radius - self.vapour_pressure;
        self.at_temperature(pressure)
    }

    /// The gas at a pressure and the temperature T: p (v − b) = R_s T with R_s = (γ − 1) c_v, where c_v is not known air's.
    ///
    /// - `pressure`: Pa. valid for: T > 0. errors: none. tested by: known bubbles.
    #[must_use]
    pub fn at_temperature(&self, pressure: f64) -> GasState {
        let air = || pressure / (AIR * self.temperature + self.gas.covolume * pressure);
        GasState { pressure, density: self.gas.density_at(pressure, self.temperature).unwrap_or_else(air) }
    }

    /// The gas of an equilibrium radius R_n at another radius R: ρ = ρ_n (R_n/R)³ and p = p_n ((v_n − b)/(v − b))^γ.
    ///
    /// Without a covolume p = p_n (R_n/R)^(3γ) (Koch et al. 2016, Lechner et al. 2020); with it the van der Waals hard core.
    ///
    /// - `equilibrium_radius`, `radius`: R_n and R, m.
    /// - returns: infinite or NaN where the gas would be within its hard core, v ≤ b. errors: none.
    /// - tested by: (R_n/R)^(3γ), the isentrope of a gas with covolume.
    #[must_use]
    pub fn gas_at(&self, equilibrium_radius: f64, radius: f64) -> GasState {
        let rest = self.in_equilibrium(equilibrium_radius);
        let density = rest.density * (equilibrium_radius / radius).powi(3);
        compressed(&self.gas, rest, density)
    }

    /// The vapour: at its pressure and the temperature T, an ideal gas; where the gas has a heat capacity, which says what temperature
    /// it has, of that R_s = (γ − 1) c_v, else of that of water.
    ///
    /// - valid for: p_v ≥ 0. errors: none. tested by: water at 20 °C, the temperature of vapour and gas together.
    #[must_use]
    pub fn vapour(&self) -> GasState {
        GasState {
            pressure: self.vapour_pressure,
            density: (self.gas.density_at(self.vapour_pressure, self.temperature))
                .unwrap_or(self.vapour_pressure / (WATER_VAPOUR * self.temperature)),
        }
    }

    /// The adiabatic exponent of gas and vapour together, 1/(γ − 1) = Σ (p_i/p)/(γ_i − 1): heat capacities add up by moles.
    ///
    /// - `gas_pressure`: of the gas alone, Pa; `vapour_gamma`: γ of the vapour.
    /// - valid for: pressures ≥ 0, not both 0. errors: none. tested by: limits, equal shares.
    #[must_use]
    pub fn mixed_gamma(&self, gas_pressure: f64, vapour_gamma: f64) -> f64 {
        let whole = gas_pressure + self.vapour_pressure;
        let share = self.vapour_pressure / whole;
        1.0 + 1.0 / ((1.0 - share) / (self.gas.gamma - 1.0) + share / (vapour_gamma - 1.0))
    }

    /// What is left of a bubble whose gas is cut to that of another equilibrium radius, at the same radius and on the same isentrope.
    ///
    /// The isentrope p (v − b)^γ of the gas as it is has the density ρ_n' at the new equilibrium's p_n'; then ρ' = ρ_n' (R_n'/R)³, and
    /// p' on the isentrope: without a covolume p_n' (R_n'/R)^(3γ). Vapour is added to that.
    ///
    /// - `gas`: as it is; `radius`: R; `equilibrium_radius`: R_n', m. errors: none.
    /// - tested by: the pressure of the new radius, the isentrope, the way there and back.
    #[must_use]
    pub fn cut(&self, gas: GasState, radius: f64, equilibrium_radius: f64) -> GasState {
        let rest = self.in_equilibrium(equilibrium_radius).pressure;
        let rest_density = self.gas.isentropic_density(gas.density, gas.pressure, rest);
        let density = rest_density * (equilibrium_radius / radius).powi(3);
        compressed(&self.gas, gas, density) + self.vapour()
    }
}

/// A state brought to another density along its isentrope, (p + π)(v − b)^γ = const.
pub(crate) fn compressed(law: &NobleAbelStiffenedGas, state: GasState, density: f64) -> GasState {
    let ratio = law.free_density(density) / law.free_density(state.density);
    GasState { pressure: (state.pressure + law.pi) * ratio.powf(law.gamma) - law.pi, density }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const LABORATORY: BubbleContent =
        BubbleContent::dry(1e5, NobleAbelStiffenedGas { gamma: 1.4, pi: 0.0, covolume: 0.0, heat: None });

    #[test]
    fn a_laser_bubble_has_the_published_pressures() {
        // R_n = 184.1 um at 500 um and after the cut to 64 um.
        let before = LABORATORY.gas_at(184.1e-6, 500e-6);
        assert_relative_eq!(before.pressure, 1e5 * 0.3682_f64.powf(4.2), max_relative = 1e-13);
        let after = LABORATORY.cut(before, 500e-6, 64e-6);
        assert_relative_eq!(after.pressure, 1e5 * 0.128_f64.powf(4.2), max_relative = 1e-13);
        assert!((1.49e3..1.51e3).contains(&before.pressure) && (17.0..18.5).contains(&after.pressure));
        assert_relative_eq!(after.density / before.density, (64.0 / 184.1_f64).powi(3), max_relative = 1e-13);
        // Air at 1 bar and 20 degrees.
        let rest = LABORATORY.in_equilibrium(184.1e-6);
        assert_relative_eq!(rest.density, 1e5 / (287.05 * 293.15), max_relative = 1e-15);
    }

    #[test]
    fn surface_tension_and_vapour_change_the_equilibrium() {
        let content = BubbleContent { surface_tension: 0.072, vapour_pressure: 2339.0, ..LABORATORY };
        let rest = content.in_equilibrium(10e-6);
        assert_relative_eq!(rest.pressure, 1e5 + 14400.0 - 2339.0, max_relative = 1e-15);
        let wide = content.gas_at(10e-6, 40e-6);
        assert_relative_eq!(wide.pressure, rest.pressure * 0.25_f64.powf(4.2), max_relative = 1e-13);
        let vapour = content.vapour();
        assert!((vapour.density - 0.0173).abs() < 1e-4, "{vapour:?}");
        let whole = wide + vapour;
        assert_relative_eq!(whole.pressure, wide.pressure + 2339.0, max_relative = 1e-15);
        let cut = content.cut(wide, 40e-6, 5e-6);
        let of_gas = (1e5 + 28800.0 - 2339.0) * 0.125_f64.powf(4.2);
        assert_relative_eq!(cut.pressure, of_gas + 2339.0, max_relative = 1e-13);
    }

    #[test]
    fn a_gas_with_a_heat_capacity_has_its_vapour_at_the_temperature() {
        let law = crate::NamedFluid::of("water-vapour").unwrap().law;
        let content = BubbleContent { gas: law, vapour_pressure: 2339.0, ..LABORATORY };
        for state in [content.vapour(), content.at_temperature(1e4) + content.vapour()] {
            let temperature = law.temperature(state.density, state.pressure).unwrap();
            assert_relative_eq!(temperature, 293.15, max_relative = 1e-14);
        }
    }

    #[test]
    fn a_covolume_is_a_hard_core() {
        let content =
            BubbleContent { gas: NobleAbelStiffenedGas { covolume: 1.5e-3, ..LABORATORY.gas }, ..LABORATORY };
        let rest = content.in_equilibrium(100e-6);
        assert_relative_eq!(1e5 * (1.0 / rest.density - 1.5e-3), 287.05 * 293.15, max_relative = 1e-13);
        for radius in [13e-6, 50e-6, 300e-6] {
            let gas = content.gas_at(100e-6, radius);
            let isentrope = |state: GasState| state.pressure * (1.0 / state.density - 1.5e-3).powf(1.4);
            assert_relative_eq!(isentrope(gas), isentrope(rest), max_relative = 1e-12);
            // The core has the radius (b rho_n)^(1/3) R_n = 12.1 um here.
            let ideal = LABORATORY.gas_at(100e-6, radius).pressure;
            assert_eq!(radius < 100e-6, gas.pressure > ideal, "{radius}");
            // Cut to half and back again.
            if radius > 20e-6 {
                let half = content.cut(gas, radius, 50e-6);
                let direct = content.gas_at(50e-6, radius);
                assert_relative_eq!(half.pressure, direct.pressure, max_relative = 1e-11);
                assert_relative_eq!(
                    content.cut(half, radius, 100e-6).density,
                    gas.density,
                    max_relative = 1e-11
                );
            }
        }
        assert!(!(content.gas_at(100e-6, 12e-6).pressure > 0.0), "within its core");
    }

    #[test]
    fn heat_capacities_add_up_by_moles() {
        let content = BubbleContent { vapour_pressure: 2000.0, ..LABORATORY };
        assert_relative_eq!(content.mixed_gamma(0.0, 1.33), 1.33, max_relative = 1e-14);
        assert_relative_eq!(content.mixed_gamma(1e12, 1.33), 1.4, max_relative = 1e-8);
        // Half and half of 2.5 R and 3 R: 2.75 R.
        assert_relative_eq!(
            content.mixed_gamma(2000.0, 1.0 + 1.0 / 3.0),
            1.0 + 1.0 / 2.75,
            max_relative = 1e-14
        );
    }
}
