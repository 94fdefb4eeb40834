//! What of a fluid changes in time: kept between two steps of the whole, and taken up again.

use std::borrow::Cow;

use mesh::{BlockId, Field, Horizon, Misfit};
use serde::{Deserialize, Serialize};

use crate::clips::SharedCount;
use crate::far_field::{SideImpulses, SourceHistory};
use crate::report::BlockReport;
use crate::{BoundaryLedger, Fixups, FluidSolver, WallState};

/// Everything of a fluid that its setup and its initial condition do not say, between two steps of the whole.
///
/// Then all levels are at the same time, and what they keep for each other within a step has done its service.
#[derive(Serialize, Deserialize)]
pub struct FluidState<'a, const N: usize> {
    leaves: Cow<'a, [BlockId]>,
    generation: u64,
    state: Cow<'a, Field>,
    reports: Cow<'a, [BlockReport<N>]>,
    pending: Cow<'a, [BlockReport<N>]>,
    has_gas: Cow<'a, [bool]>,
    horizon: Horizon,
    wall: Cow<'a, [WallState]>,
    impulses: Cow<'a, SideImpulses>,
    sources: Cow<'a, SourceHistory>,
    time: f64,
    steps: u64,
    cell_updates: u64,
    common_updates: u64,
    fixups: Fixups,
    ledger: BoundaryLedger,
}

impl<const N: usize> FluidSolver<N> {
    /// What changes in time, to be kept. Only between two steps of the whole.
    pub fn saved(&self) -> FluidState<'_, N> {
        debug_assert!(self.clock().is_over(), "no step is under way");
        // Field by field, so that a new one cannot be forgotten here.
        let Self {
            mesh,
            mixture: _,
            limiter: _,
            riemann: _,
            two_phase: _,
            boundaries: _,
            impulses,
            sources,
            state,
            next: _,
            register: _,
            levels: _,
            reports,
            pending,
            has_gas,
            marks: _,
            analysis: _,
            adaptation: _,
            horizon,
            patches: _,
            scratch: _,
            wall,
            wall_first: _,
            wall_blocks: _,
            axis_blocks: _,
            time,
            steps,
            cell_updates,
            common_updates,
            fixups: _,
            scaled_traces: _,
            ledger,
        } = self;
        FluidState {
            leaves: Cow::Borrowed(mesh.tree().leaves()),
            generation: mesh.generation(),
            state: Cow::Borrowed(state),
            reports: Cow::Borrowed(reports),
            pending: Cow::Borrowed(pending),
            has_gas: Cow::Borrowed(has_gas),
            horizon: *horizon,
            wall: Cow::Borrowed(wall),
            impulses: Cow::Borrowed(impulses),
            sources: Cow::Borrowed(sources),
            time: *time,
            steps: *steps,
            cell_updates: *cell_updates,
            common_updates: *common_updates,
            // Those of the traces shown are among them.
            fixups: self.fixups(),
            ledger: *ledger,
        }
    }

    /// Takes up what was kept of a fluid with the same setup and initial condition; it then goes on as that one did.
    ///
    /// - errors: the state is not one of such a fluid; this one is then not to be used.
    pub fn restore(&mut self, saved: FluidState<'_, N>) -> Result<(), Misfit> {
        let FluidState {
            leaves,
            generation,
            state,
            reports,
            pending,
            has_gas,
            horizon,
            wall,
            impulses,
            sources,
            time,
            steps,
            cell_updates,
            common_updates,
            fixups,
            ledger,
        } = saved;
        let mesh = self.mesh.restored(leaves.into_owned(), generation)?;
        let blocks = mesh.blocks();
        if !state.has_shape(blocks, N * N, self.state.components()) {
            return Err(Misfit(format!("the fluid's cells are not those of {blocks} blocks")));
        }
        if [reports.len(), pending.len(), has_gas.len()] != [blocks; 3] {
            return Err(Misfit(format!("not every one of the fluid's {blocks} blocks has a report")));
        }
        self.mesh = mesh;
        self.index_sides();
        if self.wall.len() != wall.len() {
            return Err(Misfit(format!("{} faces of the wall are not the grid's", wall.len())));
        }
        if !impulses.fits(&self.impulses) {
            return Err(Misfit("the far field's faces are not those of the fluid's sides".to_owned()));
        }
        self.impulses = impulses.into_owned();
        self.sources = sources.into_owned();
        self.state = state.into_owned();
        self.next = self.state.clone();
        self.register.resize(blocks);
        self.reports = reports.into_owned();
        self.pending = pending.into_owned();
        self.has_gas = has_gas.into_owned();
        self.horizon = horizon;
        self.wall = wall.into_owned();
        (self.time, self.steps) = (time, steps);
        (self.cell_updates, self.common_updates) = (cell_updates, common_updates);
        (self.fixups, self.ledger) = (fixups, ledger);
        self.scaled_traces = SharedCount::default();
        Ok(())
    }
}
