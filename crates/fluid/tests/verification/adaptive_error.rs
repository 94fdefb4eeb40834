//! How far an adaptive run is from the uniform one on the same finest level, measured by the error that the uniform
//! run itself has.

use fluid::{
    Boundary, FluidSetup, FluidSolver, InitialCondition, Phase, PhaseState, Pulse, PulseShape, Region,
    Scales, Shape,
};
use mesh::{Adaptation, Domain, Geometry};

use crate::helpers::*;

const BLOCK: usize = 8;

/// A problem and the grids it is run on.
struct Problem {
    name: &'static str,
    setup: FluidSetup,
    initial: InitialCondition,
    end: f64,
    /// ρc, with which velocities are compared with pressures.
    impedance: f64,
}

/// What is compared: ρ, p and ρc times the velocities.
const COMPARED: [&str; 3] = ["density", "pressure", "velocity"];

/// An adaptive or uniform run: the state on a grid of `cells` (row by row in r) and the cells advanced.
struct Run {
    cells: [usize; 2],
    states: Vec<[f64; 4]>,
    updates: u64,
}

fn cells(setup: &FluidSetup) -> [usize; 2] {
    setup.coarsest.map(|cells| cells << setup.levels)
}

fn run(problem: &Problem, levels: u8, epsilon: Option<f64>) -> Run {
    let adaptation = epsilon.map(|epsilon| Adaptation::by_details(epsilon, 8));
    let setup = FluidSetup { levels, adaptation, ..problem.setup.clone() };
    let mut fluid = FluidSolver::<BLOCK>::new(&setup, &problem.initial).unwrap();
    while fluid.time() < problem.end * (1.0 - 1e-12) {
        let dt = fluid.time_step_limit(CFL).min(problem.end - fluid.time());
        fluid.step(dt).unwrap();
        fluid.adapt_if_due(dt, 1);
    }
    let cells = cells(&setup);
    let [h_z, h_r] = fluid.mesh().widths(levels);
    let Domain { z, r, .. } = setup.domain;
    let states = (0..cells[0] * cells[1])
        .map(|k| {
            let (i, j) = (k % cells[0], k / cells[0]);
            let place = [z[0] + (i as f64 + 0.5) * h_z, r[0] + (j as f64 + 0.5) * h_r];
            let w = fluid.sample(place).unwrap();
            [w.density, w.pressure, problem.impedance * w.v_z, problem.impedance * w.v_r]
        })
        .collect();
    Run { cells, states, updates: fluid.cell_updates() }
}

/// A run on the grid twice as coarse: means of 2 × 2 cells, weighted with their volumes.
fn coarsened(run: &Run, geometry: Geometry) -> Run {
    let cells = run.cells.map(|cells| cells / 2);
    let states = (0..cells[0] * cells[1])
        .map(|k| {
            let (i, j) = (2 * (k % cells[0]), 2 * (k / cells[0]));
            let lower = if geometry == AXIAL { (j as f64 + 0.5) / (2.0 * j as f64 + 2.0) } else { 0.5 };
            let at = |i: usize, j: usize| run.states[j * run.cells[0] + i];
            std::array::from_fn(|c| {
                0.5 * (lower * (at(i, j)[c] + at(i + 1, j)[c])
                    + (1.0 - lower) * (at(i, j + 1)[c] + at(i + 1, j + 1)[c]))
            })
        })
        .collect();
    Run { cells, states, updates: run.updates }
}

/// L1 differences of two runs on one grid, field by field.
fn difference(a: &Run, b: &Run) -> [f64; 3] {
    assert_eq!(a.cells, b.cells);
    differences(&a.states, &b.states, |[rho, p, v_z, v_r]| [rho, p, v_z + v_r])
}

/// What an adaptive run loses and saves: its differences to the uniform run relative to that run's error, and its
/// share of the cell updates.
#[derive(Clone, Copy, Debug)]
struct Loss {
    ratios: [f64; 3],
    cells: f64,
}

