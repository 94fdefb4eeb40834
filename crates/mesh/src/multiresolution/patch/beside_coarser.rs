//! The ghosts of a block beside coarser blocks: predicted line by line, so that the inner loops are plain ones.

use crate::ghosts::continue_within;
use crate::multiresolution::project::project_for_ghosts;
use crate::multiresolution::radial::RadialRow;
use crate::multiresolution::{
    MOST_COMPONENTS, MOST_IN_FIELD, Multiresolution, deviations as deviations_of, deviations_among,
};
use crate::{Field, Frame, GHOSTS, Mesh, Neighbour, Offset, Patch, Side};

impl<const N: usize> Patch<N> {
    /// Predicts the ghosts of the block in `slot` beyond which there are coarser blocks.
    ///
    /// - `padded`: the block with all other ghosts, and where it lies; those beyond the domain do not matter. `is_asked`: in which
    ///   directions.
    pub(crate) fn predict_beside_coarser(
        &mut self,
        mesh: &Mesh<N>,
        field: &Field,
        slot: usize,
        rule: &impl Multiresolution,
        (padded, at): (&mut [f64], Frame),
        is_asked: impl Fn(Offset) -> bool,
    ) {
        let id = mesh.tree().leaves()[slot];
        self.place(mesh, id.level, i64::from(id.j) * Self::HALF as i64, rule);
        for (offset, neighbour) in Offset::ALL.iter().zip(mesh.tree().neighbours(slot)) {
            if matches!(neighbour, Neighbour::Coarser(_)) && is_asked(*offset) {
                project_for_ghosts(&mut self.data, &self.rows, (&*padded, at), mesh, field, slot, *offset);
                self.continue_for_ghosts(mesh, slot, rule, *offset);
                self.predict_ghosts(*offset, rule, (&mut *padded, at));
            }
        }
    }

    /// Fills what the prediction in one direction needs of the cells beyond the domain, beside the ends of the line.
    fn continue_for_ghosts(
        &mut self,
        mesh: &Mesh<N>,
        slot: usize,
        rule: &impl Multiresolution,
        offset: Offset,
    ) {
        let half = Self::HALF as isize;
        let (sides, step) = match offset {
            Offset { j: 0, i } => ([Side::RMin, Side::RMax], i),
            Offset { i: 0, j } => ([Side::ZMin, Side::ZMax], j),
            // Where there is a block beyond a corner, there are some beyond both sides.
            _ => return,
        };
        let along = if step < 0 { -2..1 } else { half - 1..half + 2 };
        for side in sides.into_iter().filter(|side| mesh.touches(slot, *side)) {
            for (component, row) in self.data.chunks_exact_mut(Self::LEN).enumerate() {
                continue_within(row, Self::FRAME, side, along.clone(), rule.parity(side, component));
            }
        }
    }

    /// Predicts the ghosts of the block in one direction.
    fn predict_ghosts(&self, offset: Offset, rule: &impl Multiresolution, (padded, at): (&mut [f64], Frame)) {
        let half = Self::HALF as isize;
        let first = |step: i8| match step {
            -1 => -1,
            0 => 0,
            _ => half,
        };
        let (i, j) = (first(offset.i), first(offset.j));
        let (from, to) = (Self::FRAME.index(i, j), at.index(2 * i, 2 * j));
        let rows = &self.rows[(j + GHOSTS as isize) as usize..];
        match offset {
            Offset { i: 0, .. } => {
                let line = Line { count: Self::HALF, from, to };
                predict_line::<N, false, _>(&self.data, line, rows, &self.odd, rule, (padded, at));
            }
            Offset { j: 0, .. } => {
                let line = Line { count: Self::HALF, from, to };
                predict_line::<N, true, _>(&self.data, line, rows, &self.odd, rule, (padded, at));
            }
            _ => {
                let line = Line { count: 1, from, to };
                predict_line::<N, false, _>(&self.data, line, rows, &self.odd, rule, (padded, at));
            }
        }
    }
}

/// Cells beside each other, and where their children lie.
#[derive(Clone, Copy)]
struct Line {
    count: usize,
    /// The first of them, and of the children.
    from: usize,
    /// See `from`.
    to: usize,
}

