//! Remapping keeps the volume-weighted integral of every component.

use mesh::{Field, Mesh, Origin, Patch, ScratchPool};
use proptest::prelude::*;

use crate::common::*;

/// Volume-weighted sums of a component and of its absolute values.
fn sums(mesh: &Mesh<N>, field: &Field, component: usize) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for (slot, id) in mesh.tree().leaves().iter().enumerate() {
        for (j, row) in field.component(slot, component).chunks_exact(N).enumerate() {
            let volume = mesh.volume(*id, j);
            for cell in row {
                sums[0] += volume * cell;
                sums[1] += volume * cell.abs();
            }
        }
    }
    sums
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..Default::default() })]

    /// Catches weights that are not the volumes', a share applied to some children only, blocks mixed up.
    #[test]
    fn remapping_keeps_integrals(plan in plans(4), parity in prop::option::of(prop::bool::ANY), shares: bool) {
        let mut random = Random(plan.seed);
        let mut mesh = plan.mesh();
        let mut field = Field::zeros(mesh.blocks(), N * N, 3);
        random.fill(field.as_mut_slice());
        let rule = Rule { parity: parity.map(|even| if even { 1.0 } else { -1.0 }), shares, told: false };
        let scratch = ScratchPool::new(|| Patch::zeros(3));
        for _ in 0..5 {
            let wanted = random_levels(&mesh, &mut random, [0.35, 0.45]);
            let Some(adapted) = towards(&mesh, &wanted) else { continue };
            let new = adapted.remap(&mesh, &field, &rule, &scratch);
            for component in 0..3 {
                let [[before, size], [after, _]] =
                    [sums(&mesh, &field, component), sums(&adapted.mesh, &new, component)];
                assert!((after - before).abs() <= 1e-13 * size, "{before} became {after} of {size}");
            }
            // Block by block, too: what is lost here is not to be found there.
            for (slot, origin) in adapted.origins.iter().enumerate() {
                if let Origin::Same(old) = origin {
                    assert_eq!(new.block(slot), field.block(*old));
                }
            }
            (mesh, field) = (adapted.mesh, new);
        }
    }

    /// Projection undoes prediction, whatever share of it was taken.
    #[test]
    fn projection_undoes_prediction(plan in plans(3), shares: bool) {
        let mut random = Random(plan.seed);
        let mesh = plan.grown(&mut random);
        let mut field = Field::zeros(mesh.blocks(), N * N, 2);
        random.fill(field.as_mut_slice());
        let rule = Rule { shares, ..SILENT };
        let scratch = ScratchPool::new(|| Patch::zeros(2));
        let Some(finer) = towards(&mesh, &random_levels(&mesh, &mut random, [0.5, 0.0])) else { return Ok(()) };
        let predicted = finer.remap(&mesh, &field, &rule, &scratch);
        let back: Vec<u8> = (finer.origins.iter().zip(finer.mesh.tree().leaves()))
            .map(|(origin, id)| if matches!(origin, Origin::Same(_)) { id.level } else { id.level - 1 })
            .collect();
        let again = towards(&finer.mesh, &back).expect("blocks were refined");
        assert_eq!(again.mesh.tree().leaves(), mesh.tree().leaves());
        let projected = again.remap(&finer.mesh, &predicted, &rule, &scratch);
        for (cell, before) in projected.as_slice().iter().zip(field.as_slice()) {
            assert!((cell - before).abs() < 1e-15 * 8.0, "{before} became {cell}");
        }
    }
}
