//! What changes phase in the cells of a block at the end of its step.

use mesh::Padded;
use serde::{Deserialize, Serialize};

use super::equilibrium::to_equilibrium;
use super::holding::{Changed, Holding, holds_both};
use super::laws::{EvaporationLaw, PhaseChange};
use super::rate::at_finite_rate;
use super::saturation::Saturation;
use super::surface::{area_density, borders_gas, condensing_area, lies_beside_gas};
use crate::Mixture;
use crate::capillarity::{CapillaryRows, SinglePressure};
use crate::state::conserved::{ENERGY, GAS, MOMENTUM_R, MOMENTUM_Z, PHI, RHO};
use crate::state::finished::FinishedCell;

/// What has changed phase, per radian in axial symmetry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct BlockExchange {
    /// Mass that evaporated and that condensed, kg.
    pub evaporated: f64,
    pub condensed: f64,
    /// What the energy, counted without reference energies, has gained, J.
    pub energy: f64,
    /// What it has gained by the work of surface tension on surfaces that move as masses change phase, J.
    pub tension_work: f64,
    /// Cells that opened under tension, and the mass that evaporated in them, kg.
    pub opened: u32,
    pub opened_mass: f64,
}

/// How the cells of a fluid change phase.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Exchange {
    asked: PhaseChange,
    saturation: Saturation,
    /// The component of the vapour's mass.
    vapour: usize,
}

/// A block at the end of its step.
pub(crate) struct BlockPlace<'a> {
    /// φ of the padded cells at the beginning of the step.
    pub phi: &'a [f64],
    /// 1/h_z, 1/h_r.
    pub inverse_h: [f64; 2],
    /// Δt, s.
    pub dt: f64,
    /// The volume of a cell in a row.
    pub volume: &'a dyn Fn(usize) -> f64,
    /// Whether there was gas in the padded cells.
    pub had_gas: bool,
    /// Surface tension at the beginning of the step.
    pub capillary: &'a CapillaryRows,
}

impl Exchange {
    /// `None` where the phases have no equilibrium, see [`Saturation::of`].
    ///
    /// - `vapour`: the component of its mass.
    pub fn of(asked: PhaseChange, mixture: &Mixture, vapour: usize) -> Option<Self> {
        Some(Self { asked, saturation: Saturation::of(mixture)?, vapour })
    }

    /// The component of the vapour's mass.
    pub fn vapour(&self) -> usize {
        self.vapour
    }

    /// Lets mass go from one phase to the other in those cells of a block where they meet, and opens liquid under tension.
    ///
    /// Mass and momentum of a cell stay, its energy with the reference energies and that of surface tension, too. A cell that would be left below the floor of the pressure, or
    /// without a sound speed, stays as it is.
    ///
    /// - `new`: the block's components; `speeds`: those of [`FinishedCell`], of the N² cells; both written where something changes.
    pub fn act<const N: usize>(
        &self,
        place: &BlockPlace<'_>,
        new: &mut [f64],
        speeds: &mut [&mut [f64]; 3],
    ) -> BlockExchange {
        let mut done = BlockExchange::default();
        if !place.had_gas && self.asked.cavitation.is_none() {
            return done;
        }
        let even = SinglePressure::of(0.0, &self.saturation.mixture);
        for cell in 0..N * N {
            let phi = new[PHI * N * N + cell];
            let meets = holds_both(phi);
            let k = Padded::<N>::index((cell % N) as isize, (cell / N) as isize);
            // Vapour that came into liquid beside the gas, see `terms/gas_slip.rs`.
            let has_come =
                !meets && phi > 0.0 && phi < 0.5 && lies_beside_gas(place.phi, k, Padded::<N>::STRIDE);
            if !meets && !has_come && (self.asked.cavitation.is_none() || phi > 0.5) {
                continue;
            }
            let at = |component: usize| component * N * N + cell;
            let u = [RHO, MOMENTUM_Z, MOMENTUM_R, ENERGY].map(|component| new[at(component)]);
            let jump = if meets { place.capillary.jump(k) } else { 0.0 };
            // Only few cells have a jump: the others need no laws of their own.
            let uneven = (jump != 0.0).then(|| {
                let single = SinglePressure::of(jump, &self.saturation.mixture);
                (single, self.saturation.with_laws_of(&single))
            });
            let (single, saturation) = uneven
                .as_ref()
                .map_or((&even, &self.saturation), |(single, saturation)| (single, saturation));
            let (holding, kinetic) = holding(u, phi, [new[at(GAS)], new[at(self.vapour)]], single);
            let changed = if meets {
                self.where_phases_meet(&holding, saturation, place, k, Padded::<N>::STRIDE)
            } else {
                let come = if has_come { to_equilibrium(&holding, saturation) } else { None };
                come.filter(|changed| changed.evaporated < 0.0).or_else(|| self.under_tension(&holding))
            };
            let Some(changed) = changed else { continue };
            let after = holding.with(changed, saturation);
            let Some(finished) = self.finished(u, kinetic, &after, single) else { continue };
            for (component, value) in finished.conserved.into_iter().enumerate() {
                new[at(component)] = value;
            }
            new[at(GAS)] += changed.evaporated;
            new[at(self.vapour)] += changed.evaporated;
            for (row, value) in speeds.iter_mut().zip([finished.speed_z, finished.speed_r]) {
                row[cell] = value;
            }
            let tension_work = single.tension_work(phi, after.phi);
            let energy = finished.conserved[ENERGY] - u[3];
            done.add(
                changed.evaporated,
                [energy - tension_work, tension_work],
                (place.volume)(cell / N),
                !meets && changed.evaporated > 0.0,
            );
        }
        done
    }

