//! A block and its surroundings, seen on the next coarser level.

use crate::ghosts::{continue_parabola, finer_cell, ghost_range, ghost_span, index, mean, mirror};
use crate::multiresolution::{
    MOST_COMPONENTS, Multiresolution, deviations, deviations_among, radial_weights,
};
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
    radial: Radial,
}

/// What differences along r count in prediction, row by row, ghosts included: for even and for odd components.
#[derive(Clone, Debug)]
pub(crate) struct Radial {
    odd: [bool; MOST_COMPONENTS],
    rows: Vec<[[f64; 2]; 2]>,
}

impl Radial {
    pub fn new(rows: usize) -> Self {
        Self { odd: [false; MOST_COMPONENTS], rows: vec![[radial_weights(0.5, 1.0); 2]; rows] }
    }

    /// For rows from `first` on, two ghost rows before it included; `fine` is the level of the children.
    pub fn set<const N: usize>(
        &mut self,
        mesh: &Mesh<N>,
        fine: u8,
        first: i64,
        components: usize,
        rule: &impl Multiresolution,
    ) {
        for (component, odd) in self.odd[..components].iter_mut().enumerate() {
            *odd = rule.parity(Side::RMin, component) == Some(-1.0);
        }
        for (row, j) in self.rows.iter_mut().zip(first - GHOSTS as i64..) {
            let share = mesh.lower_share(fine, j);
            *row = [radial_weights(share, 1.0), radial_weights(share, mesh.odd_factor(fine, j))];
        }
    }

    /// The weights of a component in a row counted from the first ghost row.
    #[inline(always)]
    pub fn of(&self, component: usize, row: usize) -> [f64; 2] {
        self.rows[row][usize::from(self.odd[component])]
    }
}

impl<const N: usize> Patch<N> {
    const HALF: usize = N / 2;
    const STRIDE: usize = N / 2 + 2 * GHOSTS;
    const LEN: usize = Self::STRIDE * Self::STRIDE;

    /// All zero.
    pub fn zeros(components: usize) -> Self {
        assert!(components <= MOST_COMPONENTS, "no more than {MOST_COMPONENTS} components");
        Self {
            components,
            data: vec![0.0; components * Self::LEN],
            shares: vec![0.5; Self::STRIDE],
            radial: Radial::new(Self::STRIDE),
        }
    }

