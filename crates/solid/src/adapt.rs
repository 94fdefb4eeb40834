//! Adaptation of the solid's grid: the initial mesh, and the step from one mesh to the next.

use mesh::{Field, Mesh, Side, for_some_blocks};

use crate::analysis::Analysis;
use crate::state::component::COUNT;
use crate::{Boundary, ElasticState, SolidError, SolidSetup, SolidSolver};

/// The mesh that the initial state asks for, filled with it.
pub(crate) fn initial_mesh<const N: usize>(
    setup: &SolidSetup,
    analysis: &Analysis,
    initial: &(impl Fn([f64; 2]) -> ElasticState + Sync),
) -> Result<(Mesh<N>, Field), SolidError> {
    let kinds = setup.boundaries;
    let periodic = [Side::ZMin, Side::RMin].map(|side| kinds[side as usize] == Boundary::Periodic);
    let fill = |mesh: &Mesh<N>| fill(mesh, initial);
    let adaptation = setup.adaptation.as_ref();
    let SolidSetup { domain, coarsest, levels, .. } = *setup;
    Ok(Mesh::initial(domain, coarsest, levels, periodic, adaptation, analysis, fill, |_, _| 0)?)
}

/// The initial state at the cells' centres.
fn fill<const N: usize>(mesh: &Mesh<N>, initial: &(impl Fn([f64; 2]) -> ElasticState + Sync)) -> Field {
    let mut state = Field::zeros(mesh.blocks(), N * N, COUNT);
    let mut reports = vec![(); mesh.blocks()];
    for_some_blocks(
        &mut state,
        &mut reports,
        |_| true,
        |slot, block, ()| {
            let id = mesh.tree().leaves()[slot];
            for j in 0..N {
                for i in 0..N {
                    for (c, value) in initial(mesh.centre(id, i, j)).to_array().into_iter().enumerate() {
                        block[(c * N + j) * N + i] = value;
                    }
                }
            }
        },
    );
    state
}

impl<const N: usize> SolidSolver<N> {
    /// Whether [`SolidSolver::adapt`] should follow the step about to be made, of length `dt`, which is `steps` of the finest
    /// level; to be asked once before each step.
    pub fn adaptation_follows(&mut self, dt: f64, steps: u32) -> bool {
        let Some(every) = self.setup.adaptation.as_ref().map(|adaptation| adaptation.every) else {
            return false;
        };
        self.horizon.is_due(every, steps, self.time + dt, dt)
    }

    /// Adapts the grid to the present state. Returns whether the mesh changed: slots, faces of the surface and
    /// their number are then new ones.
    ///
    /// - `dt`: about the length of the steps to come, s; `steps`: how many of the finest level they are.
    pub fn adapt(&mut self, dt: f64, steps: u32) -> bool {
        let Some(adaptation) = &self.setup.adaptation else { return false };
        // Waves cross a cell of a level in this time.
        let crossing = |level: u8| {
            let [h_z, h_r] = self.mesh.widths(level);
            h_z.min(h_r) / self.setup.speeds.c1
        };
        let leaves = self.mesh.tree().leaves();
        let finest = leaves.iter().map(|id| id.level).max().unwrap_or(0);
        let longest = (N as f64 - 2.0) * crossing(finest);
        let span = self.horizon.renew(adaptation.every, steps, self.time, dt, longest);
        let travel = |slot: usize| 1.0 + span / crossing(leaves[slot].level);
        let adapted =
            self.mesh.adapted(&self.state, &self.analysis, adaptation, &self.patches, travel, |_| 0);
        let Some(adapted) = adapted else { return false };
        adapted.remap_into(&self.mesh, &self.state, &self.analysis, &self.patches, &mut self.next);
        std::mem::swap(&mut self.state, &mut self.next);
        self.next.resize(adapted.mesh.blocks());
        self.register.resize(adapted.mesh.blocks());
        self.reports = adapted.carried(&self.reports);
        let fresh: Vec<usize> = adapted.fresh().collect();
        self.mesh = adapted.mesh;
        for slot in fresh {
            self.measure(slot);
        }
        self.pending.clone_from(&self.reports);
        self.index_surface();
        true
    }
}
