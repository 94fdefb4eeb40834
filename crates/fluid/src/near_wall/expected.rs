//! Levels along the wall for waves that are about to come out of it.

use mesh::{Mesh, Side};

use crate::FluidSolver;

/// What the other side says of its waves: how wide cells along z may be, m, and how far from r_min on, m; nothing where that is 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Expected([[f64; 2]; 4]);

impl Expected {
    /// The level that it demands of each block along the wall, `base` at the most; 0 elsewhere, and none at all where nothing is expected.
    pub fn demanded_levels<const N: usize>(&self, mesh: &Mesh<N>, base: u8) -> Vec<u8> {
        let Self(waves) = self;
        let waves = waves.iter().filter(|[_, reach]| *reach > 0.0);
        let steps: Vec<(u8, f64)> =
            waves.map(|[width, reach]| (level_of(mesh, *width, base), *reach)).collect();
        if steps.iter().all(|(level, _)| *level == 0) {
            return Vec::new();
        }
        let leaves = mesh.tree().leaves();
        let mut demanded = vec![0; leaves.len()];
        for (slot, id) in leaves.iter().enumerate().filter(|(slot, _)| mesh.touches(*slot, Side::ZMin)) {
            let begin = mesh.origin(*id)[1] - mesh.domain().r[0];
            let reaching = steps.iter().filter(|(_, reach)| begin < *reach);
            demanded[slot] = reaching.map(|(level, _)| *level).max().unwrap_or(0);
        }
        demanded
    }
}

/// The coarsest level whose cells are no wider than that along z, `base` at the most.
fn level_of<const N: usize>(mesh: &Mesh<N>, width: f64, base: u8) -> u8 {
    (0..base).find(|level| mesh.widths(*level)[0] <= width * (1.0 + 1e-9)).unwrap_or(base)
}

impl<const N: usize> FluidSolver<N> {
    /// Takes notice, before the grid adapts, of waves that are about to come out of the wall: how wide cells that carry them may be along
    /// z, m, and how far from r_min on there are any that need them so narrow, m; zeros where there are no more.
    pub fn expect_waves(&mut self, waves: [[f64; 2]; 4]) {
        self.model_mut().expected = Expected(waves);
    }

    /// Whether blocks along the wall are coarser than [expected waves](FluidSolver::expect_waves) need, and may be finer:
    /// [`mesh::BlockSolver::adapt`] makes them so, a level at a time.
    pub fn is_too_coarse_for_waves(&self) -> bool {
        let Some(base) = self.finest_by_details() else { return false };
        self.lacks_levels(&self.model().expected.demanded_levels(self.mesh(), base))
    }
}
