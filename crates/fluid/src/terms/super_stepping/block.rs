//! A block in stages.

use mesh::{GHOSTS, Mesh, Neighbour, Offset, Padded, Side};

use super::levels::{Across, Beyond, blocks_across, face, follow, matched};
use super::rkl2::Stage;
use super::{Frame, Shape, Spreading};
use crate::terms::TermBlock;

/// The product of step and rate of decay, from which on what passes to levels that step by themselves is no more than what one step is stable
/// with: some fifty times as much. Below it fixed ghosts serve, and are right to second order; with twice as much they do not.
const FAR: f64 = 75.0;

/// What stages keep of a block.
#[derive(Debug)]
pub(crate) struct SpreadBlock {
    pub(super) slot: usize,
    frame: Frame,
    /// The numbers of the blocks around it that are in stages, too.
    around: [Option<usize>; 8],
    constants: Vec<f64>,
    /// Blocks of other levels that are in stages, too; and the corners beyond which others are.
    across: Vec<Across>,
    corners: Vec<Offset>,
    /// The sides with fluxes that stages do not change: towards levels that step by themselves, and where they are the side's own.
    fixed_sides: Vec<Side>,
    /// The fluxes through these.
    fixed: Vec<f64>,
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
    /// - `group`: the slots that step together.
    /// - returns: besides it no less than the largest rate of decay in it, 1/s.
    pub fn begin<const N: usize>(
        slot: usize,
        of: &dyn Spreading,
        block: &TermBlock<'_>,
        (mesh, group): (&Mesh<N>, &[bool]),
        work: &mut Vec<f64>,
    ) -> (Self, f64) {
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
        let neighbours = mesh.tree().neighbours(slot);
        // Those beyond sides come first, in the sides' order.
        let is_apart = |side: Side| {
            let beyond = neighbours[side as usize];
            // The finer block of a jump has the larger product.
            let own = if matches!(beyond, Neighbour::Finer(_)) { 2.0 } else { 1.0 };
            own * metric.dt * fastest > FAR && beyond.slots().any(|slot| !group[slot])
        };
        let is_given = |side: Side| sides[side as usize].is_some_and(|kind| of.is_given(kind));
        begun.fixed_sides =
            Side::FOR_GHOSTS.into_iter().filter(|side| is_apart(*side) || is_given(*side)).collect();
        if !begun.fixed_sides.is_empty() {
            begun.fixed.resize(begun.mean.len(), 0.0);
            of.bounded(block, work, &mut begun.fixed);
        }
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
            across: Vec::new(),
            corners: Vec::new(),
            fixed_sides: Vec::new(),
            fixed: Vec::new(),
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
        number_of: impl Fn(usize) -> Option<usize> + Copy,
    ) {
        let neighbours = mesh.tree().neighbours(self.slot);
        self.around = std::array::from_fn(|k| match neighbours[k] {
            Neighbour::Same(slot) => number_of(slot),
            _ => None,
        });
        let is_fixed = |across: &Across| self.fixed_sides.contains(&across.side);
        self.across = blocks_across(mesh, self.slot, number_of).filter(|across| !is_fixed(across)).collect();
        let is_other_level = |k: usize| matches!(neighbours[k], Neighbour::Coarser(_) | Neighbour::Finer(_));
        self.corners = (4..8).filter(|k| is_other_level(*k)).map(|k| Offset::ALL[k]).collect();
    }

    /// The blocks of its own level in stages beyond its high sides.
    pub(super) fn beyond_high_sides(&self) -> impl Iterator<Item = (Side, usize)> {
        [Side::ZMax, Side::RMax].into_iter().filter_map(|side| Some((side, self.around[side as usize]?)))
    }

    /// Takes another one's fluxes on the faces of a side that both have: next to a corner beyond which is another level they see different cells.
    pub(super) fn take_fluxes<const N: usize>(&mut self, of: &dyn Spreading, side: Side, other: &Self) {
        put_faces::<N>((&mut self.now, side), (&other.now, side.opposite()), of.shape().axes);
    }

