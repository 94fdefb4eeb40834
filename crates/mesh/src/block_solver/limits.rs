//! How long steps may be.
//!
//! It is asked several times in a step, and what it depends on changes once: it is kept, level by level.

use super::{BlockSolver, Model};
use crate::{MOST_HALVINGS, Mesh};

/// What a pass over the blocks of a group costs besides their steps, in steps of one block: threads wake up.
const PASS: f64 = 2.0;
/// And for each block of the mesh, whichever group it is in: it is asked whether it is due, and those that finer ones read are moved.
const PASS_OVER_BLOCKS: f64 = 0.01;

/// What holds the steps of a level's blocks.
#[derive(Clone, Copy, Debug)]
pub(super) struct LevelLimit {
    /// The fastest signals along z and r, m/s.
    speeds: [f64; 2],
    /// The most cells that signals of one block cross per second, both directions together.
    crossings: f64,
    /// The longest step that what is not waves allows, s.
    besides: f64,
    /// How many blocks there are.
    blocks: usize,
}

impl LevelLimit {
    /// Of no block.
    const NONE: Self = Self { speeds: [0.0; 2], crossings: 0.0, besides: f64::INFINITY, blocks: 0 };

    fn and(self, other: Self) -> Self {
        let [z, r] = [0, 1].map(|axis: usize| self.speeds[axis].max(other.speeds[axis]));
        Self {
            speeds: [z, r],
            crossings: self.crossings.max(other.crossings),
            besides: self.besides.min(other.besides),
            blocks: self.blocks + other.blocks,
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
            blocks: 1,
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
        longest_whole(self.levels().map(|level| self.limit_of(level, cfl)), base)
    }

    /// The base, no coarser than `coarsest`, with which a second of time takes the least work: how many blocks each level has and how
    /// long their steps may be decides. One step for all where nothing is saved, and where blocks prepare their steps together.
    pub fn cheapest_base(&self, cfl: f64, coarsest: u8) -> u8 {
        if self.model.prepares() {
            return u8::MAX;
        }
        let levels: Vec<(usize, f64)> = self
            .levels()
            .map(|level| (self.limits[usize::from(level)].blocks, self.limit_of(level, cfl)))
            .collect();
        cheapest(&levels, coarsest.max(self.mesh.coarsest_base()))
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

/// How many steps a level makes in one of the whole, whose length is that of `base`.
fn steps_of(level: u8, base: u8) -> f64 {
    f64::from(1_u32 << level.saturating_sub(base).min(MOST_HALVINGS))
}

/// [`BlockSolver::local_step_limit`] of the longest steps of all levels, the coarsest first, s.
fn longest_whole(steps: impl Iterator<Item = f64>, base: u8) -> f64 {
    (0..).zip(steps).fold(f64::INFINITY, |longest, (level, step)| longest.min(step * steps_of(level, base)))
}

/// [`BlockSolver::cheapest_base`] of the blocks of all levels and their longest steps, s.
fn cheapest(levels: &[(usize, f64)], coarsest: u8) -> u8 {
    let all: usize = levels.iter().map(|(blocks, _)| blocks).sum();
    let finest = levels.iter().rposition(|(blocks, _)| *blocks > 0).unwrap_or(0) as u8;
    let work = |base: u8| {
        let blocks: f64 =
            (0..).zip(levels).map(|(level, (blocks, _))| steps_of(level, base) * *blocks as f64).sum();
        let passes: f64 = (base..=finest).map(|level| steps_of(level, base)).sum();
        let longest = longest_whole(levels.iter().map(|(_, step)| *step), base);
        (blocks + passes * (PASS + PASS_OVER_BLOCKS * all as f64)) / longest
    };
    // Where two are alike, the one with fewer groups.
    let bases = (coarsest.min(finest)..=finest).rev();
    bases.min_by(|one, other| work(*one).total_cmp(&work(*other))).unwrap_or(finest)
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
                    all.and(LevelLimit { speeds: *speeds, crossings, besides: f64::INFINITY, blocks: 1 })
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

    /// A fine level that few blocks are on costs little; one that most are on nothing, and where coarse cells are as fast in their steps as
    /// fine ones nothing can be saved.
    #[test]
    fn levels_step_by_themselves_where_that_saves_work() {
        let halved = |blocks: [usize; 4]| {
            let steps = [8e-6, 4e-6, 2e-6, 1e-6];
            std::array::from_fn::<_, 4, _>(|level| (blocks[level], steps[level]))
        };
        assert_eq!(cheapest(&halved([100, 100, 100, 100]), 0), 0);
        assert_eq!(cheapest(&halved([100, 100, 100, 100]), 2), 2, "no coarser than that");
        assert_eq!(cheapest(&halved([100, 100, 100, 0]), 0), 0, "the finest level that there is");
        assert_eq!(cheapest(&halved([0, 0, 0, 100]), 0), 3);
        assert_eq!(cheapest(&halved([0, 0, 1, 1000]), 0), 3, "a pass costs more than one block");
        assert_eq!(cheapest(&halved([0, 0, 900, 100]), 0), 2);
        // Five halvings would not make it cheaper, as three are all there are.
        let long = [(1, 32e-6), (10, 16e-6), (100, 8e-6), (100, 4e-6), (100, 2e-6), (100, 1e-6)];
        assert_eq!(cheapest(&long, 0), 2);
        // The coarse level's sound is the faster: the fine ones would make shorter steps than they have to.
        assert_eq!(cheapest(&[(500, 1e-6), (500, 1e-6)], 0), 1);
        assert_eq!(cheapest(&[(500, 1.2e-6), (500, 1e-6)], 0), 1);
        assert_eq!(cheapest(&[(500, 1.8e-6), (500, 1e-6)], 0), 0);
    }
}
