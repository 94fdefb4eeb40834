//! All terms together: ledgers of each species, momentum and energy, and interfaces that stay as thin as they are without.

use fluid::{
    Boundary, ConductingWall, Conduction, EvaporationLaw, FluidSetup, FluidSolver, InitialCondition,
    NamedFluid, NobleAbelStiffenedGas, PhaseChange, PhaseViscosity, SurfaceTension, ThinGas, Viscosity,
    WallHeat,
};
use mesh::{Adaptation, FaceState, Geometry};

use crate::helpers::*;

fn laws() -> [NobleAbelStiffenedGas; 2] {
    ["water-nasg", "water-vapour"].map(|name| NamedFluid::of(name).unwrap().law)
}

/// A ball of vapour and gas in water, each with a pressure (Pa) and a temperature (K).
fn ball(place: ([f64; 2], f64), liquid: [f64; 2], gas: [f64; 2]) -> InitialCondition {
    ball_of_laws(laws(), place, [liquid, gas], 0.0)
}

/// All terms, as much of each as makes a difference in a domain of a metre.
fn with_all(thin_gas: ThinGas, law: EvaporationLaw, setup: FluidSetup) -> FluidSetup {
    let [liquid, gas] = laws();
    FluidSetup {
        liquid,
        gas,
        viscosity: Some(Viscosity {
            liquid: PhaseViscosity { shear: 2e3, bulk: 1e3 },
            gas: PhaseViscosity { shear: 20.0, bulk: 0.0 },
            thin_gas,
        }),
        conduction: Some(Conduction {
            liquid: 6e6,
            gas: 3e4,
            thin_gas,
            wall: WallHeat::Conducting(ConductingWall { temperature: 320.0, effusivity: 1e6 }),
        }),
        surface_tension: Some(SurfaceTension { coefficient: 7e3, density: 1e3, may_touch_walls: true }),
        phase_change: Some(PhaseChange { law, vapour_fraction: 0.7, cavitation: Some(-1e5) }),
        ..setup
    }
}

fn vapour(fluid: &FluidSolver<8>) -> f64 {
    fluid.carried_masses().find(|(name, _)| *name == "vapour").unwrap().1
        / fluid.mesh().domain().geometry.turn()
}

/// A wall that moves and slides, more on the axis than farther out, with what it meets in the fluid.
fn move_wall(fluid: &mut FluidSolver<8>, dt: f64) {
    let edges = fluid.interface_edges();
    let (shear, mut traces) = (shear_on_wall(fluid, dt), vec![]);
    fluid.traces_at_mid_step(dt, &mut traces);
    let phase = (3e3 * fluid.time()).sin();
    fluid.interface_mut().set_all(|face| {
        let far = edges[face];
        let (velocity, sliding) = (0.5 * phase * (-far * far).exp(), 2.0 * phase * far);
        let trace = traces[face];
        let pressure = trace.pressure + impedance(&trace) * (velocity - trace.velocity);
        FaceState {
            pressure,
            velocity,
            power: pressure * velocity - shear[face] * sliding,
            shear: shear[face],
            tangential_velocity: sliding,
        }
    });
}

