//! Rows of exact Riemann solutions.
//!
//! What [`crate::riemann::exact_riemann`] does for one face, for chunks of faces (SIMD batches) without branches: the same wave curves and
//! the same first guess, then Halley's steps (cubic, as there) until all faces of the chunk have converged. A face
//! that has keeps its numbers, so that they do not depend on the company it is solved in. Faces for which more is
//! needed (a vacuum or nearly one, the inside of a fan, no convergence) are left to the scalar solver, and weak waves have a shorter way
//! of their own (`weak.rs`).

mod curves;
mod fluxes;
mod liquid;
mod listed;
mod prepare;
mod weak;

use std::ops::Range;

use mesh::whole_lines;

use crate::Mixture;
use crate::reconstruction::{Reconstruction, states_at_face};
use crate::riemann::godunov::flux_exact;
use crate::state::primitive::{PHI, PRESSURE, RHO, V_N, V_T};
use crate::step::face_rows::FaceRows;

use curves::{Curve, curve};
use liquid::Liquid;
pub(crate) use listed::{ListedFaces, exact_fluxes};
use prepare::{complete, prepare};
use weak::Weak;

/// Faces solved together: enough to hide that one step waits for the one before, and not so many that all wait for the
/// slowest of them. Of 8, 16, 32 the last is the fastest by 3 % of a step of the true collapse.
const LANES: usize = 32;

/// Steps after which a face is left to the scalar solver.
const MOST_STEPS: u32 = 8;

/// A relative step after which the cubic convergence leaves nothing, whatever the pressure cancels.
const LAST_STEP: f64 = 1e-8;

/// What a step may leave of the pressure, relative.
const LEFT_OVER: f64 = 1e-14;

type Lane = [f64; LANES];

/// One side of the faces: its state and its wave curve.
#[derive(Clone, Copy)]
struct Sides {
    rho: Lane,
    u: Lane,
    v: Lane,
    p: Lane,
    phi: Lane,
    /// The gas's part of the mass, and the share of the volume that is free; used where there is a covolume.
    gas_share: Lane,
    free: Lane,
    /// Sound speed in the free volume.
    c: Lane,
    /// (γ − 1)/(2γ); (γ + 1)/(2γ) is then 1 − m, and 1/γ is 1 − 2m.
    m: Lane,
    /// 1/(p + π).
    inverse_base: Lane,
    /// 2c/(γ − 1).
    escape: Lane,
    /// π − min(π_L, π_R).
    offset: Lane,
}

/// Both sides of the faces and how far their solution is.
#[derive(Clone, Copy)]
struct Chunk {
    left: Sides,
    right: Sides,
    /// min(π_L, π_R).
    pi: Lane,
    /// The iterate, and P = p + min(π_L, π_R) in full precision.
    p: Lane,
    shifted: Lane,
    /// f_L and f_R there.
    f_left: Lane,
    f_right: Lane,
    /// 0 before the iteration has ended, 1 after it, 2 where there is no state.
    done: Lane,
    /// Both sides' wave curves at the iterate.
    curves: [Curve; 2],
    weak: Weak,
}

impl Chunk {
    const fn zeros() -> Self {
        const ZERO: Lane = [0.0; LANES];
        const SIDES: Sides = Sides {
            rho: ZERO,
            u: ZERO,
            v: ZERO,
            p: ZERO,
            phi: ZERO,
            gas_share: ZERO,
            free: ZERO,
            c: ZERO,
            m: ZERO,
            inverse_base: ZERO,
            escape: ZERO,
            offset: ZERO,
        };
        Self {
            left: SIDES,
            right: SIDES,
            pi: ZERO,
            p: ZERO,
            shifted: ZERO,
            f_left: ZERO,
            f_right: ZERO,
            done: ZERO,
            curves: [Curve::ZERO; 2],
            weak: Weak::ZERO,
        }
    }
}

