//! Flow stress as a table.

use super::error::PlasticityError;
use super::flow::Flow;
use super::rate::RateFactor;

/// Flow stress over plastic strain: straight between the points, constant before the first and beyond the last, with an
/// optional rate's factor.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    strains: Vec<f64>,
    stresses: Vec<f64>,
    rate: RateFactor,
}

impl Table {
    /// From points [plastic strain, stress in Pa].
    ///
    /// The stress must not fall: with a stress that falls over the strain the equations lose their character as waves,
    /// strain gathers in one cell, and what comes out depends on the grid (Hill 1962; Bažant 1976).
    ///
    /// # Errors
    /// No point; a strain negative, a stress not positive, either not finite; strains that do not increase strictly,
    /// stresses that fall.
    pub fn new(points: &[[f64; 2]]) -> Result<Self, PlasticityError> {
        if points.is_empty() {
            return Err(PlasticityError::EmptyTable);
        }
        for (k, &[strain, stress]) in points.iter().enumerate() {
            let point = k + 1;
            if !(strain >= 0.0 && strain.is_finite() && stress > 0.0 && stress.is_finite()) {
                return Err(PlasticityError::TablePoint { point, strain, stress });
            }
        }
        for (k, pair) in points.windows(2).enumerate() {
            let (point, [[before, low], [strain, stress]]) = (k + 2, [pair[0], pair[1]]);
            if strain <= before {
                return Err(PlasticityError::TableNotIncreasing { point, before, strain });
            }
            if stress < low {
                return Err(PlasticityError::TableSoftens { point, before: low, stress });
            }
        }
        Ok(Self {
            strains: points.iter().map(|point| point[0]).collect(),
            stresses: points.iter().map(|point| point[1]).collect(),
            rate: RateFactor::NONE,
        })
    }

    /// The same with a rate's factor.
    #[must_use]
    pub fn with_rate(self, rate: RateFactor) -> Self {
        Self { rate, ..self }
    }

    /// The points [plastic strain, stress in Pa].
    pub fn points(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.strains.iter().zip(&self.stresses).map(|(&strain, &stress)| [strain, stress])
    }

    /// The rate's factor.
    pub fn rate(&self) -> RateFactor {
        self.rate
    }

    /// See [`super::Hardening::flow`].
    #[inline]
    pub(super) fn flow(&self, strain: f64, rate: f64) -> Flow {
        let (hardened, slope) = self.hardened(strain);
        let (fast, d_fast) = self.rate.at(rate);
        Flow {
            stress: hardened * fast,
            per_log_strain: slope * strain * fast,
            per_log_rate: hardened * d_fast,
            per_log_rise: 0.0,
        }
    }

    /// Stress and slope of the curve at a plastic strain, Pa; at a point the slope behind it.
    fn hardened(&self, strain: f64) -> (f64, f64) {
        let above = self.strains.partition_point(|&point| point <= strain);
        match above.checked_sub(1) {
            None => (self.stresses[0], 0.0),
            Some(below) if above == self.strains.len() => (self.stresses[below], 0.0),
            Some(below) => {
                let width = self.strains[above] - self.strains[below];
                let slope = (self.stresses[above] - self.stresses[below]) / width;
                (self.stresses[below] + slope * (strain - self.strains[below]), slope)
            }
        }
    }
}
