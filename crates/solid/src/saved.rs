//! What of a solid changes in time: kept between two steps of the whole, and taken up again.

use std::borrow::Cow;

use mesh::{BlockId, Field, Horizon, Misfit};
use serde::{Deserialize, Serialize};

use crate::absorbing::SideFilters;
use crate::block::BlockReport;
use crate::state::component::COUNT;
use crate::{BoundaryLedger, SolidSolver, SurfaceState};

/// Everything of a solid that its setup and its initial state do not say, between two steps of the whole.
///
/// Then all levels are at the same time, and what they keep for each other within a step has done its service.
#[derive(Serialize, Deserialize)]
pub struct SolidState<'a> {
    leaves: Cow<'a, [BlockId]>,
    generation: u64,
    state: Cow<'a, Field>,
    reports: Cow<'a, [BlockReport]>,
    pending: Cow<'a, [BlockReport]>,
    horizon: Horizon,
    surface: Cow<'a, [SurfaceState]>,
    sides: Cow<'a, [SideFilters; 4]>,
    time: f64,
    steps: u64,
    cell_updates: u64,
    common_updates: u64,
    ledger: BoundaryLedger,
}

impl<const N: usize> SolidSolver<N> {
    /// What changes in time, to be kept. Only between two steps of the whole.
    pub fn saved(&self) -> SolidState<'_> {
        debug_assert!(self.clock().is_over(), "no step is under way");
        // Field by field, so that a new one cannot be forgotten here.
        let Self {
            mesh,
            setup: _,
            elasticity: _,
            boundaries: _,
            sides,
            state,
            next: _,
            register: _,
            levels: _,
            reports,
            pending,
            analysis: _,
            horizon,
            patches: _,
            scratch: _,
            surface,
            surface_first: _,
            surface_blocks: _,
            time,
            steps,
            cell_updates,
            common_updates,
            ledger,
        } = self;
        SolidState {
            leaves: Cow::Borrowed(mesh.tree().leaves()),
            generation: mesh.generation(),
            state: Cow::Borrowed(state),
            reports: Cow::Borrowed(reports),
            pending: Cow::Borrowed(pending),
            horizon: *horizon,
            surface: Cow::Borrowed(surface),
            sides: Cow::Borrowed(sides.kept()),
            time: *time,
            steps: *steps,
            cell_updates: *cell_updates,
            common_updates: *common_updates,
            ledger: *ledger,
        }
    }

    /// Takes up what was kept of a solid with the same setup and initial state; it then goes on as that one did.
    ///
    /// - errors: the state is not one of such a solid; this one is then not to be used.
    pub fn restore(&mut self, saved: SolidState<'_>) -> Result<(), Misfit> {
        let SolidState {
            leaves,
            generation,
            state,
            reports,
            pending,
            horizon,
            surface,
            sides,
            time,
            steps,
            cell_updates,
            common_updates,
            ledger,
        } = saved;
        let mesh = self.mesh.restored(leaves.into_owned(), generation)?;
        let blocks = mesh.blocks();
        if !state.has_shape(blocks, N * N, COUNT) {
            return Err(Misfit(format!("the solid's cells are not those of {blocks} blocks")));
        }
        if [reports.len(), pending.len()] != [blocks; 2] {
            return Err(Misfit(format!("not every one of the solid's {blocks} blocks has a report")));
        }
        self.mesh = mesh;
        self.index_surface();
        if self.surface.len() != surface.len() {
            return Err(Misfit(format!("{} faces of the surface are not the grid's", surface.len())));
        }
        if !self.sides.restore(sides.into_owned()) {
            return Err(Misfit("what absorbing sides remember is not of the solid's sides".to_owned()));
        }
        self.state = state.into_owned();
        self.next = self.state.clone();
        self.register.resize(blocks);
        self.reports = reports.into_owned();
        self.pending = pending.into_owned();
        self.horizon = horizon;
        self.surface = surface.into_owned();
        (self.time, self.steps) = (time, steps);
        (self.cell_updates, self.common_updates) = (cell_updates, common_updates);
        self.ledger = ledger;
        Ok(())
    }
}
