//! The mean of something over the last while, from its means over steps of any length.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

/// A running mean: the time integral since t = 0, and as much of its past as the mean needs.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct RunningMean {
    /// Time since then, s, and the time integral of what is averaged, in its unit times s.
    now: [f64; 2],
    /// The same at the ends of earlier steps: the first at or before the beginning of the while, the others within it.
    before: VecDeque<[f64; 2]>,
}

impl RunningMean {
    /// The mean over the last `window` (s) after a step of length `dt` (s) with this mean, as far back as there has been time; in a longer
    /// step than that, the step's.
    ///
    /// Of a step that began before the while its part within counts, as if the step had one value throughout.
    pub fn push(&mut self, window: f64, dt: f64, mean: f64) -> f64 {
        let [time, integral] = self.now;
        self.now = [time + dt, integral + dt * mean];
        if window <= dt {
            self.before.clear();
        }
        self.before.push_back([time, integral]);
        if window <= dt {
            return mean;
        }
        let begin = self.now[0] - window;
        while self.before.get(1).is_some_and(|[next, _]| *next <= begin) {
            self.before.pop_front();
        }
        let [first, integral] = self.before[0];
        let begin = begin.max(first);
        let [next, next_integral] = self.before.get(1).copied().unwrap_or(self.now);
        let at_begin = integral + (next_integral - integral) * (begin - first) / (next - first);
        (self.now[1] - at_begin) / (self.now[0] - begin)
    }

    /// Time since t = 0, s.
    pub fn time(&self) -> f64 {
        self.now[0]
    }

    /// The time integral since t = 0.
    pub fn integral(&self) -> f64 {
        self.now[1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_is_over_the_last_while() {
        let mut mean = RunningMean::default();
        let mut push = |dt, value| mean.push(1.0, dt, value);
        // The mean over what there has been, until there has been enough.
        assert!((push(0.5, 2.0) - 2.0).abs() < 1e-15);
        assert!((push(0.5, 4.0) - 3.0).abs() < 1e-15);
        // Of the first step only the last tenth remains.
        assert!((push(0.4, 10.0) - (0.1 * 2.0 + 0.5 * 4.0 + 0.4 * 10.0)).abs() < 1e-14);
        // A step longer than the while.
        assert_eq!(push(3.0, 7.0), 7.0);
        assert!(
            (mean.integral() - (1.0 + 2.0 + 4.0 + 21.0)).abs() < 1e-14 && (mean.time() - 4.4).abs() < 1e-15
        );
        let mut at_once = RunningMean::default();
        assert_eq!([at_once.push(0.0, 0.1, 5.0), at_once.push(0.0, 0.1, 6.0)], [5.0, 6.0]);
        assert_eq!(at_once.before.len(), 1);
        // Of a step longer than the while, its end counts after it.
        let mut after_long = RunningMean::default();
        let shown = [(1.0, 3.0), (0.5, 7.0)].map(|(dt, value)| after_long.push(0.75, dt, value));
        assert_eq!(shown, [3.0, (0.25 * 3.0 + 0.5 * 7.0) / 0.75]);
        // However long it is, no step costs more than the last.
        let mut slow = RunningMean::default();
        (0..1000).for_each(|_| assert!((slow.push(0.05, 0.01, 3.0) - 3.0).abs() < 1e-12));
        assert!(slow.before.len() <= 6, "{}", slow.before.len());
    }
}
