//! Conduction of heat in both phases.

mod caloric;
mod faces;
mod layers;
mod phases;
mod rows;
mod spread;

use super::diffusion::{BY_STAGES, ThinGas, step_limit};
use super::super_stepping::{Spreading, View};
use super::{FinishedCells, Term, TermBlock, for_cells_without_mid_step};
use crate::state::primitive::{PHI, RHO};
use crate::step::clips::Clips;
use crate::step::face_rows::FaceRows;
use crate::{Mixture, WallHeat};
use caloric::{Caloric, CellHeat};
use faces::Work;
use layers::Resistivity;

/// Conduction of heat by Fourier's law, q = −λ∇T, in both phases.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conduction {
    /// λ of the liquid, W/(m K).
    pub liquid: f64,
    /// λ of the gas.
    pub gas: f64,
    /// What gas does that is too thin for a step.
    pub thin_gas: ThinGas,
    /// What walls do with heat.
    pub wall: WallHeat,
}

/// Conduction between the cells of phases of which the equations of state are known.
///
/// Energy passes through faces, −λ ∂T/∂n, with differences of the states at mid-step, which have gained half a step of it: second order in
/// space and time. A cell's T is the mean of its phases' by heat capacities, and what it holds of them lies in layers
/// ([`Resistivity::to_face`]): media in contact have the temperature that their effusivities give. The phases of a mixed cell exchange
/// heat with each other besides (`phases.rs`).
///
/// - valid for: λ ≥ 0. errors: none.
/// - tested by: `tests/verification/conduction.rs`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ConductionTerm {
    asked: Conduction,
    caloric: Caloric,
    resistivity: Resistivity,
    mixture: Mixture,
    boils: bool,
}

impl ConductionTerm {
    /// `None` where a phase has no heat capacity.
    ///
    /// - `boils`: whether phases are in equilibrium where they meet.
    pub fn of(asked: Conduction, mixture: &Mixture, boils: bool) -> Option<Self> {
        let resistivity = Resistivity::of(asked.gas, asked.liquid);
        Some(Self { asked, caloric: Caloric::of(mixture)?, resistivity, mixture: *mixture, boils })
    }

    /// Puts the fluxes that blocks have found together in the place of those of one step.
    fn take_spread(block: &TermBlock<'_>, work: &mut Work<'_>) {
        if let Some(view) = &block.spread {
            let [z, r] = &mut work.fluxes;
            view.put(View::HEAT, &mut [&mut **z, &mut **r], &Self::AXES);
        }
    }
}

impl Term for ConductionTerm {
    /// Half a step of −∇·q as pressure, in the cells of the block and the first ghosts.
    fn predict_pressure(&self, block: &TermBlock<'_>, pressure: &mut [f64], work: &mut Vec<f64>) {
        let mut work = Work::of(work, block);
        self.gather(&block.before, block, &mut work);
        self.conductances(block, &mut work, true);
        work.conduct(block);
        Self::take_spread(block, &mut work);
        let Work { gain, fluxes: [z, r], .. } = work;
        let cells = ([RHO, PHI].map(|component| block.before[component]), block.gas, block.inverse_r);
        rows::gain(&self.mixture, (block.metric, block.cells), cells, [z, r], [gain, pressure]);
    }

    /// The conductances are those of the beginning of the step, as the predictor has left them.
    fn add_fluxes(&self, block: &TermBlock<'_>, [z, r]: [&mut FaceRows; 2], work: &mut Vec<f64>) -> Clips {
        let mut work = Work::of(work, block);
        self.gather(&block.state, block, &mut work);
        for_cells_without_mid_step(block, |k| {
            let CellHeat { temperature, capacity, gas_share } = self.heat_in(&block.before, block, k);
            let temperature = temperature + work.gain[k] / capacity;
            work.set(k, CellHeat { temperature, capacity, gas_share });
        });
        Work::set_beyond(block, work.temperature);
        work.conduct(block);
        Self::take_spread(block, &mut work);
        work.note_wall(block);
        let (n, metric) = (block.cells, block.metric);
        let last = metric.origin + (n - 1) * metric.stride + n;
        for (faces, flux, first) in
            [(z, &*work.fluxes[0], metric.origin - 1), (r, &*work.fluxes[1], metric.origin - metric.stride)]
        {
            for (energy, flux) in faces.energy[first..last].iter_mut().zip(&flux[first..last]) {
                *energy += flux;
            }
        }
        let bounded = match self.asked.thin_gas {
            ThinGas::SuperTimeStepping => 0,
            ThinGas::Bounded | ThinGas::Resolved => self.count_bounded(block, work.capacity),
        };
        Clips { bounded_conductivities: bounded, ..Clips::default() }
    }

    fn finish(&self, cells: &mut FinishedCells<'_>, work: &[f64]) {
        self.finish_phases(cells, Work::fluxes_in(work, cells.phi.len()));
    }

    fn wall_heat<'w>(&self, work: &'w [f64], padded: usize) -> Option<[&'w [f64]; 2]> {
        Some(Work::wall_in(work, padded))
    }

    /// The largest λ/C that limits the step; of thin gas that does not, the liquid's part in a cell.
    fn diffusivity(&self, density: &[f64], phi: &[f64]) -> f64 {
        let [c_g, c_l] = self.caloric.capacities();
        let gas = match self.asked.thin_gas {
            ThinGas::Bounded => 0.0,
            ThinGas::Resolved => self.asked.gas / c_g,
            ThinGas::SuperTimeStepping => return Spreading::diffusivity(self, density, phi) / BY_STAGES,
        };
        let liquid = self.asked.liquid / c_l;
        rows::most_diffusivity([gas, liquid], density, phi)
    }

    fn step_limit(&self, widths: [f64; 2], diffusivity: f64) -> f64 {
        step_limit(widths, diffusivity)
    }

    fn spreading(&self) -> Option<&dyn Spreading> {
        (self.asked.thin_gas == ThinGas::SuperTimeStepping).then_some(self)
    }
}
