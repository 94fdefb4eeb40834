//! The stages of a block's step; the faces have a file of their own.

use mesh::{FaceState, Padded, Side, limited_differences};

use super::BlockStep;
use super::jumps::find_jumps;
use super::scratch::{BlockScratch, split_block, take_wall};
use crate::capillarity::{CapillaryRows, cell_at_wall};
use crate::components::carried::CarriedCells;
use crate::phase_change::{BlockPlace, Exchange};
use crate::physics::FluidStep;
use crate::reconstruction::Rows;
use crate::reconstruction::capillary::level_slopes;
use crate::reconstruction::even::{even_slopes, predict_beside_mirrors};
use crate::reconstruction::predictor::{Predicted, Predictor, predict};
use crate::state::COUNT;
use crate::state::primitive::{PHI, PRESSURE, RHO, VELOCITY};
use crate::step::clips::{Clips, CountedAnalysis};
use crate::step::reflux::register_fluxes;
use crate::step::report::{BlockReport, boundary_inflow, count_kept, far_field_gains};
use crate::step::rows;
use crate::step::update::{Extremes, Metric, NewCells, update};
use crate::terms::super_stepping::{SpreadBlock, Spreading, View};
use crate::terms::{FinishedCells, HeatBeyond, TermBlock};
use crate::two_phase::{Before, BlockGas, may_have_gas};
use crate::{Boundary, WallHeat};

/// Assembles a block with its ghosts: primitive variables in `cells`.
///
/// - `with_gas`: whether the gas is looked at; else there is none, neither in the block nor in its neighbours.
/// - returns: how many predictions of ghosts were limited.
fn assemble<const N: usize>(
    ctx: &FluidStep<'_, N>,
    slot: usize,
    with_gas: bool,
    scratch: &mut BlockScratch<N>,
) -> u64 {
    if !with_gas {
        scratch.without_gas();
    }
    scratch.has_gas = with_gas;
    let BlockScratch { cells, patch, inverse_r, .. } = scratch;
    let carried = ctx.model.carried_components();
    let components = if with_gas || !carried.is_empty() { ctx.old.components() } else { PHI };
    let analysis = CountedAnalysis::new(&ctx.model.analysis);
    cells.assemble_first(components, ctx.mesh, ctx.old, slot, &analysis, patch);
    debug_assert!(with_gas || cells.component(PHI).iter().all(|phi| *phi == 0.0), "neighbours have no gas");
    for component in carried.clone() {
        cells.divide(component, RHO);
    }
    to_primitive(ctx, with_gas, cells);
    ctx.model.boundaries.fill_ghosts(ctx.mesh, slot, carried.start, cells);
    let id = ctx.mesh.tree().leaves()[slot];
    ctx.mesh.inverse_radii(id, inverse_r);
    analysis.limited()
}

/// Conserved to primitive variables; m_g stays what it is.
fn to_primitive<const N: usize>(ctx: &FluidStep<'_, N>, with_gas: bool, cells: &mut Padded<N>) {
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
    assemble(ctx, slot, may_have_gas(ctx, slot), scratch);
    let BlockScratch { cells, s_z, s_r, .. } = scratch;
    for component in 0..COUNT {
        limited_differences(
            if component == PHI { ctx.model.scheme.fraction_limiter() } else { ctx.model.scheme.limiter },
            cells.component(component),
            Padded::<N>::STRIDE,
            s_z.component_mut(component),
            s_r.component_mut(component),
        );
    }
    even_slopes(ctx, slot, scratch);
}

