//! From details to the next mesh: which blocks to keep, refine and coarsen.

use rayon::prelude::*;

use crate::adaptation::{LevelBound, Zone};
use crate::multiresolution::Multiresolution;
use crate::{Adaptation, BlockId, Domain, Field, Mesh, Neighbour, Offset, Patch, Quadtree, ScratchPool};

/// A detail this many times its threshold will have significant details on the next level: a third-order detail of a
/// smooth field falls by 2³ there and the threshold by 2 (Harten's criterion).
const REFINE: f64 = 16.0;

/// The cells of a block that exceed a threshold: the smallest rectangle around them.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Extent {
    low: [usize; 2],
    high: [usize; 2],
}

impl Extent {
    const NONE: Self = Self { low: [usize::MAX; 2], high: [0; 2] };

    fn is_none(&self) -> bool {
        self.low[0] == usize::MAX
    }

    fn add(&mut self, i: usize, j: usize) {
        self.low = [self.low[0].min(i), self.low[1].min(j)];
        self.high = [self.high[0].max(i), self.high[1].max(j)];
    }

    /// Whether something in it that moves by `distance` cells reaches the block beyond `offset`.
    fn reaches(&self, offset: Offset, distance: f64, n: usize) -> bool {
        let reaches = |axis: usize, step: i8| match step {
            -1 => (self.low[axis] as f64) < distance,
            0 => true,
            _ => ((n - 1 - self.high[axis]) as f64) < distance,
        };
        !self.is_none() && reaches(0, offset.i) && reaches(1, offset.j)
    }
}

/// The levels that the details of a field ask for, leaf by leaf: each at most one from the present one, neighbours
/// at most one from each other, within the bounds.
///
/// - `travel`: how many of its cells a wave in the block of a slot crosses before the next adaptation.
/// - `at_least`: the level that something else demands of a block, 0 if nothing does.
pub(crate) fn wanted_levels<const N: usize, R: Multiresolution>(
    mesh: &Mesh<N>,
    field: &Field,
    rule: &R,
    adaptation: &Adaptation,
    scratch: &ScratchPool<Patch<N>>,
    travel: impl Fn(usize) -> f64 + Sync,
    at_least: impl Fn(usize) -> u8 + Sync,
) -> Vec<u8> {
    let tree = mesh.tree();
    let extents: Vec<[Extent; 2]> = (0..mesh.blocks())
        .into_par_iter()
        .with_min_len(4)
        .map(|slot| {
            let level = tree.leaves()[slot].level;
            let threshold = adaptation.epsilon / f64::from(1u32 << (tree.finest() - level));
            let (mut keep, mut refine) = (Extent::NONE, Extent::NONE);
            scratch.with(|patch| {
                patch.fill(mesh, field, slot, rule);
                patch.details(field.block(slot), rule, |i, j, size| {
                    if size > threshold {
                        keep.add(i, j);
                        if size > REFINE * threshold {
                            refine.add(i, j);
                        }
                    }
                });
            });
            [keep, refine]
        })
        .collect();

    let mut wanted: Vec<u8> = (0..mesh.blocks())
        .map(|slot| {
            let [keep, refine] = &extents[slot];
            let level = tree.leaves()[slot].level;
            let own = if !refine.is_none() {
                level + 1
            } else if !keep.is_none() {
                level
            } else {
                level.saturating_sub(1)
            };
            own.max(at_least(slot))
        })
        .collect();
    for slot in 0..mesh.blocks() {
        let [keep, refine] = &extents[slot];
        if keep.is_none() {
            continue;
        }
        let (level, distance) = (tree.leaves()[slot].level, travel(slot));
        for (offset, neighbour) in Offset::ALL.iter().zip(tree.neighbours(slot)) {
            let needed = if refine.reaches(*offset, distance, N) {
                level + 1
            } else if keep.reaches(*offset, distance, N) {
                level
            } else {
                continue;
            };
            for other in slots(neighbour) {
                wanted[other] = wanted[other].max(needed);
            }
        }
    }
    for (level, id) in wanted.iter_mut().zip(tree.leaves()) {
        let (low, high) = bounds(mesh, *id, &adaptation.bounds);
        *level = (*level).clamp(low, high.max(low)).clamp(id.level.saturating_sub(1), id.level + 1);
        *level = (*level).clamp(tree.root_level(), tree.finest());
    }
    settle(tree, &mut wanted);
    wanted
}

