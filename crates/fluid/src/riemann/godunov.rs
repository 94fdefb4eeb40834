//! Godunov's flux: the exact Riemann solution at one face.

use crate::Mixture;
use crate::riemann::exact_riemann::{Side, sample, star_state};
use crate::riemann::hllc::Face;
use crate::state::PrimitiveCell;

/// The flux of the exact Riemann solution between two mixtures, each of which behaves as [`Mixture::law_at`] has it.
///
/// Godunov (1959); the solution is that of [`star_state`]. Paper: section 3.1 (Colella & Glaz).
///
/// - `left`, `right`: (ρ kg/m³, u normal m/s, v tangential m/s, p Pa, φ) on the two sides of the face; `shares`: the gas's part of
///   their mass.
/// - returns: the [`Face`] per unit area.
/// - valid for ρ > 0 and p + π(φ) > 0 on both sides. errors: none.
/// - tested by: agreement with HLLC at contacts and in smooth flow, shock tubes against the exact profiles.
pub fn flux_exact(left: PrimitiveCell, right: PrimitiveCell, shares: [f64; 2], mixture: &Mixture) -> Face {
    let side = |[rho, u, _, p, phi]: PrimitiveCell, share: f64| {
        let law = mixture.law_at(rho, phi, share);
        Side { rho, u, p, gamma: law.gamma, pi: law.pi, covolume: law.covolume }
    };
    let (l, r) = (side(left, shares[0]), side(right, shares[1]));
    let star = star_state(&l, &r);
    let at = sample(&l, &r, &star, 0.0);
    // As HLLC has it: what crosses a contact at rest is the left fluid, by nothing.
    let [density, _, tangential, _, phi] = if star.u >= 0.0 { left } else { right };
    let kinetic = 0.5 * at.rho * (at.u * at.u + tangential * tangential);
    let share = if star.u >= 0.0 { shares[0] } else { shares[1] };
    let [beta1, beta2] = mixture.free_betas::<true>(phi, at.rho, at.rho * share);
    let energy = beta1 * at.p + beta2 + kinetic;
    let mass = at.rho * at.u;
    Face {
        mass,
        velocity: at.u,
        pressure: at.p,
        shear: mass * tangential,
        energy: at.u * (energy + at.p),
        phi,
        compression: at.rho / density,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flux_hllc;

    #[test]
    fn contacts_at_rest_and_moving_agree_with_hllc() {
        for u in [0.0, 150.0, -150.0] {
            let (l, r) = ([1000.0, u, 3.0, 1e5, 0.0], [1.2, u, -2.0, 1e5, 1.0]);
            let (exact, hllc) = (
                flux_exact(l, r, [0.0; 2], &Mixture::water_and_air()),
                flux_hllc(l, r, &Mixture::water_and_air()),
            );
            assert_eq!(exact.velocity, hllc.velocity);
            assert_eq!(exact.phi, hllc.phi);
            approx::assert_relative_eq!(exact.pressure, hllc.pressure, max_relative = 1e-12);
            approx::assert_relative_eq!(exact.mass, hllc.mass, max_relative = 1e-13);
            approx::assert_relative_eq!(exact.energy, hllc.energy, max_relative = 1e-13);
        }
    }

    #[test]
    fn weak_jumps_agree_with_hllc_to_second_order() {
        let jump = |size: f64| {
            let (l, r) = ([1000.0, 0.0, 0.0, 5e7, 0.0], [1000.0, 0.0, 0.0, 5e7 + size, 0.0]);
            let (exact, hllc) = (
                flux_exact(l, r, [0.0; 2], &Mixture::water_and_air()),
                flux_hllc(l, r, &Mixture::water_and_air()),
            );
            (exact.pressure - hllc.pressure).abs() / size
        };
        assert!(jump(1e4) < 1e-4);
        assert!(jump(1e5) < 12.0 * jump(1e4));
    }

    #[test]
    fn water_against_thin_gas_gives_the_exact_interface_state() {
        let face = flux_exact(
            [1000.0, 0.0, 0.0, 5e7, 0.0],
            [0.0266, 0.0, 0.0, 2118.0, 1.0],
            [0.0; 2],
            &Mixture::water_and_air(),
        );
        approx::assert_relative_eq!(face.pressure, 2_428.952_693_087, max_relative = 1e-9);
        approx::assert_relative_eq!(face.velocity, 32.998_029_834_56, max_relative = 1e-9);
        assert_eq!(face.phi, 0.0);
    }
}
