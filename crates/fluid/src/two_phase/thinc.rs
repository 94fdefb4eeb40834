//! THINC: the gas fraction on the faces of a cell as a step that keeps its width.

use super::closure::THIN;
use mesh::{exp_and_less_one, ln_of};

/// Steepness of the step: three quarters of it lie in one cell. Above 2.5 the time step collapses after a focus; 1.6
/// is safe and blunter.
const STEEPNESS: f64 = 2.0;

/// The normal's share below which a direction has no step to reconstruct.
const OBLIQUE: f64 = 0.05;

/// What a step across one cell has on its faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Faces {
    /// Whether there is a step; a pure cell, an extremum, or an interface along the direction has none.
    pub is_step: bool,
    /// The gas fraction that crosses the lower and the upper face: the mean over what flows out through it, else the
    /// value there.
    pub lower: f64,
    /// See `lower`.
    pub upper: f64,
}

/// The step through a cell along one direction: H(x) = m + D/2 (1 + tanh(b (x − x₀))), x in [0, 1] up the gradient.
///
/// Xiao, Honma & Kono (2005), with the steepness b = β|n| + 0.01 of Xiao, Ii & Chen (2011) for the component n of the
/// interface's normal along the direction. x₀ is such that the mean of H is the cell's. A falling step is a rising one
/// seen in a mirror, so that mirrored starts stay mirrored to the last bit.
///
/// With C = (φ − m)/D, Y = exp(2b) and X = exp(2bC), E = exp(2b x₀) = (Y − X)/(X − 1); so the hyperbolic functions need no
/// more exponentials than these. The mean over a width w next to a face is made of ∫ tanh = ln cosh/b,
///
/// cosh(b(w − x₀))/cosh(bx₀) = exp(−bw) (exp(2bw) + E)/(1 + E) and cosh(b(1 − w − x₀))/cosh(b(1 − x₀)) =
/// exp(bw) (Y exp(−2bw) + E)/(Y + E).
///
/// Without branches, so that rows of cells vectorise.
///
/// - `below`, `phi`, `above`: gas fractions of the cell and its neighbours along the direction.
/// - `normal`: the component of the unit normal ∇φ/|∇φ| along the direction.
/// - `courant`: uΔt/h of the cell along the direction.
#[inline(always)]
pub(crate) fn faces(below: f64, phi: f64, above: f64, normal: f64, courant: f64) -> Faces {
    let slant = normal.abs();
    let is_sharp = is_step(below, phi, above, normal);
    let is_falling = above < below;
    let (lowest, highest) = if is_falling { (above, below) } else { (below, above) };
    let b = STEEPNESS * slant + 0.01;
    let height = highest - lowest;
    // Of cells without a step nothing is used, but the numbers should be some.
    let c = if is_sharp { (phi - lowest) / height } else { 0.5 };
    // (Y − X)/(X − 1) without loss of digits where C is near 0 or 1.
    let (left, left_less_one) = exp_and_less_one(2.0 * b * c);
    let (right, right_less_one) = exp_and_less_one(2.0 * b * (1.0 - c));
    let middle = left * right_less_one / left_less_one;
    let across = left * right;

    let (per_bottom, per_top) = (1.0 / (1.0 + middle), 1.0 / (across + middle));
    let (bottom, top) = ((1.0 - middle) * per_bottom, (across - middle) * per_top);
    // Fluid leaves through the face where H is highest, or where it is lowest.
    let is_from_top = (courant > 0.0) != is_falling;
    let width = if courant.abs() < MOST_SWEPT { courant.abs() } else { MOST_SWEPT };
    let sign = if is_from_top { -1.0 } else { 1.0 };
    let (_, less_one) = exp_and_less_one(sign * (2.0 * b * width));
    let change = less_one * if is_from_top { across * per_top } else { per_bottom };
    let mean = sign * ln_of(1.0 + change, change) / (b * width) - 1.0;
    let is_swept = width >= POINT;
    let bottom = if is_swept & !is_from_top { mean } else { bottom };
    let top = if is_swept & is_from_top { mean } else { top };
    let at = |rise: f64| lowest + 0.5 * height * (1.0 + rise);
    let (bottom, top) = (at(bottom), at(top));
    Faces {
        // A mean that is one of the neighbours' but for round-off has its step at infinity.
        is_step: is_sharp & (middle > 0.0) & (middle < f64::MAX),
        lower: if is_falling { top } else { bottom },
        upper: if is_falling { bottom } else { top },
    }
}

