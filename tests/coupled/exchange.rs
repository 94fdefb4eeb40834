//! What the sides tell each other: in a step of the side with the longer ones its trace and, back, a register, of as many numbers
//! as it has faces; and a bare question where the solid's are the longer.
//!
//! Counted, not timed: what an exchange takes depends on the machine, how many there are does not.

use std::path::Path;

use cav::case::Case;
use coupler::{FrameHeader, RegisterRow, TraceRow};

use crate::harness::Sides;

/// The figures' case on a coarse grid.
fn sides(sets: &[&str]) -> Sides {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/dickopp2012-coarse.toml");
    let all = ["fluid.levels=4", "solid.levels=2", "time.end=12e-6", "time.snapshots=[]"];
    let sets: Vec<String> = all.iter().chain(sets).map(|set| (*set).to_owned()).collect();
    Sides::of(&Case::load(&path, &sets).unwrap_or_else(|errors| panic!("{errors}")))
}

#[test]
fn a_long_step_costs_one_trace_and_one_register() {
    for (sets, least) in [
        // Sound in steel is four times as fast as in water, and a fluid's step holds as many of the solid's.
        (&[][..], 4),
        (&["fluid.adapt=true", "solid.adapt=true", "time.local_steps=true"], 4),
    ] {
        let mut sides = sides(sets);
        let (start, mut rounds, mut last) = (sides.exchanged(), 0_u64, sides.exchanged());
        let mut goes_on = true;
        while goes_on {
            goes_on = sides.round(|_, _| ());
            rounds += 1;
            let round = sides.exchanged().since(&last);
            last = sides.exchanged();
            let faces = sides.fluid.solver().wall_faces().max(sides.solid.solver().surface_faces());
            let numbers = (TraceRow::COUNT + RegisterRow::COUNT) * faces;
            let frames = round.sent + round.received;
            let most = frames as usize * size_of::<FrameHeader>() + numbers * size_of::<f64>();
            assert!(frames <= 3, "{sets:?}, round {rounds}: {frames} frames");
            assert!(round.bytes <= most as u64, "{sets:?}, round {rounds}: {} of {most} bytes", round.bytes);
        }
        let all = last.since(&start);
        let steps = [sides.fluid.solver().steps(), sides.solid.solver().steps()];
        eprintln!("{sets:?}: {rounds} rounds, steps {steps:?}, {} sent, {} bytes", all.sent, all.bytes);
        assert!(steps[0] + steps[1] > least * rounds, "{sets:?}: {steps:?} in {rounds} rounds");
    }
}
