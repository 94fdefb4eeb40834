//! Viscosity: exact solutions in the plane and in tubes, walls that move, ledgers, limits on the step.

use std::f64::consts::{PI, TAU};

use fluid::{Boundary, FluidSetup, FluidSolver, Gravity, PhaseViscosity, Primitive, ThinGas, Viscosity};
use mesh::{FaceState, Geometry, Limiter};

use crate::helpers::*;

const SYMMETRIC: [Boundary; 4] = [Boundary::Symmetry; 4];

/// A tube without ends.
fn tube(outer: Boundary) -> [Boundary; 4] {
    [Boundary::Periodic, Boundary::Periodic, Boundary::Axis, outer]
}

/// Liquid of 1000 kg/m³ with these kinematic viscosities, m²/s.
fn viscous(shear: f64, bulk: f64) -> Option<Viscosity> {
    let liquid = PhaseViscosity { shear: 1000.0 * shear, bulk: 1000.0 * bulk };
    Some(Viscosity { liquid, gas: PhaseViscosity::default(), thin_gas: ThinGas::Bounded })
}

/// The order in L1 of what is picked, between the last two grids.
fn order_of<const K: usize>(
    what: &str,
    grids: &[[usize; 2]],
    setup: impl Fn([usize; 2]) -> FluidSetup,
    exact: impl Fn([f64; 2], f64) -> Primitive + Sync,
    end: f64,
    pick: fn(Primitive) -> [f64; K],
) -> f64 {
    let error = |cells: &[usize; 2]| {
        let mut fluid = FluidSolver::<8>::from_fn(&setup(*cells), |x| exact(x, 0.0)).unwrap();
        run_to(&mut fluid, end);
        l1(&fluid, |x| exact(x, end), pick)
    };
    order(what, &grids.iter().map(error).collect::<Vec<_>>())
}

fn velocity(w: Primitive) -> [f64; 2] {
    [w.v_z, w.v_r]
}

fn pressure(w: Primitive) -> [f64; 1] {
    [w.pressure - 1e5]
}

/// A shear wave at an angle to the grid decays as exp(−νk²t).
#[test]
fn a_shear_wave_decays() {
    let (nu, k) = (20.0, [TAU, 2.0 * TAU]);
    let number = k[0].hypot(k[1]);
    let exact = |[z, r]: [f64; 2], t: f64| {
        let speed = 1e-3 * (-nu * number * number * t).exp() * (k[0] * z + k[1] * r).sin();
        Primitive { v_z: -speed * k[1] / number, v_r: speed * k[0] / number, ..still(1e5) }
    };
    let setup = |cells| FluidSetup {
        viscosity: viscous(nu, 0.0),
        limiter: Limiter::None,
        ..setup(PLANAR, cells, PERIODIC)
    };
    let end = 1.0 / (nu * number * number);
    let grids = [[16; 2], [32; 2], [64; 2]];
    // At an angle the waves' part of the scheme adds an error of third order.
    let oblique = order_of("oblique shear wave", &grids, setup, exact, end, velocity);
    let along = |[z, _]: [f64; 2], t: f64| Primitive {
        v_r: 1e-3 * (-nu * TAU * TAU * t).exp() * (TAU * z).sin(),
        ..still(1e5)
    };
    let aligned = order_of("shear wave along z", &grids, setup, along, end, velocity);
    assert!(oblique > 1.5 && aligned > 1.95, "{oblique} {aligned}");
}

/// The midpoint rule: what half and a quarter of the step leave of the error.
#[test]
fn the_decay_is_of_second_order_in_time() {
    let nu = 20.0;
    let run = |steps: usize| {
        let setup = FluidSetup { viscosity: viscous(nu, 0.0), ..setup(PLANAR, [32, 8], PERIODIC) };
        let start = |[z, _]: [f64; 2]| Primitive { v_r: 1e-3 * (TAU * z).sin(), ..still(1e5) };
        let mut fluid = FluidSolver::<8>::from_fn(&setup, start).unwrap();
        let end = 40.0 * 0.99 * fluid.time_step_limit(CFL);
        (0..steps).for_each(|_| {
            fluid.step(end / steps as f64).unwrap();
        });
        fluid.cell(0, 7, 3).v_r
    };
    let converged = run(640);
    let errors = [40, 80, 160].map(|steps| (run(steps) / converged - 1.0).abs());
    let order = order("shear wave, step", &errors);
    assert!(order > 1.9, "{order}");
}

