//! The Johnson–Cook law.

use super::error::{PlasticityError, not_negative, positive, within};
use super::flow::Flow;
use super::rate::RateFactor;

/// Softening by heat: the factor 1 − T*ᵐ, T* = (T − T_r)/(T_m − T_r) within 0 and 1, and the adiabatic heating
/// ρ c_p dT = χ σ dε_p that raises T.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ThermalSoftening {
    /// m, positive.
    pub softening_exponent: f64,
    /// T_m, K: from there on the material has no strength.
    pub melting_temperature: f64,
    /// T_r, K: up to there it has its full strength, and there a run begins.
    pub reference_temperature: f64,
    /// c_p, J/(kg K).
    pub heat_capacity: f64,
    /// χ (Taylor & Quinney 1934), the part of the plastic work that becomes heat, 0 to 1.
    pub taylor_quinney: f64,
}

impl ThermalSoftening {
    /// From m, T_m and T_r (K), c_p (J/(kg K)) and χ.
    ///
    /// # Errors
    /// m or c_p not positive, χ outside 0 to 1, T_r negative, T_m ≤ T_r, a number that is not finite.
    pub fn new(
        softening_exponent: f64,
        melting_temperature: f64,
        reference_temperature: f64,
        heat_capacity: f64,
        taylor_quinney: f64,
    ) -> Result<Self, PlasticityError> {
        let share = (0.0..=1.0).contains(&taylor_quinney);
        let this = Self {
            softening_exponent: positive("softening_exponent", softening_exponent, "")?,
            melting_temperature: positive("melting_temperature", melting_temperature, "K")?,
            reference_temperature: not_negative("reference_temperature", reference_temperature, "K")?,
            heat_capacity: positive("heat_capacity", heat_capacity, "J/(kg K)")?,
            taylor_quinney: within(share, "taylor_quinney", taylor_quinney, "within 0 and 1", "")?,
        };
        if melting_temperature <= reference_temperature {
            return Err(PlasticityError::MeltingBelowReference {
                melting: melting_temperature,
                reference: reference_temperature,
            });
        }
        Ok(this)
    }

    /// T_m − T_r, K.
    #[inline]
    pub(super) fn range(&self) -> f64 {
        self.melting_temperature - self.reference_temperature
    }

    /// The factor 1 − T*ᵐ and its derivative by ln T* at `rise` = T − T_r, K.
    #[inline]
    fn at(&self, rise: f64) -> (f64, f64) {
        let homologous = rise / self.range();
        if !(homologous > 0.0) {
            (1.0, 0.0)
        } else if homologous >= 1.0 {
            (0.0, 0.0)
        } else {
            let lost = homologous.powf(self.softening_exponent);
            (1.0 - lost, -self.softening_exponent * lost)
        }
    }
}

/// Y = (A + B ε_pⁿ)(1 + C ln max(1, ε̇/ε̇₀))(1 − T*ᵐ); Johnson & Cook (1983).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct JohnsonCook {
    /// A, Pa.
    pub yield_strength: f64,
    /// B, Pa.
    pub hardening_modulus: f64,
    /// n, above 0 and at most 1.
    pub hardening_exponent: f64,
    /// The rate's factor, 1 for C = 0.
    pub rate: RateFactor,
    /// The heat's factor, 1 where absent.
    pub softening: Option<ThermalSoftening>,
}

impl JohnsonCook {
    /// From A, B (Pa) and n; neither rate nor heat matters.
    ///
    /// # Errors
    /// A not positive, B negative, n outside (0, 1], a number that is not finite.
    pub fn new(
        yield_strength: f64,
        hardening_modulus: f64,
        hardening_exponent: f64,
    ) -> Result<Self, PlasticityError> {
        let concave = hardening_exponent > 0.0 && hardening_exponent <= 1.0;
        Ok(Self {
            yield_strength: positive("yield_strength", yield_strength, "Pa")?,
            hardening_modulus: not_negative("hardening_modulus", hardening_modulus, "Pa")?,
            hardening_exponent: within(
                concave,
                "hardening_exponent",
                hardening_exponent,
                "above 0 and at most 1",
                "",
            )?,
            rate: RateFactor::NONE,
            softening: None,
        })
    }

    /// The same with a rate's factor.
    #[must_use]
    pub fn with_rate(self, rate: RateFactor) -> Self {
        Self { rate, ..self }
    }

    /// The same with a heat's factor.
    #[must_use]
    pub fn with_softening(self, softening: ThermalSoftening) -> Self {
        Self { softening: Some(softening), ..self }
    }

    /// See [`super::Hardening::flow`]; `rise` is T − T_r, K.
    #[inline]
    pub(super) fn flow(&self, strain: f64, rate: f64, rise: f64) -> Flow {
        let (soft, d_soft) = self.softening.as_ref().map_or((1.0, 0.0), |softening| softening.at(rise));
        if soft == 0.0 {
            // Whatever the rate: an infinite one times no strength would be no number.
            return Flow::default();
        }
        let power = if strain > 0.0 { strain.powf(self.hardening_exponent) } else { 0.0 };
        let hardened = self.yield_strength + self.hardening_modulus * power;
        let (fast, d_fast) = self.rate.at(rate);
        Flow {
            stress: hardened * fast * soft,
            per_log_strain: self.hardening_exponent * self.hardening_modulus * power * fast * soft,
            per_log_rate: hardened * d_fast * soft,
            per_log_rise: hardened * fast * d_soft,
        }
    }
}
