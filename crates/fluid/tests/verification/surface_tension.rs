//! Surface tension: Laplace's jump, spurious currents, ledgers.

use fluid::{
    Boundary, FluidError, FluidSetup, FluidSolver, InitialCondition, InitialPressure, Phase, PhaseState,
    Region, Scales, Shape, StiffenedGas, SurfaceTension,
};
use mesh::{Adaptation, Domain, Geometry};

use crate::helpers::*;
use crate::oscillations::set_moving;

/// σ = ρ_l U² R with U = 1 m/s, R = 1 m and ρ_l = 1000 kg/m³.
pub const TENSION: f64 = 1000.0;
/// So soft that sound is thirty times as fast as capillary waves, not five thousand times.
const SOFT: StiffenedGas = StiffenedGas { gamma: 4.4, pi: 2e5 };
const GAS_PRESSURE: f64 = 1e4;
pub const GAS_DENSITY: f64 = 10.0;

fn state(phase: Phase, density: f64, pressure: f64) -> PhaseState {
    PhaseState { phase, density, pressure, velocity: [0.0; 2] }
}

/// A ball of radius 1 m of one phase in the other, in a box of walls.
///
/// - `cells`: per radius; `half`: half the length of the box, m; `centre`: of the ball, from that of the box or its axis.
pub fn ball(
    kind: Kind,
    geometry: Geometry,
    inside: Phase,
    (cells, half): (usize, f64),
    centre: [f64; 2],
    change: impl Fn(&mut FluidSetup),
) -> FluidSolver<8> {
    let z = [-half, half];
    let r = if geometry == AXIAL { [0.0, half] } else { z };
    let count = |range: [f64; 2]| ((range[1] - range[0]) * cells as f64).round() as usize;
    let mut setup = FluidSetup {
        domain: Domain { geometry, z, r },
        liquid: SOFT.into(),
        surface_tension: Some(SurfaceTension {
            coefficient: TENSION,
            density: 1000.0,
            may_touch_walls: false,
        }),
        scales: Scales { pressure: 1e4, density: 1e3 },
        ..setup_of(kind, geometry, [count(z), count(r)], if geometry == AXIAL { CYLINDER } else { WALLS })
    };
    change(&mut setup);
    let jump = TENSION * if geometry == AXIAL { 2.0 } else { 1.0 };
    let sign = if inside == Phase::Gas { 1.0 } else { -1.0 };
    let gas = state(Phase::Gas, GAS_DENSITY, GAS_PRESSURE);
    let liquid = state(Phase::Liquid, 1000.0, GAS_PRESSURE - sign * jump);
    let (inner, ambient) = if inside == Phase::Gas { (gas, liquid) } else { (liquid, gas) };
    let initial = InitialCondition {
        ambient,
        pressure: InitialPressure::Uniform,
        regions: vec![Region { shape: Shape::Sphere { centre, radius: 1.0 }, state: inner }],
        pulses: vec![],
    };
    FluidSolver::new(&setup, &initial).unwrap()
}

/// The fastest fluid, m/s, and the mean pressures of the gas and the liquid.
fn at_rest(fluid: &FluidSolver<8>) -> (f64, f64, f64) {
    let mut fastest: f64 = 0.0;
    let mut sums = [[0.0; 2]; 2];
    each_cell(fluid, |_, _, w| {
        fastest = fastest.max(w.v_z.hypot(w.v_r));
        if w.phi < 1e-6 || w.phi > 1.0 - 1e-6 {
            let sum = &mut sums[usize::from(w.phi > 0.5)];
            *sum = [sum[0] + 1.0, sum[1] + w.pressure];
        }
    });
    let mean = |[count, sum]: [f64; 2]| sum / count;
    (fastest, mean(sums[1]), mean(sums[0]))
}

/// Where no symmetry of the grid helps: the centre of a ball, in cells.
fn aside(geometry: Geometry, cells: usize) -> [f64; 2] {
    [0.3 / cells as f64, if geometry == AXIAL { 0.0 } else { 0.4 / cells as f64 }]
}

