//! The hardening laws: how the flow stress follows plastic strain, its rate, and temperature.

use super::error::{PlasticityError, not_negative, positive};
use super::flow::Flow;
use super::johnson_cook::{JohnsonCook, ThermalSoftening};
use super::rate::RateFactor;
use super::table::Table;

/// Isotropic hardening; every law is made by a constructor that checks its constants.
#[derive(Clone, Debug, PartialEq)]
pub enum Hardening {
    /// Y = A.
    Perfect(Perfect),
    /// Y = A + H ε_p.
    Linear(Linear),
    /// Y = (A + B ε_pⁿ)(1 + C ln max(1, ε̇/ε̇₀))(1 − T*ᵐ).
    JohnsonCook(JohnsonCook),
    /// A table, with an optional rate's factor.
    Table(Table),
}

/// Perfect plasticity, Y = A.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Perfect {
    /// A, Pa.
    pub yield_strength: f64,
}

/// Linear hardening, Y = A + H ε_p.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Linear {
    /// A, Pa.
    pub yield_strength: f64,
    /// H, Pa.
    pub hardening_modulus: f64,
}

impl Hardening {
    /// Perfect plasticity of strength A, Pa.
    ///
    /// # Errors
    /// A not positive and finite.
    pub fn perfect(yield_strength: f64) -> Result<Self, PlasticityError> {
        Ok(Self::Perfect(Perfect { yield_strength: positive("yield_strength", yield_strength, "Pa")? }))
    }

    /// Linear hardening of strength A and modulus H, Pa.
    ///
    /// # Errors
    /// A not positive, H negative, either not finite.
    pub fn linear(yield_strength: f64, hardening_modulus: f64) -> Result<Self, PlasticityError> {
        Ok(Self::Linear(Linear {
            yield_strength: positive("yield_strength", yield_strength, "Pa")?,
            hardening_modulus: not_negative("hardening_modulus", hardening_modulus, "Pa")?,
        }))
    }

    /// The name in case files.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Perfect(_) => "perfect",
            Self::Linear(_) => "linear",
            Self::JohnsonCook(_) => "johnson-cook",
            Self::Table(_) => "table",
        }
    }

    /// The flow stress Y of the law.
    ///
    /// Johnson & Cook (1983) for the law of that name. Paper: none.
    ///
    /// - `strain`: plastic strain ε_p ≥ 0. `rate`: its rate, 1/s, from 0 on, may be infinite. `temperature`: K, ignored
    ///   by laws without heat.
    /// - returns: Y ≥ 0, Pa; 0 from the melting temperature on, at any rate.
    /// - valid for: what the arguments say; no argument makes it NaN but one that is.
    /// - errors: none.
    /// - tested by: formulas typed again, limits, differences for the slopes.
    #[must_use]
    pub fn yield_stress(&self, strain: f64, rate: f64, temperature: f64) -> f64 {
        self.flow(strain, rate, temperature).stress
    }

    /// The same with its derivatives.
    #[must_use]
    pub fn flow(&self, strain: f64, rate: f64, temperature: f64) -> Flow {
        self.flow_at_rise(strain, rate, temperature - self.reference_temperature().unwrap_or(temperature))
    }

    /// The same at `rise` = T − T_r, K.
    #[inline]
    pub(super) fn flow_at_rise(&self, strain: f64, rate: f64, rise: f64) -> Flow {
        match self {
            Self::Perfect(law) => Flow { stress: law.yield_strength, ..Flow::default() },
            Self::Linear(law) => {
                let hardening = law.hardening_modulus * strain;
                Flow { stress: law.yield_strength + hardening, per_log_strain: hardening, ..Flow::default() }
            }
            Self::JohnsonCook(law) => law.flow(strain, rate, rise),
            Self::Table(law) => law.flow(strain, rate),
        }
    }

    /// What the rate does, if anything.
    pub fn rate(&self) -> Option<RateFactor> {
        let factor = match self {
            Self::Perfect(_) | Self::Linear(_) => return None,
            Self::JohnsonCook(law) => law.rate,
            Self::Table(law) => law.rate(),
        };
        factor.acts().then_some(factor)
    }

    /// What heat does, if anything; only then temperature is a part of the state.
    pub fn softening(&self) -> Option<&ThermalSoftening> {
        match self {
            Self::JohnsonCook(law) => law.softening.as_ref(),
            Self::Perfect(_) | Self::Linear(_) | Self::Table(_) => None,
        }
    }

    /// T_r of a law with heat, K: the temperature of a state that never yielded.
    pub fn reference_temperature(&self) -> Option<f64> {
        self.softening().map(|softening| softening.reference_temperature)
    }
}