impl<'a, const N: usize> BlockStep<'a, N> {
    /// Primitive variables of the block and its ghosts.
    pub(super) fn assemble(ctx: &'a FluidStep<'a, N>, slot: usize, scratch: &mut BlockScratch<N>) -> Self {
        let id = ctx.mesh.tree().leaves()[slot];
        let widths = ctx.mesh.widths(id.level);
        let inverse_h = widths.map(|h| 1.0 / h);
        let r_low = ctx.mesh.origin(id)[1];
        for (j, weight) in scratch.face_weight.iter_mut().enumerate() {
            *weight = ctx.mesh.weight(r_low + j as f64 * widths[1]);
        }
        for (j, inverse) in scratch.inverse_weight.iter_mut().enumerate() {
            *inverse = 1.0 / ctx.mesh.weight(ctx.mesh.centre(id, 0, j)[1]);
        }
        let may_have_gas = may_have_gas(ctx, slot);
        let limited_predictions = assemble(ctx, slot, may_have_gas, scratch);
        let gas = BlockGas::of(ctx, slot, may_have_gas, &scratch.cells);
        if !gas.is_present() {
            scratch.without_gas();
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
        let bounded = Clips::default();
        Self { ctx, slot, id, inverse_h, gas, limited_predictions, clipped_roots: 0, bounded }
    }

    /// - `face_weight`, `inverse_weight`: as [`BlockStep::assemble`] has left them.
    fn metric<'b>(&self, face_weight: &'b [f64], inverse_weight: &'b [f64]) -> Metric<'b> {
        Metric {
            stride: Padded::<N>::STRIDE,
            origin: Padded::<N>::index(0, 0),
            dt: self.ctx.dt,
            inverse_h: self.inverse_h,
            face_weight,
            inverse_weight,
        }
    }

    /// The block as terms see it; `rows`: the padded cells as they are to see them, and at the beginning of the step.
    fn term_block<'b>(
        &'b self,
        metric: &'b Metric<'b>,
        inverse_r: &'b [f64],
        [state, before]: [Rows<'b>; 2],
        more: MoreForTerms<'b>,
    ) -> TermBlock<'b> {
        let MoreForTerms { capillary, gas_shares, wall, wall_temperatures } = more;
        let heat_beyond = match (&self.ctx.model.wall_heat, &self.ctx.model.wall_memory) {
            (WallHeat::Isothermal(temperature), _) => HeatBeyond::Kept(*temperature),
            (_, Some(memory)) => HeatBeyond::Wall {
                temperatures: wall_temperatures,
                resistance: memory.resistance(self.ctx.dt),
            },
            _ => HeatBeyond::Nothing,
        };
        TermBlock {
            cells: N,
            metric,
            inverse_r,
            state,
            before,
            sides: block_sides(self.ctx, self.slot),
            wall: (!wall.is_empty()).then_some(wall),
            capillary,
            gas: self.gas.mass(gas_shares),
            heat_beyond,
            spread: View::of(self.ctx.prepared, self.ctx.mesh, self.slot),
        }
    }

