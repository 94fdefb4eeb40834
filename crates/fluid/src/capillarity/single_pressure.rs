//! Cells of gas and liquid with surface tension between them, as cells of one pressure.

use crate::state::ConservedCell;
use crate::state::finished::{FinishedCell, finish_corrected, measure_cell};
use crate::{Heat, Mixture, NobleAbelStiffenedGas};

/// The laws by which gas at p + J and liquid at p are two phases at one pressure P = p + J.
///
/// A liquid with π − J in the place of π has at P the density, temperature, entropy and stiffness that it has at p. With q − bJ in the place
/// of q it has the same Gibbs energy, too. Its energy is less by J times its free volume 1 − φ − b m_l. So what is kept in a cell of one pressure
/// by these laws is, in the cell with the jump, its energy and that of the surface, J dφ. Whatever is right for phases at one
/// pressure, an exchange of heat or an equilibrium, is right with the jump by these laws.
///
/// - valid for: P + π − J > 0; without a jump all is as it is, to the last bit.
/// - tested by: `single_pressure.rs`, states of the liquid at both pressures.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SinglePressure {
    /// J, Pa.
    jump: f64,
    /// The gas, and the liquid with π − J and q − bJ.
    pub mixture: Mixture,
}

impl SinglePressure {
    /// - `jump`: J, by how much the pressure of the gas exceeds that of the liquid, Pa.
    pub fn of(jump: f64, mixture: &Mixture) -> Self {
        if jump == 0.0 {
            return Self { jump, mixture: *mixture };
        }
        let Mixture { liquid, gas, .. } = *mixture;
        let heat = liquid.heat.map(|heat| Heat { energy: heat.energy - liquid.covolume * jump, ..heat });
        let liquid = NobleAbelStiffenedGas { pi: liquid.pi - jump, heat, ..liquid };
        Self { jump, mixture: Mixture::new(liquid, gas) }
    }

    /// J times the free volume of the liquid, J/m³: how much more energy a cell has than one of one pressure by these laws.
    ///
    /// - `liquid`: m_l, kg/m³.
    pub fn energy_above(&self, phi: f64, liquid: f64) -> f64 {
        self.jump * ((1.0 - phi) - self.mixture.liquid.covolume * liquid)
    }

    /// What a cell's energy changes by when its gas fraction does: what goes into the surface, −J Δφ, J/m³.
    pub fn tension_work(&self, before: f64, after: f64) -> f64 {
        -self.jump * (after - before)
    }

    /// The pressure of the gas in a cell without heat that is in the cell's energy, Pa.
    ///
    /// - `gas`: m_g, kg/m³; `heat`: J/m³.
    pub fn pressure_without(&self, (u, gas): (ConservedCell, f64), heat: f64) -> f64 {
        let [rho, m_z, m_r, energy, phi] = u;
        let energy = energy - self.energy_above(phi, rho - gas);
        let internal = energy - 0.5 * (m_z * m_z + m_r * m_r) / rho;
        let [beta1, beta2] = self.mixture.free_betas::<true>(phi, rho, gas);
        (internal - heat - beta2) / beta1
    }

    /// A cell below the pressure floor, if its gas is not in tension. Around a bubble whose gas has less than σκ the liquid is in
    /// tension.
    pub fn borne(&self, (u, gas): (ConservedCell, f64), mixture: &Mixture) -> Option<FinishedCell> {
        let is_borne = self.jump > 0.0 && self.pressure_without((u, gas), 0.0) >= mixture.pressure_floor(1.0);
        let cell = is_borne.then(|| measure_cell(u, gas, mixture));
        cell.filter(FinishedCell::is_admissible)
    }

    /// A cell at the end of a step with its gas fraction and its energy changed; `None` if it is below the floor or has no sound speed.
    ///
    /// - `mixture`: the laws without the jump.
    pub fn finished(&self, (u, gas): (ConservedCell, f64), mixture: &Mixture) -> Option<FinishedCell> {
        let finished = finish_corrected(u, gas, mixture);
        if finished.floor > 0.0 {
            return self.borne((u, gas), mixture);
        }
        (finished.floor == 0.0 && finished.is_admissible()).then_some(finished)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{NamedFluid, Saturation};

    #[test]
    fn liquid_is_at_the_pressure_of_the_gas_what_it_is_at_its_own() {
        let of = |name| NamedFluid::of(name).expect("it is in the library").law;
        let (liquid, gas) = (of("water-nasg"), of("water-vapour"));
        let mixture = Mixture::new(liquid, gas);
        for jump in [2e5, -3e4, 0.0] {
            let single = SinglePressure::of(jump, &mixture);
            let (p, temperature, phi) = (1.2e5, 320.0, 0.3);
            let of_gas = p + jump;
            let other = single.mixture.liquid;
            let rho_l = liquid.density_at(p, temperature).expect("it has heat");
            let rho_g = gas.density_at(of_gas, temperature).expect("it has heat");
            approx::assert_relative_eq!(
                other.density_at(of_gas, temperature).expect("it has heat"),
                rho_l,
                max_relative = 1e-14
            );
            approx::assert_relative_eq!(
                other.sound_speed(rho_l, of_gas),
                liquid.sound_speed(rho_l, p),
                max_relative = 1e-14
            );
            let vapour = |mixture: &Mixture, p: f64| {
                Saturation::of(mixture).expect("both have heat").vapour_pressure(temperature, p)
            };
            approx::assert_relative_eq!(
                vapour(&single.mixture, of_gas),
                vapour(&mixture, p),
                max_relative = 1e-11
            );
            // The cell with both phases, at their own pressures.
            let (of_liquid, gas_mass) = ((1.0 - phi) * rho_l, phi * rho_g);
            let internal =
                (1.0 - phi) * liquid.internal_energy(rho_l, p) + phi * gas.internal_energy(rho_g, of_gas);
            let rho = of_liquid + gas_mass;
            let u = [rho, 3.0 * rho, -rho, internal + 5.0 * rho, phi];
            approx::assert_relative_eq!(
                single.pressure_without((u, gas_mass), 0.0),
                of_gas,
                max_relative = 1e-8
            );
        }
    }
}
