//! Projection (restriction) of cells, ghosts among them, from the blocks that own them.
//!
//! A padded block takes its ghosts from finer blocks, a [`crate::Patch`] its cells from blocks of the level above its
//! own, of two levels above, or of its own. All walk rows of cells, so that the inner loops are plain ones.

use std::ops::Range;

use crate::ghosts::{copy_row, ghost_span, mean};
use crate::multiresolution::radial::RadialRow;
use crate::{BlockId, Field, Frame, GHOSTS, Mesh, Neighbour, Offset, Patch};

/// Ranges of cells along z and r.
pub(crate) type Window = [Range<isize>; 2];

/// The ghosts in one direction around n × n cells, as far as they are in a window.
pub(crate) fn ghosts_within(n: usize, offset: Offset, window: &Window) -> Window {
    let meet = |a: Range<isize>, b: &Range<isize>| a.start.max(b.start)..a.end.min(b.end);
    [meet(ghost_span(n, offset.i), &window[0]), meet(ghost_span(n, offset.j), &window[1])]
}

/// Means of 2 × 2 cells along two rows, the second `stride` after the first.
#[inline(always)]
pub(crate) fn project_rows(cells: &[f64], stride: usize, lower_share: f64, means: &mut [f64]) {
    // In lengths known to the compiler: half a block of 16, a pair of ghosts.
    let (n, mut k) = (means.len(), 0);
    while k + 8 <= n {
        project_some::<8>(&cells[2 * k..], stride, lower_share, &mut means[k..]);
        k += 8;
    }
    while k + 2 <= n {
        project_some::<2>(&cells[2 * k..], stride, lower_share, &mut means[k..]);
        k += 2;
    }
    if k < n {
        project_some::<1>(&cells[2 * k..], stride, lower_share, &mut means[k..]);
    }
}

#[inline(always)]
fn project_some<const L: usize>(cells: &[f64], stride: usize, lower_share: f64, means: &mut [f64]) {
    let ends = "rows of the block";
    let means: &mut [f64; L] = means.first_chunk_mut().expect(ends);
    let (lower, upper) = (&cells[..2 * L], &cells[stride..][..2 * L]);
    for k in 0..L {
        let (low, high) = ([lower[2 * k], lower[2 * k + 1]], [upper[2 * k], upper[2 * k + 1]]);
        means[k] = mean([low, high], lower_share);
    }
}

/// Copies a few cells: a call that copies two numbers costs more than they do.
#[inline(always)]
pub(crate) fn copy_cells(to: &mut [f64], from: &[f64]) {
    let (n, mut k) = (to.len(), 0);
    while k + 8 <= n {
        copy_row::<8>(to, k, from, k);
        k += 8;
    }
    while k + 2 <= n {
        copy_row::<2>(to, k, from, k);
        k += 2;
    }
    if k < n {
        to[k] = from[k];
    }
}

/// Fills the cells of a patch in a window, as far as they are within the domain.
///
/// - `patch`: components of (N/2 + 4)² cells; `rows`: its rows, two ghost rows first; `slot`: the patch's block.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn project_window<const N: usize>(
    patch: &mut [f64],
    rows: &[RadialRow],
    mesh: &Mesh<N>,
    field: &Field,
    slot: usize,
    window: &Window,
) {
    let id = mesh.tree().leaves()[slot];
    let len = rows.len() * rows.len();
    let own = (Offset { i: 0, j: 0 }, Neighbour::Same(slot));
    let around = Offset::ALL.into_iter().zip(*mesh.tree().neighbours(slot));
    for (offset, neighbour) in std::iter::once(own).chain(around) {
        let span = ghosts_within(N / 2, offset, window);
        if span.iter().any(|range| range.is_empty()) {
            continue;
        }
        for (component, row) in patch.chunks_exact_mut(len).enumerate() {
            let of = |slot: usize| field.component(slot, component);
            match neighbour {
                Neighbour::Same(other) => project_same::<N>(row, of(other), offset, &span, rows),
                Neighbour::Coarser(other) => copy_coarser::<N>(row, of(other), offset, &span, id),
                Neighbour::Finer([a, b]) => {
                    project_twice(row, [of(a), of(b)], offset, &span, rows, mesh, id);
                }
                Neighbour::Boundary => {}
            }
        }
    }
}

