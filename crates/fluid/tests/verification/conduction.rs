//! Conduction: exact solutions, media in contact, equilibrium, ledgers, limits on the step.

use std::f64::consts::{PI, TAU};

use fluid::{
    Boundary, Conduction, FluidSetup, FluidSolver, Heat, InitialCondition, InitialPressure, NamedFluid,
    NobleAbelStiffenedGas, Phase, PhaseState, Primitive, Region, Shape, ThinGas, WallHeat,
};
use mesh::{Adaptation, Geometry, LevelBound, Limiter, Zone};

use crate::helpers::*;

pub const PRESSURE: f64 = 1e5;
pub const TEMPERATURE: f64 = 300.0;

/// γ − 1: so small that temperature and pressure hardly act on each other.
const HARDLY: f64 = 1e-6;
/// c_v such that the sound speed is √((γ − 1)c_vT) = 316 m/s.
pub const CAPACITY: f64 = 1e5 / (HARDLY * TEMPERATURE);

/// A medium for waves of temperature.
pub fn medium(density: f64) -> NobleAbelStiffenedGas {
    let above = density * HARDLY * CAPACITY * TEMPERATURE;
    let heat = Heat { capacity: CAPACITY, energy: 0.0, entropy: 0.0 };
    NobleAbelStiffenedGas { gamma: 1.0 + HARDLY, pi: above - PRESSURE, covolume: 0.0, heat: Some(heat) }
}

/// Conductivities of liquid and gas that are these diffusivities, m²/s.
pub fn conducting([liquid, gas]: [f64; 2]) -> Conduction {
    Conduction {
        liquid: liquid * DENSITIES[0] * CAPACITY,
        gas: gas * DENSITIES[1] * CAPACITY,
        thin_gas: ThinGas::Bounded,
        wall: WallHeat::Adiabatic,
    }
}

/// Both media, with diffusivities of liquid and gas, m²/s, for smooth waves: without a limiter nothing may jump.
pub fn media(
    kind: Kind,
    geometry: Geometry,
    cells: [usize; 2],
    sides: [Boundary; 4],
    d: [f64; 2],
) -> FluidSetup {
    FluidSetup {
        liquid: medium(DENSITIES[0]),
        gas: medium(DENSITIES[1]),
        conduction: Some(conducting(d)),
        limiter: Limiter::None,
        ..setup_of(kind, geometry, cells, sides)
    }
}

/// Of the liquid and the gas, kg/m³.
pub const DENSITIES: [f64; 2] = [1000.0, 250.0];

/// So much warmer, relative to [`TEMPERATURE`], is what waves of temperature are made of: they hardly move anything.
pub const AMPLITUDE: f64 = 1e-5;

/// A state at rest whose temperature is θ amplitudes above [`TEMPERATURE`].
pub fn warmer(phase: Phase, theta: f64) -> Primitive {
    let (law, phi) = match phase {
        Phase::Liquid => (medium(DENSITIES[0]), 0.0),
        Phase::Gas => (medium(DENSITIES[1]), 1.0),
    };
    let density = law.density_at(PRESSURE, TEMPERATURE * (1.0 + AMPLITUDE * theta)).unwrap();
    Primitive { density, v_z: 0.0, v_r: 0.0, pressure: PRESSURE, phi }
}

/// θ of all cells with their places.
pub fn temperatures<const N: usize>(fluid: &FluidSolver<N>) -> Vec<([f64; 2], f64)> {
    let temperature = fluid.snapshot().temperature;
    let mut places = Vec::new();
    each_cell(fluid, |place, _, _| places.push(place));
    places
        .into_iter()
        .zip(temperature)
        .map(|(place, t)| (place, (t / TEMPERATURE - 1.0) / AMPLITUDE))
        .collect()
}

/// L1 error of θ over that of the exact one.
pub fn error_of<const N: usize>(fluid: &FluidSolver<N>, exact: impl Fn([f64; 2]) -> f64) -> f64 {
    let (mut error, mut norm) = (0.0, 0.0);
    for (place, theta) in temperatures(fluid) {
        error += (theta - exact(place)).abs();
        norm += exact(place).abs();
    }
    error / norm
}

