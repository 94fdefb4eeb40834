//! A bubble that grows in a closed vessel and whose gas is cut at its largest: ledgers, the pressure it is cut to, the grid that
//! follows it.

use fluid::{
    BubbleContent, BubbleCuts, BubbleReset, FluidSetup, FluidSolver, FollowedBubble, NobleAbelStiffenedGas,
    ResetReport, Shape,
};
use mesh::Adaptation;

use crate::helpers::*;

const RADIUS: f64 = 0.1;
/// Of the ambient liquid and of the gas at the start, Pa.
const PRESSURES: [f64; 2] = [1e7, 4e8];
const RESETS: [BubbleReset; 2] = [BubbleReset::GasShare(0.1), BubbleReset::EquilibriumRadius(0.12, CONTENT)];
const GAS: NobleAbelStiffenedGas = NobleAbelStiffenedGas { gamma: 1.4, pi: 0.0, covolume: 0.0, heat: None };
const CONTENT: BubbleContent = BubbleContent { vapour_pressure: 1e5, ..BubbleContent::dry(1e7, GAS) };

/// A bubble in the middle of a vessel of a metre, on levels of 8 to 64 cells; with a tracer in its upper half.
fn growing(kind: Kind, reset: Option<BubbleReset>, cells_per_radius: Option<f64>) -> FluidSolver<8> {
    let initial = ball_of_gas(([0.5, 0.0], RADIUS), PRESSURES[0], [400.0, PRESSURES[1]], 0.0);
    let followed =
        FollowedBubble { radius: RADIUS, cuts: BubbleCuts::of(&initial), number: 0, cells_per_radius, reset };
    let setup = FluidSetup {
        levels: 3,
        adaptation: Some(Adaptation::by_details(1e-3, 4)),
        followed: Some(followed),
        tracer: Some(Shape::Box { z: [0.5, 1.0], r: [0.0, 1.0] }),
        ..setup_of(kind, AXIAL, [8, 8], CYLINDER)
    };
    FluidSolver::new(&setup, &initial).unwrap()
}

/// Steps level by level, or all together, until the gas is cut and some more.
fn run(fluid: &mut FluidSolver<8>, is_local: bool, mut after: impl FnMut(&FluidSolver<8>)) -> ResetReport {
    let mut left = 40;
    for _ in 0..4000 {
        let base = if is_local { fluid.mesh().coarsest_base() } else { u8::MAX };
        let dt = if is_local { fluid.local_step_limit(CFL, base) } else { fluid.time_step_limit(CFL) };
        fluid.begin_step(dt, base);
        let before = fluid.steps();
        while !fluid.clock().is_over() {
            fluid.sub_step(CFL).unwrap();
        }
        after(fluid);
        let steps = (fluid.steps() - before) as u32;
        fluid.adapt_if_due(dt, steps);
        left -= i32::from(fluid.bubble_reset().is_some());
        if left == 0 {
            return *fluid.bubble_reset().unwrap();
        }
    }
    panic!("the gas was not cut until t = {}", fluid.time());
}

#[test]
fn ledgers_count_the_cut_in_both_models_and_with_local_steps() {
    for (kind, reset, is_local) in [
        (SHARP, RESETS[0], false),
        (SHARP, RESETS[1], true),
        (MIXTURE, RESETS[0], true),
        (MIXTURE, RESETS[1], false),
    ] {
        let mut fluid = growing(kind, Some(reset), Some(8.0));
        let (start, gas) = (fluid.totals(), fluid.bubble().gas_mass);
        let mut last = fluid.bubble();
        let mut largest = 0.0_f64;
        let cut = run(&mut fluid, is_local, |fluid| {
            let bubble = fluid.bubble();
            if fluid.bubble_reset().is_none() {
                assert!(bubble.volume >= last.volume * (1.0 - 1e-6) || largest < 1.01 * 4e-3);
                largest = largest.max(bubble.volume);
            }
            last = bubble;
        });
        let (end, ledger, fixups) = (fluid.totals(), fluid.ledger(), fluid.fixups());
        let sum = |sides: [f64; 4]| sides.iter().sum::<f64>();
        assert_eq!(sum(ledger.mass), 0.0, "no mass passes a wall");
        let off = [
            (end.mass - start.mass - cut.mass) / start.mass,
            (end.momentum_z - start.momentum_z - sum(ledger.momentum) - cut.momentum_z) / (10.0 * start.mass),
            (end.energy - start.energy - cut.energy - fixups.floor_energy) / start.energy,
        ];
        assert!(off.iter().all(|part| part.abs() < 1e-12), "{kind:?}, {reset:?}: {off:?}, {cut:?}");
        // The cut is no small thing.
        assert!(cut.mass < 0.0 && cut.energy < -1e-4 * start.energy, "{cut:?}");
        if kind == SHARP {
            let [before, after] = cut.gas_mass;
            let change = std::f64::consts::TAU * (after - before);
            let added = std::f64::consts::TAU * (fixups.gas_mass_added - fixups.liquid_mass_added);
            let off = (fluid.bubble().gas_mass - gas - change - added) / gas;
            assert!(off.abs() < 1e-12, "{off}");
            assert!((after - before - cut.mass).abs() < 1e-12 * before, "only gas leaves");
        }
        assert!(cut.radius > 1.2 * RADIUS, "{cut:?}");
        match reset {
            BubbleReset::GasShare(share) => {
                assert!((cut.gas_mass[1] / cut.gas_mass[0] / share - 1.0).abs() < 1e-12, "{cut:?}");
                assert!((cut.pressure[1] / cut.pressure[0] / share.powf(1.4) - 1.0).abs() < 1e-12);
            }
            BubbleReset::EquilibriumRadius(radius, content) => {
                let expected = (1e7 - 1e5) * (radius / cut.radius).powf(4.2) + content.vapour_pressure;
                assert!((cut.pressure[1] / expected - 1.0).abs() < 1e-12, "{cut:?} {expected}");
            }
        }
    }
}