/// Predicts the children of the cells of a line along z or along r.
///
/// - `patch`: components of cells on the level below; `rows`: the line's row and the next ones.
/// - `padded`: components of the children, and how they lie.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
fn predict_line<const N: usize, const ALONG_R: bool, R: Multiresolution>(
    patch: &[f64],
    Line { count, from, to }: Line,
    rows: &[RadialRow],
    odd: &[bool; MOST_IN_FIELD],
    rule: &R,
    (padded, at): (&mut [f64], Frame),
) {
    let (step, child_step) = if ALONG_R { (Patch::<N>::STRIDE, at.stride()) } else { (1, 1) };
    let mut k = 0;
    while k + 4 <= count {
        let rows = if ALONG_R { &rows[k..] } else { rows };
        let (from, to) = (from + k * step, to + 2 * k * child_step);
        predict_some::<N, 4, ALONG_R, R>(patch, from, rows, odd, rule, (&mut *padded, at), to);
        k += 4;
    }
    while k < count {
        let rows = if ALONG_R { &rows[k..] } else { rows };
        let (from, to) = (from + k * step, to + 2 * k * child_step);
        predict_some::<N, 1, ALONG_R, R>(patch, from, rows, odd, rule, (&mut *padded, at), to);
        k += 1;
    }
}

#[inline(always)]
fn predict_some<const N: usize, const L: usize, const ALONG_R: bool, R: Multiresolution>(
    patch: &[f64],
    from: usize,
    rows: &[RadialRow],
    odd: &[bool; MOST_IN_FIELD],
    rule: &R,
    (padded, frame): (&mut [f64], Frame),
    to: usize,
) {
    let (stride, child_stride) = (Patch::<N>::STRIDE, frame.stride());
    let (step, child_step) = if ALONG_R { (stride, child_stride) } else { (1, 1) };
    let rows: &[RadialRow] = &rows[..if ALONG_R { L } else { 1 }];
    let mut means = [[0.0; L]; MOST_COMPONENTS];
    let mut deviations = [[[0.0; L]; 4]; MOST_COMPONENTS];
    let mut components = 0;
    let of_components = means.iter_mut().zip(&mut deviations).zip(odd);
    for (cells, ((means, deviations), odd)) in patch.chunks_exact(Patch::<N>::LEN).zip(of_components) {
        let cells = &cells[from - stride - 1..][..(L - 1) * step + 2 * stride + 3];
        for k in 0..L {
            let three = |row: usize| {
                let at = k * step + row * stride;
                [cells[at], cells[at + 1], cells[at + 2]]
            };
            let weights = rows[if ALONG_R { k } else { 0 }].weights[usize::from(*odd)];
            let four = deviations_among([three(0), three(1), three(2)], weights);
            means[k] = three(1)[1];
            for child in 0..4 {
                deviations[child][k] = four[child];
            }
        }
        components += 1;
    }
    let shares: [f64; L] = std::array::from_fn(|k| {
        let mean: [f64; MOST_COMPONENTS] = std::array::from_fn(|c| means[c][k]);
        let of_children = std::array::from_fn(|child| std::array::from_fn(|c| deviations[c][child][k]));
        rule.share(&mean[..components], &of_children)
    });
    let len = frame.len();
    let following = patch.chunks_exact(Patch::<N>::LEN).zip(padded.chunks_exact_mut(len)).zip(odd);
    for ((cells, children), odd) in following.skip(MOST_COMPONENTS) {
        for k in 0..L {
            let weights = rows[if ALONG_R { k } else { 0 }].weights[usize::from(*odd)];
            let at = from + k * step;
            for (child, deviation) in deviations_of(cells, at, stride, weights).into_iter().enumerate() {
                let place = to + 2 * k * child_step + (child / 2) * child_stride + child % 2;
                children[place] = cells[at] + shares[k] * deviation;
            }
        }
    }
    for ((cells, means), deviations) in padded.chunks_exact_mut(len).zip(&means).zip(&deviations) {
        let cells = &mut cells[to..][..2 * (L - 1) * child_step + child_stride + 2];
        for k in 0..L {
            for b in 0..2 {
                for a in 0..2 {
                    let value = means[k] + shares[k] * deviations[a + 2 * b][k];
                    cells[2 * k * child_step + b * child_stride + a] = value;
                }
            }
        }
    }
}