    /// Limited differences, and the states at mid-step.
    pub(super) fn predict(&self, scratch: &mut BlockScratch<N>) {
        let scheme = &self.ctx.model.scheme;
        let predictor = Predictor {
            limiter: scheme.limiter,
            fraction_limiter: scheme.fraction_limiter(),
            stride: Padded::<N>::STRIDE,
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
        predict(scratch.cells.split(), predictor, out);
        even_slopes(self.ctx, self.slot, scratch);
        predict_beside_mirrors(self.ctx, self.slot, self.inverse_h, scratch);
        if scratch.capillary.is_present() {
            level_slopes(self.ctx, self.inverse_h, scratch);
        }
        if let Some(gain) = self.ctx.model.terms.velocity_gain(0.5 * self.ctx.dt) {
            for (component, gain) in VELOCITY.into_iter().zip(gain) {
                scratch.half.component_mut(component).iter_mut().for_each(|v| *v += gain);
            }
        }
    }

    /// What terms add to the states at mid-step.
    pub(super) fn predict_terms(&self, scratch: &mut BlockScratch<N>) {
        let terms = &self.ctx.model.terms;
        if !terms.is_diffusive {
            return;
        }
        let BlockScratch { cells, half, inverse_r, face_weight, inverse_weight, works, capillary, .. } =
            scratch;
        let BlockScratch { gas_shares, wall, wall_temperatures, .. } = scratch;
        let (metric, rows) = (self.metric(face_weight, inverse_weight), cells.split());
        let more = MoreForTerms { capillary, gas_shares, wall, wall_temperatures };
        let block = self.term_block(&metric, inverse_r, [rows; 2], more);
        let [_, v_z, v_r, p, _] = half.split_mut::<COUNT>();
        if terms.is_viscous {
            terms.predict(&block, [v_z, v_r], works);
        }
        if terms.conducts {
            terms.predict_pressure(&block, p, works);
        }
    }

    /// Begins what spreads in stages, see [`SpreadBlock::begin`]; the block has been predicted.
    pub(super) fn begin_spreading(
        &self,
        of: &dyn Spreading,
        scratch: &mut BlockScratch<N>,
    ) -> (SpreadBlock, f64) {
        let BlockScratch { cells, half, inverse_r, face_weight, inverse_weight, capillary, .. } = scratch;
        let BlockScratch { gas_shares, wall, wall_temperatures, spread_work, .. } = scratch;
        let metric = self.metric(face_weight, inverse_weight);
        let more = MoreForTerms { capillary, gas_shares, wall, wall_temperatures };
        let block = self.term_block(&metric, inverse_r, [half.split(), cells.split()], more);
        SpreadBlock::begin(self.slot, of, &block, spread_work)
    }

    /// States beyond the sides of the domain, and cells that make this step at first order.
    pub(super) fn impose_boundaries(&self, scratch: &mut BlockScratch<N>) {
        let BlockScratch { half, s_z, s_r, keep, .. } = scratch;
        self.ctx.model.boundaries.impose_outer(self.ctx, self.slot, [s_z, s_r], half, keep);
        if !self.ctx.marks.is_empty() {
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
            let BlockScratch { z_faces, r_faces, face_weight, inverse_weight, half, with_sources, .. } =
                scratch;
            let BlockScratch { cells, inverse_r, works, capillary, gas_shares, .. } = scratch;
            let BlockScratch { wall, wall_temperatures, .. } = scratch;
            let metric = &self.metric(face_weight, inverse_weight);
            let rows = [half.split(), cells.split()];
            let more = MoreForTerms { capillary, gas_shares, wall, wall_temperatures };
            let block = self.term_block(metric, inverse_r, rows, more);
            with_sources.clear();
            with_sources.extend_from_slice(ctx.old.block(self.slot));
            self.bounded = ctx.model.terms.add(&block, [z_faces, r_faces], works, with_sources);
        }
        let BlockScratch { cells, carried, gas_shares, z_faces, r_faces, .. } = scratch;
        let own = ctx.model.carried.iter().zip(ctx.model.carried_components());
        for ((own, component), carried) in own.zip(carried) {
            if own.is_of_gas() {
                let (fraction, stride) = (cells.component(component), Padded::<N>::STRIDE);
                carried.carry_with_gas(fraction, gas_shares, stride, [z_faces, r_faces]);
                continue;
            }
            let cells = CarriedCells {
                fraction: cells.component(component),
                velocity: VELOCITY.map(|c| cells.component(c)),
                stride: Padded::<N>::STRIDE,
                inverse_h: self.inverse_h,
            };
            carried.carry(&cells, ctx.model.scheme.limiter, ctx.dt, [z_faces, r_faces]);
        }
    }

    /// What passes to blocks of other levels.
    pub(super) fn register_fluxes(&self, scratch: &BlockScratch<N>, fluxes: &mut [f64]) {
        let BlockScratch { z_faces, r_faces, carried, .. } = scratch;
        register_fluxes(self.ctx.mesh, self.slot, z_faces, r_faces, carried, fluxes);
    }

    /// The new cells.
    pub(super) fn update(&self, scratch: &mut BlockScratch<N>, new: &mut [f64], report: &mut BlockReport<N>) {
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
        let metric = self.metric(face_weight, inverse_weight);
        let old = if ctx.model.terms.is_empty() { ctx.old.block(self.slot) } else { with_sources };
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
            let pressure = cells.component(PRESSURE);
            let before = Before { old, pressure, inverse_r, metric: &metric, capillary };
            block.update(gas, before, faces, new, speeds, report);
        } else if !self.gas.is_present() {
            new[PHI * N * N..].fill(0.0);
        }
        for (component, carried) in ctx.model.carried_components().zip(carried) {
            let rows = component * N * N..(component + 1) * N * N;
            carried.update::<N>(&old[rows.clone()], &metric, &mut new[rows]);
        }
        if ctx.model.terms.is_diffusive && self.gas.phases().is_some() {
            self.finish_terms(scratch, new);
        }
        if let Some(exchange) = &ctx.model.exchange {
            self.change_phase(exchange, scratch, new, report);
        }
    }

