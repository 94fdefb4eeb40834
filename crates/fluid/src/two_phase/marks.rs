//! Which cells fall back to first order, as both sides of a block's edge see it.

use mesh::{Marks, Mesh, Padded};

/// Writes which padded cells of a block are marked, ghosts in other blocks included: a fall-back changes the fluxes on
/// both sides of a face alike.
///
/// A ghost that stands for cells of another level is marked if the cell at its centre is; the finer side's flux counts
/// there, see `reflux.rs`. Which blocks are made again for what they see of their neighbours' marks, `retry.rs` of the mesh knows.
pub(crate) fn padded_marks<const N: usize>(
    mesh: &Mesh<N>,
    slot: usize,
    marks: &Marks<N>,
    is_marked: &mut [bool],
) {
    is_marked.fill(false);
    for cell in marks.get(&slot).into_iter().flat_map(|cells| cells.cells()) {
        is_marked[Padded::<N>::index((cell % N) as isize, (cell / N) as isize)] = true;
    }
    let n = N as isize;
    for along in 0..n {
        for (i, j) in [(-1, along), (n, along), (along, -1), (along, n)] {
            let of_ghost =
                mesh.cell_at(slot, i, j).and_then(|(slot, i, j)| Some(marks.get(&slot)?.has(i, j)));
            is_marked[Padded::<N>::index(i, j)] = of_ghost == Some(true);
        }
    }
}