/// The error function, by its series and its continued fraction.
pub fn erf(x: f64) -> f64 {
    if x.abs() > 5.0 {
        return x.signum();
    }
    let (mut term, mut sum) = (x, x);
    for k in 1..200 {
        let k = f64::from(k);
        term *= -x * x / k;
        sum += term / (2.0 * k + 1.0);
    }
    2.0 / PI.sqrt() * sum
}

/// A wave of temperature at an angle to the grid decays as exp(−Dk²t).
#[test]
fn a_wave_of_temperature_decays() {
    let (d, k) = (2.0, [TAU, 2.0 * TAU]);
    let exact =
        |[z, r]: [f64; 2], t: f64| (-d * (k[0] * k[0] + k[1] * k[1]) * t).exp() * (k[0] * z + k[1] * r).sin();
    let end = 1.0 / (d * (k[0] * k[0] + k[1] * k[1]));
    for kind in KINDS {
        let error = |cells: usize| {
            let setup = media(kind, PLANAR, [cells; 2], PERIODIC, [d; 2]);
            let mut fluid =
                FluidSolver::<8>::from_fn(&setup, |x| warmer(Phase::Liquid, exact(x, 0.0))).unwrap();
            run_to(&mut fluid, end);
            error_of(&fluid, |x| exact(x, end))
        };
        let order = order(&format!("wave of temperature, {:?}", kind.0), &[16, 32, 64].map(error));
        assert!(order > 1.9, "{order}");
    }
}

/// In a cylinder, J0(kr): what r and 1/r do.
#[test]
fn a_cylinder_cools_alike() {
    let (d, k) = (2.0, J1_ZEROS[0]);
    let exact = |[_, r]: [f64; 2], t: f64| (-d * k * k * t).exp() * j0(k * r);
    let end = 1.0 / (d * k * k);
    let error = |cells: usize| {
        let setup = media(SHARP, AXIAL, [8, cells], CYLINDER, [d; 2]);
        let mut fluid = FluidSolver::<8>::from_fn(&setup, |x| warmer(Phase::Gas, exact(x, 0.0))).unwrap();
        run_to(&mut fluid, end);
        error_of(&fluid, |x| exact(x, end))
    };
    let order = order("cylinder that cools", &[16, 32, 64].map(error));
    assert!(order > 1.9, "{order}");
}

/// What half and a quarter of the step leave of the error.
#[test]
fn the_decay_is_of_second_order_in_time() {
    let d = 2.0;
    let run = |steps: usize| {
        let setup = media(SHARP, PLANAR, [32, 8], PERIODIC, [d; 2]);
        let start = |[z, _]: [f64; 2]| warmer(Phase::Liquid, (TAU * z).sin());
        let mut fluid = FluidSolver::<8>::from_fn(&setup, start).unwrap();
        let end = 20.0 * fluid.time_step_limit(CFL);
        (0..steps).for_each(|_| fluid.step(end / steps as f64).unwrap());
        temperatures(&fluid)[7].1
    };
    let converged = run(640);
    let errors = [40, 80, 160].map(|steps| (run(steps) / converged - 1.0).abs());
    let order = order("wave of temperature, step", &errors);
    assert!(order > 1.9, "{order}");
}

/// θ of two half-spaces, liquid of 1 below 0 and gas of 0 above, that have been in contact for a time: Carslaw & Jaeger §2.8.
fn contact(x: f64, t: f64, diffusivities: [f64; 2]) -> f64 {
    let effusivity = |k: usize| DENSITIES[k] * CAPACITY * f64::sqrt(diffusivities[k]);
    let between = effusivity(0) / (effusivity(0) + effusivity(1));
    let side = usize::from(x > 0.0);
    let depth = x.abs() / (2.0 * (diffusivities[side] * t).sqrt());
    if side == 0 { between + (1.0 - between) * erf(depth) } else { between * (1.0 - erf(depth)) }
}

/// Gas on liquid: on the contact there is the temperature that both effusivities give.
#[test]
fn media_in_contact_have_the_temperature_between() {
    let d = [4.0, 2.0];
    let exact = |[z, _]: [f64; 2], t: f64| contact(z - 0.5, t, d);
    let (start, end) = (4e-4, 2e-3);
    let error = |cells: usize| {
        let setup = FluidSetup { limiter: Limiter::Mc, ..media(SHARP, PLANAR, [cells, 8], WALLS, d) };
        let phase = |z: f64| if z < 0.5 { Phase::Liquid } else { Phase::Gas };
        let mut fluid = FluidSolver::<8>::from_fn(&setup, |x| warmer(phase(x[0]), exact(x, start))).unwrap();
        run_to(&mut fluid, end - start);
        error_of(&fluid, |x| exact(x, end))
    };
    let order = order("gas on liquid", &[32, 64, 128].map(error));
    assert!(order > 1.8, "{order}");
}

