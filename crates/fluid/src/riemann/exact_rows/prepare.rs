//! What is known of a chunk of faces before it is solved: the laws and sounds of both sides, and the acoustic guess.

use super::liquid::Liquid;
use super::weak::{WEAK, Weak};
use super::{Chunk, LANES, Sides};
use crate::Mixture;
use crate::reconstruction::fraction;

/// The wave curves and the first guess, see `first_guess` of the scalar solver.
///
/// - returns: at how many faces there are weak waves only, see [`Weak`].
#[inline(always)]
pub(super) fn prepare<const WITH_GAS: bool, const B: bool>(
    n: usize,
    chunk: &mut Chunk,
    mixture: &Mixture,
    liquid: &Liquid,
) -> usize {
    let Chunk { left, right, pi, p, shifted, done, weak: Weak { is_weak, .. }, .. } = chunk;
    let mut found = 0;
    for k in 0..n.min(LANES) {
        // (ρ, β₁, β₂) of one side, with a covolume of what is in the free volume, and that volume.
        let law = |s: &Sides| {
            let (rho, phi, share) = (s.rho[k], fraction::<WITH_GAS>(s.phi[k]), s.gas_share[k]);
            let free = mixture.free_share::<B>(rho, share);
            let [b1, b2] = mixture.free_betas::<B>(phi, rho, rho * share);
            let per_free = if B { 1.0 / free } else { 1.0 };
            if B { (rho * per_free, b1 * per_free, b2 * per_free, free) } else { (rho, b1, b2, free) }
        };
        let (rho_l, b1_l, b2_l, free_l) = law(left);
        let (rho_r, b1_r, b2_r, free_r) = law(right);
        let (above_l, above_r) = (1.0 + b1_l, 1.0 + b1_r);
        // m = 1/(2(1 + β₁)), π = β₂/(1 + β₁), constants of the liquid; one division for both sides.
        let (m_l, pi_l, m_r, pi_r) = if WITH_GAS || B {
            let inverse = 1.0 / (above_l * above_r);
            let of = |inverse_above: f64, b2: f64, phi: f64| {
                let (m, pi) = (0.5 * inverse_above, b2 * inverse_above);
                // To the last bit what a row without gas has.
                if !B && phi == 0.0 { (liquid.m, liquid.pi) } else { (m, pi) }
            };
            let (m_l, pi_l) = of(inverse * above_r, b2_l, left.phi[k]);
            let (m_r, pi_r) = of(inverse * above_l, b2_r, right.phi[k]);
            (m_l, pi_l, m_r, pi_r)
        } else {
            (liquid.m, liquid.pi, liquid.m, liquid.pi)
        };
        let (base_l, base_r) = (left.p[k] + pi_l, right.p[k] + pi_r);
        // γ = (1 + β₁)/β₁, so c² = (1 + β₁)² (p + π)/q; all is divided by at once.
        let (q_l, q_r) = (rho_l * (b1_l * above_l), rho_r * (b1_r * above_r));
        let (both_q, both_bases) = (q_l * q_r, base_l * base_r);
        let inverse = 1.0 / (both_q * both_bases);
        let (per_q, per_base) = (inverse * both_bases, inverse * both_q);
        let sound = |above: f64, squared: f64| above * (if squared > 0.0 { squared } else { 0.0 }).sqrt();
        let c_l = sound(above_l, (per_q * q_r) * base_l);
        let c_r = sound(above_r, (per_q * q_l) * base_r);
        let (z_l, z_r) = (rho_l * c_l, rho_r * c_r);
        if B {
            (left.free[k], right.free[k]) = (free_l, free_r);
        }
        let (inverse_l, inverse_r) = (per_base * base_r, per_base * base_l);
        let lowest_pi = if pi_l < pi_r { pi_l } else { pi_r };
        (left.c[k], left.inverse_base[k]) = (c_l, inverse_l);
        (right.c[k], right.inverse_base[k]) = (c_r, inverse_r);
        if WITH_GAS || B {
            (left.m[k], left.escape[k], left.offset[k]) = (m_l, 2.0 * b1_l * c_l, pi_l - lowest_pi);
            (right.m[k], right.escape[k], right.offset[k]) = (m_r, 2.0 * b1_r * c_r, pi_r - lowest_pi);
        }

        let du = right.u[k] - left.u[k];
        let right_is_lower = right.p[k] < left.p[k];
        let low = if right_is_lower { right.p[k] } else { left.p[k] };
        let high = if right_is_lower { left.p[k] } else { right.p[k] };
        let z_low = if right_is_lower { z_r } else { z_l };
        let acoustic = low + (z_low * (high - low) - (z_l * z_r) * du) / (z_l + z_r);
        let fallback = if low > -lowest_pi { low } else { high };
        let is_acoustic = acoustic + lowest_pi > 0.1 * (fallback + lowest_pi);
        let guess = if is_acoustic { acoustic } else { fallback };
        let state =
            (left.rho[k] > 0.0) & (right.rho[k] > 0.0) & (base_l > 0.0) & (base_r > 0.0) & (guess < f64::MAX);
        let state = if B { state & (free_l > 0.0) & (free_r > 0.0) } else { state };
        pi[k] = lowest_pi;
        p[k] = guess;
        shifted[k] = guess + lowest_pi;
        done[k] = if state { 0.0 } else { 2.0 };
        let is_slow = (2.0 * left.u[k].abs() < c_l) & (2.0 * right.u[k].abs() < c_r);
        let weak_l = ((guess - left.p[k]) * inverse_l).abs() < WEAK;
        let weak_r = ((guess - right.p[k]) * inverse_r).abs() < WEAK;
        let weak = state & is_acoustic & is_slow & weak_l & weak_r;
        is_weak[k] = if weak { 1.0 } else { 0.0 };
        found += u64::from(weak);
    }
    found as usize
}

/// What weak waves of one law have no need of.
#[inline(always)]
pub(super) fn complete(n: usize, chunk: &mut Chunk, mixture: &Mixture, liquid: &Liquid) {
    let twice_b1 = 2.0 * mixture.beta1(0.0);
    for side in [&mut chunk.left, &mut chunk.right] {
        for k in 0..n.min(LANES) {
            (side.m[k], side.escape[k], side.offset[k]) = (liquid.m, twice_b1 * side.c[k], 0.0);
        }
    }
}
