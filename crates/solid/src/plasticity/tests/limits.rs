//! Ends of ranges, and what is refused.

use approx::assert_relative_eq;

use super::{ALUMINIUM, STEEL, aluminium, copper, laws};
use crate::plasticity::{
    Hardening, JohnsonCook, Plasticity, PlasticityError, RateFactor, Stress, Table, ThermalSoftening,
};

const TRIAL: Stress = Stress { zz: -9e8, zr: 1e8, rr: -2e8, phiphi: -1e8 };

#[test]
fn a_molten_cell_has_no_strength_at_any_rate() {
    let plasticity = Plasticity::new(Hardening::JohnsonCook(aluminium(1.34)), ALUMINIUM);
    for (temperature, dt) in [(925.0, 1e-9), (1100.0, 1e-9), (3000.0, 1e-15), (1e6, 0.0), (925.0, 1.0)] {
        let returned = plasticity.return_map(TRIAL, 0.1, temperature, dt).expect("it flows");
        assert_eq!(returned.von_mises, 0.0);
        assert_eq!((returned.stress.zr, returned.stress.zz), (0.0, returned.stress.phiphi));
        assert_relative_eq!(returned.stress.mean(), TRIAL.mean(), max_relative = 1e-15);
        let all = TRIAL.von_mises_squared().sqrt() / (3.0 * plasticity.mu());
        assert_relative_eq!(returned.increment, all, max_relative = 1e-15);
        assert_eq!(returned.temperature, temperature);
    }
    let at = |temperature| plasticity.hardening().yield_stress(0.1, f64::INFINITY, temperature);
    assert_eq!(at(925.0), 0.0);
    assert!(at(924.0) == f64::INFINITY);
    let cold = plasticity.hardening().yield_stress(0.1, 0.0, 100.0);
    assert_eq!(cold, plasticity.hardening().yield_stress(0.1, 0.0, 293.0));
}

#[test]
fn no_time_lets_no_law_with_rate_flow() {
    for hardening in laws() {
        let rate = hardening.rate().is_some();
        let plasticity = Plasticity::new(hardening, STEEL);
        let still = plasticity.return_map(TRIAL, 1e-3, 293.0, 0.0);
        assert_eq!(still.is_none(), rate);
        if let Some(returned) = still {
            assert_eq!(Some(returned), plasticity.return_map(TRIAL, 1e-3, 293.0, 1e-9));
        }
    }
    // The limit from above is the same.
    let plasticity = Plasticity::new(Hardening::JohnsonCook(copper()), STEEL);
    let nearly = plasticity.return_map(TRIAL, 1e-3, 298.0, 1e-300).expect("it flows");
    assert!(nearly.increment < 1e-150, "{nearly:?}");
    assert_relative_eq!(nearly.stress.zz, TRIAL.zz, max_relative = 1e-15);
}

#[test]
fn a_tiny_exponent_and_a_table_of_one_point_are_perfect_plasticity() {
    let perfect = Plasticity::new(Hardening::perfect(3e8).expect("a law"), STEEL);
    let expected = perfect.return_map(TRIAL, 0.01, 0.0, 1e-9).expect("it flows");
    let flat = JohnsonCook::new(1e8, 2e8, f64::MIN_POSITIVE).expect("a law");
    for hardening in [
        Hardening::JohnsonCook(flat),
        Hardening::Table(Table::new(&[[0.0, 3e8]]).expect("a table")),
        Hardening::Table(Table::new(&[[1.0, 3e8]]).expect("a table")),
    ] {
        let returned =
            Plasticity::new(hardening, STEEL).return_map(TRIAL, 0.01, 0.0, 1e-9).expect("it flows");
        assert_relative_eq!(returned.increment, expected.increment, max_relative = 1e-14);
        assert_relative_eq!(returned.stress.zz, expected.stress.zz, max_relative = 1e-14);
    }
    // From no plastic strain the curve of a tiny exponent rises at once, above any stress below A + B.
    let rising =
        Plasticity::new(Hardening::JohnsonCook(JohnsonCook::new(1e8, 2e8, 1e-6).expect("a law")), STEEL);
    let trial = Stress { zr: 2e8 / 3f64.sqrt(), ..Stress::default() };
    let returned = rising.return_map(trial, 0.0, 0.0, 1e-9).expect("it flows");
    assert!(returned.increment < 1e-300 && (returned.von_mises - 2e8).abs() < 1.0, "{returned:?}");
}

