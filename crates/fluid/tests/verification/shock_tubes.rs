//! Shock tubes against the exact solution.

use fluid::exact_riemann::{Side, sample, star_state, waves};
use fluid::{Boundary, FluidSetup, FluidSolver, Primitive, RiemannSolver, StiffenedGas};
use mesh::Domain;

use crate::helpers::*;

struct Tube {
    name: &'static str,
    left: Side,
    right: Side,
    length: f64,
    /// Place of the diaphragm.
    at: f64,
    end: f64,
    /// Gas fractions on the two sides.
    phi: [f64; 2],
}

fn sod() -> Tube {
    let side = |rho, p| Side { rho, u: 0.0, p, gamma: 1.4, pi: 0.0, covolume: 0.0 };
    let (left, right) = (side(1.0, 1.0), side(0.125, 0.1));
    Tube { name: "Sod", left, right, length: 1.0, at: 0.5, end: 0.2, phi: [1.0, 1.0] }
}

/// Water of 1e9 Pa against dense gas of 1e5 Pa (Saurel & Abgrall 1999).
fn water_on_dense_gas() -> Tube {
    let left = Side { rho: 1000.0, u: 0.0, p: 1e9, gamma: 4.4, pi: 6e8, covolume: 0.0 };
    let right = Side { rho: 50.0, u: 0.0, p: 1e5, gamma: 1.4, pi: 0.0, covolume: 0.0 };
    Tube { name: "Saurel-Abgrall", left, right, length: 1.0, at: 0.7, end: 2.29e-4, phi: [0.0, 1.0] }
}

/// The bubble's wall at the start: water of 5e7 Pa against gas of 2118 Pa.
fn water_on_thin_gas() -> Tube {
    let left = Side { rho: 1000.0, u: 0.0, p: 5e7, gamma: LIQUID.gamma, pi: LIQUID.pi, covolume: 0.0 };
    let right = Side { rho: 0.0266, u: 0.0, p: 2118.0, gamma: 1.4, pi: 0.0, covolume: 0.0 };
    Tube { name: "water 5e7 | gas 2118", left, right, length: 1e-3, at: 5e-4, end: 2e-7, phi: [0.0, 1.0] }
}

fn run(tube: &Tube, cells: usize, riemann: RiemannSolver) -> FluidSolver<8> {
    let eos = |side: &Side| StiffenedGas { gamma: side.gamma, pi: side.pi };
    let liquid = if tube.phi[0] == 0.0 { eos(&tube.left) } else { LIQUID };
    let boundaries = [Boundary::NonReflecting, Boundary::NonReflecting, Boundary::Wall, Boundary::Wall];
    let setup = FluidSetup {
        domain: Domain {
            geometry: PLANAR,
            z: [0.0, tube.length],
            r: [0.0, tube.length * 8.0 / cells as f64],
        },
        liquid: liquid.into(),
        gas: eos(&tube.right).into(),
        riemann,
        ..setup(PLANAR, [cells, 8], boundaries)
    };
    let mut fluid = FluidSolver::<8>::from_fn(&setup, |[z, _]| {
        let (side, phi) = if z < tube.at { (&tube.left, tube.phi[0]) } else { (&tube.right, tube.phi[1]) };
        Primitive { density: side.rho, v_z: side.u, v_r: 0.0, pressure: side.p, phi }
    })
    .unwrap();
    run_to(&mut fluid, tube.end);
    fluid
}

/// Relative L1 errors of density, velocity and pressure.
fn errors(tube: &Tube, fluid: &FluidSolver<8>) -> [f64; 3] {
    let star = star_state(&tube.left, &tube.right);
    let exact = |[z, _]: [f64; 2]| {
        let at = sample(&tube.left, &tube.right, &star, (z - tube.at) / tube.end);
        Primitive { density: at.rho, v_z: at.u, v_r: 0.0, pressure: at.p, phi: 0.0 }
    };
    [l1(fluid, exact, |w| [w.density]), l1(fluid, exact, |w| [w.v_z]), l1(fluid, exact, |w| [w.pressure])]
}

#[test]
fn errors_fall_as_they_must_across_jumps() {
    // A captured shock is worth order 1 in L1 (seen as 0.8 on grids on which its place within a cell counts), a
    // contact that a second-order scheme smears over n^(1/3) cells 2/3. A wrong jump leaves errors that do
    // not fall.
    for tube in [sod(), water_on_dense_gas(), water_on_thin_gas()] {
        for riemann in [RiemannSolver::Hllc, RiemannSolver::Exact] {
            let grids = [128, 256, 512].map(|cells| errors(&tube, &run(&tube, cells, riemann)));
            for (k, name) in ["density", "velocity", "pressure"].into_iter().enumerate() {
                let label = format!("{}, {riemann:?}, {name}", tube.name);
                let errors = grids.map(|errors| errors[k]);
                order(&label, &errors);
                // Over both refinements: where the shock lies within its cells makes single ones scatter.
                let order = 0.5 * (errors[0] / errors[2]).log2();
                assert!(order > if k == 0 { 0.6 } else { 0.7 }, "{label}: {order}");
            }
        }
    }
}

#[test]
fn the_interface_finds_its_star_state() {
    for tube in [water_on_dense_gas(), water_on_thin_gas()] {
        let star = star_state(&tube.left, &tube.right);
        let [tail, shock] = waves(&tube.left, &tube.right, &star);
        for riemann in [RiemannSolver::Hllc, RiemannSolver::Exact] {
            let fluid = run(&tube, 512, riemann);
            // Half-way between the contact and the waves on its two sides.
            let speeds = [0.5 * (tail.tail + star.u), 0.5 * (star.u + shock.head)];
            let states = speeds.map(|speed| fluid.sample([tube.at + speed * tube.end, 1e-9]).unwrap());
            let p = states.map(|w| w.pressure / star.p - 1.0);
            let u = states.map(|w| w.v_z / star.u - 1.0);
            eprintln!(
                "{}, {riemann:?}: p*/exact - 1 in liquid, gas {}; u* {}",
                tube.name,
                scientific(&p),
                scientific(&u)
            );
            // Seen are 3e-4 in u, and in p 2e-4 of the jump: in the liquid a pressure far below that is lost in
            // what the rarefaction's tail leaves.
            let scale = tube.left.p - tube.right.p;
            assert!(states.iter().all(|w| (w.pressure - star.p).abs() < 1e-3 * scale), "{p:?}");
            assert!((states[1].pressure / star.p - 1.0).abs() < 5e-3, "{p:?}");
            assert!(u.iter().all(|error| error.abs() < 1e-3), "{u:?}");
        }
    }
}
