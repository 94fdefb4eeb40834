//! Work on all blocks in parallel.

use std::sync::Mutex;

use rayon::prelude::*;

use crate::{Field, Tile};

/// Blocks that a thread takes at once.
const BLOCKS_AT_ONCE: usize = 4;

/// So many are worth it to wake a thread for light work.
const FEW_BLOCKS: usize = 16;

/// So many are worth it to wake a thread that only looks at what is told of them.
pub(crate) const LOOKS_AT_ONCE: usize = 128;

/// Runs `work(tile, blocks, blocks of second, reports)` for tiles of two fields, in parallel on the current rayon pool. The result cannot
/// depend on the number of threads: each tile has its own part of the fields and its own reports.
///
/// - `tiles`: those that there is work for, in the order of their slots. Few of them are worked on by the thread that calls.
pub fn for_each_tile<R: Send>(
    tiles: &[Tile],
    field: &mut Field,
    second: &mut Field,
    reports: &mut [R],
    work: impl Fn(Tile, &mut [f64], &mut [f64], &mut [R]) + Sync,
) {
    let lens = [field.block_len(), second.block_len()];
    let parts = Parts { first: 0, lens, field: field.as_mut_slice(), second: second.as_mut_slice(), reports };
    parts.share_out(tiles, &work);
}

/// What some consecutive slots have.
struct Parts<'a, R> {
    /// The first of them.
    first: usize,
    /// Numbers of a block in both fields.
    lens: [usize; 2],
    field: &'a mut [f64],
    second: &'a mut [f64],
    reports: &'a mut [R],
}

impl<'a, R: Send> Parts<'a, R> {
    /// What the slots before one have, and what it and those after it have.
    fn split(self, slot: usize) -> [Self; 2] {
        let Self { first, lens, field, second, reports } = self;
        let blocks = slot - first;
        let (field, more_field) = field.split_at_mut(blocks * lens[0]);
        let (second, more_second) = second.split_at_mut(blocks * lens[1]);
        let (reports, more_reports) = reports.split_at_mut(blocks);
        let before = Self { first, lens, field, second, reports };
        [before, Self { first: slot, lens, field: more_field, second: more_second, reports: more_reports }]
    }

    fn share_out(self, tiles: &[Tile], work: &(impl Fn(Tile, &mut [f64], &mut [f64], &mut [R]) + Sync)) {
        let is_little = || {
            tiles.len() <= BLOCKS_AT_ONCE && tiles.iter().map(Tile::blocks).sum::<usize>() <= BLOCKS_AT_ONCE
        };
        if tiles.len() == 1 || is_little() {
            let mut rest = self;
            for tile in tiles {
                let [_, from] = rest.split(tile.first());
                let [own, after] = from.split(tile.slots().end);
                work(*tile, own.field, own.second, own.reports);
                rest = after;
            }
            return;
        }
        let (low, high) = tiles.split_at(tiles.len() / 2);
        let [before, from] = self.split(high[0].first());
        rayon::join(|| before.share_out(low, work), || from.share_out(high, work));
    }
}

/// Runs `work(slot, block, report)` for the blocks of a field for which `is_due(slot)` holds, in parallel on the current rayon
/// pool. The result cannot depend on the number of threads: each block has its own part of the field and its own report.
pub fn for_some_blocks<R: Send>(
    field: &mut Field,
    reports: &mut [R],
    is_due: impl Fn(usize) -> bool + Sync,
    work: impl Fn(usize, &mut [f64], &mut R) + Sync,
) {
    let len = field.block_len();
    (field.as_mut_slice().par_chunks_mut(len))
        .zip(reports.par_iter_mut())
        .enumerate()
        .with_min_len(BLOCKS_AT_ONCE)
        .filter(|(slot, _)| is_due(*slot))
        .for_each(|(slot, (block, report))| work(slot, block, report));
}

