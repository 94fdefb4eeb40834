//! The step from one mesh to the next (regridding): new leaves, and fields carried over by prolongation and restriction.

use rayon::prelude::*;

use crate::ghosts::mean_of_cells;
use crate::multiresolution::marks::{Marked, wanted_levels};
use crate::multiresolution::patch::{continue_beyond, odd_components, predict};
use crate::multiresolution::{MOST_IN_FIELD, Multiresolution};
use crate::{Adaptation, BlockId, Field, Frame, GHOSTS, Mesh, Padded, Patch, ScratchPool};

/// Where the values of a new block come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The same block of the old mesh.
    Same(usize),
    /// The old block in that slot was refined; this is its child of that number (z first).
    ChildOf(usize, usize),
    /// Four old blocks from that slot on were coarsened into this one.
    ParentOf(usize),
}

/// A mesh that follows from another by refining and coarsening, and where its blocks come from.
#[derive(Clone, Debug)]
pub struct Adapted<const N: usize> {
    /// The new mesh.
    pub mesh: Mesh<N>,
    /// The origin of each of its blocks.
    pub origins: Vec<Origin>,
}

impl<const N: usize> Mesh<N> {
    /// The mesh that the details of a field ask for; `None` if it is this one.
    ///
    /// Blocks with a detail above the threshold stay, those whose details foretell significant ones on the next
    /// level are refined, and both demands hold for every neighbour that they can reach before the next
    /// adaptation; blocks without significant details are coarsened. Neighbours differ by one level at most.
    ///
    /// - `travel`: how many of its cells a wave in the block of a slot crosses before the next adaptation.
    /// - `at_least`: the level that something else demands of a block, 0 if nothing does.
    pub fn adapted<R: Multiresolution>(
        &self,
        field: &Field,
        rule: &R,
        adaptation: &Adaptation,
        scratch: &ScratchPool<Patch<N>>,
        travel: impl Fn(usize) -> f64 + Sync,
        at_least: impl Fn(usize) -> u8 + Sync,
    ) -> Option<Adapted<N>> {
        let marked = Marked { mesh: self, field, rule, adaptation };
        let wanted = wanted_levels(&marked, scratch, travel, at_least);
        self.with_levels(&wanted)
    }

    /// The mesh whose blocks have the wanted levels, each one from the present one at most.
    pub(crate) fn with_levels(&self, wanted: &[u8]) -> Option<Adapted<N>> {
        let old = self.tree().leaves();
        if old.iter().zip(wanted).all(|(id, level)| id.level == *level) {
            return None;
        }
        let (mut leaves, mut origins) = (Vec::with_capacity(old.len()), Vec::with_capacity(old.len()));
        let mut slot = 0;
        while slot < old.len() {
            let id = old[slot];
            match wanted[slot] {
                level if level > id.level => {
                    for child in 0..4 {
                        let (a, b) = (child as u32 % 2, child as u32 / 2);
                        leaves.push(BlockId { level: id.level + 1, i: 2 * id.i + a, j: 2 * id.j + b });
                        origins.push(Origin::ChildOf(slot, child));
                    }
                }
                level if level < id.level => {
                    leaves.push(BlockId { level: id.level - 1, i: id.i / 2, j: id.j / 2 });
                    origins.push(Origin::ParentOf(slot));
                    slot += 3;
                }
                _ => {
                    leaves.push(id);
                    origins.push(Origin::Same(slot));
                }
            }
            slot += 1;
        }
        Some(Adapted { mesh: self.with_leaves(leaves), origins })
    }
}

impl<const N: usize> Adapted<N> {
    /// What was known of the old blocks, carried over to those that stayed; the others have none yet.
    pub fn carried<T: Clone + Default>(&self, old: &[T]) -> Vec<T> {
        (self.origins.iter())
            .map(|origin| match origin {
                Origin::Same(slot) => old[*slot].clone(),
                _ => T::default(),
            })
            .collect()
    }

