//! What of a solver changes in time: kept between two steps of the whole, and taken up again.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::limits::limits_of;
use super::{Adapting, BlockSolver, Model, Progress, Reports};
use crate::{BlockId, FaceState, Field, Horizon, Misfit};

/// Everything of a solver that its setup and its initial state do not say, between two steps of the whole.
///
/// Then all levels are at the same time, and what they keep for each other within a step has done its service.
///
/// - `R`: what a block tells of its step; `S`: what the physics remembers.
#[derive(Serialize, Deserialize)]
pub struct SavedBlocks<'a, R: Clone, S> {
    leaves: Cow<'a, [BlockId]>,
    generation: u64,
    state: Cow<'a, Field>,
    finished: Cow<'a, [R]>,
    pending: Cow<'a, [R]>,
    horizon: Horizon,
    interface: Cow<'a, [FaceState]>,
    progress: Progress,
    physics: S,
}

impl<M: Model<N>, const N: usize> BlockSolver<M, N> {
    /// What changes in time, to be kept. Only between two steps of the whole.
    pub fn saved(&self) -> SavedBlocks<'_, M::Report, M::Memory> {
        debug_assert!(self.clock().is_over(), "no step is under way");
        // Field by field, so that a new one cannot be forgotten here.
        let Self {
            model,
            mesh,
            state,
            next: _,
            levels: _,
            reports: Reports { finished, pending },
            interface,
            adapting: Adapting { settings: _, horizon, patches: _ },
            progress,
            workers: _,
            prepared: _,
            due_tiles: _,
            is_suspect: _,
            limits: _,
            news: _,
        } = self;
        SavedBlocks {
            leaves: Cow::Borrowed(mesh.tree().leaves()),
            generation: mesh.generation(),
            state: Cow::Borrowed(state),
            finished: Cow::Borrowed(finished),
            pending: Cow::Borrowed(pending),
            horizon: *horizon,
            interface: Cow::Borrowed(interface.states()),
            progress: *progress,
            physics: model.memory(),
        }
    }

    /// Takes up what was kept of a solver with the same setup and initial state; it then goes on as that one did.
    ///
    /// - errors: the state is not one of such a solver; this one is then not to be used.
    pub fn restore(&mut self, saved: SavedBlocks<'_, M::Report, M::Memory>) -> Result<(), Misfit> {
        let SavedBlocks {
            leaves,
            generation,
            state,
            finished,
            pending,
            horizon,
            interface,
            progress,
            physics,
        } = saved;
        let mesh = self.mesh.restored(leaves.into_owned(), generation)?;
        let blocks = mesh.blocks();
        if !state.has_shape(blocks, N * N, self.state.components()) {
            return Err(Misfit(format!("the {}'s cells are not those of {blocks} blocks", M::NAME)));
        }
        if [finished.len(), pending.len()] != [blocks; 2] {
            return Err(Misfit(format!("not every one of the {}'s {blocks} blocks has a report", M::NAME)));
        }
        self.mesh = mesh;
        self.interface.index(&self.mesh);
        self.interface.restore(interface.into_owned())?;
        self.model.mesh_changed(&self.mesh);
        self.model.restore(physics)?;
        self.state = state.into_owned();
        self.next = self.state.clone();
        self.levels.resize(blocks);
        self.reports = Reports { finished: finished.into_owned(), pending: pending.into_owned() };
        self.model.reports_changed(&self.reports);
        self.limits = limits_of(&self.model, &self.mesh, 0, &self.reports.finished);
        self.adapting.horizon = horizon;
        self.progress = progress;
        Ok(())
    }
}
