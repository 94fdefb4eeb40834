//! How long exchanges took, as a distribution.

use std::time::Duration;

use hdrhistogram::{Histogram, RecordError};
use serde::{Deserialize, Serialize};

/// What is told apart at all, and the longest, ns: what is longer counts as that.
const BOUNDS: (u64, u64) = (64, 100_000_000_000);
/// Significant digits; with one, no two times are counted together that differ by more than a tenth.
const DIGITS: u8 = 1;

/// Times in classes that are as wide as a tenth of them or less, up to 100 s; saved as the classes that hold any.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(into = "Vec<(u64, u64)>", try_from = "Vec<(u64, u64)>")]
pub struct Latencies(Histogram<u64>);

impl Latencies {
    /// Takes notice of one. Nothing is allocated.
    pub(crate) fn add(&mut self, time: Duration) {
        self.0.saturating_record(u64::try_from(time.as_nanos()).unwrap_or(u64::MAX));
    }

    /// The time that a share of all did not exceed, s, as the upper bound of its class; `None` before the first.
    #[must_use]
    pub fn percentile(&self, share: f64) -> Option<f64> {
        let within = self.0.value_at_quantile(share);
        (!self.0.is_empty()).then(|| self.0.highest_equivalent(within) as f64 * 1e-9)
    }

    /// These and the `other` ones.
    pub(crate) fn plus(mut self, other: &Self) -> Self {
        self.0.add(&other.0).expect("classes are the same");
        self
    }

    /// These without the `earlier` ones; with none where the earlier ones are not among them.
    pub(crate) fn since(mut self, earlier: &Self) -> Self {
        self.0.subtract(&earlier.0).map_or_else(|_| Self::default(), |()| self)
    }
}

impl Default for Latencies {
    fn default() -> Self {
        Self(Histogram::new_with_bounds(BOUNDS.0, BOUNDS.1, DIGITS).expect("valid bounds"))
    }
}

impl From<Latencies> for Vec<(u64, u64)> {
    fn from(latencies: Latencies) -> Self {
        let classes = latencies.0.iter_recorded();
        classes.map(|class| (class.value_iterated_to(), class.count_at_value())).collect()
    }
}

impl TryFrom<Vec<(u64, u64)>> for Latencies {
    type Error = RecordError;

    fn try_from(classes: Vec<(u64, u64)>) -> Result<Self, RecordError> {
        let mut latencies = Self::default();
        classes.into_iter().try_for_each(|(time, count)| latencies.0.record_n(time, count))?;
        Ok(latencies)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thousand() -> Latencies {
        let mut latencies = Latencies::default();
        (1..=1000).for_each(|k| latencies.add(Duration::from_micros(k)));
        latencies
    }

    #[test]
    fn percentiles_are_within_a_class_of_the_truth() {
        assert_eq!(Latencies::default().percentile(0.5), None);
        let mut latencies = thousand();
        for (share, truth) in [(0.5, 500e-6), (0.99, 990e-6), (1.0, 1e-3), (0.0, 1e-6)] {
            let found = latencies.percentile(share).expect("there are some");
            assert!(found >= truth * (1.0 - 1e-9) && found < 1.1 * truth, "{share}: {found}");
        }
        // Beyond the last class they are counted in it.
        latencies.add(Duration::from_secs(1000));
        assert!(latencies.percentile(1.0).is_some_and(|longest| longest > 99.0));
    }

    #[test]
    fn what_was_added_can_be_taken_away_again() {
        let mut more = thousand();
        more.add(Duration::from_secs(1));
        let last = more.clone().since(&thousand());
        assert!(last.percentile(0.0).is_some_and(|time| (time - 1.0).abs() < 0.1), "{last:?}");
        assert_eq!(thousand().plus(&last), more);
        // What is not among them.
        assert_eq!(thousand().since(&more), Latencies::default());
    }

    #[test]
    fn a_saved_distribution_is_the_same_and_an_impossible_one_is_refused() {
        let mut latencies = thousand();
        for time in [Duration::ZERO, Duration::MAX] {
            latencies.add(time);
        }
        let classes = Vec::from(latencies.clone());
        assert!(classes.len() < 120, "{}", classes.len());
        assert_eq!(Latencies::try_from(classes), Ok(latencies));
        assert!(Latencies::try_from(vec![(u64::MAX, 1)]).is_err());
    }
}
