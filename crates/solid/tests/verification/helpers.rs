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
    keep_to_own_thread();
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
        load: None,
    }
}

pub fn run_to<const N: usize>(solid: &mut SolidSolver<N>, end: f64) {
    let steps = (end / solid.time_step_limit(CFL)).ceil();
    for _ in 0..steps as usize {
        solid.step(end / steps).unwrap();
    }
}

/// Steps of the coarsest level, after which the grid adapts where that is due. `run` makes some of what is left of a step that has
/// begun; `after` is called after that with the length of the finest level's step, s, and with none after an adaptation.
pub fn whole_steps<const N: usize>(
    solid: &mut SolidSolver<N>,
    steps: usize,
    mut run: impl FnMut(&mut SolidSolver<N>),
    mut after: impl FnMut(&mut SolidSolver<N>, f64),
) {
    for _ in 0..steps {
        let base = solid.mesh().coarsest_base();
        let dt = solid.local_step_limit(CFL, base);
        let substeps = 1 << (solid.mesh().levels_present()[1] - base);
        let follows = solid.adaptation_follows(dt, substeps);
        solid.begin_step(dt, base);
        while !solid.clock().is_over() {
            run(solid);
            let own = solid.clock().length(solid.clock().finest());
            after(solid, own);
        }
        if follows {
            solid.adapt(dt, substeps);
            after(solid, 0.0);
        }
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
    relative_l1(|compare| each_cell(solid, |place, got| compare(&pick(got), &pick(exact(place)))))
}

#[path = "../../../../tests/fixture/verification.rs"]
mod shared;

pub use shared::{
    CFL, J1_ZEROS, assert_transposed, differences, j0, j1, j1_over, keep_to_own_thread, order, relative_l1,
    step_locally, step_together, strips,
};