    /// Fills the patch of the block in `slot`.
    pub(crate) fn fill(&mut self, mesh: &Mesh<N>, field: &Field, slot: usize, rule: &impl Multiresolution) {
        let id = mesh.tree().leaves()[slot];
        let first = i64::from(id.j) * Self::HALF as i64;
        for (share, j) in self.shares.iter_mut().zip(ghost_range(Self::HALF)) {
            *share = mesh.lower_share(id.level, first + j as i64);
        }
        self.radial.set(mesh, id.level, first, self.components, rule);
        let neighbours = mesh.tree().neighbours(slot);
        let shares = &self.shares;
        for (component, row) in self.data.chunks_exact_mut(Self::LEN).enumerate() {
            let own = field.component(slot, component);
            for j in 0..Self::HALF {
                let to = index(Self::HALF, 0, j as isize);
                project_rows(
                    &own[2 * j * N..][..2 * N],
                    N,
                    shares[j + GHOSTS],
                    &mut row[to..to + Self::HALF],
                );
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
            continue_beyond(row, Self::HALF, component, rule, |side| mesh.touches(slot, side));
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
                let k = index(Self::HALF, i, j);
                let radial = |component: usize| self.radial.of(component, (j + GHOSTS as isize) as usize);
                predict(&self.data, Self::LEN, Self::STRIDE, k, radial, rule, &mut cells);
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

    /// Calls `visit(i, j, significance)` for every cell of the block: the size of its detail.
    ///
    /// - `block`: the block's own cells; the patch must have been filled from it.
    pub(crate) fn details<R: Multiresolution>(
        &self,
        block: &[f64],
        rule: &R,
        mut visit: impl FnMut(usize, usize, f64),
    ) {
        // Two rows of cells at a time: component by component first, so that it vectorises.
        let mut owns = [[[0.0; N]; 2]; MOST_COMPONENTS];
        let mut details = owns;
        for j in 0..Self::HALF {
            let rows = owns.iter_mut().zip(&mut details).zip(self.data.chunks_exact(Self::LEN));
            for (component, ((own, details), row)) in rows.enumerate() {
                let from = &block[(component * N + 2 * j) * N..][..2 * N];
                own[0].copy_from_slice(&from[..N]);
                own[1].copy_from_slice(&from[N..]);
                let radial = self.radial.of(component, j + GHOSTS);
                Self::details_of_rows(row, j, radial, own, details);
            }
            for b in 0..2 {
                for i in 0..N {
                    let (mut own, mut detail) = ([0.0; MOST_COMPONENTS], [0.0; MOST_COMPONENTS]);
                    for component in 0..self.components.min(MOST_COMPONENTS) {
                        own[component] = owns[component][b][i];
                        detail[component] = details[component][b][i];
                    }
                    let size = rule.significance(&own[..self.components], &detail[..self.components]);
                    visit(i, 2 * j + b, size);
                }
            }
        }
    }

    /// The details of one component in the cells of row `j` of the patch: what they are minus what is predicted.
    #[inline(always)]
    fn details_of_rows(
        row: &[f64],
        j: usize,
        radial: [f64; 2],
        own: &[[f64; N]; 2],
        details: &mut [[f64; N]; 2],
    ) {
        let from = |j: isize| &row[index(Self::HALF, -1, j)..][..Self::HALF + 2];
        let (below, middle, above) = (from(j as isize - 1), from(j as isize), from(j as isize + 1));
        for i in 0..Self::HALF {
            let three = |row: &[f64]| [row[i], row[i + 1], row[i + 2]];
            let deviations = deviations_among([three(below), three(middle), three(above)], radial);
            for (child, deviation) in deviations.iter().enumerate() {
                let (a, b) = (2 * i + child % 2, child / 2);
                details[b][a] = own[b][a] - (middle[i + 1] + deviation);
            }
        }
    }

    /// Fills the patch of the block that four siblings would make, the leaves from slot `first` on, as far as
    /// [`Patch::details`] needs it, and sets `around` to that block and its surroundings.
    ///
    /// - `child`: scratch.
    pub(crate) fn fill_parent(
        &mut self,
        mesh: &Mesh<N>,
        field: &Field,
        first: usize,
        rule: &impl Multiresolution,
        child: &mut Self,
        around: &mut Padded<N>,
    ) {
        let half = Self::HALF as isize;
        for number in 0..4 {
            child.fill(mesh, field, first + number, rule);
            let (first_i, first_j) = (number as isize % 2 * half, number as isize / 2 * half);
            for (component, row) in child.data.chunks_exact(Self::LEN).enumerate() {
                let to = around.component_mut(component);
                for (j, row) in ghost_range(Self::HALF).zip(row.chunks_exact(Self::STRIDE)) {
                    let at = Padded::<N>::index(first_i - GHOSTS as isize, first_j + j);
                    to[at..at + Self::STRIDE].copy_from_slice(row);
                }
            }
        }
        let id = mesh.tree().leaves()[first];
        let first_row = i64::from(id.j / 2) * Self::HALF as i64;
        for (share, j) in self.shares.iter_mut().zip(ghost_range(Self::HALF)) {
            *share = mesh.lower_share(id.level - 1, first_row + j as i64);
        }
        self.radial.set(mesh, id.level - 1, first_row, self.components, rule);
        for (component, row) in self.data.chunks_exact_mut(Self::LEN).enumerate() {
            for j in -1..half + 1 {
                let from = &around.component(component)[Padded::<N>::index(-2, 2 * j)..];
                let to = index(Self::HALF, -1, j);
                let share = self.shares[(j + GHOSTS as isize) as usize];
                project_rows(from, Padded::<N>::STRIDE, share, &mut row[to..to + Self::HALF + 2]);
            }
            let is_boundary = |side: Side| {
                let last = match side {
                    Side::ZMin | Side::RMin => first,
                    Side::ZMax => first + 1,
                    Side::RMax => first + 2,
                };
                mesh.touches(last, side)
            };
            continue_beyond(row, Self::HALF, component, rule, is_boundary);
        }
    }
}

/// Fills the ghosts of one component beyond the domain in the way that prediction needs: linear in the values.
pub(crate) fn continue_beyond(
    row: &mut [f64],
    n: usize,
    component: usize,
    rule: &impl Multiresolution,
    is_boundary: impl Fn(Side) -> bool,
) {
    // r first: the z sides then find the ghosts beyond r filled and complete the corners.
    for side in [Side::RMin, Side::RMax, Side::ZMin, Side::ZMax] {
        if is_boundary(side) {
            match rule.parity(side, component) {
                Some(parity) => mirror(row, n, side, parity),
                None => continue_parabola(row, n, side),
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
    radial: impl Fn(usize) -> [f64; 2],
    rule: &R,
    cells: &mut [[f64; MOST_COMPONENTS]; 4],
) {
    let components = rows.len() / len;
    let mut means = [0.0; MOST_COMPONENTS];
    for (component, row) in rows.chunks_exact(len).enumerate() {
        means[component] = row[k];
        let deviations = deviations(row, k, stride, radial(component));
        for (cell, deviation) in cells.iter_mut().zip(deviations) {
            cell[component] = deviation;
        }
    }
    let share = rule.share(&means[..components], cells);
    for cell in cells {
        for (value, mean) in cell.iter_mut().zip(means) {
            *value = mean + share * *value;
        }
    }
}

/// Means of 2 × 2 cells along two rows, the second `stride` after the first.
#[inline(always)]
fn project_rows(cells: &[f64], stride: usize, lower_share: f64, means: &mut [f64]) {
    let (lower, upper) = (&cells[..2 * means.len()], &cells[stride..][..2 * means.len()]);
    for ((value, low), high) in means.iter_mut().zip(lower.chunks_exact(2)).zip(upper.chunks_exact(2)) {
        *value = mean([[low[0], low[1]], [high[0], high[1]]], lower_share);
    }
}

/// Ghosts of a patch from a block of the same level as the block itself.
fn project_same<const N: usize>(row: &mut [f64], owner: &[f64], offset: Offset, shares: &[f64]) {
    let (half, n) = (N / 2, N as isize);
    let span_i = ghost_span(half, offset.i);
    let local_i = (2 * span_i.start - isize::from(offset.i) * n) as usize;
    for j in ghost_span(half, offset.j) {
        let share = shares[(j + GHOSTS as isize) as usize];
        let local_j = (2 * j - isize::from(offset.j) * n) as usize;
        let to = index(half, span_i.start, j);
        let from = &owner[local_j * N + local_i..][..N + 2 * span_i.len()];
        project_rows(from, N, share, &mut row[to..to + span_i.len()]);
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
