//! The stages of a block's step; the faces have a file of their own.

use mesh::{Side, Tile, TileRows, limited_differences};

use super::TileStep;
use super::jumps::find_jumps;
use super::scratch::{BlockScratch, split_block, take_wall};
use crate::Boundary;
use crate::components::carried::CarriedCells;
use crate::phase_change::{BlockPlace, Exchange};
use crate::physics::FluidStep;
use crate::reconstruction::capillary::level_slopes;
use crate::reconstruction::even::{even_slopes, predict_beside_mirrors};
use crate::reconstruction::predictor::{Predicted, Predictor, predict};
use crate::state::COUNT;
use crate::state::primitive::{PHI, PRESSURE, RHO, VELOCITY};
use crate::step::clips::{Clips, CountedAnalysis};
use crate::step::reflux::register_fluxes;
use crate::step::report::BlockReport;
use crate::step::rows;
use crate::step::update::{Metric, NewCells, update};
use crate::two_phase::{Before, BlockGas, is_zero, may_have_gas, remove_traces};

/// Assembles a tile with its ghosts: primitive variables in `cells`.
///
/// - `with_gas`: whether the gas is looked at; else there is none, neither in the tile nor in its neighbours.
/// - returns: how many predictions of ghosts were limited.
fn assemble<const N: usize>(
    ctx: &FluidStep<'_, N>,
    tile: Tile,
    with_gas: bool,
    scratch: &mut BlockScratch<N>,
) -> u64 {
    if !with_gas {
        scratch.without_gas(ctx.model.scheme.phases.gas_component());
    }
    scratch.has_gas = with_gas;
    let BlockScratch { cells, patch, inverse_r, s_z, s_r, half, .. } = scratch;
    [s_z, s_r, half].into_iter().for_each(|rows| rows.lay_out(tile));
    let carried = ctx.model.carried_components();
    let components = if with_gas || !carried.is_empty() { ctx.old.components() } else { PHI };
    let analysis = CountedAnalysis::new(&ctx.model.analysis);
    cells.assemble(components, ctx.mesh, ctx.old, tile, &analysis, patch);
    debug_assert!(with_gas || cells.component(PHI).iter().all(|phi| *phi == 0.0), "neighbours have no gas");
    for component in carried.clone() {
        cells.divide(component, RHO);
    }
    to_primitive(ctx, with_gas, cells);
    ctx.model.boundaries.fill_ghosts(ctx.mesh, tile, carried.start, cells);
    ctx.mesh.inverse_radii(tile, inverse_r);
    analysis.limited()
}

/// Conserved to primitive variables; m_g stays what it is.
fn to_primitive<const N: usize>(ctx: &FluidStep<'_, N>, with_gas: bool, cells: &mut TileRows<N>) {
    let mixture = &ctx.model.mixture;
    if mixture.has_covolume() && with_gas {
        let [rho, a, b, c, phi, gas] = cells.split_mut::<{ COUNT + 1 }>();
        rows::to_primitive([rho, a, b, c, phi], with_gas, Some(gas), mixture);
    } else {
        rows::to_primitive(cells.split_mut(), with_gas, None, mixture);
    }
}

/// Assembles a block with its ghosts and reconstructs it: primitive variables in `cells`, limited
/// differences in `s_z`, `s_r`. A step makes the differences together with the state at mid-step instead.
pub(crate) fn reconstruct<const N: usize>(
    ctx: &FluidStep<'_, N>,
    slot: usize,
    scratch: &mut BlockScratch<N>,
) {
    let tile = Tile::one(slot);
    assemble(ctx, tile, may_have_gas(ctx, slot), scratch);
    let BlockScratch { cells, s_z, s_r, .. } = scratch;
    for component in 0..COUNT {
        limited_differences(
            if component == PHI { ctx.model.scheme.fraction_limiter() } else { ctx.model.scheme.limiter },
            cells.component(component),
            cells.frame().stride(),
            s_z.component_mut(component),
            s_r.component_mut(component),
        );
    }
    even_slopes(ctx, tile, scratch);
}

