//! Mass, momentum and energies of the whole solid.

use crate::SolidSolver;
use crate::state::component::COUNT;

/// Integrals over the domain, per radian in axial symmetry, per metre of depth in planar geometry.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Totals {
    /// Mass (constant), kg.
    pub mass: f64,
    /// Axial momentum, N s.
    pub momentum_z: f64,
    /// Kinetic energy, J.
    pub kinetic: f64,
    /// Elastic energy, J.
    pub elastic: f64,
}

impl<const N: usize> SolidSolver<N> {
    /// Mass, axial momentum, kinetic and elastic energy in the domain.
    ///
    /// The elastic energy per volume is tr(σ)²/(18K) + s:s/(4μ) with the deviator s and the bulk modulus K.
    pub fn totals(&self) -> Totals {
        let (density, mu) = (self.setup().speeds.density, self.model().elasticity.mu);
        let bulk = self.model().elasticity.lambda + 2.0 / 3.0 * mu;
        let leaves = self.mesh().tree().leaves();
        let of_block = |slot: usize| {
            let mut block = [0.0; 4];
            for j in 0..N {
                let volume = self.mesh().volume(leaves[slot], j);
                let [v_z, v_r, zz, zr, rr, pp]: [&[f64]; COUNT] =
                    std::array::from_fn(|c| &self.component(slot, c)[j * N..(j + 1) * N]);
                let (mut velocity, mut speed_squared, mut strain) = (0.0, 0.0, 0.0);
                for i in 0..N {
                    let mean = (zz[i] + rr[i] + pp[i]) / 3.0;
                    let (a, b, c) = (zz[i] - mean, rr[i] - mean, pp[i] - mean);
                    let deviator = a * a + b * b + c * c + 2.0 * zr[i] * zr[i];
                    velocity += v_z[i];
                    speed_squared += v_z[i] * v_z[i] + v_r[i] * v_r[i];
                    strain += mean * mean / (2.0 * bulk) + deviator / (4.0 * mu);
                }
                block[0] += volume * density * N as f64;
                block[1] += volume * density * velocity;
                block[2] += volume * 0.5 * density * speed_squared;
                block[3] += volume * strain;
            }
            block
        };
        let mut totals = Totals::default();
        for block in mesh::map_in_order(leaves.len(), mesh::SUMS_AT_ONCE, of_block) {
            totals.mass += block[0];
            totals.momentum_z += block[1];
            totals.kinetic += block[2];
            totals.elastic += block[3];
        }
        totals
    }
}
