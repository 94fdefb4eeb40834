//! The step of a tile, a block or four, in one sweep: nothing has a say in it but waves and, by some laws, plastic flow.

use std::ops::ControlFlow;

use mesh::{BlockWork, Side, Tile};

use super::sweep::{Sweep, sweep};
use super::{BlockScratch, BlockStep, Stage, stages};
use crate::boundary::outer_states::MidStep;
use crate::components::PLASTIC_STRAIN;
use crate::physics::SolidStep;
use crate::plasticity::Plasticity;
use crate::reconstruction::predictor::Predictor;
use crate::state::component::COUNT;
use crate::step::flow_of_strips::FlowOfStrips;
use crate::step::reflux::register_stars;
use crate::step::report::{BlockReport, boundary_inflow, yielded_volume};

/// Whether the blocks of a tile can be made in one sweep: no terms, no other medium, and what may flow in them does so by a law on straight
/// lines, or none has flowed so far, in no neighbour either.
pub(crate) fn can_be_swept<const N: usize>(ctx: &SolidStep<'_, N>, tile: Tile) -> bool {
    let model = ctx.model;
    let needs_more = model.plasticity.as_ref().is_some_and(|own| !own.is_on_lines());
    let is_plain = |slot: usize| {
        ctx.interface.first_face(slot).is_none() && (!needs_more || has_never_flowed(ctx, slot))
    };
    model.terms.is_empty() && tile.slots().all(is_plain)
}

/// Whether neither a block nor a neighbour has yielded so far, nor flows.
fn has_never_flowed<const N: usize>(ctx: &SolidStep<'_, N>, slot: usize) -> bool {
    let model = ctx.model;
    model.plasticity.is_none() || (model.is_untouched(ctx.mesh, slot) && !model.flows(slot))
}

/// How many components of the cells a sweep looks at: where nothing has flowed so far, or what has does not matter, those of elastic solids.
fn components_read<const N: usize>(ctx: &SolidStep<'_, N>, has_flowed: bool) -> usize {
    if has_flowed && needs_strain(ctx) { ctx.old.components() } else { COUNT }
}

fn needs_strain<const N: usize>(ctx: &SolidStep<'_, N>) -> bool {
    ctx.model.plasticity.as_ref().is_some_and(Plasticity::needs_strain)
}

/// Advances the blocks of a tile that [`can_be_swept`] by one step from `ctx.old`.
///
/// - returns: whether they have been; not where something may yield for the first time until mid-step.
pub(crate) fn step_tile<const N: usize>(
    ctx: &SolidStep<'_, N>,
    tile: Tile,
    work: &mut BlockWork<'_, BlockScratch<N>>,
    reports: &mut [BlockReport],
) -> bool {
    let BlockWork { new, register, scratch, timer } = work;
    let has_flowed = !tile.slots().all(|slot| has_never_flowed(ctx, slot));
    stages::assemble(ctx, tile, components_read(ctx, has_flowed), scratch);
    timer.end(Stage::Assemble as usize);
    let Some(largest) = sweep_tile(ctx, tile, has_flowed, scratch, new) else { return false };
    timer.end(Stage::Sweep as usize);
    scratch.flow.acts = false;
    let (len, registered) = (new.len() / tile.blocks(), register.len() / tile.blocks());
    let parts = new.chunks_exact_mut(len).zip(register.chunks_exact_mut(registered)).zip(reports);
    for ((number, slot), ((new, stars), report)) in tile.slots().enumerate().zip(parts) {
        let (place, rim) = (tile.place(number), &scratch.sweep.rim);
        register_stars(ctx.mesh, slot, place, rim, stars);
        timer.end(Stage::Register as usize);
        *report = BlockReport { mises_squared: largest[number], ..BlockReport::default() };
        let block = BlockStep::of(ctx, slot, !has_flowed);
        block.flow(scratch, new, report);
        timer.end(Stage::Plastic as usize);
        report.yielded = yielded_volume(ctx.mesh, slot, new, report.mises_squared, ctx.model.yield_squared());
        report.inflow = boundary_inflow(ctx, slot, place, &scratch.sweep.rim);
        timer.end(Stage::Report as usize);
    }
    true
}

/// From the padded cells to the new ones, see [`sweep`].
///
/// - `has_flowed`: whether what may flow is returned at mid-step; else the sweep ends where something would.
fn sweep_tile<const N: usize>(
    ctx: &SolidStep<'_, N>,
    tile: Tile,
    has_flowed: bool,
    scratch: &mut BlockScratch<N>,
    new: &mut [f64],
) -> Option<[f64; 4]> {
    let BlockScratch { cells, inverse_r, sweep: within, .. } = scratch;
    let (model, frame) = (ctx.model, cells.frame());
    let widths = ctx.mesh.widths(ctx.mesh.first_of(tile).level);
    let flow = model.plasticity.as_ref().map(|plasticity| {
        let of_cells = || if needs_strain(ctx) { cells.component(PLASTIC_STRAIN) } else { &[] };
        let strain = has_flowed.then(of_cells);
        FlowOfStrips::new(plasticity, strain, tile.slots().all(|slot| model.flows(slot)))
    });
    let (is_far, strips) = (ctx.old.is_far(), frame.cells() / 2 + 1);
    let read = components_read(ctx, has_flowed);
    let this = Sweep {
        predictor: Predictor {
            limiter: model.setup.limiter,
            stride: frame.stride(),
            inverse_h: widths.map(|h| 1.0 / h),
            inverse_r,
            half_dt: 0.5 * ctx.dt,
        },
        dispersion: [0, 1].map(|axis| model.dispersion(widths, ctx.dt, axis)),
        elasticity: model.elasticity,
        dt: ctx.dt,
        is_far,
    };
    let has_sides = Side::ALL.into_iter().any(|side| ctx.mesh.tile_touches(tile, side));
    let mut between = |strip: usize, mut mid_step: MidStep<'_>| {
        if is_far {
            ctx.old.look_beyond(tile, read, strip, strips);
        }
        if let Some(flow) = &flow {
            flow.return_strip(&mut mid_step)?;
        }
        if has_sides {
            let first = 2 * strip as isize - 1;
            model.boundaries.impose_outer(ctx, tile, cells, first..first + 2, &mut mid_step);
        }
        ControlFlow::Continue(())
    };
    if tile.is_one() {
        sweep::<N, 1>(cells.split(), &this, within, new, &mut between)
    } else {
        sweep::<N, 2>(cells.split(), &this, within, new, &mut between)
    }
}