/// Whether there may be a step: [`faces`] finds none where this is false.
#[inline(always)]
pub(crate) fn is_step(below: f64, phi: f64, above: f64, normal: f64) -> bool {
    (phi > THIN) & (phi < 1.0 - THIN) & ((above - phi) * (phi - below) > 0.0) & (normal.abs() > OBLIQUE)
}

/// The largest part of a cell that is taken to leave it in a step.
const MOST_SWEPT: f64 = 0.9;

/// Width below which a mean is the value on the face.
const POINT: f64 = 1e-5;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_means_over_both_parts_of_a_cell_are_the_cells() {
        for (below, phi, above) in [(0.0, 0.3, 1.0), (1.0, 0.3, 0.0), (0.1, 0.8, 0.9), (1.0, 0.999, 0.2)] {
            for normal in [1.0, -0.6, 0.06] {
                for width in [0.2, 0.5, 0.8] {
                    let (out, rest) = (
                        faces(below, phi, above, normal, width),
                        faces(below, phi, above, normal, width - 1.0),
                    );
                    assert!(out.is_step && rest.is_step);
                    let whole = width * out.upper + (1.0 - width) * rest.lower;
                    approx::assert_relative_eq!(whole, phi, max_relative = 1e-12);
                    let (low, high) = (below.min(above), below.max(above));
                    for value in [out.lower, out.upper, rest.lower, rest.upper] {
                        assert!(value >= low && value <= high, "{value}");
                    }
                }
            }
        }
    }

    #[test]
    fn it_is_steeper_than_a_line_and_rises_with_its_neighbours() {
        let rising = faces(0.0, 0.5, 1.0, 1.0, 0.0);
        // The central difference has 0.25 and 0.75 there.
        assert!(rising.lower < 0.12 && rising.upper > 0.88, "{rising:?}");
        let falling = faces(1.0, 0.5, 0.0, 1.0, 0.0);
        assert_eq!((falling.lower, falling.upper), (rising.upper, rising.lower));
    }

    #[test]
    fn mirrored_flow_has_mirrored_faces() {
        for courant in [0.0, 1e-6, 0.3, -0.3, 2.0] {
            let (one, other) = (faces(0.1, 0.4, 0.9, 0.8, courant), faces(0.9, 0.4, 0.1, -0.8, -courant));
            assert_eq!((one.lower, one.upper), (other.upper, other.lower));
        }
    }

    #[test]
    fn what_is_swept_out_is_a_mean_between_the_face_and_the_cell() {
        let at = |courant: f64| faces(0.0, 0.4, 1.0, 1.0, courant);
        let (point, swept) = (at(0.0).upper, at(0.4).upper);
        assert!(swept < point && swept > 0.4);
        // Inflow sees the value on the face.
        assert_eq!(at(-0.4).upper, point);
        // Short sweeps tend to the point value without a jump where the formula changes.
        assert!((at(0.9e-5).upper - at(1.1e-5).upper).abs() < 1e-5);
    }

    #[test]
    fn pure_cells_extrema_and_oblique_interfaces_have_none() {
        for (below, phi, above, normal) in [
            (0.0, 1e-5, 1.0, 1.0),
            (0.0, 1.0 - 1e-5, 1.0, 1.0),
            (0.6, 0.5, 0.6, 1.0),
            (0.0, 0.5, 1.0, 0.04),
            (0.0, 0.5, 1.0, f64::NAN),
        ] {
            assert!(!faces(below, phi, above, normal, 0.1).is_step);
        }
    }
}