    fn where_phases_meet(
        &self,
        cell: &Holding,
        saturation: &Saturation,
        place: &BlockPlace<'_>,
        k: usize,
        stride: usize,
    ) -> Option<Changed> {
        match self.asked.law {
            EvaporationLaw::Equilibrium => to_equilibrium(cell, saturation)
                .filter(|changed| changed.evaporated <= 0.0 || borders_gas(place.phi, k, stride)),
            EvaporationLaw::HertzKnudsen { accommodation } => {
                let evaporating = area_density(place.phi, k, stride, place.inverse_h, holds_both);
                let condensing = condensing_area(place.phi, k, stride, place.inverse_h);
                let rates = [evaporating, condensing].map(|area| accommodation * place.dt * area);
                at_finite_rate(cell, rates, saturation)
            }
        }
    }

    /// Liquid below the threshold comes to equilibrium with vapour of its own.
    fn under_tension(&self, cell: &Holding) -> Option<Changed> {
        let threshold = self.asked.cavitation?;
        if cell.pressure(&self.saturation) >= threshold {
            return None;
        }
        to_equilibrium(cell, &self.saturation).filter(|changed| changed.evaporated > 0.0)
    }

    /// The cell with what it holds now; `None` if it is not physical.
    fn finished(
        &self,
        [rho, m_z, m_r, _]: [f64; 4],
        kinetic: f64,
        after: &Holding,
        single: &SinglePressure,
    ) -> Option<FinishedCell> {
        let internal = after.internal + single.energy_above(after.phi, after.liquid());
        let u = [rho, m_z, m_r, internal + kinetic, after.phi];
        single.finished((u, after.gas), &self.saturation.mixture)
    }
}

/// What a cell holds, by the laws of one pressure, and its kinetic energy per volume. The vapour is no more than the gas.
fn holding(
    [rho, m_z, m_r, energy]: [f64; 4],
    phi: f64,
    [gas, vapour]: [f64; 2],
    single: &SinglePressure,
) -> (Holding, f64) {
    let kinetic = 0.5 * (m_z * m_z + m_r * m_r) / rho;
    let gas = gas.max(0.0);
    let internal = (energy - kinetic) - single.energy_above(phi, rho - gas);
    (Holding { density: rho, gas, vapour: vapour.clamp(0.0, gas), internal, phi }, kinetic)
}

impl BlockExchange {
    /// - `mass`, `energy`, `work`: per volume; that of surface tension.
    fn add(&mut self, mass: f64, [energy, work]: [f64; 2], volume: f64, opened: bool) {
        self.evaporated += volume * mass.max(0.0);
        self.condensed += volume * (-mass).max(0.0);
        self.energy += volume * energy;
        self.tension_work += volume * work;
        if opened {
            self.opened += 1;
            self.opened_mass += volume * mass;
        }
    }
}
