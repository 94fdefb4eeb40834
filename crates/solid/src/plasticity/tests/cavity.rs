//! The spherical cavity under pressure, quasi-static (Hill 1950), by the return as the only source of stresses.

use super::STEEL;
use crate::plasticity::{Hardening, Plasticity, Stress};

/// A (Pa), H (Pa), p (Pa), c/a, u(a)/a, ε_p(a), of a steel of ρ = 7800 kg/m³, c₁ = 5990 m/s, c₂ = 3458 m/s.
const HILL: [[f64; 6]; 4] = [
    [4e8, 0.0, 4e8, 1.181360413, 0.001263462393, 0.001669009777],
    [4e8, 0.0, 1.2e9, 3.211270543, 0.04002691853, 0.08262562942],
    [4e8, 8e9, 4e8, 1.178585113, 0.00124855004, 0.001558967801],
    [4e8, 8e9, 4.8e8, 1.297074371, 0.001778236251, 0.002892684089],
];

/// Where on a sphere a cell lies, by its angle from the axis, has no influence: the stress of the deviatoric strain
/// D = u/r − u′ there, as q and plastic strain, and the difference of the normal stresses along and across the radius.
fn returned(plasticity: &Plasticity, d: f64, angle: f64) -> (f64, f64) {
    let mu = plasticity.mu();
    let (cos, sin) = (angle.cos(), angle.sin());
    // Deviatoric strain −2D/3 along the radius, D/3 across: D/3 I − D n n.
    let along = |a: f64, b: f64| 2.0 * mu * -d * a * b;
    let across = 2.0 * mu * d / 3.0;
    let trial = Stress {
        zz: across + along(cos, cos) - 3e8,
        zr: along(cos, sin),
        rr: across + along(sin, sin) - 3e8,
        phiphi: across - 3e8,
    };
    let (stress, strain) = plasticity
        .return_map(trial, 0.0, 0.0, 1.0)
        .map_or((trial, 0.0), |returned| (returned.stress, returned.strain));
    // The hoop stress less the one along the radius.
    let radial = stress.zz * cos * cos + 2.0 * stress.zr * cos * sin + stress.rr * sin * sin;
    (stress.phiphi - radial, strain)
}

#[test]
fn the_spherical_cavity_opens_as_hill_says() {
    let bulk = STEEL.lambda() + 2.0 / 3.0 * STEEL.shear_modulus();
    for [strength, hardening, pressure, c_over_a, displacement, wall_strain] in HILL {
        let law = Hardening::linear(strength, hardening).expect("a law");
        let plasticity = Plasticity::new(law, STEEL);
        let three_mu = 3.0 * STEEL.shear_modulus();
        // dq/dD behind the front.
        let slope = 2.0 * STEEL.shear_modulus() * hardening / (three_mu + hardening);
        for angle in [0.0, 0.4, 1.1] {
            // From compatibility and equilibrium, x = ln r: D′(1 + 2 q′(D)/(3K)) = −3D − 2q/K, σ_r′ = 2q, from the front,
            // where q = A and σ_r = −2A/3, to the wall.
            let right = |d: f64| {
                let (q, _) = returned(&plasticity, d, angle);
                (-(3.0 * d + 2.0 * q / bulk) / (1.0 + 2.0 * slope / (3.0 * bulk)), 2.0 * q)
            };
            let steps = 2000;
            let h = -f64::ln(c_over_a) / f64::from(steps);
            let (mut d, mut sigma_r) = (strength / (2.0 * STEEL.shear_modulus()), -2.0 / 3.0 * strength);
            for _ in 0..steps {
                let (a, s_a) = right(d);
                let (b, s_b) = right(d + 0.5 * h * a);
                let (c, s_c) = right(d + 0.5 * h * b);
                let (e, s_e) = right(d + h * c);
                d += h / 6.0 * (a + 2.0 * b + 2.0 * c + e);
                sigma_r += h / 6.0 * (s_a + 2.0 * s_b + 2.0 * s_c + s_e);
            }
            let (q, strain) = returned(&plasticity, d, angle);
            let dilatation = (sigma_r + 2.0 / 3.0 * q) / bulk;
            let errors = [
                -sigma_r / pressure - 1.0,
                (dilatation + d) / 3.0 / displacement - 1.0,
                strain / wall_strain - 1.0,
            ];
            println!("p {pressure:e}, angle {angle}: {errors:?}");
            // The front is given to ten digits.
            assert!(errors.iter().all(|error| error.abs() < 4e-9), "{errors:?}");
        }
    }
}
