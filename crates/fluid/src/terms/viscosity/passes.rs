//! What the stresses on the faces of a block do to its motion; the loops, written as the kernels of `step/rows.rs`.
//!
//! No `map` over an array within them: it is a call, and what calls does not vectorise.

use std::ops::Range;

use super::stress::{Parts, hoop_of, part_if, velocity_between};
use super::{FaceStress, Viscosity, longitudinal};
use crate::step::update::Metric;
use crate::terms::diffusion::largest_per_density;

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
    largest_per_density(density, phi, |phi| of.stiffest(phi))
}

/// In how many cells [`Viscosity::stiffest`] is more than this times the density.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn count_beyond(of: &Viscosity, most: f64, density: &[f64], phi: &[f64]) -> u64 {
    let density = &density[..phi.len()];
    let mut count = 0;
    for k in 0..phi.len() {
        count += u64::from(of.stiffest(phi[k]) > most * density[k]);
    }
    count
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
    if parts.are_one {
        pass_body::<false>(parts, &near, step, velocity, stress, normal, shear, energy);
    } else {
        pass_body::<true>(parts, &near, step, velocity, stress, normal, shear, energy);
    }
}

// The rows that are written as arguments of their own: so it is known that they are no others.
#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias")]
#[inline(always)]
fn pass_body<const DIFFER: bool>(
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
        let part =
            part_if::<DIFFER>([longitudinal([mu[0][k], kappa[0][k]]), longitudinal([mu[1][k], kappa[1][k]])]);
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
    of_cells: OfCells<'_>,
    (cells, origin, half_dt): (usize, usize, f64),
    stress: OnFaces<'_>,
    [half_z, half_r]: [&mut [f64]; 2],
) {
    let side = cells + 2;
    for first in (0..side).map(|j| origin + j * of_cells.stride - of_cells.stride - 1) {
        let near = Near { first, count: side };
        let (half_z, half_r) = (&mut half_z[first..][..side], &mut half_r[first..][..side]);
        if of_cells.parts.are_one {
            accelerate::<false, true>(&of_cells, &near, half_dt, stress, half_z, half_r);
        } else {
            accelerate::<true, true>(&of_cells, &near, half_dt, stress, half_z, half_r);
        }
    }
}

/// The accelerations of the cells of a block, ∇·τ/ρ, m/s².
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn accelerations(
    of_cells: OfCells<'_>,
    (cells, origin): (usize, usize),
    stress: OnFaces<'_>,
    [along_z, along_r]: [&mut [f64]; 2],
) {
    for first in (0..cells).map(|j| origin + j * of_cells.stride) {
        let near = Near { first, count: cells };
        let (along_z, along_r) = (&mut along_z[first..][..cells], &mut along_r[first..][..cells]);
        accelerate::<true, false>(&of_cells, &near, 1.0, stress, along_z, along_r);
    }
}

/// What of the cells has a say in how stresses accelerate them, padded rows.
#[derive(Clone, Copy)]
pub(super) struct OfCells<'a> {
    pub parts: Parts<'a>,
    /// kg/m³.
    pub density: &'a [f64],
    /// 1/r, or 0 in planar geometry.
    pub inverse_r: &'a [f64],
    /// 1/h_z, 1/h_r.
    pub inverse_h: [f64; 2],
    /// Distance between cells that neighbour each other along r.
    pub stride: usize,
}

