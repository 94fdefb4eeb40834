//! A given pressure on a solid, as adaptation looks ahead at it.

use fluid::PressureHistory;
use mesh::{Entering, mean_since_start};

use crate::case::{LoadCase, RecordedLoad};

/// The pressure that will press on the surface less that which the solid's initial stress carries.
#[derive(Debug)]
pub enum ComingLoad {
    /// A exp(−r²/b²) f(t).
    Gaussian {
        /// A, Pa.
        amplitude: f64,
        /// b, m.
        radius: f64,
        /// f.
        factor: PressureHistory,
    },
    /// Another run's.
    Recorded(RecordedLoad),
}

impl ComingLoad {
    /// Of a case's load; `None` for a history without points, which reading refuses.
    pub fn of(case: &LoadCase) -> Option<Self> {
        Some(match case {
            LoadCase::Gaussian(load) => Self::Gaussian {
                amplitude: load.amplitude,
                radius: load.radius,
                factor: PressureHistory::new(load.history.clone())?,
            },
            LoadCase::Recorded(load) => Self::Recorded(load.clone()),
        })
    }
}

impl Entering for ComingLoad {
    fn mean(&self, from: f64, to: f64, along: f64) -> f64 {
        mean_since_start(from, to, |from, to| match self {
            Self::Gaussian { amplitude, radius, factor } => {
                amplitude * (-(along / radius).powi(2)).exp() * factor.mean(from, to)
            }
            Self::Recorded(load) => load.gained_at(along, from, to - from),
        })
    }

    fn changes(&self, from: f64, to: f64) -> bool {
        match self {
            Self::Gaussian { factor, .. } => factor.changes_from(0.0, from, to),
            Self::Recorded(load) => from < load.end() && to > 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_load_is_nothing_before_it_begins_and_changes_until_it_stays() {
        let factor = PressureHistory::new(vec![[0.0, 1.0], [2.0, 1.0], [3.0, 0.0]]).unwrap();
        let load = ComingLoad::Gaussian { amplitude: 6.0, radius: 2.0, factor };
        assert_eq!(
            [load.mean(-2.0, -1.0, 0.0), load.mean(-1.0, 1.0, 0.0), load.mean(0.0, 1.0, 0.0)],
            [0.0, 3.0, 6.0]
        );
        assert_eq!(load.mean(2.0, 3.0, 2.0), 3.0 * (-1.0_f64).exp());
        assert!(load.changes(-0.5, 0.5) && load.changes(1.9, 2.1));
        assert!(!load.changes(-2.0, -1.0) && !load.changes(0.1, 1.9) && !load.changes(3.0, 9.0));
    }
}
