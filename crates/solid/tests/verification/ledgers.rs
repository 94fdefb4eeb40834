//! Axial momentum changes by what the ledger says came in; energy is never made.

use mesh::FaceState;
use mesh::Limiter;
use solid::{Boundary, ElasticState, SolidSetup, SolidSolver, Totals};

use crate::helpers::*;

/// A start that excites all components: a displaced, moving, sheared lump off the axis.
fn lump([z, r]: [f64; 2]) -> ElasticState {
    let bell = (-((z - 0.55) / 0.15).powi(2) - ((r - 0.35) / 0.2).powi(2)).exp();
    ElasticState {
        v_z: 2.0 * bell,
        v_r: -r * bell,
        stress_zz: -5e7 * bell,
        stress_zr: 2e7 * r * bell,
        stress_rr: -3e7 * bell,
        stress_phiphi: -3e7 * bell,
    }
}

/// The change of axial momentum that the ledger does not explain, relative to 1 m/s of the whole mass.
fn imbalance(solid: &mut SolidSolver<8>, steps: usize, load: impl Fn(usize, f64) -> FaceState) -> f64 {
    let start = solid.totals();
    for _ in 0..steps {
        let time = solid.time();
        solid.interface_mut().set_all(|face| load(face, time));
        solid.step_at(CFL).unwrap();
    }
    let change = solid.totals().momentum_z - start.momentum_z - solid.ledger().momentum.iter().sum::<f64>();
    eprintln!("imbalance of axial momentum {:.1e}", change / start.mass);
    change / start.mass
}

/// Round-off: √300 steps times ε of speeds of 1 m/s and of stresses worth as much, and of the sums.
const ROUND_OFF: f64 = 1e-14;

#[test]
fn momentum_balances() {
    let rest = |_, _| FaceState::default();
    for boundaries in [
        CYLINDER,
        [Boundary::Fixed, Boundary::Free, Boundary::Axis, Boundary::Fixed],
        [Boundary::NonReflecting, Boundary::NonReflecting, Boundary::Axis, Boundary::NonReflecting],
        [Boundary::Absorbing, Boundary::Absorbing, Boundary::Axis, Boundary::Absorbing],
    ] {
        let mut solid = SolidSolver::<8>::new(setup(AXIAL, [32, 32], boundaries), lump).unwrap();
        assert!(imbalance(&mut solid, 300, rest).abs() < ROUND_OFF);
    }
    let mut solid = SolidSolver::<8>::new(setup(PLANAR, [32, 32], PERIODIC), lump).unwrap();
    assert!(imbalance(&mut solid, 300, rest).abs() < ROUND_OFF);
    assert_eq!(*solid.ledger(), solid::BoundaryLedger::default(), "there are no sides");
}

#[test]
fn momentum_and_work_of_a_load_on_the_surface() {
    let boundaries = [Boundary::NonReflecting, Boundary::Interface, Boundary::Axis, Boundary::NonReflecting];
    let mut solid =
        SolidSolver::<8>::new(setup(AXIAL, [32, 32], boundaries), |_| ElasticState::default()).unwrap();
    let bell = |face: usize| (-(face as f64 / 8.0).powi(2)).exp();
    let load = |face: usize, time: f64| FaceState {
        pressure: 1e8 * bell(face) * (1e5 * time).sin(),
        velocity: -2.0 * bell(face) * (1e5 * time).sin(),
        power: -2.1e8 * (bell(face) * (1e5 * time).sin()).powi(2),
        ..FaceState::default()
    };
    assert!(imbalance(&mut solid, 300, load).abs() < ROUND_OFF);
    // Pressure on the surface pushes down, and works where the surface yields; the ledger takes the given
    // mean of the product.
    let (mut impulse, mut work, dt) = (0.0, 0.0, solid.time_step_limit(CFL));
    for step in 0..300 {
        for face in 0..solid.interface().faces() {
            let h = 1.0 / 32.0;
            let area = (face as f64 + 0.5) * h * h;
            let state = load(face, step as f64 * dt);
            impulse -= dt * area * state.pressure;
            work -= dt * area * state.power;
        }
    }
    // The sums are formed in another order; times differ by round-off.
    assert!((solid.ledger().momentum[1] / impulse - 1.0).abs() < 1e-10);
    assert!((solid.ledger().energy[1] / work - 1.0).abs() < 1e-10);
}

fn energy(totals: Totals) -> f64 {
    totals.kinetic + totals.elastic
}

#[test]
fn energy_only_falls_in_the_long_run() {
    for limiter in [Limiter::None, Limiter::Mc] {
        for boundaries in [CYLINDER, [Boundary::Free, Boundary::Free, Boundary::Axis, Boundary::Free]] {
            let setup = SolidSetup { limiter, ..setup(AXIAL, [32, 32], boundaries) };
            let mut solid = SolidSolver::<8>::new(setup, lump).unwrap();
            let mut last = energy(solid.totals());
            for step in 0..4000 {
                solid.step_at(CFL).unwrap();
                let now = energy(solid.totals());
                // Round-off of the sum over a thousand cells.
                assert!(now <= last * (1.0 + 1e-13), "{limiter:?} {step}: {last} -> {now}");
                last = now;
            }
        }
    }
}

#[test]
fn energy_only_falls_and_less_on_finer_grids() {
    for boundaries in [CYLINDER, [Boundary::Fixed, Boundary::Free, Boundary::Axis, Boundary::Fixed]] {
        let losses = [32, 64, 128].map(|n| {
            let setup: SolidSetup = setup(AXIAL, [n, n], boundaries);
            let mut solid = SolidSolver::<8>::new(setup, lump).unwrap();
            let start = energy(solid.totals());
            let mut last = start;
            while solid.time() < 2e-4 {
                solid.step_at(CFL).unwrap();
                let now = energy(solid.totals());
                assert!(now <= last * (1.0 + 1e-14), "{n}: {last} -> {now}");
                last = now;
            }
            1.0 - last / start
        });
        // The loss of a second-order scheme in smooth waves falls like h³; edges at the walls slow that down.
        assert!(order(&format!("loss of energy, {:?}", boundaries[0]), &losses) > 1.5);
    }
}
