//! The same start, seen in a mirror, turned, cut into other blocks or computed by more threads.

use fluid::{FluidSetup, FluidSolver, Model, Primitive, RiemannSolver};
use mesh::{Geometry, Limiter};

use crate::helpers::*;

const CELLS: usize = 32;

/// A start without any symmetry: a bubble, waves, shear. From cell indices, so that mirror images are exact.
///
/// - `kind`: where phases have densities of their own, each cell starts as one of them.
fn start((model, _): Kind, i: usize, j: usize) -> Primitive {
    let (x, y) = (i as f64 / CELLS as f64, j as f64 / CELLS as f64);
    let mixed = 1.0 / (1.0 + (((x - 0.4).hypot(y - 0.3) - 0.2) * 80.0).exp());
    let inside = if model == Model::SaurelAbgrall { mixed } else { mixed.round() };
    let wave = (7.0 * x + 3.0 * y).sin();
    Primitive {
        density: 1000.0 - 999.0 * inside + 5.0 * wave * (1.0 - inside),
        v_z: 20.0 * (5.0 * x).sin() * (4.0 * y).cos(),
        v_r: 15.0 * (9.0 * y).sin() * (2.0 * x + 1.0).cos(),
        pressure: 1e7 - 9.8e6 * inside + 1e6 * wave * (1.0 - inside),
        phi: inside,
    }
}

/// The state after 50 steps by cell, `[j][i]`.
fn after<const N: usize>(
    setup: &FluidSetup,
    start: impl Fn(usize, usize) -> Primitive + Sync,
) -> Vec<Vec<[f64; 6]>> {
    let index = |x: f64| (x * CELLS as f64) as usize;
    let mut fluid = FluidSolver::<N>::from_fn(setup, |[z, r]| start(index(z), index(r))).unwrap();
    for _ in 0..50 {
        // The common step of all runs that are compared.
        fluid.step(2e-6).unwrap();
    }
    global(&fluid)
}

fn box_of(kind: Kind, geometry: Geometry, limiter: Limiter, riemann: RiemannSolver) -> FluidSetup {
    let boundaries = if geometry == AXIAL { CYLINDER } else { WALLS };
    FluidSetup { limiter, riemann, ..setup_of(kind, geometry, [CELLS, CELLS], boundaries) }
}

const LIMITERS: [Limiter; 2] = [Limiter::Mc, Limiter::Minmod];
const SOLVERS: [RiemannSolver; 2] = [RiemannSolver::Hllc, RiemannSolver::Exact];

/// Each model with each limiter and Riemann solver.
fn each_scheme(mut visit: impl FnMut(Kind, Limiter, RiemannSolver)) {
    for kind in KINDS {
        for limiter in LIMITERS {
            SOLVERS.into_iter().for_each(|riemann| visit(kind, limiter, riemann));
        }
    }
}

#[test]
fn a_mirrored_start_gives_the_mirror_image_bitwise() {
    each_scheme(|kind, limiter, riemann| {
        for geometry in [AXIAL, PLANAR] {
            let setup = box_of(kind, geometry, limiter, riemann);
            let plain = after::<8>(&setup, |i, j| start(kind, i, j));
            let mirrored = after::<8>(&setup, |i, j| {
                let w = start(kind, CELLS - 1 - i, j);
                Primitive { v_z: -w.v_z, ..w }
            });
            for (row, image) in plain.iter().zip(&mirrored) {
                for (u, [rho, mz, mr, energy, phi, gas]) in row.iter().zip(image.iter().rev()) {
                    assert_eq!(
                        *u,
                        [*rho, -mz, *mr, *energy, *phi, *gas],
                        "{kind:?} {geometry:?} {limiter:?} {riemann:?}"
                    );
                }
            }
        }
    });
}

#[test]
fn a_transposed_planar_start_gives_the_transposed_result_bitwise() {
    each_scheme(|kind, limiter, riemann| {
        let setup = box_of(kind, PLANAR, limiter, riemann);
        let plain = after::<8>(&setup, |i, j| start(kind, i, j));
        let turned = after::<8>(&setup, |i, j| {
            let w = start(kind, j, i);
            Primitive { v_z: w.v_r, v_r: w.v_z, ..w }
        });
        let turn = |[rho, mz, mr, energy, phi, gas]: [f64; 6]| [rho, mr, mz, energy, phi, gas];
        assert_transposed(&plain, &turned, turn, &(kind, limiter, riemann));
    });
}

#[test]
fn blocks_of_any_size_give_the_same_bitwise() {
    each_scheme(|kind, limiter, riemann| {
        for geometry in [AXIAL, PLANAR] {
            let setup = box_of(kind, geometry, limiter, riemann);
            let start = |i, j| start(kind, i, j);
            let of_8 = after::<8>(&setup, start);
            assert!(of_8 == after::<16>(&setup, start), "16: {kind:?} {geometry:?} {limiter:?} {riemann:?}");
            assert!(of_8 == after::<32>(&setup, start), "32: {kind:?} {geometry:?} {limiter:?} {riemann:?}");
        }
    });
}

#[test]
fn a_bubble_at_a_wall_is_the_same_in_blocks_of_any_size() {
    fn collapsed<const N: usize>(kind: Kind, geometry: Geometry) -> Vec<Vec<[f64; 6]>> {
        let initial = ball_of_gas(([0.35, 0.0], 0.2), 5e7, THIN_GAS, 0.0);
        let setup =
            FluidSetup { coarsest: [64, 64], ..box_of(kind, geometry, Limiter::Minmod, RiemannSolver::Hllc) };
        let mut fluid = FluidSolver::<N>::new(&setup, &initial).unwrap();
        run_steps(&mut fluid, 300);
        global(&fluid)
    }
    for kind in KINDS {
        for geometry in [AXIAL, PLANAR] {
            let of_8 = collapsed::<8>(kind, geometry);
            assert!(of_8 == collapsed::<16>(kind, geometry), "16: {kind:?} {geometry:?}");
            assert!(of_8 == collapsed::<32>(kind, geometry), "32: {kind:?} {geometry:?}");
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bitwise() {
    for kind in KINDS {
        let setup = box_of(kind, AXIAL, Limiter::Mc, RiemannSolver::Hllc);
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| after::<8>(&setup, |i, j| start(kind, i, j)))
        };
        let one = with(1);
        assert!(one == with(2) && one == with(3), "{kind:?}");
    }
}
