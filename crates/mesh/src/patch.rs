//! A block and its surroundings, seen on the next coarser level.

use crate::ghosts::{continue_line, finer_cell, ghost_range, ghost_span, index, mean, mean_of_cells, mirror};
use crate::multiresolution::{MOST_COMPONENTS, Multiresolution, deviations};
use crate::{BlockId, Field, GHOSTS, Mesh, Neighbour, Offset, Padded, Side};

/// The cells of one block and two layers around it, projected to the level below: N/2 × N/2 cells with ghosts.
///
/// From it the block's ghosts beyond a level jump are predicted, and its own cells, whose differences from the
/// prediction are the details.
#[derive(Clone, Debug)]
pub struct Patch<const N: usize> {
    components: usize,
    data: Vec<f64>,
    /// Lower shares of the volume, by row, ghosts included.
    shares: Vec<f64>,
}

impl<const N: usize> Patch<N> {
    const HALF: usize = N / 2;
    const STRIDE: usize = N / 2 + 2 * GHOSTS;
    const LEN: usize = Self::STRIDE * Self::STRIDE;

    /// All zero.
    pub fn zeros(components: usize) -> Self {
        assert!(components <= MOST_COMPONENTS, "no more than {MOST_COMPONENTS} components");
        Self { components, data: vec![0.0; components * Self::LEN], shares: vec![0.5; Self::STRIDE] }
    }

    /// Fills the patch of the block in `slot`.
    pub(crate) fn fill(&mut self, mesh: &Mesh<N>, field: &Field, slot: usize, rule: &impl Multiresolution) {
        let id = mesh.tree().leaves()[slot];
        let first = i64::from(id.j) * Self::HALF as i64;
        for (share, j) in self.shares.iter_mut().zip(ghost_range(Self::HALF)) {
            *share = mesh.lower_share(id.level, first + j as i64);
        }
        let neighbours = mesh.tree().neighbours(slot);
        let shares = &self.shares;
        for (component, row) in self.data.chunks_exact_mut(Self::LEN).enumerate() {
            let own = field.component(slot, component);
            for j in 0..Self::HALF {
                let share = shares[j + GHOSTS];
                let to = index(Self::HALF, 0, j as isize);
                for (i, cell) in row[to..to + Self::HALF].iter_mut().enumerate() {
                    *cell = mean_of_cells::<N>(own, 2 * i, 2 * j, share);
                }
            }
            for (offset, neighbour) in Offset::ALL.iter().zip(neighbours) {
                let of = |slot: &usize| field.component(*slot, component);
                match neighbour {
                    Neighbour::Same(other) => project_same::<N>(row, of(other), *offset, shares),
                    Neighbour::Coarser(other) => copy_coarser::<N>(row, of(other), *offset, id),
                    Neighbour::Finer([a, b]) => {
                        project_twice(row, [of(a), of(b)], *offset, shares, mesh, id);
                    }
                    Neighbour::Boundary => {}
                }
            }
            // r first: the z sides then find the ghosts beyond r filled and complete the corners.
            for side in [Side::RMin, Side::RMax, Side::ZMin, Side::ZMax] {
                if neighbours[side as usize] == Neighbour::Boundary {
                    match rule.parity(side, component) {
                        Some(parity) => mirror(row, Self::HALF, side, parity),
                        None => continue_line(row, Self::HALF, side),
                    }
                }
            }
        }
    }

    /// Predicts the ghosts of the block in one direction.
    pub(crate) fn predict_ghosts(&self, offset: Offset, rule: &impl Multiresolution, padded: &mut Padded<N>) {
        let half = Self::HALF as isize;
        let span = |step: i8| match step {
            -1 => -1..0,
            0 => 0..half,
            _ => half..half + 1,
        };
        let mut cells = [[0.0; MOST_COMPONENTS]; 4];
        for j in span(offset.j) {
            for i in span(offset.i) {
                self.predict(i, j, Some(rule), &mut cells);
                for component in 0..self.components {
                    let row = padded.component_mut(component);
                    for (child, cell) in cells.iter().enumerate() {
                        let (di, dj) = (child as isize % 2, child as isize / 2);
                        row[Padded::<N>::index(2 * i + di, 2 * j + dj)] = cell[component];
                    }
                }
            }
        }
    }

    /// The predicted children of cell (i, j) of the patch; without a rule without regard to what is admissible.
    fn predict<R: Multiresolution>(
        &self,
        i: isize,
        j: isize,
        rule: Option<&R>,
        cells: &mut [[f64; MOST_COMPONENTS]; 4],
    ) {
        let k = index(Self::HALF, i, j);
        let lower_share = self.shares[(j + GHOSTS as isize) as usize];
        predict(&self.data, Self::LEN, Self::STRIDE, k, lower_share, rule, cells);
    }

