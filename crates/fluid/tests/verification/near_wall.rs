//! Levels above the others next to the wall: what they are worth where a shock hits it, and where a film is thin.

use fluid::{Boundary, FluidSetup, FluidSolver, NearWall, Primitive, Scales};
use mesh::{Adaptation, Domain};

use crate::helpers::*;

/// Ambient pressure and rise of the pressure behind the front, Pa.
const AMBIENT: f64 = 5e7;
const RISE: f64 = 2e8;

/// What a shock does to a wall, and what it takes to say so.
struct Hit {
    /// The largest pressure in a cell at the wall, Pa.
    peak: f64,
    /// Mean over 20 µs about the arrival, Pa.
    mean: f64,
    updates: u64,
    /// The finest level there ever was, and that at the end.
    finest: [u8; 2],
    /// How far from the wall blocks above the others ever reached, in cells of those.
    reach: f64,
}

/// A plane front, half a metre above a wall, with a pressure that falls to 1/e within 0.1 m behind it: as what a collapse sends. 64 · 2^finer
/// cells a metre, and so many levels more next to the wall.
fn hit(finer: u8, above: u8, local: bool) -> Hit {
    let base = 1 + finer;
    let near_wall = NearWall { reference_pressure: AMBIENT, shock_levels: above, ..NearWall::default() };
    let setup = FluidSetup {
        domain: Domain { geometry: PLANAR, z: [0.0, 1.0], r: [0.0, 0.25] },
        levels: base + above,
        adaptation: Some(Adaptation { above, ..Adaptation::by_details(1e-3, 8) }),
        near_wall,
        scales: Scales { pressure: AMBIENT, density: 1e3 },
        ..setup_of(SHARP, PLANAR, [32, 8], WALLS)
    };
    let impedance = 1e3 * (7.15_f64 * (AMBIENT + 3e8) / 1e3).sqrt();
    let wave = |z: f64| if z < 0.5 { 0.0 } else { RISE * (-(z - 0.5) / 0.1).exp() };
    let state = |[z, _]: [f64; 2]| {
        let rise = wave(z);
        Primitive { pressure: AMBIENT + rise, v_z: -rise / impedance, ..still(AMBIENT) }
    };
    let mut fluid = FluidSolver::<8>::from_fn(&setup, state).unwrap();
    let mut hit = Hit { peak: 0.0, mean: 0.0, updates: 0, finest: [0; 2], reach: 0.0 };
    let coarse = fluid.mesh().widths(base)[0];
    while fluid.time() < 0.45e-3 {
        let (dt, made) = if local { step_locally(&mut fluid) } else { step_together(&mut fluid) };
        hit.peak = fluid.wall_pressures().axis.max(hit.peak);
        if fluid.time() > 0.25e-3 {
            hit.mean += fluid.wall_pressures().axis * dt / 0.2e-3;
        }
        fluid.adapt_if_due(dt, made);
        let mesh = fluid.mesh();
        hit.finest = [mesh.levels_present()[1].max(hit.finest[0]), mesh.levels_present()[1]];
        for id in mesh.tree().leaves().iter().filter(|id| id.level > base) {
            let top = mesh.origin(*id)[0] + 8.0 * mesh.widths(id.level)[0];
            hit.reach = hit.reach.max(top / coarse);
        }
    }
    hit.updates = fluid.cell_updates();
    hit
}

