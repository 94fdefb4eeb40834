//! Steps that went too far, made again at first order.

use std::collections::BTreeSet;

use super::advance::to_be_looked_at;
use super::{Marks, Model, Step, Worker};
use crate::{Field, FluxRegister, Mesh, ScratchPool, for_each_block};

impl<M: Model<N>, const N: usize> Step<'_, M, N> {
    /// Makes the step of cells again at first order that it has taken too far, see [`Model::cells_to_redo`]. What then is still
    /// not admissible is left for the check.
    pub(super) fn retry(
        &self,
        next: &mut Field,
        register: &mut FluxRegister<N>,
        reports: &mut [M::Report],
        is_due: impl Fn(usize) -> bool + Sync,
        workers: &ScratchPool<Worker<M::Scratch>>,
    ) {
        /// The neighbours of a cell at first order may fail in turn.
        const ROUNDS: usize = 4;
        let mut marks = Marks::new();
        for _ in 0..ROUNDS {
            let mut is_new = false;
            for slot in to_be_looked_at(self.model, reports).into_iter().filter(|slot| is_due(*slot)) {
                for cell in self.model.cells_to_redo(&reports[slot], next.block(slot)) {
                    let known = marks.entry(slot).or_default();
                    if !known.contains(&cell) {
                        known.push(cell);
                        is_new = true;
                    }
                }
            }
            if !is_new {
                return;
            }
            self.redo(&marks, next, register, reports, &is_due, workers);
        }
    }

    /// Makes the step of the blocks around marked cells again, with those cells at first order. Beyond the group's blocks the
    /// fluxes are those of the finer side.
    fn redo(
        &self,
        marks: &Marks,
        next: &mut Field,
        register: &mut FluxRegister<N>,
        reports: &mut [M::Report],
        is_due: impl Fn(usize) -> bool + Sync,
        workers: &ScratchPool<Worker<M::Scratch>>,
    ) {
        let context = Step { marks, ..*self };
        let around = blocks_around(self.mesh, marks);
        let is_around = |slot: usize| is_due(slot) && around.contains(&slot);
        for_each_block(next, register.values_mut(), reports, is_around, |slot, new, fluxes, report| {
            *report = workers.with(|worker| self.model.step_block(&context, slot, worker.begin(new, fluxes)));
        });
        for (slot, cells) in marks {
            let id = self.mesh.tree().leaves()[*slot];
            let volume = cells.iter().map(|cell| self.mesh.volume(id, cell / N)).sum();
            self.model.note_redone(&mut reports[*slot], cells.len(), volume);
        }
    }
}

/// The blocks whose fluxes change because of marked cells: their own and the neighbours'.
fn blocks_around<const N: usize>(mesh: &Mesh<N>, marks: &Marks) -> BTreeSet<usize> {
    let beside = |slot: &usize| mesh.tree().neighbours(*slot).iter().flat_map(|neighbour| neighbour.slots());
    marks.keys().copied().chain(marks.keys().flat_map(beside)).collect()
}