/// A plane wave of sound in a fluid with diffusivity of sound 4ν/3 + κ/ρ: s² + νₗk²s + c²k² = 0 (Stokes).
fn sound(diffusivity: f64, k: f64) -> [f64; 2] {
    let c = LIQUID.sound_speed(1000.0, 1e5);
    let decay = 0.5 * diffusivity * k * k;
    [decay, (c * c * k * k - decay * decay).sqrt()]
}

/// The potential flow v = ∇(shape) with time factor Re(e^{st}), s = −decay + iω, and its pressure −ρc²k² Re(e^{st}/s) shape… as a state.
fn mode([decay, omega]: [f64; 2], k: f64, t: f64, (shape, gradient): (f64, [f64; 2])) -> Primitive {
    let c = LIQUID.sound_speed(1000.0, 1e5);
    let amplitude = 1e-6 * c / k;
    let fading = (-decay * t).exp();
    let (sine, cosine) = (omega * t).sin_cos();
    // ∂t ρ' = ρk² shape Re(e^{st}): ρ' = ρk² shape Re(e^{st}/s).
    let integral = fading * (omega * sine - decay * cosine) / (decay * decay + omega * omega);
    let excess = 1000.0 * k * k * amplitude * shape * integral;
    let speed = amplitude * fading * cosine;
    Primitive {
        density: 1000.0 + excess,
        v_z: speed * gradient[0],
        v_r: speed * gradient[1],
        pressure: 1e5 + c * c * excess,
        phi: 0.0,
    }
}

/// Standing sound between rigid walls: the stress on the walls counts, too.
#[test]
fn sound_between_walls_decays_as_stokes_says() {
    let (nu, kappa, k) = (10.0, 15.0, PI);
    let rates = sound(4.0 / 3.0 * nu + kappa, k);
    let exact = |[z, _]: [f64; 2], t: f64| mode(rates, k, t, ((k * z).cos(), [-k * (k * z).sin(), 0.0]));
    let sides = [Boundary::Wall, Boundary::Wall, Boundary::Symmetry, Boundary::Symmetry];
    let setup = |cells| FluidSetup {
        viscosity: viscous(nu, kappa),
        limiter: Limiter::None,
        ..setup(PLANAR, cells, sides)
    };
    // Two periods, in which it loses a third.
    let end = 2.0 * TAU / rates[1];
    let grids = [[16, 8], [32, 8], [64, 8]];
    let order = order_of("viscous sound between walls", &grids, setup, exact, end, pressure);
    assert!(order > 1.9, "{order}");
}

/// The same in a cylinder that the fluid slips along: what r, 1/r and the hoop stress do.
#[test]
fn sound_in_a_cylinder_decays_alike() {
    let (nu, [k_z, k_r]) = (10.0, [PI, J1_ZEROS[0]]);
    let k = f64::hypot(k_z, k_r);
    let rates = sound(4.0 / 3.0 * nu, k);
    let exact = |[z, r]: [f64; 2], t: f64| {
        let (along, across) = ((k_z * z).cos(), j0(k_r * r));
        mode(rates, k, t, (along * across, [-k_z * (k_z * z).sin() * across, -k_r * along * j1(k_r * r)]))
    };
    let sides = [Boundary::Symmetry, Boundary::Symmetry, Boundary::Axis, Boundary::Symmetry];
    for kind in KINDS {
        let setup = |cells| FluidSetup {
            viscosity: viscous(nu, 0.0),
            limiter: Limiter::None,
            ..setup_of(kind, AXIAL, cells, sides)
        };
        let grids = [[16; 2], [32; 2], [64; 2]];
        for (name, pick) in [("v", velocity as fn(Primitive) -> [f64; 2]), ("p", |w| [w.pressure - 1e5, 0.0])]
        {
            let label = format!("viscous sound in a cylinder, {name}, {:?}", kind.0);
            let order = order_of(&label, &grids, setup, exact, TAU / rates[1], pick);
            assert!(order > 1.9, "{label}: {order}");
        }
    }
}

