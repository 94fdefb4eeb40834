//! When liquid and vapour are in equilibrium.

use crate::capillarity::SinglePressure;
use crate::{Heat, Mixture, NobleAbelStiffenedGas};

/// A liquid and its vapour, an ideal gas: both laws with their reference energies and entropies.
///
/// Where not all of the gas is vapour, the rest shares its law, so that mole fractions are mass fractions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Saturation {
    pub(super) mixture: Mixture,
    pub(super) liquid_heat: Heat,
    pub(super) gas_heat: Heat,
}

impl Saturation {
    /// Temperature (K) and pressure (Pa) of water's critical point, IAPWS (1992): above either there are no two phases.
    pub const CRITICAL: [f64; 2] = [647.096, 22.064e6];

    /// Of the phases of a mixture; `None` where one has no heat capacity, the gas no reference, or the gas is not an ideal one.
    #[must_use]
    pub fn of(mixture: &Mixture) -> Option<Self> {
        let (liquid_heat, gas_heat) = (mixture.liquid.heat?, mixture.gas.heat?);
        let is_ideal = mixture.gas.pi == 0.0 && mixture.gas.covolume == 0.0;
        let is_referred = gas_heat.energy > liquid_heat.energy && gas_heat.energy != 0.0;
        (is_ideal && is_referred).then_some(Self { mixture: *mixture, liquid_heat, gas_heat })
    }

    /// The same phases by the laws of one pressure, where surface tension makes a jump.
    pub(super) fn with_laws_of(&self, single: &SinglePressure) -> Self {
        let mixture = single.mixture;
        Self {
            mixture,
            liquid_heat: mixture.liquid.heat.unwrap_or(self.liquid_heat),
            gas_heat: self.gas_heat,
        }
    }

    /// The vapour's partial pressure that is in equilibrium with liquid: the p_v of g_v(T, p_v) = g_l(T, p).
    ///
    /// With the Gibbs energies g = (γ c_v − q′) T − c_v T ln(T^γ/(p + π)^(γ−1)) + b p + q, Le Métayer & Saurel (2016) eq. 49, of an
    /// ideal gas it can be solved for. That the liquid is under another pressure than its vapour counts (Poynting's correction).
    ///
    /// - `temperature`: T, K; `pressure`: of the liquid, Pa.
    /// - returns: Pa.  valid for: T > 0, p + π > 0; otherwise NaN.  errors: none.
    /// - tested by: measured saturation of water, a table of steam.
    #[must_use]
    pub fn vapour_pressure(&self, temperature: f64, pressure: f64) -> f64 {
        let (liquid, gas) = (self.mixture.liquid, self.mixture.gas);
        let Heat { capacity, energy, entropy } = self.gas_heat;
        let own = (gas.gamma * (1.0 - temperature.ln()) * capacity - entropy) * temperature + energy;
        let difference = gibbs(&liquid, &self.liquid_heat, temperature, pressure) - own;
        (difference / ((gas.gamma - 1.0) * capacity * temperature)).exp()
    }

    /// The pressure at which liquid and pure vapour of one temperature are in equilibrium, p_sat(T).
    ///
    /// The fixed point of [`Self::vapour_pressure`], which contracts by the ratio of the densities of vapour and liquid.
    ///
    /// - `temperature`: T, K.
    /// - returns: Pa.  valid for: below the critical point, where fits of the constants have a range of their own.  errors: none.
    /// - tested by: measured saturation of water.
    #[must_use]
    pub fn pressure(&self, temperature: f64) -> f64 {
        const TURNS: usize = 100;
        let mut pressure = self.vapour_pressure(temperature, 0.0);
        for _ in 0..TURNS {
            let next = self.vapour_pressure(temperature, pressure);
            if (next - pressure).abs() <= 1e-14 * next {
                return next;
            }
            pressure = next;
        }
        pressure
    }

    /// The laws of both.
    pub(crate) fn mixture(&self) -> &Mixture {
        &self.mixture
    }

    /// √(2πRT), m/s: by which a difference of the vapour's pressures makes a flux in the kinetic theory of gases.
    ///
    /// - `temperature`: of the surface, K.
    pub(crate) fn kinetic_speed(&self, temperature: f64) -> f64 {
        let gas_constant = (self.mixture.gas.gamma - 1.0) * self.gas_heat.capacity;
        (std::f64::consts::TAU * gas_constant * temperature).sqrt()
    }

    /// Temperature of the liquid, K.
    ///
    /// - `mass`: of it in a cell, kg/m³; `share`: its part of the cell's volume; `pressure`: its own, Pa.
    pub(crate) fn liquid_temperature(&self, mass: f64, share: f64, pressure: f64) -> f64 {
        let law = self.mixture.liquid;
        let density = mass / share;
        (pressure + law.pi) * law.free_share(density)
            / ((law.gamma - 1.0) * self.liquid_heat.capacity * density)
    }

    /// q_l − q_v, J/kg: what a mass that evaporates adds to the energy that is counted without the references.
    #[must_use]
    pub fn reference_difference(&self) -> f64 {
        self.liquid_heat.energy - self.gas_heat.energy
    }
}

/// g(T, p), J/kg.
fn gibbs(law: &NobleAbelStiffenedGas, heat: &Heat, temperature: f64, pressure: f64) -> f64 {
    let Heat { capacity, energy, entropy } = *heat;
    let logarithm = law.gamma * temperature.ln() - (law.gamma - 1.0) * (pressure + law.pi).ln();
    (law.gamma * capacity - entropy) * temperature - capacity * temperature * logarithm
        + law.covolume * pressure
        + energy
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NamedFluid;

    #[test]
    fn water_boils_where_it_does() {
        let of = |name| NamedFluid::of(name).expect("it is in the library").law;
        let water =
            Saturation::of(&Mixture::new(of("water-nasg"), of("water-vapour"))).expect("both have heat");
        // IAPWS-IF97; the rest is what is left of fitting straight heats and volumes from 300 to 500 K.
        for (temperature, wanted, error) in [
            (300.0, 3536.6, 0.02),
            (373.124, 101_325.0, 0.02),
            (450.0, 932_030.0, 0.07),
            (500.0, 2_638_900.0, 0.16),
        ] {
            let got = water.pressure(temperature);
            eprintln!(
                "{temperature} K: {got:.1} Pa, measured {wanted:.1}, {:+.1} %",
                100.0 * (got / wanted - 1.0)
            );
            assert!((got / wanted - 1.0).abs() < error, "{temperature} K: {got} Pa");
            // The Gibbs energies are those of both laws: h − T s by its definition from e, p, v and the entropy.
            let g = |law: &NobleAbelStiffenedGas| {
                let heat = law.heat.expect("it has heat");
                let density = law.density_at(got, temperature).expect("likewise");
                let h = (law.internal_energy(density, got) + got) / density + heat.energy;
                let s = heat.capacity
                    * (temperature.powf(law.gamma) / (got + law.pi).powf(law.gamma - 1.0)).ln()
                    + heat.entropy;
                h - temperature * s
            };
            let (liquid, vapour) = (g(&of("water-nasg")), g(&of("water-vapour")));
            assert!((liquid - vapour).abs() < 1e-9 * 2.4e6, "{liquid} {vapour}");
        }
    }

    #[test]
    fn air_is_no_vapour() {
        let of = |name| NamedFluid::of(name).expect("it is in the library").law;
        assert!(Saturation::of(&Mixture::new(of("water-nasg"), of("air"))).is_none());
        assert!(Saturation::of(&Mixture::new(of("water"), of("water-vapour"))).is_none());
    }
}
