//! Random level bounds, random thresholds: what must hold on any tree.

use fluid::{
    Boundary, FluidSetup, FluidSolver, InitialCondition, Phase, PhaseState, Region, RiemannSolver, Scales,
    Shape,
};
use mesh::{Adaptation, Domain, Geometry, LevelBound, Zone};

use crate::helpers::*;

const LEVELS: u8 = 3;

/// Splitmix64.
struct Random(u64);

impl Random {
    /// In [0, 1).
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }
}

/// Boxes with bounds and a threshold, over the unit square.
fn adaptation(random: &mut Random) -> Adaptation {
    let bounds = (0..random.below(4))
        .map(|_| {
            let mut range = || {
                let low = random.within(0.0, 0.8);
                [low, low + random.within(0.05, 0.5)]
            };
            let zone = Zone::Box { z: range(), r: range() };
            let at_least = random.below(usize::from(LEVELS) + 1) as u8;
            let at_most = at_least + random.below(usize::from(LEVELS - at_least) + 1) as u8;
            LevelBound { zone, at_least, at_most }
        })
        .collect();
    let epsilon = 10.0_f64.powf(random.within(-2.5, -0.5));
    Adaptation { epsilon, every: 1 + random.below(8) as u32, bounds }
}

/// A bubble in liquid, both of `pressure` or not, and of one velocity along z.
fn bubble(random: &mut Random, pressures: [f64; 2], velocity: f64) -> InitialCondition {
    let state = |phase, density, pressure| PhaseState { phase, density, pressure, velocity: [velocity, 0.0] };
    let centre = [random.within(0.2, 0.8), random.within(0.0, 0.8)];
    InitialCondition {
        ambient: state(Phase::Liquid, 1000.0, pressures[0]),
        pressure: fluid::InitialPressure::Uniform,
        regions: vec![Region {
            shape: Shape::Sphere { centre, radius: random.within(0.1, 0.3) },
            state: state(Phase::Gas, 1.2, pressures[1]),
        }],
        pulses: vec![],
    }
}

fn setup_of(random: &mut Random, geometry: Geometry, sides: [Boundary; 4], pressure: f64) -> FluidSetup {
    FluidSetup {
        domain: Domain { geometry, z: [0.0, 1.0], r: [0.0, 1.0] },
        levels: LEVELS,
        adaptation: Some(adaptation(random)),
        scales: Scales { pressure, density: 1e3 },
        riemann: if random.below(4) == 0 { RiemannSolver::Exact } else { RiemannSolver::Hllc },
        ..setup(geometry, [8, 8], sides)
    }
}

/// Steps with adaptation, of all levels alike or of each by itself; returns how often the mesh changed.
fn run_adaptively(fluid: &mut FluidSolver<8>, steps: usize, local: bool) -> usize {
    let (mut changes, end) = (0, fluid.steps() + steps as u64);
    while fluid.steps() < end {
        let (dt, made) = if local {
            step_locally(fluid)
        } else {
            let dt = fluid.time_step_limit(CFL);
            fluid.step(dt).unwrap();
            (dt, 1)
        };
        if fluid.adapt_if_due(dt, made) {
            changes += 1;
            check_grading(fluid);
        }
    }
    changes
}

/// Looks a little beyond each side and corner of each block: who is there is one level away at most.
fn check_grading(fluid: &FluidSolver<8>) {
    let mesh = fluid.mesh();
    for id in mesh.tree().leaves() {
        let (low, h) = (mesh.origin(*id), mesh.widths(id.level));
        let beyond = |axis: usize, k: usize| low[axis] + [-0.01, 0.1, 7.9, 8.01][k] * h[axis];
        for (a, b) in (0..16).map(|k| (k % 4, k / 4)) {
            if let Some((other, ..)) = mesh.locate([beyond(0, a), beyond(1, b)]) {
                let level = mesh.tree().leaves()[other].level;
                assert!(level.abs_diff(id.level) <= 1, "{id:?} beside level {level}");
            }
        }
    }
}

/// A bubble is carried through the tree: pressure and velocity are uniform, and stay so.
fn stays_uniform(seed: u64, steps: usize) {
    let random = &mut Random(seed);
    let geometry = if random.below(2) == 0 { PLANAR } else { AXIAL };
    let axis = if geometry == AXIAL { Boundary::Axis } else { Boundary::Wall };
    let sides = [Boundary::Periodic, Boundary::Periodic, axis, Boundary::Wall];
    let velocity = random.within(-300.0, 300.0);
    let setup = setup_of(random, geometry, sides, 1e5);
    let initial = bubble(random, [1e5; 2], velocity);
    let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
    run_adaptively(&mut fluid, steps, seed % 2 == 1);
    each_cell(&fluid, |place, _, w| {
        let off = (w.pressure / 1e5 - 1.0).abs().max((w.v_z - velocity).hypot(w.v_r) / 100.0);
        assert!(off < 1e-8, "seed {seed}: {off:.1e} at {place:?}, {w:?}");
        assert!(w.phi > -1e-6 && w.phi < 1.0 + 1e-6, "seed {seed}: {w:?}");
    });
}

/// A bubble shrinks and swells in a closed box: mass, energy and, in a periodic plane, momentum stay. Returns whether the mesh
/// changed.
fn is_conserved(seed: u64, steps: usize) -> bool {
    let random = &mut Random(seed);
    let (geometry, sides) = [(AXIAL, CYLINDER), (PLANAR, PERIODIC), (PLANAR, WALLS)][random.below(3)];
    let setup = setup_of(random, geometry, sides, 1e7);
    let initial = bubble(random, [1e7, 7e6], 5.0);
    let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
    let before = fluid.totals();
    let changes = run_adaptively(&mut fluid, steps, seed % 2 == 1);
    let (after, ledger) = (fluid.totals(), fluid.ledger());
    let off = |a: f64, b: f64, into: &[f64; 4]| (b - a - into.iter().sum::<f64>()).abs();
    let mass = off(before.mass, after.mass, &ledger.mass) / before.mass;
    let floor = fluid.fixups().floor_energy;
    let energy = off(before.energy + floor, after.energy, &ledger.energy) / before.energy;
    let momentum = off(before.momentum_z, after.momentum_z, &ledger.momentum) / before.mass / 5.0;
    eprintln!(
        "{seed}: {geometry:?} {changes} changes, {} cells: {mass:.1e} {energy:.1e} {momentum:.1e}, floor {floor:.1e}",
        fluid.mesh().cells()
    );
    assert!(mass < 1e-12 && energy < 1e-12 && momentum < 1e-11, "seed {seed}");
    changes > 0
}

#[test]
fn uniform_states_stay_uniform_on_random_trees() {
    (0..24).for_each(|seed| stays_uniform(seed, 200));
}

#[test]
fn nothing_is_lost_on_random_trees() {
    let changed = (100..112).filter(|seed| is_conserved(*seed, 1000)).count();
    assert!(changed > 6, "{changed} of 12 meshes changed");
}

#[test]
#[ignore = "minutes"]
fn many_random_trees() {
    for seed in 1000..1200 {
        stays_uniform(seed, 1000);
        is_conserved(seed, 2000);
    }
}
