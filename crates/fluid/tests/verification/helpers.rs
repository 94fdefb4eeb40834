//! What the tests share: media, grids, norms, orders of convergence, Bessel functions.

use fluid::{
    Boundary, FluidSetup, FluidSolver, InitialCondition, InitialPressure, Model, NobleAbelStiffenedGas,
    Phase, PhaseState, Primitive, Region, Shape, Sharpening, StiffenedGas, Totals,
};
use mesh::{Adaptation, Domain, Geometry, LevelBound, Zone};

pub const LIQUID: StiffenedGas = StiffenedGas { gamma: 7.15, pi: 3e8 };
pub const GAS: StiffenedGas = StiffenedGas { gamma: 1.4, pi: 0.0 };

/// A two-phase model, and what keeps its interfaces sharp.
pub type Kind = (Model, Sharpening);

/// The default, and the paper's mixture.
pub const KINDS: [Kind; 2] = [SHARP, MIXTURE];
pub const SHARP: Kind = (Model::FiveEquation, Sharpening::Thinc);
pub const MIXTURE: Kind = (Model::SaurelAbgrall, Sharpening::None);

/// The rows of a study of minutes: all, or the first of them under `CAV_STUDIES=short`, which tries its command.
pub fn rows<T>(all: &[T]) -> &[T] {
    if std::env::var("CAV_STUDIES").is_ok_and(|how| how == "short") { &all[..1] } else { all }
}

pub const PERIODIC: [Boundary; 4] = [Boundary::Periodic; 4];
pub const WALLS: [Boundary; 4] = [Boundary::Wall; 4];
/// Axis, and walls elsewhere.
pub const CYLINDER: [Boundary; 4] = [Boundary::Wall, Boundary::Wall, Boundary::Axis, Boundary::Wall];

pub const PLANAR: Geometry = Geometry::Planar;
pub const AXIAL: Geometry = Geometry::Axisymmetric;

/// [`setup_of`] the paper's mixture.
pub fn setup(geometry: Geometry, cells: [usize; 2], boundaries: [Boundary; 4]) -> FluidSetup {
    setup_of(MIXTURE, geometry, cells, boundaries)
}

/// Water and gas, HLLC and the MC limiter, on `cells` over [0, 1] × [0, 1] m.
pub fn setup_of(
    (model, sharpening): Kind,
    geometry: Geometry,
    cells: [usize; 2],
    boundaries: [Boundary; 4],
) -> FluidSetup {
    let domain = Domain { geometry, z: [0.0, 1.0], r: [0.0, 1.0] };
    FluidSetup { model, sharpening, ..setup_in(domain, cells, boundaries) }
}

/// [`FluidSetup::new`] of a test.
pub fn setup_in(domain: Domain, cells: [usize; 2], boundaries: [Boundary; 4]) -> FluidSetup {
    keep_to_own_thread();
    FluidSetup::new(domain, cells, boundaries)
}

/// A ball of gas in liquid of 1000 kg/m³.
///
/// - `place`: its centre and radius, m.
/// - `pressure`: of the liquid, Pa; `gas`: density and pressure of the gas; `velocity`: of both, along z.
pub fn ball_of_gas(place: ([f64; 2], f64), pressure: f64, gas: [f64; 2], velocity: f64) -> InitialCondition {
    let state = |phase, density, pressure| PhaseState { phase, density, pressure, velocity: [velocity, 0.0] };
    InitialCondition {
        ambient: state(Phase::Liquid, 1000.0, pressure),
        pressure: InitialPressure::Uniform,
        regions: vec![Region {
            shape: Shape::Sphere { centre: place.0, radius: place.1 },
            state: state(Phase::Gas, gas[0], gas[1]),
        }],
        pulses: vec![],
    }
}

/// A ball of gas in liquid, of these laws, each with a pressure (Pa) and a temperature (K), moving along z.
pub fn ball_of_laws(
    [liquid_law, gas_law]: [NobleAbelStiffenedGas; 2],
    place: ([f64; 2], f64),
    [liquid, gas]: [[f64; 2]; 2],
    velocity: f64,
) -> InitialCondition {
    let density = |law: NobleAbelStiffenedGas, [p, t]: [f64; 2]| law.density_at(p, t).unwrap();
    let mut initial = ball_of_gas(place, liquid[0], [density(gas_law, gas), gas[0]], velocity);
    initial.ambient.density = density(liquid_law, liquid);
    initial
}

