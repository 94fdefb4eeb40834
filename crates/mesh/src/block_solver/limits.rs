//! How long steps may be.
//!
//! It is asked several times in a step, and what it depends on changes once: it is kept, level by level.

use super::{BlockSolver, Model};
use crate::{MOST_HALVINGS, Mesh};

/// What holds the steps of a level's blocks.
#[derive(Clone, Copy, Debug)]
pub(super) struct LevelLimit {
    /// The fastest signals along z and r, m/s.
    speeds: [f64; 2],
    /// The most cells that signals of one block cross per second, both directions together.
    crossings: f64,
    /// The longest step that what is not waves allows, s.
    besides: f64,
}

impl LevelLimit {
    /// Of no block.
    const NONE: Self = Self { speeds: [0.0; 2], crossings: 0.0, besides: f64::INFINITY };

    fn and(self, other: Self) -> Self {
        let [z, r] = [0, 1].map(|axis: usize| self.speeds[axis].max(other.speeds[axis]));
        Self {
            speeds: [z, r],
            crossings: self.crossings.max(other.crossings),
            besides: self.besides.min(other.besides),
        }
    }

    /// The least of [`crate::longest_step`] over the blocks: each of its terms falls with what this holds the most of, also when rounded.
    fn longest_step(&self, cfl: f64, [h_z, h_r]: [f64; 2]) -> f64 {
        let [s_z, s_r] = self.speeds;
        (cfl * h_z / s_z).min(cfl * h_r / s_r).min(1.0 / self.crossings).min(self.besides)
    }
}

/// Of all levels, the coarsest first.
pub(super) type Limits = Vec<LevelLimit>;

/// What the reports of some blocks say of how long steps may be.
///
/// - `first`: the slot of the first of them.
pub(super) fn limits_of<M: Model<N>, const N: usize>(
    model: &M,
    mesh: &Mesh<N>,
    first: usize,
    reports: &[M::Report],
) -> Limits {
    let mut limits = no_limits(mesh);
    for (id, report) in mesh.tree().leaves()[first..].iter().zip(reports) {
        let ([s_z, s_r], [h_z, h_r]) = (model.signal_speeds(report), mesh.widths(id.level));
        let of_block = LevelLimit {
            speeds: [s_z, s_r],
            crossings: s_z / h_z + s_r / h_r,
            besides: model.step_limit(report, [h_z, h_r]),
        };
        let limit = &mut limits[usize::from(id.level)];
        *limit = limit.and(of_block);
    }
    limits
}

/// The limits of all blocks, from those of some.
pub(super) fn together<const N: usize>(mesh: &Mesh<N>, parts: impl IntoIterator<Item = Limits>) -> Limits {
    parts.into_iter().fold(no_limits(mesh), |all, part| {
        all.into_iter().zip(part).map(|(limit, other)| limit.and(other)).collect()
    })
}

fn no_limits<const N: usize>(mesh: &Mesh<N>) -> Limits {
    vec![LevelLimit::NONE; usize::from(mesh.tree().finest()) + 1]
}

impl<M: Model<N>, const N: usize> BlockSolver<M, N> {
    /// The longest step of a level's blocks, s; infinite where it has none.
    fn limit_of(&self, level: u8, cfl: f64) -> f64 {
        self.limits[usize::from(level)].longest_step(cfl, self.mesh.widths(level))
    }

    fn levels(&self) -> impl Iterator<Item = u8> {
        0..=self.mesh.tree().finest()
    }

    /// The fastest signals in any block along z and r, m/s.
    pub fn largest_speeds(&self) -> [f64; 2] {
        self.limits.iter().fold(LevelLimit::NONE, |all, limit| all.and(*limit)).speeds
    }

    /// The largest step that the Courant number allows all cells, s, see [`crate::longest_step`].
    pub fn time_step_limit(&self, cfl: f64) -> f64 {
        self.levels().fold(f64::INFINITY, |limit, level| limit.min(self.limit_of(level, cfl)))
    }

    /// The largest step of the whole that the Courant number allows if each level finer than `base` halves it once more, s.
    pub fn local_step_limit(&self, cfl: f64, base: u8) -> f64 {
        self.levels().fold(f64::INFINITY, |limit, level| {
            let halvings = level.saturating_sub(base).min(MOST_HALVINGS);
            limit.min(self.limit_of(level, cfl) * f64::from(1_u32 << halvings))
        })
    }

    /// The longest step of the group of levels that is due, s.
    pub fn due_limit(&self, cfl: f64) -> f64 {
        let Some(group) = self.clock().due().filter(|_| cfl.is_finite()) else { return cfl };
        let of_group = self.levels().filter(|level| self.clock().group(*level) == group);
        of_group.fold(f64::INFINITY, |limit, level| limit.min(self.limit_of(level, cfl)))
    }

    /// The time in which signals cross a cell of the block in `slot`, s.
    pub(super) fn crossing_time(&self, slot: usize) -> f64 {
        let widths = self.mesh.widths(self.mesh.tree().leaves()[slot].level);
        let speeds = self.model.signal_speeds(&self.reports.finished[slot]);
        (widths[0] / speeds[0]).min(widths[1] / speeds[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::longest_step;

    /// What is kept of a level allows what the strictest of its blocks does, to the last bit.
    #[test]
    fn a_level_steps_as_its_strictest_block() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        for widths in [[1e-4, 1e-4], [2e-4, 3e-3], [0.7, 0.1]] {
            for cfl in [0.45, 0.8] {
                let blocks: Vec<[f64; 2]> = (0..50).map(|_| [1000.0 * random(), 1500.0 * random()]).collect();
                let all = blocks.iter().fold(LevelLimit::NONE, |all, speeds| {
                    let crossings = speeds[0] / widths[0] + speeds[1] / widths[1];
                    all.and(LevelLimit { speeds: *speeds, crossings, besides: f64::INFINITY })
                });
                let strictest = blocks
                    .iter()
                    .map(|speeds| longest_step(cfl, widths, *speeds))
                    .fold(f64::INFINITY, f64::min);
                assert_eq!(all.longest_step(cfl, widths), strictest);
            }
        }
        assert_eq!(LevelLimit::NONE.longest_step(0.45, [1.0; 2]), f64::INFINITY);
    }
}
