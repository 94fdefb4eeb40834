//! Rows of exact Riemann solutions.
//!
//! What [`crate::riemann::exact_riemann`] does for one face, for chunks of faces (SIMD batches) without branches: the same wave curves and
//! the same first guess, then Halley's steps (cubic, as there) until all faces of the chunk have converged. A face
//! that has keeps its numbers, so that they do not depend on the company it is solved in. Faces for which more is
//! needed (a vacuum or nearly one, the inside of a fan, no convergence) are left to the scalar solver.

mod fluxes;
mod listed;

use std::ops::Range;

use mesh::{exp_and_less_one, ln_of, whole_lines};

use crate::Mixture;
use crate::reconstruction::Reconstruction;
use crate::reconstruction::states_at_face;
use crate::riemann::godunov::flux_exact;
use crate::step::face_rows::FaceRows;

use fluxes::fluxes;
pub(crate) use listed::{ListedFaces, exact_fluxes};

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
        }
    }
}

/// [`flux_exact`] at the faces between cells `k` and `k + step`, for `k` in `range` and in whatever completes its
/// lines; `stride` is that of the rows.
///
/// - `used`: whether the face above cell `k` counts. What lies between the rows of a block may be no state at all.
/// - tested by: [`crate::riemann::exact_riemann`] over its extreme and random states.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn exact_faces(
    cells: &Reconstruction<'_>,
    step: usize,
    stride: usize,
    range: std::ops::Range<usize>,
    used: fn(usize, usize) -> bool,
    mixture: &Mixture,
    faces: &mut FaceRows,
) {
    let mixture = *mixture;
    let range = whole_lines(range, cells.lines(step, stride));
    if mixture.has_covolume() {
        exact_rows::<true>(cells, step, range, used, &mixture, faces);
    } else {
        exact_rows::<false>(cells, step, range, used, &mixture, faces);
    }
}