/// Right after the cut, with nothing else: pure gas has the factors, pure liquid is as it was to the last bit, velocities stay,
/// and the tracer's mass fraction does.
#[test]
fn only_the_gas_is_cut() {
    for kind in KINDS {
        let [mut with, mut without] = [Some(RESETS[0]), None].map(|reset| growing(kind, reset, Some(8.0)));
        while with.bubble_reset().is_none() {
            for fluid in [&mut with, &mut without] {
                fluid.step_at(CFL).unwrap();
            }
            assert!(with.steps() < 4000);
        }
        let tracer = with.state().components() - 1;
        let (mut gas, mut mixed, mut liquid) = (0, 0, 0);
        for slot in 0..with.mesh().blocks() {
            for cell in 0..64 {
                let [a, b] = [&with, &without].map(|fluid| fluid.cell(slot, cell % 8, cell / 8));
                let fraction = [&with, &without].map(|fluid| {
                    fluid.state().component(slot, tracer)[cell] / fluid.state().component(slot, 0)[cell]
                });
                assert!((fraction[0] - fraction[1]).abs() < 1e-12);
                assert_eq!(a.phi, b.phi);
                // Traces of gas without a volume are cut, too.
                let trace = if kind == SHARP { without.state().component(slot, 5)[cell] } else { 0.0 };
                if b.phi == 0.0 && trace == 0.0 {
                    assert_eq!(a, b);
                    liquid += 1;
                    continue;
                }
                assert!(a.phi > 0.0 || b.density - a.density <= trace.abs() + 1e-12 * b.density);
                assert!((a.v_z - b.v_z).hypot(a.v_r - b.v_r) < 1e-9 * b.v_z.hypot(b.v_r).max(1.0));
                if b.phi > 1.0 - 1e-12 && kind == SHARP {
                    // Traces of liquid without a volume stay: the gas's own mass counts.
                    let mass = with.state().component(slot, 5)[cell] / trace;
                    let factors = [mass / 0.1, a.pressure / b.pressure / 0.1_f64.powf(1.4)];
                    assert!(factors.iter().all(|factor| (factor - 1.0).abs() < 1e-9), "{factors:?}");
                    gas += 1;
                } else {
                    assert!(a.density <= b.density && a.pressure <= b.pressure + 1e-6 * b.pressure.abs());
                    mixed += 1;
                }
            }
        }
        // The paper's mixture has traces of gas nearly everywhere.
        let has_pure = (liquid > 100 && gas > 5) || kind == MIXTURE;
        assert!(mixed > 10 && has_pure, "{liquid} {mixed} {gas}");
        assert!(with.time_step_limit(CFL) > 0.0 && with.step_at(CFL).is_ok());
    }
}

#[test]
fn the_grid_becomes_coarser_as_the_bubble_grows() {
    let finest = |fluid: &FluidSolver<8>| {
        fluid.mesh().tree().leaves().iter().map(|id| id.level).max().unwrap_or_default()
    };
    // Level 3 has 64 cells a metre, 6.4 per radius at the start.
    let mut fluid = growing(SHARP, None, Some(6.0));
    assert_eq!(finest(&fluid), 3);
    let mut levels = vec![];
    for _ in 0..700 {
        fluid.step_at(CFL).unwrap();
        let dt = fluid.time_step_limit(CFL);
        fluid.adapt_if_due(dt, 1);
        levels.push((fluid.bubble().equivalent_radius, finest(&fluid)));
    }
    // Level 2 has six per radius from 0.1875 m on; an adaptation later it is the finest.
    let enough = 6.0 / 32.0;
    let first = levels.iter().position(|(_, level)| *level == 2).expect("it becomes coarser");
    assert!((enough..1.05 * enough).contains(&levels[first].0), "{:?}", levels[first]);
    assert!(levels[..first].iter().all(|(_, level)| *level == 3));
    // And finer again when the bubble is small again.
    let (last, finest_then) = levels[levels.len() - 1];
    assert!(last < 0.95 * enough && finest_then == 3, "{last}");
    // It starts coarse where that is enough.
    assert_eq!(finest(&growing(SHARP, None, Some(3.0))), 2);
}
