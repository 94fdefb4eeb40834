//! The displacement of the solid's surface.

use mesh::{BLOCK, BlockId, Limiter, Misfit, Side, SideFaces};
use serde::{Deserialize, Serialize};
use solid::SolidSolver;

use super::sum::CompensatedSum;

/// u_z and u_r on the surface since t = 0, integrated in time.
///
/// The sum over the steps of Δt times the mean velocity of the star state, [`SolidSolver::surface_velocity`]. On a face of a level
/// that makes longer steps than the finest one it goes on with each of the finest level's.
///
/// What is summed hangs on the present faces; when others take their place it is added to the faces of the finest level, a coarser
/// face's to all that it consists of, in a line between its neighbours. So a step costs what there are faces, and memory does not
/// depend on the mesh.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SurfaceDisplacement {
    generation: u64,
    /// The blocks that the present faces belong to, ascending in r.
    blocks: Vec<BlockId>,
    /// Before the present faces, on those of the finest level.
    before: SideFaces<[CompensatedSum; 2]>,
    /// Since then, on the present ones.
    since: Vec<[CompensatedSum; 2]>,
}

fn blocks_of(solver: &SolidSolver<BLOCK>) -> Vec<BlockId> {
    let leaves = solver.mesh().tree().leaves();
    solver.interface().blocks().iter().map(|slot| leaves[*slot]).collect()
}

impl SurfaceDisplacement {
    /// Of a surface as it is at t = 0, not displaced.
    pub fn new(solver: &SolidSolver<BLOCK>) -> Self {
        let mesh = solver.mesh();
        let none = |_, _| [CompensatedSum::default(); 2];
        let [_, before, _, _] = SideFaces::along_sides(mesh, |side| side == Side::ZMax, none);
        let faces = solver.interface().faces();
        Self {
            generation: mesh.generation(),
            blocks: blocks_of(solver),
            before,
            since: vec![[CompensatedSum::default(); 2]; faces],
        }
    }

    /// Of a surface that lies so, (u_z, u_r) face by face of a finest level that may have been another one, m.
    pub fn starting(solver: &SolidSolver<BLOCK>, earlier: &[[f64; 2]]) -> Self {
        let mut surface = Self::new(solver);
        let count = surface.len();
        let blocks = surface.blocks.clone();
        let mut next = 0;
        for (level, along) in faces_of(&blocks) {
            for sums in surface.before.of_mut(level, along) {
                let value = at_face(earlier, next, count);
                (0..2).for_each(|c| sums[c].add(value[c]));
                next += 1;
            }
        }
        surface
    }

    /// Whether it can be of this solver's surface, `solver` being as the displacement was kept with it.
    pub fn fits(&self, solver: &SolidSolver<BLOCK>) -> Result<(), Misfit> {
        let own = Self::new(solver);
        let faces = self.blocks.len() * BLOCK;
        let finest = self.before.finest();
        let mut next = 0;
        let follow_each_other = self.blocks.iter().all(|id| {
            let begins =
                id.level <= finest && id.first_face::<BLOCK>(Side::ZMax) << (finest - id.level) == next;
            next += BLOCK << finest.saturating_sub(id.level);
            begins
        });
        let is_whole = follow_each_other && next == self.before.len();
        if self.before.has_shape_of(&own.before) && is_whole && self.since.len() == faces {
            return Ok(());
        }
        Err(Misfit(format!("a displacement of {faces} faces is not that of the surface")))
    }

    /// Takes notice of a step of length `dt` of the finest level.
    pub fn after_step(&mut self, solver: &SolidSolver<BLOCK>, dt: f64) {
        self.follow(solver);
        let since = &mut self.since;
        solver.surface_velocity(|face, velocity| (0..2).for_each(|c| since[face][c].add(dt * velocity[c])));
    }

    /// Takes notice of other faces than before.
    fn follow(&mut self, solver: &SolidSolver<BLOCK>) {
        let generation = solver.mesh().generation();
        if generation == self.generation {
            return;
        }
        self.generation = generation;
        let blocks = blocks_of(solver);
        if blocks == self.blocks {
            return;
        }
        for (face, (level, along)) in faces_of(&self.blocks).enumerate() {
            let (since, slope) = (self.since[face], self.slope(face));
            let finest = self.before.of_mut(level, along);
            let count = finest.len();
            for (k, before) in finest.iter_mut().enumerate() {
                (0..2).for_each(|c| before[c] = total(before[c], since[c], slope[c] * from_middle(k, count)));
            }
        }
        self.since.clear();
        self.since.resize(BLOCK * blocks.len(), Default::default());
        self.blocks = blocks;
    }