#[test]
fn a_stress_on_the_surface_and_one_that_is_no_number_stay() {
    for hardening in laws() {
        let strength = hardening.yield_stress(0.02, 0.0, 293.0);
        let plasticity = Plasticity::new(hardening, STEEL);
        let trial = Stress { zz: strength, ..Stress::default() };
        assert_eq!(plasticity.return_map(trial, 0.02, 293.0, 1e-9), None);
        let lost = Stress { zz: f64::NAN, ..trial };
        assert_eq!(plasticity.return_map(lost, 0.02, 293.0, 1e-9), None);
    }
}

#[test]
fn slopes_are_differences_of_the_flow_stress() {
    for hardening in laws() {
        let (strain, rate, temperature) = (0.03, 2e3, 400.0);
        let flow = hardening.flow(strain, rate, temperature);
        let reference = hardening.reference_temperature().unwrap_or(0.0);
        let step = 1e-5_f64;
        let slope = |f: &dyn Fn(f64) -> f64| (f(step.exp()) - f((-step).exp())) / (2.0 * step);
        let by_strain = slope(&|x| hardening.yield_stress(strain * x, rate, temperature));
        let by_rate = slope(&|x| hardening.yield_stress(strain, rate * x, temperature));
        let by_rise =
            slope(&|x| hardening.yield_stress(strain, rate, reference + (temperature - reference) * x));
        for (is, should) in
            [(flow.per_log_strain, by_strain), (flow.per_log_rate, by_rate), (flow.per_log_rise, by_rise)]
        {
            assert!((is - should).abs() < 1e-8 * flow.stress, "{hardening:?}: {is} for {should}");
        }
    }
    let copper = Hardening::JohnsonCook(copper()).yield_stress(0.2, 1e4, 500.0);
    let expected = (90e6 + 292e6 * 0.2_f64.powf(0.31))
        * (1.0 + 0.025 * 1e4_f64.ln())
        * (1.0 - (202.0_f64 / 1058.0).powf(1.09));
    assert_relative_eq!(copper, expected, max_relative = 1e-15);
}

#[test]
fn constants_out_of_range_are_refused_by_name() {
    let softening = |m, melting, reference, heat_capacity, share| {
        ThermalSoftening::new(m, melting, reference, heat_capacity, share).err()
    };
    let table = |points: &[[f64; 2]]| Table::new(points).err();
    for (error, word) in [
        (Hardening::perfect(0.0).err(), "yield_strength"),
        (Hardening::perfect(f64::NAN).err(), "yield_strength"),
        (Hardening::perfect(f64::INFINITY).err(), "yield_strength"),
        (Hardening::linear(-1.0, 0.0).err(), "yield_strength"),
        (Hardening::linear(1e8, -1.0).err(), "hardening_modulus"),
        (JohnsonCook::new(-1e8, 0.0, 0.5).err(), "yield_strength"),
        (JohnsonCook::new(1e8, -1.0, 0.5).err(), "hardening_modulus"),
        (JohnsonCook::new(1e8, 1e8, 0.0).err(), "hardening_exponent"),
        (JohnsonCook::new(1e8, 1e8, 1.1).err(), "hardening_exponent"),
        (RateFactor::new(-0.1, 1.0).err(), "rate_coefficient"),
        (RateFactor::new(0.1, 0.0).err(), "reference_rate"),
        (softening(0.0, 900.0, 300.0, 900.0, 0.9), "softening_exponent"),
        (softening(1.0, f64::NAN, 300.0, 900.0, 0.9), "melting_temperature"),
        (softening(1.0, 300.0, 300.0, 900.0, 0.9), "melting_temperature"),
        (softening(1.0, 900.0, -1.0, 900.0, 0.9), "reference_temperature"),
        (softening(1.0, 900.0, 300.0, 0.0, 0.9), "heat_capacity"),
        (softening(1.0, 900.0, 300.0, 900.0, 1.1), "taylor_quinney"),
        (softening(1.0, 900.0, 300.0, 900.0, -0.1), "taylor_quinney"),
        (table(&[]), "at least one point"),
        (table(&[[0.0, -1.0]]), "point 1"),
        (table(&[[-0.1, 1e8]]), "point 1"),
        (table(&[[0.0, 1e8], [f64::NAN, 1e8]]), "point 2"),
        (table(&[[0.0, 1e8], [0.0, 2e8]]), "point 2"),
        (table(&[[0.0, 2e8], [0.1, 2e8], [0.2, 1e8]]), "point 3"),
    ] {
        let error: PlasticityError = error.expect(word);
        assert!(error.to_string().contains(word), "{word}: {error}");
    }
}
