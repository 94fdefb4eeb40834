//! Adaptation of the solid's grid: the initial mesh, and the step from one mesh to the next.

use mesh::{Field, FluxRegister, Mesh, Origin, Patch, ScratchPool, Side, for_some_blocks};

use crate::analysis::Analysis;
use crate::block::BlockReport;
use crate::state::component::COUNT;
use crate::{Boundary, ElasticState, SolidError, SolidSetup, SolidSolver};

/// Cells of the grid from which the initial mesh is found, refined and coarsened from there.
const FIRST_CELLS: usize = 1 << 18;

/// Cells that a wave crosses in a step, as the initial mesh assumes.
const COURANT: f64 = 0.5;

/// The mesh that the initial state asks for, filled with it: found by adapting and filling anew until the mesh stays
/// what it is. Without adaptation the uniform one on the finest level.
pub(crate) fn initial_mesh<const N: usize>(
    setup: &SolidSetup,
    analysis: &Analysis,
    initial: &(impl Fn([f64; 2]) -> ElasticState + Sync),
) -> Result<(Mesh<N>, Field), SolidError> {
    let kinds = setup.boundaries;
    let periodic = [Side::ZMin, Side::RMin].map(|side| kinds[side as usize] == Boundary::Periodic);
    let cells = |level: u8| (setup.coarsest[0] << level) * (setup.coarsest[1] << level);
    let level = match &setup.adaptation {
        Some(_) => (0..=setup.levels).rev().find(|level| cells(*level) <= FIRST_CELLS).unwrap_or(0),
        None => setup.levels,
    };
    let mut mesh = Mesh::<N>::on_level(setup.domain, setup.coarsest, level, setup.levels, periodic)?;
    let Some(adaptation) = &setup.adaptation else {
        let state = fill(&mesh, initial);
        return Ok((mesh, state));
    };
    let scratch = ScratchPool::new(|| Patch::zeros(COUNT));
    // A level a round, down and up again.
    for _ in 0..2 * setup.levels + 2 {
        let state = fill(&mesh, initial);
        let travel = |slot: usize| {
            let coarser = mesh.tree().finest() - mesh.tree().leaves()[slot].level;
            1.0 + COURANT * f64::from(adaptation.every) / f64::from(1u32 << coarser)
        };
        match mesh.adapted(&state, analysis, adaptation, &scratch, travel, |_| 0) {
            None => return Ok((mesh, state)),
            Some(adapted) => mesh = adapted.mesh,
        }
    }
    let state = fill(&mesh, initial);
    Ok((mesh, state))
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
    /// Whether [`SolidSolver::adapt`] should follow the step about to be made, of length `dt`; to be asked once
    /// before each step.
    pub fn adaptation_follows(&mut self, dt: f64) -> bool {
        let Some(every) = self.setup.adaptation.as_ref().map(|adaptation| adaptation.every) else {
            return false;
        };
        self.horizon.is_due(every, self.time + dt, dt)
    }

    /// Adapts the grid to the present state. Returns whether the mesh changed: slots, faces of the surface and
    /// their number are then new ones.
    ///
    /// - `dt`: about the length of the steps to come, s.
    pub fn adapt(&mut self, dt: f64) -> bool {
        let Some(adaptation) = &self.setup.adaptation else { return false };
        // Waves cross a cell of a level in this time.
        let crossing = |level: u8| {
            let [h_z, h_r] = self.mesh.widths(level);
            h_z.min(h_r) / self.setup.speeds.c1
        };
        let leaves = self.mesh.tree().leaves();
        let finest = leaves.iter().map(|id| id.level).max().unwrap_or(0);
        let longest = (N as f64 - 2.0) * crossing(finest);
        let span = self.horizon.renew(adaptation.every, self.time, dt, longest);
        let travel = |slot: usize| 1.0 + span / crossing(leaves[slot].level);
        let adapted =
            self.mesh.adapted(&self.state, &self.analysis, adaptation, &self.patches, travel, |_| 0);
        let Some(adapted) = adapted else { return false };
        self.state = adapted.remap(&self.mesh, &self.state, &self.analysis, &self.patches);
        self.mesh = adapted.mesh;
        self.next = Field::zeros(self.mesh.blocks(), N * N, COUNT);
        self.register = FluxRegister::new(self.mesh.blocks());
        let old = std::mem::take(&mut self.reports);
        self.reports = (adapted.origins.iter())
            .map(|origin| match origin {
                Origin::Same(slot) => old[*slot],
                _ => BlockReport::default(),
            })
            .collect();
        for (slot, origin) in adapted.origins.iter().enumerate() {
            if !matches!(origin, Origin::Same(_)) {
                self.measure(slot);
            }
        }
        self.index_surface();
        true
    }
}
