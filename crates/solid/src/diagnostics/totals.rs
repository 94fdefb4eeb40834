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

/// Cells of a row that are added up side by side (SIMD batches): blocks have eight or a multiple.
const LANES: usize = 8;

/// Of a row of cells, the sums of v_z, of |v|², and of the elastic energy per volume, J/m³; `per_square` is 1/2K and 1/4μ, 1/Pa.
fn sums_of_row(row: [&[f64]; COUNT], [per_mean, per_deviator]: [f64; 2]) -> [f64; 3] {
    let [v_z, v_r, zz, zr, rr, pp] = row.map(|row| row.as_chunks::<LANES>().0);
    let [mut velocity, mut speed_squared, mut strain] = [[0.0; LANES]; 3];
    for k in 0..v_z.len() {
        for i in 0..LANES {
            let mean = (zz[k][i] + rr[k][i] + pp[k][i]) / 3.0;
            let (a, b, c) = (zz[k][i] - mean, rr[k][i] - mean, pp[k][i] - mean);
            let deviator = a * a + b * b + c * c + 2.0 * zr[k][i] * zr[k][i];
            velocity[i] += v_z[k][i];
            speed_squared[i] += v_z[k][i] * v_z[k][i] + v_r[k][i] * v_r[k][i];
            strain[i] += per_mean * (mean * mean) + per_deviator * deviator;
        }
    }
    [velocity, speed_squared, strain].map(|lanes| mesh::sum(&lanes))
}

impl<const N: usize> SolidSolver<N> {
    /// Mass, axial momentum, kinetic and elastic energy in the domain.
    ///
    /// The elastic energy per volume is tr(σ)²/(18K) + s:s/(4μ) with the deviator s and the bulk modulus K.
    pub fn totals(&self) -> Totals {
        let (density, mu) = (self.setup().speeds.density, self.model().elasticity.mu);
        let bulk = self.model().elasticity.lambda + 2.0 / 3.0 * mu;
        let leaves = self.mesh().tree().leaves();
        let per_square = [1.0 / (2.0 * bulk), 1.0 / (4.0 * mu)];
        let of_block = |slot: usize| {
            let mut block = [0.0; 4];
            for j in 0..N {
                let volume = self.mesh().volume(leaves[slot], j);
                let row = std::array::from_fn(|c| &self.component(slot, c)[j * N..(j + 1) * N]);
                let [velocity, speed_squared, strain] = sums_of_row(row, per_square);
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