/// Hagen and Poiseuille: v_z = g(a² − r²)/4ν, reached from rest but for exp(−5.78 νt/a²).
#[test]
fn a_tube_driven_along_its_axis_has_poiseuilles_profile() {
    let (nu, g) = (20.0, 1e-2);
    let exact = |[_, r]: [f64; 2], _: f64| Primitive { v_z: g * (1.0 - r * r) / (4.0 * nu), ..still(1e5) };
    let gravity = Some(Gravity { acceleration: g, level: 0.0 });
    let error = |cells: usize| {
        let setup = FluidSetup {
            viscosity: viscous(nu, 0.0),
            gravity,
            ..setup(AXIAL, [8, cells], tube(Boundary::Wall))
        };
        let mut fluid =
            FluidSolver::<8>::from_fn(&setup, |x| Primitive { v_z: 0.0, ..exact(x, 0.0) }).unwrap();
        let far = 2.0 / nu;
        run_to(&mut fluid, far);
        l1(&fluid, |x| exact(x, far), |w| [w.v_z])
    };
    let errors = [8, 16, 32].map(error);
    let order = order("Poiseuille", &errors);
    assert!(order > 1.8 && errors[2] < 1e-3, "{order} {errors:?}");
}

/// Stokes' second problem: the wall to the solid slides to and fro, and feels U√(ωρμ) an eighth of a period ahead.
#[test]
fn a_wall_that_slides_to_and_fro_drags_a_layer_along() {
    let (nu, depth, speed) = (4.0, 0.12, 1e-2);
    let omega = 2.0 * nu / (depth * depth);
    let layer = |z: f64, t: f64| speed * (-z / depth).exp() * (omega * t - z / depth).cos();
    let exact = |[z, _]: [f64; 2], t: f64| Primitive { v_r: layer(z, t), ..still(1e5) };
    let sides = [Boundary::Interface, Boundary::Symmetry, Boundary::Periodic, Boundary::Periodic];
    let (mut errors, mut shears) = (vec![], vec![]);
    for cells in [16, 32, 64] {
        let setup = FluidSetup { viscosity: viscous(nu, 0.0), ..setup(PLANAR, [cells, 8], sides) };
        let mut fluid = FluidSolver::<8>::from_fn(&setup, |x| exact(x, 0.0)).unwrap();
        let end = 0.5 * TAU / omega;
        let (mut error, mut scale) = (0.0, 0.0);
        while fluid.time() < end * (1.0 - 1e-12) {
            let dt = fluid.time_step_limit(CFL).min(end - fluid.time());
            let middle = fluid.time() + 0.5 * dt;
            let wall = FaceState { tangential_velocity: layer(0.0, middle), ..[1e5, 0.0, 0.0].into() };
            fluid.interface_mut().set_all(|_| wall);
            let shear = shear_on_wall(&fluid, dt);
            fluid.interface_mut().set_all(|face| FaceState { shear: shear[face], ..wall });
            fluid.step(dt).unwrap();
            let amplitude = speed * (omega * 1000.0 * 1000.0 * nu).sqrt();
            // The layer above moves with the wall but lags: the wall is held back most an eighth of a period early.
            let expected = -amplitude * (omega * middle + 0.25 * PI).cos();
            error += dt * (shear[3] - expected).abs();
            scale += dt * expected.abs();
        }
        errors.push(l1(&fluid, |x| exact(x, end), |w| [w.v_r]));
        shears.push(error / scale);
    }
    let orders = [order("Stokes' layer", &errors), order("its shear on the wall", &shears)];
    assert!(orders[0] > 1.8 && orders[1] > 0.9 && shears[2] < 0.05, "{orders:?} {shears:?}");
}

