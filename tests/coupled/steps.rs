//! Each side with its own time step: as exact as with a common one, and nothing is lost between them. Levels with steps of their
//! own: where that saves work.

use coupler::Participant;
use mesh::Limiter;

use crate::harness::Sides;
use crate::modes::{END, at_start, errors};

/// Errors of the coupled mode with `ratio` short steps in each long one, and the mismatch of impulse and work.
fn run(cells: usize, long: Participant, ratio: u32) -> [f64; 4] {
    let mut pair = at_start([cells; 2], Limiter::None);
    pair.run_in_ratio(END, 0.45, long, ratio, false);
    let [short, long_steps] = match long {
        Participant::Fluid => [pair.solid.steps(), pair.fluid.steps()],
        Participant::Solid => [pair.fluid.steps(), pair.solid.steps()],
    };
    assert_eq!(short, u64::from(ratio) * long_steps, "as many short steps as asked for");
    let (given, taken) = (pair.fluid.ledger(), pair.solid.ledger());
    let [p, s] = errors(&pair.fluid, &pair.solid);
    // The solid's ledger counts what comes in; the pressure pushes it down.
    let impulse = given.wall_impulse + taken.momentum[1];
    let work = given.wall_work + taken.energy[1];
    [p, s, impulse / given.wall_impulse.abs(), work / given.wall_work.abs()]
}

#[test]
fn the_mode_is_as_exact_with_steps_of_their_own() {
    for (long, ratios) in [(Participant::Fluid, [1, 2, 4, 8, 16]), (Participant::Solid, [1, 2, 4, 8, 16])] {
        let common = [32, 64].map(|cells| run(cells, long, 1));
        for ratio in ratios {
            let found = [32, 64].map(|cells| run(cells, long, ratio));
            for (side, medium) in ["fluid", "solid"].into_iter().enumerate() {
                let e = found.map(|errors| errors[side]);
                let order = (e[0] / e[1]).log2();
                eprintln!("{long:?} long, {ratio} in one, {medium}: {e:?}, order {order:.2}");
                assert!(order >= 1.8, "{long:?}, {ratio}, {medium}: {e:?} is order {order:.2}");
                // Both sides' own errors change with their Courant numbers; what the coupling adds would be of first order.
                assert!(e[1] < 1.5 * common[1][side] + 1e-4, "{long:?}, {ratio}, {medium}: {e:?}");
            }
            for [.., impulse, work] in found {
                eprintln!("  impulse {impulse:.1e}, work {work:.1e}");
                assert!(impulse.abs() < 1e-13 && work.abs() < 1e-11, "{impulse:e}, {work:e}");
            }
        }
    }
}

/// The figures' bubble on coarse grids that adapt, through its collapse and the shock on the wall: the cells that each side has
/// stepped, and what the wall was given, N s and J.
fn figures(local_steps: &str) -> [[f64; 2]; 2] {
    let local_steps = format!("time.local_steps={local_steps}");
    let grids = ["fluid.levels=5", "solid.levels=5", "fluid.near_wall.shock_levels=0", "time.end=50e-6"];
    let mut sides = Sides::of_shipped("collapse-near-steel", grids.into_iter().chain([&*local_steps]));
    sides.run(|_, _| {});
    let (fluid, solid) = (sides.fluid.solver(), sides.solid.solver());
    let ledger = fluid.ledger();
    [[fluid.cell_updates() as f64, solid.cell_updates() as f64], [ledger.wall_impulse, ledger.wall_work]]
}

#[test]
fn by_default_levels_step_by_themselves_where_that_saves_work() {
    let [never, auto, always] = ["false", "auto", "true"].map(figures);
    eprintln!("never {never:?}\nauto {auto:?}\nalways {always:?}");
    for side in 0..2 {
        assert!(auto[0][side] <= 1.001 * never[0][side], "side {side}: {auto:?}, {never:?}");
    }
    assert!(auto[0][1] < 0.95 * never[0][1], "the solid saves some: {auto:?}, {never:?}");
    for (quantity, bound) in [2e-4, 2e-3].into_iter().enumerate() {
        for other in [auto, always] {
            let off = (other[1][quantity] / never[1][quantity] - 1.0).abs();
            assert!(off < bound, "what the wall is given stays: {off:e}");
        }
    }
}
