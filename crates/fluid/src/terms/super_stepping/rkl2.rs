//! The Runge–Kutta–Legendre scheme of second order, Meyer, Balsara & Aslam (2014).

use crate::terms::diffusion::MOST_STAGES;

/// What a stage takes of the two stages before it and of the first fluxes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stage {
    /// μ_j and ν_j: of the last stage and of that before it.
    pub last: f64,
    pub before: f64,
    /// μ̃_j: of the fluxes of the last stage.
    pub fluxes: f64,
    /// γ̃_j: of the fluxes of the beginning.
    pub first: f64,
}

/// How many stages a step takes of which the product with the largest rate of decay is z: the fewest odd number s ≥ 3 with s² + s − 2 ≥ 2z.
///
/// The scheme's stability polynomial is bounded by 1 there; with an odd number the fastest modes decay more.
pub(super) fn stages(z: f64) -> usize {
    let least = 0.5 * ((9.0 + 8.0 * z).sqrt() - 1.0);
    // More than that nothing asks for whose steps are limited as they should be.
    let stages = if least < MOST_STAGES as f64 { least.ceil() as usize } else { MOST_STAGES };
    stages.max(3) | 1
}

/// b_j: ⅓ up to j = 2, then (j² + j − 2)/(2j(j + 1)), eq. 16.
fn b(j: usize) -> f64 {
    if j < 3 {
        return 1.0 / 3.0;
    }
    let j = j as f64;
    (j * j + j - 2.0) / (2.0 * j * (j + 1.0))
}

/// Stage j from 1 of s, eq. 17: Y_j = μ_j Y_{j−1} + ν_j Y_{j−2} + (1 − μ_j − ν_j) Y_0 + Δt (μ̃_j M Y_{j−1} + γ̃_j M Y_0).
///
/// With Y_j = Y_0 − Δt ∇·Φ_j that is Φ_j = μ_j Φ_{j−1} + ν_j Φ_{j−2} + μ̃_j F(Y_{j−1}) + γ̃_j F(Y_0): Φ_s is the mean flux of the step.
pub(super) fn stage(j: usize, stages: usize) -> Stage {
    let s = stages as f64;
    let w = 4.0 / (s * s + s - 2.0);
    if j == 1 {
        return Stage { last: 0.0, before: 0.0, fluxes: b(1) * w, first: 0.0 };
    }
    let number = j as f64;
    let last = (2.0 * number - 1.0) / number * b(j) / b(j - 1);
    let before = -(number - 1.0) / number * b(j) / b(j - 2);
    let fluxes = last * w;
    Stage { last, before, fluxes, first: -(1.0 - b(j - 1)) * fluxes }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a step makes of dy/dt = −zy.
    fn amplification(z: f64, stages: usize) -> f64 {
        let (mut before, mut last) = (0.0, 0.0);
        for j in 1..=stages {
            let of = stage(j, stages);
            let next = of.last * last + of.before * before + of.fluxes * z * (1.0 - last) + of.first * z;
            (before, last) = (last, next);
        }
        1.0 - last
    }

    #[test]
    fn a_step_is_right_to_second_order() {
        for stages in [3, 5, 9, 21] {
            for z in [1e-2, 1e-3_f64] {
                let error = (amplification(z, stages) - (-z).exp()).abs();
                assert!(error < 0.2 * z.powi(3) + 1e-15, "{stages} {z}: {error}");
            }
        }
    }

    #[test]
    fn nothing_grows_within_the_stages_that_are_asked_for() {
        for most in [0.1, 2.0, 5.0, 33.0, 400.0, 3e4] {
            let stages = stages(most);
            assert!(stages % 2 == 1 && stages >= 3);
            for part in 0..=200 {
                let left = amplification(most * f64::from(part) / 200.0, stages);
                assert!(left.abs() <= 1.0 + 1e-9, "{most} {part}: {left}");
            }
        }
        assert_eq!([f64::INFINITY, f64::NAN, 1e300].map(stages), [MOST_STAGES; 3]);
        assert_eq!([stages(5.0), stages(5.01), stages(14.0), stages(14.1)], [3, 5, 5, 7]);
    }
}
