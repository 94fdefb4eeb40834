//! Which blocks have never yielded. Their plastic strain is 0 and their temperature that of the start, before and after a step: once that
//! is written, it need not be read or written again.

use std::sync::atomic::{AtomicUsize, Ordering};

/// Buffers that a block's new state may be written to: two that take turns, and that of levels with steps of their own.
const BUFFERS: usize = 3;

/// What is known of each block.
#[derive(Debug, Default)]
pub(crate) struct Untouched {
    blocks: Vec<Block>,
}

#[derive(Debug)]
struct Block {
    has_yielded: bool,
    /// Where in memory the block is known to hold what never yielded; 0: nowhere.
    written: [AtomicUsize; BUFFERS],
}

impl Block {
    fn unknown() -> Self {
        Self { has_yielded: true, written: Default::default() }
    }
}

impl Untouched {
    /// Of so many blocks whose memory is not what it was.
    pub fn mesh_changed(&mut self, blocks: usize) {
        if self.blocks.len() != blocks {
            self.blocks = (0..blocks).map(|_| Block::unknown()).collect();
        }
        self.blocks.iter_mut().for_each(|block| block.written = Default::default());
    }

    /// How many blocks there are.
    pub fn blocks(&self) -> usize {
        self.blocks.len()
    }

    /// Takes what the blocks have told: whether each has yielded by now, or may have by the end of a step that is under way.
    pub fn take(&mut self, yielded: impl ExactSizeIterator<Item = bool>) {
        if self.blocks.len() != yielded.len() {
            self.mesh_changed(yielded.len());
        }
        for (block, has_yielded) in self.blocks.iter_mut().zip(yielded) {
            block.has_yielded = has_yielded;
            if has_yielded {
                block.written = Default::default();
            }
        }
    }

    /// Whether a block may have yielded by now.
    pub fn has_yielded(&self, slot: usize) -> bool {
        self.blocks.get(slot).is_none_or(|block| block.has_yielded)
    }

    /// Whether a block that has never yielded holds that already where its new state goes; it is taken for true from then on.
    pub fn is_written(&self, slot: usize, new: &[f64]) -> bool {
        let address = new.as_ptr().addr();
        for written in &self.blocks[slot].written {
            // Only the thread that steps the block is here.
            match written.load(Ordering::Relaxed) {
                0 => {
                    written.store(address, Ordering::Relaxed);
                    return false;
                }
                known if known == address => return true,
                _ => {}
            }
        }
        false
    }

    /// A block yields in this step.
    pub fn yields(&self, slot: usize) {
        self.blocks[slot].written.iter().for_each(|written| written.store(0, Ordering::Relaxed));
    }
}
