//! One MUSCL-Hancock step of one block: the algorithm, stage by stage.

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

use mesh::{BlockId, StageTimer};

pub use scratch::BlockScratch;
pub(crate) use scratch::{split_block, take_wall};
pub(crate) use stages::{block_sides, reconstruct};

use crate::physics::FluidStep;
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

/// A block in a step.
struct BlockStep<'a, const N: usize> {
    ctx: &'a FluidStep<'a, N>,
    slot: usize,
    id: BlockId,
    /// 1/h_z, 1/h_r.
    inverse_h: [f64; 2],
    gas: BlockGas<'a, N>,
    limited_predictions: u64,
    clipped_roots: u64,
    /// What terms were bounded in.
    bounded: Clips,
}

/// Begins what spreads in stages in a block, see [`SpreadBlock::begin`].
pub(crate) fn begin_spreading<const N: usize>(
    ctx: &FluidStep<'_, N>,
    slot: usize,
    of: &dyn Spreading,
    scratch: &mut BlockScratch<N>,
) -> (SpreadBlock, f64) {
    let block = BlockStep::assemble(ctx, slot, scratch);
    block.predict(scratch);
    block.begin_spreading(of, scratch)
}

/// Advances one block by one step from `ctx.old` into `new`; `fluxes` is its part of the flux register.
pub(crate) fn step_block<const N: usize>(
    ctx: &FluidStep<'_, N>,
    slot: usize,
    new: &mut [f64],
    fluxes: &mut [f64],
    scratch: &mut BlockScratch<N>,
    timer: &mut StageTimer,
) -> BlockReport<N> {
    let mut done = |stage: Stage| timer.end(stage as usize);
    let mut report = BlockReport::default();
    let mut block = BlockStep::assemble(ctx, slot, scratch);
    done(Stage::Assemble);
    block.predict(scratch);
    block.predict_terms(scratch);
    done(Stage::Predict);
    block.impose_boundaries(scratch);
    done(Stage::Boundary);
    block.collect_mixed_cells(scratch);
    done(Stage::MixedCells);
    block.solve_faces(scratch);
    done(Stage::Faces);
    block.add_terms(scratch);
    done(Stage::Terms);
    block.register_fluxes(scratch, fluxes);
    done(Stage::Register);
    block.update(scratch, new, &mut report);
    done(Stage::Update);
    block.report(scratch, new, &mut report);
    done(Stage::Report);
    report
}
