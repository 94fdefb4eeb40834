//! The same start, seen in a mirror, turned, cut into other blocks or computed by more threads.

use mesh::{Geometry, Limiter};
use solid::{Boundary, ElasticState, SolidSetup, SolidSolver};

use crate::helpers::*;

const CELLS: usize = 32;
const LIMITERS: [Limiter; 3] = [Limiter::Mc, Limiter::Minmod, Limiter::None];

/// A start without any symmetry, from cell indices, so that mirror images are exact.
fn start(i: usize, j: usize) -> ElasticState {
    let (x, y) = (i as f64 / CELLS as f64, j as f64 / CELLS as f64);
    let jump = if x + 0.3 * y < 0.5 { 1.0 } else { 0.2 };
    ElasticState {
        v_z: 2.0 * (5.0 * x).sin() * (4.0 * y).cos() * jump,
        v_r: 1.5 * (9.0 * y).sin() * (2.0 * x + 1.0).cos(),
        stress_zz: -5e7 * jump + 1e7 * (6.0 * x).sin(),
        stress_zr: 2e7 * (3.0 * x + 7.0 * y).sin(),
        stress_rr: -3e7 * (8.0 * y).cos() * jump,
        stress_phiphi: -1e7 * (4.0 * x * y).cos(),
    }
}

/// The state after 50 steps by cell, `[j][i]`.
fn after<const N: usize>(
    setup: &SolidSetup,
    start: impl Fn(usize, usize) -> ElasticState + Sync,
) -> Vec<Vec<[f64; 6]>> {
    let index = |x: f64| (x * CELLS as f64) as usize;
    let mut solid = SolidSolver::<N>::new(setup.clone(), |[z, r]| start(index(z), index(r))).unwrap();
    for _ in 0..50 {
        solid.step_at(CFL).unwrap();
    }
    global(&solid, CELLS)
}

fn box_of(geometry: Geometry, limiter: Limiter, kind: Boundary) -> SolidSetup {
    let low = if geometry == AXIAL { Boundary::Axis } else { kind };
    SolidSetup { limiter, ..setup(geometry, [CELLS, CELLS], [kind, kind, low, kind]) }
}

const KINDS: [Boundary; 4] = [Boundary::Symmetry, Boundary::Fixed, Boundary::Free, Boundary::NonReflecting];

#[test]
fn a_mirrored_start_gives_the_mirror_image_bitwise() {
    for geometry in [AXIAL, PLANAR] {
        for limiter in LIMITERS {
            for kind in KINDS {
                let setup = box_of(geometry, limiter, kind);
                let plain = after::<8>(&setup, start);
                let mirrored = after::<8>(&setup, |i, j| {
                    let w = start(CELLS - 1 - i, j);
                    ElasticState { v_z: -w.v_z, stress_zr: -w.stress_zr, ..w }
                });
                for (row, image) in plain.iter().zip(&mirrored) {
                    for (w, [v_z, v_r, zz, zr, rr, pp]) in row.iter().zip(image.iter().rev()) {
                        assert_eq!(*w, [-v_z, *v_r, *zz, -zr, *rr, *pp], "{geometry:?} {limiter:?} {kind:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_transposed_planar_start_gives_the_transposed_result_bitwise() {
    for limiter in LIMITERS {
        for kind in KINDS {
            let setup = box_of(PLANAR, limiter, kind);
            let plain = after::<8>(&setup, start);
            let turned = after::<8>(&setup, |i, j| {
                let w = start(j, i);
                ElasticState { v_z: w.v_r, v_r: w.v_z, stress_zz: w.stress_rr, stress_rr: w.stress_zz, ..w }
            });
            let turn = |[v_z, v_r, zz, zr, rr, pp]: [f64; 6]| [v_r, v_z, rr, zr, zz, pp];
            assert_transposed(&plain, &turned, turn, &(limiter, kind));
        }
    }
}

#[test]
fn blocks_of_any_size_give_the_same_bitwise() {
    for geometry in [AXIAL, PLANAR] {
        for kind in KINDS {
            let setup = box_of(geometry, Limiter::Mc, kind);
            let of_8 = after::<8>(&setup, start);
            assert!(of_8 == after::<16>(&setup, start), "16: {geometry:?} {kind:?}");
            assert!(of_8 == after::<32>(&setup, start), "32: {geometry:?} {kind:?}");
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bitwise() {
    let setup = box_of(AXIAL, Limiter::Mc, Boundary::NonReflecting);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| after::<8>(&setup, start))
    };
    let one = with(1);
    assert!(one == with(2) && one == with(3));
}
