//! What the tests share: steel, grids, norms, orders of convergence, Bessel functions.

use mesh::{Domain, Geometry, Limiter};
use solid::{Boundary, ElasticState, SolidSetup, SolidSolver, WaveSpeeds};

pub const STEEL: WaveSpeeds = WaveSpeeds { density: 7800.0, c1: 5990.0, c2: 3458.0 };

pub const PERIODIC: [Boundary; 4] = [Boundary::Periodic; 4];
/// Axis, and frictionless walls elsewhere.
pub const CYLINDER: [Boundary; 4] =
    [Boundary::Symmetry, Boundary::Symmetry, Boundary::Axis, Boundary::Symmetry];

pub const PLANAR: Geometry = Geometry::Planar;
pub const AXIAL: Geometry = Geometry::Axisymmetric;

/// Steel and the MC limiter on `cells` over [0, 1] × [0, 1] m.
pub fn setup(geometry: Geometry, cells: [usize; 2], boundaries: [Boundary; 4]) -> SolidSetup {
    SolidSetup {
        domain: Domain { geometry, z: [0.0, 1.0], r: [0.0, 1.0] },
        coarsest: cells,
        levels: 0,
        speeds: STEEL,
        yield_strength: f64::INFINITY,
        plasticity: None,
        limiter: Limiter::Mc,
        boundaries,
        adaptation: None,
        stress_scale: 1e6,
        weight: None,
    }
}

pub fn run_to<const N: usize>(solid: &mut SolidSolver<N>, end: f64) {
    let steps = (end / solid.time_step_limit(CFL)).ceil();
    for _ in 0..steps as usize {
        solid.step(end / steps).unwrap();
    }
}

/// Visits every cell: its place and its state.
pub fn each_cell<const N: usize>(solid: &SolidSolver<N>, mut visit: impl FnMut([f64; 2], ElasticState)) {
    for (slot, id) in solid.mesh().tree().leaves().iter().enumerate() {
        for j in 0..N {
            for i in 0..N {
                visit(solid.mesh().centre(*id, i, j), solid.cell(slot, i, j));
            }
        }
    }
}

/// All components by global cell of an n × n grid, `[j][i]`, whatever the blocks are.
pub fn global<const N: usize>(solid: &SolidSolver<N>, n: usize) -> Vec<Vec<[f64; 6]>> {
    let mut cells = vec![vec![[0.0; 6]; n]; n];
    for (slot, id) in solid.mesh().tree().leaves().iter().enumerate() {
        for j in 0..N {
            for i in 0..N {
                cells[id.j as usize * N + j][id.i as usize * N + i] = solid.cell(slot, i, j).to_array();
            }
        }
    }
    cells
}

pub fn velocity(w: ElasticState) -> [f64; 4] {
    [w.v_z, w.v_r, 0.0, 0.0]
}

pub fn stress(w: ElasticState) -> [f64; 4] {
    [w.stress_zz, w.stress_zr, w.stress_rr, w.stress_phiphi]
}

/// L1 error over cells divided by the L1 norm of the reference at their centres. Every cell counts the same:
/// those at the axis are not weighted down by their small volumes.
pub fn l1<const N: usize>(
    solid: &SolidSolver<N>,
    exact: impl Fn([f64; 2]) -> ElasticState,
    pick: fn(ElasticState) -> [f64; 4],
) -> f64 {
    let (mut error, mut norm) = (0.0, 0.0);
    each_cell(solid, |place, got| {
        for (got, want) in pick(got).into_iter().zip(pick(exact(place))) {
            error += (got - want).abs();
            norm += want.abs();
        }
    });
    error / norm
}

#[path = "../../../../tests/fixture/verification.rs"]
mod shared;

pub use shared::{CFL, J1_ZEROS, j0, j1, j1_over, order, step_locally, step_together, strips};
