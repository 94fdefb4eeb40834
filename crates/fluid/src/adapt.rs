//! Adaptation of the fluid's grid: the initial mesh, and the step from one mesh to the next.

use mesh::{Field, Mesh};

use crate::analysis::Analysis;
use crate::clips::CountedAnalysis;
use crate::solver::{AsksForFiner, InitialState};
use crate::{FluidError, FluidSetup, FluidSolver};

/// The mesh that the initial condition asks for, filled with it.
pub(crate) fn initial_mesh<const N: usize>(
    setup: &FluidSetup,
    periodic: [bool; 2],
    analysis: &Analysis,
    initial: &InitialState<'_>,
    asks_for_finer: &AsksForFiner<'_>,
) -> Result<(Mesh<N>, Field), FluidError> {
    let fill = |mesh: &Mesh<N>| {
        let mut state = Field::zeros(mesh.blocks(), N * N, setup.model.components());
        crate::fill::fill(mesh, &analysis.mixture, &mut state, initial);
        state
    };
    let at_least = |mesh: &Mesh<N>, slot: usize| {
        let id = mesh.tree().leaves()[slot];
        let (low, widths) = (mesh.origin(id), mesh.widths(id.level));
        let high = [0, 1].map(|axis| low[axis] + N as f64 * widths[axis]);
        if asks_for_finer(low, high, widths) { id.level + 1 } else { 0 }
    };
    let adaptation = setup.adaptation.as_ref();
    let FluidSetup { domain, coarsest, levels, .. } = *setup;
    Ok(Mesh::initial(domain, coarsest, levels, periodic, adaptation, analysis, fill, at_least)?)
}

impl<const N: usize> FluidSolver<N> {
    /// Adapts the grid if it is time to; to be called after a step. Returns whether the mesh changed: slots, faces
    /// of the wall and their number are then new ones.
    ///
    /// - `dt`: about the length of the steps to come, s; `steps`: how many of the finest level they are.
    pub fn adapt_if_due(&mut self, dt: f64, steps: u32) -> bool {
        let Some(every) = self.adaptation.as_ref().map(|adaptation| adaptation.every) else { return false };
        self.horizon.is_due(every, steps, self.time, dt) && self.adapt(dt, steps)
    }

    /// Adapts the grid to the present state. Returns whether the mesh changed.
    pub fn adapt(&mut self, dt: f64, steps: u32) -> bool {
        let Some(adaptation) = &self.adaptation else { return false };
        // Waves cross a cell, or a block, of their level in these times.
        let crossing = |slot: usize| {
            let widths = self.mesh.widths(self.mesh.tree().leaves()[slot].level);
            let speeds = &self.reports[slot].extremes;
            (widths[0] / speeds.speed_z).min(widths[1] / speeds.speed_r)
        };
        let shortest = (0..self.mesh.blocks()).map(crossing).fold(f64::INFINITY, f64::min);
        let longest = (N as f64 - 2.0) * shortest;
        let span = self.horizon.renew(adaptation.every, steps, self.time, dt, longest);
        let travel = |slot: usize| 1.0 + span / crossing(slot);
        let adapted =
            self.mesh.adapted(&self.state, &self.analysis, adaptation, &self.patches, travel, |_| 0);
        let Some(adapted) = adapted else { return false };
        let analysis = CountedAnalysis::new(&self.analysis);
        adapted.remap_into(&self.mesh, &self.state, &analysis, &self.patches, &mut self.next);
        self.fixups.clips.limited_predictions += analysis.limited();
        std::mem::swap(&mut self.state, &mut self.next);
        self.next.resize(adapted.mesh.blocks());
        self.register.resize(adapted.mesh.blocks());
        self.reports = adapted.carried(&self.reports);
        let fresh: Vec<usize> = adapted.fresh().collect();
        self.mesh = adapted.mesh;
        for slot in fresh {
            self.measure_speeds(slot);
        }
        self.pending.clone_from(&self.reports);
        self.note_gas();
        self.index_sides();
        true
    }
}
