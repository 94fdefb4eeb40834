//! What the rate of plastic strain does to the flow stress.

use super::error::{PlasticityError, not_negative, positive};

/// The factor 1 + C ln max(1, ε̇/ε̇₀) on the flow stress; Johnson & Cook (1983).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RateFactor {
    /// C, at least 0.
    pub rate_coefficient: f64,
    /// ε̇₀, 1/s, positive.
    pub reference_rate: f64,
}

impl RateFactor {
    /// None: C = 0.
    pub(super) const NONE: Self = Self { rate_coefficient: 0.0, reference_rate: 1.0 };

    /// From C and ε̇₀ (1/s).
    ///
    /// # Errors
    /// C negative, ε̇₀ not positive, either not finite.
    pub fn new(rate_coefficient: f64, reference_rate: f64) -> Result<Self, PlasticityError> {
        Ok(Self {
            rate_coefficient: not_negative("rate_coefficient", rate_coefficient, "")?,
            reference_rate: positive("reference_rate", reference_rate, "1/s")?,
        })
    }

    /// Whether the rate matters at all.
    #[inline]
    pub fn acts(self) -> bool {
        self.rate_coefficient > 0.0
    }

    /// The factor and its derivative by ln ε̇ at a rate (1/s, may be infinite).
    #[inline]
    pub(super) fn at(self, rate: f64) -> (f64, f64) {
        if self.acts() && rate > self.reference_rate {
            (1.0 + self.rate_coefficient * (rate / self.reference_rate).ln(), self.rate_coefficient)
        } else {
            (1.0, 0.0)
        }
    }
}
