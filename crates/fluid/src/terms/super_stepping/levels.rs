//! What passes between blocks of two levels that are in stages together.

use mesh::{Mesh, Neighbour, Padded, Side, cell_below};

/// The blocks of another level beyond a side, by their numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Across {
    pub side: Side,
    pub blocks: Beyond,
}

/// What is beyond a side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Beyond {
    /// A block one level coarser, and which half of its side.
    Coarser { number: usize, half: usize },
    /// Two blocks one level finer, in the order along the side; `None` for one that is not in stages.
    Finer([Option<usize>; 2]),
}

/// The blocks of other levels around that of a slot; `number_of`: of a slot's block, if it is in stages.
pub(super) fn blocks_across<const N: usize>(
    mesh: &Mesh<N>,
    slot: usize,
    number_of: impl Fn(usize) -> Option<usize>,
) -> impl Iterator<Item = Across> {
    let (neighbours, id) = (mesh.tree().neighbours(slot), mesh.tree().leaves()[slot]);
    Side::FOR_GHOSTS.into_iter().filter_map(move |side| {
        let blocks = match neighbours[side as usize] {
            Neighbour::Coarser(slot) => {
                let place = [id.i, id.j][1 - side.axis_across()];
                Beyond::Coarser { number: number_of(slot)?, half: place as usize % 2 }
            }
            Neighbour::Finer(slots) => {
                let numbers = slots.map(&number_of);
                numbers.iter().any(Option::is_some).then_some(Beyond::Finer(numbers))?
            }
            Neighbour::Same(_) | Neighbour::Boundary => return None,
        };
        Some(Across { side, blocks })
    })
}

/// Lets the first ghosts beyond a side go with the cells that they are of: by what those, or their mean, have changed since the start.
///
/// So the ghosts keep the second order that they had at first, and what passes is symmetric: the stages remain stable.
///
/// - `rows`: of the block, with the ghosts of the start; `starts`, `last`: of all blocks at first and in the last stage.
pub(super) fn follow<const N: usize>(rows: &mut [f64], across: Across, [starts, last]: [&[Vec<f64>]; 2]) {
    let (len, opposite) = (Padded::<N>::LEN, across.side.opposite());
    let index = |side: Side, depth: isize, along: usize| {
        let (i, j) = cell_below(N, side, depth, along as isize);
        Padded::<N>::index(i, j)
    };
    for row in (0..rows.len()).step_by(len) {
        let gained = |number: usize, k: usize| last[number][row + k] - starts[number][row + k];
        for along in 0..N {
            let gain = match across.blocks {
                Beyond::Coarser { number, half } => {
                    gained(number, index(opposite, 0, (half * N + along) / 2))
                }
                Beyond::Finer(numbers) => {
                    let (Some(number), first) = finer::<N>(numbers, along) else { continue };
                    let of = |depth: isize, along: usize| gained(number, index(opposite, depth, along));
                    0.25 * ((of(0, first) + of(0, first + 1)) + (of(1, first) + of(1, first + 1)))
                }
            };
            rows[row + index(across.side, -1, along)] += gain;
        }
    }
}

/// Which of two finer blocks beyond a side is beside a cell, and the first of its two cells there.
fn finer<const N: usize>(numbers: [Option<usize>; 2], along: usize) -> (Option<usize>, usize) {
    (numbers[2 * along / N], 2 * along % N)
}

/// The fluxes through a coarse block's faces towards two finer ones: the means of theirs by area, so that what leaves one enters the other.
///
/// - `fluxes`: of a block by its number, row after row; `axes`: of the rows; `inverse_r`: 1/r of its padded cells, 0 in a plane.
/// - returns: places in the rows, and fluxes.
pub(super) fn matched<'b, const N: usize>(
    side: Side,
    numbers: [Option<usize>; 2],
    axes: &[usize],
    fluxes: impl Fn(usize) -> &'b [f64],
    inverse_r: impl Fn(usize) -> &'b [f64],
) -> Vec<(usize, f64)> {
    let (len, opposite) = (Padded::<N>::LEN, side.opposite());
    let mut found = Vec::new();
    let of_side = axes.iter().enumerate().filter(|(_, axis)| **axis == side.axis_across());
    for (row, _) in of_side {
        for along in 0..N {
            let (Some(number), first) = finer::<N>(numbers, along) else { continue };
            let [one, other] = [first, first + 1].map(|along| {
                let inner = cell_below(N, opposite, 0, along as isize);
                let inverse_r = inverse_r(number)[Padded::<N>::index(inner.0, inner.1)];
                // Faces along z are rings.
                let area = if side.axis_across() == 0 && inverse_r > 0.0 { 1.0 / inverse_r } else { 1.0 };
                (fluxes(number)[row * len + face::<N>(opposite, along)], area)
            });
            let mean = (one.0 * one.1 + other.0 * other.1) / (one.1 + other.1);
            found.push((row * len + face::<N>(side, along), mean));
        }
    }
    found
}

/// The place of a face on a side of a block: faces are named by the cell below, on a low side a ghost.
pub(super) fn face<const N: usize>(side: Side, along: usize) -> usize {
    let depth = if matches!(side, Side::ZMin | Side::RMin) { -1 } else { 0 };
    let (i, j) = cell_below(N, side, depth, along as isize);
    Padded::<N>::index(i, j)
}