/// [`flux_exact`] at the faces between cells `k` and `k + step`, for `k` in `range` and in whatever completes its
/// lines; `stride` is that of the rows.
///
/// - `used`: 1 at the cells above which the face counts, else 0. What lies between the rows of a block may be no state at all; such faces
///   are solved as if there were no jump.
/// - tested by: [`crate::riemann::exact_riemann`] over its extreme and random states.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn exact_faces(
    cells: &Reconstruction<'_>,
    step: usize,
    stride: usize,
    range: std::ops::Range<usize>,
    used: &[f64],
    mixture: &Mixture,
    faces: &mut FaceRows,
) {
    let mixture = *mixture;
    let range = whole_lines(range, cells.lines(step, stride));
    match (cells.with_gas, mixture.has_covolume()) {
        (true, true) => exact_rows::<true, true>(cells, step, range, used, &mixture, faces),
        (true, false) => exact_rows::<true, false>(cells, step, range, used, &mixture, faces),
        (false, true) => exact_rows::<false, true>(cells, step, range, used, &mixture, faces),
        (false, false) => exact_rows::<false, false>(cells, step, range, used, &mixture, faces),
    }
}

/// [`exact_faces`] of whole lines.
#[inline(always)]
fn exact_rows<const WITH_GAS: bool, const B: bool>(
    cells: &Reconstruction<'_>,
    step: usize,
    range: Range<usize>,
    used: &[f64],
    mixture: &Mixture,
    faces: &mut FaceRows,
) {
    let mut chunk = Chunk::zeros();
    let (mut compression, mut solved) = ([0.0; LANES], [0.0; LANES]);
    let mut first = range.start;
    while first < range.end {
        let n = LANES.min(range.end - first);
        let (lower, upper, used) = (cells.cut(first, n), cells.cut(first + step, n), &used[first..][..n]);
        take::<WITH_GAS, B>(n, lower, upper, used, &mut chunk.left, &mut chunk.right);
        let [mass, velocity, pressure, shear, energy, phi] = faces.fluxes_mut();
        let are_solved = solve::<WITH_GAS, B>(
            n,
            &mut chunk,
            mixture,
            &mut mass[first..][..n],
            &mut velocity[first..][..n],
            &mut pressure[first..][..n],
            &mut shear[first..][..n],
            &mut energy[first..][..n],
            &mut phi[first..][..n],
            &mut compression,
            &mut solved,
        );
        if !are_solved {
            for k in 0..n {
                if solved[k] == 0.0 && used[k] != 0.0 {
                    let at = |s: &Sides| [s.rho[k], s.u[k], s.v[k], s.p[k], s.phi[k]];
                    let shares = [chunk.left.gas_share[k], chunk.right.gas_share[k]];
                    faces.set(first + k, flux_exact(at(&chunk.left), at(&chunk.right), shares, mixture));
                }
            }
        }
        first += n;
    }
}

/// How many of the first `n` lanes are not 0.
#[inline(always)]
fn count(lane: &Lane, n: usize) -> usize {
    let mut found = 0;
    for flag in &lane[..n.min(LANES)] {
        found += u64::from(*flag != 0.0);
    }
    found as usize
}

#[inline(always)]
fn take<const WITH_GAS: bool, const B: bool>(
    n: usize,
    lower: Reconstruction<'_>,
    upper: Reconstruction<'_>,
    used: &[f64],
    left: &mut Sides,
    right: &mut Sides,
) {
    for k in 0..n.min(LANES) {
        if B {
            let share = |cells: &Reconstruction<'_>| cells.gas_share::<WITH_GAS>(k);
            (left.gas_share[k], right.gas_share[k]) = (share(&lower), share(&upper));
        }
        let [l, r] = states_at_face::<WITH_GAS>(&lower, &upper, k);
        let beyond = |c: usize| if used[k] != 0.0 { r[c] } else { l[c] };
        [left.rho[k], left.u[k], left.v[k], left.p[k], _] = l;
        right.rho[k] = beyond(RHO);
        right.u[k] = beyond(V_N);
        right.v[k] = beyond(V_T);
        right.p[k] = beyond(PRESSURE);
        if WITH_GAS {
            (left.phi[k], right.phi[k]) = (l[PHI], beyond(PHI));
        }
    }
}

