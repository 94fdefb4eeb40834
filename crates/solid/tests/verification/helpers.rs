//! What the tests share: steel, grids, norms, orders of convergence, Bessel functions.

use mesh::{Domain, Geometry, Limiter};
use solid::{Boundary, ElasticState, SolidSetup, SolidSolver, WaveSpeeds};

pub const STEEL: WaveSpeeds = WaveSpeeds { density: 7800.0, c1: 5990.0, c2: 3458.0 };

/// Courant number of the runs, that of the cases.
pub const CFL: f64 = 0.45;

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

/// Errors on grids each twice as fine as the one before; prints them and returns the order between the last two.
pub fn order(what: &str, errors: &[f64]) -> f64 {
    let orders: Vec<f64> = errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect();
    let shown: String = errors.iter().map(|error| format!("{error:.2e} ")).collect();
    eprintln!("{what:52} errors {shown} orders {orders:.2?}");
    orders[orders.len() - 1]
}

/// J0 by its power series; 13 digits for |x| < 10.
pub fn j0(x: f64) -> f64 {
    series(x, 0)
}

/// J1, likewise.
pub fn j1(x: f64) -> f64 {
    0.5 * x * series(x, 1)
}

/// J1(x)/x, also at 0.
pub fn j1_over(x: f64) -> f64 {
    0.5 * series(x, 1)
}

/// The first zero of J1.
pub const J1_ZERO: f64 = 3.831_705_970_207_512;

/// Σ (−x²/4)^k / (k! (k + n)!) for n = 0, 1.
fn series(x: f64, n: u32) -> f64 {
    let q = -0.25 * x * x;
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 1..60 {
        term *= q / (f64::from(k) * f64::from(k + n));
        sum += term;
    }
    sum
}

#[test]
fn bessel_functions_at_tabulated_points() {
    // Abramowitz & Stegun, tables 9.1 and 9.5.
    for (got, want) in [
        (j0(1.0), 0.765_197_686_557_966_6),
        (j1(1.0), 0.440_050_585_744_933_5),
        (j0(7.0), 0.300_079_270_519_555_6),
        (j1(7.0), -0.004_682_823_482_345_8),
        (j1(J1_ZERO), 0.0),
    ] {
        assert!((got - want).abs() < 1e-13, "{got} {want}");
    }
}
