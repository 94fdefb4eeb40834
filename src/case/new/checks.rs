//! What is asked, looked at before a case is written.

use super::super::error::{CaseError, CaseErrors};

/// The least and the most cells per radius that a case is written for.
const CELLS: std::ops::RangeInclusive<f64> = 4.0..=2000.0;

/// Faults of what is asked, each with the name of the option.
#[derive(Default)]
pub(super) struct Checks(Vec<CaseError>);

impl Checks {
    /// Refuses what is not so.
    pub fn hold(&mut self, holds: bool, option: &str, value: f64, must: &str, help: &str) -> &mut Self {
        if !holds {
            self.0.push(CaseError {
                path: option.to_owned(),
                message: format!("must be {must}, got {value:?}"),
                help: Some(help.to_owned()),
                span: None,
            });
        }
        self
    }

    /// Refuses what is not a positive number.
    pub fn positive(&mut self, option: &str, value: f64, unit: &str) -> &mut Self {
        let holds = value > 0.0 && value.is_finite();
        self.hold(holds, option, value, "positive", &format!("give a number > 0 in {unit}"))
    }

    /// Refuses distances d/R from a wall that no case is written for.
    pub fn stand_off(&mut self, value: f64) -> &mut Self {
        let help = "give d/R, the distance of the bubble's centre from the wall in radii";
        self.hold((0.0..=1e3).contains(&value), "stand_off", value, "from 0 to 1000", help)
    }

    /// Refuses resolutions that no case is written for.
    pub fn cells(&mut self, value: f64) -> &mut Self {
        let must = format!("from {} to {}", CELLS.start(), CELLS.end());
        self.hold(
            CELLS.contains(&value),
            "cells_per_radius",
            value,
            &must,
            "leave it out for a good begin; half of that is quick",
        )
    }

    /// A pressure that is more than that of the gas.
    pub fn above_gas(&mut self, option: &str, pressure: f64, gas: f64) -> &mut Self {
        let help = "the liquid's pressure is what lets the bubble collapse";
        self.hold(pressure > gas, option, pressure, &format!("above the gas's {gas:?} Pa"), help)
    }

    /// The faults, if there are any.
    pub fn done(&mut self) -> Result<(), CaseErrors> {
        let faults = std::mem::take(&mut self.0);
        if faults.is_empty() { Ok(()) } else { Err(CaseErrors::new("cav new", "", faults)) }
    }
}
