//! From details to the next mesh: which blocks to keep, refine and coarsen.

use rayon::prelude::*;

use crate::multiresolution::Multiresolution;
use crate::multiresolution::adaptation::{LevelBound, Zone};
use crate::{
    Adaptation, BlockId, Domain, Field, Mesh, Neighbour, Offset, Padded, Patch, Quadtree, ScratchPool, Side,
};

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

/// A field whose details say which blocks are wanted.
pub(crate) struct Marked<'a, const N: usize, R> {
    pub mesh: &'a Mesh<N>,
    pub field: &'a Field,
    pub rule: &'a R,
    pub adaptation: &'a Adaptation,
}

/// The levels that the details of a field ask for, leaf by leaf: each at most one from the present one, neighbours
/// at most one from each other, within the bounds.
///
/// - `travel`: how many of its cells a wave in the block of a slot crosses before the next adaptation.
/// - `at_least`: the level that something else demands of a block, 0 if nothing does; it may lie above what details may ask for.
pub(crate) fn wanted_levels<const N: usize, R: Multiresolution>(
    marked: &Marked<'_, N, R>,
    scratch: &ScratchPool<Patch<N>>,
    travel: impl Fn(usize) -> f64 + Sync,
    at_least: impl Fn(usize) -> u8 + Sync,
) -> Vec<u8> {
    let Marked { mesh, adaptation, .. } = *marked;
    let tree = mesh.tree();
    let mut extents = significant_extents(marked, scratch);
    for (first, kept) in refined_again(marked, &extents) {
        for (extents, kept) in extents[first..].iter_mut().zip(kept) {
            extents[0] = kept;
        }
    }

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
    reach_neighbours(mesh, &extents, travel, &mut wanted);
    let base = adaptation.base(tree.finest());
    for (slot, (level, id)) in wanted.iter_mut().zip(tree.leaves()).enumerate() {
        let (low, high) = bounds(mesh, *id, &adaptation.bounds);
        let high = high.min(base.max(at_least(slot)));
        *level = (*level).clamp(low, high.max(low)).clamp(id.level.saturating_sub(1), id.level + 1);
        *level = (*level).clamp(tree.root_level(), tree.finest());
    }
    grade(tree, &mut wanted);
    wanted
}

/// Where in each block the details are above the threshold, and where they foretell such ones on the next level.
fn significant_extents<const N: usize, R: Multiresolution>(
    &Marked { mesh, field, rule, adaptation }: &Marked<'_, N, R>,
    scratch: &ScratchPool<Patch<N>>,
) -> Vec<[Extent; 2]> {
    let tree = mesh.tree();
    (0..mesh.blocks())
        .into_par_iter()
        .with_min_len(4)
        .map(|slot| {
            let level = tree.leaves()[slot].level;
            let threshold = threshold(tree, adaptation, level);
            let (mut keep, mut refine) = (Extent::NONE, Extent::NONE);
            scratch.with(|patch| {
                patch.fill(mesh, field, slot, rule);
                let [along_z, along_r] = counting_cells(mesh, tree.leaves()[slot], rule);
                let own = |component, j| &field.component(slot, component)[j * N..];
                let directed = directed(mesh, tree.leaves()[slot], rule, adaptation);
                let rule = directed.as_ref().unwrap_or(rule);
                patch.details(own, rule, threshold, |i, j, [size, everywhere]| {
                    let counts = along_z.contains(&i) && along_r.contains(&j);
                    let size = if counts { size } else { everywhere };
                    if size > threshold {
                        keep.add(i, j);
                    }
                    if size > REFINE * threshold {
                        refine.add(i, j);
                    }
                });
            });
            [keep, refine]
        })
        .collect()
}

/// The rule for the details of a block of which only waves towards the region of interest matter; `None` where all do.
fn directed<const N: usize, R: Multiresolution>(
    mesh: &Mesh<N>,
    id: BlockId,
    rule: &R,
    adaptation: &Adaptation,
) -> Option<R> {
    let [low, high] = corners(mesh, id);
    rule.towards(adaptation.interest?.direction_from(low, high)?)
}

/// Asks for the levels of blocks that significant details can reach before the next adaptation.
fn reach_neighbours<const N: usize>(
    mesh: &Mesh<N>,
    extents: &[[Extent; 2]],
    travel: impl Fn(usize) -> f64,
    wanted: &mut [u8],
) {
    let tree = mesh.tree();
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
}

/// Details nearer to an open side than this share of the domain's extent do not count, but for what does everywhere: the
/// boundary is not exact, and at its corners with other sides singular, which no refinement cures. Half and twice of it:
/// `docs/verification/constants.md`.
const OPEN_SHARE: f64 = 1.0 / 32.0;

/// The cells of a block, by number along z and along r, that are near no open side.
fn counting_cells<const N: usize>(
    mesh: &Mesh<N>,
    id: BlockId,
    rule: &impl Multiresolution,
) -> [std::ops::Range<usize>; 2] {
    let Domain { z, r, .. } = *mesh.domain();
    let (origin, widths) = (mesh.origin(id), mesh.widths(id.level));
    let along = |axis: usize, [begin, end]: [f64; 2], sides: [Side; 2]| {
        let margin = OPEN_SHARE * (end - begin);
        let cells = |distance: f64| ((distance / widths[axis]).ceil().max(0.0) as usize).min(N);
        let [low, high] = sides.map(|side| if rule.counts_beside(side) { 0.0 } else { margin });
        let last = origin[axis] + N as f64 * widths[axis];
        let first = if low > 0.0 { cells(begin + low - origin[axis]) } else { 0 };
        let rest = if high > 0.0 { cells(last - (end - high)) } else { 0 };
        first..N - rest
    };
    [along(0, z, [Side::ZMin, Side::ZMax]), along(1, r, [Side::RMin, Side::RMax])]
}