/// [`exact_faces`] of whole lines.
#[inline(always)]
fn exact_rows<const B: bool>(
    cells: &Reconstruction<'_>,
    step: usize,
    range: Range<usize>,
    used: fn(usize, usize) -> bool,
    mixture: &Mixture,
    faces: &mut FaceRows,
) {
    let mut chunk = Chunk::zeros();
    let (mut compression, mut solved) = ([0.0; LANES], [0.0; LANES]);
    let mut first = range.start;
    while first < range.end {
        let n = LANES.min(range.end - first);
        take::<B>(n, cells.cut(first, n), cells.cut(first + step, n), &mut chunk.left, &mut chunk.right);
        solve::<B>(n, &mut chunk, mixture);
        fluxes::<B>(
            n,
            &chunk,
            mixture,
            &mut faces.mass[first..][..n],
            &mut faces.velocity[first..][..n],
            &mut faces.pressure[first..][..n],
            &mut faces.shear[first..][..n],
            &mut faces.energy[first..][..n],
            &mut faces.phi[first..][..n],
            &mut compression,
            &mut solved,
        );
        if count(&solved, n) < n {
            for k in 0..n {
                if solved[k] == 0.0 && used(first + k, step) {
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
fn take<const B: bool>(
    n: usize,
    lower: Reconstruction<'_>,
    upper: Reconstruction<'_>,
    left: &mut Sides,
    right: &mut Sides,
) {
    for k in 0..n.min(LANES) {
        if B {
            let share = |cells: &Reconstruction<'_>| if cells.with_gas { cells.gas_shares[k] } else { 0.0 };
            (left.gas_share[k], right.gas_share[k]) = (share(&lower), share(&upper));
        }
        let [l, r] = states_at_face::<true>(&lower, &upper, k);
        [left.rho[k], left.u[k], left.v[k], left.p[k], left.phi[k]] = l;
        [right.rho[k], right.u[k], right.v[k], right.p[k], right.phi[k]] = r;
    }
}

/// From the states in a chunk to the pressures and velocity changes of its faces.
#[inline(always)]
fn solve<const B: bool>(n: usize, chunk: &mut Chunk, mixture: &Mixture) {
    prepare::<B>(n, chunk, mixture);
    for _ in 0..MOST_STEPS {
        advance(n, chunk);
        if count(&chunk.done, n) == n {
            break;
        }
    }
}

/// The wave curves and the first guess, see `first_guess` of the scalar solver.
#[inline(always)]
fn prepare<const B: bool>(n: usize, chunk: &mut Chunk, mixture: &Mixture) {
    let Chunk { left, right, pi, p, shifted, done, .. } = chunk;
    for k in 0..n.min(LANES) {
        // (m, π, c) of one side: γ = (1 + β₁)/β₁, π = β₂/(1 + β₁), with a covolume of what is in the free volume.
        let law = |rho: f64, p: f64, phi: f64, share: f64| {
            let free = mixture.free_share::<B>(rho, share);
            let [b1, b2] = mixture.free_betas::<B>(phi, rho, rho * share);
            let per_free = if B { 1.0 / free } else { 1.0 };
            let (rho, b1, b2) =
                if B { (rho * per_free, b1 * per_free, b2 * per_free) } else { (rho, b1, b2) };
            let above = 1.0 + b1;
            let inverse = 1.0 / (rho * (b1 * above));
            let inverse_above = inverse * (rho * b1);
            let pi = b2 * inverse_above;
            let squared = (above * above) * (inverse * (p + pi));
            let c = (if squared > 0.0 { squared } else { 0.0 }).sqrt();
            (b1, 0.5 * inverse_above, pi, c, rho * c, free)
        };
        let of = |s: &Sides| law(s.rho[k], s.p[k], s.phi[k], s.gas_share[k]);
        let (b1_l, m_l, pi_l, c_l, z_l, free_l) = of(left);
        let (b1_r, m_r, pi_r, c_r, z_r, free_r) = of(right);
        if B {
            (left.free[k], right.free[k]) = (free_l, free_r);
        }
        let (base_l, base_r) = (left.p[k] + pi_l, right.p[k] + pi_r);
        let inverse = 1.0 / (base_l * base_r);
        let lowest_pi = if pi_l < pi_r { pi_l } else { pi_r };
        (left.m[k], left.c[k], left.inverse_base[k]) = (m_l, c_l, inverse * base_r);
        (right.m[k], right.c[k], right.inverse_base[k]) = (m_r, c_r, inverse * base_l);
        (left.escape[k], left.offset[k]) = (2.0 * b1_l * c_l, pi_l - lowest_pi);
        (right.escape[k], right.offset[k]) = (2.0 * b1_r * c_r, pi_r - lowest_pi);

        let du = right.u[k] - left.u[k];
        let right_is_lower = right.p[k] < left.p[k];
        let low = if right_is_lower { right.p[k] } else { left.p[k] };
        let high = if right_is_lower { left.p[k] } else { right.p[k] };
        let z_low = if right_is_lower { z_r } else { z_l };
        let acoustic = low + (z_low * (high - low) - (z_l * z_r) * du) / (z_l + z_r);
        let fallback = if low > -lowest_pi { low } else { high };
        let guess = if acoustic + lowest_pi > 0.1 * (fallback + lowest_pi) { acoustic } else { fallback };
        let state =
            (left.rho[k] > 0.0) & (right.rho[k] > 0.0) & (base_l > 0.0) & (base_r > 0.0) & (guess < f64::MAX);
        let state = if B { state & (free_l > 0.0) & (free_r > 0.0) } else { state };
        pi[k] = lowest_pi;
        p[k] = guess;
        shifted[k] = guess + lowest_pi;
        done[k] = if state { 0.0 } else { 2.0 };
    }
}

/// f_K and its derivatives by P, times P and P², as `curve` of the scalar solver.
#[inline(always)]
fn curve(s: &Sides, k: usize, p: f64, shifted: f64) -> [f64; 3] {
    let (m, inverse_base) = (s.m[k], s.inverse_base[k]);
    let a = 1.0 - m;
    let per_gamma = s.c[k] * (1.0 - 2.0 * m);
    let x = (p - s.p[k]) * inverse_base;
    let ratio = (shifted + s.offset[k]) * inverse_base;
    let lever = shifted * inverse_base;
    let shock = x > 0.0;
    // Both waves are made, with one division between them, and one is chosen.
    let inverse = 1.0 / if shock { 1.0 + a * x } else { ratio };
    let scale = per_gamma * inverse.sqrt();
    let (power, less_one) = exp_and_less_one(m * ln_of(ratio, x));
    let slope_shock = scale * inverse * (1.0 + 0.5 * a * x) * lever;
    let slope_fan = per_gamma * power * (lever * inverse);
    let curvature_shock = -scale * (inverse * inverse) * a * (1.0 + 0.25 * a * x) * (lever * lever);
    let curvature_fan = -a * slope_fan * (lever * inverse);
    [
        if shock { scale * x } else { s.escape[k] * less_one },
        if shock { slope_shock } else { slope_fan },
        if shock { curvature_shock } else { curvature_fan },
    ]
}

/// One step of all faces that are not done.
///
/// Halley's step in P. Where P is far too low it is Newton's, which ends below the root; where it is far too high,
/// one that stays above Newton's in ln P, which ends above it.
#[inline(always)]
fn advance(n: usize, chunk: &mut Chunk) {
    let Chunk { left, right, pi, p, shifted, f_left, f_right, done } = chunk;
    for k in 0..n.min(LANES) {
        let (p_old, shifted_old) = (p[k], shifted[k]);
        let [f_l, slope_l, curvature_l] = curve(left, k, p_old, shifted_old);
        let [f_r, slope_r, curvature_r] = curve(right, k, p_old, shifted_old);
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
