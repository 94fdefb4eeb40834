//! The displacement of the solid's surface.

use mesh::{BLOCK, BlockId, Misfit, Side, SideFaces};
use serde::{Deserialize, Serialize};
use solid::SolidSolver;

use super::sum::CompensatedSum;

/// u_z and u_r on the surface since t = 0, integrated in time.
///
/// u_z is the sum over the steps of Δt v*, the mean velocity of the star state over the step. u_r integrates the surface's own
/// radial velocity, [`SolidSolver::surface_slip`], by the trapezoidal rule: nothing crosses the interface in that direction. On a face
/// of a level that makes longer steps than the finest one both go on with each of the finest level's.
///
/// What is summed hangs on the present faces; when others take their place it is added to the faces of the finest level, a
/// coarser face's to all that it consists of. So a step costs what there are faces, and memory does not depend on the mesh.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SurfaceDisplacement {
    generation: u64,
    /// The blocks that the present faces belong to, ascending in r.
    blocks: Vec<BlockId>,
    /// Before the present faces, on those of the finest level.
    before: SideFaces<[CompensatedSum; 2]>,
    /// Since then, on the present ones.
    since: Vec<[CompensatedSum; 2]>,
    /// The surface's radial velocity at the end of the last step, on the present faces, m/s.
    slips: Vec<f64>,
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
        let mut slips = vec![0.0; faces];
        solver.surface_slip(|face, slip| slips[face] = slip);
        Self {
            generation: mesh.generation(),
            blocks: blocks_of(solver),
            before,
            since: vec![[CompensatedSum::default(); 2]; faces],
            slips,
        }
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
        if self.before.has_shape_of(&own.before)
            && is_whole
            && [self.since.len(), self.slips.len()] == [faces; 2]
        {
            return Ok(());
        }
        Err(Misfit(format!("a displacement of {faces} faces is not that of the surface")))
    }

    /// Takes notice of a step of length `dt` of the finest level.
    pub fn after_step(&mut self, solver: &SolidSolver<BLOCK>, dt: f64) {
        self.follow(solver);
        let (since, slips, states) = (&mut self.since, &mut self.slips, solver.interface().states());
        solver.surface_slip(|face, slip| {
            since[face][0].add(dt * states[face].velocity);
            since[face][1].add(0.5 * dt * (slips[face] + slip));
            slips[face] = slip;
        });
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
        // On the finest faces, from which the present ones take their means.
        let mut finest = Vec::with_capacity(self.before.len());
        for (face, (level, along)) in faces_of(&self.blocks).enumerate() {
            let since = self.since[face];
            for before in self.before.of_mut(level, along) {
                (0..2).for_each(|c| before[c].add_sum(since[c]));
                finest.push(self.slips[face]);
            }
        }
        self.since.clear();
        self.slips.clear();
        let mut from = 0;
        for (level, along) in faces_of(&blocks) {
            let to = from + self.before.of(level, along).len();
            self.since.push(Default::default());
            self.slips.push(finest[from..to].iter().sum::<f64>() / (to - from) as f64);
            from = to;
        }
        self.blocks = blocks;
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
            for before in self.before.of(level, along) {
                profile.push(total(*before, self.since[face]));
            }
        }
        profile
    }

    /// Of every present face: how many finest ones it is, and u_z, m, on the first of them.
    pub fn faces(&self) -> impl Iterator<Item = (usize, f64)> {
        faces_of(&self.blocks).enumerate().map(|(face, (level, along))| {
            let before = self.before.of(level, along);
            (before.len(), total(before[0], self.since[face])[0])
        })
    }
}

fn total(before: [CompensatedSum; 2], since: [CompensatedSum; 2]) -> [f64; 2] {
    std::array::from_fn(|c| {
        let mut sum = before[c];
        sum.add_sum(since[c]);
        sum.value()
    })
}

/// Level and number along the side of all faces of these blocks.
fn faces_of(blocks: &[BlockId]) -> impl Iterator<Item = (u8, usize)> {
    blocks.iter().flat_map(|id| (0..BLOCK).map(move |k| (id.level, id.first_face::<BLOCK>(Side::ZMax) + k)))
}