    /// What terms do to the cells of both phases at the end of the step.
    fn finish_terms(&self, scratch: &mut BlockScratch<N>, new: &mut [f64]) {
        let BlockScratch { cells, face_weight, inverse_weight, speeds, works, .. } = scratch;
        let mut cells = FinishedCells {
            cells: N,
            metric: &self.metric(face_weight, inverse_weight),
            phi: cells.component(PHI),
            new,
            speeds: speeds.split_mut::<3>().map(|row| &mut row[..N * N]),
        };
        self.ctx.model.terms.finish(&mut cells, works);
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
        };
        let mut speeds = scratch.speeds.split_mut::<3>().map(|row| &mut row[..N * N]);
        report.exchange = exchange.act::<N>(&place, new, &mut speeds);
        report.has_gas |= report.exchange.opened > 0;
    }

    /// The axial momentum and the energy that surface tension has added to the block (per radian).
    fn tension_gains(&self, scratch: &BlockScratch<N>) -> [f64; 2] {
        let BlockScratch { z_faces, r_faces, face_weight, inverse_weight, capillary, .. } = scratch;
        let mut gains = [0.0; 2];
        let metric = self.metric(face_weight, inverse_weight);
        capillary.for_gains(N, &metric, [&z_faces.velocity, &r_faces.velocity], |cell, [axial, _, work]| {
            let volume = self.ctx.mesh.volume(self.id, cell / N);
            gains[0] += volume * axial;
            gains[1] += volume * work;
        });
        gains
    }

    /// What the block tells of the step.
    pub(super) fn report(&self, scratch: &mut BlockScratch<N>, new: &[f64], report: &mut BlockReport<N>) {
        let ctx = self.ctx;
        let [fallbacks, halved] = count_kept::<N>(&scratch.keep);
        report.fallbacks += fallbacks;
        report.clips += Clips {
            halved_slopes: u64::from(halved),
            limited_predictions: self.limited_predictions,
            clipped_roots: self.clipped_roots,
            ..self.bounded
        };
        let speeds = scratch.speeds.split::<3>().map(|row| &row[..N * N]);
        let [_, _, floor] = speeds;
        report.extremes = Extremes::of(&new[PHI * N * N..(PHI + 1) * N * N], speeds);
        if report.extremes.floor > 0.0 {
            for (cell, added) in floor.iter().enumerate().filter(|(_, added)| **added > 0.0) {
                report.marked.insert(cell);
                report.lift_pressure(*added, ctx.mesh.volume(self.id, cell / N));
            }
        }
        if scratch.capillary.is_present() {
            report.tension = self.tension_gains(scratch);
            if ctx.model.terms.forbids_contact() {
                let found = cell_at_wall(ctx.mesh, self.slot, ctx.model.analysis.boundaries, new);
                report.contact = found.map(|cell| cell as u32);
            }
        }
        let BlockScratch { z_faces, r_faces, face_weight, half, works, .. } = &*scratch;
        if ctx.mesh.touches(self.slot, Side::ZMin) {
            for (j, pressure) in report.wall_pressure.iter_mut().enumerate() {
                *pressure = z_faces.pressure[Padded::<N>::index(-1, j as isize)];
            }
        }
        if ctx.model.terms.is_diffusive {
            report.diffusivity = ctx.model.diffusivity::<N>(new);
        }
        if ctx.model.terms.is_viscous && ctx.mesh.touches(self.slot, Side::ZMin) {
            let wall = ctx.interface.states_of::<N>(self.slot);
            // Through a wall at rest no mass carries any momentum along.
            let of_rest = |j: usize| -z_faces.shear[Padded::<N>::index(-1, j as isize)];
            report.wall_shear =
                std::array::from_fn(|j| wall.map_or_else(|| of_rest(j), |wall| wall[j].shear));
        }
        if ctx.model.has_wall()
            && ctx.mesh.touches(self.slot, Side::ZMin)
            && let Some([flux, temperature]) = ctx.model.terms.wall_heat(works, Padded::<N>::LEN)
        {
            report.wall_heat.copy_from_slice(flux);
            report.wall_temperature.copy_from_slice(temperature);
        }
        report.inflow = boundary_inflow(ctx, self.slot, z_faces, r_faces, face_weight);
        report.impulse = far_field_gains(ctx, self.slot, half, z_faces, r_faces);
    }
}

/// What of the scratch terms need besides.
struct MoreForTerms<'a> {
    capillary: &'a CapillaryRows,
    /// m_g/ρ of the padded cells.
    gas_shares: &'a [f64],
    /// See [`TermBlock::wall`]; empty where there is none.
    wall: &'a [FaceState],
    /// See [`HeatBeyond::Wall`].
    wall_temperatures: &'a [f64],
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