    /// What is summed on the present faces, per face of the finest level: the smaller of the differences to both neighbours where they
    /// have one sign; nothing within faces of the finest level.
    fn slope(&self, face: usize) -> [f64; 2] {
        let width = |face: usize| {
            let finest = self.before.finest();
            f64::from(1_u32 << (finest - self.blocks[face / BLOCK].level))
        };
        if width(face) == 1.0 || face == 0 || face + 1 == self.since.len() {
            return [0.0; 2];
        }
        std::array::from_fn(|c| {
            let value = |face: usize| self.since[face][c].value();
            let between = |low: usize| (value(low + 1) - value(low)) / (0.5 * (width(low) + width(low + 1)));
            Limiter::Minmod.difference(between(face - 1), between(face))
        })
    }

    /// How many faces of the finest level there are.
    pub fn len(&self) -> usize {
        self.before.len()
    }

    /// Whether there is no surface.
    pub fn is_empty(&self) -> bool {
        self.before.is_empty()
    }

    /// (u_z, u_r) on every face of the finest level, ascending in r, m.
    pub fn profile(&self) -> Vec<[f64; 2]> {
        let mut profile = Vec::with_capacity(self.len());
        for (face, (level, along)) in faces_of(&self.blocks).enumerate() {
            let (since, slope) = (self.since[face], self.slope(face));
            let finest = self.before.of(level, along);
            for (k, before) in finest.iter().enumerate() {
                let at =
                    |c: usize| total(before[c], since[c], slope[c] * from_middle(k, finest.len())).value();
                profile.push([at(0), at(1)]);
            }
        }
        profile
    }

    /// Of every present face: how many finest ones it is, and u_z, m, on the first of them.
    pub fn faces(&self) -> impl Iterator<Item = (usize, f64)> {
        faces_of(&self.blocks).enumerate().map(|(face, (level, along))| {
            let before = self.before.of(level, along);
            (before.len(), total(before[0][0], self.since[face][0], 0.0).value())
        })
    }
}

/// Both sums and a term.
fn total(before: CompensatedSum, since: CompensatedSum, term: f64) -> CompensatedSum {
    let mut sum = before;
    sum.add_sum(since);
    if term != 0.0 {
        sum.add(term);
    }
    sum
}

/// How far the face number `k` of `count` is from the middle of all, in faces.
fn from_middle(k: usize, count: usize) -> f64 {
    k as f64 + 0.5 - 0.5 * count as f64
}

/// What `earlier` faces of equal width have on the `k`th of `count` such ones: the mean of all within it, or of the one it is within.
fn at_face(earlier: &[[f64; 2]], k: usize, count: usize) -> [f64; 2] {
    let [low, high] = [k, k + 1].map(|k| k * earlier.len() / count);
    let middle = (2 * k + 1) * earlier.len() / (2 * count);
    let within = if high > low + 1 { earlier.get(low..high) } else { earlier.get(middle..=middle) };
    let within = within.unwrap_or_default();
    [0, 1].map(|c| within.iter().map(|value| value[c]).sum::<f64>() / within.len().max(1) as f64)
}

/// Level and number along the side of all faces of these blocks.
fn faces_of(blocks: &[BlockId]) -> impl Iterator<Item = (u8, usize)> {
    blocks.iter().flat_map(|id| (0..BLOCK).map(move |k| (id.level, id.first_face::<BLOCK>(Side::ZMax) + k)))
}

#[cfg(test)]
mod tests {
    use super::at_face;

    #[test]
    fn a_surface_is_taken_up_by_means_on_wider_faces_and_as_it_is_on_narrower_ones() {
        let earlier = [[1.0, 0.0], [3.0, 4.0], [5.0, 0.0], [9.0, 2.0]];
        let on = |count: usize| (0..count).map(|k| at_face(&earlier, k, count)).collect::<Vec<_>>();
        assert_eq!(on(4), earlier);
        assert_eq!(on(2), [[2.0, 2.0], [7.0, 1.0]]);
        assert_eq!(on(1), [[4.5, 1.5]]);
        assert_eq!(on(8)[..4], [earlier[0], earlier[0], earlier[1], earlier[1]]);
        // None is there before the first hit.
        assert_eq!(at_face(&[], 3, 8), [0.0; 2]);
    }
}