/// Mass, axial momentum and energy change by what the sides pass, with levels, their own steps, and gas that is too thin.
#[test]
fn ledgers_close_with_levels_and_their_own_steps() {
    let liquid = PhaseViscosity { shear: 2e3, bulk: 1e3 };
    for (kind, geometry) in KINDS.into_iter().flat_map(|kind| [(kind, AXIAL), (kind, PLANAR)]) {
        let low = if geometry == Geometry::Axisymmetric { Boundary::Axis } else { Boundary::Symmetry };
        let sides = [Boundary::Wall, Boundary::Symmetry, low, Boundary::Wall];
        let gas = PhaseViscosity { shear: 50.0, bulk: 0.0 };
        let setup = FluidSetup {
            viscosity: Some(Viscosity { liquid, gas, thin_gas: ThinGas::Bounded }),
            levels: 1,
            adaptation: Some(refined_ball()),
            ..setup_of(kind, geometry, [16, 16], sides)
        };
        let mut fluid =
            FluidSolver::<8>::new(&setup, &ball_of_gas(([0.4, 0.0], 0.25), 5e6, AIR, 0.0)).unwrap();
        let start = fluid.totals();
        run_locally(&mut fluid, 160);
        let imbalance = imbalance_since(&fluid, &start);
        assert_balanced(&format!("{kind:?} {geometry:?}"), &imbalance, &fluid);
        assert!(fluid.fixups().clips.bounded_viscosities > 0, "the gas is too thin for the step");
        assert_no_energy_through_walls(&fluid);
    }
}

/// ν Δt (1/h_z² + 1/h_r²)·4/3 ≤ 3/8 in liquid, and in thin gas where that is asked for.
#[test]
fn the_step_is_limited_by_what_a_block_holds() {
    let limit = |viscosity, state: Primitive| {
        let setup = FluidSetup { viscosity, ..setup(PLANAR, [16, 16], SYMMETRIC) };
        FluidSolver::<8>::from_fn(&setup, |_| state).unwrap().time_step_limit(CFL)
    };
    let expected = |nu: f64| 0.375 * 0.75 / nu / (2.0 * 256.0);
    approx::assert_relative_eq!(limit(viscous(100.0, 0.0), still(1e5)), expected(100.0), max_relative = 1e-9);
    let gas = Primitive { density: 0.0122, phi: 1.0, ..still(1e3) };
    let of = |thin_gas| {
        let gas = PhaseViscosity { shear: 0.122, bulk: 0.0 };
        Some(Viscosity { liquid: PhaseViscosity::default(), gas, thin_gas })
    };
    approx::assert_relative_eq!(limit(of(ThinGas::Resolved), gas), expected(10.0), max_relative = 1e-9);
    assert_eq!(limit(of(ThinGas::Bounded), gas), limit(None, gas), "the sound of the gas limits it");
}

/// A drop comes towards a wall and presses out gas that is too viscous for the step: the wall to the solid, kept at rest, does as a wall does.
#[test]
fn thin_gas_between_a_drop_and_the_wall_to_the_solid_is_as_at_any_wall() {
    let largest = |kind: Boundary, thin_gas: ThinGas| {
        let sides = [kind, Boundary::NonReflecting, Boundary::Axis, Boundary::Wall];
        let [liquid, gas] = [1.0, 100.0].map(|shear| PhaseViscosity { shear, bulk: 0.0 });
        let viscosity = Some(Viscosity { liquid, gas, thin_gas });
        let setup = FluidSetup { viscosity, ..setup_of(SHARP, AXIAL, [32, 32], sides) };
        let mut fluid = FluidSolver::<8>::new(&setup, &drop_in_gas(([0.3, 0.0], 0.2))).unwrap();
        let (mut traces, mut largest) = (vec![], 0.0_f64);
        for _ in 0..300 {
            let dt = fluid.time_step_limit(CFL);
            fluid.traces_at_mid_step(dt, &mut traces);
            let shear = if traces.is_empty() { vec![] } else { shear_on_wall(&fluid, dt) };
            fluid.interface_mut().set_all(|face| {
                let trace = traces[face];
                let pressure = trace.pressure - impedance(&trace) * trace.velocity;
                FaceState { shear: shear[face], ..[pressure, 0.0, 0.0].into() }
            });
            fluid.step(dt).unwrap();
            each_cell(&fluid, |_, _, w| largest = largest.max(w.pressure));
        }
        largest
    };
    for thin_gas in [ThinGas::Bounded, ThinGas::SuperTimeStepping] {
        let [wall, interface] = [Boundary::Wall, Boundary::Interface].map(|kind| largest(kind, thin_gas));
        eprintln!("{thin_gas:?}: {wall:.4e} Pa at a wall, {interface:.4e} at the wall to the solid");
        assert!(wall > 1e7 && (interface / wall - 1.0).abs() < 0.3, "{thin_gas:?} {wall:e} {interface:e}");
    }
}
