//! THINC: the gas fraction on the faces of a cell as a step that keeps its width.

use crate::elementary::{exp_and_less_one, ln_of};

/// Steepness of the step: three quarters of it lie in one cell. Above 2.5 the time step collapses after a focus; 1.6
/// is safe and blunter.
const STEEPNESS: f64 = 2.0;

/// The normal's share below which a direction has no step to reconstruct.
const OBLIQUE: f64 = 0.05;

/// Gas fractions nearer than this to 0 or 1 have no step in them.
const RANGE: f64 = 1e-4;

/// A step across one cell along one direction: H(x) = m + D/2 (1 + tanh(b (x − x₀))), x in [0, 1] up the gradient.
///
/// Xiao, Honma & Kono (2005), with the steepness b = β|n| + 0.01 of Xiao, Ii & Chen (2011) for the component n of the
/// interface's normal along the direction. x₀ is such that the mean of H is the cell's. A falling step is a rising one
/// seen in a mirror, so that mirrored starts stay mirrored to the last bit.
///
/// With C = (φ − m)/D, Y = exp(2b) and X = exp(2bC), exp(2b x₀) = E = (Y − X)/(X − 1); so the hyperbolic functions need no
/// more exponentials than these.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Step {
    lowest: f64,
    height: f64,
    steepness: f64,
    /// exp(2b).
    across: f64,
    /// exp(2b x₀).
    middle: f64,
    is_falling: bool,
}

impl Step {
    /// The step through a cell, or `None` where there is none: a pure cell, an extremum, or an interface along the
    /// direction.
    ///
    /// - `below`, `phi`, `above`: gas fractions of the cell and its neighbours along the direction.
    /// - `normal`: the component of the unit normal ∇φ/|∇φ| along the direction.
    pub fn through(below: f64, phi: f64, above: f64, normal: f64) -> Option<Self> {
        let is_monotone = (above - phi) * (phi - below) > 0.0;
        if !(phi > RANGE && phi < 1.0 - RANGE && is_monotone && normal.abs() > OBLIQUE) {
            return None;
        }
        let is_falling = above < below;
        let (lowest, highest) = if is_falling { (above, below) } else { (below, above) };
        let b = STEEPNESS * normal.abs() + 0.01;
        let height = highest - lowest;
        let c = (phi - lowest) / height;
        // (Y − X)/(X − 1) without loss of digits where C is near 0 or 1.
        let (lower, lower_less_one) = exp_and_less_one(2.0 * b * c);
        let (upper, upper_less_one) = exp_and_less_one(2.0 * b * (1.0 - c));
        let middle = lower * upper_less_one / lower_less_one;
        // A mean that is one of the neighbours' but for round-off has its step at infinity.
        (middle > 0.0 && middle < f64::MAX).then_some(Self {
            lowest,
            height,
            steepness: b,
            across: lower * upper,
            middle,
            is_falling,
        })
    }

    /// H from the part of its rise in [−1, 1].
    fn at(&self, rise: f64) -> f64 {
        self.lowest + 0.5 * self.height * (1.0 + rise)
    }

    /// The mean of H over the uppermost part of the cell of width `width` = w, or its value on the face:
    /// ∫ tanh = ln cosh/b, and cosh(b(1 − x₀))/cosh(b(1 − w − x₀)) = exp(−bw) (Y + E)/(Y exp(−2bw) + E).
    fn uppermost(&self, width: f64) -> f64 {
        let Self { steepness: b, across, middle, .. } = *self;
        self.at(if width < POINT {
            (across - middle) / (across + middle)
        } else {
            let (_, less_one) = exp_and_less_one(-2.0 * b * width);
            -1.0 - ln_one_plus(across * less_one / (across + middle)) / (b * width)
        })
    }

    /// As [`Step::uppermost`], of the lowermost part: cosh(b(w − x₀))/cosh(bx₀) = exp(−bw) (exp(2bw) + E)/(1 + E).
    fn lowermost(&self, width: f64) -> f64 {
        let Self { steepness: b, middle, .. } = *self;
        self.at(if width < POINT {
            (1.0 - middle) / (1.0 + middle)
        } else {
            let (_, less_one) = exp_and_less_one(2.0 * b * width);
            ln_one_plus(less_one / (1.0 + middle)) / (b * width) - 1.0
        })
    }

