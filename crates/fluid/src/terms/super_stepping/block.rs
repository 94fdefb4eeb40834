//! A block in stages.

use mesh::{GHOSTS, Mesh, Neighbour, Offset, Padded};

use super::rkl2::Stage;
use super::{Frame, Shape, Spreading};
use crate::terms::TermBlock;

/// What stages keep of a block.
#[derive(Debug)]
pub(crate) struct SpreadBlock {
    pub(super) slot: usize,
    frame: Frame,
    /// The numbers of the blocks around it that are in stages, too.
    around: [Option<usize>; 8],
    constants: Vec<f64>,
    /// The variables at first; ghosts that no block in stages owns stay what they are here.
    pub(super) start: Vec<f64>,
    /// The variables of the last stage with those of the blocks around, and rates; to work in.
    cells: Vec<f64>,
    rates: Vec<f64>,
    /// Mean fluxes of the last stage and of that before it, and the fluxes at first and of now.
    pub(super) mean: Vec<f64>,
    before: Vec<f64>,
    first: Vec<f64>,
    now: Vec<f64>,
}

impl SpreadBlock {
    /// A block of a slot, at mid-step as waves alone make it.
    ///
    /// - returns: besides it no less than the largest rate of decay in it, 1/s.
    pub fn begin(slot: usize, of: &dyn Spreading, block: &TermBlock<'_>, work: &mut Vec<f64>) -> (Self, f64) {
        let TermBlock { cells, metric, inverse_r, sides, wall, .. } = *block;
        let frame = Frame {
            cells,
            origin: metric.origin,
            stride: metric.stride,
            inverse_h: metric.inverse_h,
            inverse_r: inverse_r.to_vec(),
            sides,
            wall: wall.map(<[_]>::to_vec),
        };
        let mut begun = Self::new(slot, frame, of);
        let fastest = of.begin(block, work, [&mut begun.constants, &mut begun.start]);
        (begun, fastest)
    }

    fn new(slot: usize, frame: Frame, of: &dyn Spreading) -> Self {
        let len = frame.inverse_r.len();
        let zeros = |rows: usize| vec![0.0; rows * len];
        let Shape { variables, constants, axes, .. } = of.shape();
        let fluxes = axes.len();
        Self {
            slot,
            frame,
            around: [None; 8],
            constants: zeros(constants),
            start: zeros(variables),
            cells: zeros(variables),
            rates: zeros(variables),
            mean: zeros(fluxes),
            before: zeros(fluxes),
            first: zeros(fluxes),
            now: zeros(fluxes),
        }
    }

    /// Finds the blocks around it.
    ///
    /// - `number_of`: the number of a slot's block, if it is in stages.
    pub(super) fn find_around<const N: usize>(
        &mut self,
        mesh: &Mesh<N>,
        number_of: impl Fn(usize) -> Option<usize>,
    ) {
        let neighbours = mesh.tree().neighbours(self.slot);
        self.around = std::array::from_fn(|k| match neighbours[k] {
            Neighbour::Same(slot) => number_of(slot),
            _ => None,
        });
    }

    /// Makes a stage: the mean fluxes up to it, and the variables that they leave.
    ///
    /// - `last`: the variables of the last stage of all blocks; `number`: of this one; `next`: its variables, written.
    pub(super) fn stage<const N: usize>(
        &mut self,
        of: &dyn Spreading,
        (stage, is_first): (Stage, bool),
        dt: f64,
        (last, number): (&[Vec<f64>], usize),
        next: &mut [f64],
    ) {
        let Self { frame, around, constants, start, cells, rates, mean, before, first, now, .. } = self;
        cells.copy_from_slice(&last[number]);
        for (offset, other) in Offset::ALL.iter().zip(*around) {
            if let Some(other) = other {
                copy_ghosts::<N>(cells, &last[other], *offset);
            }
        }
        of.conduct(frame, constants, cells, now);
        if is_first {
            first.copy_from_slice(now);
        }
        let fluxes = mean.iter_mut().zip(before.iter_mut()).zip(now.iter().zip(&*first));
        for ((mean, before), (now, first)) in fluxes {
            let next =
                stage.last * *mean + stage.before * *before + (stage.fluxes * now + stage.first * first);
            (*before, *mean) = (*mean, next);
        }
        of.change(frame, constants, mean, rates);
        let len = frame.inverse_r.len();
        for at in (0..start.len()).step_by(len) {
            for j in 0..N as isize {
                let k = at + Padded::<N>::index(0, j);
                let row = next[k..k + N].iter_mut().zip(&start[k..k + N]).zip(&rates[k..k + N]);
                row.for_each(|((next, start), rate)| *next = start + dt * rate);
            }
        }
    }
}

/// The ghosts in one direction, and where they are in the block that owns them.
pub(super) fn ghosts<const N: usize>(
    offset: Offset,
    layers: isize,
) -> impl Iterator<Item = ([isize; 2], [isize; 2])> {
    let n = N as isize;
    let span = move |step: i8| match step {
        -1 => -layers..0,
        0 => 0..n,
        _ => n..n + layers,
    };
    let [i, j] = [offset.i, offset.j].map(|step| isize::from(step) * n);
    span(offset.j).flat_map(move |y| span(offset.i).map(move |x| ([x, y], [x - i, y - j])))
}

fn copy_ghosts<const N: usize>(rows: &mut [f64], owner: &[f64], offset: Offset) {
    let len = Padded::<N>::LEN;
    for ([i, j], [x, y]) in ghosts::<N>(offset, GHOSTS as isize) {
        let (to, from) = (Padded::<N>::index(i, j), Padded::<N>::index(x, y));
        for row in (0..rows.len()).step_by(len) {
            rows[row + to] = owner[row + from];
        }
    }
}
