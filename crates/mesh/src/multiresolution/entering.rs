//! Levels for what is about to enter through a side.
//!
//! Details of a state say where waves are, not where they will come in. What a side prescribes over time is, along the way that
//! waves go meanwhile, the profile that its blocks are about to have. Its details count as those of their cells.

use std::fmt::Debug;

use rayon::prelude::*;

use crate::multiresolution::marks::{corners, threshold_on};
use crate::{Mesh, Side};

/// How far ahead is looked for a level, in blocks of the next coarser one that a wave crosses: adaptations come before one has crossed a
/// block, and must find time to rise from there to the finest level.
const AHEAD: usize = 2;
/// Pairs of cells before the present: a jump at this moment is none of the future alone.
const BEHIND: usize = 2;
/// Places along a block at which the profile in time is looked at, and stretches of time in which that along the side is.
const PLACES: usize = 3;
const STRETCHES: usize = 8;

/// What a side prescribes.
pub trait Entering: Debug + Send + Sync {
    /// Its mean from one time to another, s, at a place along the side, m, less what the state at t = 0 has. 0 before that time.
    fn mean(&self, from: f64, to: f64, along: f64) -> f64;

    /// Whether it changes between two times.
    fn changes(&self, from: f64, to: f64) -> bool;

    /// Whether it is not the same all along the side.
    fn varies_along(&self) -> bool {
        true
    }
}

/// Something that enters, as adaptation looks at it.
#[derive(Clone, Copy, Debug)]
pub struct Entry<'a> {
    /// What.
    pub entering: &'a dyn Entering,
    /// Through which side.
    pub side: Side,
    /// The speed of the waves that it makes, m/s.
    pub speed: f64,
    /// The reference value of details, in the unit of what enters.
    pub scale: f64,
    /// The present, s.
    pub time: f64,
    /// Threshold on level `base`, see [`crate::Adaptation::epsilon`].
    pub epsilon: f64,
    /// The finest level that details may ask for.
    pub base: u8,
}

impl Entry<'_> {
    /// The level that each block of a mesh should have for what is about to enter there, 0 where nothing does; at most one above its own.
    pub fn demanded_levels<const N: usize>(&self, mesh: &Mesh<N>) -> Vec<u8> {
        let mut demanded = vec![0; mesh.blocks()];
        let slots = mesh.blocks_along(self.side);
        let levels: Vec<u8> = slots.par_iter().map(|slot| self.demanded_of(mesh, *slot)).collect();
        slots.into_iter().zip(levels).for_each(|(slot, level)| demanded[slot] = level);
        demanded
    }

    fn demanded_of<const N: usize>(&self, mesh: &Mesh<N>, slot: usize) -> u8 {
        let id = mesh.tree().leaves()[slot];
        let across = self.side.axis_across();
        let block = corners(mesh, id).map(|corner| corner[1 - across]);
        let domain = mesh.domain();
        let whole = if across == 0 { domain.r } else { domain.z };
        let finest = (id.level + 1).min(self.base);
        // One coarser than that asks for no more than the block has already.
        (id.level.min(finest).max(1)..=finest)
            .rev()
            .find(|level| self.has_details::<N>(*level, mesh.widths(*level), block, whole))
            .unwrap_or(0)
    }

    /// Whether the details that cells of a level would have count in a block, in the time that a wave takes over [`AHEAD`] blocks of the level
    /// below: from then on a block is wanted on the level, and, once there, stays on it.
    ///
    /// - `widths`: of the cells there, m; `block`, `whole`: the parts of the side that are the block's, and the domain's, m.
    fn has_details<const N: usize>(
        &self,
        level: u8,
        widths: [f64; 2],
        block: [f64; 2],
        whole: [f64; 2],
    ) -> bool {
        let least = self.scale * threshold_on(level, self.base, self.epsilon);
        let across = self.side.axis_across();
        let span = widths[across] / self.speed;
        let pairs = AHEAD * N;
        let begin = self.time - 2.0 * BEHIND as f64 * span;
        let end = self.time + 2.0 * pairs as f64 * span;
        if !self.entering.changes(begin, end) {
            return false;
        }
        let varies = self.entering.varies_along();
        let [low, high] = block;
        let places = if varies { PLACES } else { 1 };
        let in_time = (0..places).any(|place| {
            let along = low + (high - low) * (place as f64 + 0.5) / places as f64;
            let cell = |number: usize| {
                let from = begin + number as f64 * span;
                self.entering.mean(from, from + span, along)
            };
            largest_detail(&(0..2 * (BEHIND + pairs)).map(cell).collect::<Vec<_>>()) > least
        });
        let stretch = (end - begin) / STRETCHES as f64;
        let width = widths[1 - across];
        // And a pair of cells on both sides; beyond the domain they mirror it.
        let cells = ((high - low) / width).round() as usize + 4;
        in_time
            || varies
                && (0..STRETCHES).any(|number| {
                    let from = begin + number as f64 * stretch;
                    let cell = |number: usize| {
                        let along = low + (number as f64 - 1.5) * width;
                        let along = if along < whole[0] { 2.0 * whole[0] - along } else { along };
                        let along = if along > whole[1] { 2.0 * whole[1] - along } else { along };
                        self.entering.mean(from, from + stretch, along)
                    };
                    largest_detail(&(0..cells).map(cell).collect::<Vec<_>>()) > least
                })
    }
}

