//! Some of the cells of a block.

use serde::{Deserialize, Serialize};

use crate::Side;

/// Some of the cells of a block: bit i of number j is cell (i, j).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CellBits<const N: usize>(#[serde(with = "crate::array")] [u32; N]);

impl<const N: usize> Default for CellBits<N> {
    fn default() -> Self {
        const { assert!(N <= 32, "a row fits its bits") };
        Self([0; N])
    }
}

impl<const N: usize> CellBits<N> {
    /// Takes a cell, j N + i, into it.
    #[inline]
    pub fn insert(&mut self, cell: usize) {
        self.0[cell / N] |= 1 << (cell % N);
    }

    /// Takes all cells of another one into it; whether that had some that were not in it.
    pub fn insert_all(&mut self, other: &Self) -> bool {
        let mut is_new = false;
        for (own, other) in self.0.iter_mut().zip(other.0) {
            is_new |= other & !*own != 0;
            *own |= other;
        }
        is_new
    }

    /// Whether it has none.
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(|row| *row == 0)
    }

    /// How many it has.
    pub fn len(&self) -> usize {
        self.0.iter().map(|row| row.count_ones() as usize).sum()
    }

    /// Whether it has the cell (i, j).
    #[inline]
    pub fn has(&self, i: usize, j: usize) -> bool {
        self.0[j] >> i & 1 == 1
    }

    /// Whether it has one of the `layers` layers of cells next to a side of the block.
    pub fn has_beside(&self, side: Side, layers: usize) -> bool {
        let any_of = |rows: &[u32], columns: u32| rows.iter().any(|row| row & columns != 0);
        let columns = (1 << layers) - 1;
        match side {
            Side::ZMin => any_of(&self.0, columns),
            Side::ZMax => any_of(&self.0, columns << (N - layers)),
            Side::RMin => any_of(&self.0[..layers], u32::MAX),
            Side::RMax => any_of(&self.0[N - layers..], u32::MAX),
        }
    }

    /// Its cells, j N + i, ascending.
    pub fn cells(&self) -> impl Iterator<Item = usize> + use<N> {
        let rows = self.0;
        let in_row = move |j: usize| (0..N).filter(move |i| rows[j] >> i & 1 == 1).map(move |i| j * N + i);
        (0..N).filter(move |j| rows[*j] != 0).flat_map(in_row)
    }
}

impl<const N: usize> Extend<usize> for CellBits<N> {
    fn extend<T: IntoIterator<Item = usize>>(&mut self, cells: T) {
        cells.into_iter().for_each(|cell| self.insert(cell));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_those_taken_in_and_sides_know_their_own() {
        let mut cells = CellBits::<8>::default();
        assert!(cells.is_empty() && cells.cells().next().is_none());
        cells.extend([3 * 8 + 1, 5 * 8 + 6, 3 * 8 + 1]);
        assert_eq!(cells.cells().collect::<Vec<_>>(), [25, 46]);
        assert_eq!((cells.len(), cells.is_empty()), (2, false));
        assert!(cells.has(1, 3) && cells.has(6, 5) && !cells.has(3, 1));
        let beside = |layers: usize| Side::ALL.map(|side| cells.has_beside(side, layers));
        assert_eq!(beside(1), [false; 4]);
        assert_eq!(
            beside(2),
            [true, true, false, false],
            "along z one cell lies between, along r two and three"
        );
        assert_eq!(beside(3), [true, true, false, true]);
        assert_eq!(beside(4), [true; 4]);
    }

    #[test]
    fn what_is_taken_in_twice_is_not_new() {
        let of = |taken: &[usize]| {
            let mut cells = CellBits::<16>::default();
            cells.extend(taken.iter().copied());
            cells
        };
        let mut known = of(&[0, 255]);
        assert!(!known.insert_all(&of(&[])) && !known.insert_all(&of(&[255])));
        assert!(known.insert_all(&of(&[255, 17])));
        assert_eq!(known, of(&[0, 17, 255]));
    }
}
