//! Adaptive grids: what must be exact on them, and how little a level jump may be seen.

use fluid::{
    Boundary, FluidSetup, FluidSolver, InitialCondition, Primitive, Pulse, PulseShape, RiemannSolver, Scales,
};
use mesh::{Adaptation, Domain, Geometry, LevelBound, Limiter, RegionOfInterest, Zone};

use crate::helpers::*;

fn adaptation(epsilon: f64, bounds: Vec<LevelBound>) -> Option<Adaptation> {
    Some(Adaptation { bounds, ..Adaptation::by_details(epsilon, 4) })
}

/// Steps with adaptation, of all levels alike or of each by itself; returns how often the mesh changed and the fewest and most
/// cells.
fn run_adaptively<const N: usize>(
    fluid: &mut FluidSolver<N>,
    steps: usize,
    local: bool,
) -> (usize, [usize; 2]) {
    let (mut changes, mut cells) = (0, [usize::MAX, 0]);
    let end = fluid.steps() + steps as u64;
    while fluid.steps() < end {
        let (dt, made) = if local { step_locally(fluid) } else { step_together(fluid) };
        changes += usize::from(fluid.adapt_if_due(dt, made));
        let count = fluid.mesh().cells();
        cells = [cells[0].min(count), cells[1].max(count)];
    }
    (changes, cells)
}

/// A bubble of radius 0.3 carried at 200 m/s through 2 × 1 m on three levels.
fn carried(
    kind: Kind,
    local: bool,
    geometry: Geometry,
    riemann: RiemannSolver,
    bounds: Vec<LevelBound>,
    steps: usize,
) -> [f64; 2] {
    let axis = if geometry == AXIAL { Boundary::Axis } else { Boundary::Wall };
    let sides = [Boundary::Periodic, Boundary::Periodic, axis, Boundary::Wall];
    let setup = FluidSetup {
        domain: Domain { geometry, z: [0.0, 2.0], r: [0.0, 1.0] },
        riemann,
        levels: 2,
        adaptation: adaptation(1e-2, bounds),
        scales: Scales { pressure: 1e5, density: 1e3 },
        ..setup_of(kind, geometry, [32, 16], sides)
    };
    let initial = ball_of_gas(([1.0, 0.0], 0.3), 1e5, AIR, 200.0);
    let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
    let (changes, cells) = run_adaptively(&mut fluid, steps, local);
    let mut worst = [0.0_f64; 2];
    each_cell(&fluid, |_, _, w| {
        worst[0] = worst[0].max((w.pressure / 1e5 - 1.0).abs());
        worst[1] = worst[1].max((w.v_z - 200.0).hypot(w.v_r) / 200.0);
        assert!(w.phi > -1e-6 && w.phi < 1.0 + 1e-6, "{w:?}");
    });
    eprintln!(
        "{kind:?} local {local} {geometry:?} {riemann:?} {steps} steps, {changes} changes, {cells:?} cells: \
         dp/p, du/u {:.1e} {:.1e}",
        worst[0], worst[1]
    );
    assert!(changes > 10, "the mesh follows the bubble");
    worst
}

#[test]
fn uniform_pressure_and_velocity_stay_so_while_the_mesh_changes() {
    // The bubble also passes through a strip that is kept coarse, so that the gas meets level jumps.
    let strip = LevelBound { zone: Zone::Box { z: [0.2, 0.6], r: [0.0, 1.0] }, at_least: 0, at_most: 1 };
    for (kind, local) in KINDS.into_iter().flat_map(|kind| [(kind, false), (kind, true)]) {
        for (geometry, bounds) in [(AXIAL, vec![strip]), (PLANAR, vec![])] {
            let worst = carried(kind, local, geometry, RiemannSolver::Hllc, bounds, 1500);
            assert!(worst[0] < 1e-9 && worst[1] < 1e-9);
        }
    }
}

