//! Uniform states stay uniform to the bit; ghosts are whole and right.

use std::sync::atomic::{AtomicU64, Ordering};

use mesh::{
    ComponentsOfCell, Field, GHOSTS, MOST_COMPONENTS, Mesh, Multiresolution, Padded, Patch, ScratchPool, Side,
};
use proptest::prelude::*;

use crate::common::*;

const UNIFORM: [f64; 3] = [0.1, -1.7e9, 1.0 / 3.0];

/// Takes odd shares of what is predicted and remembers the largest detail.
struct Watch(AtomicU64);

impl Multiresolution for Watch {
    fn parity(&self, side: Side, component: usize) -> Option<f64> {
        (side as usize + component).is_multiple_of(2).then_some(1.0)
    }

    fn share(&self, _: &[f64], deviations: &[[f64; MOST_COMPONENTS]; 4]) -> f64 {
        for deviation in deviations {
            assert_eq!(deviation[..3], [0.0; 3], "a uniform field has no deviations");
        }
        0.3
    }

    fn significance(&self, _: &ComponentsOfCell, detail: &ComponentsOfCell) -> f64 {
        let largest =
            detail.iter().fold(0.0, |largest: f64, d| if d.abs() <= largest { largest } else { d.abs() });
        self.0.fetch_max(largest.to_bits(), Ordering::Relaxed);
        0.0
    }
}

fn uniform_field(blocks: usize) -> Field {
    let mut field = Field::zeros(blocks, N * N, 3);
    for slot in 0..blocks {
        for (cells, value) in field.block_mut(slot).chunks_exact_mut(N * N).zip(UNIFORM) {
            cells.fill(value);
        }
    }
    field
}

/// The cells of a block and its ghosts.
fn cells() -> impl Iterator<Item = (isize, isize)> {
    let range = || -(GHOSTS as isize)..(N + GHOSTS) as isize;
    range().flat_map(move |j| range().map(move |i| (i, j)))
}

/// Scratch in which every number is NaN that an assembly can write.
fn spoilt(mesh: &Mesh<N>, components: usize) -> (Padded<N>, Patch<N>) {
    let (mut padded, mut patch) = (Padded::zeros(components), Patch::zeros(components));
    let mut field = Field::zeros(mesh.blocks(), N * N, components);
    field.as_mut_slice().fill(f64::NAN);
    for slot in 0..mesh.blocks().min(8) {
        padded.assemble(mesh, &field, slot, &SILENT, &mut patch);
    }
    (padded, patch)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..Default::default() })]

    /// Catches means whose weights do not add up, ghosts from wrong or stale places.
    #[test]
    fn a_uniform_state_stays_so_to_the_bit(plan in plans(3)) {
        let mut random = Random(plan.seed);
        let mesh = plan.grown(&mut random);
        let field = uniform_field(mesh.blocks());
        let (mut padded, mut patch) = spoilt(&mesh, 3);
        let rule = Watch(AtomicU64::new(0));
        for slot in 0..mesh.blocks() {
            (0..3).for_each(|component| padded.component_mut(component).fill(f64::NAN));
            padded.assemble(&mesh, &field, slot, &rule, &mut patch);
            for (component, value) in UNIFORM.iter().enumerate() {
                assert!(padded.component(component).iter().all(|cell| cell == value));
            }
        }

        let scratch = ScratchPool::new(|| Patch::zeros(3));
        let wanted = random_levels(&mesh, &mut random, [0.4, 0.4]);
        let adapted = mesh.adapted(&field, &rule, &EVERYWHERE, &scratch, |_| 0.0, |slot| wanted[slot]);
        assert_eq!(f64::from_bits(rule.0.load(Ordering::Relaxed)), 0.0, "details of a uniform field");
        if let Some(adapted) = adapted {
            let new = adapted.remap(&mesh, &field, &rule, &scratch);
            assert_eq!(new, uniform_field(adapted.mesh.blocks()));
        }
    }

    /// Catches ghosts left out or taken from the wrong cells; a line is predicted and projected without error.
    #[test]
    fn ghosts_are_finite_and_follow_a_line(plan in plans(3)) {
        let mut random = Random(plan.seed);
        let mesh = plan.grown(&mut random);
        // Cell averages of r in a ring are not those of a line: along r only a plane mesh is exact.
        let slopes = [1.5, if mesh.weight(2.0) == 1.0 { -0.75 } else { 0.0 }];
        let line = |[z, r]: [f64; 2]| 0.25 + slopes[0] * z + slopes[1] * r;
        let mut field = Field::zeros(mesh.blocks(), N * N, 2);
        sample(&mesh, &mut field, 0, |centre, _| line(centre));
        sample(&mesh, &mut field, 1, |centre, _| -2.0 * line(centre));
        let domain = *mesh.domain();
        let (mut padded, mut patch) = spoilt(&mesh, 2);
        for (slot, id) in mesh.tree().leaves().iter().enumerate() {
            (0..2).for_each(|component| padded.component_mut(component).fill(f64::NAN));
            padded.assemble(&mesh, &field, slot, &SILENT, &mut patch);
            assert!((0..2).all(|component| padded.component(component).iter().all(|cell| cell.is_finite())));
            let ([z, r], [h_z, h_r]) = (mesh.centre(*id, 0, 0), mesh.widths(id.level));
            // Two layers of coarse cells are taken over or projected at the most.
            let margin = 8.0;
            let inner = |low: f64, x: f64, high: f64, h: f64, periodic: bool| {
                let margin = if periodic { margin * h } else { 0.0 };
                low + margin < x && x < high - margin
            };
            for (i, j) in cells() {
                let centre = [z + i as f64 * h_z, r + j as f64 * h_r];
                if inner(domain.z[0], centre[0], domain.z[1], h_z, plan.periodic[0])
                    && inner(domain.r[0], centre[1], domain.r[1], h_r, plan.periodic[1])
                {
                    for (component, factor) in [1.0, -2.0].iter().enumerate() {
                        let ghost = padded.component(component)[Padded::<N>::index(i, j)];
                        let off = ghost - factor * line(centre);
                        assert!(off.abs() < 1e-14, "{id:?}: ghost ({i}, {j}) is off by {off:e}");
                    }
                }
            }
        }
    }
}