/// The mean from one time to another of what is 0 before t = 0; `mean`: of the part of that time since then.
pub fn mean_since_start(from: f64, to: f64, mean: impl FnOnce(f64, f64) -> f64) -> f64 {
    let begin = from.max(0.0);
    if to <= begin { 0.0 } else { mean(begin, to) * ((to - begin) / (to - from)) }
}

/// The largest detail of a line of an even number of cells: of each pair but the first and the last, what it is off the parabola through the
/// means of three pairs, as `deviations` has it.
pub fn largest_detail(line: &[f64]) -> f64 {
    let mean = |pair: usize| 0.5 * (line[2 * pair] + line[2 * pair + 1]);
    let of_pair =
        |pair: usize| (line[2 * pair] - mean(pair) + 0.125 * (mean(pair + 1) - mean(pair - 1))).abs();
    (1..(line.len() / 2).saturating_sub(1)).map(of_pair).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Domain, Geometry};

    /// A exp(−x²/b²) (1 + tanh((t − t₀)/τ))/2, over its mean in a stretch.
    #[derive(Debug)]
    struct Rise {
        at: f64,
        over: f64,
        radius: f64,
    }

    impl Entering for Rise {
        fn mean(&self, from: f64, to: f64, along: f64) -> f64 {
            let integral = |t: f64| 0.5 * (t + self.over * ((t - self.at) / self.over).cosh().ln());
            let profile = (-(along / self.radius).powi(2)).exp();
            profile * (integral(to) - integral(from)) / (to - from)
        }

        fn changes(&self, _: f64, _: f64) -> bool {
            true
        }
    }

    fn entry(entering: &Rise, time: f64) -> Entry<'_> {
        Entry { entering, side: Side::ZMax, speed: 1.0, scale: 1.0, time, epsilon: 1e-3, base: 3 }
    }

    fn mesh(level: u8) -> Mesh<8> {
        let domain = Domain { geometry: Geometry::Planar, z: [-1.0, 0.0], r: [0.0, 1.0] };
        Mesh::on_level(domain, [16, 16], level, 3, [false; 2]).expect("a mesh")
    }

    #[test]
    fn details_of_a_parabola_are_none_and_of_a_jump_three_eighths_of_it() {
        let mean_of_square = |i: usize| (i * i + i) as f64 + 1.0 / 3.0;
        let of = |cell: &dyn Fn(usize) -> f64| largest_detail(&(0..16).map(cell).collect::<Vec<_>>());
        assert!(of(&mean_of_square) < 1e-12);
        let jump = |i: usize| if i < 7 { 0.0 } else { 1.0 };
        // Within a pair, its own means are 0, ½, 1: predicted ½ ∓ ⅛.
        assert!((of(&jump) - 0.375).abs() < 1e-15);
    }

    #[test]
    fn blocks_that_something_enters_rise_a_level_before_it_does() {
        let (mesh, rise) = (mesh(0), Rise { at: 1.0, over: 0.001, radius: 0.1 });
        let [slots, far] = [Side::ZMax, Side::ZMin].map(|side| mesh.blocks_along(side));
        let demanded = entry(&rise, 0.5).demanded_levels(&mesh);
        assert_eq!([demanded[slots[0]], demanded[far[0]]], [1, 0], "{demanded:?}");
        assert_eq!(demanded[slots[1]], 0, "there it never amounts to anything");
        // Too early, and long after.
        for time in [-0.5, 3.0] {
            assert_eq!(entry(&rise, time).demanded_levels(&mesh)[slots[0]], 0, "{time}");
        }
    }

    #[test]
    fn a_slow_rise_needs_no_finest_cells_and_a_jump_does() {
        let top = |over: f64, level: u8| {
            let (mesh, rise) = (mesh(level), Rise { at: 0.1, over, radius: 1e3 });
            entry(&rise, 0.0).demanded_levels(&mesh)[mesh.blocks_along(Side::ZMax)[0]]
        };
        assert_eq!((0..=3).map(|level| top(0.001, level)).collect::<Vec<_>>(), [1, 2, 3, 3]);
        // As third-order details fall, by eight a level for a threshold that doubles.
        assert_eq!((0..=3).map(|level| top(0.1, level)).collect::<Vec<_>>(), [1, 2, 2, 0]);
        assert_eq!((0..=3).map(|level| top(0.4, level)).collect::<Vec<_>>(), [0; 4]);
    }

    /// 1 − x², and so slow that time does not matter.
    #[derive(Debug)]
    struct Dish;

    impl Entering for Dish {
        fn mean(&self, from: f64, to: f64, along: f64) -> f64 {
            (1.0 - along * along) * (1.0 + 1e-9 * (from + to))
        }

        fn changes(&self, _: f64, _: f64) -> bool {
            true
        }
    }

    #[test]
    fn a_parabola_about_the_axis_has_no_details_there() {
        let (mesh, epsilon) = (mesh(0), 1e-5);
        let entry = Entry {
            entering: &Dish,
            epsilon,
            time: 1.0,
            ..entry(&Rise { at: 0.0, over: 1.0, radius: 1.0 }, 0.0)
        };
        assert_eq!(entry.demanded_levels(&mesh)[mesh.blocks_along(Side::ZMax)[0]], 0);
    }

    #[test]
    fn the_profile_along_the_side_counts_where_nothing_changes_fast() {
        let narrow = Rise { at: 0.0, over: 1e3, radius: 0.05 };
        let mesh = mesh(1);
        let demanded = entry(&narrow, 0.0).demanded_levels(&mesh);
        let slots = mesh.blocks_along(Side::ZMax);
        assert_eq!(demanded[slots[0]], 2);
        assert_eq!(demanded[slots[3]], 0);
    }
}