/// A pulse at rest runs apart: of its halves the grid follows that which runs towards the region of interest, and it loses
/// nothing there.
#[test]
fn only_the_wave_that_runs_to_the_region_of_interest_keeps_its_cells() {
    let (amplitude, width) = (1e4, 1.0 / 16.0);
    let c = (LIQUID.gamma * (1e5 + LIQUID.pi) / 1000.0_f64).sqrt();
    let run = |interest: Option<RegionOfInterest>| {
        let epsilon = 1e-4;
        let setup = FluidSetup {
            domain: Domain { geometry: PLANAR, z: [0.0, 1.0], r: [0.0, 0.25] },
            levels: 3,
            adaptation: Some(Adaptation { epsilon, every: 4, bounds: vec![], above: 0, interest }),
            scales: Scales { pressure: amplitude, density: amplitude / (c * c) },
            ..setup(PLANAR, [32, 8], WALLS)
        };
        let pulse =
            Pulse { shape: PulseShape::Plane { direction: None }, centre: [0.5, 0.0], width, amplitude };
        let initial =
            InitialCondition { pulses: vec![pulse], ..ball_of_gas(([9.0, 0.0], 0.1), 1e5, AIR, 0.0) };
        let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
        while fluid.time() < 0.38 / c {
            let dt = fluid.time_step_limit(CFL).min(0.38 / c - fluid.time());
            fluid.step(dt).unwrap();
            fluid.adapt_if_due(dt, 1);
        }
        fluid
    };
    // The lower half is at z = 0.12 then, in the region; the upper one at 0.88.
    let region = RegionOfInterest { centre: [-9.7, 0.125], radius: 10.0 };
    let [all, followed] = [None, Some(region)].map(run);
    let level = |fluid: &FluidSolver<8>, z: f64| {
        let (slot, ..) = fluid.mesh().locate([z, 0.1]).unwrap();
        fluid.mesh().tree().leaves()[slot].level
    };
    assert_eq!([0.12, 0.88].map(|z| level(&all, z)), [3, 3]);
    assert!(level(&followed, 0.12) == 3 && level(&followed, 0.88) < 3);
    let difference = (0..100)
        .map(|k| [0.3 * f64::from(k) / 100.0, 0.1])
        .map(|place| {
            let [a, b] = [&all, &followed].map(|fluid| fluid.sample(place).unwrap().pressure);
            (a - b).abs() / (0.5 * amplitude)
        })
        .fold(0.0, f64::max);
    let share = followed.cell_updates() as f64 / all.cell_updates() as f64;
    eprintln!("the half in the region differs by {difference:.1e}, {share:.2} of the cell updates");
    assert!(difference < 2e-4, "{difference}");
    assert!(share < 0.7, "{share}");
}

#[test]
fn what_is_in_a_closed_box_stays_there() {
    for (geometry, sides) in [(AXIAL, CYLINDER), (PLANAR, PERIODIC), (PLANAR, WALLS)] {
        let setup = FluidSetup {
            levels: 3,
            adaptation: adaptation(2e-2, vec![]),
            scales: Scales { pressure: 1e7, density: 1e3 },
            ..setup(geometry, [8, 8], sides)
        };
        let initial = |[z, r]: [f64; 2]| {
            let d = (z - 0.4).hypot(r - 0.3) / 0.1;
            Primitive { v_z: 5.0, pressure: 5e7 * (1.0 + (-d * d).exp()), ..still(5e7) }
        };
        let mut fluid = FluidSolver::<8>::from_fn(&setup, initial).unwrap();
        let before = fluid.totals();
        let (changes, cells) = run_adaptively(&mut fluid, 1000, false);
        let after = fluid.totals();
        let ledger = fluid.ledger();
        let relative = |a: f64, b: f64, into: &[f64; 4]| (b - a - into.iter().sum::<f64>()).abs() / a.abs();
        let mass = relative(before.mass, after.mass, &ledger.mass);
        let energy = relative(before.energy, after.energy, &ledger.energy);
        // Axial momentum in axial symmetry as in the plane: no geometric term acts on it.
        let momentum =
            (after.momentum_z - before.momentum_z - ledger.momentum.iter().sum::<f64>()).abs() / 1e3 / 5.0;
        eprintln!(
            "{geometry:?} {sides:?}: {changes} changes, {cells:?} cells, {mass:.1e} {energy:.1e} {momentum:.1e}"
        );
        assert!(changes > 5 && cells[0] < cells[1]);
        assert!(mass < 1e-12 && energy < 1e-12 && momentum < 1e-11);
    }
}

