//! Plane waves of uniaxial strain in solids that yield, against exact solutions.
//!
//! With s = −σ_zz and M = K + (4μ/3) H/(3μ + H): an elastic precursor of strength A c₁²/(2c₂²) at c₁, then a plastic wave at
//! √(M/ρ). Numbers of the pulses are an independent program's, by following all waves and their meetings.

use mesh::{Domain, FaceState, GroupStep, Part};
use solid::plasticity::Hardening;
use solid::{Boundary, ElasticState, SolidSetup, SolidSolver, WaveSpeeds};

use crate::helpers::*;

pub const ALUMINIUM: WaveSpeeds = WaveSpeeds { density: 2700.0, c1: 6320.0, c2: 3130.0 };

/// A + H ε_p.
pub fn law([strength, modulus]: [f64; 2]) -> Hardening {
    if modulus == 0.0 {
        Hardening::perfect(strength).unwrap()
    } else {
        Hardening::linear(strength, modulus).unwrap()
    }
}

/// A bar `depth` long of `n` cells, that a pressure on z = 0 acts on.
pub fn bar(speeds: WaveSpeeds, hardening: Option<Hardening>, depth: f64, n: usize) -> SolidSolver<8> {
    let h = depth / n as f64;
    let boundaries = [Boundary::NonReflecting, Boundary::Interface, Boundary::Periodic, Boundary::Periodic];
    let setup = SolidSetup {
        domain: Domain { geometry: PLANAR, z: [-depth, 0.0], r: [0.0, 8.0 * h] },
        speeds,
        plasticity: hardening,
        ..setup(PLANAR, [n, 8], boundaries)
    };
    SolidSolver::new(setup, |_| ElasticState::default()).unwrap()
}

/// Steps of at most `most` to `end` under a pressure of place and time of the middle of the step.
pub fn press<const N: usize>(
    solid: &mut SolidSolver<N>,
    end: f64,
    pressure: impl Fn(f64, f64) -> f64,
    mut after: impl FnMut(&mut SolidSolver<N>, f64),
) {
    while solid.time() < end * (1.0 - 1e-12) {
        let left = end - solid.time();
        let dt = left / (left / solid.time_step_limit(CFL)).ceil();
        solid.begin_step(dt, u8::MAX);
        let step = solid.start(f64::INFINITY);
        load(solid, step, &pressure);
        solid.run(step, Part::All).unwrap();
        solid.finish().unwrap();
        after(solid, dt);
    }
}

/// [`whole_steps`] under such a pressure.
pub fn press_locally<const N: usize>(
    solid: &mut SolidSolver<N>,
    steps: usize,
    pressure: impl Fn(f64, f64) -> f64,
    after: impl FnMut(&mut SolidSolver<N>, f64),
) {
    let run = |solid: &mut SolidSolver<N>| {
        while solid.clock().due().is_some() {
            let limit = solid.due_limit(CFL);
            let step = solid.start(limit);
            load(solid, step, &pressure);
            solid.run(step, Part::All).unwrap();
        }
        solid.finish().unwrap();
    };
    whole_steps(solid, steps, run, after);
}

/// Sets the surface of the levels that are about to make a step: what a pressure makes of the solid's own trace.
fn load<const N: usize>(solid: &mut SolidSolver<N>, step: GroupStep, pressure: impl Fn(f64, f64) -> f64) {
    let mut traces = vec![];
    solid.group_traces_at_mid_step(step, &mut traces);
    let (edges, low) = (solid.interface_edges(), solid.mesh().domain().r[0]);
    let middle = step.begin + 0.5 * step.dt;
    for (face, trace) in traces.iter().enumerate() {
        if solid.group_of_face(face) != step.group {
            continue;
        }
        let before = if face == 0 { low } else { edges[face - 1] };
        let load = pressure(0.5 * (before + edges[face]), middle);
        let velocity = trace.velocity + (trace.pressure - load) / trace.impedance;
        let state = FaceState { pressure: load, velocity, power: load * velocity, ..FaceState::default() };
        solid.interface_mut().set(face, state);
    }
}

/// Cells from the surface down: z, [σ_zz, σ_rr, v_z, ε_p].
fn column(solid: &SolidSolver<8>) -> Vec<(f64, [f64; 4])> {
    let mut cells = Vec::new();
    for (slot, id) in solid.mesh().tree().leaves().iter().enumerate() {
        for i in 0..8 {
            let w = solid.cell(slot, i, 0);
            let z = solid.mesh().centre(*id, i, 0)[0];
            cells.push((z, [w.stress_zz, w.stress_rr, w.v_z, solid.plastic_strain(slot, i, 0)]));
        }
    }
    cells.sort_by(|a, b| b.0.total_cmp(&a.0));
    cells
}

/// Depth at which σ_zz passes a value, from below.
fn front(cells: &[(f64, [f64; 4])], stress: f64) -> f64 {
    let k = (1..cells.len()).rev().find(|k| cells[*k - 1].1[0] <= stress && cells[*k].1[0] > stress).unwrap();
    let ((za, a), (zb, b)) = (cells[k - 1], cells[k]);
    -(za + (zb - za) * (stress - a[0]) / (b[0] - a[0]))
}