/// The same where the interface lies within cells, from the moment of the contact on.
#[test]
fn interfaces_within_cells_conduct_alike() {
    for (what, d) in [("liquid conducts more", [4.0, 1.0]), ("gas conducts more", [0.5, 8.0])] {
        for place in [0.5 + 0.3 / 32.0, 0.5 + 0.7 / 32.0] {
            let exact = |[z, _]: [f64; 2], t: f64| contact(z - place, t, d);
            let end = 2e-3;
            let error = |cells: usize| {
                let of = |phase, theta| {
                    let Primitive { density, pressure, .. } = warmer(phase, theta);
                    PhaseState { phase, density, pressure, velocity: [0.0; 2] }
                };
                let shape = Shape::Box { z: [-1.0, place], r: [-1.0, 2.0] };
                let initial = InitialCondition {
                    ambient: of(Phase::Gas, 0.0),
                    pressure: InitialPressure::Uniform,
                    regions: vec![Region { shape, state: of(Phase::Liquid, 1.0) }],
                    pulses: vec![],
                };
                let mut setup =
                    FluidSetup { limiter: Limiter::Mc, ..media(SHARP, PLANAR, [cells, 8], WALLS, d) };
                setup.conduction.as_mut().unwrap().thin_gas = ThinGas::SuperTimeStepping;
                let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
                run_to(&mut fluid, end);
                error_of(&fluid, |x| exact(x, end))
            };
            let errors = [32, 64, 128].map(error);
            order(&format!("interface in a cell, {what}"), &errors);
            assert!(errors[2] < 0.35 * errors[0] && errors[2] < 0.01, "{errors:?}");
        }
    }
}

/// Waves of temperature over jumps of levels, of which each makes steps of its own or not.
#[test]
fn levels_conduct_to_each_other() {
    let (d, k) = (2.0, TAU);
    let exact = |[z, _]: [f64; 2], t: f64| (-d * k * k * t).exp() * (k * z).sin();
    let end = 0.5 / (d * k * k);
    let zone = |z: [f64; 2], level| LevelBound {
        zone: Zone::Box { z, r: [-1.0, 2.0] },
        at_least: level,
        at_most: level,
    };
    for is_local in [false, true] {
        let error = |cells: usize| {
            let bounds = vec![zone([-1.0, 0.3], 0), zone([0.32, 0.7], 1), zone([0.72, 2.0], 0)];
            let setup = FluidSetup {
                levels: 1,
                adaptation: Some(Adaptation { bounds, ..Adaptation::by_details(1.0, 1000) }),
                ..media(SHARP, PLANAR, [cells, 16], PERIODIC, [d; 2])
            };
            let mut fluid =
                FluidSolver::<8>::from_fn(&setup, |x| warmer(Phase::Liquid, exact(x, 0.0))).unwrap();
            let [coarsest, finest] = fluid.mesh().levels_present();
            assert!(coarsest < finest, "there is a jump of levels");
            let start = fluid.totals().energy;
            while fluid.time() < end {
                if is_local {
                    step_locally(&mut fluid)
                } else {
                    step_together(&mut fluid)
                };
            }
            let kept = fluid.totals().energy / start - 1.0;
            assert!(kept.abs() < 1e-14, "energy: {kept:e}");
            let now = fluid.time();
            error_of(&fluid, |x| exact(x, now))
        };
        let what = if is_local { "level jumps, steps of their own" } else { "level jumps" };
        let order = order(what, &[32, 64, 128].map(error));
        assert!(order > 1.6, "{order}");
    }
}

/// Complex numbers (re, im).
type Complex = [f64; 2];

fn times([a, b]: Complex, [c, d]: Complex) -> Complex {
    [a * c - b * d, a * d + b * c]
}

fn over(a: Complex, [c, d]: Complex) -> Complex {
    let [re, im] = times(a, [c, -d]);
    [re / (c * c + d * d), im / (c * c + d * d)]
}