/// The blocks that a neighbour consists of.
fn slots(neighbour: &Neighbour) -> impl Iterator<Item = usize> {
    let (first, second) = match neighbour {
        Neighbour::Boundary => (None, None),
        Neighbour::Same(slot) | Neighbour::Coarser(slot) => (Some(*slot), None),
        Neighbour::Finer([a, b]) => (Some(*a), (a != b).then_some(*b)),
    };
    first.into_iter().chain(second)
}

/// Raises levels until neighbours are one apart at most and only whole groups of siblings are coarsened.
fn settle(tree: &Quadtree, wanted: &mut [u8]) {
    let leaves = tree.leaves();
    loop {
        let mut changed = false;
        for slot in 0..leaves.len() {
            if wanted[slot] < leaves[slot].level && !siblings_agree(tree, wanted, slot) {
                wanted[slot] = leaves[slot].level;
                changed = true;
            }
            let needed = (tree.neighbours(slot).iter().flat_map(slots))
                .map(|other| wanted[other].saturating_sub(1))
                .fold(0, u8::max);
            if needed > wanted[slot] {
                wanted[slot] = needed;
                changed = true;
            }
        }
        if !changed {
            return;
        }
    }
}

/// Whether the four children of a leaf's parent are all leaves that want to be coarser.
fn siblings_agree(tree: &Quadtree, wanted: &[u8], slot: usize) -> bool {
    let id = tree.leaves()[slot];
    let first = BlockId { i: id.i & !1, j: id.j & !1, ..id };
    let position = ((id.i & 1) + 2 * (id.j & 1)) as usize;
    let Some(start) = slot.checked_sub(position) else { return false };
    (0..4).all(|child| {
        let at = start + child;
        let expected = BlockId { i: first.i + (child as u32 & 1), j: first.j + (child as u32 >> 1), ..id };
        tree.leaves().get(at) == Some(&expected) && wanted[at] < id.level
    })
}

/// The level bounds of a block.
fn bounds<const N: usize>(mesh: &Mesh<N>, id: BlockId, bounds: &[LevelBound]) -> (u8, u8) {
    let mut range = (0, u8::MAX);
    for bound in bounds.iter().filter(|bound| meets(mesh, id, &bound.zone)) {
        range = (range.0.max(bound.at_least), range.1.min(bound.at_most));
    }
    range
}

/// Whether a block has points in a zone; for zones that bound from above that is what keeps them whole.
fn meets<const N: usize>(mesh: &Mesh<N>, id: BlockId, zone: &Zone) -> bool {
    let (low, widths) = (mesh.origin(id), mesh.widths(id.level));
    let high = [low[0] + N as f64 * widths[0], low[1] + N as f64 * widths[1]];
    match zone {
        Zone::Within { centre, radius } => {
            let nearest = [0, 1].map(|axis| centre[axis].clamp(low[axis], high[axis]) - centre[axis]);
            nearest[0].hypot(nearest[1]) < *radius
        }
        // A block is beyond the circle when all of it is: else the circle's rim could never be refined.
        Zone::Beyond { centre, radius } => {
            let nearest = [0, 1].map(|axis| centre[axis].clamp(low[axis], high[axis]) - centre[axis]);
            nearest[0].hypot(nearest[1]) >= *radius
        }
        Zone::Box { z, r } => z[0] < high[0] && z[1] > low[0] && r[0] < high[1] && r[1] > low[1],
        Zone::Along(side) => {
            let Domain { z, r, .. } = mesh.domain();
            let at = |a: f64, b: f64, h: f64| (a - b).abs() < 0.5 * h;
            match side {
                crate::Side::ZMin => at(low[0], z[0], widths[0]),
                crate::Side::ZMax => at(high[0], z[1], widths[0]),
                crate::Side::RMin => at(low[1], r[0], widths[1]),
                crate::Side::RMax => at(high[1], r[1], widths[1]),
            }
        }
    }
}
