//! Each side with its own time step: as exact as with a common one, and nothing is lost between them.

use coupler::Participant;
use mesh::Limiter;

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
