//! Sums of many terms.

use serde::{Deserialize, Serialize};

/// A sum that keeps what rounding takes from it.
///
/// A. Neumaier, ZAMM 54 (1974), 39: error of at most two units in the last place of the sum, plus one of second order in the
/// number of terms; a plain sum's grows with that number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CompensatedSum {
    sum: f64,
    lost: f64,
}

impl CompensatedSum {
    /// Adds a term.
    pub fn add(&mut self, term: f64) {
        let sum = self.sum + term;
        let [large, small] = if self.sum.abs() >= term.abs() { [self.sum, term] } else { [term, self.sum] };
        self.lost += (large - sum) + small;
        self.sum = sum;
    }

    /// Adds another sum.
    pub fn add_sum(&mut self, other: Self) {
        self.add(other.sum);
        self.lost += other.lost;
    }

    /// The sum so far.
    pub fn value(self) -> f64 {
        self.sum + self.lost
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sum_of(terms: impl Iterator<Item = f64>) -> f64 {
        let mut sum = CompensatedSum::default();
        terms.for_each(|term| sum.add(term));
        sum.value()
    }

    #[test]
    fn what_a_large_term_hides_comes_back_when_it_is_gone() {
        assert_eq!(sum_of([1.0, 1e100, 1.0, -1e100].into_iter()), 2.0);
    }

    #[test]
    fn a_million_terms_are_summed_to_round_off() {
        let million = 1_000_000;
        let sum = sum_of((0..million).map(|_| 0.1));
        assert!((sum - 1e5).abs() < 3e-11, "{:e}", sum - 1e5);
        let plain: f64 = (0..million).map(|_| 0.1).sum();
        assert!((plain - 1e5).abs() > 1e-7, "a plain sum is no worse");
        // There and back on top of an offset: a plain sum is left with 1e-12 or so.
        let there_and_back = (0..million).map(|k| if k % 2 == 0 { 1e-3 / 3.0 } else { -1e-3 / 3.0 });
        assert_eq!(sum_of(std::iter::once(1e4).chain(there_and_back)), 1e4);
    }

    #[test]
    fn a_sum_of_sums_is_that_of_all_terms() {
        let (mut first, mut second) = (CompensatedSum::default(), CompensatedSum::default());
        [1.0, 1e100].into_iter().for_each(|term| first.add(term));
        [1.0, -1e100].into_iter().for_each(|term| second.add(term));
        first.add_sum(second);
        assert_eq!(first.value(), 2.0);
    }
}
