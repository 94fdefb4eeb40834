//! The step of a tile, a block or four, in which nothing has a say but waves.

use mesh::{BlockWork, Side, Tile};

use super::sweep::{Sweep, sweep};
use super::{BlockScratch, BlockStep, Stage, stages};
use crate::boundary::outer_states::MidStep;
use crate::physics::SolidStep;
use crate::reconstruction::predictor::Predictor;
use crate::state::component::COUNT;
use crate::step::mises::LEAST;
use crate::step::reflux::register_stars;
use crate::step::report::{BlockReport, boundary_inflow, yielded_volume};

/// Whether nothing but waves has a say in the blocks of a tile: no terms, no other medium, no plastic flow so far, in no neighbour either.
pub(crate) fn has_only_waves<const N: usize>(ctx: &SolidStep<'_, N>, tile: Tile) -> bool {
    let model = ctx.model;
    let is_elastic = |slot: usize| match &model.following {
        None => true,
        Some(following) => model.is_untouched(ctx.mesh, slot) && following.of_block(slot).rates.is_zero,
    };
    let is_plain = |slot: usize| ctx.interface.first_face(slot).is_none() && is_elastic(slot);
    model.terms.is_empty() && tile.slots().all(is_plain)
}

/// Advances the blocks of a tile with [`has_only_waves`] by one step from `ctx.old`.
///
/// - returns: whether they have been; not where something may yield until mid-step.
pub(crate) fn step_tile<const N: usize>(
    ctx: &SolidStep<'_, N>,
    tile: Tile,
    work: &mut BlockWork<'_, BlockScratch<N>>,
    reports: &mut [BlockReport],
) -> bool {
    let BlockWork { new, register, scratch, timer } = work;
    stages::assemble(ctx, tile, COUNT, scratch);
    timer.end(Stage::Assemble as usize);
    let Some(largest) = sweep_tile(ctx, tile, scratch, new) else { return false };
    timer.end(Stage::Sweep as usize);
    scratch.flow.acts = false;
    let (len, registered) = (new.len() / tile.blocks(), register.len() / tile.blocks());
    let parts = new.chunks_exact_mut(len).zip(register.chunks_exact_mut(registered)).zip(reports);
    for ((number, slot), ((new, stars), report)) in tile.slots().enumerate().zip(parts) {
        let (place, rim) = (tile.place(number), &scratch.sweep.rim);
        register_stars(ctx.mesh, slot, place, rim, stars);
        timer.end(Stage::Register as usize);
        *report = BlockReport { mises_squared: largest[number], ..BlockReport::default() };
        let block = BlockStep::of(ctx, slot, true);
        block.flow(scratch, new, report);
        timer.end(Stage::Plastic as usize);
        report.yielded = yielded_volume(ctx.mesh, slot, new, report.mises_squared, ctx.model.yield_squared());
        report.inflow = boundary_inflow(ctx, slot, place, &scratch.sweep.rim);
        timer.end(Stage::Report as usize);
    }
    true
}

/// From the padded cells to the new ones, see [`sweep`].
fn sweep_tile<const N: usize>(
    ctx: &SolidStep<'_, N>,
    tile: Tile,
    scratch: &mut BlockScratch<N>,
    new: &mut [f64],
) -> Option<[f64; 4]> {
    let BlockScratch { cells, inverse_r, sweep: within, .. } = scratch;
    let (model, frame) = (ctx.model, cells.frame());
    let widths = ctx.mesh.widths(ctx.mesh.first_of(tile).level);
    let most_mises = model.plasticity.as_ref().map_or(f64::INFINITY, |plasticity| {
        let least = plasticity.hardening().yield_stress(0.0, 0.0, plasticity.reference());
        LEAST * least * least
    });
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
        most_mises,
        is_far: ctx.old.is_far(),
    };
    let has_sides = Side::ALL.into_iter().any(|side| ctx.mesh.tile_touches(tile, side));
    let (is_far, strips) = (this.is_far, frame.cells() / 2 + 1);
    let mut between = |strip: usize, mut mid_step: MidStep<'_>| {
        if is_far {
            ctx.old.look_beyond(tile, strip, strips);
        }
        if has_sides {
            let first = 2 * strip as isize - 1;
            model.boundaries.impose_outer(ctx, tile, cells, first..first + 2, &mut mid_step);
        }
    };
    if tile.is_one() {
        sweep::<N, 1>(cells.split(), &this, within, new, &mut between)
    } else {
        sweep::<N, 2>(cells.split(), &this, within, new, &mut between)
    }
}
