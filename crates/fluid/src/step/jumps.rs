//! Where surface tension makes the pressure jump.

use super::BlockScratch;
use crate::capillarity::Interfaces;
use crate::physics::FluidStep;

/// Finds the jumps of pressure across the interfaces in a block's padded cells.
pub(super) fn find_jumps<const N: usize>(
    ctx: &FluidStep<'_, N>,
    slot: usize,
    tension: f64,
    has_gas: bool,
    scratch: &mut BlockScratch<N>,
) {
    let BlockScratch { cells, gas_shares, capillary, .. } = scratch;
    if !has_gas {
        capillary.clear();
        return;
    }
    let block = Interfaces {
        mesh: ctx.mesh,
        field: ctx.old,
        slot,
        kinds: ctx.model.analysis.boundaries,
        mixture: &ctx.model.mixture,
        tension,
        has_phases: ctx.model.analysis.has_phases,
        has_closure: ctx.model.scheme.phases.has_closure(),
    };
    capillary.find(&block, cells.split(), gas_shares);
}
