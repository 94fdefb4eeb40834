//! Tiles of four blocks have the ghosts that these have one by one.

use super::*;
use crate::multiresolution::Plain;
use crate::{BlockId, Domain, Geometry, Padded, Side};

const N: usize = 8;

/// A tree with jumps of levels within, around and across tiles, on periodic and on bounded domains.
fn meshes() -> Vec<Mesh<N>> {
    let domain = Domain { geometry: Geometry::Axisymmetric, z: [0.0, 1.0], r: [0.0, 1.0] };
    [[false; 2], [true, false]]
        .into_iter()
        .map(|periodic| {
            let mesh = Mesh::<N>::on_level(domain, [32, 32], 1, 3, periodic).expect("a mesh");
            // Children of every block whose number some bits choose, and of two of these again.
            let split = |ids: Vec<BlockId>, is_split: &dyn Fn(&BlockId) -> bool| -> Vec<BlockId> {
                let children = |id: BlockId| {
                    (0..4).map(move |number| BlockId {
                        level: id.level + 1,
                        i: 2 * id.i + number % 2,
                        j: 2 * id.j + number / 2,
                    })
                };
                ids.into_iter()
                    .flat_map(|id| if is_split(&id) { children(id).collect::<Vec<_>>() } else { vec![id] })
                    .collect()
            };
            let once = split(mesh.tree().leaves().to_vec(), &|id| {
                (2..6).contains(&id.i) && (3..6).contains(&id.j) || (id.i, id.j) == (0, 0)
            });
            let twice = split(once, &|id| id.level == 2 && (6..8).contains(&id.i) && (8..10).contains(&id.j));
            mesh.with_leaves(twice)
        })
        .collect()
}

#[test]
fn a_tile_has_the_cells_and_ghosts_of_its_blocks() {
    for mesh in meshes() {
        let mut random = 1_u64;
        let mut field = Field::zeros(mesh.blocks(), N * N, 3);
        for value in field.as_mut_slice() {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            *value = 1.0 + (random >> 11) as f64 / (1_u64 << 53) as f64;
        }
        let (mut rows, mut patch) = (TileRows::<N>::zeros(3), Patch::zeros(3));
        let mut kinds = [0; 4];
        for tile in mesh.tree().tiles().iter().copied() {
            rows.assemble(3, &mesh, &field, tile, &Plain, &mut patch);
            for (number, slot) in tile.slots().enumerate() {
                let mut single = Padded::<N>::zeros(3);
                single.assemble(&mesh, &field, slot, &Plain, &mut patch);
                let at = tile.frame_of::<N>(number);
                for component in 0..3 {
                    for (i, j) in (-2..10_isize).flat_map(|j| (-2..10_isize).map(move |i| (i, j))) {
                        let (own, wanted) = (
                            rows.component(component)[at.index(i, j)],
                            single.component(component)[Padded::<N>::index(i, j)],
                        );
                        // Nobody asks for what lies beyond the domain.
                        let corner = |x: isize| (0..8).contains(&x);
                        let is_beyond = Side::ALL.into_iter().any(|side| {
                            let x = if side.axis_across() == 0 { i } else { j };
                            let is_low = matches!(side, Side::ZMin | Side::RMin);
                            mesh.touches(slot, side) && (if is_low { x < 0 } else { x > 7 })
                        });
                        assert!(is_beyond || own == wanted, "{slot} {component} {i} {j}: {own} {wanted}");
                        kinds[usize::from(!corner(i)) + 2 * usize::from(!corner(j))] += 1;
                    }
                }
            }
        }
        assert!(kinds.iter().all(|count| *count > 0));
    }
}
