//! Levels that step by themselves keep their place in time in two fields.

use mesh::{Field, LevelSteps, Mesh, Neighbour};
use proptest::prelude::*;

use crate::common::*;

/// A step of a block's level: what it was, what it comes to, and where on the way it is seen.
#[derive(Clone, Copy, Default)]
struct Way {
    begin: f64,
    end: f64,
    from: f64,
    to: f64,
    seen: f64,
}

fn is_beside_finer(mesh: &Mesh<N>, slot: usize) -> bool {
    mesh.tree().neighbours(slot).iter().any(|neighbour| matches!(neighbour, Neighbour::Finer(_)))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..Default::default() })]

    /// Catches ends that are taken for the present, blocks left in the wrong field, and numbers of steps that are odd.
    #[test]
    fn every_block_is_where_its_level_is(plan in plans(3), whole_steps in 1usize..3) {
        let mut random = Random(plan.seed);
        let mesh = plan.grown(&mut random);
        let base = random.below(3) as u8;
        let mut steps = LevelSteps::<N>::new(1, mesh.blocks());
        // What is in the second field may be of another mesh.
        let [mut state, mut next] = [0.0, f64::NAN].map(|value| {
            let mut field = Field::zeros(mesh.blocks(), N * N, 1);
            field.as_mut_slice().fill(value);
            field
        });
        let mut ways = vec![Way::default(); mesh.blocks()];
        let mut now = 0.0;
        for _ in 0..whole_steps {
            let watched: Vec<usize> = (0..mesh.blocks()).filter(|_| random.below(5) == 0).collect();
            steps.begin(&mesh, base, now, 1.0, &watched);
            while !steps.clock().is_over() {
                while steps.clock().due().is_some() {
                    let step = steps.start(0.1 + random.unit());
                    for (slot, way) in ways.iter_mut().enumerate() {
                        if steps.clock().group_of(&mesh, slot) != step.group {
                            continue;
                        }
                        // What the step begins with is in the field that is read, in all blocks of the group.
                        prop_assert!(state.block(slot).iter().all(|value| (value - way.to).abs() < 1e-13));
                        let [begin, end] = [step.begin, steps.clock().end(step.group)];
                        *way = Way { begin, end, from: way.to, to: random.unit(), seen: way.to };
                        next.block_mut(slot).fill(way.to);
                    }
                }
                let later = steps.clock().next();
                // What is corrected ends in the second field, and the first one has what it was last seen as.
                steps.before_corrections(&mesh, &mut state, &mut next);
                for (slot, way) in ways.iter().enumerate().filter(|(_, way)| way.end == later) {
                    if is_beside_finer(&mesh, slot) && !watched.contains(&slot) {
                        prop_assert!((next.block(slot)[0] - way.to).abs() < 1e-13);
                        prop_assert!((state.block(slot)[0] - way.seen).abs() < 1e-13);
                    }
                }
                steps.finish_step(&mesh, &mut state, &mut next);
                now = steps.clock().now();
                prop_assert_eq!(now, later);
                for (slot, way) in ways.iter_mut().enumerate() {
                    let (clock, is_watched) = (steps.clock(), watched.contains(&slot));
                    let group = clock.group_of(&mesh, slot);
                    // Finer neighbours begin a step.
                    let is_read = is_beside_finer(&mesh, slot)
                        && (group == clock.finest() || clock.end(group + 1) <= now);
                    if now >= way.end {
                        way.seen = way.to;
                    } else if is_read || is_watched {
                        way.seen = way.from + (now - way.begin) / (way.end - way.begin) * (way.to - way.from);
                    }
                    let is_aside = steps.is_aside(&mesh, slot);
                    prop_assert!(!is_aside || now < way.end && !is_read && !is_watched);
                    let present = if is_aside { &next } else { &state }.block(slot);
                    prop_assert!(present.iter().all(|value| (value - way.seen).abs() < 1e-13), "{slot} at {now}");
                }
            }
            prop_assert!((0..mesh.blocks()).all(|slot| state.block(slot)[0] == ways[slot].to));
            // A mesh that has been adapted since is read before its first step.
            let wanted = random_levels(&mesh, &mut random, [0.8, 0.1]);
            if let Some(mesh) = towards(&mesh, &wanted).map(|adapted| adapted.mesh) {
                prop_assert!((0..mesh.blocks()).all(|slot| !steps.is_aside(&mesh, slot)));
            }
        }
    }
}
