//! Laplace's jump within the cells that an interface cuts at t = 0.

use mesh::{Field, Mesh};

use super::block::BlockCurvature;
use super::jumps::share_of_jump;
use super::patch::WidePatch;
use crate::state::conserved::{ENERGY, GAS, PHI, RHO};
use crate::{Boundary, Mixture, TRACE_GAS};

/// Gives mixed cells, filled at the gas's pressure p_g, the pressure p_g − (1 − ψ)σκ that their liquid asks for, see [`share_of_jump`]:
/// with the gas's all through, the liquid beside a bubble at rest would be thrown off.
///
/// - `tension`: σ, N/m, and whether the gas has a mass of its own.
pub(crate) fn level_mixed_cells<const N: usize>(
    mesh: &Mesh<N>,
    mixture: &Mixture,
    kinds: [Boundary; 4],
    (tension, has_phases): (f64, bool),
    field: &mut Field,
) {
    let filled = field.clone();
    let mut patch = WidePatch::default();
    let mut padded = mesh::Padded::<N>::zeros(1);
    for (slot, id) in mesh.tree().leaves().iter().enumerate() {
        let phi = filled.component(slot, PHI);
        let is_cut = |phi: f64| phi > TRACE_GAS && phi < 1.0;
        if !phi.iter().any(|phi| is_cut(*phi)) {
            continue;
        }
        for j in 0..N {
            let to = mesh::Padded::<N>::index(0, j as isize);
            padded.component_mut(0)[to..][..N].copy_from_slice(&phi[j * N..][..N]);
        }
        patch.fill(mesh, &filled, slot, kinds, padded.component(0));
        let curvature = BlockCurvature { mesh, id: *id, patch: &patch, has_images: has_phases };
        let block = field.block_mut(slot);
        for cell in (0..N * N).filter(|cell| is_cut(phi[*cell])) {
            let kappa = curvature.at([(cell % N) as isize, (cell / N) as isize]);
            let own = phi[cell];
            let rho = block[RHO * N * N + cell];
            let gas = if has_phases { block[GAS * N * N + cell] } else { 0.0 };
            let lack = (1.0 - share_of_jump(own, rho, gas, mixture)) * tension * kappa;
            block[ENERGY * N * N + cell] -= mixture.free_betas::<true>(own, rho, gas)[0] * lack;
        }
    }
}