/// The largest amplitude of the wave that runs back when a packet of plane waves, 20 coarse cells a wavelength, has
/// crossed level jumps, relative to the packet's.
///
/// - `levels`: of adjacent strips, each as wide as a block of level 0, in the middle of the domain; behind the last
///   strip its level goes on.
fn reflected(limiter: Limiter, levels: &[u8]) -> f64 {
    const AMPLITUDE: f64 = 1e3;
    // Lengths in coarse cells.
    let (cells, wavelength, start, middle) = (384.0, 20.0, 80.0, 192.0);
    let sides = [Boundary::NonReflecting, Boundary::NonReflecting, Boundary::Periodic, Boundary::Periodic];
    let setup = FluidSetup {
        domain: Domain { geometry: PLANAR, z: [0.0, cells], r: [0.0, 8.0] },
        levels: levels.iter().copied().max().unwrap_or(0),
        limiter,
        // No detail is significant: the bounds alone make the mesh.
        adaptation: adaptation(0.99e9, strips(levels, middle)),
        ..setup(PLANAR, [cells as usize, 8], sides)
    };
    let bulk_modulus = LIQUID.gamma * (1e5 + LIQUID.pi);
    let impedance = (1000.0 * bulk_modulus).sqrt();
    let state = |[z, _]: [f64; 2]| {
        let x = (z - start) / wavelength;
        let excess = AMPLITUDE * (std::f64::consts::TAU * x).sin() * (-(x / 1.5).powi(2)).exp();
        Primitive {
            density: 1000.0 * (1.0 + excess / bulk_modulus),
            v_z: excess / impedance,
            ..still(1e5 + excess)
        }
    };
    let mut fluid = FluidSolver::<8>::from_fn(&setup, state).unwrap();
    let on_side = |side: f64| {
        let mesh = fluid.mesh();
        let mut found: Vec<u8> = (mesh.tree().leaves().iter())
            .filter(|id| (mesh.origin(**id)[0] - middle + 1e-6) * side > 0.0)
            .map(|id| id.level)
            .collect();
        found.dedup();
        found
    };
    assert_eq!(on_side(-1.0), [0]);
    assert_eq!(on_side(1.0), if levels.is_empty() { vec![0] } else { levels.to_vec() }, "in Morton order");
    // The packet ends up 200 cells farther; what runs back is then at least 90 cells from it.
    run_to(&mut fluid, 200.0 / (bulk_modulus / 1000.0).sqrt());
    let mut back = 0.0_f64;
    each_cell(&fluid, |[z, _], _, w| {
        if z < middle - 2.0 {
            back = back.max((w.pressure - 1e5 - impedance * w.v_z).abs() / 2.0 / AMPLITUDE);
        }
    });
    back
}

#[test]
fn a_wave_is_not_reflected_at_level_jumps() {
    for limiter in [Limiter::Mc, Limiter::None, Limiter::Minmod] {
        let uniform = reflected(limiter, &[]);
        for strips in [&[1][..], &[1, 2, 1, 0], &[1, 0, 1, 0], &[1, 2, 3, 2, 1, 0]] {
            let back = reflected(limiter, strips);
            eprintln!("{limiter:?} {strips:?}: {back:.2e}, uniform {uniform:.2e}");
            assert!(back < 1e-3, "{limiter:?} {strips:?}: {back}");
        }
    }
}

/// Details beside an open side do not count, but those of the gas fraction do: a bubble that leaves through one was on the
/// coarsest level there after the first adaptation.
#[test]
fn the_interface_is_on_the_finest_level_beside_an_open_side_too() {
    let open = Boundary::NonReflecting;
    let setup = FluidSetup {
        domain: Domain { geometry: AXIAL, z: [0.0, 2.0], r: [0.0, 1.0] },
        levels: 3,
        adaptation: adaptation(1e-2, vec![]),
        scales: Scales { pressure: 1e5, density: 1e3 },
        ..setup(AXIAL, [32, 16], [open, open, Boundary::Axis, open])
    };
    let initial = ball_of_gas(([1.72, 0.0], 0.25), 1e5, AIR, 200.0);
    let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
    let mut beside = 0;
    for _ in 0..30 {
        run_adaptively(&mut fluid, 4, false);
        let mesh = fluid.mesh();
        for (slot, id) in mesh.tree().leaves().iter().enumerate() {
            for (j, i) in (0..8).flat_map(|j| (0..8).map(move |i| (j, i))) {
                if (0.1..0.9).contains(&fluid.cell(slot, i, j).phi) {
                    assert_eq!(id.level, 3, "{:?} at {:e} s", mesh.centre(*id, i, j), fluid.time());
                    beside += usize::from(mesh.centre(*id, i, j)[0] > 2.0 - 2.0 / 32.0);
                }
            }
        }
    }
    assert!(beside > 100, "the interface comes by: {beside}");
}
