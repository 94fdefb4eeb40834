//! Where shocks are.

use mesh::{Field, Mesh};

use super::Rectangle;
use crate::Mixture;
use crate::state::primitive::{GAS, PHI, PRESSURE, V_R, V_Z};
use crate::state::{ConservedCell, primitive_of};

/// Rise of the pressure from one cell to the next that makes a shock, relative to the lower one of the two or to the reference
/// pressure, whichever is larger. A front of 2.5 cells has a third to a half of its whole in one step: this finds shocks of half the
/// reference pressure and more. Colella & Woodward (1984) ask for a third over two cells.
const STEEP: f64 = 0.2;

/// Cells of margin around what is steep, of the level `base`: the wake of a front is not smooth at once.
const MARGIN: f64 = 2.0;

/// The rectangles around the compressed, steep places of each block, grown by what waves travel until the marks are made anew.
///
/// Neighbouring cells of liquid count that move towards each other and whose pressures differ by [`STEEP`] or more.
///
/// - `reference`: pressure below which nothing is steep, Pa; `farthest`: z beyond which nobody asks, m; `widths`: of the cells of
///   level `base`, m; `travel`: see [`super::demanded_levels`].
pub(crate) fn steep_places<const N: usize>(
    (mesh, field, mixture): (&Mesh<N>, &Field, &Mixture),
    base: u8,
    farthest: f64,
    reference: f64,
    travel: &(dyn Fn(usize) -> f64 + Sync),
) -> Vec<Rectangle> {
    let leaves = mesh.tree().leaves().iter().enumerate();
    let near = leaves.filter(|(_, id)| id.level >= base && mesh.origin(**id)[0] < farthest);
    let of_block = |(slot, id): (usize, &mesh::BlockId)| {
        let [low, high] = steep_cells::<N>(field.block(slot), mixture, reference)?;
        let (origin, own, coarse) = (mesh.origin(*id), mesh.widths(id.level), mesh.widths(base));
        let grown = |axis: usize| travel(slot) * own[axis] + MARGIN * coarse[axis];
        let at = |axis: usize, cell: usize| origin[axis] + cell as f64 * own[axis];
        Some(Rectangle {
            low: [0, 1].map(|axis| at(axis, low[axis]) - grown(axis)),
            high: [0, 1].map(|axis| at(axis, high[axis] + 1) + grown(axis)),
        })
    };
    near.filter_map(of_block).collect()
}

/// The first and the last cell (i, j) of the smallest rectangle around what is steep in a block; `None` if nothing is.
fn steep_cells<const N: usize>(block: &[f64], mixture: &Mixture, reference: f64) -> Option<[[usize; 2]; 2]> {
    // Models whose phases have no masses of their own have no covolumes, either.
    let gas = |cell: usize| if mixture.has_covolume() { block[GAS * N * N + cell] } else { 0.0 };
    let at = |i: usize, j: usize| {
        let cell: ConservedCell = std::array::from_fn(|c| block[c * N * N + j * N + i]);
        primitive_of::<true>(cell, gas(j * N + i), mixture)
    };
    let mut found: Option<[[usize; 2]; 2]> = None;
    for j in 0..N {
        for i in 0..N {
            let here = at(i, j);
            let pairs = [(i + 1 < N).then(|| (at(i + 1, j), V_Z)), (j + 1 < N).then(|| (at(i, j + 1), V_R))];
            let is_steep = |(next, velocity): &([f64; 5], usize)| {
                let [lower, upper] = [here[PRESSURE].min(next[PRESSURE]), here[PRESSURE].max(next[PRESSURE])];
                here[PHI].max(next[PHI]) < 0.5
                    && next[*velocity] < here[*velocity]
                    && upper - lower > STEEP * lower.max(reference)
            };
            if pairs.iter().flatten().any(is_steep) {
                let [low, high] = found.unwrap_or([[i, j]; 2]);
                let last = [(i + 1).min(N - 1), (j + 1).min(N - 1)];
                found = Some([[low[0].min(i), low[1].min(j)], [high[0].max(last[0]), high[1].max(last[1])]]);
            }
        }
    }
    found
}
