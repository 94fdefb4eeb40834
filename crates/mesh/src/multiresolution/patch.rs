//! A block and its surroundings, seen on the next coarser level: what prediction (prolongation) starts from.

use crate::ghosts::{continue_within, ghost_range};
use crate::multiresolution::details::{DetailRows, details_of_rows};
use crate::multiresolution::project::{Window, copy_cells, project_rows, project_window};
use crate::multiresolution::radial::RadialRow;
use crate::multiresolution::{MOST_COMPONENTS, MOST_IN_FIELD, Multiresolution, deviations};
use crate::{Field, Frame, GHOSTS, Mesh, Padded, Side};

mod beside_coarser;

/// The cells of one block and two layers around it, projected to the level below: N/2 × N/2 cells with ghosts.
///
/// From it the block's ghosts beyond a level jump are predicted, and its own cells, whose differences from the
/// prediction are the details.
#[derive(Clone, Debug)]
pub struct Patch<const N: usize> {
    components: usize,
    data: Vec<f64>,
    /// Rows of cells, ghosts included.
    rows: Vec<RadialRow>,
    odd: [bool; MOST_IN_FIELD],
}

/// Which components are odd in r.
pub(crate) fn odd_components(components: usize, rule: &impl Multiresolution) -> [bool; MOST_IN_FIELD] {
    let is_odd = |component| component < components && rule.parity(Side::RMin, component) == Some(-1.0);
    std::array::from_fn(is_odd)
}

impl<const N: usize> Patch<N> {
    const HALF: usize = N / 2;
    /// Where the cells of a component lie.
    pub(crate) const FRAME: Frame = Frame::of(N / 2);
    const STRIDE: usize = Self::FRAME.stride();
    const LEN: usize = Self::FRAME.len();

    /// All zero.
    pub fn zeros(components: usize) -> Self {
        assert!(components <= MOST_IN_FIELD, "no more than {MOST_IN_FIELD} components");
        Self {
            components,
            data: vec![0.0; components * Self::LEN],
            rows: Vec::with_capacity(Self::STRIDE),
            odd: [false; MOST_IN_FIELD],
        }
    }

    /// Takes notice of where the patch lies: the level of the children of its cells, and its first row.
    fn place(&mut self, mesh: &Mesh<N>, fine: u8, first: i64, rule: &impl Multiresolution) {
        self.rows.clear();
        self.rows.extend_from_slice(&mesh.radial(fine, first - GHOSTS as i64)[..Self::STRIDE]);
        self.odd = odd_components(self.components, rule);
    }

    /// Fills the patch of the block in `slot`.
    pub(crate) fn fill(&mut self, mesh: &Mesh<N>, field: &Field, slot: usize, rule: &impl Multiresolution) {
        self.fill_part(mesh, field, slot, rule, &[ghost_range(Self::HALF), ghost_range(Self::HALF)]);
    }

    /// [`Patch::fill`] in a window that holds all of the block's own cells.
    fn fill_part(
        &mut self,
        mesh: &Mesh<N>,
        field: &Field,
        slot: usize,
        rule: &impl Multiresolution,
        window: &Window,
    ) {
        let id = mesh.tree().leaves()[slot];
        self.place(mesh, id.level, i64::from(id.j) * Self::HALF as i64, rule);
        project_window(&mut self.data, &self.rows, mesh, field, slot, window);
        for (component, row) in self.data.chunks_exact_mut(Self::LEN).enumerate() {
            continue_beyond(row, Self::FRAME, component, rule, |side| mesh.touches(slot, side));
        }
    }

    /// What differences along r count in a row of the patch, counted from the first ghost row.
    #[inline(always)]
    fn radial(&self, component: usize, row: usize) -> [f64; 2] {
        self.rows[row].weights[usize::from(self.odd[component])]
    }

