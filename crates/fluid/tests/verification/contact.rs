//! Uniform pressure and velocity stay uniform across moving interfaces (Abgrall's condition).

use fluid::{Boundary, FluidSetup, FluidSolver, RiemannSolver};
use mesh::{Domain, Geometry, Limiter};

use crate::helpers::*;

struct Worst {
    pressure: f64,
    velocity: f64,
    phi: [f64; 2],
}

/// A bubble of radius 0.3 carried along z at 200 m/s through a periodic domain of 2 × 1.
fn carried(
    kind: Kind,
    geometry: Geometry,
    centre_r: f64,
    density: f64,
    limiter: Limiter,
    riemann: RiemannSolver,
    steps: usize,
) -> Worst {
    let axis = if geometry == AXIAL { Boundary::Axis } else { Boundary::Wall };
    let setup = FluidSetup {
        domain: Domain { geometry, z: [0.0, 2.0], r: [0.0, 1.0] },
        limiter,
        riemann,
        ..setup_of(kind, geometry, [32, 16], [Boundary::Periodic, Boundary::Periodic, axis, Boundary::Wall])
    };
    let initial = ball_of_gas(([1.0, centre_r], 0.3), 1e5, [density, 1e5], 200.0);
    let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
    let mut phi = [0.0_f64, 1.0_f64];
    for step in 0..steps {
        fluid.step_at(CFL).unwrap();
        if step % 50 == 0 {
            each_cell(&fluid, |_, _, w| phi = [phi[0].min(w.phi), phi[1].max(w.phi)]);
        }
    }
    let mut worst = Worst { pressure: 0.0, velocity: 0.0, phi };
    each_cell(&fluid, |_, _, w| {
        worst.pressure = worst.pressure.max((w.pressure / 1e5 - 1.0).abs());
        worst.velocity = worst.velocity.max((w.v_z - 200.0).hypot(w.v_r) / 200.0);
    });
    eprintln!(
        "{kind:?} {geometry:?} centre r {centre_r} gas {density} {limiter:?} {riemann:?} {steps} steps: dp/p {:.1e} du/u {:.1e} \
         phi below 0 by {:.1e}, above 1 by {:.1e}",
        worst.pressure,
        worst.velocity,
        -worst.phi[0],
        worst.phi[1] - 1.0
    );
    assert_eq!((fluid.fixups().floored, fluid.fixups().first_order), (0, 0));
    worst
}

fn check(geometry: Geometry, centre_r: f64, riemann: RiemannSolver, steps: usize) {
    for kind in KINDS {
        for density in [1.2, 0.0266] {
            for limiter in [Limiter::Mc, Limiter::Minmod] {
                // What grows in the default model is seen by 2000 steps; one of its tests goes on for longer.
                let steps = if kind == SHARP { steps.min(2000) } else { steps };
                let worst = carried(kind, geometry, centre_r, density, limiter, riemann, steps);
                // What is asked; reached are 1e-11, the round-off of an energy of 3.5e8 J/m³ in a pressure of
                // 1e5 Pa. Face states of gas in stiff mixed cells let round-off grow tenfold in each step.
                assert!(worst.pressure < 1e-9 && worst.velocity < 1e-9);
            }
        }
    }
}

#[test]
fn a_bubble_on_the_axis() {
    check(AXIAL, 0.0, RiemannSolver::Hllc, 7000);
}

#[test]
fn a_gas_ring_off_the_axis() {
    check(AXIAL, 0.5, RiemannSolver::Hllc, 7000);
}

#[test]
fn a_bubble_sliding_along_a_wall() {
    check(PLANAR, 0.0, RiemannSolver::Hllc, 7000);
    check(PLANAR, 0.2, RiemannSolver::Hllc, 7000);
}

#[test]
fn the_exact_solver_keeps_it_as_well() {
    check(AXIAL, 0.0, RiemannSolver::Exact, 1000);
}
