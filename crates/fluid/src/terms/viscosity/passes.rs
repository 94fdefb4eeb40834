//! What the stresses on the faces of a block do to its motion; the loops, written as the kernels of `step/rows.rs`.
//!
//! No `map` over an array within them: it is a call, and what calls does not vectorise.

use std::ops::Range;

use super::stress::{Parts, hoop_of, part, velocity_between};
use super::{FaceStress, Viscosity, longitudinal};
use crate::step::update::Metric;

/// Where cells and their neighbours are in padded rows.
struct Near {
    first: usize,
    count: usize,
}

impl Near {
    /// The cells themselves.
    #[inline(always)]
    fn here<'r>(&self, row: &'r [f64]) -> &'r [f64] {
        &row[self.first..][..self.count]
    }

    /// Those so much further on.
    #[inline(always)]
    fn after<'r>(&self, row: &'r [f64], by: usize) -> &'r [f64] {
        &row[self.first + by..][..self.count]
    }

    /// Those so much before.
    #[inline(always)]
    fn before<'r>(&self, row: &'r [f64], by: usize) -> &'r [f64] {
        &row[self.first - by..][..self.count]
    }
}

/// μ and κ of cells with these gas fractions.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn viscosities(of: &Viscosity, phi: &[f64], shear: &mut [f64], bulk: &mut [f64]) {
    let count = phi.len();
    let (shear, bulk) = (&mut shear[..count], &mut bulk[..count]);
    for k in 0..count {
        [shear[k], bulk[k]] = of.at(phi[k]);
    }
}

/// The largest [`Viscosity::stiffest`] per density.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn stiffest_per_density(of: &Viscosity, density: &[f64], phi: &[f64]) -> f64 {
    const LANES: usize = 16;
    let larger = |most: f64, density: f64, phi: f64| {
        let own = of.stiffest(phi) / density;
        if own > most { own } else { most }
    };
    let (densities, phis) = (density.as_chunks::<LANES>(), phi.as_chunks::<LANES>());
    let mut most = [0.0; LANES];
    for (density, phi) in densities.0.iter().zip(phis.0) {
        for lane in 0..LANES {
            most[lane] = larger(most[lane], density[lane], phi[lane]);
        }
    }
    let rest = densities.1.iter().zip(phis.1).fold(0.0, |most, (density, phi)| larger(most, *density, *phi));
    most.into_iter().fold(rest, f64::max)
}

/// Lets momentum and energy pass through faces: −τ and −τ·v.
///
/// - `range`: of the cells below the faces, `step` to those above. `velocity`: normal and tangential. `fluxes`: of both momenta and the
///   energy.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn pass(
    parts: Parts<'_>,
    (range, step): (Range<usize>, usize),
    velocity: [&[f64]; 2],
    stress: &FaceStress<'_>,
    fluxes: [&mut [f64]; 3],
) {
    let near = Near { first: range.start, count: range.len() };
    let [normal, shear, energy] = fluxes.map(|row| &mut row[range.clone()]);
    pass_body(parts, &near, step, velocity, stress, normal, shear, energy);
}

// The rows that are written as arguments of their own: so it is known that they are no others.
#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias")]
#[inline(always)]
fn pass_body(
    parts: Parts<'_>,
    near: &Near,
    step: usize,
    velocity: [&[f64]; 2],
    stress: &FaceStress<'_>,
    normal: &mut [f64],
    shear: &mut [f64],
    energy: &mut [f64],
) {
    let count = near.count;
    let (normal, shear, energy) = (&mut normal[..count], &mut shear[..count], &mut energy[..count]);
    let both = |row| [near.here(row), near.after(row, step)];
    let [mu, kappa, u, w] = [parts.shear, parts.bulk, velocity[0], velocity[1]].map(both);
    let (tau_n, tau_t) = (near.here(stress.normal), near.here(stress.shear));
    for k in 0..count {
        let part = part([longitudinal([mu[0][k], kappa[0][k]]), longitudinal([mu[1][k], kappa[1][k]])]);
        let between = |v: [&[f64]; 2]| velocity_between(part, [v[0][k], v[1][k]]);
        let (u, w) = (between(u), between(w));
        normal[k] -= tau_n[k];
        shear[k] -= tau_t[k];
        energy[k] -= tau_n[k] * u + tau_t[k] * w;
    }
}

