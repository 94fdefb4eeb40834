//! Fetching what will be needed, while there is something to compute.

use std::ops::Range;

use crate::{Field, Mesh, Neighbour, Offset, Side, Tile};

/// Numbers in a cache line.
const LINE: usize = 8;

/// Numbers in a field, 16 MiB of them, below which it comes from the caches fast enough: there fetching ahead costs more
/// than it saves.
const FAR: usize = 1 << 21;

/// Numbers in a field, 1 MiB of them, below which it comes from the second-level cache.
const NEAR: usize = 1 << 17;

impl<const N: usize> Mesh<N> {
    /// Asks for a part of the memory that a step is about to need, so that it comes while the present block is computed: of
    /// what the next block will be the first to read, and of where the present one will be written. A kernel that hardly
    /// computes would else wait for both.
    ///
    /// In the order of the slots a block's own cells have been read by its lower neighbours, as ghosts. What nobody has
    /// read yet is the block beyond the upper side along z.
    ///
    /// - `beside`: numbers of all blocks that a step touches besides those of the field. `target`: where the block in `slot` will be written, as far as it will: of the next one as much is asked for. `part` of `parts`:
    ///   not all at once, since only so many lines can be under way.
    /// - returns: whether it was worth while.
    pub fn look_ahead(
        &self,
        (field, beside): (&Field, usize),
        slot: usize,
        target: &[f64],
        part: usize,
        parts: usize,
    ) -> bool {
        debug_assert!(part < parts, "part {part} of {parts}");
        debug_assert_eq!(Offset::ALL[Side::ZMax as usize], Offset { i: 1, j: 0 });
        if field.as_slice().len() + beside < FAR {
            return false;
        }
        fetch(target, part, parts);
        let next = slot + 1;
        if next < self.blocks()
            && let Neighbour::Same(other) = self.tree().neighbours(next)[Side::ZMax as usize]
            && other > next
        {
            fetch(&field.block(other)[..target.len()], part, parts);
        }
        true
    }

    /// [`Mesh::look_ahead`] for tiles of a medium that computes for longer: of the blocks that follow a tile, as many as it has,
    /// and of where the tile will be written.
    pub fn look_ahead_of(&self, field: &Field, tile: Tile, target: &[f64], part: usize, parts: usize) {
        debug_assert!(part < parts, "part {part} of {parts}");
        if field.as_slice().len() < NEAR {
            return;
        }
        fetch(target, part, parts);
        let Range { start, end } = tile.slots();
        (end..(end + end - start).min(self.blocks())).for_each(|slot| fetch(field.block(slot), part, parts));
    }
}

impl Field {
    /// Whether it is so large that asking for what comes next is worth while.
    pub fn is_far(&self) -> bool {
        self.as_slice().len() >= NEAR
    }

    /// Asks for a part of the blocks that follow a tile, as many as it has and of each the first so many components, for the second-level
    /// cache: in the first one they would take the place of what is worked on.
    pub fn look_beyond(&self, tile: Tile, components: usize, part: usize, parts: usize) {
        debug_assert!(part < parts, "part {part} of {parts}");
        let Range { start, end } = tile.slots();
        let len = self.block_len() / self.components() * components;
        let following = self.as_slice().chunks_exact(self.block_len()).skip(end).take(end - start);
        following.for_each(|block| fetch_from_afar(part_of(&block[..len], part, parts)));
    }
}

/// Asks for some lines, for the second-level cache.
#[cfg(target_arch = "x86_64")]
fn fetch_from_afar(numbers: &[f64]) {
    numbers.iter().step_by(LINE).for_each(safe_arch::prefetch_t1);
}

/// Other machines are left to look ahead for themselves.
#[cfg(not(target_arch = "x86_64"))]
fn fetch_from_afar(_: &[f64]) {}

/// Asks for the lines of some numbers, without waiting for any.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
pub fn fetch_lines(numbers: &[f64]) {
    numbers.iter().step_by(LINE).for_each(safe_arch::prefetch_t0);
}

/// Other machines are left to look ahead for themselves.
#[cfg(not(target_arch = "x86_64"))]
pub fn fetch_lines(_: &[f64]) {}

/// Asks for the lines of a part of some numbers, without waiting for any.
pub fn fetch(block: &[f64], part: usize, parts: usize) {
    fetch_lines(part_of(block, part, parts));
}

/// One of so many parts of equal length.
#[inline(always)]
fn part_of(numbers: &[f64], part: usize, parts: usize) -> &[f64] {
    let len = numbers.len() / parts;
    &numbers[part * len..(part + 1) * len]
}
