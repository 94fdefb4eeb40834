//! The passive tracer: carried by the mass, conserved, bounded.

use fluid::{FluidSetup, FluidSolver, Primitive, Shape};
use mesh::{Adaptation, Limiter};

use crate::helpers::*;

/// A bubble that collapses in a closed cylinder on an adaptive grid, with a tracer beside and within it.
fn collapse(kind: Kind, tracer: Shape) -> FluidSolver<8> {
    let initial = ball_of_gas(([0.5, 0.0], 0.3), 5e6, AIR, 0.0);
    let setup = FluidSetup {
        tracer: Some(tracer),
        levels: 2,
        adaptation: Some(Adaptation::by_details(5e-2, 2)),
        ..setup_of(kind, AXIAL, [32, 32], CYLINDER)
    };
    FluidSolver::new(&setup, &initial).unwrap()
}

fn mass(fluid: &FluidSolver<8>) -> f64 {
    let masses: Vec<_> = fluid.carried_masses().collect();
    assert_eq!((masses.len(), masses[0].0), (1, "tracer"));
    masses[0].1
}

/// Mass fractions: the least, the largest.
fn range(fluid: &FluidSolver<8>) -> [f64; 2] {
    let fold = |[low, high]: [f64; 2], y: &f64| [low.min(*y), high.max(*y)];
    fluid.snapshot().tracer.iter().fold([f64::INFINITY, f64::NEG_INFINITY], fold)
}

#[test]
fn its_mass_is_conserved_with_adaptation_and_subcycling() {
    for kind in KINDS {
        for local in [false, true] {
            let mut fluid = collapse(kind, Shape::Box { z: [0.1, 0.6], r: [0.0, 0.25] });
            let start = mass(&fluid);
            let (mut changes, mut jumps) = (0, 0);
            for _ in 0..if local { 60 } else { 200 } {
                let (dt, made) = if local { step_locally(&mut fluid) } else { step_together(&mut fluid) };
                changes += usize::from(fluid.adapt_if_due(dt, made));
                let [coarsest, finest] = fluid.mesh().levels_present();
                jumps += usize::from(coarsest < finest);
            }
            assert!(
                changes > 2 && jumps > 20 && start > 0.0,
                "{changes} new meshes, {jumps} steps with jumps"
            );
            let lost = mass(&fluid) / start - 1.0;
            eprintln!("{kind:?} {local}: {lost:.1e} of the mass, {:?}", range(&fluid));
            assert!(lost.abs() < 1e-13, "{kind:?} {local}: {lost:e}");
            let [least, most] = range(&fluid);
            assert!(least > -1e-9 && most < 1.0 + 1e-9, "{kind:?} {local}: {least:e} {most}");
        }
    }
}

#[test]
fn what_is_everywhere_stays_everywhere() {
    for kind in KINDS {
        let mut fluid = collapse(kind, Shape::Box { z: [-1.0, 2.0], r: [0.0, 2.0] });
        for _ in 0..40 {
            let (dt, made) = step_locally(&mut fluid);
            fluid.adapt_if_due(dt, made);
        }
        let [least, most] = range(&fluid);
        eprintln!("{kind:?}: 1 {:+.1e} {:+.1e}", least - 1.0, most - 1.0);
        assert!(least > 1.0 - 1e-14 && most < 1.0 + 1e-14, "{kind:?}: 1 {:e} {:e}", least - 1.0, most - 1.0);
    }
}

/// The distance in L1 of a band of tracer from where uniform flow has carried it: once through a periodic square, diagonally.
fn error_of_a_band(cells: usize) -> f64 {
    let setup = FluidSetup {
        limiter: Limiter::Mc,
        tracer: Some(Shape::Box { z: [0.25, 0.75], r: [0.25, 0.75] }),
        ..setup_of(SHARP, PLANAR, [cells, cells], PERIODIC)
    };
    let flow = Primitive { v_z: 200.0, v_r: 200.0, ..still(1e5) };
    let mut fluid = FluidSolver::<8>::from_fn(&setup, |_| flow).unwrap();
    let before = fluid.snapshot().tracer;
    run_to(&mut fluid, 1.0 / 200.0);
    let after = fluid.snapshot().tracer;
    before.iter().zip(&after).map(|(a, b)| (a - b).abs()).sum::<f64>() / before.len() as f64
}

#[test]
fn an_edge_is_carried_as_sharply_as_second_order_does() {
    let [coarse, fine] = [32, 64].map(error_of_a_band);
    let order = (coarse / fine).log2();
    eprintln!("{coarse:.4} {fine:.4}: order {order:.2}");
    // Discontinuities: order 2/3 at least (order 1/2 is that of upwind differences).
    assert!(order > 0.6 && fine < 0.06, "{coarse} {fine}: order {order}");
}
