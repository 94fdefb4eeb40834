//! The same start, seen in a mirror, turned, cut into other blocks or computed by more threads.

use fluid::{
    FluidSetup, FluidSolver, InitialCondition, Phase, PhaseState, Primitive, Region, RiemannSolver, Shape,
};
use mesh::{Geometry, Limiter};

use crate::helpers::*;

const CELLS: usize = 32;

/// A start without any symmetry: a bubble, waves, shear. From cell indices, so that mirror images are exact.
fn start(i: usize, j: usize) -> Primitive {
    let (x, y) = (i as f64 / CELLS as f64, j as f64 / CELLS as f64);
    let inside = 1.0 / (1.0 + (((x - 0.4).hypot(y - 0.3) - 0.2) * 80.0).exp());
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
) -> Vec<Vec<[f64; 5]>> {
    let index = |x: f64| (x * CELLS as f64) as usize;
    let mut fluid = FluidSolver::<N>::from_fn(setup, |[z, r]| start(index(z), index(r))).unwrap();
    for _ in 0..50 {
        // The common step of all runs that are compared.
        fluid.step(2e-6).unwrap();
    }
    global(&fluid)
}

fn box_of(geometry: Geometry, limiter: Limiter, riemann: RiemannSolver) -> FluidSetup {
    let boundaries = if geometry == AXIAL { CYLINDER } else { WALLS };
    FluidSetup { limiter, riemann, ..setup(geometry, [CELLS, CELLS], boundaries) }
}

const LIMITERS: [Limiter; 2] = [Limiter::Mc, Limiter::Minmod];
const SOLVERS: [RiemannSolver; 2] = [RiemannSolver::Hllc, RiemannSolver::Exact];

#[test]
fn a_mirrored_start_gives_the_mirror_image_bitwise() {
    for geometry in [AXIAL, PLANAR] {
        for limiter in LIMITERS {
            for riemann in SOLVERS {
                let setup = box_of(geometry, limiter, riemann);
                let plain = after::<8>(&setup, start);
                let mirrored = after::<8>(&setup, |i, j| {
                    let w = start(CELLS - 1 - i, j);
                    Primitive { v_z: -w.v_z, ..w }
                });
                for (row, image) in plain.iter().zip(&mirrored) {
                    for (u, [rho, mz, mr, energy, phi]) in row.iter().zip(image.iter().rev()) {
                        assert_eq!(
                            *u,
                            [*rho, -mz, *mr, *energy, *phi],
                            "{geometry:?} {limiter:?} {riemann:?}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn a_transposed_planar_start_gives_the_transposed_result_bitwise() {
    for limiter in LIMITERS {
        for riemann in SOLVERS {
            let setup = box_of(PLANAR, limiter, riemann);
            let plain = after::<8>(&setup, start);
            let turned = after::<8>(&setup, |i, j| {
                let w = start(j, i);
                Primitive { v_z: w.v_r, v_r: w.v_z, ..w }
            });
            for j in 0..CELLS {
                for i in 0..CELLS {
                    let [rho, mz, mr, energy, phi] = turned[i][j];
                    assert_eq!(plain[j][i], [rho, mr, mz, energy, phi], "{limiter:?} {riemann:?}");
                }
            }
        }
    }
}

#[test]
fn blocks_of_any_size_give_the_same_bitwise() {
    for geometry in [AXIAL, PLANAR] {
        for limiter in LIMITERS {
            let setup = box_of(geometry, limiter, RiemannSolver::Hllc);
            let of_8 = after::<8>(&setup, start);
            assert!(of_8 == after::<16>(&setup, start), "16: {geometry:?} {limiter:?}");
            assert!(of_8 == after::<32>(&setup, start), "32: {geometry:?} {limiter:?}");
        }
    }
}

#[test]
fn a_bubble_at_a_wall_is_the_same_in_blocks_of_any_size() {
    fn collapsed<const N: usize>(geometry: Geometry) -> Vec<Vec<[f64; 5]>> {
        let state = |phase, density, pressure| PhaseState { phase, density, pressure, velocity: [0.0; 2] };
        let initial = InitialCondition {
            ambient: state(Phase::Liquid, 1000.0, 5e7),
            pressure: fluid::InitialPressure::Uniform,
            regions: vec![Region {
                shape: Shape::Sphere { centre: [0.35, 0.0], radius: 0.2 },
                state: state(Phase::Gas, 0.0266, 2118.0),
            }],
            pulses: vec![],
        };
        let setup =
            FluidSetup { coarsest: [64, 64], ..box_of(geometry, Limiter::Minmod, RiemannSolver::Hllc) };
        let mut fluid = FluidSolver::<N>::new(&setup, &initial).unwrap();
        run_steps(&mut fluid, 300);
        global(&fluid)
    }
    for geometry in [AXIAL, PLANAR] {
        let of_8 = collapsed::<8>(geometry);
        assert!(of_8 == collapsed::<16>(geometry), "16: {geometry:?}");
        assert!(of_8 == collapsed::<32>(geometry), "32: {geometry:?}");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bitwise() {
    let setup = box_of(AXIAL, Limiter::Mc, RiemannSolver::Hllc);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| after::<8>(&setup, start))
    };
    let one = with(1);
    assert!(one == with(2) && one == with(3));
}
