//! What friction makes of the phases of mixed cells.

use super::stress::Parts;
use super::{Viscosity, longitudinal, rows_of};
use crate::state::conserved::PHI;
use crate::terms::FinishedCells;
use crate::terms::heating::CellInHeat;
use crate::two_phase::is_mixed;

impl Viscosity {
    /// Gives both phases of mixed cells their parts of the heat that friction has made there.
    ///
    /// It is in the cell's energy, and would make gas and liquid warmer as their volumes are: thin gas by far too much. If both phases are
    /// deformed alike friction in phase k has α_k η_k/Σ α η of it, η = 4μ/3 + κ. Mass, momentum and energy of the cell stay; the gas
    /// fraction changes, which says how the energy is divided.
    pub(super) fn finish_phases(&self, cells: &mut FinishedCells<'_>, work: &[f64]) {
        cells.change_mixed(is_mixed, |cells, (u, gas), at| {
            let heat = friction(cells, work, at);
            let cell = CellInHeat::of((u, gas), cells.capillary.jump(at.0), cells.mixture);
            let phases = cell.without(heat)?;
            let [of_gas, of_liquid] = [
                u[PHI] * longitudinal([self.gas.shear, self.gas.bulk]),
                (1.0 - u[PHI]) * longitudinal([self.liquid.shear, self.liquid.bulk]),
            ];
            let by_gas = if of_gas > 0.0 { heat * of_gas / (of_gas + of_liquid) } else { 0.0 };
            cell.heated(&phases, [by_gas, heat - by_gas])
        });
    }
}

/// The energy that a cell has got by friction beside that of its motion, J/m³: Δt Σ A/V τ·(v_f − v), and Δt τ_φφ v_r/r.
///
/// - `work`: as the fluxes have left it; `k`, `j`: the cell's padded place, and its row.
fn friction(cells: &FinishedCells<'_>, work: &[f64], (k, j): (usize, usize)) -> f64 {
    let (metric, stride) = (cells.metric, cells.metric.stride);
    let [v_z, v_r, shear, bulk, _, _, _, z_normal, z_shear, _, r_normal, r_shear, hoop] =
        rows_of(work, cells.phi.len());
    let parts = Parts { shear, bulk, are_one: false };
    let of = |face: usize, step: usize, stresses: [(&[f64], &[f64]); 2]| -> f64 {
        stresses.into_iter().map(|(stress, v)| stress[face] * (parts.velocity(face, step, v) - v[k])).sum()
    };
    let axial = |face: usize| of(face, 1, [(z_normal, v_z), (z_shear, v_r)]);
    let radial = |face: usize| of(face, stride, [(r_normal, v_r), (r_shear, v_z)]);
    let row = metric.row(j);
    let below = k - stride;
    // Twice τ_φφ: the radial momentum gets τ_rr without weights, and the energy the work of all of it.
    let around = (r_normal[k] + r_normal[below]) - parts.hoop(k, stride, r_normal, hoop);
    row.axial(axial(k), axial(k - 1))
        + row.radial(radial(k), radial(below))
        + row.around(0.5 * around * v_r[k])
}