/// τ_zz and τ_zr on the faces along z; τ_rr, τ_rz and τ_rr − τ_φφ on those along r.
type OnFaces<'a> = ([&'a [f64]; 2], [&'a [f64]; 3]);

/// ∇·τ/ρ of some cells in a time: added to what is there, or in its place.
#[inline(always)]
fn accelerate<const DIFFER: bool, const ADD: bool>(
    cells: &OfCells<'_>,
    near: &Near,
    time: f64,
    (z, r): OnFaces<'_>,
    along_z: &mut [f64],
    along_r: &mut [f64],
) {
    let (count, stride) = (near.count, cells.stride);
    let (along_z, along_r) = (&mut along_z[..count], &mut along_r[..count]);
    let [inverse_z, inverse_h] = cells.inverse_h;
    let (density, inverse_r) = (near.here(cells.density), near.here(cells.inverse_r));
    // On the faces above and below.
    let of_z = |row| [near.here(row), near.before(row, 1)];
    let of_r = |row| [near.here(row), near.before(row, stride)];
    let [z_normal, z_shear] = z.map(of_z);
    let [r_normal, r_shear, r_hoop] = r.map(of_r);
    let around = Around::cut(cells.parts, near, stride);
    for k in 0..count {
        let inverse_r = inverse_r[k];
        // r_j±1/2 / r_j.
        let half_width = 0.5 * (inverse_r / inverse_h);
        let (low, high) = (1.0 - half_width, 1.0 + half_width);
        let hoop = around.hoop::<DIFFER>(k, r_normal, r_hoop);
        let force_z = inverse_z * (z_normal[0][k] - z_normal[1][k])
            + inverse_h * (high * r_shear[0][k] - low * r_shear[1][k]);
        let force_r = inverse_z * (z_shear[0][k] - z_shear[1][k])
            + inverse_h * (r_normal[0][k] - r_normal[1][k])
            + 0.5 * inverse_r * hoop;
        if ADD {
            let gain = time / density[k];
            along_z[k] += gain * force_z;
            along_r[k] += gain * force_r;
        } else {
            (along_z[k], along_r[k]) = (force_z / density[k], force_r / density[k]);
        }
    }
}

/// Adds what the hoop stress leaves to the radial momentum of the cells of a block: Δt (τ_rr − τ_φφ)/r.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn add_hoop(
    (parts, inverse_r): (Parts<'_>, &[f64]),
    (metric, cells): (&Metric<'_>, usize),
    stress: [&[f64]; 2],
    momentum: &mut [f64],
) {
    if parts.are_one {
        add_hoop_body::<false>(parts, inverse_r, metric, cells, stress, momentum);
    } else {
        add_hoop_body::<true>(parts, inverse_r, metric, cells, stress, momentum);
    }
}

#[inline(always)]
fn add_hoop_body<const DIFFER: bool>(
    parts: Parts<'_>,
    inverse_r: &[f64],
    metric: &Metric<'_>,
    cells: usize,
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
            let hoop = around.hoop::<DIFFER>(k, normal, hoop);
            momentum[k] += metric.dt * (0.5 * inverse_r[k] * hoop);
        }
    }
}

/// Whether all numbers of a row are the same.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn is_uniform(row: &[f64]) -> bool {
    let first = row.first().copied().unwrap_or_default();
    row.chunks(64).all(|chunk| chunk.iter().fold(true, |all, value| all & (*value == first)))
}

/// The least of a row's numbers.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn least(row: &[f64]) -> f64 {
    const LANES: usize = 16;
    let (chunks, rest) = row.as_chunks::<LANES>();
    let mut least = [f64::INFINITY; LANES];
    for chunk in chunks {
        for lane in 0..LANES {
            least[lane] = if chunk[lane] < least[lane] { chunk[lane] } else { least[lane] };
        }
    }
    least.iter().chain(rest).fold(f64::INFINITY, |least, value| least.min(*value))
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
    fn hoop<const DIFFER: bool>(&self, k: usize, normal: [&[f64]; 2], hoop: [&[f64]; 2]) -> f64 {
        let of = |cell: usize| longitudinal([self.shear[cell][k], self.bulk[cell][k]]);
        let own = of(0);
        let parts = [part_if::<DIFFER>([own, of(1)]), part_if::<DIFFER>([own, of(2)])];
        hoop_of(parts, [normal[0][k], normal[1][k]], [hoop[0][k], hoop[1][k]])
    }
}

#[cfg(test)]
#[path = "passes_tests.rs"]
mod tests;
