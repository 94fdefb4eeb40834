//! The paper's damping factors for the weak scheme.

use serde::{Deserialize, Serialize};

/// The largest Courant number of the paper's scheme, ν₀ in (38).
const LARGEST_COURANT: f64 = 0.5;
/// The paper's empirical exponents q₁ and q_∞ in (42).
const EXPONENT_AT_ONE: f64 = 0.95;
const EXPONENT_AT_INFINITY: f64 = 0.5;

/// κ̂ of one side, averaged over two steps.
///
/// Paper eqs. (40)–(43): ν = Δt λ_max/h, ratio = ν₀/ν, κ = ratio^(q₁ + (2/π) arctan(ratio) (q_∞ − q₁)),
/// κ̂ = (κⁿ + κⁿ⁻¹)/2.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct KappaFactor {
    previous: Option<f64>,
}

impl KappaFactor {
    /// κ̂ for a step at the Courant number `courant` > 0 of this side.
    pub fn next(&mut self, courant: f64) -> f64 {
        let ratio = LARGEST_COURANT / courant;
        let exponent = EXPONENT_AT_ONE
            + std::f64::consts::FRAC_2_PI * ratio.atan() * (EXPONENT_AT_INFINITY - EXPONENT_AT_ONE);
        let kappa = ratio.powf(exponent);
        let mean = 0.5 * (kappa + self.previous.unwrap_or(kappa));
        self.previous = Some(kappa);
        mean
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_the_papers_step_kappa_is_about_two_and_a_half() {
        // Δt = 1e-10 s on the finest solid grid: ν = 0.098 and κ̂ = 2.47.
        let mut factor = KappaFactor::default();
        let first = factor.next(1e-10 * 5990.0 / (0.05 / 8192.0));
        assert!((first - 2.47).abs() < 0.01, "{first}");
        assert!((KappaFactor::default().next(0.4) - 1.17).abs() < 0.005);
        assert_eq!(KappaFactor::default().next(0.5), 1.0);
        // The mean of this step's and the last one's.
        let second = factor.next(0.5);
        assert!((second - 0.5 * (first + 1.0)).abs() < 1e-15);
    }
}
