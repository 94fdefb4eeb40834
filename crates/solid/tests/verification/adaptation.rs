//! Adaptive grids: what must be exact on them, and how little a level jump may be seen.

use mesh::{Adaptation, Domain, LevelBound, Limiter, RegionOfInterest};
use solid::{Boundary, ElasticState, SolidSetup, SolidSolver};

use crate::helpers::*;

const AMPLITUDE: f64 = 1e7;

fn adaptive(setup: SolidSetup, levels: u8, epsilon: f64, bounds: Vec<LevelBound>) -> SolidSetup {
    let adaptation = Some(Adaptation { bounds, ..Adaptation::by_details(epsilon, 4) });
    SolidSetup { levels, adaptation, stress_scale: AMPLITUDE, ..setup }
}

/// Steps with adaptation; returns how often the mesh changed and the fewest and most cells.
fn run_adaptively<const N: usize>(solid: &mut SolidSolver<N>, steps: usize) -> (usize, [usize; 2]) {
    let (mut changes, mut cells) = (0, [usize::MAX, 0]);
    for _ in 0..steps {
        let dt = solid.time_step_limit(CFL);
        let follows = solid.adaptation_follows(dt, 1);
        solid.step(dt).unwrap();
        changes += usize::from(follows && solid.adapt(dt, 1));
        let count = solid.mesh().cells();
        cells = [cells[0].min(count), cells[1].max(count)];
    }
    (changes, cells)
}

/// A moving, sheared lump off the axis.
fn lump([z, r]: [f64; 2]) -> ElasticState {
    let bell = (-((z - 0.4) / 0.1).powi(2) - ((r - 0.3) / 0.1).powi(2)).exp();
    ElasticState {
        v_z: bell,
        v_r: -r * bell,
        stress_zz: -AMPLITUDE * bell,
        stress_zr: AMPLITUDE * r * bell,
        stress_rr: -0.5 * AMPLITUDE * bell,
        stress_phiphi: -0.5 * AMPLITUDE * bell,
    }
}

#[test]
fn momentum_stays_what_the_ledger_says() {
    let open = [Boundary::NonReflecting, Boundary::Free, Boundary::Axis, Boundary::NonReflecting];
    let fixed = [Boundary::Fixed, Boundary::Free, Boundary::Axis, Boundary::Fixed];
    for (geometry, sides) in [(AXIAL, CYLINDER), (AXIAL, fixed), (AXIAL, open), (PLANAR, PERIODIC)] {
        let setup = adaptive(setup(geometry, [8, 8], sides), 3, 2e-2, vec![]);
        let mut solid = SolidSolver::<8>::new(setup, lump).unwrap();
        let before = solid.totals();
        let (changes, cells) = run_adaptively(&mut solid, 1000);
        let after = solid.totals();
        let change = after.momentum_z - before.momentum_z - solid.ledger().momentum.iter().sum::<f64>();
        let relative = (change / before.mass).abs();
        eprintln!("{geometry:?} {sides:?}: {changes} changes, {cells:?} cells, momentum {relative:.1e} m/s");
        assert!(changes > 3 && cells[0] < cells[1]);
        // Relative to 1 m/s of the whole mass.
        assert!(relative < 1e-13, "{relative}");
    }
}