#[test]
#[ignore = "a study of minutes: docs/theory/surface-tension.md has its numbers"]
fn study_of_balls_at_rest() {
    for &(name, kind) in rows(&[("sharp", SHARP), ("mixture", MIXTURE)]) {
        for geometry in [AXIAL, PLANAR] {
            for inside in [Phase::Gas, Phase::Liquid] {
                for &cells in rows(&[12, 16, 20, 32, 40]) {
                    let mut fluid =
                        ball(kind, geometry, inside, (cells, 2.0), aside(geometry, cells), |_| ());
                    let mut line = format!("{name} {geometry:?} {inside:?} {cells}:");
                    let jump = TENSION * if geometry == AXIAL { 2.0 } else { 1.0 };
                    for time in [0.2, 0.5, 1.0] {
                        run_to(&mut fluid, time);
                        let (fastest, gas, liquid) = at_rest(&fluid);
                        let off = 100.0 * ((gas - liquid).abs() / jump - 1.0);
                        line += &format!(" [{time}: u {fastest:.2e}, jump {off:+.4}%]");
                    }
                    eprintln!("{line}");
                }
            }
        }
    }
}

/// For a time R/U: where pressures do not balance beside the outermost cells of the interface, currents are eight times as fast by then.
#[test]
fn balls_at_rest_have_laplaces_jump() {
    for kind in KINDS {
        for inside in [Phase::Gas, Phase::Liquid] {
            let mut currents = vec![];
            for cells in [12, 20] {
                let mut fluid = ball(kind, AXIAL, inside, (cells, 2.0), aside(AXIAL, cells), |_| ());
                run_to(&mut fluid, 1.0);
                let (fastest, gas, liquid) = at_rest(&fluid);
                let jump = (gas - liquid).abs() / (2.0 * TENSION);
                eprintln!("{inside:?} {cells}: {fastest:.2e} m/s, jump {jump:.6}");
                assert!(cells < 20 || (jump - 1.0).abs() < 5e-3, "{jump}");
                currents.push(fastest);
            }
            assert!(currents[1] < 2e-4 && currents[1] < 0.25 * currents[0], "{currents:?}");
        }
    }
}

/// Mass, momentum and energy change by what the ledger says, on adaptive grids with steps of their own, too; the gas keeps its mass.
#[test]
fn the_ledger_has_the_work_and_the_impulse_of_tension() {
    for kind in KINDS {
        let mut fluid = ball(kind, AXIAL, Phase::Gas, (12, 2.0), [0.013, 0.0], |setup| {
            setup.coarsest = [24, 12];
            setup.levels = 1;
            setup.adaptation = Some(Adaptation::by_details(1e-3, 4));
        });
        set_moving(&mut fluid, Phase::Gas, 0.5);
        let (start, gas) = (fluid.totals(), fluid.bubble().gas_mass);
        for _ in 0..40 {
            let (dt, steps) = step_locally(&mut fluid);
            fluid.adapt_if_due(dt, steps);
        }
        let (end, ledger) = (fluid.totals(), *fluid.ledger());
        let sum = |sides: [f64; 4]| sides.iter().sum::<f64>();
        let momentum = end.momentum_z - start.momentum_z - sum(ledger.momentum) - ledger.tension_impulse;
        let energy = end.energy - start.energy - ledger.tension_work;
        eprintln!(
            "momentum {momentum:.1e} of {:.1e} N s, energy {energy:.1e} of {:.1e} J, work {:.2e} J",
            ledger.tension_impulse, start.energy, ledger.tension_work
        );
        assert!((end.mass / start.mass - 1.0).abs() < 1e-12);
        assert!(momentum.abs() < 1e-12 * start.mass, "{momentum}");
        assert!(energy.abs() < 1e-12 * start.energy && ledger.tension_work.abs() > 1e-7 * start.energy);
        assert!(kind == MIXTURE || (fluid.bubble().gas_mass / gas - 1.0).abs() < 1e-12);
    }
}

