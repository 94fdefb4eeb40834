//! How far an adaptive run is from the uniform one on the same finest level, measured by the error that the uniform
//! run itself has.

use mesh::{Adaptation, Domain, Geometry};
use solid::{Boundary, ElasticState, SolidSetup, SolidSolver};

use crate::helpers::*;

const BLOCK: usize = 8;

/// Cells of the finest grid along either side, in four levels.
const CELLS: usize = 192;

/// Width of the pulse: 12 cells of the finest grid.
const WIDTH: f64 = 1.0 / 16.0;

/// The state on a grid of `cells` × `cells` (row by row in r): stresses and ρc₁ times the velocities.
struct Run {
    cells: usize,
    states: Vec<[f64; 6]>,
    updates: u64,
}

/// The stresses of u = ∇(Φ exp(−R²/a²)), in a plane or about a point of the axis; the largest is `amplitude`.
fn pulse(geometry: Geometry, centre: [f64; 2], amplitude: f64) -> impl Fn([f64; 2]) -> ElasticState + Sync {
    let (lambda, mu) = {
        let mu = STEEL.density * STEEL.c2 * STEEL.c2;
        (STEEL.density * STEEL.c1 * STEEL.c1 - 2.0 * mu, mu)
    };
    let potential = amplitude * WIDTH * WIDTH / (2.0 * (lambda + 2.0 * mu));
    move |place| {
        let d = [place[0] - centre[0], place[1] - centre[1]];
        let s = (d[0] * d[0] + d[1] * d[1]) / (WIDTH * WIDTH);
        let around = -2.0 * potential / (WIDTH * WIDTH) * (-s).exp();
        let along = around * (1.0 - 2.0 * s);
        let hoop = if geometry == AXIAL { around } else { 0.0 };
        let n = if s > 0.0 { d.map(|d| d / (WIDTH * s.sqrt())) } else { [1.0, 0.0] };
        let strain = |a: usize, b: usize| {
            let isotropic = if a == b { around } else { 0.0 };
            isotropic + (along - around) * n[a] * n[b]
        };
        let pressure = lambda * (along + around + hoop);
        ElasticState {
            v_z: 0.0,
            v_r: 0.0,
            stress_zz: pressure + 2.0 * mu * strain(0, 0),
            stress_zr: 2.0 * mu * strain(0, 1),
            stress_rr: pressure + 2.0 * mu * strain(1, 1),
            stress_phiphi: pressure + 2.0 * mu * hoop,
        }
    }
}

const AMPLITUDE: f64 = 1e6;

fn run(geometry: Geometry, levels: u8, epsilon: Option<f64>) -> Run {
    let low = if geometry == AXIAL { Boundary::Axis } else { Boundary::Symmetry };
    let setup = SolidSetup {
        domain: Domain { geometry, z: [0.0, 1.0], r: [0.0, 1.0] },
        levels,
        adaptation: epsilon.map(|epsilon| Adaptation::by_details(epsilon, 8)),
        stress_scale: AMPLITUDE,
        ..setup(geometry, [CELLS / 8; 2], [Boundary::Symmetry, Boundary::Symmetry, low, Boundary::Symmetry])
    };
    let centre = if geometry == AXIAL { [0.47, 0.0] } else { [0.47, 0.52] };
    let mut solid = SolidSolver::<BLOCK>::new(setup, pulse(geometry, centre, AMPLITUDE)).unwrap();
    let end = 5.0 * WIDTH / STEEL.c1;
    while solid.time() < end * (1.0 - 1e-12) {
        let dt = solid.time_step_limit(CFL).min(end - solid.time());
        let adapts = solid.adaptation_follows(dt, 1);
        solid.step(dt).unwrap();
        if adapts {
            solid.adapt(dt, 1);
        }
    }
    let cells = (CELLS / 8) << levels;
    let h = 1.0 / cells as f64;
    let impedance = STEEL.density * STEEL.c1;
    let states = (0..cells * cells)
        .map(|k| {
            let place = [((k % cells) as f64 + 0.5) * h, ((k / cells) as f64 + 0.5) * h];
            let [v_z, v_r, zz, zr, rr, pp] = solid.sample(place).unwrap().to_array();
            [impedance * v_z, impedance * v_r, zz, zr, rr, pp]
        })
        .collect();
    Run { cells, states, updates: solid.cell_updates() }
}

/// A run on the grid twice as coarse: means of 2 × 2 cells, weighted with their volumes.
fn coarsened(run: &Run, geometry: Geometry) -> Run {
    let cells = run.cells / 2;
    let states = (0..cells * cells)
        .map(|k| {
            let (i, j) = (2 * (k % cells), 2 * (k / cells));
            let lower = if geometry == AXIAL { (2.0 * j as f64 + 1.0) / (4.0 * j as f64 + 4.0) } else { 0.5 };
            let at = |i: usize, j: usize| run.states[j * run.cells + i];
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
            std::array::from_fn(|k| 0.5 * (lower * (a[k] + b[k]) + (1.0 - lower) * (c[k] + d[k])))
        })
        .collect();
    Run { cells, states, updates: run.updates }
}

/// L1 differences of the velocities and the stresses.
fn difference(a: &Run, b: &Run) -> [f64; 2] {
    assert_eq!(a.cells, b.cells);
    differences(&a.states, &b.states, |[v_z, v_r, zz, zr, rr, pp]| [v_z + v_r, zz + zr + rr + pp])
}

#[test]
fn a_pulse_loses_little_to_adaptation_and_less_with_smaller_epsilon() {
    for geometry in [PLANAR, AXIAL] {
        let uniform = run(geometry, 3, None);
        let error = difference(&uniform, &coarsened(&run(geometry, 4, None), geometry));
        let [coarse, fine] = [1e-3, 1e-4].map(|epsilon| {
            let adaptive = run(geometry, 3, Some(epsilon));
            let differences = difference(&adaptive, &uniform);
            let ratios = [0, 1].map(|k| differences[k] / error[k]);
            let cells = adaptive.updates as f64 / uniform.updates as f64;
            eprintln!(
                "{geometry:?}, epsilon {epsilon:.0e}: difference / error {ratios:.3?} of velocities and stresses, \
                 {cells:.3} of the cell updates"
            );
            assert!(cells < 0.6);
            ratios
        });
        for k in 0..2 {
            assert!(fine[k] < 0.1, "within 10 % of the uniform run's error: {fine:?}");
            assert!(coarse[k] < 1.2 && fine[k] < 0.2 * coarse[k], "{coarse:?} {fine:?}");
        }
    }
}
