//! The values of a snapshot.

use std::fmt::Debug;
use std::ops::Range;

/// What a file asks of the values of a snapshot, piece by piece: written out they take more memory than the state of the cells that they
/// are made from.
pub trait CellValues: Debug + Send {
    /// How many fields there are.
    fn fields(&self) -> usize;
    /// How many numbers a field has: those of one cell after the other.
    fn len(&self, field: usize) -> usize;
    /// Adds some of its numbers to a list.
    fn add(&self, field: usize, numbers: Range<usize>, list: &mut Vec<f64>);
}

/// Fields of which all numbers are there.
impl<T: AsRef<[f64]> + Debug + Send> CellValues for Vec<T> {
    fn fields(&self) -> usize {
        Vec::len(self)
    }

    fn len(&self, field: usize) -> usize {
        self[field].as_ref().len()
    }

    fn add(&self, field: usize, numbers: Range<usize>, list: &mut Vec<f64>) {
        list.extend_from_slice(&self[field].as_ref()[numbers]);
    }
}
