//! A tile with the ghosts that other blocks own.

use crate::ghosts::{copy_row, ghost_span};
use crate::multiresolution::project::project_finer;
use crate::{Field, Frame, Mesh, Multiresolution, Neighbour, Offset, Patch, Tile};

/// Copies the blocks of a tile into padded rows and fills the ghost cells that other blocks own: cells of the same level are
/// copied, finer ones projected, and from coarser ones predicted. Ghosts beyond the domain are set to the nearest cell of the tile,
/// so that they hold finite numbers.
///
/// - `data`: rows of `frame`, one per component of the field, of which the first `components` count; written.
/// - `rule`: what prediction must know of the fields; `patch`: scratch for it.
pub(crate) fn assemble<const N: usize>(
    (data, frame): (&mut [f64], Frame),
    components: usize,
    (mesh, field): (&Mesh<N>, &Field),
    tile: Tile,
    rule: &impl Multiresolution,
    patch: &mut Patch<N>,
) {
    let len = frame.len();
    let counted = components * len;
    for (number, slot) in tile.slots().enumerate() {
        copy_block::<N>(&mut data[..counted], frame.part(N, tile.place(number)), field.block(slot));
    }
    let mut has_coarser = false;
    for (number, offset, neighbour) in mesh.around(tile) {
        let at = frame.part(N, tile.place(number));
        match neighbour {
            Neighbour::Same(other) => {
                copy_ghosts::<N>(&mut data[..counted], at, field.block(other), offset);
            }
            Neighbour::Finer(children) => {
                let id = mesh.tree().leaves()[tile.first() + number];
                project_finer(data, at, field, children, offset, mesh, id);
            }
            Neighbour::Boundary => {
                data[..counted].chunks_exact_mut(len).for_each(|row| hold(row, at, offset));
            }
            Neighbour::Coarser(_) => has_coarser = true,
        }
    }
    if has_coarser {
        for (number, slot) in tile.slots().enumerate() {
            let at = frame.part(N, tile.place(number));
            let is_asked = |offset| tile.is_outward(number, offset);
            patch.predict_beside_coarser(mesh, field, slot, rule, (data, at), is_asked);
        }
    }
}

/// Copies the cells of a block.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
fn copy_block<const N: usize>(data: &mut [f64], at: Frame, own: &[f64]) {
    for (row, own) in data.chunks_exact_mut(at.len()).zip(own.chunks_exact(N * N)) {
        let rows = row[at.index(0, 0)..].chunks_mut(at.stride());
        for (row, own) in rows.zip(own.chunks_exact(N)) {
            copy_row::<N>(row, 0, own, 0);
        }
    }
}

/// Copies the ghosts in one direction from the block of the same level that owns them.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
fn copy_ghosts<const N: usize>(data: &mut [f64], at: Frame, owner: &[f64], offset: Offset) {
    let (span_i, span_j) = (ghost_span(N, offset.i), ghost_span(N, offset.j));
    let n = N as isize;
    let first_i = (span_i.start - isize::from(offset.i) * n) as usize;
    let first_j = (span_j.start - isize::from(offset.j) * n) as usize;
    let (to, from) = (at.index(span_i.start, span_j.start), first_j * N + first_i);
    for (row, owner) in data.chunks_exact_mut(at.len()).zip(owner.chunks_exact(N * N)) {
        let rows = row[to..].chunks_mut(at.stride()).zip(owner[from..].chunks(N)).take(span_j.len());
        // Of known length: a call that copies two numbers costs more than they do.
        if offset.i == 0 {
            rows.for_each(|(row, owner)| copy_row::<N>(row, 0, owner, 0));
        } else {
            rows.for_each(|(row, owner)| copy_row::<{ crate::GHOSTS }>(row, 0, owner, 0));
        }
    }
}

/// Sets the ghosts in one direction to the nearest cell of the block.
fn hold(row: &mut [f64], at: Frame, offset: Offset) {
    let last = at.cells() as isize - 1;
    for j in ghost_span(at.cells(), offset.j) {
        for i in ghost_span(at.cells(), offset.i) {
            row[at.index(i, j)] = row[at.index(i.clamp(0, last), j.clamp(0, last))];
        }
    }
}
