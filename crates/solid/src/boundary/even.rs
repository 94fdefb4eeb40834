//! Slopes of the cells next to the axis and to planes of symmetry.

use mesh::{Frame, Limiter, Side};

/// Sets the first ghosts beyond a mirror so that limiters find the slopes of even functions in the cells next to it.
///
/// The velocity along a mirror and the normal stresses are even about it. To a limiter the mirror image makes an extremum of the
/// cell beside it, which it clips to no slope at all. Half of the difference to the next cell is the slope of the parabola with its
/// vertex on the mirror: A + Bx² rises by Bh² across the first cell, and by 2Bh² from its mean to the second one's, about an axis and
/// beside a plane.
///
/// Where the difference to the third cell is smaller, as beside a front, it counts instead, and none where it has another sign.
///
/// - `limiter`: of the slopes; without one the mirror images lead to that slope themselves.
/// - `row`: a component whose ghosts are mirror images.
pub(super) fn lead_to_even_slopes(limiter: Limiter, row: &mut [f64], frame: Frame, side: Side) {
    // The lower one of two differences of which the limiter makes half the upper one.
    let share = match limiter {
        Limiter::Mc => 0.25,
        Limiter::Minmod | Limiter::Eno => 0.5,
        Limiter::None => return,
    };
    for along in -1..=frame.cells() as isize {
        let [first, second, third] = [0, 1, 2].map(|depth| row[frame.below(side, depth, along)]);
        let even = Limiter::Minmod.difference(second - first, third - second);
        row[frame.below(side, -1, along)] = first - share * even;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The slope in the first cell of a row of cells that begins on a mirror.
    fn slope(limiter: Limiter, side: Side, cells: [f64; 3]) -> f64 {
        let frame = Frame::of(4);
        let mut row = vec![0.0; frame.len()];
        for along in -2..6 {
            for depth in 0..4 {
                row[frame.below(side, depth, along)] = cells[depth.min(2) as usize];
            }
        }
        frame.reflect(&mut row, side, 1.0);
        lead_to_even_slopes(limiter, &mut row, frame, side);
        let at = |depth| row[frame.below(side, depth, 1)];
        limiter.difference(at(0) - at(-1), at(1) - at(0))
    }

    #[test]
    fn limiters_find_the_slope_of_an_even_parabola() {
        // Means of 3 − 5 x², about an axis and beside a plane.
        let about_axis = [0.5, 2.5, 6.5].map(|mean| 3.0 - 5.0 * mean);
        let beside_plane = [1.0, 7.0, 19.0].map(|mean| 3.0 - 5.0 * mean / 3.0);
        for (name, limiter) in Limiter::NAMES {
            for side in Side::ALL {
                for cells in [about_axis, beside_plane] {
                    let found = slope(limiter, side, cells);
                    assert!((found + 5.0).abs() < 1e-14, "{name} {side:?}: {found}");
                }
            }
        }
    }

    #[test]
    fn beside_fronts_and_crests_slopes_stay_small() {
        for limiter in [Limiter::Mc, Limiter::Minmod, Limiter::Eno] {
            assert_eq!(slope(limiter, Side::RMin, [0.0, 1.0, 1.0]), 0.0, "a front on the first face");
            assert_eq!(slope(limiter, Side::RMin, [0.0, 1.0, 0.5]), 0.0, "a crest in the second cell");
            assert_eq!(slope(limiter, Side::RMin, [0.0, 0.0, 1.0]), 0.0, "a front on the second face");
            assert_eq!(slope(limiter, Side::RMin, [0.0, 1.0, 1.25]), 0.125, "behind a front");
        }
    }
}
