//! Traces of gas in liquid that is under tension: they stay closed.
//!
//! What the closure opens is a bubble's gas, at its interface. Ahead of that advection leaves traces, of one part in a hundred down to
//! nothing, a cell farther with every step. In tension the closure would open them all: gas of 10⁻⁶ takes the whole divergence once its pressure
//! is next to nothing, and hands on traces of its own. Liquid at −1 MPa would be foam soon, and no tension left. In water such nuclei
//! are of less than a micrometre, and surface tension, 2σ/r, holds them.

use super::windows::{LANES, Window};
use crate::Mixture;

/// A cell of more gas than this is the inside of a bubble; beside it gas is at an interface.
const INSIDE: f64 = 0.5;

/// Which cells of a window hold gas that stays closed: not enough to count as a cavity, no bubble beside, and tension in
/// them or beside.
///
/// The gas goes as the liquid does there, as if it were as stiff.
///
/// - `rows`: pressure (Pa) and φ of the padded cells; `stride`: between cells that neighbour each other along r.
#[inline(always)]
pub(super) fn closed(at: Window, rows: [&[f64]; 2], stride: usize, mixture: &Mixture) -> [bool; LANES] {
    if !mixture.has_closed_traces() {
        return [false; LANES];
    }
    let along_r = stride as isize;
    let [pressures, fractions] = rows.map(|row| [0, -1, 1, -along_r, along_r].map(|by| at.load(row, by)));
    let mut is_closed = [false; LANES];
    for k in 0..LANES {
        let lowest = pressures
            .iter()
            .fold(f64::INFINITY, |lowest, lane| if lane[k] < lowest { lane[k] } else { lowest });
        let most = fractions.iter().fold(0.0, |most, lane| if lane[k] > most { lane[k] } else { most });
        is_closed[k] = (lowest < 0.0) & (most < INSIDE) & !mixture.has_gas_floor(fractions[0][k]);
    }
    is_closed
}

/// Whether a state's gas is too little to count as a cavity and under tension: as far as a face, or a cell alone, can tell.
#[inline(always)]
pub(super) fn is_closed(p: f64, phi: f64, mixture: &Mixture) -> bool {
    mixture.has_closed_traces() & (p < 0.0) & !mixture.has_gas_floor(phi)
}
