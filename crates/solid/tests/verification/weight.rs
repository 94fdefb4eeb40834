//! The solid's own weight: at rest, and in free fall.

use mesh::{Adaptation, LevelBound, Zone};
use solid::{Boundary, ElasticState, SolidSetup, SolidSolver, Weight};

use crate::helpers::*;

/// So strong that what is wrong shows within a few steps.
const STRONG: Weight = Weight { acceleration: -1e6, level: 1.0 };

fn setup_with(weight: Weight, sides: [Boundary; 4]) -> SolidSetup {
    let (centre, radius) = ([0.5, 0.0], 0.2);
    let within = LevelBound { zone: Zone::Within { centre, radius }, at_least: 1, at_most: 1 };
    let beyond = LevelBound { zone: Zone::Beyond { centre, radius }, at_least: 0, at_most: 0 };
    SolidSetup {
        weight: Some(weight),
        levels: 1,
        adaptation: Some(Adaptation { bounds: vec![within, beyond], ..Adaptation::by_details(1.0, 4) }),
        ..setup(AXIAL, [32, 32], sides)
    }
}

/// The fastest motion, over what it would be in free fall, and the largest change of σ_zz, over that from top to bottom.
fn unrest(solid: &SolidSolver<8>, at_rest: impl Fn([f64; 2]) -> ElasticState) -> [f64; 2] {
    let mut largest = [0.0_f64; 2];
    each_cell(solid, |centre, w| {
        let speed = w.v_z.hypot(w.v_r) / (STRONG.acceleration.abs() * solid.time());
        let change = (w.stress_zz - at_rest(centre).stress_zz).abs();
        largest = [largest[0].max(speed), largest[1].max(change / at_rest([0.0, 0.0]).stress_zz.abs())];
    });
    largest
}

#[test]
fn it_rests_under_its_weight_to_round_off() {
    for bottom in [Boundary::NonReflecting, Boundary::Absorbing] {
        let sides = [bottom, Boundary::Free, Boundary::Axis, Boundary::Symmetry];
        for (step, how) in [(step_together as fn(&mut _) -> _, "together"), (step_locally, "locally")] {
            let setup = setup_with(STRONG, sides);
            let density = setup.speeds.density;
            let at_rest = |[z, _]: [f64; 2]| ElasticState {
                stress_zz: STRONG.stress(density, z),
                ..ElasticState::default()
            };
            let mut solid = SolidSolver::<8>::new(setup, at_rest).unwrap();
            let [coarsest, finest] = solid.mesh().levels_present();
            assert!(coarsest < finest, "there is a jump of levels");
            while solid.steps() < 300 {
                step(&mut solid);
            }
            let [speed, change] = unrest(&solid, at_rest);
            eprintln!("{bottom:?} {how}: {speed:.1e} of free fall, {change:.1e} of the stress");
            assert!(speed < 1e-13 && change < 1e-13, "{bottom:?} {how}: {speed:e} {change:e}");
        }
    }
}

#[test]
fn it_falls_freely() {
    let periodic = [Boundary::Periodic, Boundary::Periodic, Boundary::Axis, Boundary::Symmetry];
    let setup = SolidSetup { levels: 0, adaptation: None, ..setup_with(STRONG, periodic) };
    let mut solid = SolidSolver::<8>::new(setup, |_| ElasticState::default()).unwrap();
    for _ in 0..50 {
        step_together(&mut solid);
    }
    let fallen = STRONG.acceleration * solid.time();
    each_cell(&solid, |_, w| {
        approx::assert_relative_eq!(w.v_z, fallen, max_relative = 1e-13);
        assert!(w.stress_zz == 0.0 && w.v_r == 0.0, "{w:?}");
    });
}
