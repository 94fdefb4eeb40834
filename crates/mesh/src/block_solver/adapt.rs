//! The step from one mesh to the next.

use super::limits::limits_of;
use super::{BlockSolver, Model};
use crate::kernels::parallel::map_in_order;
use crate::multiresolution::marks::bounds;
use crate::{BlockId, Remap};

impl<M: Model<N>, const N: usize> BlockSolver<M, N> {
    /// Adapts the grid if it is time to; to be called after a step. Returns whether the mesh changed: slots, faces of the interface
    /// and their number are then new ones.
    ///
    /// - `dt`: about the length of the steps to come, s; `steps`: how many of the finest level they are.
    pub fn adapt_if_due(&mut self, dt: f64, steps: u32) -> bool {
        self.is_adaptation_due(self.progress.time, dt, steps) && self.adapt(dt, steps)
    }

    /// Whether [`BlockSolver::adapt`] should follow the step about to be made, of length `dt`, which is `steps` of the finest
    /// level; to be asked once before each step.
    pub fn adaptation_follows(&mut self, dt: f64, steps: u32) -> bool {
        self.is_adaptation_due(self.progress.time + dt, dt, steps)
    }

    fn is_adaptation_due(&mut self, time: f64, dt: f64, steps: u32) -> bool {
        let every = self.adapting.settings.as_ref().map(|settings| settings.every);
        every.is_some_and(|every| self.adapting.horizon.is_due(every, steps, time, dt))
    }

    /// Adapts the grid to the present state, as [`BlockSolver::adapt_if_due`].
    pub fn adapt(&mut self, dt: f64, steps: u32) -> bool {
        let Some(settings) = &self.adapting.settings else { return false };
        let crossing: Vec<f64> = (0..self.mesh.blocks()).map(|slot| self.crossing_time(slot)).collect();
        let shortest = crossing.iter().copied().fold(f64::INFINITY, f64::min);
        let longest = (N as f64 - 2.0) * shortest;
        let span = self.adapting.horizon.renew(settings.every, steps, self.progress.time, dt, longest);
        let travel = |slot: usize| 1.0 + span / crossing[slot];
        let (analysis, patches) = (self.model.analysis(), &self.adapting.patches);
        let Some(base) = self.finest_by_details() else { return false };
        let settings = settings.ending_at(base, self.mesh.tree().finest());
        let present = (&self.mesh, &self.state, self.progress.time);
        let demanded = self.model.demanded_levels(present, base, &travel);
        let at_least = |slot: usize| demanded.get(slot).copied().unwrap_or(0);
        let adapted = self.mesh.adapted(&self.state, analysis, &settings, patches, travel, at_least);
        let Some(adapted) = adapted else { return false };
        let (mesh, field) = (&self.mesh, &self.state);
        let remap = Remap { adapted: &adapted, mesh, field, patches: &self.adapting.patches };
        self.model.remap(&remap, self.progress.time, &mut self.next);
        std::mem::swap(&mut self.state, &mut self.next);
        let blocks = adapted.mesh.blocks();
        self.next.resize(blocks);
        self.levels.resize(blocks);
        self.reports.finished = adapted.carried(&self.reports.finished);
        let fresh: Vec<usize> = adapted.fresh().collect();
        let sliding = self.interface.sliding(&self.mesh);
        self.mesh = adapted.mesh;
        self.measure(fresh);
        self.interface.index(&self.mesh);
        if let Some(sliding) = sliding {
            self.interface.slide(&self.mesh, &sliding);
        }
        self.model.mesh_changed(&self.mesh);
        true
    }

    /// The finest level that details may ask for at present; `None` of a grid that does not adapt.
    pub fn finest_by_details(&self) -> Option<u8> {
        let settings = self.adapting.settings.as_ref()?;
        Some(self.model.finest_for_details(&self.mesh, settings.base(self.mesh.tree().finest())))
    }

    /// Whether a block is coarser than a demanded level, as far as the bounds of the adaptation admit that.
    ///
    /// - `demanded`: by slot, as [`Model::demanded_levels`].
    pub fn lacks_levels(&self, demanded: &[u8]) -> bool {
        let Some(settings) = &self.adapting.settings else { return false };
        let leaves = self.mesh.tree().leaves();
        let is_coarser = |(level, id): (&u8, &BlockId)| {
            *level > id.level && bounds(&self.mesh, *id, &settings.bounds).1 > id.level
        };
        demanded.iter().zip(leaves).any(is_coarser)
    }

    /// Takes notice that the cells of some blocks have been changed between two steps of the whole, see [`BlockSolver::state_mut`].
    pub fn state_changed(&mut self, slots: impl IntoIterator<Item = usize>) {
        self.measure(slots);
    }

    /// Takes the reports of some blocks from their cells, and those of all for the steps to come.
    pub(super) fn measure(&mut self, slots: impl IntoIterator<Item = usize>) {
        /// So many are worth it to wake a thread.
        const BLOCKS_AT_ONCE: usize = 4;
        let Self { model, mesh, state, reports, limits, .. } = self;
        let slots: Vec<usize> = slots.into_iter().collect();
        let measured = map_in_order(slots.len(), BLOCKS_AT_ONCE, |number| {
            let slot = slots[number];
            let mut report = reports.finished[slot].clone();
            model.measure(mesh, slot, state.block(slot), &mut report);
            report
        });
        for (slot, report) in slots.into_iter().zip(measured) {
            reports.finished[slot] = report;
        }
        reports.pending.clone_from(&reports.finished);
        *limits = limits_of(model, mesh, 0, &reports.finished);
        model.reports_changed(reports);
    }
}
