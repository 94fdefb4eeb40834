//! The mesh that an initial state asks for.

use crate::{Adaptation, Domain, Field, Mesh, MeshError, Multiresolution, Patch, ScratchPool};

/// Cells of the grid from which the initial mesh is found, refined and coarsened from there.
const FIRST_CELLS: usize = 1 << 18;

/// Cells that a wave crosses in a step, as the initial mesh assumes.
const COURANT: f64 = 0.5;

impl<const N: usize> Mesh<N> {
    /// The mesh that an initial state asks for, and the state on it: found by adapting and filling anew until the mesh
    /// stays what it is. Without adaptation the uniform mesh on the finest level.
    ///
    /// - `domain` to `periodic`: as for [`Mesh::on_level`]; `fill`: the state on a mesh.
    /// - `demanded`: the level that something besides the details demands of each block of a mesh with this state, 0 (or none at all) if
    ///   nothing does.
    /// - errors: as [`Mesh::uniform`].
    #[expect(clippy::too_many_arguments, reason = "called once by each solver, no kernel")]
    pub fn initial<R: Multiresolution>(
        domain: Domain,
        coarsest: [usize; 2],
        levels: u8,
        periodic: [bool; 2],
        adaptation: Option<&Adaptation>,
        rule: &R,
        fill: impl Fn(&Self) -> Field,
        demanded: impl Fn(&Self, &Field) -> Vec<u8>,
    ) -> Result<(Self, Field), MeshError> {
        let Some(adaptation) = adaptation else {
            let mesh = Self::uniform(domain, coarsest, levels, periodic)?;
            let state = fill(&mesh);
            return Ok((mesh, state));
        };
        let cells = |level: u8| (coarsest[0] << level) * (coarsest[1] << level);
        let base = adaptation.base(levels);
        let level = (0..=base).rev().find(|level| cells(*level) <= FIRST_CELLS).unwrap_or(0);
        let mut mesh = Self::on_level(domain, coarsest, level, levels, periodic)?;
        let mut state = fill(&mesh);
        let scratch = ScratchPool::new(|| Patch::zeros(state.components()));
        // A level a round, down and up again.
        for _ in 0..2 * levels + 2 {
            let travel = |slot: usize| {
                let coarser = base.saturating_sub(mesh.tree().leaves()[slot].level);
                1.0 + COURANT * f64::from(adaptation.every) / f64::from(1u32 << coarser)
            };
            let demanded = demanded(&mesh, &state);
            let least = |slot: usize| demanded.get(slot).copied().unwrap_or(0);
            let Some(adapted) = mesh.adapted(&state, rule, adaptation, &scratch, travel, least) else {
                break;
            };
            mesh = adapted.mesh;
            state = fill(&mesh);
        }
        Ok((mesh, state))
    }
}
