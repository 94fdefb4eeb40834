//! Gravity: liquid at rest under its own weight, free fall, the limit on the step.

use fluid::{Boundary, FluidSetup, FluidSolver, Gravity, Primitive};
use mesh::{Adaptation, LevelBound, Zone};

use crate::helpers::*;

/// So strong that what is wrong shows within a few steps: 1 GPa over the metre that the domain is high.
const STRONG: Gravity = Gravity { acceleration: -1e6, level: 1.0 };

/// Liquid at rest under p = p₀ + ρg(z − z₀).
fn hydrostatic(gravity: Gravity) -> impl Fn([f64; 2]) -> Primitive + Sync {
    move |[z, _]| still(1e5 + gravity.head(1000.0, z))
}

/// The largest velocity, over what the liquid would gain in the time by falling; and the largest change of pressure, over that from
/// top to bottom.
fn unrest(fluid: &FluidSolver<8>, gravity: Gravity) -> [f64; 2] {
    let mut largest = [0.0_f64; 2];
    each_cell(fluid, |centre, _, w| {
        let speed = w.v_z.hypot(w.v_r) / (gravity.acceleration.abs() * fluid.time());
        let change = w.pressure - hydrostatic(gravity)(centre).pressure;
        largest = [largest[0].max(speed), largest[1].max(change.abs() / gravity.head(1000.0, 0.0))];
    });
    largest
}

/// A finer level within a ball on the axis, and nowhere else.
fn refined() -> Adaptation {
    let (centre, radius) = ([0.5, 0.0], 0.2);
    let within = LevelBound { zone: Zone::Within { centre, radius }, at_least: 1, at_most: 1 };
    let beyond = LevelBound { zone: Zone::Beyond { centre, radius }, at_least: 0, at_most: 0 };
    Adaptation { bounds: vec![within, beyond], ..Adaptation::by_details(1.0, 4) }
}

#[test]
fn liquid_rests_under_its_weight_to_round_off() {
    let open = [Boundary::NonReflecting, Boundary::NonReflecting, Boundary::Axis, Boundary::Wall];
    for (kind, sides) in KINDS.into_iter().flat_map(|kind| [(kind, CYLINDER), (kind, open)]) {
        for local in [false, true] {
            let setup = FluidSetup {
                gravity: Some(STRONG),
                levels: 1,
                adaptation: Some(refined()),
                ..setup_of(kind, AXIAL, [32, 32], sides)
            };
            let mut fluid = FluidSolver::<8>::from_fn(&setup, hydrostatic(STRONG)).unwrap();
            let [coarsest, finest] = fluid.mesh().levels_present();
            assert!(coarsest < finest, "there is a jump of levels in the liquid");
            while fluid.steps() < 300 {
                let _ = if local { step_locally(&mut fluid) } else { step_together(&mut fluid) };
            }
            let [speed, change] = unrest(&fluid, STRONG);
            eprintln!("{kind:?} {sides:?} {local}: {speed:.1e} of free fall, {change:.1e} of the head");
            // Pressures of 1e9 Pa are kept to 1e-16 of themselves; a wall that took the pressure for even gives 1e-2.
            assert!(speed < 1e-14 && change < 1e-14, "{kind:?} {sides:?} {local}: {speed:e} {change:e}");
        }
    }
}

#[test]
fn what_the_case_fills_rests_too() {
    let gravity = Gravity { level: 0.0, ..STRONG };
    let setup = FluidSetup { gravity: Some(gravity), ..setup_of(SHARP, AXIAL, [32, 32], CYLINDER) };
    let state = |pressure| fluid::PhaseState {
        phase: fluid::Phase::Liquid,
        density: 1000.0,
        pressure,
        velocity: [0.0; 2],
    };
    let initial = fluid::InitialCondition {
        ambient: state(2e9),
        pressure: fluid::InitialPressure::Uniform,
        regions: vec![],
        pulses: vec![],
    };
    let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
    approx::assert_relative_eq!(fluid.cell(0, 0, 0).pressure, 2e9 - 1e9 / 64.0, max_relative = 1e-12);
    let mut on_wall = vec![];
    fluid.first_wall_face_pressures(&mut on_wall);
    assert!(on_wall.len() == 32 && on_wall.iter().all(|p| (p / 2e9 - 1.0).abs() < 1e-12), "{on_wall:?}");
    run_steps(&mut fluid, 100);
    each_cell(&fluid, |_, _, w| assert!(w.v_z.abs() < 1e-11 * 1e6 * fluid.time(), "{w:?}"));
}

/// Gas and liquid fall alike, whatever the interface does in between.
#[test]
fn a_bubble_and_the_liquid_about_it_fall_freely() {
    let gravity = Gravity { acceleration: -9.81, level: 0.0 };
    for kind in KINDS {
        let setup = FluidSetup { gravity: Some(gravity), ..setup_of(kind, PLANAR, [32, 32], PERIODIC) };
        let start = |[z, r]: [f64; 2]| {
            let is_gas = (z - 0.5).hypot(r - 0.5) < 0.25;
            let (density, phi) = if is_gas { (1.2, 1.0) } else { (1000.0, 0.0) };
            Primitive { density, v_z: 40.0, v_r: 0.0, pressure: 1e5, phi }
        };
        let mut fluid = FluidSolver::<8>::from_fn(&setup, start).unwrap();
        run_steps(&mut fluid, 400);
        let fallen = 40.0 - 9.81 * fluid.time();
        let mut worst = [0.0_f64; 3];
        each_cell(&fluid, |_, _, w| {
            let errors = [(w.v_z - fallen) / 40.0, w.v_r / 40.0, w.pressure / 1e5 - 1.0];
            (0..3).for_each(|k| worst[k] = worst[k].max(errors[k].abs()));
        });
        eprintln!("{kind:?}: {worst:?} of v_z, v_r, p");
        // The bubble has moved by several cells. Energies of 3e8 J/m³ leave the gas's 1e5 Pa nine digits.
        assert!(40.0 * fluid.time() > 0.1, "{}", fluid.time());
        assert!(worst[0] < 1e-10 && worst[1] < 1e-10 && worst[2] < 1e-9, "{kind:?}: {worst:?}");
    }
}

#[test]
fn nothing_falls_through_a_cell_in_a_step() {
    let gravity = Gravity { acceleration: -1e12, level: 1.0 };
    let setup = FluidSetup { gravity: Some(gravity), ..setup(AXIAL, [16, 16], CYLINDER) };
    let fluid = FluidSolver::<8>::from_fn(&setup, |_| still(1e5)).unwrap();
    approx::assert_relative_eq!(fluid.time_step_limit(CFL), (2.0 / 16.0 / 1e12_f64).sqrt());
}