    /// The gas fraction that crosses the lower face: the mean over what flows out through it, else the value there.
    ///
    /// - `courant`: uΔt/h of the cell along the direction.
    pub fn lower(&self, courant: f64) -> f64 {
        if self.is_falling { self.foremost(-courant) } else { self.hindmost(-courant) }
    }

    /// As [`Step::lower`], of the upper face.
    pub fn upper(&self, courant: f64) -> f64 {
        if self.is_falling { self.hindmost(courant) } else { self.foremost(courant) }
    }

    /// On the face where H is highest, with outflow at Courant number `out`.
    fn foremost(&self, out: f64) -> f64 {
        self.uppermost(out.clamp(0.0, MOST_SWEPT))
    }

    /// On the face where H is lowest.
    fn hindmost(&self, out: f64) -> f64 {
        self.lowermost(out.clamp(0.0, MOST_SWEPT))
    }
}

/// The largest part of a cell that is taken to leave it in a step.
const MOST_SWEPT: f64 = 0.9;

/// Width below which a mean is the value on the face.
const POINT: f64 = 1e-5;

fn ln_one_plus(x: f64) -> f64 {
    ln_of(1.0 + x, x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_over_the_cell_is_the_cells() {
        for (below, phi, above) in [(0.0, 0.3, 1.0), (1.0, 0.3, 0.0), (0.1, 0.8, 0.9), (1.0, 0.999, 0.2)] {
            for normal in [1.0, -0.6, 0.06] {
                let step = Step::through(below, phi, above, normal).unwrap();
                approx::assert_relative_eq!(step.lowermost(1.0), phi, max_relative = 1e-12);
                approx::assert_relative_eq!(step.uppermost(1.0), phi, max_relative = 1e-12);
                let (low, high) = (below.min(above), below.max(above));
                for value in [step.lower(0.3), step.lower(-0.3), step.upper(0.3), step.upper(0.0)] {
                    assert!(value >= low && value <= high, "{value}");
                }
            }
        }
    }

    #[test]
    fn it_is_steeper_than_a_line_and_rises_with_its_neighbours() {
        let step = Step::through(0.0, 0.5, 1.0, 1.0).unwrap();
        // The central difference has 0.25 and 0.75 there.
        assert!(step.lower(0.0) < 0.12 && step.upper(0.0) > 0.88, "{} {}", step.lower(0.0), step.upper(0.0));
        let falling = Step::through(1.0, 0.5, 0.0, 1.0).unwrap();
        approx::assert_relative_eq!(falling.lower(0.0), step.upper(0.0), max_relative = 1e-14);
    }

    #[test]
    fn what_is_swept_out_is_a_mean_between_the_face_and_the_cell() {
        let step = Step::through(0.0, 0.4, 1.0, 1.0).unwrap();
        let (point, swept) = (step.upper(0.0), step.upper(0.4));
        assert!(swept < point && swept > 0.4);
        // Inflow sees the value on the face.
        assert_eq!(step.upper(-0.4), point);
        // The swept means of both faces and of what stays add up to the cell.
        let stays = step.lowermost(0.6);
        approx::assert_relative_eq!(0.4 * swept + 0.6 * stays, 0.4, max_relative = 1e-12);
        // Short sweeps tend to the point value without a jump where the formula changes.
        assert!((step.upper(0.9e-5) - step.upper(1.1e-5)).abs() < 1e-5);
    }

    #[test]
    fn pure_cells_extrema_and_oblique_interfaces_have_none() {
        assert_eq!(Step::through(0.0, 1e-5, 1.0, 1.0), None);
        assert_eq!(Step::through(0.0, 1.0 - 1e-5, 1.0, 1.0), None);
        assert_eq!(Step::through(0.6, 0.5, 0.6, 1.0), None);
        assert_eq!(Step::through(0.0, 0.5, 1.0, 0.04), None);
        assert_eq!(Step::through(0.0, 0.5, 1.0, f64::NAN), None);
    }
}