/// The threshold of the details on a level: it does not depend on how far above L blocks may rise.
fn threshold(tree: &Quadtree, adaptation: &Adaptation, level: u8) -> f64 {
    threshold_on(level, adaptation.base(tree.finest()), adaptation.epsilon)
}

/// The same for `epsilon` on the level `base`.
pub(super) fn threshold_on(level: u8, base: u8, epsilon: f64) -> f64 {
    epsilon * f64::powi(2.0, i32::from(level) - i32::from(base))
}

/// The groups of siblings without significant details of their own whose parent would be refined at once: the slot
/// of the first, and the cells of each that must be kept for it. Fresh children have only predicted values, hence no
/// details; without this they would come and go with every adaptation.
fn refined_again<const N: usize, R: Multiresolution>(
    &Marked { mesh, field, rule, adaptation }: &Marked<'_, N, R>,
    extents: &[[Extent; 2]],
) -> Vec<(usize, [Extent; 4])> {
    let tree = mesh.tree();
    let is_quiet = |slot: usize| extents[slot][0].is_none();
    let firsts: Vec<usize> = (0..mesh.blocks())
        .filter(|slot| {
            let id = tree.leaves()[*slot];
            id.level > tree.root_level() && id.i.is_multiple_of(2) && id.j.is_multiple_of(2)
        })
        .filter(|first| are_siblings(tree, *first) && (*first..first + 4).all(is_quiet))
        .collect();
    let components = field.components();
    let scratch = || (Patch::zeros(components), Patch::zeros(components), Padded::zeros(components));
    let look = |(patch, child, around): &mut (Patch<N>, Patch<N>, Padded<N>), first: &usize| {
        let first = *first;
        patch.fill_parent(mesh, field, first, rule, child, around);
        let least = REFINE * threshold(tree, adaptation, tree.leaves()[first].level - 1);
        let mut kept = [Extent::NONE; 4];
        let id = tree.leaves()[first];
        let parent = BlockId { level: id.level - 1, i: id.i / 2, j: id.j / 2 };
        let [along_z, along_r] = counting_cells(mesh, parent, rule);
        let own = |component, j| &around.component(component)[Padded::<N>::index(0, j as isize)..];
        let directed = directed(mesh, parent, rule, adaptation);
        let rule = directed.as_ref().unwrap_or(rule);
        patch.details(own, rule, least, |i, j, [_, everywhere]| {
            if everywhere > least || along_z.contains(&i) && along_r.contains(&j) {
                let (a, b) = (i / (N / 2), j / (N / 2));
                let (i, j) = (2 * (i % (N / 2)), 2 * (j % (N / 2)));
                kept[a + 2 * b].add(i, j);
                kept[a + 2 * b].add(i + 1, j + 1);
            }
        });
        (first, kept)
    };
    (firsts.par_iter().with_min_len(4).map_init(scratch, look))
        .filter(|(_, kept)| kept.iter().any(|extent| !extent.is_none()))
        .collect()
}

/// Whether the leaf in a slot and the three after it are the children of one block.
fn are_siblings(tree: &Quadtree, first: usize) -> bool {
    let id = tree.leaves()[first];
    (0..4).all(|child| {
        let sibling = BlockId { i: id.i + (child as u32 & 1), j: id.j + (child as u32 >> 1), ..id };
        tree.leaves().get(first + child) == Some(&sibling)
    })
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
fn grade(tree: &Quadtree, wanted: &mut [u8]) {
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
    let position = ((id.i & 1) + 2 * (id.j & 1)) as usize;
    let Some(first) = slot.checked_sub(position) else { return false };
    let parity = |id: BlockId| (id.i & 1, id.j & 1);
    parity(tree.leaves()[first]) == (0, 0)
        && are_siblings(tree, first)
        && (first..first + 4).all(|at| wanted[at] < id.level)
}

/// The level bounds of a block. A block is bounded from above where one of the admitted level around it is: else that
/// one could not be refined, but its children need not be coarsened.
pub(crate) fn bounds<const N: usize>(mesh: &Mesh<N>, id: BlockId, bounds: &[LevelBound]) -> (u8, u8) {
    let mut range = (0, u8::MAX);
    for bound in bounds {
        let meets_it = meets(mesh, id, &bound.zone);
        let steps = id.level.saturating_sub(bound.at_most.max(mesh.tree().root_level()));
        let admitted = BlockId { level: id.level - steps, i: id.i >> steps, j: id.j >> steps };
        if meets_it {
            range.0 = range.0.max(bound.at_least);
        }
        if meets_it || meets(mesh, admitted, &bound.zone) {
            range.1 = range.1.min(bound.at_most);
        }
    }
    range
}

/// Whether a block has points in a zone, see [`Zone::meets`].
fn meets<const N: usize>(mesh: &Mesh<N>, id: BlockId, zone: &Zone) -> bool {
    let [low, high] = corners(mesh, id);
    zone.meets(low, high, mesh.widths(id.level), mesh.domain())
}

/// The corners (z, r) of a block, m.
pub(super) fn corners<const N: usize>(mesh: &Mesh<N>, id: BlockId) -> [[f64; 2]; 2] {
    let (low, widths) = (mesh.origin(id), mesh.widths(id.level));
    [low, [low[0] + N as f64 * widths[0], low[1] + N as f64 * widths[1]]]
}
