//! Times, to be looked at: `cargo test --release -p mesh --test levels speed -- --ignored --nocapture`.

use std::hint::black_box;
use std::time::Instant;

use mesh::{Adaptation, ScratchPool, Side};
use mesh::{
    ComponentsOfCell, Domain, Field, Geometry, MOST_COMPONENTS, Mesh, Multiresolution, Neighbour, Padded,
    Patch,
};

use crate::common::{EVERYWHERE, Random};

const N: usize = mesh::BLOCK;
const COMPONENTS: usize = 5;

/// Details relative to one reference value per component, everything admissible.
struct Relative;

impl Multiresolution for Relative {
    fn parity(&self, side: Side, component: usize) -> Option<f64> {
        (side == Side::RMin).then_some(if component == 1 { -1.0 } else { 1.0 })
    }

    fn share(&self, _: &[f64], _: &[[f64; MOST_COMPONENTS]; 4]) -> f64 {
        1.0
    }

    fn significance(&self, _: &ComponentsOfCell, detail: &ComponentsOfCell) -> f64 {
        detail.iter().fold(0.0, |largest: f64, d| largest.max(0.5 * d.abs()))
    }
}

/// The least time of `work` in several runs, in nanoseconds.
fn least(mut work: impl FnMut()) -> f64 {
    let run = |work: &mut dyn FnMut()| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64() * 1e9
    };
    (0..7).map(|_| run(&mut work)).fold(f64::INFINITY, f64::min)
}

fn random_field(blocks: usize) -> Field {
    let mut field = Field::zeros(blocks, N * N, COMPONENTS);
    Random(3).fill(field.as_mut_slice());
    field
}

/// One thread, so that times are of one core.
fn alone<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(work)
}

fn domain() -> Domain {
    Domain { geometry: Geometry::Axisymmetric, z: [0.0, 1.0], r: [0.0, 1.0] }
}

#[test]
#[ignore = "a measurement"]
fn time_of_an_adaptation_that_changes_nothing() {
    let mesh = Mesh::<N>::on_level(domain(), [N, N], 6, 7, [false; 2]).unwrap();
    let field = random_field(mesh.blocks());
    let adaptation = Adaptation { epsilon: 0.5, ..EVERYWHERE };
    let time = alone(|| {
        let scratch = ScratchPool::new(|| Patch::zeros(COMPONENTS));
        least(|| {
            assert!(mesh.adapted(&field, &Relative, &adaptation, &scratch, |_| 4.0, |_| 0).is_none());
        })
    });
    println!("{} leaves: {:.1} ns per cell", mesh.blocks(), time / mesh.cells() as f64);
}

#[test]
#[ignore = "a measurement"]
fn time_of_ghosts_with_and_without_a_level_jump() {
    let mesh = Mesh::<N>::on_level(domain(), [N, N], 5, 6, [false; 2]).unwrap();
    let scratch = ScratchPool::new(|| Patch::zeros(COMPONENTS));
    let zeros = Field::zeros(mesh.blocks(), N * N, COMPONENTS);
    // A quarter of the domain refined: jumps along straight lines, one coarser side per block.
    let finer = |slot: usize| {
        let id = mesh.tree().leaves()[slot];
        id.level + u8::from(id.i / 2 % 2 == 0 && id.j < 30)
    };
    let mesh = mesh.adapted(&zeros, &Relative, &EVERYWHERE, &scratch, |_| 0.0, finer).unwrap().mesh;
    let field = random_field(mesh.blocks());
    let kind = |wanted: fn(&[Neighbour; 8]) -> bool| -> Vec<usize> {
        (0..mesh.blocks()).filter(|slot| wanted(mesh.tree().neighbours(*slot))).collect()
    };

    let same = kind(|n| {
        n[..4].iter().all(|n| matches!(n, Neighbour::Same(_) | Neighbour::Boundary))
            && n[4..].iter().all(|n| !matches!(n, Neighbour::Coarser(_)))
    });
    let jump = kind(|n| n[..4].iter().filter(|n| matches!(n, Neighbour::Coarser(_))).count() == 1);
    let fine = kind(|n| n[..4].iter().any(|n| matches!(n, Neighbour::Finer(_))));
    let mut padded = Padded::<N>::zeros(COMPONENTS);
    let mut patch = Patch::zeros(COMPONENTS);
    for (name, slots) in [("one level", same), ("one side coarser", jump), ("finer sides", fine)] {
        let time = least(|| {
            for _ in 0..4 {
                for slot in &slots {
                    padded.assemble(&mesh, &field, *slot, &Relative, &mut patch);
                    black_box(padded.component(0)[0]);
                }
            }
        });
        println!("{name}: {:.0} ns per block of {} blocks", time / (4 * slots.len()) as f64, slots.len());
    }
}
