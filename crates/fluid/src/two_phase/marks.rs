//! Which cells fall back to first order, as both sides of a block's edge see it.

use mesh::{Marks, Mesh, Padded};

/// Writes which padded cells of a block are marked, ghosts in other blocks included: a fall-back changes the fluxes on
/// both sides of a face alike.
///
/// A ghost that stands for cells of another level is marked if the cell at its centre is; the finer side's flux counts
/// there, see `reflux.rs`.
pub(crate) fn padded_marks<const N: usize>(
    mesh: &Mesh<N>,
    slot: usize,
    marks: &Marks,
    is_marked: &mut [bool],
) {
    is_marked.fill(false);
    let n = N as isize;
    let own = marks.get(&slot);
    for j in -1..=n {
        for i in -1..=n {
            let inside = |x: isize| (0..n).contains(&x);
            let k = Padded::<N>::index(i, j);
            is_marked[k] = if inside(i) && inside(j) {
                own.is_some_and(|cells| cells.contains(&((j * n + i) as usize)))
            } else if inside(i) || inside(j) {
                let cell = mesh.cell_at(slot, i, j);
                cell.is_some_and(|(slot, i, j)| {
                    marks.get(&slot).is_some_and(|cells| cells.contains(&(j * N + i)))
                })
            } else {
                false
            };
        }
    }
}
