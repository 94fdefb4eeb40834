//! What differs between the two-phase models outside the block's step, which asks once, in [`super::BlockGas`].

use mesh::Limiter;

use super::closure::{Compression, is_mixed, phase_densities};
use super::expansion::{Gas, expanded};
use super::reconstruction::CellRule;
use super::traces::is_closed;
use crate::options::{Model, Sharpening, TwoPhaseOptions};
use crate::physics::Fluid;
use crate::state::conserved::{GAS, PHI, RHO};
use crate::state::finished::{FinishedCell, finish_corrected};
use crate::state::{ConservedCell, primitive_of};
use crate::step::report::BlockReport;
use crate::{Mixture, RiemannSolver};

/// How cells hold gas and liquid; chosen when a fluid is made.
#[derive(Clone, Copy, Debug)]
pub(crate) enum PhaseModel {
    /// One density: the paper's mixture, of which the kernels serve all cells.
    Mixture,
    /// Phases with densities of their own, and what the five-equation model does in mixed cells.
    FiveEquation(TwoPhaseOptions),
}

impl PhaseModel {
    pub fn of(model: Model, sharpening: Sharpening) -> Self {
        let is_sharp = sharpening == Sharpening::Thinc;
        let has_closure = match model {
            Model::SaurelAbgrall => return Self::Mixture,
            Model::Allaire => false,
            Model::FiveEquation => true,
        };
        Self::FiveEquation(TwoPhaseOptions { has_closure, is_sharp })
    }

    /// The limiter of the gas fraction's slopes, beside `limiter` for all else.
    pub fn fraction_limiter(self, limiter: Limiter) -> Limiter {
        match self {
            Self::Mixture => limiter,
            Self::FiveEquation(options) => options.fraction_limiter(limiter),
        }
    }

    /// Whether the gas fraction follows the closure of the phases' compression.
    pub fn has_closure(self) -> bool {
        matches!(self, Self::FiveEquation(TwoPhaseOptions { has_closure: true, .. }))
    }

    /// The component that holds the gas's mass.
    pub fn gas_component(self) -> Option<usize> {
        match self {
            Self::Mixture => None,
            Self::FiveEquation(_) => Some(GAS),
        }
    }

    /// Whether there is gas in a block, or a trace of it.
    pub fn has_gas<const N: usize>(self, block: &[f64]) -> bool {
        let has_any = |c: usize| block[c * N * N..(c + 1) * N * N].iter().any(|value| *value != 0.0);
        has_any(PHI) || self.gas_component().is_some_and(has_any)
    }

    /// What the closure adds to the gas fraction of a mixed cell per change of its volume, see [`Compression::expansion`].
    /// (Where the interface is on the finest level, as adaptation keeps it, no such cell is corrected.)
    ///
    /// - `gas`: m_g, kg/m³.
    pub fn expansion(self, u: ConservedCell, gas: f64, mixture: &Mixture) -> f64 {
        match self {
            Self::FiveEquation(options) if is_mixed(u[PHI]) => {
                let [rho, _, _, p, phi] = primitive_of::<true>(u, gas, mixture);
                if is_closed(p, phi, mixture) {
                    return 0.0;
                }
                let densities = phase_densities(rho, gas / rho, phi, mixture);
                Compression::at(p, phi, densities, mixture, options.has_closure).expansion(phi)
            }
            _ => 0.0,
        }
    }

    /// A corrected cell at the end of a step: where its gas would be in tension it expands, what else is below the floor is lifted to it.
    ///
    /// - `u`: the cell; `old`: the same before the step, both with m_g, kg/m³.
    pub fn finish(
        self,
        (u, gas): (ConservedCell, f64),
        (old, old_gas): (ConservedCell, f64),
        mixture: &Mixture,
    ) -> FinishedCell {
        let finished = finish_corrected(u, gas, mixture);
        match self {
            Self::FiveEquation(options)
                if options.has_closure && finished.floor > 0.0 && mixture.has_gas_floor(u[PHI]) =>
            {
                let [_, _, _, pressure, phi] = primitive_of::<true>(old, old_gas, mixture);
                let before = Gas { pressure, phi, mass: old_gas };
                expanded(u, gas, before, mixture).unwrap_or(finished)
            }
            _ => finished,
        }
    }

    /// Takes what left a cell from its gas's mass, after its other components, and keeps it above its floor.
    ///
    /// - `cell`: j N + i; `volume`: the cell's.
    pub fn correct_gas<const N: usize>(
        self,
        new: &mut [f64],
        cell: usize,
        change: f64,
        volume: f64,
        report: &mut BlockReport<N>,
    ) {
        report.has_gas |= new[PHI * N * N + cell] != 0.0;
        let Some(gas) = self.gas_component() else { return };
        let [rho, gas] = [RHO, gas].map(|component| component * N * N + cell);
        new[gas] -= change;
        report.lift_phase(new[rho], &mut new[gas], volume);
        report.has_gas |= new[gas] != 0.0;
    }
}

impl Fluid {
    /// How the five-equation model reconstructs mixed cells; `None` for the paper's mixture.
    ///
    /// - `inverse_h`: 1/h_z, 1/h_r; `inverse_r`: 1/r or 0 of the padded cells; `dt`: the step, s.
    pub(crate) fn mixed_cell_rule<'a>(
        &'a self,
        inverse_h: [f64; 2],
        inverse_r: &'a [f64],
        dt: f64,
    ) -> Option<CellRule<'a>> {
        let PhaseModel::FiveEquation(options) = self.scheme.phases else { return None };
        Some(self.rule_with(options, inverse_h, inverse_r, dt))
    }

    pub(super) fn rule_with<'a>(
        &'a self,
        options: TwoPhaseOptions,
        inverse_h: [f64; 2],
        inverse_r: &'a [f64],
        dt: f64,
    ) -> CellRule<'a> {
        CellRule {
            limiter: self.scheme.limiter,
            inverse_h,
            inverse_r,
            dt,
            mixture: &self.mixture,
            options,
            is_low_mach: self.scheme.riemann == RiemannSolver::HllcLowMach,
            velocity_gain: self.terms.velocity_gain(0.5 * dt),
            jumps: None,
            excess: None,
        }
    }
}
