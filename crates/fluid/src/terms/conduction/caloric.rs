//! Temperatures and heat capacities of cells, as conduction needs them.

use crate::Mixture;
use crate::phase_change::holds_both;
use crate::terms::heating::PhaseEnergies;

/// Constants of a phase.
#[derive(Clone, Copy, Debug, PartialEq)]
struct PhaseHeat {
    /// 1/(γ − 1).
    beta: f64,
    /// π, Pa.
    pi: f64,
    /// b, m³/kg.
    covolume: f64,
    /// c_v, J/(kg K).
    capacity: f64,
}

/// Both phases' laws with their heat capacities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Caloric {
    gas: PhaseHeat,
    liquid: PhaseHeat,
}

/// The heat in a cell, per volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CellHeat {
    /// T, K; of both phases the mean by heat capacities.
    pub temperature: f64,
    /// C = Σ m_k c_k at constant volume, J/(m³ K).
    pub capacity: f64,
    /// The gas's part of it.
    pub gas_share: f64,
}

/// A cell that holds both phases, per volume.
#[derive(Clone, Copy, Debug)]
pub(super) struct PhaseHeats {
    /// C_k = m_k c_k of gas and liquid, J/(m³ K).
    pub capacities: [f64; 2],
    /// C_k T_k, J/m³.
    pub heats: [f64; 2],
    pub energies: PhaseEnergies,
}

/// 1 for gas and for liquid where a cell has enough of it to count, else 0.
#[inline(always)]
fn counted(phi: f64) -> [f64; 2] {
    let is_mixed = holds_both(phi);
    let is_gas = phi > 0.5;
    [if is_mixed | is_gas { 1.0 } else { 0.0 }, if is_mixed | !is_gas { 1.0 } else { 0.0 }]
}

impl Caloric {
    /// `None` where a phase has no heat capacity.
    pub fn of(mixture: &Mixture) -> Option<Self> {
        let of = |law: crate::NobleAbelStiffenedGas| {
            Some(PhaseHeat {
                beta: 1.0 / (law.gamma - 1.0),
                pi: law.pi,
                covolume: law.covolume,
                capacity: law.heat?.capacity,
            })
        };
        Some(Self { gas: of(mixture.gas)?, liquid: of(mixture.liquid)? })
    }

    /// c_v of gas and liquid, J/(kg K).
    pub fn capacities(&self) -> [f64; 2] {
        [self.gas.capacity, self.liquid.capacity]
    }

    /// The heat in a cell whose phases have masses: C_k T_k = ψ_k β_k (p + π_k), so that T = Σ ψ_k β_k (p + π_k)/Σ m_k c_k.
    ///
    /// Le Métayer & Saurel (2016) eq. 29 for each phase. Where a cell does not hold both ([`holds_both`]), that one which it holds counts alone: a
    /// trace of liquid may hold more heat than all of a thin gas, and nothing warms it there.
    ///
    /// - `gas`: m_g, kg/m³; `rho`, `p`, `phi`: kg/m³, Pa, 1.
    /// - tested by: cells of one temperature have it.
    #[inline(always)]
    pub fn of_phases(&self, [rho, p, phi]: [f64; 3], gas: f64) -> CellHeat {
        let Self { gas: g, liquid: l } = *self;
        let liquid = rho - gas;
        let [of_gas, of_liquid] = counted(phi);
        let (gas_capacity, liquid_capacity) = (of_gas * gas * g.capacity, of_liquid * liquid * l.capacity);
        let gas_heat = of_gas * (phi - g.covolume * gas) * g.beta * (p + g.pi);
        let liquid_heat = of_liquid * ((1.0 - phi) - l.covolume * liquid) * l.beta * (p + l.pi);
        let capacity = gas_capacity + liquid_capacity;
        let inverse = 1.0 / capacity;
        CellHeat {
            temperature: (gas_heat + liquid_heat) * inverse,
            capacity,
            gas_share: gas_capacity * inverse,
        }
    }

    /// The heat in a cell of one density, both phases of which have one temperature: ρ = Σ α_k (p + π_k)/((γ_k − 1) c_k T).
    ///
    /// The paper's mixture, which has no covolumes. C is what ρe gains with T at fixed ρ and φ.
    #[inline(always)]
    pub fn of_mixture(&self, [rho, p, phi]: [f64; 3]) -> CellHeat {
        let Self { gas: g, liquid: l } = *self;
        let [of_gas, of_liquid] = counted(phi);
        let (gas_beta, liquid_beta) = (of_gas * phi * g.beta, of_liquid * (1.0 - phi) * l.beta);
        let (gas_mass, liquid_mass) = (gas_beta / g.capacity, liquid_beta / l.capacity);
        let temperature = (gas_mass * (p + g.pi) + liquid_mass * (p + l.pi)) / rho;
        let capacity = rho * (gas_beta + liquid_beta) / (gas_mass + liquid_mass);
        let gas_share = gas_mass * (p + g.pi) * g.capacity
            / (gas_mass * (p + g.pi) * g.capacity + liquid_mass * (p + l.pi) * l.capacity);
        CellHeat { temperature, capacity, gas_share }
    }

    /// Both phases of a cell.
    ///
    /// - `masses`: m_g and m_l, kg/m³.
    pub fn phases(&self, energies: PhaseEnergies, [gas, liquid]: [f64; 2]) -> PhaseHeats {
        PhaseHeats {
            capacities: [gas * self.gas.capacity, liquid * self.liquid.capacity],
            heats: energies.heats(),
            energies,
        }
    }
}

impl PhaseHeats {
    /// What the phases of a layered cell get of the heat that came into it in a step: each what came through its own side, and in
    /// between it passes from one to the other.
    ///
    /// The difference of their temperatures obeys dΔ/dt = q_g/C_g − q_l/C_l − G Δ (1/C_g + 1/C_l), of which the step is the exact solution: it
    /// tends to what the passing heat needs, however thin a phase is.
    ///
    /// - `through`: heat that came in on the gas's side and on the liquid's, J/m³; `conductance`: G Δt, J/(m³ K).
    /// - returns: δ_g, δ_l, J/m³; both together are what came in.
    /// - tested by: many small steps, thin phases.
    pub fn shares(&self, [by_gas, by_liquid]: [f64; 2], conductance: f64) -> [f64; 2] {
        let [c_g, c_l] = self.capacities;
        let inverse = 1.0 / (c_g + c_l);
        // 1/(1/C_g + 1/C_l), and that times Δ.
        let both = c_g * c_l * inverse;
        let apart = (self.heats[0] * c_l - self.heats[1] * c_g) * inverse;
        let exponent = conductance / both;
        let lost = -(-exponent).exp_m1();
        let mean = if exponent > 1e-12 { lost / exponent } else { 1.0 };
        let passed = (by_gas * c_l - by_liquid * c_g) * inverse * mean - apart * lost;
        let all = by_gas + by_liquid;
        let gas = c_g * inverse * all + passed;
        [gas, all - gas]
    }
}

#[cfg(test)]
#[path = "caloric_tests.rs"]
mod tests;
