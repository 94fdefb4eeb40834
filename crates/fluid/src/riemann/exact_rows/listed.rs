//! Exact Riemann solutions at listed faces, wherever they lie.

use crate::state::PrimitiveCell;
use std::hint::select_unpredictable;

use super::fluxes::fluxes;
use super::{Chunk, LANES, Lane, Sides, count, solve};
use crate::Mixture;
use crate::riemann::godunov::flux_exact;
use crate::riemann::hllc::Face;
use crate::two_phase::FaceState;

/// Faces on a list: where their states come from and where their fluxes go. The methods are to be inlined.
pub(crate) trait ListedFaces {
    type Face;

    /// The states on both sides; their velocities are the normal and the tangential one.
    fn states(&self, face: &Self::Face) -> [FaceState; 2];

    /// The gas fraction behind the wave, from ρ, p, φ and the gas's part of the mass of the side that the fluid comes from and
    /// ρ*/ρ.
    fn star_fraction(&self, side: [f64; 3], gas_share: f64, compression: f64) -> f64;

    /// Takes the solution, and the gas's part of the mass on the side that the fluid comes from.
    fn put(&mut self, face: &Self::Face, solution: Face, gas_share: f64);
}

/// [`flux_exact`] on some faces, in their order. What a face gets does not depend on the others.
///
/// - tested by: [`flux_exact`] over random states.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn exact_fluxes<L: ListedFaces>(list: &[L::Face], faces: &mut L, mixture: &Mixture) {
    if mixture.has_covolume() {
        listed_fluxes::<L, true>(list, faces, mixture);
    } else {
        listed_fluxes::<L, false>(list, faces, mixture);
    }
}

#[inline(always)]
fn listed_fluxes<L: ListedFaces, const B: bool>(list: &[L::Face], faces: &mut L, mixture: &Mixture) {
    let mixture = *mixture;
    let mut chunk = Chunk::zeros();
    let mut rows = [[0.0; LANES]; 8];
    let mut gas_shares = [[0.0; LANES]; 2];
    for list in list.chunks(LANES) {
        let n = list.len();
        for (k, face) in list.iter().enumerate() {
            let [lower, upper] = faces.states(face);
            take(&mut chunk.left, k, lower.w);
            take(&mut chunk.right, k, upper.w);
            (gas_shares[0][k], gas_shares[1][k]) = (lower.gas_share, upper.gas_share);
        }
        if B {
            (chunk.left.gas_share, chunk.right.gas_share) = (gas_shares[0], gas_shares[1]);
        }
        solve::<true, B>(n, &mut chunk, &mixture);
        let [mass, velocity, pressure, shear, energy, phi, compression, solved] = &mut rows;
        fluxes::<B, false>(
            n,
            &chunk,
            &mixture,
            mass,
            velocity,
            pressure,
            shear,
            energy,
            phi,
            compression,
            solved,
        );
        behind(n, &chunk, faces, velocity, compression, phi, &mut gas_shares);
        let are_solved = count(solved, n) == n;
        for (k, face) in list.iter().enumerate() {
            if are_solved || solved[k] != 0.0 {
                let solution = Face {
                    mass: mass[k],
                    velocity: velocity[k],
                    pressure: pressure[k],
                    shear: shear[k],
                    energy: energy[k],
                    phi: phi[k],
                    compression: compression[k],
                };
                faces.put(face, solution, gas_shares[0][k]);
            } else {
                let (solution, gas_share) = scalar_flux(face, faces, &mixture);
                faces.put(face, solution, gas_share);
            }
        }
    }
}

#[cold]
#[inline(never)]
fn scalar_flux<L: ListedFaces>(face: &L::Face, faces: &L, mixture: &Mixture) -> (Face, f64) {
    let [lower, upper] = faces.states(face);
    let mut solution = flux_exact(lower.w, upper.w, [lower.gas_share, upper.gas_share], mixture);
    let from = if solution.velocity < 0.0 { upper } else { lower };
    let [rho, _, _, p, phi] = from.w;
    solution.phi = faces.star_fraction([rho, p, phi], from.gas_share, solution.compression);
    (solution, from.gas_share)
}

#[inline(always)]
fn take(sides: &mut Sides, k: usize, [rho, u, v, p, phi]: PrimitiveCell) {
    (sides.rho[k], sides.u[k], sides.v[k], sides.p[k], sides.phi[k]) = (rho, u, v, p, phi);
}

/// The gas fractions behind the waves, and in `gas_shares[0]` the gas's part of the mass, from the sides that the fluid
/// comes from.
#[inline(always)]
fn behind<L: ListedFaces>(
    n: usize,
    chunk: &Chunk,
    faces: &L,
    velocity: &Lane,
    compression: &Lane,
    phi: &mut Lane,
    [lower, upper]: &mut [Lane; 2],
) {
    for k in 0..n.min(LANES) {
        let is_from_upper = velocity[k] < 0.0;
        let pick = |upper: &Lane, lower: &Lane| select_unpredictable(is_from_upper, upper[k], lower[k]);
        let p = pick(&chunk.right.p, &chunk.left.p);
        let rho = pick(&chunk.right.rho, &chunk.left.rho);
        lower[k] = pick(upper, lower);
        phi[k] = faces.star_fraction([rho, p, phi[k]], lower[k], compression[k]);
    }
}
