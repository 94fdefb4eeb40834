//! Traces of gas in liquid that is under tension: they stay closed.
//!
//! What the closure opens is a bubble's gas, at its interface. Ahead of that advection leaves traces, of one part in a hundred down to
//! nothing, a cell farther with every step. In tension the closure would open them all: gas of 10⁻⁶ takes the whole divergence once its pressure
//! is next to nothing, and hands on traces of its own. Liquid at −1 MPa would be foam soon, and no tension left. In water such nuclei
//! are of less than a micrometre, and surface tension, 2σ/r, holds them.

use super::windows::{LANES, Window};
use crate::Mixture;

/// Which cells of a window hold gas that stays closed: not enough to count as a cavity, and tension in them or beside.
///
/// The gas goes as the liquid does there, as if it were as stiff.
///
/// - `rows`: pressure (Pa) and φ of the padded cells; `stride`: between cells that neighbour each other along r.
#[inline(always)]
pub(super) fn closed(at: Window, rows: [&[f64]; 2], stride: usize, mixture: &Mixture) -> [bool; LANES] {
    let around = [0, -1, 1, -(stride as isize), stride as isize];
    let lesser = |a: f64, b: f64| if a < b { a } else { b };
    let mut lowest = [0.0; LANES];
    for by in around {
        let pressure = at.load(rows[0], by);
        for k in 0..LANES {
            lowest[k] = lesser(lowest[k], pressure[k]);
        }
    }
    let is_tense = lowest.iter().fold(false, |is_tense, p| is_tense | (*p < 0.0));
    if !(is_tense & mixture.has_closed_traces()) {
        return [false; LANES];
    }
    let phi = at.load(rows[1], 0);
    std::array::from_fn(|k| is_closed(lowest[k], phi[k], mixture))
}

/// Whether a state's gas is too little to count as a cavity and under tension: as far as a face, or a cell alone, can tell.
#[inline(always)]
pub(super) fn is_closed(p: f64, phi: f64, mixture: &Mixture) -> bool {
    mixture.has_closed_traces() & (p < 0.0) & !mixture.has_gas_floor(phi)
}

#[cfg(test)]
mod tests {
    use super::*;

    const STRIDE: usize = 12;

    /// Whether the gas of the cell in the middle stays closed.
    ///
    /// - `own`, `beside`: pressure (Pa) and φ of it and of the cell above it; all others are liquid at 1 bar.
    fn middle(own: [f64; 2], beside: [f64; 2], mixture: &Mixture) -> bool {
        let place = 2 * STRIDE + 2;
        let row = |component: usize, all: f64| {
            let mut row = vec![all; 5 * STRIDE];
            row[place] = own[component];
            row[place + STRIDE] = beside[component];
            row
        };
        let (pressures, fractions) = (row(0, 1e5), row(1, 0.0));
        let window = Window { first: place, step: 1, listed: 1 };
        let is_closed = closed(window, [&pressures, &fractions], STRIDE, mixture);
        assert_eq!(
            is_closed[2..],
            [false; LANES - 2],
            "no cell that holds nothing and has no tension beside"
        );
        is_closed[0]
    }

    #[test]
    fn traces_stay_closed_where_there_is_tension() {
        let mixture = Mixture::water_and_air().with_closed_traces();
        for (own, beside, is) in [
            ([-1e5, 1e-6], [1e5, 0.0], true),
            ([1e3, 9e-3], [-1.0, 0.0], true),
            ([1e3, 1e-6], [1e3, 0.0], false),
            ([-1e5, 1.1e-2], [-1e5, 0.0], false),
            ([-1e5, 1e-3], [-1e5, 0.49], true),
            ([1e3, 1e-3], [-1e5, 0.6], true),
        ] {
            assert_eq!(middle(own, beside, &mixture), is, "{own:?} {beside:?}");
        }
        assert!(
            is_closed(-1.0, 9e-3, &mixture)
                && !is_closed(-1.0, 1.1e-2, &mixture)
                && !is_closed(1.0, 0.0, &mixture)
        );
        // The floor lets them: what stays closed may be in tension.
        assert!(mixture.pressure_floor(9e-3) < -1e8 && mixture.pressure_floor(1.1e-2) > 0.0);
    }

    #[test]
    fn other_mixtures_have_no_such_rule() {
        let mixture = Mixture::water_and_air();
        assert!(!middle([-1e5, 1e-6], [-1e5, 0.0], &mixture) && !is_closed(-1.0, 1e-6, &mixture));
        assert!(mixture.pressure_floor(1.1e-3) > 0.0);
    }
}