/// [`for_some_blocks`] of work that takes about a microsecond: a few blocks are done by the thread that calls before another one is awake.
pub(crate) fn for_some_blocks_lightly<R: Send>(
    field: &mut Field,
    reports: &mut [R],
    is_due: impl Fn(usize) -> bool + Sync,
    work: impl Fn(usize, &mut [f64], &mut R) + Sync,
) {
    let due = (0..reports.len()).filter(|slot| is_due(*slot));
    if due.take(FEW_BLOCKS).count() == FEW_BLOCKS {
        for_some_blocks(field, reports, is_due, work);
        return;
    }
    for (slot, report) in reports.iter_mut().enumerate().filter(|(slot, _)| is_due(*slot)) {
        work(slot, field.block_mut(slot), report);
    }
}

/// So many blocks are worth it to wake a thread that adds up what is in them.
pub const SUMS_AT_ONCE: usize = 32;

/// What `work` makes of the numbers below `count`, in their order, in parallel on the current rayon pool.
///
/// - `at_once`: so many are worth it to wake a thread.
pub fn map_in_order<T: Send>(
    count: usize,
    at_once: usize,
    work: impl Fn(usize) -> T + Sync + Send,
) -> Vec<T> {
    if count <= at_once || rayon::current_num_threads() == 1 {
        return (0..count).map(work).collect();
    }
    (0..count).into_par_iter().with_min_len(at_once).map(work).collect()
}

/// One scratch object per worker thread, so that a step allocates nothing.
///
/// Each block is worked on with the scratch of the thread that took it; the locks are never contended.
#[derive(Debug)]
pub struct ScratchPool<T> {
    slots: Vec<Mutex<T>>,
}

impl<T> ScratchPool<T> {
    /// As many objects as the current rayon pool has threads.
    pub fn new(make: impl Fn() -> T) -> Self {
        Self { slots: (0..rayon::current_num_threads().max(1)).map(|_| Mutex::new(make())).collect() }
    }

    /// Runs `work` with this thread's scratch.
    pub fn with<R>(&self, work: impl FnOnce(&mut T) -> R) -> R {
        let index = rayon::current_thread_index().unwrap_or(0) % self.slots.len();
        // A panic while working leaves scratch behind that the next block overwrites anyway.
        let mut scratch = self.slots[index].lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        work(&mut scratch)
    }

    /// Looks at all of them, one after the other.
    pub fn for_each(&self, mut look: impl FnMut(&T)) {
        for slot in &self.slots {
            look(&slot.lock().unwrap_or_else(std::sync::PoisonError::into_inner));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Domain, Geometry, Mesh};

    #[test]
    fn each_tile_has_its_own_blocks() {
        let domain = Domain { geometry: Geometry::Planar, z: [0.0, 1.0], r: [0.0, 1.0] };
        let mesh = Mesh::<8>::uniform(domain, [72, 40], 0, [false; 2]).expect("a mesh");
        let blocks = mesh.blocks();
        // Not all of them, so that there are gaps.
        let tiles: Vec<Tile> =
            mesh.tree().tiles().iter().filter(|tile| tile.first() % 3 != 1).copied().collect();
        let (mut field, mut second) = (Field::zeros(blocks, 3, 1), Field::zeros(blocks, 2, 1));
        let mut reports = vec![0; blocks];
        for_each_tile(&tiles, &mut field, &mut second, &mut reports, |tile, field, second, reports| {
            assert_eq!(field.len(), 3 * reports.len());
            for (number, slot) in tile.slots().enumerate() {
                field[3 * number..3 * (number + 1)].fill(slot as f64 + 1.0);
                second[2 * number..2 * (number + 1)].fill(slot as f64 + 1.0);
                reports[number] += 1;
            }
        });
        let made: Vec<usize> = tiles.iter().flat_map(Tile::slots).collect();
        assert!(made.len() > 20 && made.len() < blocks);
        for slot in 0..blocks {
            let is_made = made.contains(&slot);
            let wanted = if is_made { slot as f64 + 1.0 } else { 0.0 };
            assert!(field.block(slot).iter().chain(second.block(slot)).all(|value| *value == wanted));
            assert_eq!(reports[slot], i32::from(is_made));
        }
    }
}