/// Differences of adaptive runs to the uniform one, each relative to the uniform run's error.
fn measure<const K: usize>(problem: &Problem, epsilons: [f64; K]) -> [Loss; K] {
    let levels = problem.setup.levels;
    let uniform = run(problem, levels, None);
    let finer = coarsened(&run(problem, levels + 1, None), problem.setup.domain.geometry);
    let error = difference(&uniform, &finer);
    epsilons.map(|epsilon| {
        let adaptive = run(problem, levels, Some(epsilon));
        let differences = difference(&adaptive, &uniform);
        let ratios = [0, 1, 2].map(|k| differences[k] / error[k]);
        let cells = adaptive.updates as f64 / uniform.updates as f64;
        eprintln!(
            "{}: epsilon {epsilon:.0e}: difference / error {ratios:.3?} of {COMPARED:?}, {cells:.3} of the cell updates",
            problem.name
        );
        Loss { ratios, cells }
    })
}

fn liquid(pressure: f64) -> PhaseState {
    PhaseState { phase: Phase::Liquid, density: 1000.0, pressure, velocity: [0.0; 2] }
}

/// A Gaussian pulse of 1e4 Pa, 12 cells of the finest grid a width, in a domain of 16 widths; it spreads over six.
fn pulse(name: &'static str, geometry: Geometry, centre: [f64; 2]) -> Problem {
    let axis = if geometry == AXIAL { Boundary::Axis } else { Boundary::Wall };
    let (width, amplitude, pressure) = (1.0 / 16.0, 1e4, 1e5);
    let c = (LIQUID.gamma * (pressure + LIQUID.pi) / 1000.0).sqrt();
    Problem {
        name,
        setup: FluidSetup {
            levels: 3,
            scales: Scales { pressure: amplitude, density: amplitude / (c * c) },
            ..setup(geometry, [24, 24], [Boundary::Wall, Boundary::Wall, axis, Boundary::Wall])
        },
        initial: InitialCondition {
            ambient: liquid(pressure),
            pressure: fluid::InitialPressure::Uniform,
            regions: vec![],
            pulses: vec![Pulse { shape: PulseShape::Sphere, centre, width, amplitude }],
        },
        end: 6.0 * width / c,
        impedance: 1000.0 * c,
    }
}

/// Sod's shock tube between gases, along z.
fn sod() -> Problem {
    let gas = |density, pressure| PhaseState { phase: Phase::Gas, density, pressure, velocity: [0.0; 2] };
    Problem {
        name: "Sod",
        setup: FluidSetup {
            levels: 3,
            domain: Domain { geometry: PLANAR, z: [0.0, 1.0], r: [0.0, 0.125] },
            scales: Scales { pressure: 0.9, density: 0.875 },
            ..setup(PLANAR, [64, 8], WALLS)
        },
        initial: InitialCondition {
            ambient: gas(1.0, 1.0),
            pressure: fluid::InitialPressure::Uniform,
            regions: vec![Region {
                shape: Shape::Box { z: [0.5, 2.0], r: [-1.0, 2.0] },
                state: gas(0.125, 0.1),
            }],
            pulses: vec![],
        },
        end: 0.2,
        impedance: 0.5,
    }
}

#[test]
fn a_pulse_loses_less_to_adaptation_with_smaller_epsilon() {
    // Smooth waves are the hard case: what is lost in every cell they cross adds up, and the error of the uniform
    // run is small. At epsilon = 1e-3 as much as ten times that error is lost.
    for problem in [
        pulse("planar pulse", PLANAR, [0.47, 0.52]),
        pulse("pulse on the axis", AXIAL, [0.47, 0.0]),
        pulse("pulse off the axis", AXIAL, [0.47, 0.3]),
    ] {
        let [coarse, fine] = measure(&problem, [1e-3, 3e-6]);
        for k in 0..3 {
            assert!(fine.ratios[k] < 0.1, "{fine:?}");
            assert!(fine.ratios[k] < 0.05 * coarse.ratios[k], "{coarse:?} {fine:?}");
        }
        assert!(fine.cells < 0.7 && coarse.cells < 0.15, "{coarse:?} {fine:?}");
    }
}

#[test]
fn a_shock_tube_loses_little_to_adaptation() {
    let [coarse, middle, fine] = measure(&sod(), [1e-2, 1e-3, 3e-4]);
    for k in 0..3 {
        assert!(middle.ratios[k] < 0.25 && fine.ratios[k] < 0.1, "{middle:?} {fine:?}");
        assert!(middle.ratios[k] < 0.2 * coarse.ratios[k], "{coarse:?} {middle:?}");
        assert!(fine.ratios[k] < 0.6 * middle.ratios[k], "{middle:?} {fine:?}");
    }
    assert!(fine.cells < 0.4, "{fine:?}");
}
