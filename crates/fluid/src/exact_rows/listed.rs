//! Exact Riemann solutions at listed faces, wherever they lie.

use super::{Chunk, LANES, Sides, fluxes, solve};
use crate::Mixture;
use crate::godunov::flux_exact;
use crate::hllc::Face;

/// [`flux_exact`] between `lower[k]` and `upper[k]`, for all k; states are (ρ, u normal, v tangential, p, φ).
///
/// - `faces`: written, as many as there are states. What a face gets does not depend on the others in the list.
/// - tested by: [`flux_exact`] over random states.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn exact_fluxes(lower: &[[f64; 5]], upper: &[[f64; 5]], mixture: &Mixture, faces: &mut Vec<Face>) {
    let mixture = *mixture;
    let mut chunk = Chunk::zeros();
    let mut rows = [[0.0; LANES]; 8];
    faces.clear();
    for (lower, upper) in lower.chunks(LANES).zip(upper.chunks(LANES)) {
        let n = lower.len();
        put(&mut chunk.left, lower);
        put(&mut chunk.right, upper);
        solve(n, &mut chunk, &mixture);
        let [mass, velocity, pressure, shear, energy, phi, compression, solved] = &mut rows;
        fluxes(n, &chunk, &mixture, mass, velocity, pressure, shear, energy, phi, compression, solved);
        for k in 0..n {
            faces.push(if solved[k] == 0.0 {
                flux_exact(lower[k], upper[k], &mixture)
            } else {
                Face {
                    mass: mass[k],
                    velocity: velocity[k],
                    pressure: pressure[k],
                    shear: shear[k],
                    energy: energy[k],
                    phi: phi[k],
                    compression: compression[k],
                }
            });
        }
    }
}

#[inline(always)]
fn put(sides: &mut Sides, states: &[[f64; 5]]) {
    for (k, state) in states.iter().enumerate() {
        [sides.rho[k], sides.u[k], sides.v[k], sides.p[k], sides.phi[k]] = *state;
    }
}
