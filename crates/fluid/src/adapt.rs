//! Adaptation of the fluid's grid: the initial mesh, and the step from one mesh to the next.

use mesh::{Adaptation, Field, FluxRegister, Mesh, Origin, Patch, ScratchPool};

use crate::analysis::Analysis;
use crate::block::BlockReport;
use crate::solver::{AsksForFiner, InitialState};
use crate::state::conserved::COUNT;
use crate::{FluidError, FluidSetup, FluidSolver};

/// Cells of the grid from which the initial mesh is found, refined and coarsened from there.
const FIRST_CELLS: usize = 1 << 18;

/// Cells that a wave crosses in a step, as the initial mesh assumes.
const COURANT: f64 = 0.5;

/// The mesh that the initial condition asks for, filled with it: found by adapting and filling anew until the mesh
/// stays what it is.
pub(crate) fn initial_mesh<const N: usize>(
    setup: &FluidSetup,
    periodic: [bool; 2],
    adaptation: &Adaptation,
    analysis: &Analysis,
    initial: &InitialState<'_>,
    asks_for_finer: &AsksForFiner<'_>,
) -> Result<(Mesh<N>, Field), FluidError> {
    let scratch = ScratchPool::new(|| Patch::zeros(COUNT));
    let cells = |level: u8| (setup.coarsest[0] << level) * (setup.coarsest[1] << level);
    let level = (0..setup.levels).rev().find(|level| cells(*level) <= FIRST_CELLS).unwrap_or(0);
    let level = if cells(setup.levels) <= FIRST_CELLS { setup.levels } else { level };
    let mut mesh = Mesh::<N>::on_level(setup.domain, setup.coarsest, level, setup.levels, periodic)?;
    // A level a round, down and up again.
    for _ in 0..2 * setup.levels + 2 {
        let mut state = Field::zeros(mesh.blocks(), N * N, COUNT);
        crate::fill::fill(&mesh, &analysis.mixture, &mut state, initial);
        let travel = |slot: usize| {
            let coarser = mesh.tree().finest() - mesh.tree().leaves()[slot].level;
            1.0 + COURANT * f64::from(adaptation.every) / f64::from(1u32 << coarser)
        };
        let at_least = |slot: usize| {
            let id = mesh.tree().leaves()[slot];
            let (low, widths) = (mesh.origin(id), mesh.widths(id.level));
            let high = [0, 1].map(|axis| low[axis] + N as f64 * widths[axis]);
            if asks_for_finer(low, high, widths) { id.level + 1 } else { 0 }
        };
        match mesh.adapted(&state, analysis, adaptation, &scratch, travel, at_least) {
            None => return Ok((mesh, state)),
            Some(adapted) => mesh = adapted.mesh,
        }
    }
    let mut state = Field::zeros(mesh.blocks(), N * N, COUNT);
    crate::fill::fill(&mesh, &analysis.mixture, &mut state, initial);
    Ok((mesh, state))
}

impl<const N: usize> FluidSolver<N> {
    /// Adapts the grid if it is time to; to be called after a step. Returns whether the mesh changed: slots, faces
    /// of the wall and their number are then new ones.
    ///
    /// - `dt`: about the length of the steps to come, s.
    pub fn adapt_if_due(&mut self, dt: f64) -> bool {
        let Some(every) = self.adaptation.as_ref().map(|adaptation| adaptation.every) else { return false };
        self.horizon.is_due(every, self.time, dt) && self.adapt(dt)
    }

    /// Adapts the grid to the present state. Returns whether the mesh changed.
    pub fn adapt(&mut self, dt: f64) -> bool {
        let Some(adaptation) = &self.adaptation else { return false };
        // Waves cross a cell, or a block, of their level in these times.
        let crossing = |slot: usize| {
            let widths = self.mesh.widths(self.mesh.tree().leaves()[slot].level);
            let speeds = &self.reports[slot].extremes;
            (widths[0] / speeds.speed_z).min(widths[1] / speeds.speed_r)
        };
        let shortest = (0..self.mesh.blocks()).map(crossing).fold(f64::INFINITY, f64::min);
        let longest = (N as f64 - 2.0) * shortest;
        let span = self.horizon.renew(adaptation.every, self.time, dt, longest);
        let travel = |slot: usize| 1.0 + span / crossing(slot);
        let adapted =
            self.mesh.adapted(&self.state, &self.analysis, adaptation, &self.patches, travel, |_| 0);
        let Some(adapted) = adapted else { return false };
        self.state = adapted.remap(&self.mesh, &self.state, &self.analysis, &self.patches);
        self.mesh = adapted.mesh;
        self.next = Field::zeros(self.mesh.blocks(), N * N, COUNT);
        self.register = FluxRegister::new(self.mesh.blocks());
        let old = std::mem::take(&mut self.reports);
        self.reports = (adapted.origins.iter())
            .map(|origin| match origin {
                Origin::Same(slot) => old[*slot],
                _ => BlockReport::default(),
            })
            .collect();
        for (slot, origin) in adapted.origins.iter().enumerate() {
            if !matches!(origin, Origin::Same(_)) {
                self.measure_speeds(slot);
            }
        }
        self.index_sides();
        true
    }
}
