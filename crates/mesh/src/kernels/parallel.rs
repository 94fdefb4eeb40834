//! Work on all blocks in parallel.

use std::sync::Mutex;

use rayon::prelude::*;

use crate::Field;

/// Blocks that a thread takes at once.
const BLOCKS_AT_ONCE: usize = 4;

/// Runs `work(slot, block, block of second, report)` for every block of two fields for which `is_due(slot)` holds, in
/// parallel on the current rayon pool. The result cannot depend on the number of threads: each block has its own part of
/// the fields and its own report.
pub fn for_each_block<R: Send>(
    field: &mut Field,
    second: &mut Field,
    reports: &mut [R],
    is_due: impl Fn(usize) -> bool + Sync,
    work: impl Fn(usize, &mut [f64], &mut [f64], &mut R) + Sync,
) {
    let (len, second_len) = (field.block_len(), second.block_len());
    (field.as_mut_slice().par_chunks_mut(len))
        .zip(second.as_mut_slice().par_chunks_mut(second_len))
        .zip(reports.par_iter_mut())
        .enumerate()
        .with_min_len(BLOCKS_AT_ONCE)
        .filter(|(slot, _)| is_due(*slot))
        .for_each(|(slot, ((block, second), report))| work(slot, block, second, report));
}

/// Runs `work(slot, block, report)` for the blocks of a field for which `is_due(slot)` holds, as
/// [`for_each_block`].
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
