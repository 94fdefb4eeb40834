//! Rows of numbers that lie well in the cache.

use std::ops::{Deref, DerefMut, Range};

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Numbers in a cache line.
const LINE: usize = 8;

/// A row of numbers in which a chosen one begins a cache line.
///
/// A kernel that starts there stores whole lines. Stores across two lines cost it twice the time where the row is not
/// in the first-level cache, as the rows of a block of 16² cells are not.
#[derive(Debug)]
pub struct AlignedRow {
    data: Vec<f64>,
    offset: usize,
    len: usize,
    first: usize,
}

impl AlignedRow {
    /// Zeros, of which number `first` begins a line.
    pub fn zeros(len: usize, first: usize) -> Self {
        let data = vec![0.0; if len == 0 { 0 } else { len + LINE - 1 }];
        // Where the allocator does not tell (an unaligned row is as good, only slower) nothing is skipped.
        let ahead = data.as_ptr().align_offset(LINE * size_of::<f64>()).min(LINE - 1);
        let offset = if len == 0 { 0 } else { (ahead + LINE - first % LINE) % LINE };
        Self { data, offset, len, first }
    }

    /// Makes it `len` numbers long. What they are then is not said: memory at hand is used again as it is.
    pub fn resize(&mut self, len: usize) {
        if len == 0 || self.offset + len > self.data.len() {
            // What it had goes first, so that both are never there together.
            self.data = Vec::new();
            // An eighth more, so that a row that grows little by little need not move each time.
            *self = Self::zeros(len + len / 8, self.first);
        }
        self.len = len;
    }
}

impl Deref for AlignedRow {
    type Target = [f64];

    #[inline(always)]
    fn deref(&self) -> &[f64] {
        &self.data[self.offset..self.offset + self.len]
    }
}

impl DerefMut for AlignedRow {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.data[self.offset..self.offset + self.len]
    }
}

impl PartialEq for AlignedRow {
    fn eq(&self, other: &Self) -> bool {
        self[..] == other[..]
    }
}

impl Clone for AlignedRow {
    fn clone(&self) -> Self {
        let mut copy = Self::zeros(self.len, self.first);
        copy.copy_from_slice(self);
        copy
    }
}

impl Serialize for AlignedRow {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (self.first, &self[..]).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for AlignedRow {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (first, numbers) = <(usize, Vec<f64>)>::deserialize(deserializer)?;
        let mut row = Self::zeros(numbers.len(), first % LINE);
        row.copy_from_slice(&numbers);
        Ok(row)
    }
}

/// The range in whole lines, as far as `limits` allow; lines begin at `limits.start`.
///
/// Kernels whose surplus results do no harm walk it instead of `range`: no store crosses a line, no number is left
/// over from the vectors.
#[inline]
pub fn whole_lines(range: Range<usize>, limits: Range<usize>) -> Range<usize> {
    debug_assert!(limits.start <= range.start && range.end <= limits.end, "{range:?} within {limits:?}");
    let start = range.start - (range.start - limits.start) % LINE;
    let end = start + (range.end - start).next_multiple_of(LINE);
    start..if end <= limits.end { end } else { range.end }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_grow_to_whole_lines_within_their_limits() {
        assert_eq!(whole_lines(22..358, 20..380), 20..364);
        assert_eq!(whole_lines(20..28, 20..28), 20..28);
        assert_eq!(whole_lines(41..79, 20..80), 36..79);
    }

    #[test]
    fn a_row_of_another_length_begins_a_line_too() {
        let mut row = AlignedRow::zeros(64, 0);
        for len in [40, 64, 70, 65, 0, 16] {
            row.resize(len);
            assert_eq!(row.len(), len);
            assert!(len == 0 || row.as_ptr().align_offset(64) == 0);
        }
    }

    #[test]
    fn the_chosen_number_begins_a_line_also_in_a_copy() {
        for len in [0, 1, 8, 400] {
            for first in [0, 1, 4, 20] {
                let mut row = AlignedRow::zeros(len, first);
                assert_eq!(row.len(), len);
                row.fill(3.0);
                for row in [&row, &row.clone()] {
                    assert!(row.iter().all(|value| *value == 3.0));
                    assert!(len <= first || row[first..].as_ptr().align_offset(64) == 0);
                }
            }
        }
    }
}
