//! Whether a grid that grows still has room in memory.

use crate::case::{Memory, available_memory};
use crate::run::RunError;

/// Looks again when a grid has grown by this.
const GROWTH: f64 = 1.1;

/// Looks at what the machine has each time a grid has grown: a run ends with an error rather than by the kernel's hand.
#[derive(Clone, Copy, Debug)]
pub struct MemoryWatch {
    /// What the next snapshot takes, bytes a cell.
    per_cell: f64,
    /// Cells at the last look.
    looked: usize,
}

impl MemoryWatch {
    /// For a side that takes so much.
    pub fn of(memory: Option<Memory>) -> Self {
        Self { per_cell: memory.map_or(0.0, |memory| memory.per_cell_of_output), looked: 0 }
    }

    /// To be called after each adaptation.
    ///
    /// - errors: [`RunError::Memory`]: what the next snapshot takes is not there.
    pub fn look(&mut self, cells: usize, time: f64, side: &'static str) -> Result<(), RunError> {
        if cells as f64 <= GROWTH * self.looked as f64 {
            return Ok(());
        }
        self.looked = cells;
        self.weigh(cells, time, side, available_memory())
    }

    fn weigh(
        &self,
        cells: usize,
        time: f64,
        side: &'static str,
        available: Option<f64>,
    ) -> Result<(), RunError> {
        let needed = self.per_cell * cells as f64;
        match available.filter(|available| needed > *available) {
            None => Ok(()),
            Some(available) => Err(RunError::Memory {
                side,
                cells,
                time,
                needed: needed as u64,
                available: available as u64,
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_there_ends_the_run_and_names_the_keys() {
        let watch = MemoryWatch { per_cell: 300.0, looked: 0 };
        assert!(watch.weigh(1 << 20, 1e-6, "solid", Some(400e6)).is_ok());
        assert!(watch.weigh(1 << 20, 1e-6, "solid", None).is_ok());
        let error = watch
            .weigh(1 << 20, 1e-6, "solid", Some(200e6))
            .err()
            .map(|error| (error.exit_code(), error.to_string()));
        let Some((5, text)) = error else { panic!("{error:?}") };
        assert!(
            text.contains("1048576 cells") && text.contains("300 MiB") && text.contains("solid.levels"),
            "{text}"
        );
    }
}
