//! What the sides tell each other: in a step of the side with the longer ones its trace and, back, a register, of as many numbers
//! as it has faces; and a bare question where the solid's are the longer.
//!
//! Counted, not timed: what an exchange takes depends on the machine, how many there are does not.

use coupler::{FrameHeader, RegisterRow, TraceRow};

use crate::harness::Sides;

/// The figures' case on a coarse grid.
fn sides(sets: &[&str]) -> Sides {
    let all = ["fluid.levels=4", "solid.levels=2", "time.end=12e-6"];
    Sides::of_shipped("dickopp2012-coarse", all.iter().chain(sets).copied())
}

#[test]
fn a_long_step_costs_one_trace_and_one_register() {
    for (sets, least) in [
        // Sound in steel is four times as fast as in water, and a fluid's step holds as many of the solid's.
        (&[][..], 4),
        (&["fluid.adapt=true", "solid.adapt=true", "time.local_steps=true"], 3),
    ] {
        let mut sides = sides(sets);
        let (start, mut rounds, mut last) = (sides.exchanged(), 0_u64, sides.exchanged());
        let (mut faces, mut goes_on) = (0, true);
        while goes_on {
            goes_on = sides.round(|_, _| ());
            rounds += 1;
            let round = sides.exchanged().since(&last);
            last = sides.exchanged();
            faces = faces
                .max(sides.fluid.solver().interface().faces())
                .max(sides.solid.solver().interface().faces());
            assert!(round.sent + round.received <= 3, "{sets:?}, round {rounds}: {round:?}");
        }
        // Over the whole run: where the longer steps change sides, a round has a trace of each.
        let all = last.since(&start);
        let numbers = (TraceRow::COUNT + RegisterRow::COUNT) * faces * rounds as usize;
        let most = (all.sent + all.received) as usize * size_of::<FrameHeader>() + numbers * size_of::<f64>();
        assert!(all.bytes <= most as u64, "{sets:?}: {} of {most} bytes in {rounds} rounds", all.bytes);
        let steps = [sides.fluid.solver().steps(), sides.solid.solver().steps()];
        eprintln!("{sets:?}: {rounds} rounds, steps {steps:?}, {} sent, {} bytes", all.sent, all.bytes);
        assert!(steps[0] + steps[1] > least * rounds, "{sets:?}: {steps:?} in {rounds} rounds");
    }
}
