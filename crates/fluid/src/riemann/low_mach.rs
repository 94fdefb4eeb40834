//! What jumps of the velocity add to the pressure on a face where flow is slow against sound.

use crate::Mixture;
use crate::state::PrimitiveCell;
use crate::state::primitive::{PHI, PRESSURE, RHO, V_N};

/// The share that is kept of what the jump of the velocity adds to the star pressure, ½Z(u_L − u_R).
///
/// In sound that is as large as the jump of the pressure. In slow flow, where differences of the pressure are of the order ρu², a
/// Riemann solver makes it c/u times as large, and damps flow in which there is no sound (Guillard & Viozat 1999; Thornber et
/// al. 2008). So of Z|Δu| is kept
///
/// min(Z|Δu|, max(|Δp|, Z Δu²/(|u_L| + |u_R|))),
///
/// no more than the jump of the pressure. That leaves waves that run in one direction as they are, whatever their height. And what
/// streams bring that meet, up to all of it where they are mirror images, as at a wall. A share that follows the Mach number instead
/// lets chequerboards grow, and takes from weak shocks what they need.
///
/// - `jump`: Z|Δu|, Pa; `difference`: |Δp|, Pa; `step`: |Δu|, `speeds`: |u_L| + |u_R|, m/s.
/// - returns: the pressure that is kept of `jump`, Pa. errors: none.
#[inline(always)]
pub(crate) fn kept_of_jump(jump: f64, difference: f64, step: f64, speeds: f64) -> f64 {
    // Where both sides are at rest there is no jump either.
    let met = jump * step / (speeds + f64::MIN_POSITIVE);
    let kept = if difference > met { difference } else { met };
    if kept < jump { kept } else { jump }
}

/// Two states whose velocities are brought together, so that their Riemann problem has the u* that it had, and of p* what
/// [`kept_of_jump`] leaves.
///
/// With the impedances Z = ρc of both sides, u* of weak waves is (Z_L u_L + Z_R u_R − Δp)/(Z_L + Z_R), and the jump of the velocity
/// adds ½Z(u_L − u_R) to p*, Z = 2 Z_L Z_R/(Z_L + Z_R). Where gas is on one side Z is the gas's, twice, and hardly anything happens.
///
/// - `left`, `right`: (ρ, u normal, v, p, φ) on the two sides of the face; what has no sound speed stays as it is.
///   `shares`: the gas's part of the mass there.
/// - tested by: u* and p* of the exact solver.
#[inline(always)]
pub(crate) fn brought_together(
    left: PrimitiveCell,
    right: PrimitiveCell,
    [share_l, share_r]: [f64; 2],
    mixture: &Mixture,
) -> [PrimitiveCell; 2] {
    let impedance = |w: &PrimitiveCell, share: f64| {
        (w[RHO] * mixture.bulk_modulus(w[RHO], w[PRESSURE], w[PHI], share)).sqrt()
    };
    let (z_l, z_r) = (impedance(&left, share_l), impedance(&right, share_r));
    let (u_l, u_r) = (left[V_N], right[V_N]);
    let per_sum = 1.0 / (z_l + z_r);
    let step = (u_l - u_r).abs();
    let jump = 2.0 * z_l * z_r * per_sum * step;
    let kept = kept_of_jump(jump, (left[PRESSURE] - right[PRESSURE]).abs(), step, u_l.abs() + u_r.abs());
    let lost = 1.0 - kept / jump;
    let [mut together_l, mut together_r] = [left, right];
    if lost > 0.0 {
        let mean = (z_l * u_l + z_r * u_r) * per_sum;
        together_l[V_N] = u_l - lost * (u_l - mean);
        together_r[V_N] = u_r - lost * (u_r - mean);
    }
    [together_l, together_r]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::riemann::exact_riemann::{Side, star_state};
    use crate::{flux_hllc, flux_hllc_low_mach};

    /// Water that flows by `u` beside water that flows by `u + step`, with a pressure that is `rise` higher.
    fn beside(u: f64, step: f64, rise: f64) -> [PrimitiveCell; 2] {
        [[1000.0, u, 3.0, 1e5, 0.0], [1000.0, u + step, 5.0, 1e5 + rise, 0.0]]
    }

    #[test]
    fn waves_walls_and_shocks_have_hllcs_flux_bitwise() {
        let z = (1000.0 * Mixture::water_and_air().bulk_modulus(1000.0, 1e5, 0.0, 0.0)).sqrt();
        let mirror = beside(2.0, -4.0, 0.0);
        for [l, r] in
            [beside(5.0, -1e-3, 1.01e-3 * z), beside(0.0, 20.0, 25.0 * z), mirror, beside(1.0, 0.0, 0.0)]
        {
            assert_eq!(
                flux_hllc_low_mach(l, r, &Mixture::water_and_air()),
                flux_hllc(l, r, &Mixture::water_and_air())
            );
            assert_eq!(brought_together(l, r, [0.0; 2], &Mixture::water_and_air()), [l, r]);
        }
    }

    #[test]
    fn slow_flow_keeps_no_more_than_the_jump_of_its_pressure() {
        for (step, rise) in [(-0.1, 0.0), (0.1, 0.0), (-0.1, 300.0), (0.1, -300.0)] {
            let [l, r] = beside(10.0, step, rise);
            let z = (1000.0 * Mixture::water_and_air().bulk_modulus(1000.0, 1e5, 0.0, 0.0)).sqrt();
            let plain = flux_hllc(l, r, &Mixture::water_and_air()).pressure - (1e5 + 0.5 * rise);
            let slow = flux_hllc_low_mach(l, r, &Mixture::water_and_air()).pressure - (1e5 + 0.5 * rise);
            approx::assert_relative_eq!(plain, -0.5 * z * step, max_relative = 1e-2);
            let met = z * step * step / 20.0;
            approx::assert_relative_eq!(
                slow,
                -0.5 * step.signum() * rise.abs().max(met),
                max_relative = 2e-2
            );
        }
    }

    #[test]
    fn bringing_together_leaves_the_star_velocity_and_bounds_the_star_pressure() {
        let side = |[rho, u, _, p, phi]: PrimitiveCell| {
            let law = Mixture::water_and_air().at(phi);
            Side { rho, u, p, gamma: law.gamma, pi: law.pi, covolume: 0.0 }
        };
        // Water beside a mixed cell, both at the pressure of the gas.
        let (l, r) = ([1000.0, 10.0, 0.0, 1e4, 0.0], [600.0, 9.5, 0.0, 1e4, 0.4]);
        let star = |[l, r]: [PrimitiveCell; 2]| star_state(&side(l), &side(r));
        let (plain, together) =
            (star([l, r]), star(brought_together(l, r, [0.0; 2], &Mixture::water_and_air())));
        approx::assert_relative_eq!(together.u, plain.u, max_relative = 1e-4);
        assert!(plain.p > 1.4e5 && (together.p - 1e4).abs() < 5e3, "{} {}", plain.p, together.p);
    }
}