fn plus(a: Complex, b: Complex) -> Complex {
    [a[0] + b[0], a[1] + b[1]]
}

/// The plane wave of sound exp(ikx + st) in a stiffened gas with the rates νₗk² of friction and a = λk²/(ρc_v) of conduction: s, and what p′ and ρ′
/// are to v. With P = p + π, (s + νₗk²)(s + a)s + (γs + a)k²P/ρ = 0 (Kirchhoff 1868).
fn sound_wave(
    law: NobleAbelStiffenedGas,
    density: f64,
    k: f64,
    friction: f64,
    conduction: f64,
) -> [Complex; 3] {
    let above = PRESSURE + law.pi;
    let stiffness = k * k * above / density;
    let (c2, c1) = (friction + conduction, friction * conduction + law.gamma * stiffness);
    let c0 = conduction * stiffness;
    let mut s = [0.0, (law.gamma * stiffness).sqrt()];
    for _ in 0..50 {
        let square = times(s, s);
        let value = plus(plus(times(square, s), square.map(|x| c2 * x)), plus(s.map(|x| c1 * x), [c0, 0.0]));
        let slope = plus(square.map(|x| 3.0 * x), plus(s.map(|x| 2.0 * c2 * x), [c1, 0.0]));
        let step = over(value, slope);
        s = [s[0] - step[0], s[1] - step[1]];
    }
    let of_density = over([0.0, -k * density], s);
    let stiff = plus([law.gamma, 0.0], over([conduction, 0.0], s));
    let of_pressure = over(times([0.0, -k * above], stiff), plus(s, [conduction, 0.0]));
    [s, of_pressure, of_density]
}

/// Sound loses height by friction and by conduction, as Stokes and Kirchhoff say.
#[test]
fn sound_decays_by_friction_and_conduction() {
    let law = NamedFluid::of("air").unwrap().law;
    let density = law.density_at(PRESSURE, TEMPERATURE).unwrap();
    let (k, d, nu) = (TAU, 50.0, 20.0);
    let capacity = law.heat.unwrap().capacity;
    for (what, d, nu, thin_gas) in [
        ("conduction", d, 0.0, ThinGas::Resolved),
        ("friction and conduction", d, nu, ThinGas::Resolved),
        ("both in stages", d, nu, ThinGas::SuperTimeStepping),
    ] {
        let rates = sound_wave(law, density, k, 4.0 / 3.0 * nu * k * k, d * k * k);
        let [s, of_pressure, of_density] = rates;
        let exact = |[z, _]: [f64; 2], t: f64| {
            let (sine, cosine) = (k * z + s[1] * t).sin_cos();
            let wave = [cosine, sine].map(|x| 1e-3 * (s[0] * t).exp() * x);
            let of = |factor: Complex| times(factor, wave)[0];
            Primitive {
                density: density + of(of_density),
                v_z: wave[0],
                v_r: 0.0,
                pressure: PRESSURE + of(of_pressure),
                phi: 1.0,
            }
        };
        let end = TAU / s[1].abs();
        let error = |cells: usize| {
            let gas = fluid::PhaseViscosity { shear: nu * density, bulk: 0.0 };
            let setup = FluidSetup {
                liquid: NamedFluid::of("water-nasg").unwrap().law,
                gas: law,
                conduction: Some(Conduction {
                    liquid: 0.6,
                    gas: d * density * capacity,
                    thin_gas,
                    wall: WallHeat::Adiabatic,
                }),
                viscosity: (nu > 0.0).then_some(fluid::Viscosity {
                    liquid: fluid::PhaseViscosity::default(),
                    gas,
                    thin_gas,
                }),
                limiter: Limiter::None,
                ..setup_of(SHARP, PLANAR, [cells, 8], PERIODIC)
            };
            let mut fluid = FluidSolver::<8>::from_fn(&setup, |x| exact(x, 0.0)).unwrap();
            run_to(&mut fluid, end);
            l1(&fluid, |x| exact(x, end), |w| [w.pressure - PRESSURE])
        };
        let weak = -0.5 * k * k * (4.0 / 3.0 * nu + d * (law.gamma - 1.0) / law.gamma);
        eprintln!("{what}: decays by {:.4} 1/s, to first order {weak:.4}", s[0]);
        let order = order(&format!("sound, {what}"), &[16, 32, 64].map(error));
        assert!(order > 1.8, "{order}");
    }
}
