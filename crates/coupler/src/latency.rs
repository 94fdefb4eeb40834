//! How long exchanges took, as a distribution.

use std::time::Duration;

use serde::{Deserialize, Serialize};

/// Upper bound of the first class.
const SHORTEST: f64 = 1e-6;
/// From one class to the next.
const RATIO: f64 = 1.6;
const CLASSES: usize = 32;

/// Counts of times by their size, in classes that grow by a factor of 1.6, from 1 µs to 2 s.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Latencies {
    counts: [u64; CLASSES],
}

impl Latencies {
    /// Takes notice of one.
    pub(crate) fn add(&mut self, time: Duration) {
        let class = (time.as_secs_f64() / SHORTEST).log(RATIO).ceil().max(0.0);
        self.counts[(class as usize).min(CLASSES - 1)] += 1;
    }

    /// The time that a share of all did not exceed, s, as the upper bound of its class; `None` before the first.
    #[must_use]
    pub fn percentile(&self, share: f64) -> Option<f64> {
        let all: u64 = self.counts.iter().sum();
        let wanted = (share * all as f64).ceil().max(1.0) as u64;
        let mut so_far = 0;
        let class = self.counts.iter().position(|count| {
            so_far += count;
            so_far >= wanted
        })?;
        Some(SHORTEST * RATIO.powi(class as i32))
    }

    pub(crate) fn zip(self, other: Self, join: impl Fn(u64, u64) -> u64) -> Self {
        Self { counts: std::array::from_fn(|class| join(self.counts[class], other.counts[class])) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_within_a_class_of_the_truth() {
        let mut latencies = Latencies::default();
        assert_eq!(latencies.percentile(0.5), None);
        (1..=1000).for_each(|k| latencies.add(Duration::from_micros(k)));
        for (share, truth) in [(0.5, 500e-6), (0.99, 990e-6), (1.0, 1e-3), (0.0, 1e-6)] {
            let found = latencies.percentile(share).expect("there are some");
            assert!(found >= truth * (1.0 - 1e-9) && found < RATIO * truth, "{share}: {found}");
        }
        // Beyond the last class they are counted in it.
        latencies.add(Duration::from_secs(100));
        assert!(latencies.percentile(1.0).is_some_and(|longest| longest > 1.0));
    }
}
