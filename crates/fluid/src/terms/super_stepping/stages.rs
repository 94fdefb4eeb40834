//! All blocks that something spreads in, stage by stage.

use mesh::{Mesh, Side};
use rayon::prelude::*;

use super::Spreading;
use super::block::SpreadBlock;
use super::rkl2::{stage, stages};

/// The mean fluxes that stages have found, of momentum and of heat; nothing at first.
#[derive(Debug, Default)]
pub struct Spread {
    of: [SpreadOf; 2],
}

#[derive(Debug, Default)]
struct SpreadOf {
    /// The number of a slot's block.
    numbers: Vec<Option<usize>>,
    blocks: Vec<SpreadBlock>,
}

impl Spread {
    /// Whether no block was in stages.
    pub fn is_empty(&self) -> bool {
        self.of.iter().all(|of| of.blocks.is_empty())
    }

    /// Forgets all of them.
    pub fn clear(&mut self) {
        self.of.iter_mut().for_each(|of| {
            of.blocks.clear();
            of.numbers.clear();
        });
    }

    /// The mean fluxes of a kind in a slot's block, row after row; `None` if it was not in stages.
    pub fn fluxes(&self, kind: usize, slot: usize) -> Option<&[f64]> {
        let of = &self.of[kind];
        of.numbers.get(slot).copied().flatten().map(|number| &of.blocks[number].mean[..])
    }
}

/// Lets something spread in some blocks for a step of length `dt`, in as many stages as that takes, and keeps its mean fluxes.
///
/// - `begin`: begins a block of a slot, see [`SpreadBlock::begin`]; called in parallel.
/// - returns: the number of stages; 0 without blocks.
pub(crate) fn spread_in<const N: usize>(
    spread: &mut Spread,
    of: &dyn Spreading,
    mesh: &Mesh<N>,
    slots: &[usize],
    dt: f64,
    begin: impl Fn(usize) -> (SpreadBlock, f64) + Sync,
) -> usize {
    if slots.is_empty() {
        return 0;
    }
    let begun: Vec<(SpreadBlock, f64)> = slots.par_iter().map(|slot| begin(*slot)).collect();
    let fastest = begun.iter().fold(0.0_f64, |fastest, (_, rate)| fastest.max(*rate));
    let mut blocks: Vec<SpreadBlock> = begun.into_iter().map(|(block, _)| block).collect();
    let mut numbers = vec![None; mesh.blocks()];
    for (number, block) in blocks.iter().enumerate() {
        numbers[block.slot] = Some(number);
    }
    for block in &mut blocks {
        block.find_around(mesh, |slot| numbers[slot]);
    }
    let starts: Vec<Vec<f64>> = blocks.iter_mut().map(|block| std::mem::take(&mut block.start)).collect();
    let mut last = starts.clone();
    let mut next = last.clone();
    let coarse: Vec<usize> = (0..blocks.len()).filter(|number| blocks[*number].has_finer()).collect();
    let pairs: Vec<(usize, Side, usize)> = (blocks.iter().enumerate())
        .flat_map(|(own, block)| block.beyond_high_sides().map(move |(side, other)| (own, side, other)))
        .collect();
    let count = stages(dt * fastest);
    for number in 1..=count {
        let of_stage = (stage(number, count), number == 1);
        blocks.par_iter_mut().enumerate().with_min_len(BLOCKS_AT_ONCE).for_each(|(own, block)| {
            block.conduct::<N>(of, [&starts, &last], own);
        });
        for &(own, side, other) in &pairs {
            // A block beyond both sides of a periodic domain may be the same.
            if let Ok([own, other]) = blocks.get_disjoint_mut([own, other]) {
                own.take_fluxes::<N>(of, side, other);
            }
        }
        coarse.iter().for_each(|number| SpreadBlock::match_levels::<N>(of, &mut blocks, *number));
        let places = blocks.par_iter_mut().zip(&mut next).zip(&starts);
        places.with_min_len(BLOCKS_AT_ONCE).for_each(|((block, next), start)| {
            block.stage::<N>(of, of_stage, dt, start, next);
        });
        std::mem::swap(&mut last, &mut next);
    }
    spread.of[of.shape().kind] = SpreadOf { numbers, blocks };
    count
}

/// Blocks that a thread takes at once.
const BLOCKS_AT_ONCE: usize = 4;