    /// Calls `visit(i, j, [size, size everywhere])` for the cells of the block whose details are larger than `least`, see
    /// [`Multiresolution::significance`].
    ///
    /// - `own`: the block's own row of cells of a component and a number; the patch must have been filled from it.
    pub(crate) fn details<'a, R: Multiresolution>(
        &self,
        own: impl Fn(usize, usize) -> &'a [f64],
        rule: &R,
        least: f64,
        mut visit: impl FnMut(usize, usize, [f64; 2]),
    ) {
        let mut rows = DetailRows::<N>::ZERO;
        for j in 0..Self::HALF {
            for component in 0..self.components.min(MOST_COMPONENTS) {
                for (b, row) in rows.own[component].iter_mut().enumerate() {
                    row.copy_from_slice(&own(component, 2 * j + b)[..N]);
                }
            }
            let weights = std::array::from_fn(|component| {
                if component < self.components { self.radial(component, j + GHOSTS) } else { [0.0; 2] }
            });
            let from = Self::FRAME.index(-1, j as isize - 1);
            details_of_rows(&self.data, Self::LEN, from, Self::STRIDE, &weights, rule, &mut rows);
            for (b, sizes) in rows.sizes.iter().enumerate() {
                // Most rows hold nothing significant.
                if sizes.iter().fold(false, |any, size| any | (*size > least)) {
                    let cells = (0..N).filter(|i| sizes[*i] > least);
                    cells.for_each(|i| {
                        let [cell, detail] = rows.cell(b, i);
                        visit(i, 2 * j + b, [sizes[i], rule.significance_everywhere(&cell, &detail)]);
                    });
                }
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
            // Not the ghosts that its siblings own.
            let window = [number % 2, number / 2].map(|upper| match upper {
                0 => -(GHOSTS as isize)..half,
                _ => 0..half + GHOSTS as isize,
            });
            child.fill_part(mesh, field, first + number, rule, &window);
            let (first_i, first_j) = (number as isize % 2 * half, number as isize / 2 * half);
            let width = window[0].len();
            for (component, row) in child.data.chunks_exact(Self::LEN).enumerate() {
                let to = around.component_mut(component);
                for j in window[1].clone() {
                    let from = Self::FRAME.index(window[0].start, j);
                    let at = Padded::<N>::index(first_i + window[0].start, first_j + j);
                    copy_cells(&mut to[at..at + width], &row[from..from + width]);
                }
            }
        }
        let id = mesh.tree().leaves()[first];
        self.place(mesh, id.level - 1, i64::from(id.j / 2) * Self::HALF as i64, rule);
        for (component, row) in self.data.chunks_exact_mut(Self::LEN).enumerate() {
            for j in -1..half + 1 {
                let from = &around.component(component)[Padded::<N>::index(-2, 2 * j)..];
                let to = Self::FRAME.index(-1, j);
                let share = self.rows[(j + GHOSTS as isize) as usize].lower_share;
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
            continue_beyond(row, Self::FRAME, component, rule, is_boundary);
        }
    }
}

/// Fills the ghosts of one component beyond the domain in the way that prediction needs: linear in the values.
pub(crate) fn continue_beyond(
    row: &mut [f64],
    frame: Frame,
    component: usize,
    rule: &impl Multiresolution,
    is_boundary: impl Fn(Side) -> bool,
) {
    // r first: the z sides then find the ghosts beyond r filled and complete the corners.
    for side in Side::FOR_GHOSTS {
        if is_boundary(side) {
            let along = ghost_range(frame.cells());
            continue_within(row, frame, side, along, rule.parity(side, component));
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
    cells: &mut [[f64; MOST_IN_FIELD]; 4],
) {
    let components = (rows.len() / len).min(MOST_COMPONENTS);
    let mut means = [0.0; MOST_IN_FIELD];
    for (component, row) in rows.chunks_exact(len).enumerate() {
        means[component] = row[k];
        let deviations = deviations(row, k, stride, radial(component));
        for (cell, deviation) in cells.iter_mut().zip(deviations) {
            cell[component] = deviation;
        }
    }
    let leading: [[f64; MOST_COMPONENTS]; 4] =
        std::array::from_fn(|child| std::array::from_fn(|component| cells[child][component]));
    let share = rule.share(&means[..components], &leading);
    for cell in cells {
        for (value, mean) in cell.iter_mut().zip(means) {
            *value = mean + share * *value;
        }
    }
}