/// From the states in a chunk to the fluxes of its faces and, at those that are not weak, 1 in `solved` where they are right.
///
/// - returns: whether all are.
// A flat list of what is written, as in `step/rows.rs`.
#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias")]
#[inline(always)]
fn solve<const WITH_GAS: bool, const B: bool>(
    n: usize,
    chunk: &mut Chunk,
    mixture: &Mixture,
    mass: &mut [f64],
    velocity: &mut [f64],
    pressure: &mut [f64],
    shear: &mut [f64],
    energy: &mut [f64],
    phi: &mut [f64],
    compression: &mut Lane,
    solved: &mut Lane,
) -> bool {
    let liquid = Liquid::of(mixture);
    let l = &liquid;
    let mut weak = prepare::<WITH_GAS, B>(n, chunk, mixture, l);
    // Called by name: a pointer to one of them would not be inlined.
    macro_rules! weak_fluxes {
        ($others:literal) => {
            weak::fluxes::<WITH_GAS, B, $others>(
                n,
                chunk,
                mixture,
                l,
                mass,
                velocity,
                pressure,
                shear,
                energy,
                phi,
                compression,
            )
        };
    }
    if weak > 0 {
        weak =
            if WITH_GAS || B { weak::solve::<false>(n, chunk, l) } else { weak::solve::<true>(n, chunk, l) };
    }
    if weak == n {
        weak_fluxes!(false);
        return true;
    }
    if !WITH_GAS && !B {
        complete(n, chunk, mixture, l);
    }
    iterate(n, chunk);
    fluxes::fluxes::<B>(n, chunk, mixture, mass, velocity, pressure, shear, energy, phi, compression, solved);
    if weak > 0 {
        weak_fluxes!(true);
        for k in 0..n.min(LANES) {
            solved[k] = if chunk.weak.is_weak[k] != 0.0 { 1.0 } else { solved[k] };
        }
    }
    count(solved, n) == n
}

/// Steps until all faces are done, or have had so many that the scalar solver takes them.
#[inline(always)]
fn iterate(n: usize, chunk: &mut Chunk) {
    for _ in 0..MOST_STEPS {
        advance(n, chunk);
        if count(&chunk.done, n) == n {
            break;
        }
    }
}

/// One step of all faces that are not done.
///
/// Halley's step in P. Where P is far too low it is Newton's, which ends below the root; where it is far too high,
/// one that stays above Newton's in ln P, which ends above it.
#[inline(always)]
fn advance(n: usize, chunk: &mut Chunk) {
    let Chunk { left, right, pi, p, shifted, f_left, f_right, done, curves: [on_left, on_right], .. } = chunk;
    curve(n, left, p, shifted, on_left);
    curve(n, right, p, shifted, on_right);
    for k in 0..n.min(LANES) {
        let (p_old, shifted_old) = (p[k], shifted[k]);
        let [f_l, slope_l, curvature_l] = [on_left.f[k], on_left.slope[k], on_left.curvature[k]];
        let [f_r, slope_r, curvature_r] = [on_right.f[k], on_right.slope[k], on_right.curvature[k]];
        let inverse = 1.0 / (slope_l + slope_r);
        let x = ((f_l + f_r) + (right.u[k] - left.u[k])) * inverse;
        let bend = x * ((curvature_l + curvature_r) * inverse);
        // P is multiplied by 1 + over/under.
        let (over, under) = (-2.0 * x, 2.0 - bend);
        let far_down = 10.0 * (over + under) < under;
        let far_up = x < -1.0;
        let over = if far_down { -x * (1.0 + 0.5 * x) } else { over };
        let under = if far_down { 1.0 + x * (1.0 + 0.5 * x) } else { under };
        let over = if far_up { -x } else { over };
        let under = if far_up { 1.0 } else { under };
        let step = over / under;

        // p and P differ by π; the smaller of the two is carried, the other one follows.
        let ahead = shifted_old + shifted_old * step;
        let carry_p = (ahead - pi[k]).abs() < ahead;
        let p_carried = p_old + shifted_old * step;
        let p_new = if carry_p { p_carried } else { ahead - pi[k] };
        let shifted_new = if carry_p { p_carried + pi[k] } else { ahead };
        // The curves at the end of the step by their Taylor series: what they lack is of the order of step³ as well.
        let moved = |f: f64, slope: f64, curvature: f64| f + step * (slope + 0.5 * step * curvature);
        let size = step.abs();
        let smaller = if p_new.abs() < shifted_new { p_new.abs() } else { shifted_new };
        let converged = (size <= LAST_STEP) | (size * size * size * shifted_new <= LEFT_OVER * smaller);
        let active = done[k] == 0.0;
        p[k] = if active { p_new } else { p_old };
        shifted[k] = if active { shifted_new } else { shifted_old };
        f_left[k] = if active { moved(f_l, slope_l, curvature_l) } else { f_left[k] };
        f_right[k] = if active { moved(f_r, slope_r, curvature_r) } else { f_right[k] };
        let ended = if converged { 1.0 } else { 0.0 };
        done[k] = if active { ended } else { done[k] };
    }
}

#[cfg(test)]
mod tests;