impl<'a, const N: usize> TileStep<'a, N> {
    /// Primitive variables of the tile and its ghosts.
    pub(super) fn assemble(ctx: &'a FluidStep<'a, N>, tile: Tile, scratch: &mut BlockScratch<N>) -> Self {
        let id = ctx.mesh.first_of(tile);
        let widths = ctx.mesh.widths(id.level);
        let inverse_h = widths.map(|h| 1.0 / h);
        let rows =
            scratch.face_weight.chunks_exact_mut(N + 1).zip(scratch.inverse_weight.chunks_exact_mut(N));
        for (slot, (face_weight, inverse_weight)) in tile.slots_on(Side::ZMin).zip(rows) {
            let id = ctx.mesh.tree().leaves()[slot];
            let r_low = ctx.mesh.origin(id)[1];
            for (j, weight) in face_weight.iter_mut().enumerate() {
                *weight = ctx.mesh.weight(r_low + j as f64 * widths[1]);
            }
            for (j, inverse) in inverse_weight.iter_mut().enumerate() {
                *inverse = 1.0 / ctx.mesh.weight(ctx.mesh.centre(id, 0, j)[1]);
            }
        }
        let slot = tile.first();
        let may_have_gas = tile.slots().any(|slot| may_have_gas(ctx, slot));
        let limited_predictions = assemble(ctx, tile, may_have_gas, scratch);
        let gas = BlockGas::of(ctx, tile, may_have_gas, &scratch.cells);
        if !gas.is_present() {
            scratch.without_gas(ctx.model.scheme.phases.gas_component());
        }
        if let Some(gas) = gas.phases() {
            gas.shares(scratch);
        }
        if ctx.model.terms.is_diffusive {
            take_wall(ctx.mesh, ctx.interface, slot, &mut scratch.wall);
        }
        if let Some(memory) = &ctx.model.wall_memory
            && ctx.mesh.touches(slot, Side::ZMin)
        {
            memory.temperatures(ctx.mesh, id, ctx.dt, &mut scratch.wall_temperatures);
        }
        if let Some(tension) = ctx.model.terms.surface_tension() {
            find_jumps(ctx, slot, tension, gas.is_present(), scratch);
        }
        let frame = scratch.cells.frame();
        let counts = Clips { limited_predictions, ..Clips::default() };
        Self { ctx, tile, slot, id, frame, inverse_h, gas, all_keep: false, clips: counts }
    }

