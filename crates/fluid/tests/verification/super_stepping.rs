//! What spreads in stages: orders where one step spreads over many cells, levels, conservation, threads.

use std::f64::consts::{PI, TAU};

use fluid::{
    Boundary, Conduction, FluidSetup, FluidSolver, NamedFluid, Phase, PhaseViscosity, Primitive, ThinGas,
    Viscosity, WallHeat,
};
use mesh::{Adaptation, FaceState, Geometry, LevelBound, Limiter, Zone};

use crate::conduction::*;
use crate::conduction_media::{ball, laws};
use crate::helpers::*;

/// The diffusivity times the step, over what one step is stable with.
fn excess(d: f64, dt: f64, cells: usize) -> f64 {
    d * dt * 2.0 * (cells * cells) as f64 / 0.375
}

/// A wave of temperature that spreads over up to ten times as much as a step is stable with.
#[test]
fn waves_of_temperature_decay_in_stages() {
    let (d, k) = (20.0, TAU);
    let exact = |[z, r]: [f64; 2], t: f64| (-2.0 * d * k * k * t).exp() * (k * z).sin() * (k * r).cos();
    let end = 0.5 / (d * k * k);
    for kind in KINDS {
        let error = |cells: usize| {
            let mut setup = media(kind, PLANAR, [cells; 2], PERIODIC, [d; 2]);
            setup.conduction.as_mut().unwrap().thin_gas = ThinGas::SuperTimeStepping;
            let mut fluid =
                FluidSolver::<8>::from_fn(&setup, |x| warmer(Phase::Liquid, exact(x, 0.0))).unwrap();
            let start = fluid.totals();
            eprintln!("{:.1} times what a step is stable with", excess(d, fluid.time_step_limit(CFL), cells));
            run_to(&mut fluid, end);
            let kept = fluid.totals().energy / start.energy - 1.0;
            assert!(kept.abs() < 1e-14, "{kept:e}");
            error_of(&fluid, |x| exact(x, end))
        };
        let order = order(&format!("wave of temperature in stages, {:?}", kind.0), &[16, 32, 64].map(error));
        assert!(order > 1.9, "{order}");
    }
}

/// A shear wave likewise, and one of a tube that it sticks to.
#[test]
fn shear_waves_decay_in_stages() {
    let nu = 200.0;
    let liquid = PhaseViscosity { shear: 1000.0 * nu, bulk: 0.0 };
    let viscosity =
        Some(Viscosity { liquid, gas: PhaseViscosity::default(), thin_gas: ThinGas::SuperTimeStepping });
    let exact = |[z, _]: [f64; 2], t: f64| Primitive {
        v_r: 1e-3 * (-nu * TAU * TAU * t).exp() * (TAU * z).sin(),
        ..still(1e5)
    };
    let end = 1.0 / (nu * TAU * TAU);
    let error = |cells: usize| {
        let setup = FluidSetup { viscosity, limiter: Limiter::None, ..setup(PLANAR, [cells, 8], PERIODIC) };
        let mut fluid = FluidSolver::<8>::from_fn(&setup, |x| exact(x, 0.0)).unwrap();
        eprintln!(
            "{:.1} times what a step is stable with",
            excess(4.0 / 3.0 * nu, fluid.time_step_limit(CFL), cells)
        );
        run_to(&mut fluid, end);
        l1(&fluid, |x| exact(x, end), |w| [w.v_r])
    };
    let order_of_wave = order("shear wave in stages", &[16, 32, 64].map(error));
    assert!(order_of_wave > 1.9, "{order_of_wave}");
    // In a tube v_z = J0(kr) with J0(k) = 0 on its wall.
    let k = 2.404_825_557_695_773;
    let flow = |[_, r]: [f64; 2], t: f64| Primitive {
        v_z: 1e-3 * (-nu * k * k * t).exp() * j0(k * r),
        ..still(1e5)
    };
    let sides = [Boundary::Periodic, Boundary::Periodic, Boundary::Axis, Boundary::Wall];
    let end = 0.5 / (nu * k * k);
    let error = |cells: usize| {
        let setup = FluidSetup { viscosity, limiter: Limiter::None, ..setup(AXIAL, [8, cells], sides) };
        let mut fluid = FluidSolver::<8>::from_fn(&setup, |x| flow(x, 0.0)).unwrap();
        run_to(&mut fluid, end);
        l1(&fluid, |x| flow(x, end), |w| [w.v_z])
    };
    let order_of_tube = order("flow in a tube in stages", &[16, 32, 64].map(error));
    assert!(order_of_tube > 1.8, "{order_of_tube}");
}