/// A wave in a stressed solid is the wave plus the stress, whatever the mesh does: nothing in adaptation sets a
/// uniform stress in motion.
#[test]
fn a_uniform_stress_stays_at_rest_under_a_wave() {
    let stress = ElasticState {
        v_z: 0.0,
        v_r: 0.0,
        stress_zz: -3e7,
        stress_zr: 0.0,
        stress_rr: -2e7,
        stress_phiphi: -2e7,
    };
    for (geometry, sides, epsilon) in [(AXIAL, CYLINDER, 2e-2), (PLANAR, PERIODIC, 0.1)] {
        let start = |with: f64| {
            let setup = adaptive(setup(geometry, [8, 8], sides), 3, epsilon, vec![]);
            let initial = move |place| {
                let (wave, uniform) = (lump(place).to_array(), stress.to_array());
                ElasticState::from_array(std::array::from_fn(|c| wave[c] + with * uniform[c]))
            };
            SolidSolver::<8>::new(setup, initial).unwrap()
        };
        let (mut alone, mut stressed) = (start(0.0), start(1.0));
        let (changes, cells) = run_adaptively(&mut alone, 500);
        run_adaptively(&mut stressed, 500);
        assert!(changes > 1 && cells[0] < cells[1]);
        assert_eq!(alone.mesh().tree().leaves(), stressed.mesh().tree().leaves());
        let impedance = STEEL.density * STEEL.c1;
        let mut worst = 0.0_f64;
        for slot in 0..alone.mesh().blocks() {
            for k in 0..64 {
                let [a, b] = [&stressed, &alone].map(|solid| solid.cell(slot, k % 8, k / 8).to_array());
                for (c, uniform) in stress.to_array().into_iter().enumerate() {
                    let scale = if c < 2 { impedance } else { 1.0 };
                    worst = worst.max(scale * (a[c] - b[c] - uniform).abs() / 3e7);
                }
            }
        }
        eprintln!("{geometry:?}: {changes} changes, {cells:?} cells: {worst:.1e} of the stress");
        assert!(worst < 1e-11, "{worst}");
    }
}

/// A pulse at rest runs apart: of its halves the grid follows that which runs towards the region of interest, and it loses
/// nothing there.
#[test]
fn only_the_wave_that_runs_to_the_region_of_interest_keeps_its_cells() {
    for (wave, c) in [(Wave::Pressure, STEEL.c1), (Wave::Shear, STEEL.c2)] {
        let run = |interest: Option<RegionOfInterest>| {
            let sides = [Boundary::Fixed, Boundary::Fixed, Boundary::Periodic, Boundary::Periodic];
            let mut setup = adaptive(setup(PLANAR, [32, 8], sides), 3, 1e-4, vec![]);
            setup.domain = Domain { geometry: PLANAR, z: [0.0, 1.0], r: [0.0, 0.25] };
            setup.adaptation.as_mut().unwrap().interest = interest;
            let initial = move |[z, _]: [f64; 2]| {
                let stress = AMPLITUDE * (-((z - 0.5) * 16.0).powi(2)).exp();
                let across = stress * (1.0 - 2.0 * (STEEL.c2 / STEEL.c1).powi(2));
                match wave {
                    Wave::Pressure => {
                        ElasticState { stress_zz: stress, stress_rr: across, stress_phiphi: across, ..REST }
                    }
                    Wave::Shear => ElasticState { stress_zr: stress, ..REST },
                }
            };
            let mut solid = SolidSolver::<8>::new(setup, initial).unwrap();
            while solid.time() < 0.38 / c {
                let dt = solid.time_step_limit(CFL).min(0.38 / c - solid.time());
                solid.step(dt).unwrap();
                solid.adapt_if_due(dt, 1);
            }
            solid
        };
        // The lower half is at z = 0.12 then, in the region; the upper one at 0.88.
        let region = RegionOfInterest { centre: [-9.7, 0.125], radius: 10.0 };
        let [all, followed] = [None, Some(region)].map(run);
        let level = |solid: &SolidSolver<8>, z: f64| {
            let (slot, ..) = solid.mesh().locate([z, 0.1]).unwrap();
            solid.mesh().tree().leaves()[slot].level
        };
        assert_eq!([0.12, 0.88].map(|z| level(&all, z)), [3, 3], "{wave:?}");
        assert!(level(&followed, 0.12) == 3 && level(&followed, 0.88) < 3, "{wave:?}");
        let difference = (0..100)
            .map(|k| [0.3 * f64::from(k) / 100.0, 0.1])
            .map(|place| {
                let [a, b] = [&all, &followed].map(|solid| solid.sample(place).unwrap());
                let difference = (a.stress_zz - b.stress_zz).abs().max((a.stress_zr - b.stress_zr).abs());
                difference / (0.5 * AMPLITUDE)
            })
            .fold(0.0, f64::max);
        let share = followed.cell_updates() as f64 / all.cell_updates() as f64;
        eprintln!("{wave:?}: in the region {difference:.1e}, {share:.2} of the cell updates");
        assert!(difference < 5e-4, "{wave:?}: {difference}");
        assert!(share < 0.7, "{wave:?}: {share}");
    }
}

