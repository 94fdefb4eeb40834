//! What a solid says of waves that are about to come out of its surface.

use mesh::{Domain, Geometry};
use solid::{Boundary, ComingWaves, ElasticState, SolidSetup, SolidSolver};

use crate::helpers::*;

/// What is told of a plane state, σ_zz and v_z of z, in planar solids of 1 m that end at r = `end`.
fn told(end: f64, state: impl Fn(f64) -> [f64; 2] + Sync) -> ComingWaves {
    let sides = [Boundary::NonReflecting, Boundary::Interface, Boundary::Symmetry, Boundary::Symmetry];
    let domain = Domain { geometry: Geometry::Planar, z: [-1.0, 0.0], r: [end - 1.0, end] };
    let setup = SolidSetup { domain, ..setup(PLANAR, [32, 32], sides) };
    let initial = |[z, _]: [f64; 2]| {
        let [stress_zz, v_z] = state(z);
        ElasticState { stress_zz, v_z, ..ElasticState::default() }
    };
    let mut solid = SolidSolver::<16>::new(setup, initial).unwrap();
    // After a step, as nothing that begins has moved before.
    solid.step_at(1e-6).unwrap();
    let cell = 1.0 / 32.0 / solid.setup().speeds.c1;
    solid.coming_waves(20.0 * cell, 8.0 * cell, |_| 1.0)
}

fn impedance() -> f64 {
    setup(PLANAR, [32, 32], PERIODIC).speeds.z1()
}

#[test]
fn waves_that_run_upwards_are_told_wherever_the_domain_is() {
    let narrow = |z: f64| 1e3 * (-((z + 0.3) / 0.05).powi(2)).exp();
    for end in [1.0, 0.5, 0.0] {
        let [shortest, ..] = told(end, |z| [-narrow(z), narrow(z) / impedance()]);
        assert!(shortest[0] > 0.0 && shortest[1] == 1.0, "{end}: {shortest:?}");
    }
}

#[test]
fn what_runs_down_or_stands_is_not() {
    let narrow = |z: f64| 1e3 * (-((z + 0.3) / 0.05).powi(2)).exp();
    assert_eq!(told(1.0, |z| [-narrow(z), -narrow(z) / impedance()]), ComingWaves::default());
    assert_eq!(told(1.0, |z| [-narrow(z), 0.0]), ComingWaves::default());
    assert_eq!(told(1.0, |z| [-1e3 * z, 0.0]), ComingWaves::default());
}
