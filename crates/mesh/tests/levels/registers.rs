//! What leaves one side of a level jump enters the other.

use mesh::{FluxRegister, Mesh, Side};
use proptest::prelude::*;

use crate::common::*;

const K: usize = 3;

/// Area of the face behind cell `along` on a side of a block: its integral of the weight of the metric.
fn area(mesh: &Mesh<N>, slot: usize, side: Side, along: usize) -> f64 {
    let id = mesh.tree().leaves()[slot];
    let [h_z, h_r] = mesh.widths(id.level);
    let low = mesh.origin(id);
    match side {
        Side::ZMin | Side::ZMax => h_r * mesh.weight(low[1] + (along as f64 + 0.5) * h_r),
        Side::RMin => h_z * mesh.weight(low[1]),
        Side::RMax => h_z * mesh.weight(low[1] + N as f64 * h_r),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..Default::default() })]

    /// Catches faces of the wrong child, side or place, and weights that are not the areas'.
    #[test]
    fn coarse_faces_take_what_fine_faces_pass(plan in plans(3)) {
        let mut random = Random(plan.seed);
        let mesh = plan.grown(&mut random);
        let map = Map::paint(&mesh, plan.periodic);
        let mut register = FluxRegister::<N>::new(mesh.blocks(), K);
        let mut values = vec![[[[0.0; N]; K]; 4]; mesh.blocks()];
        for (slot, values) in values.iter_mut().enumerate() {
            for side in Side::ALL {
                let rows = FluxRegister::<N>::rows(register.values_mut().block_mut(slot), side);
                for (row, values) in rows.chunks_exact_mut(N).zip(&mut values[side as usize]) {
                    random.fill(row);
                    values.copy_from_slice(row);
                }
            }
        }
        let pairs = [(Side::ZMin, Side::ZMax, [-1, 0]), (Side::ZMax, Side::ZMin, [1, 0]),
            (Side::RMin, Side::RMax, [0, -1]), (Side::RMax, Side::RMin, [0, 1])];
        for (slot, id) in mesh.tree().leaves().iter().enumerate() {
            let mut corrected = [None; 4];
            register.for_corrected_sides(&register, &mesh, slot, 0, |side, outward, differences: &[[f64; N]; K]| {
                assert_eq!(outward > 0.0, matches!(side, Side::ZMax | Side::RMax));
                corrected[side as usize] = Some(*differences);
            });
            for (side, opposite, offset) in pairs {
                let beyond = map.beyond(&mesh, slot, offset);
                let levels = beyond.iter().map(|other| mesh.tree().leaves()[*other].level);
                let finer = levels.clone().any(|level| level > id.level);
                assert_eq!(FluxRegister::<N>::is_corrected(&mesh, slot, side), finer);
                let needed = levels.clone().any(|level| level != id.level);
                assert_eq!(FluxRegister::<N>::is_needed(&mesh, slot, side), needed);
                assert_eq!(corrected[side as usize].is_some(), finer);
                let Some(differences) = corrected[side as usize] else { continue };
                for along in 0..N {
                    let difference = differences.map(|row| row[along]);
                    // The two fine faces on this coarse one: the upper half of the cells are the second child's.
                    let child = beyond[along / (N / 2)];
                    let faces = [0, 1].map(|k| 2 * (along % (N / 2)) + k);
                    let areas = faces.map(|face| area(&mesh, child, opposite, face));
                    for quantity in 0..K {
                        let fine = faces.map(|face| values[child][opposite as usize][quantity][face]);
                        let own = values[slot][side as usize][quantity][along];
                        let passed = areas[0] * fine[0] + areas[1] * fine[1];
                        let [low, high] = [area(&mesh, slot, side, along), areas[0] + areas[1]];
                        assert!((low - high).abs() <= 1e-14 * high);
                        let taken = low * (own + difference[quantity]);
                        assert!((taken - passed).abs() <= 1e-14 * high, "{side:?}: {taken} for {passed}");
                        if high > 0.0 {
                            let mean = passed / high;
                            assert!((own + difference[quantity] - mean).abs() <= 1e-14);
                        }
                    }
                }
            }
        }
    }
}
