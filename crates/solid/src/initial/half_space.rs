//! The stress of a half-space at rest under what presses on its surface.

use crate::ElasticState;

/// A harmonic function h in the half-space that is the pressure on its surface, and the mean m of h over the disc about the axis that ends
/// at the point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Harmonic {
    /// h, Pa.
    pub value: f64,
    /// (∂h/∂z, ∂h/∂r), Pa/m; z points out of the half-space.
    pub gradient: [f64; 2],
    /// m = (2/r²) ∫₀^r h r' dr', Pa; h on the axis.
    pub disc_mean: f64,
    /// ∂m/∂z, Pa/m.
    pub disc_mean_along_z: f64,
}

/// The static stress of an elastic half-space under an axisymmetric pressure on its surface, without shear there.
///
/// Boussinesq's problem (1885) by one harmonic function (Love 1929, Phil. Trans. R. Soc. A 228, 377; Johnson 1985, *Contact
/// Mechanics*, § 3.2). With the depth d
///
/// σ_zz = −h − d ∂h/∂z, σ_zr = −d ∂h/∂r, σ_rr = −h + d ∂h/∂z + ((1 − 2ν) m − d ∂m/∂z)/2,
/// σ_φφ = −2ν h − ((1 − 2ν) m − d ∂m/∂z)/2.
///
/// - `depth`: below the surface, m. `poisson`: ν, from −1 to 1/2.
/// - result: the stresses, Pa, positive in tension; at rest. errors: none.
/// - tested by: Boussinesq's point force, a disc's pressure on the axis, equilibrium and compatible strains by differences.
pub fn half_space_stress(harmonic: &Harmonic, depth: f64, poisson: f64) -> ElasticState {
    let Harmonic { value, gradient: [along_z, along_r], disc_mean, disc_mean_along_z } = *harmonic;
    let across = 0.5 * ((1.0 - 2.0 * poisson) * disc_mean - depth * disc_mean_along_z);
    ElasticState {
        stress_zz: -value - depth * along_z,
        stress_zr: -depth * along_r,
        stress_rr: -value + depth * along_z + across,
        stress_phiphi: -2.0 * poisson * value - across,
        ..ElasticState::default()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    const NU: f64 = 0.29;

    /// Of a charge at the height η above the surface: h = 1/s, s² = (d + η)² + r².
    fn of_a_charge(height: f64, [z, r]: [f64; 2]) -> Harmonic {
        let along = height - z;
        let s = along.hypot(r);
        Harmonic {
            value: 1.0 / s,
            gradient: [along / s.powi(3), -r / s.powi(3)],
            disc_mean: 2.0 / (s + along),
            disc_mean_along_z: 2.0 / (s * (s + along)),
        }
    }

    /// Of a force of 1 N: h = d/(2π s³), the charge's derivative along the depth with η = 0.
    fn of_a_force([z, r]: [f64; 2]) -> Harmonic {
        let d = -z;
        let s = d.hypot(r);
        Harmonic {
            value: d / (TAU * s.powi(3)),
            gradient: [-(1.0 / s.powi(3) - 3.0 * d * d / s.powi(5)) / TAU, -3.0 * d * r / (TAU * s.powi(5))],
            disc_mean: 2.0 / (TAU * s * (s + d)),
            disc_mean_along_z: 2.0 / (TAU * s.powi(3)),
        }
    }

    #[test]
    fn a_force_has_the_stress_that_boussinesq_found() {
        for point in [[-0.3, 0.4], [-2.0, 0.1], [-0.05, 1.0]] {
            let [d, r]: [f64; 2] = [-point[0], point[1]];
            let s = d.hypot(r);
            let found = half_space_stress(&of_a_force(point), d, NU);
            let sideways = (1.0 - 2.0 * NU) / (s * (s + d));
            let want = [
                -3.0 * d.powi(3) / s.powi(5),
                3.0 * d * d * r / s.powi(5),
                sideways - 3.0 * r * r * d / s.powi(5),
                (1.0 - 2.0 * NU) * (d / s.powi(3)) - sideways,
            ]
            .map(|part| part / TAU);
            let found = [found.stress_zz, found.stress_zr, found.stress_rr, found.stress_phiphi];
            for (found, want) in found.into_iter().zip(want) {
                assert!((found - want).abs() < 1e-12 * (1.0 + want.abs()), "{found} {want}");
            }
        }
    }

    /// Under a uniform pressure on r < a, on the axis: h = p (1 − d/√(a² + d²)).
    #[test]
    fn beneath_a_disc_the_axis_has_its_stress() {
        for d in [0.0, 0.2, 1.0, 3.0_f64] {
            let s = d.hypot(1.0);
            let (value, along_z) = (1.0 - d / s, 1.0 / s.powi(3));
            let harmonic =
                Harmonic { value, gradient: [along_z, 0.0], disc_mean: value, disc_mean_along_z: along_z };
            let found = half_space_stress(&harmonic, d, NU);
            let zz = -(1.0 - (d / s).powi(3));
            let rr = -0.5 * ((1.0 + 2.0 * NU) - 2.0 * (1.0 + NU) * d / s + (d / s).powi(3));
            assert!((found.stress_zz - zz).abs() < 1e-14 && (found.stress_rr - rr).abs() < 1e-14, "{d}");
            assert!((found.stress_phiphi - rr).abs() < 1e-14, "{d}");
        }
    }

    #[test]
    fn it_is_in_equilibrium_and_its_strains_are_of_a_displacement() {
        let at = |z: f64, r: f64| half_space_stress(&of_a_charge(0.7, [z, r]), -z, NU);
        for [z, r] in [[-0.3, 0.4], [-1.0, 1.5], [-0.01, 0.8]] {
            let h = 1e-4;
            let along = |part: fn(&ElasticState) -> f64, z: [f64; 2], r: [f64; 2]| {
                (part(&at(z[1], r[1])) - part(&at(z[0], r[0]))) / (2.0 * h)
            };
            let (zz, rr) = ([z - h, z + h], [r - h, r + h]);
            let here = at(z, r);
            let axial =
                along(|w| w.stress_zz, zz, [r; 2]) + along(|w| w.stress_zr, [z; 2], rr) + here.stress_zr / r;
            let radial = along(|w| w.stress_zr, zz, [r; 2])
                + along(|w| w.stress_rr, [z; 2], rr)
                + (here.stress_rr - here.stress_phiphi) / r;
            assert!(axial.abs() < 1e-6 && radial.abs() < 1e-6, "({z}, {r}): {axial:e} {radial:e}");
            // E u_r/r = σ_φφ − ν(σ_zz + σ_rr), and ∂u_r/∂r is the radial strain.
            let displaced = |w: &ElasticState| w.stress_phiphi - NU * (w.stress_zz + w.stress_rr);
            let slope = (rr[1] * displaced(&at(z, rr[1])) - rr[0] * displaced(&at(z, rr[0]))) / (2.0 * h);
            let strain = here.stress_rr - NU * (here.stress_zz + here.stress_phiphi);
            assert!((slope - strain).abs() < 1e-6, "({z}, {r}): {slope} {strain}");
        }
        let surface = at(0.0, 0.6);
        assert_eq!(surface.stress_zr, 0.0);
        assert!((surface.stress_zz + 1.0 / 0.7_f64.hypot(0.6)).abs() < 1e-15);
    }
}
