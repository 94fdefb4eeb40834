//! One MUSCL-Hancock step of one tile, a block or four: the algorithm, stage by stage, or in one sweep.

pub(crate) mod plastic;
pub(crate) mod reflux;
pub(crate) mod report;
pub(crate) mod rows;
pub(crate) mod update;

mod flow_of_strips;
mod mises;
mod rim;
mod scratch;
mod stages;
mod sweep;
mod tile;
#[cfg(test)]
mod tile_tests;

use mesh::{BlockId, BlockWork};

pub use scratch::BlockScratch;
pub(crate) use stages::reconstruct;
pub(crate) use tile::{can_be_swept, step_tile};

use crate::physics::SolidStep;
use crate::step::report::BlockReport;

/// The stages of a step, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    Assemble,
    Predict,
    Boundary,
    Faces,
    Register,
    Update,
    Terms,
    Plastic,
    Report,
    Sweep,
}

/// Their names.
pub(crate) const STAGES: &[&str] = &[
    "assemble", "predict", "boundary", "faces", "register", "update", "terms", "plastic", "report", "sweep",
];

/// A block in a step.
struct BlockStep<'a, const N: usize> {
    ctx: &'a SolidStep<'a, N>,
    slot: usize,
    id: BlockId,
    /// 1/h_z, 1/h_r.
    inverse_h: [f64; 2],
    /// Whether neither it nor a neighbour has yielded so far; what an elastic solid does not have is then not looked at.
    is_untouched: bool,
}

/// Advances one block by one step from `ctx.old`; what it registers are star states.
pub(crate) fn step_block<const N: usize>(
    ctx: &SolidStep<'_, N>,
    slot: usize,
    BlockWork { new, register, scratch, timer }: BlockWork<'_, BlockScratch<N>>,
) -> BlockReport {
    let mut done = |stage: Stage| timer.end(stage as usize);
    let mut report = BlockReport::default();
    let block = BlockStep::assemble(ctx, slot, scratch);
    done(Stage::Assemble);
    block.predict(scratch);
    block.flow_to_mid_step(scratch);
    done(Stage::Predict);
    block.look_ahead(new, 0);
    block.impose_boundaries(scratch);
    done(Stage::Boundary);
    block.solve_faces(scratch, new);
    done(Stage::Faces);
    block.look_ahead(new, 2);
    block.register_stars(scratch, register);
    done(Stage::Register);
    block.update(scratch, new, &mut report);
    done(Stage::Update);
    block.add_sources(new);
    done(Stage::Terms);
    block.flow(scratch, new, &mut report);
    done(Stage::Plastic);
    block.report(scratch, new, &mut report);
    done(Stage::Report);
    report
}