/// Nothing moves, nothing is stressed.
const REST: ElasticState =
    ElasticState { v_z: 0.0, v_r: 0.0, stress_zz: 0.0, stress_zr: 0.0, stress_rr: 0.0, stress_phiphi: 0.0 };

/// The two plane waves along z.
#[derive(Clone, Copy, Debug)]
enum Wave {
    Pressure,
    Shear,
}

/// The largest amplitude of the wave that runs back when a packet of plane waves, 20 coarse cells a wavelength, has
/// crossed level jumps, relative to the packet's.
///
/// - `levels`: of adjacent strips, each as wide as a block of level 0, in the middle of the domain; behind
///   the last one its level goes on.
fn reflected(wave: Wave, limiter: Limiter, levels: &[u8]) -> f64 {
    // Lengths in coarse cells.
    let (cells, wavelength, start, middle) = (384.0, 20.0, 80.0, 192.0);
    let sides = [Boundary::NonReflecting, Boundary::NonReflecting, Boundary::Periodic, Boundary::Periodic];
    let setup = SolidSetup {
        domain: Domain { geometry: PLANAR, z: [0.0, cells], r: [0.0, 8.0] },
        limiter,
        // No detail is significant: the bounds alone make the mesh.
        ..adaptive(
            setup(PLANAR, [cells as usize, 8], sides),
            levels.iter().copied().max().unwrap_or(0),
            0.99e9,
            strips(levels, middle),
        )
    };
    let (c, lambda) = match wave {
        Wave::Pressure => (STEEL.c1, 1.0 - 2.0 * (STEEL.c2 / STEEL.c1).powi(2)),
        Wave::Shear => (STEEL.c2, 0.0),
    };
    let impedance = STEEL.density * c;
    let initial = |[z, _]: [f64; 2]| {
        let x = (z - start) / wavelength;
        let v = (std::f64::consts::TAU * x).sin() * (-(x / 1.5).powi(2)).exp();
        let stress = -impedance * v;
        match wave {
            Wave::Pressure => ElasticState {
                v_z: v,
                stress_zz: stress,
                stress_rr: lambda * stress,
                stress_phiphi: lambda * stress,
                ..ElasticState::default()
            },
            Wave::Shear => ElasticState { v_r: v, stress_zr: stress, ..ElasticState::default() },
        }
    };
    let mut solid = SolidSolver::<8>::new(setup, initial).unwrap();
    let behind: Vec<u8> = (solid.mesh().tree().leaves().iter())
        .filter(|id| solid.mesh().origin(**id)[0] > middle - 1e-6)
        .map(|id| id.level)
        .fold(vec![], |mut levels, level| {
            if levels.last() != Some(&level) {
                levels.push(level);
            }
            levels
        });
    assert_eq!(behind, if levels.is_empty() { vec![0] } else { levels.to_vec() }, "in Morton order");
    // The packet ends up 200 cells farther; what runs back is then at least 90 cells from it.
    run_to(&mut solid, 200.0 / c);
    let mut back = 0.0_f64;
    each_cell(&solid, |[z, _], w| {
        if z < middle - 2.0 {
            let (stress, v) = match wave {
                Wave::Pressure => (w.stress_zz, w.v_z),
                Wave::Shear => (w.stress_zr, w.v_r),
            };
            back = back.max((stress + impedance * v).abs() / 2.0 / impedance);
        }
    });
    back
}

#[test]
fn a_wave_is_not_reflected_at_level_jumps() {
    for wave in [Wave::Pressure, Wave::Shear] {
        for limiter in [Limiter::Mc, Limiter::None, Limiter::Minmod] {
            let uniform = reflected(wave, limiter, &[]);
            for strips in [&[1][..], &[1, 2, 1, 0], &[1, 0, 1, 0]] {
                let back = reflected(wave, limiter, strips);
                eprintln!("{wave:?} {limiter:?} {strips:?}: {back:.2e}, uniform {uniform:.2e}");
                assert!(back < 1e-3, "{wave:?} {limiter:?} {strips:?}: {back}");
            }
        }
    }
}
