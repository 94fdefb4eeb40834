//! What holds for any state.

use super::{Dice, in_steel};
use crate::plasticity::{Hardening, Returned, project_to_yield};

/// Any state: trial stress, plastic strain, temperature, time step.
fn state(dice: &mut Dice) -> (crate::plasticity::Stress, f64, f64, f64) {
    let stress = dice.stress();
    let strain = if dice.unit() < 0.2 { 0.0 } else { dice.power(-15.0, 1.0) };
    let temperature = 200.0 + 1400.0 * dice.unit();
    let dt = if dice.unit() < 0.05 { 0.0 } else { dice.power(-16.0, 1.0) };
    (stress, strain, temperature, dt)
}

/// How far the flow stress is known: to rounding of what it depends on.
fn known_to(hardening: &Hardening, returned: &Returned, rate: f64) -> f64 {
    let flow = hardening.flow(returned.strain, rate, returned.temperature);
    let rise = returned.temperature - hardening.reference_temperature().unwrap_or(0.0);
    let by_heat =
        if rise > 0.0 { (flow.per_log_rise / rise).abs() * f64::EPSILON * returned.temperature } else { 0.0 };
    1e-12 * flow.stress + by_heat
}

#[test]
fn any_state_returns_to_the_yield_surface_and_dissipates() {
    let mut dice = Dice::new(23);
    let (mut flowed, mut off) = (0, 0.0_f64);
    for (hardening, plasticity) in in_steel() {
        for _ in 0..40_000 {
            let (trial, strain, temperature, dt) = state(&mut dice);
            let said = format!("{hardening:?} {trial:?} {strain:e} {temperature} {dt:e}");
            let Some(returned) = plasticity.return_map(trial, strain, temperature, dt) else {
                let still = dt == 0.0 && hardening.rate().is_some();
                let bound = hardening.yield_stress(strain, 0.0, temperature);
                assert!(still || trial.von_mises_squared().sqrt() <= bound, "{said}");
                continue;
            };
            flowed += 1;
            let numbers =
                [returned.stress.zz, returned.stress.zr, returned.stress.rr, returned.stress.phiphi];
            assert!(numbers.iter().all(|number| number.is_finite()), "{said}");
            assert!(returned.temperature.is_finite() && returned.temperature >= temperature, "{said}");
            assert!(returned.increment >= 0.0 && returned.strain == strain + returned.increment, "{said}");
            assert!(returned.plastic_work >= 0.0, "{said}");

            let size = trial.zz.abs().max(trial.rr.abs()).max(trial.phiphi.abs());
            assert!((returned.stress.mean() - trial.mean()).abs() <= 4.0 * f64::EPSILON * size, "{said}");
            let q = returned.stress.von_mises_squared().sqrt();
            let rounding = 8.0 * f64::EPSILON * size;
            assert!((q - returned.von_mises).abs() <= rounding + 1e-15 * q, "{said}");

            let rate = if returned.increment == 0.0 { 0.0 } else { returned.increment / dt };
            let strength = hardening.yield_stress(returned.strain, rate, returned.temperature);
            let tolerance = known_to(&hardening, &returned, rate);
            assert!(returned.von_mises <= strength + tolerance, "{} {strength} {said}", returned.von_mises);
            // On it, but where the law jumps between one increment and the next number.
            let jumps = returned.increment < 1e-300;
            assert!(jumps || returned.von_mises >= strength - tolerance, "{strength} {returned:?} {said}");
            if strength > 0.0 && !jumps {
                off = off.max((returned.von_mises - strength).abs() / (1e-12 * strength).max(tolerance));
            }
            let drop = trial.von_mises_squared().sqrt() - returned.von_mises;
            let flow_rule = 3.0 * plasticity.mu() * returned.increment;
            assert!((drop - flow_rule).abs() <= 1e-12 * trial.von_mises_squared().sqrt(), "{said}");
        }
    }
    println!("{flowed} flowed, off the surface by {off:.2} of the tolerance");
    assert!(flowed > 100_000, "{flowed}");
}

#[test]
fn the_deviator_loses_the_plastic_work_and_what_the_trial_was_beyond() {
    let mut dice = Dice::new(5);
    for (_, plasticity) in in_steel() {
        for _ in 0..1000 {
            let (trial, strain, temperature, dt) = state(&mut dice);
            let Some(returned) = plasticity.return_map(trial, strain, temperature, dt) else { continue };
            let mu = plasticity.mu();
            let lost = trial.deviatoric_energy(mu) - returned.stress.deviatoric_energy(mu);
            let size = trial.zz.abs().max(trial.rr.abs()).max(trial.phiphi.abs());
            let rounding = size * trial.von_mises_squared().sqrt() / mu;
            let beyond = 1.5 * mu * returned.increment * returned.increment;
            let apart = lost - returned.plastic_work - beyond;
            assert!(apart.abs() <= 16.0 * f64::EPSILON * rounding, "{returned:?}");
        }
    }
}

#[test]
fn a_projection_acts_outside_the_surface_only() {
    let mut dice = Dice::new(7);
    for _ in 0..10_000 {
        let (stress, strength) = (dice.stress(), dice.power(4.0, 9.0));
        let q = stress.von_mises_squared().sqrt();
        let (projected, acted) = project_to_yield(stress, strength);
        assert_eq!(acted, q > strength);
        if !acted {
            assert_eq!(projected, stress);
            continue;
        }
        let size = stress.zz.abs().max(stress.rr.abs()).max(stress.phiphi.abs());
        let after = projected.von_mises_squared().sqrt();
        assert!((after - strength).abs() <= 8.0 * f64::EPSILON * size + 1e-15 * strength, "{stress:?}");
        assert!((projected.mean() - stress.mean()).abs() <= 4.0 * f64::EPSILON * size);
    }
    let none = project_to_yield(dice.stress(), 0.0).0;
    assert!(none.zr == 0.0 && none.zz == none.rr && none.rr == none.phiphi);
}
