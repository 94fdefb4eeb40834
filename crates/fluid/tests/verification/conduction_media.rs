//! Conduction where gas and liquid meet: equilibrium, a ball that cools, levels, ledgers, limits.

use std::f64::consts::PI;

use fluid::{
    Boundary, Conduction, FluidSetup, FluidSolver, Heat, InitialCondition, NamedFluid, NobleAbelStiffenedGas,
    PhaseViscosity, ThinGas, Viscosity, WallHeat,
};
use mesh::Geometry;

use crate::helpers::*;

pub fn laws() -> [NobleAbelStiffenedGas; 2] {
    ["water-nasg", "air"].map(|name| NamedFluid::of(name).unwrap().law)
}

const P: f64 = 1e5;

/// A ball of gas in liquid, both with a pressure and a temperature of their own, moving along z.
pub fn ball(place: ([f64; 2], f64), liquid: [f64; 2], gas: [f64; 2], velocity: f64) -> InitialCondition {
    ball_of_laws(laws(), place, [liquid, gas], velocity)
}

fn conducting(liquid: f64, gas: f64) -> Option<Conduction> {
    Some(Conduction { liquid, gas, thin_gas: ThinGas::Bounded, wall: WallHeat::Adiabatic })
}

fn setup(geometry: Geometry, cells: [usize; 2], sides: [Boundary; 4]) -> FluidSetup {
    let [liquid, gas] = laws();
    FluidSetup { liquid, gas, conduction: conducting(6e5, 3e4), ..setup_of(SHARP, geometry, cells, sides) }
}

/// Gas and liquid of one temperature and one pressure stay as they are, at rest and moving.
#[test]
fn nothing_comes_of_equilibrium() {
    let along = [Boundary::Periodic, Boundary::Periodic, Boundary::Axis, Boundary::Wall];
    let run = |velocity: f64, steps: usize, conduction: Option<Conduction>| {
        let initial = ball(([0.4, 0.0], 0.25), [P, 300.0], [P, 300.0], velocity);
        let setup = FluidSetup { conduction, ..setup(AXIAL, [32, 32], along) };
        let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
        run_steps(&mut fluid, steps);
        let mut worst = [0.0_f64; 2];
        let snapshot = fluid.snapshot();
        let cells = snapshot.pressure.iter().zip(&snapshot.temperature).zip(&snapshot.gas_fraction);
        for ((p, t), phi) in cells {
            worst[0] = worst[0].max((p / P - 1.0).abs());
            let is_trace = (*phi != 0.0 && *phi < 1e-3) || (*phi > 1.0 - 1e-3 && *phi != 1.0);
            worst[1] = worst[1].max(if is_trace { 0.0 } else { (t / 300.0 - 1.0).abs() });
        }
        let d = conduction.map_or(0.0, |conduction| conduction.liquid) / 3.8e6 * fluid.time_step_limit(CFL);
        eprintln!("{velocity} m/s, D dt/h2 = {:.1e}: dp/p, dT/T {}", d * 1024.0, scientific(&worst));
        worst
    };
    assert!(run(0.0, 200, conducting(6e5, 3e4)).iter().all(|worst| *worst < 1e-9));
    let without = run(20.0, 2000, None);
    for scale in [0.03, 0.3] {
        let with = run(20.0, 2000, conducting(scale * 6e5, scale * 3e4));
        assert!(with[0] < 1e-3, "{with:?} {without:?}");
    }
}

