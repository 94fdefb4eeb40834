//! Totals change by what the ledger says came in, to round-off.

use fluid::{Boundary, FluidSetup, FluidSolver, InitialCondition, PressureHistory, Primitive};
use mesh::{Geometry, Side};

use crate::helpers::*;

/// Imbalances of mass, axial momentum, energy and, where the model knows it, the gas's mass after some steps, relative to the
/// totals (the momentum to what a side brought in, or to 10 m/s of all mass).
fn imbalance<const N: usize>(
    fluid: &mut FluidSolver<N>,
    steps: usize,
    mut before: impl FnMut(&mut FluidSolver<N>, f64),
) -> [f64; 4] {
    let (start, gas) = (fluid.totals(), fluid.bubble().gas_mass);
    for _ in 0..steps {
        let dt = fluid.time_step_limit(CFL);
        before(fluid, dt);
        fluid.step(dt).unwrap();
    }
    let [mass, momentum, energy] = imbalance_since(fluid, &start);
    // Of the gas unknown, or none at all.
    let gas = if gas > 0.0 { fluid.bubble().gas_mass / gas - 1.0 } else { 0.0 };
    let imbalance = [mass, momentum, energy, gas];
    eprintln!("imbalance of mass, momentum, energy, gas {} {:?}", scientific(&imbalance), fluid.fixups());
    imbalance
}

/// Round-off: each step adds a few ε = 2e-16 relative in every cell, with random signs: √steps ε, and the
/// sums over cells as much again.
const ROUND_OFF: f64 = 1e-13;

fn check(imbalance: &[f64]) {
    assert!(imbalance.iter().all(|part| part.abs() < ROUND_OFF), "{imbalance:?}");
}

/// A gas bubble of radius 0.3 in liquid of 5e6 Pa.
fn bubble(centre: [f64; 2]) -> InitialCondition {
    ball_of_gas((centre, 0.3), 5e6, AIR, 0.0)
}

/// A bubble 300 steps later, when everything is where it was or has passed a side.
fn collapsed(kind: Kind, (geometry, sides): (Geometry, [Boundary; 4]), centre: [f64; 2]) -> FluidSolver<8> {
    let mut fluid = FluidSolver::new(&setup_of(kind, geometry, [32, 32], sides), &bubble(centre)).unwrap();
    check(&imbalance(&mut fluid, 300, |_, _| {}));
    fluid
}

#[test]
fn a_collapse_in_a_closed_cylinder() {
    for kind in KINDS {
        let fluid = collapsed(kind, (AXIAL, CYLINDER), [0.4, 0.0]);
        assert_eq!(fluid.ledger().mass, [0.0; 4], "no mass passes a wall");
    }
}

#[test]
fn a_collapse_in_a_periodic_box() {
    for kind in KINDS {
        let fluid = collapsed(kind, (PLANAR, PERIODIC), [0.4, 0.6]);
        assert_eq!(*fluid.ledger(), fluid::BoundaryLedger::default(), "there are no sides");
    }
}

#[test]
fn waves_enter_and_leave() {
    let mut boundaries = CYLINDER;
    boundaries[Side::ZMin as usize] = Boundary::Inflow;
    boundaries[Side::ZMax as usize] = Boundary::NonReflecting;
    boundaries[Side::RMax as usize] = Boundary::NonReflecting;
    for kind in KINDS {
        let setup = FluidSetup {
            inflow: PressureHistory::new(vec![[0.0, 5e6], [1e-4, 9e7], [3e-4, 1e7]]),
            ..setup_of(kind, AXIAL, [32, 32], boundaries)
        };
        let mut fluid = FluidSolver::<8>::new(&setup, &bubble([0.7, 0.0])).unwrap();
        // The bubble touches an open side: gas leaves.
        check(&imbalance(&mut fluid, 200, |_, _| {})[..3]);
        assert!(fluid.ledger().mass[Side::ZMin as usize] > 0.0 && fluid.ledger().energy[3] != 0.0);
    }
}

#[test]
fn a_moving_wall_gives_and_takes() {
    KINDS.into_iter().for_each(moving_wall);
}

fn moving_wall(kind: Kind) {
    let mut boundaries = CYLINDER;
    boundaries[Side::ZMin as usize] = Boundary::Interface;
    let setup = setup_of(kind, AXIAL, [32, 32], boundaries);
    let start = |[z, _]: [f64; 2]| Primitive { v_z: 3.0 * z, ..still(5e7) };
    let mut fluid = FluidSolver::<8>::from_fn(&setup, start).unwrap();
    let (mut impulse, mut work) = (0.0, 0.0);
    let balance = imbalance(&mut fluid, 200, |fluid, dt| {
        // Some motion of the wall, larger at the axis; the mean of pv is not the product of the means.
        let n = fluid.interface().faces();
        let phase = 5e3 * fluid.time();
        let at = |face: usize| (-(face as f64 / 10.0).powi(2)).exp();
        let velocity: Vec<f64> = (0..n).map(|face| 2.0 * at(face) * phase.sin()).collect();
        let pressure: Vec<f64> = (0..n).map(|face| 5e7 - 2e6 * at(face) * phase.sin()).collect();
        let power: Vec<f64> = (0..n).map(|face| 1.01 * pressure[face] * velocity[face]).collect();
        for face in 0..n {
            let h = 1.0 / 32.0;
            let area = (face as f64 + 0.5) * h * h;
            impulse += dt * area * pressure[face];
            work += dt * area * power[face];
        }
        fluid.interface_mut().set_rows([&pressure, &velocity, &power]);
    });
    check(&balance);
    // The wall's impulse and work are in the ledger: what passes besides is what the moving fluid carries,
    // ρ*v*², and its internal energy.
    let ledger = fluid.ledger();
    assert!((ledger.momentum[0] / impulse - 1.0).abs() < 1e-4);
    assert!(ledger.mass[0].abs() > 1e-3 && work.abs() > 0.0);
}