/// Mass of each species, axial momentum and energy change by what ledgers say, with everything on at once.
#[test]
fn ledgers_close_with_all_terms() {
    let laws = [EvaporationLaw::Equilibrium, EvaporationLaw::HertzKnudsen { accommodation: 1.0 }];
    for (geometry, law) in [(AXIAL, laws[0]), (AXIAL, laws[1]), (PLANAR, laws[1])] {
        for (thin_gas, local) in [(ThinGas::SuperTimeStepping, true), (ThinGas::Bounded, false)] {
            let low = if geometry == Geometry::Axisymmetric { Boundary::Axis } else { Boundary::Symmetry };
            let sides = [Boundary::Interface, Boundary::NonReflecting, low, Boundary::Wall];
            let setup = FluidSetup {
                levels: 1,
                adaptation: Some(Adaptation::by_details(2e-2, 4)),
                ..with_all(thin_gas, law, setup_of(SHARP, geometry, [32, 32], sides))
            };
            let initial = ball(([0.45, 0.0], 0.3), [5e6, 300.0], [1e5, 500.0]);
            let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
            let (before, held) = (fluid.totals(), vapour(&fluid));
            while fluid.steps() < 120 {
                let (dt, steps) = if local {
                    // The wall's states hold for the whole step of the coarsest level.
                    let (base, made) = (fluid.mesh().coarsest_base(), fluid.steps());
                    let dt = fluid.local_step_limit(CFL, base);
                    move_wall(&mut fluid, dt);
                    fluid.begin_step(dt, base);
                    while !fluid.clock().is_over() {
                        fluid.sub_step(CFL).unwrap();
                    }
                    (dt, (fluid.steps() - made) as u32)
                } else {
                    let dt = fluid.time_step_limit(CFL);
                    move_wall(&mut fluid, dt);
                    fluid.step(dt).unwrap();
                    (dt, 1)
                };
                fluid.adapt_if_due(dt, steps);
            }
            assert_jump_of_levels(&fluid);
            let (now, ledger, phases, fixups) =
                (fluid.totals(), *fluid.ledger(), *fluid.phase_ledger(), fluid.fixups());
            let sum = |sides: [f64; 4]| sides.iter().sum::<f64>();
            let net = phases.evaporated - phases.condensed;
            let gained = sum(ledger.gas_mass) + net + fixups.gas_mass_added - fixups.liquid_mass_added;
            let impulse = sum(ledger.momentum) + ledger.tension_impulse;
            let energy = sum(ledger.energy) + ledger.tension_work + phases.energy + fixups.floor_energy;
            let scale = ledger.momentum.iter().map(|m| m.abs()).fold(10.0 * before.mass, f64::max);
            let imbalance = [
                (now.mass - before.mass - sum(ledger.mass)) / before.mass,
                (now.gas_mass - before.gas_mass - gained) / before.gas_mass,
                (now.momentum_z - before.momentum_z - impulse) / scale,
                (now.energy - before.energy - energy) / before.energy,
            ];
            // What gas passes the wall that moves is vapour of liquid that has opened there.
            let part = (vapour(&fluid) - held - net - sum(ledger.gas_mass)) / before.gas_mass;
            eprintln!("{geometry:?} {law:?} {thin_gas:?}: {} vapour {part:.1e}", scientific(&imbalance));
            assert!(imbalance.iter().chain([&part]).all(|part| part.abs() < 1e-12), "{imbalance:?} {part:e}");
            assert!(ledger.wall_heat.abs() > 0.0 && net != 0.0 && ledger.tension_work != 0.0);
        }
    }
}

/// How many cells hold both phases on a way through the interface, and ∫φ(1 − φ) over it in cells.
fn thickness(fluid: &FluidSolver<8>) -> [f64; 2] {
    let (mut mixed, mut product, mut gas, mut cells) = (0.0, 0.0, 0.0, 0.0);
    each_cell(fluid, |_, _, w| {
        let phi = w.phi.clamp(0.0, 1.0);
        mixed += f64::from(u8::from(phi > 0.01 && phi < 0.99));
        product += phi * (1.0 - phi);
        gas += phi;
        cells += 1.0;
    });
    // Of a disc of that many cells, or a quarter or half of one.
    assert!(gas > 0.0 && cells > gas);
    let around = 2.0 * (std::f64::consts::PI * gas).sqrt();
    [mixed / around, product / around]
}

/// A bubble carried through the grid, and one that collapses: interfaces are as thin as they are without any term.
#[test]
fn interfaces_stay_as_thin_with_all_terms() {
    let rate = EvaporationLaw::HertzKnudsen { accommodation: 0.5 };
    let boiling = 393.0;
    let [liquid, gas] = laws();
    let saturation = fluid::Saturation::of(&fluid::Mixture::new(liquid, gas)).unwrap();
    let run = |all: bool, carried: bool| {
        let sides = if carried { PERIODIC } else { WALLS };
        let plain = FluidSetup { liquid, gas, ..setup_of(SHARP, PLANAR, [32, 32], sides) };
        let setup = if all {
            let with = with_all(ThinGas::SuperTimeStepping, rate, plain);
            // Laplace's jump is small against the pressure.
            let tension = SurfaceTension { coefficient: 700.0, density: 1e3, may_touch_walls: true };
            let change = PhaseChange { law: rate, vapour_fraction: 0.7, cavitation: None };
            FluidSetup { surface_tension: Some(tension), phase_change: Some(change), ..with }
        } else {
            plain
        };
        let p = saturation.pressure(boiling);
        let mut initial = if carried {
            ball(([0.5, 0.5], 0.25), [p, boiling], [p, boiling])
        } else {
            ball(([0.5, 0.5], 0.3), [5e6, 300.0], [1e5, 500.0])
        };
        if carried {
            initial.ambient.velocity = [20.0, 13.0];
            initial.regions[0].state.velocity = [20.0, 13.0];
        }
        let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
        run_to(&mut fluid, if carried { 1e-2 } else { 2e-3 });
        thickness(&fluid)
    };
    for carried in [true, false] {
        let [with, without] = [true, false].map(|all| run(all, carried));
        let what = if carried { "carried" } else { "collapsing" };
        eprintln!(
            "{what}: cells, integral with all terms {}, without {}",
            scientific(&with),
            scientific(&without)
        );
        for (with, without) in with.into_iter().zip(without) {
            assert!(with < 1.1 * without, "{what}: {with} {without}");
        }
    }
}