#[test]
fn a_shock_that_hits_the_wall_is_resolved_there_and_nowhere_else() {
    let converged = hit(3, 0, true);
    for local in [false, true] {
        let [plain, raised] = [hit(0, 0, local), hit(0, 2, local)];
        let short = |hit: &Hit| (converged.peak - hit.peak) / (converged.peak - AMBIENT);
        eprintln!(
            "local steps {local}: peak short by {:.1} %, with two levels by {:.1} %; mean {:.2e} {:.2e} {:.2e} Pa; updates {} and {}; \
             reach {} cells",
            100.0 * short(&plain),
            100.0 * short(&raised),
            plain.mean,
            raised.mean,
            converged.mean,
            plain.updates,
            raised.updates,
            raised.reach
        );
        assert!(short(&plain) > 0.1, "there is something to win");
        assert!(short(&raised) < 0.6 * short(&plain), "half of what is lost is lost on the way");
        assert!((raised.mean / converged.mean - 1.0).abs() < 0.01);
        assert_eq!(plain.finest[0], 1);
        assert_eq!(raised.finest, [3, 1], "they come, and go with the shock");
        assert!(raised.reach <= 16.0, "a block of the others, and its neighbour by grading");
    }
}

#[test]
fn a_shock_elsewhere_raises_nothing_and_changes_no_bit() {
    let run = |above: u8| {
        let setup = FluidSetup {
            levels: 1 + above,
            adaptation: Some(Adaptation { above, ..Adaptation::by_details(1e-3, 4) }),
            near_wall: NearWall {
                reference_pressure: 1e6,
                shock_levels: above,
                film_levels: above,
                film_cells: 8,
            },
            scales: Scales { pressure: 1e6, density: 1e3 },
            ..setup_of(SHARP, AXIAL, [64, 64], CYLINDER)
        };
        let mut fluid =
            FluidSolver::<8>::new(&setup, &ball_of_gas(([0.7, 0.0], 0.1), 1e6, AIR, 0.0)).unwrap();
        for _ in 0..40 {
            let (dt, made) = step_together(&mut fluid);
            fluid.adapt_if_due(dt, made);
        }
        global_sums(&fluid)
    };
    assert_eq!(run(0), run(2));
}

/// Every cell's state, in the order of the slots.
fn global_sums(fluid: &FluidSolver<8>) -> Vec<u64> {
    let mut bits = Vec::new();
    each_cell(fluid, |[z, r], _, w| {
        bits.extend([z, r, w.density, w.v_z, w.v_r, w.pressure, w.phi].map(f64::to_bits));
    });
    bits
}

#[test]
fn a_thin_film_has_the_cells_that_it_should_have() {
    let film = |film_levels: u8| {
        let setup = FluidSetup {
            levels: 2 + film_levels,
            adaptation: Some(Adaptation { above: film_levels, ..Adaptation::by_details(1e-3, 4) }),
            near_wall: NearWall { reference_pressure: 1e5, shock_levels: 0, film_levels, film_cells: 6 },
            scales: Scales { pressure: 1e5, density: 1e3 },
            ..setup_of(
                SHARP,
                AXIAL,
                [16, 16],
                [Boundary::Wall, Boundary::Wall, Boundary::Axis, Boundary::Wall],
            )
        };
        let mut fluid =
            FluidSolver::<8>::new(&setup, &ball_of_gas(([0.43, 0.0], 0.4), 1e5, AIR, 0.0)).unwrap();
        for _ in 0..16 {
            let (dt, made) = step_together(&mut fluid);
            fluid.adapt_if_due(dt, made);
        }
        let (film, is_on_wall) = fluid.film();
        assert!(!is_on_wall);
        film.map(|film| (film, fluid.mesh().levels_present()[1]))
    };
    // 0.03 m at cells of 1/64 m: two cells, with a level more four. Two levels more are enough for six everywhere.
    for (above, cells) in [(0, 1.92), (1, 3.84)] {
        let (film, finest) = film(above).expect("a film");
        assert!((film.thickness / 0.03 - 1.0).abs() < 0.06, "{film:?}");
        assert!((film.cells() / cells - 1.0).abs() < 0.06, "{film:?}, {cells} cells");
        assert!(film.radius < 0.02, "below the bubble: {film:?}");
        assert_eq!(finest, 2 + above, "as fine as may be");
    }
    let (film, finest) = film(3).expect("a film");
    assert!((6.0..12.0).contains(&film.cells()), "{film:?}");
    assert_eq!(finest, 4, "as fine as need be");
}
