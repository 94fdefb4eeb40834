//! Exact Riemann solutions at listed faces, wherever they lie.

use std::hint::select_unpredictable;

use super::{Chunk, LANES, Lane, Sides, fluxes, solve};
use crate::Mixture;
use crate::five_equation::FaceState;
use crate::godunov::flux_exact;
use crate::hllc::Face;

/// [`flux_exact`] on some faces; the velocities of the states are the normal and the tangential one.
///
/// - `states`: those on both sides of a face.
/// - `fraction`: the gas fraction behind the wave, from the pressure and the gas fraction of the side that the fluid comes
///   from and ρ*/ρ.
/// - `put`: called with every problem, in their order, its solution, which does not depend on the others, and the gas's part
///   of the mass on the side that the fluid comes from.
/// - tested by: [`flux_exact`] over random states.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn exact_fluxes<
    T,
    S: Fn(&T) -> [FaceState; 2],
    F: Fn(f64, f64, f64) -> f64,
    P: FnMut(&T, Face, f64),
>(
    problems: &[T],
    states: S,
    mixture: &Mixture,
    fraction: F,
    mut put: P,
) {
    let mixture = *mixture;
    let mut chunk = Chunk::zeros();
    let mut rows = [[0.0; LANES]; 8];
    let mut gas_shares = [[0.0; 2]; LANES];
    for problems in problems.chunks(LANES) {
        let n = problems.len();
        for (k, problem) in problems.iter().enumerate() {
            let [lower, upper] = states(problem);
            take(&mut chunk.left, k, lower.w);
            take(&mut chunk.right, k, upper.w);
            gas_shares[k] = [lower.gas_share, upper.gas_share];
        }
        solve(n, &mut chunk, &mixture);
        let [mass, velocity, pressure, shear, energy, phi, compression, solved] = &mut rows;
        fluxes(n, &chunk, &mixture, mass, velocity, pressure, shear, energy, phi, compression, solved);
        behind(n, &chunk, &fraction, velocity, compression, phi);
        for (k, problem) in problems.iter().enumerate() {
            let face = if solved[k] == 0.0 {
                let [lower, upper] = states(problem).map(|state| state.w);
                let mut face = flux_exact(lower, upper, &mixture);
                let [_, _, _, p, phi] = if face.velocity < 0.0 { upper } else { lower };
                face.phi = fraction(p, phi, face.compression);
                face
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
            };
            put(problem, face, gas_shares[k][usize::from(face.velocity < 0.0)]);
        }
    }
}

#[inline(always)]
fn take(sides: &mut Sides, k: usize, [rho, u, v, p, phi]: [f64; 5]) {
    (sides.rho[k], sides.u[k], sides.v[k], sides.p[k], sides.phi[k]) = (rho, u, v, p, phi);
}

/// The gas fractions behind the waves, from those of the sides that the fluid comes from.
#[inline(always)]
fn behind(
    n: usize,
    chunk: &Chunk,
    fraction: &impl Fn(f64, f64, f64) -> f64,
    velocity: &Lane,
    compression: &Lane,
    phi: &mut Lane,
) {
    for k in 0..n.min(LANES) {
        let p = select_unpredictable(velocity[k] < 0.0, chunk.right.p[k], chunk.left.p[k]);
        phi[k] = fraction(p, phi[k], compression[k]);
    }
}
