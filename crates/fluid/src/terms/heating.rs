//! Heat that comes into the phases of a cell that holds both.

use crate::Mixture;
use crate::capillarity::SinglePressure;
use crate::state::ConservedCell;
use crate::state::finished::FinishedCell;

/// The energies of the phases of a cell at one pressure, per volume of the cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PhaseEnergies {
    /// ψ_k β_k, with the free volumes ψ_k = α_k − b_k m_k.
    free: [f64; 2],
    /// β_k γ_k (p + π_k), J/m³: the enthalpy per free volume.
    enthalpies: [f64; 2],
    /// β_k.
    betas: [f64; 2],
    /// p + π_k, Pa.
    bases: [f64; 2],
}

impl PhaseEnergies {
    /// - `gas`: m_g, kg/m³; `rho`, `p`, `phi`: kg/m³, Pa, 1.
    pub fn of(mixture: &Mixture, [rho, p, phi]: [f64; 3], gas: f64) -> Self {
        let laws = [mixture.gas, mixture.liquid];
        let betas = laws.map(|law| 1.0 / (law.gamma - 1.0));
        let volumes = [phi - laws[0].covolume * gas, (1.0 - phi) - laws[1].covolume * (rho - gas)];
        let of = |k: usize| betas[k] * laws[k].gamma * (p + laws[k].pi);
        Self {
            free: [volumes[0] * betas[0], volumes[1] * betas[1]],
            enthalpies: [of(0), of(1)],
            betas,
            bases: laws.map(|law| p + law.pi),
        }
    }

    /// ψ_k β_k (p + π_k) = C_k T_k, J/m³.
    pub fn heats(&self) -> [f64; 2] {
        std::array::from_fn(|k| self.free[k] * self.bases[k])
    }

    /// By how much the gas's volume grows when both phases get heat and come to one pressure in the volume of the cell, p̂.
    ///
    /// Each phase does work at p̂ on the other: with x the volume that the gas gains and q = p̂ − p,
    ///
    /// q (ψ_g β_g + (1 + β_g) x) + H_g x = δ_g,   q (ψ_l β_l − (1 + β_l) x) − H_l x = δ_l,   H_k = β_k γ_k (p + π_k),
    ///
    /// which is a quadratic equation for x. Both add up to the cell's energy: p̂ is the pressure that it has then. Without heat nothing
    /// changes to the last bit.
    ///
    /// - `heat`: δ_g, δ_l per volume of the cell, J/m³.
    /// - returns: x; `None` where a phase has not that much heat.
    /// - tested by: energies of both phases, heat at constant volume, nothing from nothing.
    pub fn growth(&self, [gas, liquid]: [f64; 2]) -> Option<f64> {
        let Self { free: [free_g, free_l], enthalpies: [h_g, h_l], betas: [beta_g, beta_l], .. } = *self;
        let quadratic = h_g * (1.0 + beta_l) - h_l * (1.0 + beta_g);
        let linear = h_g * free_l + h_l * free_g + gas * (1.0 + beta_l) + liquid * (1.0 + beta_g);
        let constant = gas * free_l - liquid * free_g;
        let root = (linear * linear - 4.0 * quadratic * constant).sqrt();
        let growth = 2.0 * constant / (linear + root);
        let is_left = free_g / beta_g + growth > 0.0 && free_l / beta_l - growth > 0.0;
        (linear > 0.0 && is_left).then_some(growth)
    }
}

/// A cell of both phases that have got heat which is in its energy already.
pub(crate) struct CellInHeat<'a> {
    u: ConservedCell,
    /// m_g, kg/m³.
    gas: f64,
    mixture: &'a Mixture,
    single: SinglePressure,
}

impl<'a> CellInHeat<'a> {
    /// - `gas`: m_g, kg/m³; `jump`: by which the gas's pressure exceeds the liquid's by surface tension, Pa.
    pub fn of((u, gas): (ConservedCell, f64), jump: f64, mixture: &'a Mixture) -> Self {
        Self { u, gas, mixture, single: SinglePressure::of(jump, mixture) }
    }

    /// Its phases before they got heat; `None` where the gas would have no pressure.
    ///
    /// - `heat`: J/m³.
    pub fn without(&self, heat: f64) -> Option<PhaseEnergies> {
        let [rho, .., phi] = self.u;
        let pressure = self.single.pressure_without((self.u, self.gas), heat);
        (pressure + self.mixture.gas.pi > 0.0)
            .then(|| PhaseEnergies::of(&self.single.mixture, [rho, pressure, phi], self.gas))
    }

    /// The cell with its phases in equilibrium of pressures again; `None` where it stays as it is.
    ///
    /// Mass and momentum stay; the gas fraction changes, which says how the energy is divided. The energy changes by what goes into the surface.
    ///
    /// - `phases`: before; `heat`: of gas and liquid, J/m³.
    pub fn heated(&self, phases: &PhaseEnergies, heat: [f64; 2]) -> Option<FinishedCell> {
        let [rho, m_z, m_r, energy, phi] = self.u;
        let after = phi + phases.growth(heat)?;
        if !(after > 0.0 && after < 1.0) {
            return None;
        }
        let energy = energy + self.single.tension_work(phi, after);
        self.single.finished(([rho, m_z, m_r, energy, after], self.gas), self.mixture)
    }
}
