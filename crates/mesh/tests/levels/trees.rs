//! Leaves tile the domain, in Morton order, graded; neighbours, points and sides are found.

use mesh::{Domain, Field, Mesh, Neighbour, Offset, Patch, ScratchPool, Side};
use proptest::prelude::*;

use crate::common::*;

/// One adaptation where each block has random significant cells, sometimes with a level demanded from outside.
fn adapt_at_random(mesh: &Mesh<N>, random: &mut Random) -> Option<Mesh<N>> {
    let mut field = Field::zeros(mesh.blocks(), N * N, 1);
    for (slot, id) in mesh.tree().leaves().iter().enumerate() {
        let size = match random.below(6) {
            0 | 1 => 20.0,
            2 => 2.0,
            _ => 0.0,
        };
        field.block_mut(slot)[random.below(N * N)] = size * threshold(mesh, id.level);
    }
    let reach = random.unit() * N as f64;
    let demanded = random.below(4 * mesh.blocks());
    let scratch = ScratchPool::new(|| Patch::zeros(1));
    let at_least = |slot: usize| if slot == demanded { mesh.tree().finest() } else { 0 };
    mesh.adapted(&field, &TOLD, &EVERYWHERE, &scratch, |_| reach, at_least).map(|adapted| adapted.mesh)
}

fn check_order(mesh: &Mesh<N>) {
    let key = |[x, y]: [i64; 2]| {
        (0..32).fold(0u64, |key, bit| {
            key | ((x as u64 >> bit & 1) << (2 * bit)) | ((y as u64 >> bit & 1) << (2 * bit + 1))
        })
    };
    let keys: Vec<u64> = mesh.tree().leaves().iter().map(|id| key(square(mesh, *id).0)).collect();
    assert!(keys.is_sorted_by(|a, b| a < b), "leaves follow the Z curve");
}

fn check_neighbours(mesh: &Mesh<N>, map: &Map) {
    let tree = mesh.tree();
    for (slot, id) in tree.leaves().iter().enumerate() {
        assert!((tree.root_level()..=tree.finest()).contains(&id.level));
        assert_eq!(tree.slot(*id), Some(slot));
        for (offset, neighbour) in Offset::ALL.iter().zip(tree.neighbours(slot)) {
            let beyond = map.beyond(mesh, slot, [i64::from(offset.i), i64::from(offset.j)]);
            let levels: Vec<i32> = beyond
                .iter()
                .map(|other| i32::from(tree.leaves()[*other].level) - i32::from(id.level))
                .collect();
            assert!(levels.iter().all(|level| level.abs() <= 1), "{id:?} meets levels {levels:?} away");
            let expected = match (&beyond[..], &levels[..]) {
                ([], _) => Neighbour::Boundary,
                ([other], [0]) => Neighbour::Same(*other),
                ([other], [-1]) => Neighbour::Coarser(*other),
                ([first], [1]) => Neighbour::Finer([*first; 2]),
                ([first, second], [1, 1]) => Neighbour::Finer([*first, *second]),
                _ => panic!("{id:?} meets {beyond:?} at {offset:?}"),
            };
            assert_eq!(*neighbour, expected, "{id:?} at {offset:?}");
        }
    }
}

fn check_points(mesh: &Mesh<N>, map: &Map, random: &mut Random) {
    let domain = *mesh.domain();
    let finest = mesh.widths(mesh.tree().finest());
    for trial in 0..20 {
        let mut point = [
            domain.z[0] + random.unit() * (domain.z[1] - domain.z[0]),
            domain.r[0] + random.unit() * (domain.r[1] - domain.r[0]),
        ];
        match trial {
            0 => point[0] = domain.z[0],
            1 => point[0] = domain.z[1],
            2 => point[1] = domain.r[0],
            3 => point[1] = domain.r[1],
            _ => {}
        }
        let (slot, i, j) = mesh.locate(point).expect("the point is in the domain");
        let id = mesh.tree().leaves()[slot];
        let (centre, widths) = (mesh.centre(id, i, j), mesh.widths(id.level));
        assert!(i < N && j < N);
        for axis in 0..2 {
            let off = (point[axis] - centre[axis]).abs() / widths[axis];
            assert!(off <= 0.5 + 1e-9, "{point:?} is {off} cells from its cell's centre");
        }
        let low = [domain.z[0], domain.r[0]];
        let place = [0, 1].map(|axis| {
            let at = ((point[axis] - low[axis]) / (N as f64 * finest[axis])).floor() as i64;
            at.min(map.extent[axis] - 1)
        });
        assert_eq!(map.at(place), Some(slot));
    }
    assert_eq!(mesh.locate([domain.z[0] - 1e-9, domain.r[0]]), None);
    assert_eq!(mesh.locate([domain.z[0], domain.r[1] + 1e-9]), None);
}

fn check_sides(mesh: &Mesh<N>, map: &Map, periodic: [bool; 2]) {
    for side in Side::ALL {
        let (across, along) = if matches!(side, Side::ZMin | Side::ZMax) { (0, 1) } else { (1, 0) };
        let mut reached = 0;
        for slot in mesh.blocks_along(side) {
            let (low, size) = square(mesh, mesh.tree().leaves()[slot]);
            assert_eq!(low[along], reached, "the blocks along a side follow each other");
            reached += size;
            let upper = matches!(side, Side::ZMax | Side::RMax);
            assert_eq!(
                low[across] + if upper { size } else { 0 },
                if upper { map.extent[across] } else { 0 }
            );
        }
        assert_eq!(reached, if periodic[across] { 0 } else { map.extent[along] });
    }
}

fn check_volume(mesh: &Mesh<N>) {
    let total: f64 = (mesh.tree().leaves().iter())
        .map(|id| (0..N).map(|j| N as f64 * mesh.volume(*id, j)).sum::<f64>())
        .sum();
    let Domain { z, r, .. } = *mesh.domain();
    let exact = (z[1] - z[0]) * (r[1] - r[0]) * mesh.weight(0.5 * (r[0] + r[1]));
    assert!((total / exact - 1.0).abs() < 1e-13);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..Default::default() })]

    /// Catches gaps, overlaps, jumps of two levels (over corners and through periodic sides too), wrong slots.
    #[test]
    fn random_adaptations_keep_the_tree_whole_and_graded(plan in plans(4)) {
        let mut random = Random(plan.seed);
        let mut mesh = plan.mesh();
        for _ in 0..8 {
            let generation = mesh.generation();
            let Some(next) = adapt_at_random(&mesh, &mut random) else { continue };
            assert_eq!(next.generation(), generation + 1);
            mesh = next;
            let map = Map::paint(&mesh, plan.periodic);
            check_order(&mesh);
            check_neighbours(&mesh, &map);
            check_points(&mesh, &map, &mut random);
            check_sides(&mesh, &map, plan.periodic);
            check_volume(&mesh);
        }
    }
}
