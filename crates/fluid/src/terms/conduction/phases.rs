//! What conduction makes of the phases of mixed cells.

use super::ConductionTerm;
use crate::phase_change::{area_density, holds_both};
use crate::state::ConservedCell;
use crate::state::finished::FinishedCell;
use crate::terms::FinishedCells;
use crate::terms::heating::CellInHeat;

impl ConductionTerm {
    /// Gives both phases of mixed cells their parts of the heat that came in, and lets it pass between them.
    ///
    /// Mass, momentum and energy of a cell stay; the gas fraction changes, which says how the energy is divided. The heat that came through
    /// faces is in the energy already. With surface tension the energy of the surface counts.
    ///
    /// - `fluxes`: of heat along z and r, W/m².
    pub(super) fn finish_phases(&self, cells: &mut FinishedCells<'_>, fluxes: [&[f64]; 2]) {
        cells.change_mixed(holds_both, |cells, state, at| self.finished(state, cells, fluxes, at));
    }

    /// A cell with its phases at one pressure again; `None` where it stays as it is.
    ///
    /// - `k`, `j`: its padded place, and its row.
    fn finished(
        &self,
        (u, gas): (ConservedCell, f64),
        cells: &FinishedCells<'_>,
        fluxes: [&[f64]; 2],
        (k, j): (usize, usize),
    ) -> Option<FinishedCell> {
        let [rho, _, _, _, phi] = u;
        let cell = CellInHeat::of((u, gas), cells.capillary.jump(k), &self.mixture);
        let through = self.heat_through(cells, fluxes, (k, j));
        let [by_gas, by_liquid, by_either] = through;
        let phases = self.caloric.phases(cell.without(by_gas + by_liquid + by_either)?, [gas, rho - gas]);
        let [c_g, c_l] = phases.capacities;
        let split = by_either * c_g / (c_g + c_l);
        let through = [by_gas + split, by_liquid + (by_either - split)];
        let heat = phases.shares(through, self.conductance(cells, phi, k) * cells.metric.dt);
        cell.heated(&phases.energies, heat)
    }

    /// The heat that came into a cell in the step through faces on its gas's side, on its liquid's side, and through those of which the
    /// neighbour has the same gas fraction, J/m³.
    fn heat_through(
        &self,
        cells: &FinishedCells<'_>,
        [z, r]: [&[f64]; 2],
        (k, j): (usize, usize),
    ) -> [f64; 3] {
        let (phi, stride, row) = (cells.phi, cells.metric.stride, cells.metric.row(j));
        let mut through = [0.0; 3];
        for (other, heat) in [
            (k - 1, row.axial(0.0, z[k - 1])),
            (k + 1, row.axial(z[k], 0.0)),
            (k - stride, row.radial(0.0, r[k - stride])),
            (k + stride, row.radial(r[k], 0.0)),
        ] {
            let side = match phi[other] - phi[k] {
                rise if rise > 0.0 => 0,
                rise if rise < 0.0 => 1,
                _ => 2,
            };
            through[side] -= heat;
        }
        through
    }

    /// The conductance between the layers of gas and liquid in a cell, between their middles, per volume, W/(m³ K).
    ///
    /// With the area a of the interface per volume they are φ/a and (1 − φ)/a thick. It is no less than that of a front over two cells: what is
    /// left of an interface somewhere still exchanges heat.
    fn conductance(&self, cells: &FinishedCells<'_>, phi: f64, k: usize) -> f64 {
        let inverse_h = cells.metric.inverse_h;
        let area = area_density(cells.phi, k, cells.metric.stride, inverse_h, holds_both);
        let area = area.max(0.5 * inverse_h[0].min(inverse_h[1]));
        2.0 * area * area / self.resistivity.of_cell(phi)
    }
}
