//! The levels that details ask for: reach, bounds, coarsening, and coming to rest.

use mesh::{
    Adaptation, BlockId, ComponentsOfCell, Domain, Field, Geometry, LevelBound, MOST_COMPONENTS, Mesh,
    Multiresolution, Patch, RegionOfInterest, ScratchPool, Side, Zone,
};
use proptest::prelude::*;

use crate::common::*;

/// The level of the coarsest and the finest leaf over a block of an older mesh.
fn levels_over(mesh: &Mesh<N>, map: &Map, old: &Mesh<N>, slot: usize) -> [u8; 2] {
    let ([x, y], size) = square(old, old.tree().leaves()[slot]);
    let mut range = [u8::MAX, 0];
    for b in y..y + size {
        for a in x..x + size {
            let level = mesh.tree().leaves()[map.at([a, b]).unwrap()].level;
            range = [range[0].min(level), range[1].max(level)];
        }
    }
    range
}

/// Whether a cell of a block that moves by `distance` cells gets into another block, by their places alone.
fn gets_into(
    mesh: &Mesh<N>,
    from: usize,
    cell: [usize; 2],
    distance: f64,
    to: usize,
    images: [i64; 2],
) -> bool {
    let [(low, size), (other, other_size)] = [from, to].map(|slot| square(mesh, mesh.tree().leaves()[slot]));
    let h = size as f64 / N as f64;
    (0..2).all(|axis| {
        let start = low[axis] as f64 + (cell[axis] as f64 - distance) * h;
        let end = low[axis] as f64 + (cell[axis] as f64 + 1.0 + distance) * h;
        (-1..=1).any(|image| {
            let at = (other[axis] + image * images[axis]) as f64;
            start < at + other_size as f64 && end > at
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..Default::default() })]

    /// One cell whose detail foretells finer ones: the blocks it reaches are refined, and no others.
    #[test]
    fn one_cell_refines_the_blocks_it_reaches(
        cell in (0..N, 0..N), block in (0usize..4, 0usize..4), distance in 0.0..8.0, periodic: bool,
    ) {
        let domain = Domain { geometry: Geometry::Planar, z: [0.0, 1.0], r: [0.0, 1.0] };
        let mesh = Mesh::<N>::on_level(domain, [N, N], 2, 4, [periodic; 2]).unwrap();
        let origin = [block.0 as f64 * 0.25 + 0.1, block.1 as f64 * 0.25 + 0.1];
        let (from, ..) = mesh.locate(origin).unwrap();
        let mut field = Field::zeros(mesh.blocks(), N * N, 1);
        field.block_mut(from)[cell.1 * N + cell.0] = 17.0 * threshold(&mesh, 2);
        let scratch = ScratchPool::new(|| Patch::zeros(1));
        let adapted = mesh.adapted(&field, &TOLD, &EVERYWHERE, &scratch, |_| distance, |_| 0).unwrap().mesh;
        let map = Map::paint(&adapted, [periodic; 2]);
        let images = if periodic { map.extent } else { [0; 2] };
        for slot in 0..mesh.blocks() {
            let reached = gets_into(&mesh, from, [cell.0, cell.1], distance, slot, images);
            let [coarsest, finest] = levels_over(&adapted, &map, &mesh, slot);
            if reached {
                assert_eq!([coarsest, finest], [3, 3], "reached");
            } else {
                assert!(finest <= 2, "not reached, but refined");
            }
        }
    }

    /// One cell that wants its level kept, in a random tree held as it is: neighbours in reach get that level.
    #[test]
    fn one_cell_keeps_its_level_around_it(plan in plans(4), cell in (0..N, 0..N), distance in 0.0..8.0) {
        let mut random = Random(plan.seed);
        let mesh = plan.grown(&mut random);
        let from = random.below(mesh.blocks());
        let level = mesh.tree().leaves()[from].level;
        let mut field = Field::zeros(mesh.blocks(), N * N, 1);
        field.block_mut(from)[cell.1 * N + cell.0] = 2.0 * threshold(&mesh, level);
        let scratch = ScratchPool::new(|| Patch::zeros(1));
        let present = |slot: usize| mesh.tree().leaves()[slot].level;
        let adapted = mesh.adapted(&field, &TOLD, &EVERYWHERE, &scratch, |_| distance, present);
        let adapted = adapted.map_or_else(|| mesh.clone(), |adapted| adapted.mesh);
        let (before, map) = (Map::paint(&mesh, plan.periodic), Map::paint(&adapted, plan.periodic));
        let images = [0, 1].map(|axis| if plan.periodic[axis] { map.extent[axis] } else { 0 });
        let mut touching: Vec<usize> = (-1..=1)
            .flat_map(|b| (-1..=1).map(move |a| [a, b]))
            .flat_map(|offset| before.beyond(&mesh, from, offset))
            .collect();
        touching.sort_unstable();
        touching.dedup();
        let mut raised = false;
        for slot in touching {
            let reached = gets_into(&mesh, from, [cell.0, cell.1], distance, slot, images);
            let [coarsest, _] = levels_over(&adapted, &map, &mesh, slot);
            assert!(!reached || coarsest >= level, "reached, but coarser");
            raised |= reached && present(slot) < level;
        }
        assert!(raised || adapted.generation() == mesh.generation(), "nothing to refine");
    }
}

/// Adapts a field that says of each block whether it is significant until nothing changes; returns the meshes.
fn settled(mut mesh: Mesh<N>, adaptation: &Adaptation, sizes: impl Fn(&Mesh<N>, usize) -> f64) -> Mesh<N> {
    let scratch = ScratchPool::new(|| Patch::zeros(1));
    for _ in 0..mesh.tree().finest() + 3 {
        let mut field = Field::zeros(mesh.blocks(), N * N, 1);
        for slot in 0..mesh.blocks() {
            field.block_mut(slot).fill(sizes(&mesh, slot));
        }
        match mesh.adapted(&field, &TOLD, adaptation, &scratch, |_| 0.0, |_| 0) {
            Some(adapted) => mesh = adapted.mesh,
            None => return mesh,
        }
    }
    panic!("the mesh does not come to rest");
}

#[test]
fn without_significant_details_the_roots_remain() {
    proptest!(ProptestConfig { failure_persistence: None, ..Default::default() }, |(plan in plans(4))| {
        let mesh = plan.grown(&mut Random(plan.seed));
        let root_level = mesh.tree().root_level();
        let [across, up] = mesh.tree().blocks_on(root_level);
        let rest = settled(mesh, &EVERYWHERE, |_, _| 0.0);
        assert_eq!(rest.blocks(), (across * up) as usize);
    });
}

/// The zones of a unit square, each with the question whether a rectangle meets it.
fn zones() -> Vec<(Zone, fn([f64; 2], [f64; 2]) -> bool)> {
    fn distance(low: [f64; 2], high: [f64; 2]) -> f64 {
        let gap = |axis: usize, c: f64| (low[axis] - c).max(c - high[axis]).max(0.0);
        gap(0, 0.3).hypot(gap(1, 0.6))
    }
    let centre = [0.3, 0.6];
    vec![
        (Zone::Within { centre, radius: 0.15 }, |low, high| distance(low, high) < 0.15),
        (Zone::Beyond { centre, radius: 0.15 }, |low, high| distance(low, high) >= 0.15),
        (Zone::Box { z: [0.3, 0.45], r: [0.2, 0.26] }, |low, high| {
            low[0] < 0.45 && high[0] > 0.3 && low[1] < 0.26 && high[1] > 0.2
        }),
        (Zone::Along(Side::ZMin), |low, _| low[0] == 0.0),
        (Zone::Along(Side::ZMax), |_, high| high[0] == 1.0),
        (Zone::Along(Side::RMin), |low, _| low[1] == 0.0),
        (Zone::Along(Side::RMax), |_, high| high[1] == 1.0),
    ]
}

/// Lower and upper corner of a block.
fn corners(mesh: &Mesh<N>, slot: usize) -> [[f64; 2]; 2] {
    let id = mesh.tree().leaves()[slot];
    let (low, widths) = (mesh.origin(id), mesh.widths(id.level));
    [low, [0, 1].map(|axis| low[axis] + N as f64 * widths[axis])]
}

fn square_domain() -> Domain {
    Domain { geometry: Geometry::Planar, z: [0.0, 1.0], r: [0.0, 1.0] }
}

#[test]
fn blocks_in_a_zone_are_as_fine_as_demanded() {
    for start in [0, 2, 5] {
        for (zone, meets) in zones() {
            let bound = LevelBound { zone, at_least: 4, at_most: 5 };
            let adaptation = Adaptation { bounds: vec![bound], ..EVERYWHERE };
            let mesh = Mesh::<N>::on_level(square_domain(), [N, N], start, 5, [false; 2]).unwrap();
            let rest = settled(mesh, &adaptation, |_, _| 0.0);
            let mut coarse = 0;
            for slot in 0..rest.blocks() {
                let level = rest.tree().leaves()[slot].level;
                let [low, high] = corners(&rest, slot);
                assert!(level >= 4 || !meets(low, high), "{zone:?}: a block of level {level}");
                coarse += usize::from(level < 4);
            }
            assert!(rest.tree().leaves().iter().all(|id| id.level <= 4), "{zone:?}: finer than demanded");
            assert!(coarse > 0, "{zone:?}: coarse elsewhere");
        }
    }
}

#[test]
fn blocks_in_a_zone_are_no_finer_than_admitted() {
    const MOST: u8 = 2;
    for (zone, meets) in zones() {
        let bound = LevelBound { zone, at_least: 0, at_most: MOST };
        let adaptation = Adaptation { bounds: vec![bound], ..EVERYWHERE };
        let rests = [0, 1, 2, 3, 5].map(|start| {
            let mesh = Mesh::<N>::on_level(square_domain(), [N, N], start, 5, [false; 2]).unwrap();
            settled(mesh, &adaptation, |_, _| 1e6)
        });
        for rest in &rests {
            assert!(
                rest.tree().leaves() == rests[0].tree().leaves(),
                "{zone:?}: where it began does not matter"
            );
        }
        let rest = &rests[0];
        let map = Map::paint(rest, [false; 2]);
        let leaves = rest.tree().leaves();
        let is_bounded = |slot: usize| {
            let [low, high] = corners(rest, slot);
            let size = 0.5_f64.powi(i32::from(MOST));
            let above = low.map(|x| (x / size).floor() * size);
            meets(low, high) || (leaves[slot].level > MOST && meets(above, above.map(|x| x + size)))
        };
        assert!((0..rest.blocks()).any(|slot| leaves[slot].level < 5 && is_bounded(slot)));
        assert!(leaves.iter().any(|id| id.level == 5), "{zone:?}: finest elsewhere");
        for (slot, id) in leaves.iter().enumerate().filter(|(_, id)| id.level > MOST) {
            if !is_bounded(slot) {
                continue;
            }
            // Its parent was refined for something finer that touches it, or for a child that is free.
            let parent = BlockId { level: id.level - 1, i: id.i / 2, j: id.j / 2 };
            let ([x, y], size) = square(rest, parent);
            let around = (y - 1..=y + size).flat_map(|b| (x - 1..=x + size).map(move |a| [a, b]));
            let reason = around.filter_map(|place| Some((place, map.at(place)?))).any(|([a, b], other)| {
                let inside = (x..x + size).contains(&a) && (y..y + size).contains(&b);
                leaves[other].level > id.level || (inside && !is_bounded(other))
            });
            assert!(reason, "{zone:?}: {id:?} is finer than admitted");
        }
    }
}

#[test]
fn levels_above_those_of_details_are_only_for_what_demands_them() {
    // Details everywhere, one block demands two levels more.
    let settled = |above: u8, demanded: u8, value: f64| {
        let adaptation = Adaptation { above, ..EVERYWHERE };
        let mut mesh = Mesh::<N>::on_level(square_domain(), [N, N], 2, 3 + above, [false; 2]).unwrap();
        for _ in 0..8 {
            let mut field = Field::zeros(mesh.blocks(), N * N, 1);
            field.as_mut_slice().fill(value);
            let scratch = ScratchPool::new(|| Patch::zeros(1));
            let demand = |slot: usize| if corners(&mesh, slot)[0] == [0.0; 2] { demanded } else { 0 };
            let adapted = mesh.adapted(&field, &TOLD, &adaptation, &scratch, |_| 1.0, demand);
            let Some(adapted) = adapted else { return mesh };
            mesh = adapted.mesh;
        }
        panic!("it does not come to rest");
    };
    let levels = |mesh: &Mesh<N>| mesh.levels_present();
    assert_eq!(levels(&settled(2, 0, 1e6)), [3, 3], "details do not ask for them");
    assert_eq!(levels(&settled(2, 5, 1e6)), [3, 5]);
    assert_eq!(levels(&settled(2, 5, 0.0)), [1, 5], "nor are they kept by them");
    // A threshold is what it is, whatever is above.
    for value in [0.3, 0.6, 1.1, 1.9] {
        assert_eq!(settled(0, 0, value).tree().leaves(), settled(2, 0, value).tree().leaves());
    }
}

/// Details of a field as they are.
struct Plain;

impl Multiresolution for Plain {
    fn parity(&self, _: Side, _: usize) -> Option<f64> {
        None
    }

    fn share(&self, _: &[f64], _: &[[f64; MOST_COMPONENTS]; 4]) -> f64 {
        1.0
    }

    fn significance(&self, _: &ComponentsOfCell, detail: &ComponentsOfCell) -> f64 {
        detail[0].abs()
    }
}

/// Adapts to a smooth function, sampled anew or remapped, and returns whether the mesh came to rest.
fn rests(seed: u64, remapped: bool, extra: usize) -> bool {
    let mut random = Random(seed);
    let levels = 5;
    let mut mesh =
        Mesh::<N>::on_level(square_domain(), [N, N], random.below(6) as u8, levels, [false; 2]).unwrap();
    let [z, r, width] = [random.unit(), random.unit(), 0.02 + 0.2 * random.unit()];
    let epsilon = 10.0_f64.powf(-1.0 - 4.0 * random.unit());
    let adaptation = Adaptation { epsilon, ..EVERYWHERE };
    let reach = random.unit() * 6.0;
    let bell = |x: f64, y: f64| (-((x - z).powi(2) + (y - r).powi(2)) / (width * width)).exp();
    let bell = crate::exactness::average(Geometry::Planar, bell);
    let scratch = ScratchPool::new(|| Patch::zeros(1));
    let mut field = Field::zeros(mesh.blocks(), N * N, 1);
    sample(&mesh, &mut field, 0, &bell);
    for _ in 0..levels as usize + 2 + extra {
        // The same way in metres on all levels.
        let travel = |slot: usize| reach / f64::from(1 << (levels - mesh.tree().leaves()[slot].level));
        let Some(adapted) = mesh.adapted(&field, &Plain, &adaptation, &scratch, travel, |_| 0) else {
            return true;
        };
        if remapped {
            field = adapted.remap(&mesh, &field, &Plain, &scratch);
        } else {
            field = Field::zeros(adapted.mesh.blocks(), N * N, 1);
            sample(&adapted.mesh, &mut field, 0, &bell);
        }
        mesh = adapted.mesh;
    }
    false
}

#[test]
fn adaptation_to_a_smooth_function_comes_to_rest() {
    let restless =
        |remapped, extra| (0..200).filter(|seed| !rests(*seed, remapped, extra)).collect::<Vec<_>>();
    let counts = [false, true].map(|remapped| [restless(remapped, 0), restless(remapped, 20)]);
    assert!(
        counts.as_flattened().iter().all(Vec::is_empty),
        "sampled and remapped, soon and later: {counts:?}"
    );
}

/// Cells say how much they matter; those that only waves in a direction matter of do as far as it is that of rising z.
struct Directed([f64; 2]);

impl Multiresolution for Directed {
    fn parity(&self, _: Side, _: usize) -> Option<f64> {
        None
    }

    fn towards(&self, direction: [f64; 2]) -> Option<Self> {
        assert!((direction[0].hypot(direction[1]) - 1.0).abs() < 1e-12);
        Some(Self(direction))
    }

    fn share(&self, _: &[f64], _: &[[f64; MOST_COMPONENTS]; 4]) -> f64 {
        1.0
    }

    fn significance(&self, cell: &ComponentsOfCell, _: &ComponentsOfCell) -> f64 {
        cell[0].abs() * self.0[0].max(0.0)
    }
}

#[test]
fn outside_the_region_of_interest_the_direction_to_it_counts() {
    let region = RegionOfInterest { centre: [0.5, 0.25], radius: 0.1 };
    let levels_beside = |interest: Option<RegionOfInterest>| {
        let adaptation = Adaptation { interest, ..EVERYWHERE };
        let mut mesh = Mesh::<N>::on_level(square_domain(), [N, N], 4, 4, [false; 2]).unwrap();
        let scratch = ScratchPool::new(|| Patch::zeros(1));
        for _ in 0..8 {
            let mut field = Field::zeros(mesh.blocks(), N * N, 1);
            field.as_mut_slice().fill(1e6);
            let rule = Directed([1.0, 0.0]);
            match mesh.adapted(&field, &rule, &adaptation, &scratch, |_| 0.0, |_| 0) {
                Some(adapted) => mesh = adapted.mesh,
                None => break,
            }
        }
        let level_at = |point: [f64; 2]| {
            let (slot, ..) = mesh.locate(point).unwrap();
            mesh.tree().leaves()[slot].level
        };
        // Before the region, in it, behind it, and farther behind, where grading asks for nothing.
        [[0.1, 0.25], [0.5, 0.25], [0.9, 0.25], [0.9, 0.9]].map(level_at)
    };
    assert_eq!(levels_beside(None), [4; 4]);
    let [before, within, behind, far] = levels_beside(Some(region));
    assert_eq!([before, within], [4, 4]);
    assert!(behind < 4 && far <= 2, "{behind} {far}");
}

#[test]
fn blocks_see_the_middle_of_the_region() {
    let region = RegionOfInterest { centre: [1.0, 2.0], radius: 0.5 };
    assert_eq!(region.direction_from([0.0, 1.0], [2.0, 3.0]), None, "around it");
    assert_eq!(region.direction_from([1.4, 2.0], [9.0, 9.0]), None, "it meets it");
    assert_eq!(region.direction_from([4.0, 1.0], [6.0, 3.0]), Some([-1.0, 0.0]));
    let [z, r] = region.direction_from([-3.0, -2.0], [-1.0, 0.0]).unwrap();
    assert!((z - 0.5_f64.sqrt()).abs() < 1e-15 && (r - z).abs() < 1e-15);
    assert_eq!(region.distance([4.0, 1.0], [6.0, 3.0]), 3.0);
}