/// A moving ball's interface, ∫φ(1 − φ) dV, is as thick with tension as without.
#[test]
fn sharpening_acts_with_tension() {
    let thickness = |tension: Option<f64>| {
        let mut fluid = ball(SHARP, AXIAL, Phase::Gas, (12, 2.0), [-0.4, 0.0], |setup| {
            setup.boundaries = [Boundary::Periodic, Boundary::Periodic, Boundary::Axis, Boundary::Wall];
            setup.surface_tension = setup.surface_tension.filter(|_| tension.is_some());
        });
        for slot in 0..fluid.mesh().blocks() {
            let block = fluid.state_mut().block_mut(slot);
            for cell in 0..64 {
                block[64 + cell] = block[cell];
                block[192 + cell] += 0.5 * block[cell];
            }
        }
        run_to(&mut fluid, 0.3);
        let mut volume = 0.0;
        each_cell(&fluid, |[_, r], _, w| volume += r * w.phi * (1.0 - w.phi));
        volume
    };
    let (with, without) = (thickness(Some(TENSION)), thickness(None));
    eprintln!("volume of the interface with tension over that without: {:.3}", with / without);
    assert!((with / without - 1.0).abs() < 0.1, "{with} {without}");
}

#[test]
fn an_interface_at_a_wall_is_refused_without_an_angle() {
    let domain = Domain { geometry: AXIAL, z: [0.0, 4.0], r: [0.0, 2.0] };
    let at = |may_touch_walls: bool| {
        let tension = SurfaceTension { coefficient: 0.07, density: 1000.0, may_touch_walls };
        let setup = FluidSetup { surface_tension: Some(tension), ..setup_in(domain, [32, 16], CYLINDER) };
        FluidSolver::<8>::new(&setup, &ball_of_gas(([0.3, 0.0], 1.0), 1e5, AIR, 0.0))
    };
    let refused = at(false).err().unwrap();
    assert!(matches!(refused, FluidError::Contact { .. }), "{refused}");
    assert!(refused.to_string().contains("fluid.terms.contact_angle = 90"), "{refused}");
    assert!(at(true).is_ok());
}

/// The gas of a bubble of 10 µm in water has 1 kPa, its jump 14.6 kPa: the liquid is at −13.6 kPa, and mixed cells are in between.
#[test]
fn liquid_in_tension_around_a_small_bubble_stays_at_rest() {
    let (radius, sigma, gas_pressure) = (1e-5, 0.0728, 1e3);
    let length = 3.0 * radius;
    let domain = Domain { geometry: AXIAL, z: [-length, length], r: [0.0, length] };
    let tension = SurfaceTension { coefficient: sigma, density: 1000.0, may_touch_walls: false };
    let setup = FluidSetup {
        surface_tension: Some(tension),
        scales: Scales { pressure: 1e5, density: 1e3 },
        ..setup_in(domain, [96, 48], CYLINDER)
    };
    let initial = InitialCondition {
        ambient: state(Phase::Liquid, 1000.0, gas_pressure - 2.0 * sigma / radius),
        pressure: InitialPressure::Uniform,
        regions: vec![Region {
            shape: Shape::Sphere { centre: [0.3 * length / 48.0, 0.0], radius },
            state: state(Phase::Gas, 0.012, gas_pressure),
        }],
        pulses: vec![],
    };
    let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
    for _ in 0..200 {
        fluid.step_at(CFL).unwrap();
    }
    let (fastest, gas, liquid) = at_rest(&fluid);
    let jump = (gas - liquid) * radius / (2.0 * sigma);
    let speed = (sigma / (1000.0 * radius)).sqrt();
    eprintln!("{:.1e} of the capillary speed, jump {jump:.5}", fastest / speed);
    assert!(liquid < 0.0 && (jump - 1.0).abs() < 5e-3, "{gas} {liquid}");
    assert!(fastest < 5e-4 * speed, "{fastest}");
    let fixups = fluid.fixups();
    assert!(fixups.clips.expanded_cells == 0 && fixups.floored == 0, "{fixups:?}");
}