/// Density and pressure of air, and of the gas in the bubble of the figures' case.
pub const AIR: [f64; 2] = [1.2, 1e5];
pub const THIN_GAS: [f64; 2] = [0.0266, 2118.0];

/// Liquid of 1000 kg/m³ at rest.
pub fn still(pressure: f64) -> Primitive {
    Primitive { density: 1000.0, v_z: 0.0, v_r: 0.0, pressure, phi: 0.0 }
}

pub fn run_to<const N: usize>(fluid: &mut FluidSolver<N>, end: f64) {
    while fluid.time() < end * (1.0 - 1e-12) {
        let dt = fluid.time_step_limit(CFL).min(end - fluid.time());
        fluid.step(dt).unwrap();
    }
}

/// A step of y' = rate(y) by the classical method of fourth order.
pub fn runge_kutta<const K: usize>(y: [f64; K], dt: f64, rate: impl Fn([f64; K]) -> [f64; K]) -> [f64; K] {
    let at = |share: f64, k: [f64; K]| rate(std::array::from_fn(|c| y[c] + share * dt * k[c]));
    let k1 = rate(y);
    let k2 = at(0.5, k1);
    let k3 = at(0.5, k2);
    let k4 = at(1.0, k3);
    std::array::from_fn(|c| y[c] + dt / 6.0 * (k1[c] + 2.0 * (k2[c] + k3[c]) + k4[c]))
}

/// A drop of water of 200 m/s towards z = 0, in gas of 1 kg/m³, at 1 bar.
pub fn drop_in_gas(place: ([f64; 2], f64)) -> InitialCondition {
    let mut initial = ball_of_gas(place, 1e5, [1.0, 1e5], 0.0);
    std::mem::swap(&mut initial.ambient, &mut initial.regions[0].state);
    initial.regions[0].state.velocity = [-200.0, 0.0];
    initial
}

/// ρc of a fluid at a wall, Pa s/m.
pub fn impedance(trace: &coupler::FluidTrace) -> f64 {
    (trace.gamma * (trace.pressure + trace.pi) * trace.density).sqrt()
}

/// The shear stresses that a fluid shows on the faces of its wall in a step of length `dt`, Pa.
pub fn shear_on_wall(fluid: &FluidSolver<8>, dt: f64) -> Vec<f64> {
    let mut shear = vec![0.0; fluid.interface().faces()];
    fluid.write_trace(dt, mesh::every_slot, |row, face, value| {
        if row == coupler::TraceRow::Shear {
            shear[face] = value;
        }
    });
    shear
}

pub fn run_steps<const N: usize>(fluid: &mut FluidSolver<N>, steps: usize) {
    for _ in 0..steps {
        fluid.step_at(CFL).unwrap();
    }
}

/// A finer level within a ball of 0.2 m on the axis, a coarse one far from it, what waves ask for between.
pub fn refined_ball() -> Adaptation {
    let (centre, radius) = ([0.4, 0.0], 0.2);
    let within = LevelBound { zone: Zone::Within { centre, radius }, at_least: 1, at_most: 1 };
    let top = LevelBound { zone: Zone::Box { z: [0.76, 2.0], r: [-1.0, 2.0] }, at_least: 0, at_most: 0 };
    Adaptation { bounds: vec![within, top], ..Adaptation::by_details(1e-2, 4) }
}

/// So many steps, with levels that make their own; there is a jump of levels at the end.
pub fn run_locally<const N: usize>(fluid: &mut FluidSolver<N>, steps: u64) {
    while fluid.steps() < steps {
        let (dt, made) = step_locally(fluid);
        fluid.adapt_if_due(dt, made);
    }
    assert_jump_of_levels(fluid);
}

pub fn assert_jump_of_levels<const N: usize>(fluid: &FluidSolver<N>) {
    let [coarsest, finest] = fluid.mesh().levels_present();
    assert!(coarsest < finest, "there is a jump of levels");
}

