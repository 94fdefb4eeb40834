//! Axisymmetric stress, its deviator, and the elastic energy in it.

use mesh::Blend;

use crate::material::yield_criterion::von_mises_squared;

/// A stress tensor without the components that vanish in axisymmetry; Pa, positive in tension.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stress {
    /// σ_zz.
    pub zz: f64,
    /// σ_zr.
    pub zr: f64,
    /// σ_rr.
    pub rr: f64,
    /// σ_φφ.
    pub phiphi: f64,
}

impl Stress {
    /// The square of the von Mises stress, q² = 3/2 s:s, Pa².
    #[inline(always)]
    #[must_use]
    pub fn von_mises_squared(self) -> f64 {
        von_mises_squared(self.zz, self.zr, self.rr, self.phiphi)
    }

    /// The mean stress ⅓ tr σ, Pa.
    #[inline(always)]
    #[must_use]
    pub fn mean(self) -> f64 {
        // Divisions are what a return costs.
        (self.zz + self.rr + self.phiphi) * (1.0 / 3.0)
    }

    /// s_zz, of the deviator.
    #[inline(always)]
    #[must_use]
    pub fn deviator_zz(self) -> f64 {
        self.zz - self.mean()
    }

    /// The stress of the same mean with `factor` times the deviator; 0 leaves the mean alone.
    #[inline(always)]
    #[must_use]
    pub fn with_deviator_times(self, factor: f64) -> Self {
        let mean = self.mean();
        Self {
            zz: mean + factor * (self.zz - mean),
            zr: factor * self.zr,
            rr: mean + factor * (self.rr - mean),
            phiphi: mean + factor * (self.phiphi - mean),
        }
    }

    /// This one, or another; without a branch.
    #[inline(always)]
    pub(super) fn or(self, blend: Blend, is_this: bool, other: Self) -> Self {
        Self {
            zz: blend.choose(is_this, self.zz, other.zz),
            zr: blend.choose(is_this, self.zr, other.zr),
            rr: blend.choose(is_this, self.rr, other.rr),
            phiphi: blend.choose(is_this, self.phiphi, other.phiphi),
        }
    }

    /// Elastic energy density of the deviator, s:s/(4μ) = q²/(6μ), J/m³; `mu` in Pa.
    ///
    /// The rest of the elastic energy, ½ (mean stress)²/K, is not touched by plastic flow.
    #[inline]
    #[must_use]
    pub fn deviatoric_energy(self, mu: f64) -> f64 {
        self.von_mises_squared() / (6.0 * mu)
    }
}

/// Scales the deviator onto a yield surface that the stress lies outside of.
///
/// The closest point in the norm of the elastic energy, which for von Mises is along the radius; Wilkins (1964). For
/// states that are predicted, not stepped: nothing flows, no work is counted.
///
/// - `stress`: Pa. `yield_stress`: Y ≥ 0, Pa.
/// - returns: the stress, bitwise as it was where q ≤ Y, and whether it lay outside.
/// - valid for: stresses below 1e150 Pa.  errors: none.
/// - tested by: random stresses, one on the surface, no strength.
#[inline]
#[must_use]
pub fn project_to_yield(stress: Stress, yield_stress: f64) -> (Stress, bool) {
    let squared = stress.von_mises_squared();
    if squared > yield_stress * yield_stress {
        (stress.with_deviator_times(yield_stress / squared.sqrt()), true)
    } else {
        (stress, false)
    }
}
