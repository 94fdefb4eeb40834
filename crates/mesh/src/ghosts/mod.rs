//! Filling the ghost cells of one component: from blocks of the same level, from finer ones, beyond the domain.
//!
//! Rows are those of [`crate::Padded`] and [`crate::Patch`]: n × n cells with two layers of ghosts around.

pub(crate) mod assemble;
pub(crate) mod frame;
pub(crate) mod padded;
pub(crate) mod side_faces;
pub(crate) mod side_states;
pub(crate) mod tile_rows;

use std::ops::Range;

use crate::{Frame, GHOSTS, Side};

/// The cells along a side, ghosts at its ends included.
#[inline(always)]
pub(crate) fn ghost_range(n: usize) -> Range<isize> {
    -(GHOSTS as isize)..(n + GHOSTS) as isize
}

/// The range of cells that the ghosts in one direction cover.
#[inline(always)]
pub(crate) fn ghost_span(n: usize, step: i8) -> Range<isize> {
    let (n, g) = (n as isize, GHOSTS as isize);
    match step {
        -1 => -g..0,
        0 => 0..n,
        _ => n..n + g,
    }
}

/// Copies L numbers.
#[inline(always)]
pub(crate) fn copy_row<const L: usize>(row: &mut [f64], to: usize, owner: &[f64], from: usize) {
    let ends = "both are within their blocks";
    *row[to..].first_chunk_mut::<L>().expect(ends) = *owner[from..].first_chunk().expect(ends);
}

/// The mean of four children: along z the plain mean, along r with the lower row's share of the volume. Children
/// that are equal are their own mean exactly.
#[inline(always)]
pub(crate) fn mean([lower, upper]: [[f64; 2]; 2], lower_share: f64) -> f64 {
    let (low, high) = (0.5 * (lower[0] + lower[1]), 0.5 * (upper[0] + upper[1]));
    high + lower_share * (low - high)
}

/// The mean of the 2 × 2 cells of a block whose lower left one is (i, j).
#[inline(always)]
pub(crate) fn mean_of_cells<const N: usize>(block: &[f64], i: usize, j: usize, lower_share: f64) -> f64 {
    let k = j * N + i;
    mean([[block[k], block[k + 1]], [block[k + N], block[k + N + 1]]], lower_share)
}

/// (i, j) of the cell at a depth below a side of n × n cells, 0 for the cell next to it, −1 and −2 for the ghosts beyond; `along` cells
/// from the side's beginning.
#[inline(always)]
pub fn cell_below(n: usize, side: Side, depth: isize, along: isize) -> (isize, isize) {
    let last = n as isize - 1;
    match side {
        Side::ZMin => (depth, along),
        Side::ZMax => (last - depth, along),
        Side::RMin => (along, depth),
        Side::RMax => (along, last - depth),
    }
}

/// Fills the ghosts beyond some cells along a side by reflection, times `parity` (±1).
pub(crate) fn mirror(row: &mut [f64], frame: Frame, side: Side, along: Range<isize>, parity: f64) {
    for layer in 0..GHOSTS as isize {
        for along in along.clone() {
            row[frame.below(side, -1 - layer, along)] = parity * row[frame.below(side, layer, along)];
        }
    }
}

/// Fills the ghosts beyond a side by continuing the inner differences: by the parabola through three cells where the data
/// are smooth, see `continued`.
pub(crate) fn extrapolate(row: &mut [f64], frame: Frame, side: Side) {
    let layers = [-2, -1, 0, 1, 2].map(|depth| frame.below(side, depth, -(GHOSTS as isize)));
    let step = if side.axis_across() == 0 { frame.stride() } else { 1 };
    for along in 0..frame.cells() + 2 * GHOSTS {
        let [beyond, before, first, second, third] = layers.map(|layer| layer + along * step);
        let at_side = row[first];
        let difference = continued(at_side - row[second], row[second] - row[third]);
        row[before] = at_side + difference;
        row[beyond] = at_side + 2.0 * difference;
    }
}

/// The difference beyond a boundary that continues the two within it.
///
/// A parabola continues them by 2·near − far, and the central difference of the boundary cell is then as accurate as
/// those within. At a wall the normal derivative is often zero and near = far/2: the parabola's zero would switch a
/// limited slope off altogether, hence the lower bound. Where the differences grow fast towards the boundary, as behind a
/// front that has just arrived, the farther one counts.
///
/// The lower bound is the least that MC does not limit: with a·near beyond and near within, the central slope (1 + a)/2 near is no
/// more than twice the smaller one, 2a·near, from a = ⅓ on. The upper bound is the one that second-order limiters put on ratios of
/// neighbouring differences (Sweby 1984). Half and twice of them: `docs/verification/constants.md`.
///
/// - `near`, `far`: the differences of the first to the second and of the second to the third cell from the boundary.
/// - returns: zero where the signs of the two differ.
#[inline]
fn continued(near: f64, far: f64) -> f64 {
    const LEAST: f64 = 1.0 / 3.0;
    const MOST: f64 = 2.0;
    let sign = if near > 0.0 { 1.0 } else { -1.0 };
    let (near, far) = (sign * near, sign * far);
    // Comparisons: `max` and `min` take more care of what is no number, and longer.
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let parabola = larger(2.0 * near - far, LEAST * near);
    let most = if parabola < MOST * far { parabola } else { MOST * far };
    sign * larger(most, 0.0)
}

/// Fills the ghosts beyond some cells along a side in the way that prediction needs: by reflection where the component has
/// a parity, else by continuing it.
pub(crate) fn continue_within(
    row: &mut [f64],
    frame: Frame,
    side: Side,
    along: Range<isize>,
    parity: Option<f64>,
) {
    match parity {
        Some(parity) => mirror(row, frame, side, along, parity),
        None => continue_parabola(row, frame, side, along),
    }
}

/// Fills the ghosts beyond some cells along a side by the parabola through the three cells next to it. A linear map, unlike
/// [`Padded::extrapolate`]: prediction must be the same one for all fields; and of prediction's own order, so that
/// the details of smooth fields are no larger here than elsewhere.
fn continue_parabola(row: &mut [f64], frame: Frame, side: Side, along: Range<isize>) {
    for along in along {
        let [first, second, third] = [0, 1, 2].map(|depth| row[frame.below(side, depth, along)]);
        // u(−k) = u₀ + k (u₀ − u₁) + ½k(k + 1) (u₀ − 2u₁ + u₂), exactly u₀ for a constant.
        let (slope, bend) = (first - second, (first - second) - (second - third));
        for layer in 1..=GHOSTS as isize {
            let k = layer as f64;
            row[frame.below(side, -layer, along)] = first + k * slope + 0.5 * k * (k + 1.0) * bend;
        }
    }
}