/// Nothing is lost but round-off.
pub fn assert_balanced<const N: usize>(what: &str, imbalance: &[f64], fluid: &FluidSolver<N>) {
    eprintln!("{what}: {} {:?}", scientific(imbalance), fluid.fixups().clips);
    assert!(imbalance.iter().all(|part| part.abs() < 1e-12), "{imbalance:?}");
}

/// No energy comes through walls that rest and keep their heat; r_min is an axis or a plane of symmetry.
pub fn assert_no_energy_through_walls<const N: usize>(fluid: &FluidSolver<N>) {
    let [z_min, z_max, _, r_max] = fluid.ledger().energy;
    assert_eq!([z_min, z_max, r_max], [0.0; 3], "no energy passes walls at rest");
}

/// Imbalances of mass, axial momentum and energy since the totals were `start`, relative to them (the momentum to what a side brought
/// in, or to 10 m/s of all mass).
pub fn imbalance_since<const N: usize>(fluid: &FluidSolver<N>, start: &Totals) -> [f64; 3] {
    let (end, ledger) = (fluid.totals(), fluid.ledger());
    let sum = |sides: [f64; 4]| sides.iter().sum::<f64>();
    let scale = ledger.momentum.iter().map(|m| m.abs()).fold(10.0 * start.mass, f64::max);
    [
        (end.mass - start.mass - sum(ledger.mass)) / start.mass,
        (end.momentum_z - start.momentum_z - sum(ledger.momentum)) / scale,
        (end.energy - start.energy - sum(ledger.energy) - fluid.fixups().floor_energy) / start.energy,
    ]
}

/// Visits every cell: its place, its global indices, its state.
pub fn each_cell<const N: usize>(
    fluid: &FluidSolver<N>,
    mut visit: impl FnMut([f64; 2], [usize; 2], Primitive),
) {
    let mesh = fluid.mesh();
    for (slot, id) in mesh.tree().leaves().iter().enumerate() {
        for j in 0..N {
            for i in 0..N {
                let index = [id.i as usize * N + i, id.j as usize * N + j];
                visit(mesh.centre(*id, i, j), index, fluid.cell(slot, i, j));
            }
        }
    }
}

/// All conserved variables by global cell, `[j][i]`, whatever the blocks are; the gas's mass is 0 in the paper's mixture.
pub fn global<const N: usize>(fluid: &FluidSolver<N>) -> Vec<Vec<[f64; 6]>> {
    let [h_z, h_r] = fluid.mesh().widths(fluid.mesh().tree().leaves()[0].level);
    let Domain { z, r, .. } = *fluid.mesh().domain();
    let count = |range: [f64; 2], h: f64| ((range[1] - range[0]) / h).round() as usize;
    let components = fluid.state().components();
    let mut cells = vec![vec![[0.0; 6]; count(z, h_z)]; count(r, h_r)];
    for (slot, id) in fluid.mesh().tree().leaves().iter().enumerate() {
        for j in 0..N {
            for i in 0..N {
                cells[id.j as usize * N + j][id.i as usize * N + i] = std::array::from_fn(|c| {
                    if c < components { fluid.state().component(slot, c)[j * N + i] } else { 0.0 }
                });
            }
        }
    }
    cells
}

/// L1 error over cells divided by the L1 norm of the reference at their centres. Every cell counts the same:
/// those at the axis are not weighted down by their small volumes.
pub fn l1<const N: usize, const K: usize>(
    fluid: &FluidSolver<N>,
    exact: impl Fn([f64; 2]) -> Primitive,
    pick: impl Fn(Primitive) -> [f64; K],
) -> f64 {
    relative_l1(|compare| each_cell(fluid, |place, _, got| compare(&pick(got), &pick(exact(place)))))
}

#[path = "../../../../tests/fixture/verification.rs"]
mod shared;

pub use shared::{
    CFL, J1_ZEROS, assert_transposed, differences, j0, j1, keep_to_own_thread, order, relative_l1,
    scientific, step_locally, step_together, strips,
};
