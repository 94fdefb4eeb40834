//! What spreads in stages: orders where one step spreads over many cells, levels, conservation, threads.

use std::f64::consts::TAU;

use fluid::{
    Boundary, Conduction, FluidSetup, FluidSolver, NamedFluid, Phase, PhaseViscosity, Primitive, ThinGas,
    Viscosity, WallHeat,
};
use mesh::{Geometry, Limiter};

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
