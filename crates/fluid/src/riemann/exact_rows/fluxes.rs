//! The fluxes of rows of exact Riemann solutions.

use std::hint::select_unpredictable;

use super::{Chunk, LANES, Lane, Sides};
use crate::Mixture;

/// Share of the pressure P on the softer side below which a face is left to the scalar solver: the density is made
/// from the velocity behind a rarefaction, which loses digits towards the vacuum.
const NEAR_VACUUM: f64 = 1e-8;

/// The fluxes at x/t = 0, and 1 in `solved` where they are right: see `sample` of the scalar solver.
// A flat list of what is written, as in `step/rows.rs`.
#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias")]
#[inline(always)]
pub(super) fn fluxes<const B: bool>(
    n: usize,
    chunk: &Chunk,
    mixture: &Mixture,
    mass: &mut [f64],
    velocity: &mut [f64],
    pressure: &mut [f64],
    shear: &mut [f64],
    energy: &mut [f64],
    phi: &mut [f64],
    compression: &mut Lane,
    solved: &mut Lane,
) {
    let Chunk { left, right, p, shifted, f_left, f_right, done, .. } = chunk;
    for k in 0..n.min(LANES) {
        let u_star = 0.5 * ((left.u[k] - f_left[k]) + (right.u[k] + f_right[k]));
        let p_star = p[k];
        let from_left = u_star >= 0.0;
        // Loads of both and a choice: of a branch LLVM makes a gather from where the choice falls.
        let pick = |l: &Lane, r: &Lane| select_unpredictable(from_left, l[k], r[k]);
        let ratio = |s: &Sides| (shifted[k] + s.offset[k]) * s.inverse_base[k];
        let (ratio_l, ratio_r) = (ratio(left), ratio(right));
        // The upwind side as a left one: a right wave is a left wave seen from behind.
        let sign = if from_left { 1.0 } else { -1.0 };
        let (u_side, u_contact) = (sign * pick(&left.u, &right.u), sign * u_star);
        let (rho_side, p_side) = (pick(&left.rho, &right.rho), pick(&left.p, &right.p));
        let (c, m) = (pick(&left.c, &right.c), pick(&left.m, &right.m));
        let escape = pick(&left.escape, &right.escape);
        let behind = escape + pick(f_left, f_right);
        let x = (p_star - p_side) * pick(&left.inverse_base, &right.inverse_base);
        let phi_side = pick(&left.phi, &right.phi);
        let (b1, b2) = (mixture.beta1(phi_side), mixture.beta2(phi_side));
        // Waves cross the whole volume.
        let free = if B { pick(&left.free, &right.free) } else { 1.0 };
        let speed = if B { c / free } else { c };

        let shock = x > 0.0;
        let squeezed = 1.0 + (1.0 - m) * x;
        let head = u_side - if shock { speed * squeezed.sqrt() } else { speed };
        let undisturbed = head >= 0.0;
        // Behind a rarefaction the sound speed is (γ − 1)/2 (escape + f) and ρ* = ρR/(c*/c)².
        let ratio_side = if from_left { ratio_l } else { ratio_r };
        let over = if shock { squeezed } else { ratio_side * (escape * escape) };
        let under = if shock { 1.0 + m * x } else { behind * behind };
        let unchanged = undisturbed | (x == 0.0);
        let squeezing = if unchanged { 1.0 } else { over / under };
        // 1 − bρ* is the free share over this.
        let whole = 1.0 + (squeezing - 1.0) * (1.0 - free);
        let faster = if B { (1.0 - 2.0 * m) / m * (free / whole) } else { 2.0 * b1 };
        let fan = !shock & !undisturbed & (faster * u_contact > behind);
        compression[k] = if B & !unchanged { squeezing / whole } else { squeezing };
        let rho = rho_side * compression[k];
        let u = if undisturbed { pick(&left.u, &right.u) } else { u_star };
        let p = if undisturbed { p_side } else { p_star };
        let v = pick(&left.v, &right.v);

        let [b1, b2] = if B {
            mixture.free_betas::<B>(phi_side, rho, rho * pick(&left.gas_share, &right.gas_share))
        } else {
            [b1, b2]
        };
        let total = b1 * p + b2 + 0.5 * rho * (u * u + v * v);
        mass[k] = rho * u;
        velocity[k] = u;
        pressure[k] = p;
        shear[k] = rho * u * v;
        energy[k] = u * (total + p);
        phi[k] = phi_side;
        let lowest = if ratio_l < ratio_r { ratio_l } else { ratio_r };
        let sane = (rho > 0.0) & (energy[k].abs() < f64::MAX);
        solved[k] = if (done[k] == 1.0) & (lowest > NEAR_VACUUM) & !fan & sane { 1.0 } else { 0.0 };
    }
}