/// Heat and momentum that spread over up to seven hundred times as much as a step is stable with, half of it on a finer level: as on one grid
/// with a common step, and with steps of their own nowhere beyond what there was at first.
#[test]
fn what_spreads_far_passes_between_levels() {
    let exact = |rate: f64, [z, r]: [f64; 2], t: f64| {
        (-2.0 * rate * TAU * TAU * t).exp() * (TAU * z).sin() * (TAU * r).cos()
    };
    let finer = LevelBound { zone: Zone::Box { z: [0.0, 0.49], r: [-1.0, 2.0] }, at_least: 1, at_most: 1 };
    let coarse = LevelBound { zone: Zone::Box { z: [0.51, 1.0], r: [-1.0, 2.0] }, at_least: 0, at_most: 0 };
    let adaptation = Some(Adaptation { bounds: vec![finer, coarse], ..Adaptation::by_details(1e3, 1 << 20) });
    let on_levels = |setup: FluidSetup| FluidSetup { levels: 1, adaptation: adaptation.clone(), ..setup };
    for (d, cells, steps) in [(10.0, 32, 12), (1000.0, 64, 40)] {
        let warm = || {
            let mut setup = media(SHARP, PLANAR, [cells; 2], PERIODIC, [d; 2]);
            setup.conduction.as_mut().unwrap().thin_gas = ThinGas::SuperTimeStepping;
            setup
        };
        let run = |setup: FluidSetup, is_local: bool| {
            let start = |x| warmer(Phase::Liquid, exact(d, x, 0.0));
            let mut fluid = FluidSolver::<8>::from_fn(&setup, start).unwrap();
            eprintln!("{:.0} times", excess(d, fluid.time_step_limit(CFL), cells));
            for _ in 0..steps {
                if is_local {
                    step_locally(&mut fluid);
                } else {
                    fluid.step_at(CFL).unwrap();
                }
            }
            fluid
        };
        let error = |fluid: &FluidSolver<8>| {
            let off = |(x, theta): ([f64; 2], f64)| (theta - exact(d, x, fluid.time())).abs();
            temperatures(fluid).into_iter().map(off).fold(0.0, f64::max)
        };
        let [one, two, local] =
            [(warm(), false), (on_levels(warm()), false), (on_levels(warm()), true)].map(|(s, l)| run(s, l));
        assert_jump_of_levels(&two);
        let errors = [&one, &two, &local].map(error);
        eprintln!("D = {d}: {errors:?}");
        assert!(errors[1..].iter().all(|error| *error < 2.0 * errors[0] + 5e-3), "{errors:?}");
        let most = temperatures(&local).into_iter().map(|(_, theta)| theta.abs()).fold(0.0, f64::max);
        assert!(most < 1.0, "{most}");
    }
    // Shear likewise: a wave along the jump of levels, and one across it.
    let nu = 1000.0;
    let liquid = PhaseViscosity { shear: 1000.0 * nu, bulk: 0.0 };
    let viscosity =
        Some(Viscosity { liquid, gas: PhaseViscosity::default(), thin_gas: ThinGas::SuperTimeStepping });
    let start = |[z, r]: [f64; 2]| Primitive {
        v_r: 1e-3 * (TAU * z).sin(),
        v_z: 1e-3 * (TAU * r).cos(),
        ..still(1e5)
    };
    for is_local in [false, true] {
        let setup = on_levels(FluidSetup { viscosity, ..setup(PLANAR, [64; 2], PERIODIC) });
        let mut fluid = FluidSolver::<8>::from_fn(&setup, start).unwrap();
        let (mut fastest, rate) = (vec![], nu * TAU * TAU);
        for _ in 0..40 {
            if is_local {
                step_locally(&mut fluid);
            } else {
                fluid.step_at(CFL).unwrap();
            }
            let mut most = 0.0_f64;
            each_cell(&fluid, |_, _, w| most = most.max(w.v_z.abs()).max(w.v_r.abs()));
            fastest.push(most);
        }
        let share = fastest[39] / (1e-3 * (-rate * fluid.time()).exp());
        eprintln!("shear, {is_local}: {share}");
        // Between levels with steps of their own passes too little, and it does not grow.
        let most = fastest.iter().fold(0.0_f64, |most, speed| most.max(*speed));
        assert!(most < if is_local { 1.1e-3 } else { 1e-3 } && fastest[39] < 0.5e-3, "{fastest:?}");
        assert!(is_local || (share - 1.0).abs() < 0.05, "{share}");
    }
}