/// Fills what prediction of a block's ghosts in one direction, beyond which it is coarser, needs of its patch, as far as it
/// is within the domain: the layer of cells next to the side, which the padded block knows, and the two layers beyond.
///
/// - `patch`, `rows`, `slot`: as for [`project_window`]; `padded`: the block with the ghosts of its level, and where it lies.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn project_for_ghosts<const N: usize>(
    patch: &mut [f64],
    rows: &[RadialRow],
    (padded, at): (&[f64], Frame),
    mesh: &Mesh<N>,
    field: &Field,
    slot: usize,
    towards: Offset,
) {
    let id = mesh.tree().leaves()[slot];
    let (stride, fine_stride) = (N / 2 + 2 * GHOSTS, at.stride());
    let (len, half) = (stride * stride, (N / 2) as isize);
    let spans = |step: i8| match step {
        -1 => (0..1, -2..1),
        0 => (-1..half + 1, -1..half + 1),
        _ => (half - 1..half, half - 1..half + 2),
    };
    let ((known_i, window_i), (known_j, window_j)) = (spans(towards.i), spans(towards.j));
    let known_rows = &rows[(known_j.start + GHOSTS as isize) as usize..][..known_j.len()];
    let from = at.index(2 * known_i.start, 2 * known_j.start);
    let to = Patch::<N>::FRAME.index(known_i.start, known_j.start);
    for (row, cells) in patch.chunks_exact_mut(len).zip(padded.chunks_exact(at.len())) {
        let (row, cells) = (&mut row[to..], &cells[from..]);
        // Of known width; no iterator over chunks, which would divide to know its length.
        if towards.i == 0 {
            let share = known_rows[0].lower_share;
            project_rows(cells, fine_stride, share, &mut row[..N / 2 + 2]);
        } else {
            for (line, radial) in known_rows.iter().enumerate() {
                let cells = &cells[2 * line * fine_stride..];
                project_some::<1>(cells, fine_stride, radial.lower_share, &mut row[line * stride..]);
            }
        }
    }
    let window = [window_i, window_j];
    for (offset, neighbour) in Offset::ALL.into_iter().zip(mesh.tree().neighbours(slot)) {
        let span = ghosts_within(N / 2, offset, &window);
        if span.iter().any(|range| range.is_empty()) {
            continue;
        }
        let is_known =
            |range: &Range<isize>, known: &Range<isize>| known.start <= range.start && range.end <= known.end;
        let is_known = is_known(&span[0], &known_i) && is_known(&span[1], &known_j);
        let rows_of = |slot: usize| field.block(slot).chunks_exact(N * N);
        let components = patch.chunks_exact_mut(len);
        match *neighbour {
            Neighbour::Coarser(other) => {
                let (from, to) = (
                    first_of_coarser::<N>(offset, &span, id),
                    Patch::<N>::FRAME.index(span[0].start, span[1].start),
                );
                for (row, owner) in components.zip(rows_of(other)) {
                    let (row, owner, lines) = (&mut row[to..], &owner[from..], span[1].len());
                    match span[0].len() {
                        1 => (0..lines).for_each(|line| row[line * stride] = owner[line * N]),
                        2 => (0..lines).for_each(|line| copy_row::<2>(row, line * stride, owner, line * N)),
                        n => (0..lines).for_each(|line| {
                            copy_cells(&mut row[line * stride..][..n], &owner[line * N..][..n]);
                        }),
                    }
                }
            }
            Neighbour::Same(other) if !is_known => {
                for (row, owner) in components.zip(rows_of(other)) {
                    project_same::<N>(row, owner, offset, &span, rows);
                }
            }
            Neighbour::Finer([a, b]) if !is_known => {
                for (row, (a, b)) in components.zip(rows_of(a).zip(rows_of(b))) {
                    project_twice(row, [a, b], offset, &span, rows, mesh, id);
                }
            }
            _ => {}
        }
    }
}

/// Means of 2 × 2 cells of a block's finer neighbours: the cells `i` of row `j`, numbered as that neighbour's own if
/// it were of the block's level.
///
/// - `fine`: the children that touch the block, see [`crate::Neighbour::Finer`].
#[inline(always)]
fn project_children<const N: usize>(
    fine: [&[f64]; 2],
    offset: Offset,
    i: Range<usize>,
    j: usize,
    lower_share: f64,
    means: &mut [f64],
) {
    let half = N / 2;
    let row = 2 * (j % half) * N;
    // Beyond a side the two children differ along it; beyond a corner they are the same.
    if offset.j != 0 && offset.i == 0 {
        let middle = i.end.min(half).saturating_sub(i.start);
        let (first, second) = means.split_at_mut(middle);
        if !first.is_empty() {
            project_rows(&fine[0][row + 2 * i.start..], N, lower_share, first);
        }
        if !second.is_empty() {
            project_rows(&fine[1][row + 2 * (i.start.max(half) - half)..], N, lower_share, second);
        }
    } else {
        let child = if offset.j == 0 { j / half } else { i.start / half };
        project_rows(&fine[child][row + 2 * (i.start % half)..], N, lower_share, means);
    }
}

/// The cells of a neighbour's own numbering that a range of ghosts covers.
#[inline(always)]
fn local(range: &Range<isize>, step: i8, n: usize) -> Range<usize> {
    let first = isize::from(step) * n as isize;
    (range.start - first) as usize..(range.end - first) as usize
}

