//! One MUSCL-Hancock step of one tile, a block or four: the algorithm, stage by stage.

pub(crate) mod clips;
pub(crate) mod face_rows;
pub(crate) mod reflux;
pub(crate) mod report;
pub(crate) mod rows;
pub(crate) mod update;

mod faces;
mod jumps;
mod scratch;
mod stages;
mod tell;
#[cfg(test)]
mod tile_tests;
mod with_terms;

use mesh::{BlockId, BlockWork, Frame, Tile};

pub use scratch::BlockScratch;
pub(crate) use scratch::{split_block, take_wall};
pub(crate) use stages::{block_sides, reconstruct};

use crate::physics::{Fluid, FluidStep};
use crate::step::clips::Clips;
use crate::step::report::BlockReport;
use crate::terms::super_stepping::{SpreadBlock, Spreading};
use crate::two_phase::BlockGas;

/// The stages of a step, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    Assemble,
    Predict,
    Boundary,
    MixedCells,
    Faces,
    Terms,
    Register,
    Update,
    Report,
}

/// Their names.
pub(crate) const STAGES: &[&str] =
    &["assemble", "predict", "boundary", "mixed_cells", "faces", "terms", "register", "update", "report"];

/// A tile in a step.
struct TileStep<'a, const N: usize> {
    ctx: &'a FluidStep<'a, N>,
    tile: Tile,
    /// Its first block, the only one but where there is nothing but the fluid's own fluxes: see [`may_join`].
    slot: usize,
    id: BlockId,
    /// Where its cells lie in the padded rows.
    frame: Frame,
    /// 1/h_z, 1/h_r.
    inverse_h: [f64; 2],
    gas: BlockGas<'a, N>,
    /// Whether all cells are known to keep their slopes.
    all_keep: bool,
    /// What was bounded in the tile as a whole.
    clips: Clips,
}

/// Begins what spreads in stages in a block of a group, see [`SpreadBlock::begin`].
pub(crate) fn begin_spreading<const N: usize>(
    ctx: &FluidStep<'_, N>,
    (slot, group): (usize, &[bool]),
    of: &dyn Spreading,
    scratch: &mut BlockScratch<N>,
) -> (SpreadBlock, f64) {
    let mut block = TileStep::assemble(ctx, Tile::one(slot), scratch);
    block.predict(scratch);
    block.begin_spreading(of, group, scratch)
}

/// Whether the blocks of a tile are stepped as one: where nothing has a say but their cells' own fluxes.
///
/// Terms, what the mass carries, phase change and the wall to the solid are made block by block.
pub(crate) fn is_one<const N: usize>(ctx: &FluidStep<'_, N>, tile: Tile) -> bool {
    let Fluid { terms, exchange, carried, has_tiles, .. } = ctx.model;
    let is_plain = terms.is_empty() && exchange.is_none() && carried.is_empty();
    *has_tiles && is_plain && tile.slots().all(|slot| ctx.interface.first_face(slot).is_none())
}

/// Advances the blocks of a tile by one step from `ctx.old`.
pub(crate) fn step_tile<const N: usize>(
    ctx: &FluidStep<'_, N>,
    tile: Tile,
    BlockWork { new, register, scratch, timer }: BlockWork<'_, BlockScratch<N>>,
    reports: &mut [BlockReport<N>],
) {
    let mut done = |stage: Stage| timer.end(stage as usize);
    let mut step = TileStep::assemble(ctx, tile, scratch);
    done(Stage::Assemble);
    ctx.mesh.look_ahead_of(ctx.old, tile, new, 0, 3);
    step.predict(scratch);
    step.predict_terms(scratch);
    done(Stage::Predict);
    ctx.mesh.look_ahead_of(ctx.old, tile, new, 1, 3);
    step.impose_boundaries(scratch);
    done(Stage::Boundary);
    step.collect_mixed_cells(scratch);
    done(Stage::MixedCells);
    ctx.mesh.look_ahead_of(ctx.old, tile, new, 2, 3);
    step.solve_faces(scratch);
    done(Stage::Faces);
    step.add_terms(scratch);
    done(Stage::Terms);
    step.register_fluxes(scratch, register);
    done(Stage::Register);
    let len = new.len() / reports.len();
    for (number, (new, report)) in new.chunks_exact_mut(len).zip(reports).enumerate() {
        *report = BlockReport { sides: report.sides.take(), ..BlockReport::default() };
        step.update(number, scratch, new, report);
        done(Stage::Update);
        step.report(number, scratch, new, report);
        done(Stage::Report);
    }
}
