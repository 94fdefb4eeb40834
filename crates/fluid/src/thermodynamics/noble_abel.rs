//! The Noble–Abel stiffened-gas equation of state.

use crate::StiffenedGas;

/// A Noble–Abel stiffened gas, p = (γ − 1)(e − q)/(v − b) − γπ with v = 1/ρ: Le Métayer & Saurel (2016).
///
/// The covolume b is the part of the volume that the molecules themselves take. In the free volume v − b it is the stiffened gas of γ and
/// π: wave curves, isentropes and impedances ρc are those of a stiffened gas of the density ρ/(1 − bρ), see [`Self::free_density`].
/// b = 0 is the stiffened gas itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NobleAbelStiffenedGas {
    /// Adiabatic exponent γ > 1.
    pub gamma: f64,
    /// Stiffness π ≥ 0, Pa.
    pub pi: f64,
    /// Covolume b ≥ 0, m³/kg.
    pub covolume: f64,
    /// What makes temperatures and phase change of it, if known.
    pub heat: Option<Heat>,
}

/// The caloric constants of an equation of state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heat {
    /// Heat capacity at constant volume c_v > 0, J/(kg K).
    pub capacity: f64,
    /// Reference energy q, J/kg: the heat of a phase change is the difference of two.
    pub energy: f64,
    /// Reference entropy q′, J/(kg K).
    pub entropy: f64,
}

impl From<StiffenedGas> for NobleAbelStiffenedGas {
    fn from(StiffenedGas { gamma, pi }: StiffenedGas) -> Self {
        Self { gamma, pi, covolume: 0.0, heat: None }
    }
}

impl NobleAbelStiffenedGas {
    /// The stiffened gas that it is in its free volume.
    #[must_use]
    pub fn law(&self) -> StiffenedGas {
        StiffenedGas { gamma: self.gamma, pi: self.pi }
    }

    /// The share of the volume that is free, 1 − bρ; 1 to the last bit without a covolume.
    #[must_use]
    pub fn free_share(&self, density: f64) -> f64 {
        1.0 - self.covolume * density
    }

    /// The mass in the free volume, ρ/(1 − bρ), kg/m³.
    #[must_use]
    pub fn free_density(&self, density: f64) -> f64 {
        density / self.free_share(density)
    }

    /// The inverse of [`Self::free_density`]: ρ of the mass in the free volume, kg/m³.
    #[must_use]
    pub fn density_of_free(&self, free: f64) -> f64 {
        free / (1.0 + self.covolume * free)
    }

    /// Pressure p = (γ − 1)(ρe − ρq)/(1 − bρ) − γπ, Le Métayer & Saurel (2016) eq. 30.
    ///
    /// - `density`: ρ, kg/m³; `internal_energy`: ρ(e − q), per volume without the reference energy, J/m³.
    /// - returns: p, Pa.  valid for: bρ < 1.  errors: none.
    /// - tested by: energy and pressure are inverses.
    #[must_use]
    pub fn pressure(&self, density: f64, internal_energy: f64) -> f64 {
        self.law().pressure(internal_energy / self.free_share(density))
    }

    /// Internal energy per volume without the reference energy, ρ(e − q) = (p + γπ)(1 − bρ)/(γ − 1), J/m³.
    ///
    /// The inverse of [`Self::pressure`].
    #[must_use]
    pub fn internal_energy(&self, density: f64, p: f64) -> f64 {
        self.law().internal_energy(p) * self.free_share(density)
    }

    /// Sound speed c = √(γ(p + π)/(ρ(1 − bρ))), Le Métayer & Saurel (2016) eq. 46.
    ///
    /// - `density`: ρ, kg/m³; `p`: Pa.
    /// - returns: c, m/s.  valid for: 0 < bρ < 1 or b = 0, p + π ≥ 0; otherwise NaN.  errors: none.
    /// - tested by: slope of the isentrope.
    #[must_use]
    pub fn sound_speed(&self, density: f64, p: f64) -> f64 {
        let stiffened = self.law().sound_speed(density, p);
        if self.covolume == 0.0 { stiffened } else { stiffened / self.free_share(density).sqrt() }
    }

    /// Density on the isentrope through (ρ, p) at another pressure: ρ/(1 − bρ) goes as (p + π)^(1/γ).
    ///
    /// - `density`, `p`: the given state, kg/m³ and Pa; `p_new`: the other pressure, Pa.
    /// - returns: kg/m³.  valid for: bρ < 1, p + π > 0, p_new + π ≥ 0; otherwise NaN.  errors: none.
    /// - tested by: slope of the isentrope.
    #[must_use]
    pub fn isentropic_density(&self, density: f64, p: f64, p_new: f64) -> f64 {
        if self.covolume == 0.0 {
            return self.law().isentropic_density(density, p, p_new);
        }
        self.density_of_free(self.law().isentropic_density(self.free_density(density), p, p_new))
    }