/// Adds what the velocities of a block and its first ghosts gain in half a step: ½ Δt ∇·τ/ρ.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn gain(
    (parts, density, inverse_r): (Parts<'_>, &[f64], &[f64]),
    (metric, cells): (&Metric<'_>, usize),
    stress: [&FaceStress<'_>; 2],
    half: [&mut [f64]; 2],
) {
    let (side, stride) = (cells + 2, metric.stride);
    let [half_z, half_r] = half;
    for first in (0..side).map(|j| metric.origin + j * stride - stride - 1) {
        let near = Near { first, count: side };
        let [half_z, half_r] = [&mut *half_z, &mut *half_r].map(|row| &mut row[first..][..side]);
        gain_body(parts, &near, metric, density, inverse_r, stress, half_z, half_r);
    }
}

#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias")]
#[inline(always)]
fn gain_body(
    parts: Parts<'_>,
    near: &Near,
    metric: &Metric<'_>,
    density: &[f64],
    inverse_r: &[f64],
    [z, r]: [&FaceStress<'_>; 2],
    half_z: &mut [f64],
    half_r: &mut [f64],
) {
    let (count, stride) = (near.count, metric.stride);
    let (half_z, half_r) = (&mut half_z[..count], &mut half_r[..count]);
    let ([inverse_z, inverse_h], half_dt) = (metric.inverse_h, 0.5 * metric.dt);
    let (density, inverse_r) = (near.here(density), near.here(inverse_r));
    // On the faces above and below.
    let of_z = |row| [near.here(row), near.before(row, 1)];
    let of_r = |row| [near.here(row), near.before(row, stride)];
    let [z_normal, z_shear] = [&*z.normal, &*z.shear].map(of_z);
    let [r_normal, r_shear, r_hoop] = [&*r.normal, &*r.shear, &*r.hoop].map(of_r);
    let around = Around::cut(parts, near, stride);
    for k in 0..count {
        let inverse_r = inverse_r[k];
        // r_j±1/2 / r_j.
        let share = |half: f64| 1.0 + half * inverse_r / inverse_h;
        let (low, high) = (share(-0.5), share(0.5));
        let hoop = around.hoop(k, r_normal, r_hoop);
        let force_z = inverse_z * (z_normal[0][k] - z_normal[1][k])
            + inverse_h * (high * r_shear[0][k] - low * r_shear[1][k]);
        let force_r = inverse_z * (z_shear[0][k] - z_shear[1][k])
            + inverse_h * (r_normal[0][k] - r_normal[1][k])
            + 0.5 * inverse_r * hoop;
        let gain = half_dt / density[k];
        half_z[k] += gain * force_z;
        half_r[k] += gain * force_r;
    }
}

/// Adds what the hoop stress leaves to the radial momentum of the cells of a block: Δt (τ_rr − τ_φφ)/r.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn add_hoop(
    (parts, inverse_r): (Parts<'_>, &[f64]),
    (metric, cells): (&Metric<'_>, usize),
    [normal, hoop]: [&[f64]; 2],
    momentum: &mut [f64],
) {
    let stride = metric.stride;
    for (j, momentum) in momentum.chunks_exact_mut(cells).enumerate() {
        let near = Near { first: metric.origin + j * stride, count: cells };
        let momentum = &mut momentum[..cells];
        let inverse_r = near.here(inverse_r);
        let [normal, hoop] = [normal, hoop].map(|row| [near.here(row), near.before(row, stride)]);
        let around = Around::cut(parts, &near, stride);
        for k in 0..cells {
            momentum[k] += metric.dt * (0.5 * inverse_r[k] * around.hoop(k, normal, hoop));
        }
    }
}

/// The viscosities of cells, and of those above and below them.
struct Around<'a> {
    shear: [&'a [f64]; 3],
    bulk: [&'a [f64]; 3],
}

impl<'a> Around<'a> {
    #[inline(always)]
    fn cut(parts: Parts<'a>, near: &Near, stride: usize) -> Self {
        let of = |row| [near.here(row), near.after(row, stride), near.before(row, stride)];
        Self { shear: of(parts.shear), bulk: of(parts.bulk) }
    }

    /// [`Parts::hoop`] of cell `k`; the stresses are those of the faces above and below.
    #[inline(always)]
    fn hoop(&self, k: usize, normal: [&[f64]; 2], hoop: [&[f64]; 2]) -> f64 {
        let [own, above, below] =
            [0, 1, 2].map(|cell| longitudinal([self.shear[cell][k], self.bulk[cell][k]]));
        let parts = [part([own, above]), part([own, below])];
        hoop_of(parts, normal.map(|row| row[k]), hoop.map(|row| row[k]))
    }
}