    /// Of a block of the tile.
    ///
    /// - `face_weight`, `inverse_weight`: as [`TileStep::assemble`] has left them.
    pub(super) fn metric_of<'b>(
        &self,
        number: usize,
        face_weight: &'b [f64],
        inverse_weight: &'b [f64],
    ) -> Metric<'b> {
        let place = self.tile.place(number);
        Metric {
            stride: self.frame.stride(),
            origin: self.frame.part(N, place).origin(),
            dt: self.ctx.dt,
            inverse_h: self.inverse_h,
            face_weight: &face_weight[place[1] * (N + 1)..][..N + 1],
            inverse_weight: &inverse_weight[place[1] * N..][..N],
        }
    }

    /// [`TileStep::metric_of`] of the only block.
    pub(super) fn metric<'b>(&self, face_weight: &'b [f64], inverse_weight: &'b [f64]) -> Metric<'b> {
        self.metric_of(0, face_weight, inverse_weight)
    }

    /// Limited differences, and the states at mid-step.
    pub(super) fn predict(&mut self, scratch: &mut BlockScratch<N>) {
        let scheme = &self.ctx.model.scheme;
        let predictor = Predictor {
            limiter: scheme.limiter,
            fraction_limiter: scheme.fraction_limiter(),
            stride: self.frame.stride(),
            inverse_h: self.inverse_h,
            inverse_r: &scratch.inverse_r,
            gas_shares: &scratch.gas_shares,
            half_dt: 0.5 * self.ctx.dt,
            mixture: self.ctx.model.mixture,
            with_gas: self.gas.is_present(),
            with_mixed: self.gas.is_of_kernels(),
        };
        let out = Predicted {
            s_z: scratch.s_z.split_mut(),
            s_r: scratch.s_r.split_mut(),
            half: scratch.half.split_mut(),
            keep: &mut scratch.keep,
            sound: &mut scratch.sound,
        };
        self.all_keep = predict(scratch.cells.split(), predictor, out);
        even_slopes(self.ctx, self.tile, scratch);
        self.all_keep &= predict_beside_mirrors(self.ctx, self.tile, self.inverse_h, scratch);
        if scratch.capillary.is_present() {
            self.all_keep = false;
            level_slopes(self.ctx, self.inverse_h, scratch);
        }
        if let Some(gain) = self.ctx.model.terms.velocity_gain(0.5 * self.ctx.dt) {
            for (component, gain) in VELOCITY.into_iter().zip(gain) {
                scratch.half.component_mut(component).iter_mut().for_each(|v| *v += gain);
            }
        }
    }

    /// States beyond the sides of the domain, and cells that make this step at first order.
    pub(super) fn impose_boundaries(&mut self, scratch: &mut BlockScratch<N>) {
        let BlockScratch { half, s_z, s_r, keep, .. } = scratch;
        self.ctx.model.boundaries.impose_outer(self.ctx, self.tile, [s_z, s_r], half, keep);
        if !self.ctx.marks.is_empty() {
            self.all_keep = false;
            at_first_order(self.ctx, self.slot, scratch);
        }
    }

    /// Cells with gas and liquid in them, which have face states of their own.
    pub(super) fn collect_mixed_cells(&self, scratch: &mut BlockScratch<N>) {
        if let Some(gas) = self.gas.phases() {
            gas.collect(scratch);
        }
    }

    /// What terms add to fluxes and cells, and what the mass carries with it: the fluxes are final then.
    pub(super) fn add_terms(&mut self, scratch: &mut BlockScratch<N>) {
        let ctx = self.ctx;
        if !ctx.model.terms.is_empty() {
            self.add_to_fluxes(scratch);
        }
        let BlockScratch { cells, carried, gas_shares, z_faces, r_faces, works, .. } = scratch;
        let own = ctx.model.carried.iter().zip(ctx.model.carried_components());
        for ((own, component), carried) in own.zip(carried) {
            if own.is_of_gas() {
                let (fraction, stride) = (cells.component(component), self.frame.stride());
                carried.carry_with_gas(fraction, gas_shares, stride, [z_faces, r_faces]);
                if let Some(selected) = ctx.model.terms.selected_vapour(works, fraction.len()) {
                    carried.add(selected);
                }
                continue;
            }
            let cells = CarriedCells {
                fraction: cells.component(component),
                velocity: VELOCITY.map(|c| cells.component(c)),
                stride: self.frame.stride(),
                inverse_h: self.inverse_h,
            };
            carried.carry(&cells, ctx.model.scheme.limiter, ctx.dt, [z_faces, r_faces]);
        }
    }

    /// What passes to blocks of other levels.
    pub(super) fn register_fluxes(&self, scratch: &BlockScratch<N>, fluxes: &mut [f64]) {
        let BlockScratch { z_faces, r_faces, carried, .. } = scratch;
        let len = fluxes.len() / self.tile.blocks();
        for ((number, slot), fluxes) in self.tile.slots().enumerate().zip(fluxes.chunks_exact_mut(len)) {
            let at = self.tile.frame_of::<N>(number);
            register_fluxes(self.ctx.mesh, (slot, at), z_faces, r_faces, carried, fluxes);
        }
    }

    /// The new cells of a block.
    ///
    /// - `number`: of the block in the tile; `new`, `report`: its own.
    pub(super) fn update(
        &self,
        number: usize,
        scratch: &mut BlockScratch<N>,
        new: &mut [f64],
        report: &mut BlockReport<N>,
    ) {
        let ctx = self.ctx;
        let BlockScratch {
            z_faces,
            r_faces,
            face_weight,
            inverse_weight,
            speeds,
            gas,
            cells,
            inverse_r,
            with_sources,
            carried,
            capillary,
            ..
        } = scratch;
        let metric = self.metric_of(number, face_weight, inverse_weight);
        let old = if ctx.model.terms.is_empty() { ctx.old.block(self.slot + number) } else { with_sources };
        let old_rows: [&[f64]; COUNT] = std::array::from_fn(|c| &old[c * N * N..(c + 1) * N * N]);
        let faces = [&*z_faces, &*r_faces];
        let mut speeds = speeds.split_mut::<3>().map(|row| &mut row[..N * N]);
        let (state, more) = new.split_at_mut(COUNT * N * N);
        // The pressure of the new cells asks for the gas's mass.
        let gas_after = self.gas.phases().map(|block| {
            block.advance_gas(old, faces, &metric, &mut more[..N * N]);
            &more[..N * N]
        });
        let rows =
            NewCells { conserved: split_block::<N>(state), speeds: speeds.each_mut().map(|row| &mut **row) };
        update::<N>(old_rows, faces, &metric, (self.gas.is_present(), gas_after), &ctx.model.mixture, rows);
        if let Some(block) = self.gas.phases() {
            let padded = [PRESSURE, PHI].map(|component| cells.component(component));
            let before = Before { number, old, padded, inverse_r, metric: &metric, capillary };
            block.update(gas, before, faces, new, speeds, report);
        } else if self.gas.is_present() {
            let (is_left, removed) = remove_traces(&mut new[PHI * N * N..(PHI + 1) * N * N]);
            report.has_gas = is_left;
            report.clips.removed_traces += removed;
        } else if !is_zero(&new[PHI * N * N..]) {
            // Mostly there is nothing but zeros; to write them would be a fourth of what a step writes.
            new[PHI * N * N..].fill(0.0);
        }
        for (component, carried) in ctx.model.carried_components().zip(carried) {
            let rows = component * N * N..(component + 1) * N * N;
            carried.update::<N>(&old[rows.clone()], &metric, &mut new[rows]);
        }
        if !ctx.model.terms.is_empty() && self.gas.phases().is_some() {
            report.tension[1] += self.finish_terms(scratch, new);
        }
        if let Some(exchange) = &ctx.model.exchange {
            self.change_phase(exchange, scratch, new, report);
        }
    }

    /// What goes from one phase to the other at the end of the step.
    fn change_phase(
        &self,
        exchange: &Exchange,
        scratch: &mut BlockScratch<N>,
        new: &mut [f64],
        report: &mut BlockReport<N>,
    ) {
        let place = BlockPlace {
            phi: scratch.cells.component(PHI),
            inverse_h: self.inverse_h,
            dt: self.ctx.dt,
            volume: &|j| self.ctx.mesh.volume(self.id, j),
            had_gas: self.gas.is_present(),
            capillary: &scratch.capillary,
        };
        let mut speeds = scratch.speeds.split_mut::<3>().map(|row| &mut row[..N * N]);
        report.exchange = exchange.act::<N>(&place, new, &mut speeds);
        report.tension[1] += report.exchange.tension_work;
        report.has_gas |= report.exchange.opened > 0;
    }
}

/// What bounds the domain on the sides of a block; `None` where other blocks are.
pub(crate) fn block_sides<const N: usize>(ctx: &FluidStep<'_, N>, slot: usize) -> [Option<Boundary>; 4] {
    Side::ALL.map(|side| {
        let kind = ctx.model.boundaries.kind(side);
        (kind != Boundary::Periodic && ctx.mesh.touches(slot, side)).then_some(kind)
    })
}

/// Takes the marked cells' means for the states on their faces.
fn at_first_order<const N: usize>(ctx: &FluidStep<'_, N>, slot: usize, scratch: &mut BlockScratch<N>) {
    let BlockScratch { cells, half, keep, gas, .. } = scratch;
    for k in gas.mark(ctx.mesh, slot, ctx.marks) {
        keep[k] = 0.0;
        for component in 0..COUNT {
            half.component_mut(component)[k] = cells.component(component)[k];
        }
    }
}
