//! Exact Riemann solutions at listed faces, wherever they lie.

use std::hint::select_unpredictable;

use super::fluxes::fluxes;
use super::liquid::Liquid;
use super::prepare::prepare;
use super::{Chunk, LANES, Lane, iterate, weak};
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

/// [`flux_exact`] on some faces, those of weak waves first. What a face gets does not depend on the others.
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
    let liquid = Liquid::of(&mixture);
    let (mut chunk, mut rows) = (Chunk::zeros(), [[0.0; LANES]; 8]);
    // Faces with strong waves wait until they are a chunk.
    let (mut waiting, mut strong) = ([0; 2 * LANES], 0);
    for first in (0..list.len()).step_by(LANES) {
        let n = LANES.min(list.len() - first);
        let mut shares = take::<L, B>(list[first..][..n].iter(), faces, &mut chunk);
        let weak = prepare::<true, B>(n, &mut chunk, &mixture, &liquid);
        if weak > 0 {
            weak::solve::<false>(n, &mut chunk, &liquid);
            let [mass, velocity, pressure, shear, energy, phi, compression, _] = &mut rows;
            weak::fluxes::<true, B, false>(
                n,
                &chunk,
                &mixture,
                &liquid,
                mass,
                velocity,
                pressure,
                shear,
                energy,
                phi,
                compression,
            );
            behind(n, &chunk, faces, &mut rows, &mut shares);
        }
        for (k, face) in list[first..][..n].iter().enumerate() {
            if chunk.weak.is_weak[k] != 0.0 {
                faces.put(face, solution(&rows, k), shares[0][k]);
            } else {
                waiting[strong] = first + k;
                strong += 1;
            }
        }
        let is_last = first + n == list.len();
        while strong >= LANES || (is_last && strong > 0) {
            let some = strong.min(LANES);
            strong_fluxes::<L, B>(list, &waiting[..some], faces, &mixture, &mut chunk, &mut rows);
            waiting.copy_within(some..strong, 0);
            strong -= some;
        }
    }
}

/// Rows of what a chunk of faces gets: mass, velocity, pressure, shear, energy, φ, ρ*/ρ, and 1 where that is right.
type Solutions = [Lane; 8];

fn solution([mass, velocity, pressure, shear, energy, phi, compression, _]: &Solutions, k: usize) -> Face {
    Face {
        mass: mass[k],
        velocity: velocity[k],
        pressure: pressure[k],
        shear: shear[k],
        energy: energy[k],
        phi: phi[k],
        compression: compression[k],
    }
}

/// The fluxes of at most a chunk of faces, given by their numbers in the list.
#[inline(always)]
fn strong_fluxes<L: ListedFaces, const B: bool>(
    list: &[L::Face],
    numbers: &[usize],
    faces: &mut L,
    mixture: &Mixture,
    chunk: &mut Chunk,
    rows: &mut Solutions,
) {
    let n = numbers.len();
    let mut shares = take::<L, B>(numbers.iter().map(|number| &list[*number]), faces, chunk);
    prepare::<true, B>(n, chunk, mixture, &Liquid::of(mixture));
    iterate(n, chunk);
    let [mass, velocity, pressure, shear, energy, phi, compression, solved] = &mut *rows;
    fluxes::<B>(n, chunk, mixture, mass, velocity, pressure, shear, energy, phi, compression, solved);
    behind(n, chunk, faces, rows, &mut shares);
    for (k, number) in numbers.iter().enumerate() {
        let face = &list[*number];
        if rows[7][k] != 0.0 {
            faces.put(face, solution(rows, k), shares[0][k]);
        } else {
            let (solution, gas_share) = scalar_flux(face, faces, mixture);
            faces.put(face, solution, gas_share);
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

/// Takes the states of faces into a chunk.
///
/// - returns: the gas's part of the mass on both sides.
#[inline(always)]
fn take<'a, L: ListedFaces<Face: 'a>, const B: bool>(
    list: impl Iterator<Item = &'a L::Face>,
    faces: &L,
    chunk: &mut Chunk,
) -> [Lane; 2] {
    let mut shares = [[0.0; LANES]; 2];
    for (k, face) in list.enumerate() {
        let states = faces.states(face);
        for ((sides, share), state) in
            [&mut chunk.left, &mut chunk.right].into_iter().zip(&mut shares).zip(states)
        {
            [sides.rho[k], sides.u[k], sides.v[k], sides.p[k], sides.phi[k]] = state.w;
            share[k] = state.gas_share;
        }
    }
    if B {
        (chunk.left.gas_share, chunk.right.gas_share) = (shares[0], shares[1]);
    }
    shares
}

/// The gas fractions behind the waves, and in `shares[0]` the gas's part of the mass, from the sides that the fluid
/// comes from.
#[inline(always)]
fn behind<L: ListedFaces>(
    n: usize,
    chunk: &Chunk,
    faces: &L,
    [_, velocity, _, _, _, phi, compression, _]: &mut Solutions,
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