/// Elastic and plastic waves behind a step load: speeds, plateaus.
#[test]
fn both_waves_of_a_step_load_are_the_exact_ones() {
    // Material, [A, H], P; behind the precursor σ_zz, σ_rr, v_z, behind the plastic wave those and ε_p; its speed.
    #[rustfmt::skip]
    let rows = [
        (STEEL, [4e8, 0.0], [-6.00113867442e8, -2.00113867442e8, -12.8443531407],
         [-1.5e9, -1.1e9, -38.6829798378, 3.85793262977e-3], 4465.02123922),
        (STEEL, [4e8, 8e9], [-6.00113867442e8, -2.00113867442e8, -12.8443531407],
         [-1.5e9, -1.07064691303e9, -38.4004951562, 3.66913587161e-3], 4514.37532804),
        (ALUMINIUM, [2.5e8, 0.0], [-5.09630597434e8, -2.59630597434e8, -29.865834355],
         [-1.2e9, -9.5e8, -79.1836934895, 6.34160812605e-3], 5184.5797001),
        (ALUMINIUM, [2.5e8, 3e9], [-5.09630597434e8, -2.59630597434e8, -29.865834355],
         [-1.2e9, -9.31987078351e8, -78.7528826649, 6.00430721639e-3], 5230.26814178),
    ];
    for (speeds, constants, precursor, plateau, plastic_speed) in rows {
        let mut solid = bar(speeds, Some(law(constants)), 1.0, 640);
        let end = 0.8 / speeds.c1;
        press(&mut solid, end, |_, _| -plateau[0], |_, _| ());
        let cells = column(&solid);
        let mean = |from: f64, to: f64| -> [f64; 4] {
            let within: Vec<[f64; 4]> =
                cells.iter().filter(|(z, _)| -z > from && -z < to).map(|cell| cell.1).collect();
            std::array::from_fn(|c| within.iter().map(|w| w[c]).sum::<f64>() / within.len() as f64)
        };
        let (slow, fast) = (plastic_speed * end, speeds.c1 * end);
        let gap = fast - slow;
        let found = [mean(slow + 0.35 * gap, slow + 0.65 * gap), mean(0.3 * slow, 0.7 * slow)];
        let expected = [[precursor[0], precursor[1], precursor[2], 0.0], plateau];
        for (found, expected) in found.iter().zip(expected) {
            for c in 0..4 {
                let scale = if expected[c] == 0.0 { plateau[c] } else { expected[c] };
                let error = (found[c] - expected[c]) / scale;
                eprintln!("{constants:?} {c}: {error:.1e}");
                assert!(error.abs() < 1e-3, "{constants:?}: {c}: {found:?} of {expected:?}");
            }
        }
        // Of a load that jumps, the surface's own cell has too much, on any grid: an overshoot that stays. 0.15 to 0.29 where the surface
        // answers with the elastic impedance while it flows.
        let excess = cells[0].1[3] / plateau[3] - 1.0;
        eprintln!("{constants:?}: surface's own cell {excess:.3}");
        assert!(excess.abs() < 0.19, "{constants:?}: {excess}");
        let middles = [0.5 * precursor[0], 0.5 * (precursor[0] + plateau[0])];
        for (middle, exact) in middles.into_iter().zip([fast, slow]) {
            let off = front(&cells, middle) / exact - 1.0;
            eprintln!("{constants:?}: front off by {off:.1e}");
            assert!(off.abs() < 2e-3, "{constants:?}: {off}");
        }
    }
}

/// A pulse on a half-space: material, [A, H], [P, τ], [depth, integral of ε_p] that it leaves behind.
type Pulse = (WaveSpeeds, [f64; 2], [f64; 2], [f64; 2]);

/// What a rectangular pulse leaves behind after 15 τ, on cells of width `h`.
///
/// Waves that have gone through the plastic zone leave over the lower side.
fn left_behind(&(speeds, constants, [pressure, duration], [depth, ..]): &Pulse, h: f64) -> SolidSolver<8> {
    let n = (1.2 * depth / h / 8.0).ceil() as usize * 8;
    let mut solid = bar(speeds, Some(law(constants)), n as f64 * h, n);
    press(&mut solid, duration, |_, _| pressure, |_, _| ());
    press(&mut solid, 15.0 * duration, |_, _| 0.0, |_, _| ());
    solid
}

#[test]
fn a_rectangular_pulse_leaves_the_exact_plastic_strain_behind() {
    #[rustfmt::skip]
    let rows: [Pulse; 4] = [
        (STEEL, [4e8, 0.0], [1.5e9, 1e-7], [1.75382621127e-3, 9.17855836533e-6]),
        (STEEL, [4e8, 8e9], [1.5e9, 1e-7], [1.83251938848e-3, 8.40594557439e-6]),
        (ALUMINIUM, [2.5e8, 0.0], [9e8, 1e-7], [2.88585149547e-3, 1.03482667571e-5]),
        (ALUMINIUM, [2.5e8, 3e9], [1.4e9, 1.5e-7], [4.55001307063e-3, 4.6874811622e-5]),
    ];
    for row in rows {
        let (speeds, constants, [_, duration], [depth, integral]) = row;
        let error = |length: f64, cells: f64, what: &str| -> f64 {
            let solid = left_behind(&row, length / cells);
            let height = solid.mesh().domain().r[1];
            let found = solid.plastic_strain_integral() / height;
            eprintln!("{constants:?}, {cells} cells to {what}: {:.2e}", found / integral - 1.0);
            (found / integral - 1.0).abs()
        };
        let errors = [50.0, 100.0, 200.0].map(|cells| error(speeds.c1 * duration, cells, "c₁τ"));
        // The unloading wave's foot catches the smeared plastic front before its time, c₁/(c₁ − c_p) times as many cells early as both
        // are wide: order 1/2 to 1. Without the return of the states at mid-step the last errors are 0.018 to 0.036.
        assert!(errors[2] < 2.1e-2 && errors[2] < 0.5 * errors[0], "{constants:?}: {errors:?}");
        let coarse = error(depth, 200.0, "the depth that it yields to");
        assert!(coarse < 5.5e-2, "{constants:?}: {coarse}");
    }
}
