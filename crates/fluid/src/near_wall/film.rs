//! The film of liquid between gas and wall.

use mesh::{Field, Mesh};
use serde::{Deserialize, Serialize};

use super::Rectangle;
use crate::FluidSolver;
use crate::state::conserved::PHI;

/// Slope of the interface, dz/dr, above which what is between gas and wall is a wedge, and no film.
const SLOPE: f64 = 0.5;

/// What is between the gas and the wall at a radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Column {
    /// Range of r, m.
    pub r: [f64; 2],
    /// From the wall to the gas, m.
    pub thickness: f64,
    /// Width of the cells there along z, m.
    pub cell: f64,
}

impl Column {
    /// Whether part of the film is in a rectangle.
    pub fn is_in(&self, block: &Rectangle, wall: f64) -> bool {
        self.r[0] < block.high[1] && self.r[1] > block.low[1] && block.low[0] < wall + self.thickness
    }
}

/// The film column by column, where there is one: liquid on the wall and gas above it, with an interface that is about parallel to the
/// wall, |dz/dr| at most [`SLOPE`].
///
/// The thickness is where φ = ½ along z, by linear interpolation between the cells' centres.
///
/// - `blocks`: slots of those along the wall; `most`: how thick a film may be to be one, m.
pub(crate) fn columns<const N: usize>(
    (mesh, field): (&Mesh<N>, &Field),
    blocks: &[usize],
    most: impl Fn(usize) -> f64,
) -> Vec<Column> {
    let mut columns = Vec::new();
    for &slot in blocks {
        let id = mesh.tree().leaves()[slot];
        let (low, [h_z, h_r]) = (mesh.origin(id)[1], mesh.widths(id.level));
        let thickness: [Option<f64>; N] =
            std::array::from_fn(|j| below_gas((mesh, field), slot, j, most(slot)));
        for (j, own) in thickness.iter().enumerate() {
            let Some(thickness_here) = *own else { continue };
            let around =
                [j.checked_sub(1).and_then(|j| thickness[j]), thickness.get(j + 1).copied().flatten()];
            // At the edge of a block, or of the gas, the difference to one side.
            let change = match around {
                [Some(before), Some(after)] => 0.5 * (after - before),
                [Some(before), None] => thickness_here - before,
                [None, Some(after)] => after - thickness_here,
                [None, None] => continue,
            };
            if change.abs() <= SLOPE * h_r {
                let r = [low + j as f64 * h_r, low + (j + 1) as f64 * h_r];
                columns.push(Column { r, thickness: thickness_here, cell: h_z });
            }
        }
    }
    columns
}

/// From the wall to the first gas above row `j` of a block on the wall, m; `None` if there is gas on the wall, or none up to `most`.
fn below_gas<const N: usize>(
    (mesh, field): (&Mesh<N>, &Field),
    slot: usize,
    j: usize,
    most: f64,
) -> Option<f64> {
    let wall = mesh.domain().z[0];
    let (mut slot, mut row) = (slot, j);
    // Height and gas fraction of the cell before.
    let mut below: Option<[f64; 2]> = None;
    loop {
        let id = mesh.tree().leaves()[slot];
        let (first, [h_z, _]) = (mesh.centre(id, 0, row), mesh.widths(id.level));
        let phi = &field.component(slot, PHI)[row * N..][..N];
        for (i, &phi) in phi.iter().enumerate() {
            let height = first[0] - wall + i as f64 * h_z;
            if phi >= 0.5 {
                let [before, least] = below?;
                return Some(before + (height - before) * (0.5 - least) / (phi - least));
            }
            if height > most {
                return None;
            }
            below = Some([height, phi]);
        }
        // On in the block above, whatever its level.
        (slot, _, row) = mesh.locate([first[0] + N as f64 * h_z, first[1]])?;
    }
}

/// The film of liquid between gas and wall at a radius.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Film {
    /// From the wall to the gas, m.
    pub thickness: f64,
    /// Width of the cells along z, m.
    pub cell: f64,
    /// Where it is, m.
    pub radius: f64,
}

impl Film {
    /// Cells across it.
    pub fn cells(&self) -> f64 {
        self.thickness / self.cell
    }
}

impl<const N: usize> FluidSolver<N> {
    /// The film between gas and wall where it has the fewest cells, if there is one of less than a block's cells; and whether gas lies
    /// on the wall. Neither where z_min is no wall.
    ///
    /// Where the interface is steeper than 1 to 2 against the wall, it is a wedge and no film.
    pub fn film(&self) -> (Option<Film>, bool) {
        if !self.model().has_wall() {
            return (None, false);
        }
        let with_gas: Vec<usize> =
            self.interface().blocks().iter().copied().filter(|slot| self.model().has_gas[*slot]).collect();
        let columns = columns((self.mesh(), self.state()), &with_gas, |slot| {
            N as f64 * self.mesh().widths(self.mesh().tree().leaves()[slot].level)[0]
        });
        let films = columns.iter().map(|column| Film {
            thickness: column.thickness,
            cell: column.cell,
            radius: 0.5 * (column.r[0] + column.r[1]),
        });
        let is_on_wall = |slot: &usize| {
            let phi = self.component(*slot, PHI);
            phi.iter().step_by(N).any(|phi| *phi >= 0.5)
        };
        (films.min_by(|a, b| a.cells().total_cmp(&b.cells())), with_gas.iter().any(is_on_wall))
    }
}
