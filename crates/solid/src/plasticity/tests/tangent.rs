//! The modulus that waves meet in a material that flows.

use approx::assert_relative_eq;

use super::{STEEL, laws};
use crate::plasticity::{Hardening, Plasticity, Stress};

/// Within the yield surface, elastic up to it along z.
fn strained(by: f64, from: Stress) -> Stress {
    let (along, across) = (STEEL.p_modulus() * by, STEEL.lambda() * by);
    Stress { zz: from.zz + along, rr: from.rr + across, phiphi: from.phiphi + across, ..from }
}

#[test]
fn behind_a_plane_wave_it_is_that_of_the_plastic_wave() {
    let mu = STEEL.shear_modulus();
    let bulk = STEEL.p_modulus() - 4.0 / 3.0 * mu;
    for modulus in [0.0, 8e9, 1e11] {
        let plasticity = Plasticity::new(Hardening::linear(4e8, modulus).expect("a law"), STEEL);
        let trial = strained(-4e-3, Stress::default());
        let end = plasticity.return_map(trial, 0.0, 0.0, 1e-9).expect("it flows");
        let exact = bulk + 4.0 / 3.0 * mu * modulus / (3.0 * mu + modulus);
        assert_relative_eq!(
            plasticity.tangent_modulus(STEEL.p_modulus(), &end, 1e-9),
            exact,
            max_relative = 1e-12
        );
    }
}

#[test]
fn it_is_the_slope_of_the_stress_over_the_strain() {
    const STEP: f64 = 1e-6;
    for hardening in laws() {
        let softens = hardening.softening().is_some();
        let plasticity = Plasticity::new(hardening, STEEL);
        let strength = plasticity.hardening().yield_stress(0.02, 0.0, 400.0);
        // Off the plane wave: some shear and hoop stress, scaled onto the yield surface.
        let shape = Stress { zz: -2.0, zr: 0.3, rr: 0.4, phiphi: 0.1 };
        let start = shape.with_deviator_times(strength / shape.von_mises_squared().sqrt());
        let at = |strain: f64| {
            plasticity.return_map(strained(strain, start), 0.02, 400.0, 1e-8).expect("it flows")
        };
        let [low, middle, high] = [-19.0, -20.0, -21.0].map(|steps| at(steps * STEP));
        let slope = (low.stress.zz - high.stress.zz) / (2.0 * STEP);
        let tangent = plasticity.tangent_modulus(STEEL.p_modulus(), &middle, 1e-8);
        // Turning the deviator within a finite step is not in the tangent; softening is left out of it.
        let tolerance = if softens { 2e-2 } else { 5e-3 };
        assert_relative_eq!(tangent, slope, max_relative = tolerance);
        let (lowest, highest) = (STEEL.p_modulus() - 4.0 / 3.0 * STEEL.shear_modulus(), STEEL.p_modulus());
        assert!(tangent >= lowest * (1.0 - 1e-12) && tangent < highest, "{tangent}");
    }
}