    /// The slots of the blocks that are new.
    pub fn fresh(&self) -> impl Iterator<Item = usize> + '_ {
        (self.origins.iter().enumerate())
            .filter(|(_, origin)| !matches!(origin, Origin::Same(_)))
            .map(|(slot, _)| slot)
    }

    /// A field of the old mesh on the new one: copied, projected or predicted block by block. The volume-weighted
    /// integral of every component stays what it was.
    pub fn remap<R: Multiresolution>(
        &self,
        old_mesh: &Mesh<N>,
        field: &Field,
        rule: &R,
        scratch: &ScratchPool<Patch<N>>,
    ) -> Field {
        let mut new = Field::zeros(self.mesh.blocks(), N * N, field.components());
        Remap { adapted: self, mesh: old_mesh, field, patches: scratch }.by(rule, &mut new);
        new
    }
}

/// A field that is to be carried over from one mesh to another.
pub struct Remap<'a, const N: usize> {
    /// The other mesh, and where its blocks come from.
    pub adapted: &'a Adapted<N>,
    /// The mesh of the field.
    pub mesh: &'a Mesh<N>,
    /// The field.
    pub field: &'a Field,
    /// What threads predict with.
    pub patches: &'a ScratchPool<Patch<N>>,
}

impl<const N: usize> Remap<'_, N> {
    /// [`Adapted::remap`] into a field of as many components that is no longer needed.
    pub fn by<R: Multiresolution>(&self, rule: &R, new: &mut Field) {
        let Self { adapted: Adapted { mesh, origins }, mesh: old_mesh, field, patches } = *self;
        let components = field.components();
        new.resize(mesh.blocks());
        let padded = ScratchPool::new(|| Padded::<N>::zeros(components));
        (new.as_mut_slice().par_chunks_mut(components * N * N)).zip(origins).with_min_len(4).for_each(
            |(block, origin)| match *origin {
                Origin::Same(slot) => block.copy_from_slice(field.block(slot)),
                Origin::ParentOf(first) => project(old_mesh, field, first, block),
                Origin::ChildOf(slot, child) => padded.with(|padded| {
                    patches.with(|patch| padded.assemble(old_mesh, field, slot, rule, patch));
                    for component in 0..components {
                        let is_boundary = |side| old_mesh.touches(slot, side);
                        continue_beyond(
                            padded.component_mut(component),
                            Frame::of(N),
                            component,
                            rule,
                            is_boundary,
                        );
                    }
                    predict_child(old_mesh, slot, child, rule, padded, block);
                }),
            },
        );
    }
}

/// A parent from its four children, which are the blocks from slot `first` on.
fn project<const N: usize>(mesh: &Mesh<N>, field: &Field, first: usize, block: &mut [f64]) {
    let id = mesh.tree().leaves()[first];
    let first_row = i64::from(id.j / 2) * N as i64;
    for (component, cells) in block.chunks_exact_mut(N * N).enumerate() {
        for j in 0..N {
            let share = mesh.radial(id.level, first_row + j as i64)[0].lower_share;
            for i in 0..N {
                let child = field.component(first + i / (N / 2) + 2 * (j / (N / 2)), component);
                cells[j * N + i] = mean_of_cells::<N>(child, 2 * (i % (N / 2)), 2 * (j % (N / 2)), share);
            }
        }
    }
}

/// One child of an assembled block.
fn predict_child<const N: usize>(
    mesh: &Mesh<N>,
    slot: usize,
    child: usize,
    rule: &impl Multiresolution,
    padded: &Padded<N>,
    block: &mut [f64],
) {
    let id = mesh.tree().leaves()[slot];
    let half = N / 2;
    let (first_i, first_j) = ((child % 2) * half, (child / 2) * half);
    let mut cells = [[0.0; MOST_IN_FIELD]; 4];
    let odd = odd_components(padded.components(), rule);
    let rows = mesh.radial(id.level + 1, i64::from(id.j) * N as i64);
    for j in 0..half {
        let row = first_j + j;
        let at = |component: usize| rows[row].weights[usize::from(odd[component])];
        for i in 0..half {
            let k = Padded::<N>::index((first_i + i) as isize, row as isize);
            let (len, stride) = (Padded::<N>::LEN, N + 2 * GHOSTS);
            predict(padded.as_slice(), len, stride, k, at, rule, &mut cells);
            for component in 0..padded.components() {
                for (number, cell) in cells.iter().enumerate() {
                    let (a, b) = (number % 2, number / 2);
                    block[(component * N + 2 * j + b) * N + 2 * i + a] = cell[component];
                }
            }
        }
    }
}