    /// Whether it has faces in common with finer blocks in stages.
    pub(super) fn has_finer(&self) -> bool {
        self.across.iter().any(|across| matches!(across.blocks, Beyond::Finer(_)))
    }

    /// Finds the fluxes that the variables of the last stage make.
    ///
    /// - `starts`, `last`: the variables of all blocks at first and in the last stage; `number`: of this one.
    pub(super) fn conduct<const N: usize>(
        &mut self,
        of: &dyn Spreading,
        [starts, last]: [&[Vec<f64>]; 2],
        number: usize,
    ) {
        let Self { frame, around, across, corners, fixed_sides, fixed, constants, cells, now, .. } = self;
        cells.copy_from_slice(&last[number]);
        for (offset, other) in Offset::ALL.iter().zip(*around) {
            if let Some(other) = other {
                copy_ghosts::<N>(cells, &last[other], *offset);
            }
        }
        for across in &*across {
            follow::<N>(cells, *across, [starts, last]);
        }
        for corner in &*corners {
            // Only differences along faces look there: it goes with the block's own corner.
            let beyond = [corner.i, corner.j].map(|step| if step < 0 { -1 } else { N as isize });
            let inner = beyond.map(|place| place.clamp(0, N as isize - 1));
            let [to, own] = [beyond, inner].map(|[i, j]| Padded::<N>::index(i, j));
            for row in (0..cells.len()).step_by(Padded::<N>::LEN) {
                cells[row + to] += last[number][row + own] - starts[number][row + own];
            }
        }
        for side in &*fixed_sides {
            // So that along the side, too, cells feel nothing of what is beyond.
            for row in cells.chunks_exact_mut(Padded::<N>::LEN) {
                Padded::<N>::reflect(row, *side, 1.0);
            }
        }
        of.conduct(frame, constants, cells, now);
        for side in &*fixed_sides {
            put_faces::<N>((now, *side), (fixed, *side), of.shape().axes);
        }
    }

    /// Takes the fluxes of finer blocks on faces that it has in common with them.
    ///
    /// - `blocks`: all in stages; `number`: of the one.
    pub(super) fn match_levels<const N: usize>(of: &dyn Spreading, blocks: &mut [Self], number: usize) {
        let Shape { axes, .. } = of.shape();
        let finer = |across: &Across| match across.blocks {
            Beyond::Finer(numbers) => Some((across.side, numbers)),
            Beyond::Coarser { .. } => None,
        };
        let places: Vec<(usize, f64)> = (blocks[number].across.iter().filter_map(finer))
            .flat_map(|(side, numbers)| {
                let fluxes = |number: usize| &blocks[number].now[..];
                matched::<N>(side, numbers, axes, fluxes, |number| &blocks[number].frame.inverse_r[..])
            })
            .collect();
        places.into_iter().for_each(|(place, flux)| blocks[number].now[place] = flux);
    }

    /// Makes a stage with the fluxes that are there: the mean fluxes up to it, and the variables that they leave.
    ///
    /// - `start`: the variables at first; `next`: those after it, written.
    pub(super) fn stage<const N: usize>(
        &mut self,
        of: &dyn Spreading,
        (stage, is_first): (Stage, bool),
        dt: f64,
        start: &[f64],
        next: &mut [f64],
    ) {
        let Self { frame, constants, rates, mean, before, first, now, .. } = self;
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

/// Puts fluxes through one side of a block in the place of those through another, of the same axis; `axes`: of their rows.
fn put_faces<const N: usize>((to, side): (&mut [f64], Side), (from, of): (&[f64], Side), axes: &[usize]) {
    let len = Padded::<N>::LEN;
    let rows = to.chunks_exact_mut(len).zip(from.chunks_exact(len)).zip(axes);
    for ((to, from), _) in rows.filter(|(_, axis)| **axis == side.axis_across()) {
        for along in 0..N {
            to[face::<N>(side, along)] = from[face::<N>(of, along)];
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
