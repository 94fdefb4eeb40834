//! Steps that went too far, made again at first order.

use std::collections::BTreeSet;

use super::advance::to_be_looked_at;
use super::{Marks, Model, Step, Worker};
use crate::{Field, FluxRegister, Mesh, Neighbour, ScratchPool, Side, Tile, for_each_tile};

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
        let mut suspects = to_be_looked_at(self.model, reports);
        for _ in 0..ROUNDS {
            let mut fresh = Vec::new();
            for slot in suspects.into_iter().filter(|slot| is_due(*slot)) {
                let cells = self.model.cells_to_redo(&reports[slot], next.block(slot));
                if !cells.is_empty() && marks.entry(slot).or_default().insert_all(&cells) {
                    fresh.push(slot);
                }
            }
            if fresh.is_empty() {
                return;
            }
            suspects = self.redo(&marks, &fresh, (next, register, reports), &is_due, workers);
        }
    }

    /// Makes the step of the blocks that see marked cells again, with those cells at first order. Beyond the group's blocks the
    /// fluxes are those of the finer side.
    ///
    /// - `fresh`: the blocks whose marks have been changed since.
    /// - returns: the blocks made again that have to be looked at, ascending.
    fn redo(
        &self,
        marks: &Marks<N>,
        fresh: &[usize],
        (next, register, reports): (&mut Field, &mut FluxRegister<N>, &mut [M::Report]),
        is_due: impl Fn(usize) -> bool,
        workers: &ScratchPool<Worker<M::Scratch>>,
    ) -> Vec<usize> {
        let context = Step { marks, ..*self };
        let around = blocks_around(self.mesh, marks, fresh);
        let due: Vec<usize> = around.into_iter().filter(|slot| is_due(*slot)).collect();
        let tiles: Vec<Tile> = due.iter().map(|slot| Tile::one(*slot)).collect();
        for_each_tile(&tiles, next, register.values_mut(), reports, |tile, new, fluxes, reports| {
            let step = |worker: &mut Worker<M::Scratch>| {
                self.model.step_block(&context, tile.first(), worker.begin(new, fluxes))
            };
            reports[0] = workers.with(step);
        });
        for (slot, cells) in due.iter().filter_map(|slot| Some((*slot, marks.get(slot)?))) {
            let id = self.mesh.tree().leaves()[slot];
            let volume = cells.cells().map(|cell| self.mesh.volume(id, cell / N)).sum();
            self.model.note_redone(&mut reports[slot], cells.len(), volume);
        }
        due.into_iter().filter(|slot| !self.model.is_clean(&reports[*slot])).collect()
    }
}

/// The blocks whose fluxes change because of marked cells in some blocks: these and the neighbours along whose sides such cells lie.
fn blocks_around<const N: usize>(mesh: &Mesh<N>, marks: &Marks<N>, fresh: &[usize]) -> BTreeSet<usize> {
    let mut around: BTreeSet<usize> = fresh.iter().copied().collect();
    for slot in fresh {
        for side in Side::ALL {
            let neighbour = mesh.tree().neighbours(*slot)[side as usize];
            // The middle of a coarse ghost lies between the first two layers.
            let layers = if matches!(neighbour, Neighbour::Coarser(_)) { 2 } else { 1 };
            if marks[slot].has_beside(side, layers) {
                around.extend(neighbour.slots());
            }
        }
    }
    around
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CellBits, Domain, Geometry, Offset};

    /// Marks in the middle of a block are nobody else's business, those along a side are its neighbour's there, on either level.
    #[test]
    fn blocks_see_marks_along_their_sides() {
        let domain = Domain { geometry: Geometry::Planar, z: [0.0, 1.0], r: [0.0, 1.0] };
        let mesh = Mesh::<8>::uniform(domain, [16, 16], 1, [false; 2]).expect("a mesh");
        let levels: Vec<u8> = mesh.tree().leaves().iter().map(|id| u8::from(id.i < 2 && id.j < 2)).collect();
        let mesh = mesh.with_levels(&levels).map_or(mesh, |adapted| adapted.mesh);
        let around = |slot: usize, cells: &[usize]| {
            let mut marked = CellBits::default();
            marked.extend(cells.iter().copied());
            blocks_around(&mesh, &Marks::from([(slot, marked)]), &[slot]).into_iter().collect::<Vec<_>>()
        };
        let beyond = |slot: usize, i: i8, j: i8| {
            let at = Offset::ALL.iter().position(|offset| *offset == Offset { i, j });
            mesh.tree().neighbours(slot)[at.expect("a direction")].slots().collect::<Vec<_>>()
        };
        // The fine block that touches coarse ones on two sides, and fine ones on the others.
        let fine = (0..mesh.blocks())
            .find(|slot| {
                let count = |kind: fn(&Neighbour) -> bool| {
                    mesh.tree().neighbours(*slot)[..4].iter().filter(|neighbour| kind(neighbour)).count()
                };
                count(|n| matches!(n, Neighbour::Coarser(_))) == 2
            })
            .expect("a corner of the fine part");
        let with = |others: Vec<usize>| {
            let mut all = others;
            all.push(fine);
            all.sort_unstable();
            all
        };
        assert_eq!(around(fine, &[3 * 8 + 3]), [fine]);
        assert_eq!(
            around(fine, &[3 * 8 + 6]),
            with(beyond(fine, 1, 0)),
            "two fine layers are one coarse cell"
        );
        assert_eq!(around(fine, &[8 + 3]), [fine], "to a neighbour of its level one layer counts");
        assert_eq!(around(fine, &[3]), with(beyond(fine, 0, -1)));
        let coarse = beyond(fine, 1, 0)[0];
        let mut finer = beyond(coarse, -1, 0);
        assert_eq!(finer.len(), 2);
        finer.push(coarse);
        finer.sort_unstable();
        assert_eq!(around(coarse, &[3 * 8]), finer);
        assert_eq!(around(coarse, &[3 * 8 + 1]), [coarse]);
    }
}