/// Liquid at rest on a wall to the solid that begins to slide: momentum spreads over many cells in a step, the layer does not overtake the wall,
/// and the wall feels what it gets.
#[test]
fn a_wall_that_slides_drags_in_stages() {
    let (nu, speed) = (400.0, 1e-2);
    let liquid = PhaseViscosity { shear: 1000.0 * nu, bulk: 0.0 };
    let viscosity =
        Some(Viscosity { liquid, gas: PhaseViscosity::default(), thin_gas: ThinGas::SuperTimeStepping });
    let modes = || (0..40).map(|n| (f64::from(n) + 0.5) * PI);
    let exact = |z: f64, t: f64| {
        speed * (1.0 - modes().map(|k| 2.0 / k * (k * z).sin() * (-nu * k * k * t).exp()).sum::<f64>())
    };
    let shear_of =
        |t: f64| -1000.0 * nu * speed * modes().map(|k| 2.0 * (-nu * k * k * t).exp()).sum::<f64>();
    let sides = [Boundary::Interface, Boundary::Symmetry, Boundary::Periodic, Boundary::Periodic];
    let wall = FaceState { tangential_velocity: speed, ..[1e5, 0.0, 0.0].into() };
    let end = 0.3 / nu;
    for cells in [32, 64] {
        let setup = FluidSetup { viscosity, ..setup(PLANAR, [cells, 8], sides) };
        let mut fluid = FluidSolver::<8>::from_fn(&setup, |_| still(1e5)).unwrap();
        eprintln!(
            "{:.0} times what a step is stable with",
            excess(4.0 / 3.0 * nu, fluid.time_step_limit(CFL), cells)
        );
        let mut off = 0.0_f64;
        while fluid.time() < end * (1.0 - 1e-12) {
            let dt = fluid.time_step_limit(CFL).min(end - fluid.time());
            fluid.interface_mut().set_all(|_| wall);
            let shear = shear_on_wall(&fluid, dt);
            let expected = shear_of(fluid.time() + 0.5 * dt);
            if fluid.time() > 0.1 / nu {
                off = off.max((shear[3] / expected - 1.0).abs());
            }
            fluid.interface_mut().set_all(|face| FaceState { shear: shear[face], ..wall });
            fluid.step(dt).unwrap();
            // The first step's mean stress acts on what comes to go with the wall before its end.
            each_cell(&fluid, |_, _, w| assert!(w.v_r < 1.03 * speed, "{}", w.v_r));
        }
        let mut error = 0.0_f64;
        each_cell(&fluid, |[z, _], _, w| error = error.max((w.v_r - exact(z, end)).abs() / speed));
        eprintln!("{cells} cells: {error:.2e} of the wall's speed, {off:.2e} of the shear");
        assert!(error < 2e-3 && off < 0.03, "{error} {off}");
    }
}

/// A collapse of hot thin gas with all its viscosity and conductivity, on levels with steps of their own.
fn thin(geometry: Geometry, kind: Kind) -> FluidSolver<8> {
    let low = if geometry == Geometry::Axisymmetric { Boundary::Axis } else { Boundary::Symmetry };
    let law = if kind == MIXTURE { NamedFluid::of("water-2.35").unwrap().law } else { laws()[0] };
    let thin_gas = ThinGas::SuperTimeStepping;
    let setup = FluidSetup {
        liquid: law,
        gas: laws()[1],
        viscosity: Some(Viscosity {
            liquid: PhaseViscosity { shear: 2e3, bulk: 1e3 },
            gas: PhaseViscosity { shear: 50.0, bulk: 0.0 },
            thin_gas,
        }),
        conduction: Some(Conduction { liquid: 6e6, gas: 3e4, thin_gas, wall: WallHeat::Isothermal(310.0) }),
        levels: 1,
        adaptation: Some(refined_ball()),
        ..setup_of(kind, geometry, [16, 16], [Boundary::Wall, Boundary::Symmetry, low, Boundary::Wall])
    };
    let mut initial = ball(([0.4, 0.0], 0.25), [5e6, 300.0], [1e4, 900.0], 0.0);
    initial.ambient.density = law.density_at(5e6, 300.0).unwrap();
    FluidSolver::<8>::new(&setup, &initial).unwrap()
}

#[test]
fn ledgers_close_in_stages() {
    for (kind, geometry) in KINDS.into_iter().flat_map(|kind| [(kind, AXIAL), (kind, PLANAR)]) {
        let mut fluid = thin(geometry, kind);
        let start = fluid.totals();
        run_locally(&mut fluid, 160);
        let (imbalance, fixups) = (imbalance_since(&fluid, &start), fluid.fixups());
        assert_balanced(&format!("{kind:?} {geometry:?}"), &imbalance, &fluid);
        assert_eq!(fixups.clips.bounded_viscosities + fixups.clips.bounded_conductivities, 0);
        assert!(fluid.ledger().energy[0] != 0.0, "the wall takes heat");
    }
}

/// What does not spread over more than a cell in a step takes no stages, and is what it is without them to the last bit.
#[test]
fn stages_are_taken_only_where_they_are_needed() {
    let run = |thin_gas| {
        let mut setup = media(SHARP, PLANAR, [32; 2], WALLS, [0.01, 0.02]);
        setup.conduction.as_mut().unwrap().thin_gas = thin_gas;
        let start = |[z, r]: [f64; 2]| warmer(if z < 0.5 { Phase::Liquid } else { Phase::Gas }, z * r);
        let mut fluid = FluidSolver::<8>::from_fn(&setup, start).unwrap();
        run_steps(&mut fluid, 20);
        fluid.state().clone()
    };
    assert_eq!(run(ThinGas::Resolved), run(ThinGas::SuperTimeStepping));
}
