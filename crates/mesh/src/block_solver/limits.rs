//! How long steps may be.

use super::{BlockSolver, Model};
use crate::kernels::parallel::least;
use crate::{MOST_HALVINGS, longest_step};

impl<M: Model<N>, const N: usize> BlockSolver<M, N> {
    /// The longest step of the block in `slot`, s.
    fn limit_of(&self, slot: usize, cfl: f64) -> f64 {
        let widths = self.mesh.widths(self.mesh.tree().leaves()[slot].level);
        let report = &self.reports.finished[slot];
        longest_step(cfl, widths, self.model.signal_speeds(report)).min(self.model.step_limit(report, widths))
    }

    /// The fastest signals in any block along z and r, m/s.
    pub fn largest_speeds(&self) -> [f64; 2] {
        self.reports.finished.iter().fold([0.0_f64; 2], |[z, r], report| {
            let speeds = self.model.signal_speeds(report);
            [z.max(speeds[0]), r.max(speeds[1])]
        })
    }

    /// The largest step that the Courant number allows all cells, s, see [`longest_step`].
    pub fn time_step_limit(&self, cfl: f64) -> f64 {
        least(self.mesh.blocks(), |slot| self.limit_of(slot, cfl))
    }

    /// The largest step of the whole that the Courant number allows if each level finer than `base` halves it once more, s.
    pub fn local_step_limit(&self, cfl: f64, base: u8) -> f64 {
        let leaves = self.mesh.tree().leaves();
        least(leaves.len(), |slot| {
            let halvings = leaves[slot].level.saturating_sub(base).min(MOST_HALVINGS);
            self.limit_of(slot, cfl) * f64::from(1_u32 << halvings)
        })
    }

    /// The longest step of the group of levels that is due, s.
    pub fn due_limit(&self, cfl: f64) -> f64 {
        let Some(group) = self.clock().due().filter(|_| cfl.is_finite()) else { return cfl };
        let is_due = |slot: usize| self.clock().group_of(&self.mesh, slot) == group;
        least(self.mesh.blocks(), |slot| if is_due(slot) { self.limit_of(slot, cfl) } else { f64::INFINITY })
    }

    /// The time in which signals cross a cell of the block in `slot`, s.
    pub(super) fn crossing_time(&self, slot: usize) -> f64 {
        let widths = self.mesh.widths(self.mesh.tree().leaves()[slot].level);
        let speeds = self.model.signal_speeds(&self.reports.finished[slot]);
        (widths[0] / speeds[0]).min(widths[1] / speeds[1])
    }
}