/// Mass, axial momentum and energy change by what the sides pass, with levels, their own steps, and gas that is too thin.
#[test]
fn ledgers_close_with_levels_and_their_own_steps() {
    let mixed = NamedFluid::of("water-2.35").unwrap().law;
    for (kind, geometry) in KINDS.into_iter().flat_map(|kind| [(kind, AXIAL), (kind, PLANAR)]) {
        let low = if geometry == Geometry::Axisymmetric { Boundary::Axis } else { Boundary::Symmetry };
        let sides = [Boundary::Wall, Boundary::Symmetry, low, Boundary::Wall];
        let law = if kind == MIXTURE { mixed } else { laws()[0] };
        let viscosity = Viscosity {
            liquid: PhaseViscosity { shear: 2e3, bulk: 1e3 },
            gas: PhaseViscosity { shear: 50.0, bulk: 0.0 },
            thin_gas: ThinGas::Bounded,
        };
        let setup = FluidSetup {
            liquid: law,
            gas: laws()[1],
            viscosity: Some(viscosity),
            conduction: conducting(6e6, 3e4),
            levels: 1,
            adaptation: Some(refined_ball()),
            ..setup_of(kind, geometry, [16, 16], sides)
        };
        let mut initial = ball(([0.4, 0.0], 0.25), [5e6, 300.0], [P, 900.0], 0.0);
        initial.ambient.density = law.density_at(5e6, 300.0).unwrap();
        let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
        let start = fluid.totals();
        run_locally(&mut fluid, 160);
        let gas = if kind == MIXTURE { 0.0 } else { fluid.totals().gas_mass / start.gas_mass - 1.0 };
        let [mass, momentum, energy] = imbalance_since(&fluid, &start);
        let imbalance = [mass, momentum, energy, gas];
        assert_balanced(&format!("{kind:?} {geometry:?}"), &imbalance, &fluid);
        assert!(fluid.fixups().clips.bounded_conductivities > 0, "the gas is too thin for the step");
        assert_no_energy_through_walls(&fluid);
    }
}

/// A ball of gas warmer than the liquid around it, which conducts far better, cools as one with a surface that is kept cold:
/// θ = 6/π² Σ exp(−n²π²Dt/R²)/n² (Carslaw & Jaeger §9.3).
#[test]
fn a_ball_of_gas_cools() {
    let radius = 0.3;
    // c_p is nearly c_v: what the pressure does hardly warms anything.
    let heat = Heat { capacity: 28.7e3, energy: 0.0, entropy: 0.0 };
    let gas = NobleAbelStiffenedGas { gamma: 1.01, pi: 0.0, covolume: 0.0, heat: Some(heat) };
    let liquid = NamedFluid::of("water-2.35").unwrap().law;
    let [warm, cold] = [303.0, 300.0];
    let error = |cells: usize| {
        let density = gas.density_at(P, warm).unwrap();
        let d = 2.0;
        let setup = FluidSetup {
            liquid,
            gas,
            conduction: conducting(6e6, d * density * 28.7e3),
            ..setup_of(SHARP, AXIAL, [cells; 2], CYLINDER)
        };
        let mut initial = ball(([0.5, 0.0], radius), [P, cold], [P, warm], 0.0);
        initial.ambient.density = liquid.density_at(P, cold).unwrap();
        initial.regions[0].state.density = density;
        let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
        let begun = pressure_volume(&fluid);
        let mut worst = 0.0_f64;
        for fourier in [0.01, 0.03, 0.06] {
            run_to(&mut fluid, fourier * radius * radius / d);
            let mode = |n: f64| 6.0 / (PI * n).powi(2) * (-(n * PI).powi(2) * fourier).exp();
            let wanted: f64 = (1..200).map(f64::from).map(mode).sum();
            // The pressure is uniform in it: pV is what its temperature is in the mean.
            let theta = (warm * pressure_volume(&fluid) / begun - cold) / (warm - cold);
            worst = worst.max((theta - wanted).abs());
        }
        worst
    };
    let errors = [16, 32, 64].map(error);
    let order = order("ball that cools", &errors);
    assert!(order > 1.0 && errors[2] < 0.02, "{order} {errors:?}");
}

/// ∫ φp dV.
fn pressure_volume(fluid: &FluidSolver<8>) -> f64 {
    let mut sum = 0.0;
    for (slot, id) in fluid.mesh().tree().leaves().iter().enumerate() {
        for (j, i) in (0..8).flat_map(|j| (0..8).map(move |i| (j, i))) {
            let cell = fluid.cell(slot, i, j);
            sum += fluid.mesh().volume(*id, j) * cell.phi * cell.pressure;
        }
    }
    sum
}