    /// Temperature T = (p + π)(1 − bρ)/((γ − 1) c_v ρ), Le Métayer & Saurel (2016) eq. 29; `None` where c_v is not known.
    ///
    /// - `density`: kg/m³; `p`: Pa.
    /// - returns: T, K.  valid for: ρ > 0.  errors: none.
    /// - tested by: air at room temperature, temperature and density are inverses.
    #[must_use]
    pub fn temperature(&self, density: f64, p: f64) -> Option<f64> {
        let heat = self.heat?;
        Some((p + self.pi) * self.free_share(density) / ((self.gamma - 1.0) * heat.capacity * density))
    }

    /// Density at a pressure and a temperature, the inverse of [`Self::temperature`]: 1/ρ = (γ − 1) c_v T/(p + π) + b.
    ///
    /// - `p`: Pa; `temperature`: K.
    /// - returns: kg/m³; `None` where c_v is not known.
    #[must_use]
    pub fn density_at(&self, p: f64, temperature: f64) -> Option<f64> {
        let heat = self.heat?;
        Some(1.0 / ((self.gamma - 1.0) * heat.capacity * temperature / (p + self.pi) + self.covolume))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NamedFluid;
    use approx::assert_relative_eq;

    /// The liquid of Le Métayer & Saurel (2016) and a hard-core gas.
    fn laws() -> [(NobleAbelStiffenedGas, f64); 2] {
        let water = NamedFluid::of("water-nasg").expect("it is in the library").law;
        let gas = NobleAbelStiffenedGas { gamma: 1.4, pi: 0.0, covolume: 1.5e-3, heat: None };
        [(water, 1000.0), (gas, 150.0)]
    }

    #[test]
    fn energy_and_pressure_are_inverses_and_the_isentrope_has_the_slope_of_sound() {
        for (law, density) in laws() {
            for p in [1e5, 5e7, 1e9] {
                let energy = law.internal_energy(density, p);
                let round_off = 4.0 * f64::EPSILON * (p + law.gamma * law.pi);
                assert!((law.pressure(density, energy) - p).abs() <= round_off, "{p}");
                let (above, below) = (
                    law.isentropic_density(density, p, 1.001 * p),
                    law.isentropic_density(density, p, 0.999 * p),
                );
                let slope = 0.002 * p / (above - below);
                assert_relative_eq!(slope.sqrt(), law.sound_speed(density, p), max_relative = 2e-6);
            }
        }
    }

    #[test]
    fn energy_along_an_isentrope_is_the_work() {
        // de = p dρ/ρ², by Simpson's rule over 2 % of density.
        for (law, density) in laws() {
            let p = 1e8;
            let e = |rho: f64, p: f64| law.internal_energy(rho, p) / rho;
            let at = |p_new: f64| (law.isentropic_density(density, p, p_new), p_new);
            let points = [at(p), at(1.05 * p), at(1.1 * p)];
            let [(r0, p0), (_, _), (r2, p2)] = points;
            let steps = 200;
            let mut work = 0.0;
            let (mut rho, mut pressure) = (r0, p0);
            for step in 1..=steps {
                let next = at(p0 + (p2 - p0) * f64::from(step) / f64::from(steps));
                work += 0.5 * (pressure + next.1) * (1.0 / rho - 1.0 / next.0);
                (rho, pressure) = next;
            }
            assert_relative_eq!(e(r2, p2) - e(r0, p0), work, max_relative = 1e-5);
        }
    }

    #[test]
    fn without_a_covolume_it_is_the_stiffened_gas_to_the_last_bit() {
        let stiffened = StiffenedGas { gamma: 7.15, pi: 3e8 };
        let law = NobleAbelStiffenedGas::from(stiffened);
        for (density, p) in [(1000.0, 1e5), (1021.3, 5e7)] {
            assert_eq!(law.sound_speed(density, p), stiffened.sound_speed(density, p));
            assert_eq!(law.internal_energy(density, p), stiffened.internal_energy(p));
            assert_eq!(
                law.isentropic_density(density, p, 2e6),
                stiffened.isentropic_density(density, p, 2e6)
            );
        }
    }

    #[test]
    fn temperatures_are_those_of_the_constants() {
        let air = NamedFluid::of("air").expect("it is in the library").law;
        assert_relative_eq!(
            air.temperature(1.2043, 101_325.0).expect("air has c_v"),
            293.15,
            max_relative = 1e-3
        );
        let (water, _) = laws()[0];
        let density = water.density_at(1e5, 300.0).expect("it has c_v");
        assert_relative_eq!(water.temperature(density, 1e5).expect("likewise"), 300.0, max_relative = 1e-12);
        assert_eq!(laws()[1].0.temperature(1.0, 1e5), None);
    }
}