/// Projects the ghosts of a padded block in one direction from blocks one level finer, all components.
///
/// - `at`: where the block lies in the padded rows; `children`: their slots, see [`Neighbour::Finer`].
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn project_finer<const N: usize>(
    padded: &mut [f64],
    at: Frame,
    field: &Field,
    children: [usize; 2],
    offset: Offset,
    mesh: &Mesh<N>,
    id: BlockId,
) {
    let (span_i, span_j) = (ghost_span(N, offset.i), ghost_span(N, offset.j));
    let rows = &mesh.radial(id.level + 1, i64::from(id.j) * N as i64 + span_j.start as i64)[..span_j.len()];
    // The first cells of a child that touch the block, along z and along r.
    let first = |step: i8| if step < 0 { N - 2 * GHOSTS } else { 0 };
    let from = first(offset.j) * N + first(offset.i);
    let to = at.index(span_i.start, span_j.start);
    let (half, stride) = (N / 2, at.stride());
    for (component, row) in padded.chunks_exact_mut(at.len()).enumerate() {
        let [a, b] = children.map(|child| &field.component(child, component)[from..]);
        let row = &mut row[to..];
        if offset.i == 0 {
            for (j, radial) in rows.iter().enumerate() {
                let (first, second) = row[j * stride..][..N].split_at_mut(half);
                project_rows(&a[2 * j * N..], N, radial.lower_share, first);
                project_rows(&b[2 * j * N..], N, radial.lower_share, second);
            }
        } else {
            // Beyond a corner there is one child only.
            for (j, radial) in rows.iter().enumerate() {
                let fine = if j < half { a } else { b };
                let cells = &fine[2 * (j % half) * N..];
                project_some::<GHOSTS>(cells, N, radial.lower_share, &mut row[j * stride..]);
            }
        }
    }
}

/// Cells of a patch from its own block, or ghosts in one direction from a block of the same level.
///
/// - `window`: the cells; `rows`: of the patch, two ghost rows first.
#[inline(always)]
fn project_same<const N: usize>(
    row: &mut [f64],
    owner: &[f64],
    offset: Offset,
    [span_i, span_j]: &Window,
    rows: &[RadialRow],
) {
    let n = N as isize;
    let local_i = (2 * span_i.start - isize::from(offset.i) * n) as usize;
    for j in span_j.clone() {
        let share = rows[(j + GHOSTS as isize) as usize].lower_share;
        let local_j = (2 * j - isize::from(offset.j) * n) as usize;
        let to = Patch::<N>::FRAME.index(span_i.start, j);
        project_rows(&owner[local_j * N + local_i..], N, share, &mut row[to..to + span_i.len()]);
    }
}

/// Ghosts of a patch from a block of the patch's own level.
#[inline(always)]
fn copy_coarser<const N: usize>(row: &mut [f64], owner: &[f64], offset: Offset, span: &Window, id: BlockId) {
    let first = first_of_coarser::<N>(offset, span, id);
    let [span_i, span_j] = span;
    for (line, j) in span_j.clone().enumerate() {
        let (from, to) = (first + line * N, Patch::<N>::FRAME.index(span_i.start, j));
        copy_cells(&mut row[to..to + span_i.len()], &owner[from..from + span_i.len()]);
    }
}

/// The cell of a coarser neighbour that the first cell of a window is.
fn first_of_coarser<const N: usize>(offset: Offset, [span_i, span_j]: &Window, id: BlockId) -> usize {
    let (half, n) = ((N / 2) as i64, N as i64);
    // Both counted from the domain's edge in cells of the coarse level, as if periodic images went on.
    let first = |at: u32, step: i8| {
        let coarse_block = (i64::from(at) + i64::from(step)).div_euclid(2);
        (i64::from(at) * half - coarse_block * n) as isize
    };
    let (first_i, first_j) = (first(id.i, offset.i), first(id.j, offset.j));
    ((first_j + span_j.start) * N as isize + first_i + span_i.start) as usize
}

/// Ghosts of a patch from blocks one level finer than the block itself.
#[inline(always)]
fn project_twice<const N: usize>(
    row: &mut [f64],
    fine: [&[f64]; 2],
    offset: Offset,
    [span_i, span_j]: &Window,
    rows: &[RadialRow],
    mesh: &Mesh<N>,
    id: BlockId,
) {
    let from = local(&(2 * span_i.start..2 * span_i.end), offset.i, N);
    let first = i64::from(id.j) * N as i64;
    for j in span_j.clone() {
        let halves = mesh.radial(id.level + 1, first + 2 * j as i64);
        let mut between = [[0.0; N]; 2];
        for (b, means) in between.iter_mut().enumerate() {
            let local_j = (2 * j + b as isize - isize::from(offset.j) * N as isize) as usize;
            let means = &mut means[..from.len()];
            project_children::<N>(fine, offset, from.clone(), local_j, halves[b].lower_share, means);
        }
        let to = Patch::<N>::FRAME.index(span_i.start, j);
        let share = rows[(j + GHOSTS as isize) as usize].lower_share;
        project_rows(between.as_flattened(), N, share, &mut row[to..to + span_i.len()]);
    }
}