    /// Calls `visit(i, j, significance)` for every cell of the block: the size of its detail.
    ///
    /// - `block`: the block's own cells; the patch must have been filled from it.
    pub(crate) fn details<R: Multiresolution>(
        &self,
        block: &[f64],
        rule: &R,
        mut visit: impl FnMut(usize, usize, f64),
    ) {
        let mut cells = [[0.0; MOST_COMPONENTS]; 4];
        for j in 0..Self::HALF {
            for i in 0..Self::HALF {
                self.predict::<R>(i as isize, j as isize, None, &mut cells);
                for (child, predicted) in cells.iter().enumerate() {
                    let (fine_i, fine_j) = (2 * i + child % 2, 2 * j + child / 2);
                    let (mut own, mut detail) = ([0.0; MOST_COMPONENTS], [0.0; MOST_COMPONENTS]);
                    for component in 0..self.components {
                        own[component] = block[(component * N + fine_j) * N + fine_i];
                        detail[component] = own[component] - predicted[component];
                    }
                    let size = rule.significance(&own[..self.components], &detail[..self.components]);
                    visit(fine_i, fine_j, size);
                }
            }
        }
    }
}

/// The predicted children of cell `k` of rows of length `len`.
pub(crate) fn predict<R: Multiresolution>(
    rows: &[f64],
    len: usize,
    stride: usize,
    k: usize,
    lower_share: f64,
    rule: Option<&R>,
    cells: &mut [[f64; MOST_COMPONENTS]; 4],
) {
    let components = rows.len() / len;
    let mut means = [0.0; MOST_COMPONENTS];
    for (component, row) in rows.chunks_exact(len).enumerate() {
        means[component] = row[k];
        let deviations = deviations(row, k, stride, lower_share);
        for (cell, deviation) in cells.iter_mut().zip(deviations) {
            cell[component] = deviation;
        }
    }
    let share = rule.map_or(1.0, |rule| rule.share(&means[..components], cells));
    for cell in cells {
        for (value, mean) in cell.iter_mut().zip(means) {
            *value = mean + share * *value;
        }
    }
}

/// Ghosts of a patch from a block of the same level as the block itself.
fn project_same<const N: usize>(row: &mut [f64], owner: &[f64], offset: Offset, shares: &[f64]) {
    let (half, n) = (N / 2, N as isize);
    for j in ghost_span(half, offset.j) {
        let share = shares[(j + GHOSTS as isize) as usize];
        let local_j = (2 * j - isize::from(offset.j) * n) as usize;
        for i in ghost_span(half, offset.i) {
            let local_i = (2 * i - isize::from(offset.i) * n) as usize;
            row[index(half, i, j)] = mean_of_cells::<N>(owner, local_i, local_j, share);
        }
    }
}

/// Ghosts of a patch from a block of the patch's own level.
fn copy_coarser<const N: usize>(row: &mut [f64], owner: &[f64], offset: Offset, id: BlockId) {
    let (half, n) = ((N / 2) as i64, N as i64);
    // Both counted from the domain's edge in cells of the coarse level, as if periodic images went on.
    let first = |at: u32, step: i8| {
        let coarse_block = (i64::from(at) + i64::from(step)).div_euclid(2);
        (i64::from(at) * half - coarse_block * n) as isize
    };
    let (first_i, first_j) = (first(id.i, offset.i), first(id.j, offset.j));
    let span_i = ghost_span(N / 2, offset.i);
    for j in ghost_span(N / 2, offset.j) {
        let to = index(N / 2, span_i.start, j);
        let from = ((first_j + j) * N as isize + first_i + span_i.start) as usize;
        row[to..to + span_i.len()].copy_from_slice(&owner[from..from + span_i.len()]);
    }
}

/// Ghosts of a patch from blocks one level finer than the block itself.
fn project_twice<const N: usize>(
    row: &mut [f64],
    fine: [&[f64]; 2],
    offset: Offset,
    shares: &[f64],
    mesh: &Mesh<N>,
    id: BlockId,
) {
    let half = N / 2;
    let first = i64::from(id.j) * N as i64;
    for j in ghost_span(half, offset.j) {
        let halves = [0, 1].map(|b| mesh.lower_share(id.level + 1, first + 2 * j as i64 + b));
        for i in ghost_span(half, offset.i) {
            let cells = [0, 1].map(|b| {
                [0, 1].map(|a| finer_cell::<N>(fine, offset, 2 * i + a, 2 * j + b as isize, halves[b]))
            });
            row[index(half, i, j)] = mean(cells, shares[(j + GHOSTS as isize) as usize]);
        }
    }
}
