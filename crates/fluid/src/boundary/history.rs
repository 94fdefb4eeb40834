//! Pressure over time, as it is given.

/// A pressure history, linear between its points and constant beyond them.
#[derive(Clone, Debug, PartialEq)]
pub struct PressureHistory {
    points: Vec<[f64; 2]>,
}

impl PressureHistory {
    /// From (time s, pressure Pa) points in ascending order of time; `None` if there is none or they descend.
    pub fn new(points: Vec<[f64; 2]>) -> Option<Self> {
        let ascending = points.windows(2).all(|w| w[0][0] <= w[1][0]);
        (!points.is_empty() && ascending).then_some(Self { points })
    }

    /// Pressure at a time, Pa.
    pub fn at(&self, time: f64) -> f64 {
        let after = self.points.partition_point(|p| p[0] <= time);
        match (after.checked_sub(1).map(|k| self.points[k]), self.points.get(after).copied()) {
            (Some([t0, p0]), Some([t1, p1])) => p0 + (p1 - p0) * ((time - t0) / (t1 - t0)),
            (Some([_, p]), None) | (None, Some([_, p])) => p,
            (None, None) => unreachable!("there is at least one point"),
        }
    }

    /// Its mean between two times, Pa.
    pub fn mean(&self, from: f64, to: f64) -> f64 {
        let first = self.points.partition_point(|p| p[0] <= from);
        let within = self.points[first..].iter().copied().take_while(|p| p[0] <= to);
        let (mut sum, mut last) = (0.0, [from, self.at(from)]);
        for next in within.chain([[to, self.at(to)]]) {
            sum += 0.5 * (last[1] + next[1]) * (next[0] - last[0]);
            last = next;
        }
        sum / (to - from)
    }

    /// Whether it changes between two times.
    pub fn changes(&self, from: f64, to: f64) -> bool {
        let first = self.points.partition_point(|p| p[0] <= from);
        let within = self.points[first..].iter().take_while(|p| p[0] < to).map(|p| p[1]);
        let before = self.at(from);
        within.chain([self.at(to)]).any(|value| value != before)
    }

    /// The same where it is `initial` before t = 0.
    pub fn changes_from(&self, initial: f64, from: f64, to: f64) -> bool {
        let begins = from < 0.0 && to > 0.0 && self.at(0.0) != initial;
        begins || self.changes(from.max(0.0), to.max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_history_is_linear_between_points_and_constant_beyond() {
        let history = PressureHistory::new(vec![[0.0, 1e5], [1e-6, 3e5], [2e-6, 3e5], [2e-6, 1e5]]).unwrap();
        assert_eq!(history.at(-1.0), 1e5);
        assert_eq!(history.at(0.5e-6), 2e5);
        assert_eq!(history.at(1.5e-6), 3e5);
        assert_eq!(history.at(5.0), 1e5);
        assert!(PressureHistory::new(vec![]).is_none());
        assert!(PressureHistory::new(vec![[1.0, 0.0], [0.0, 0.0]]).is_none());
    }

    #[test]
    fn means_are_those_of_lines_between_points() {
        let history = PressureHistory::new(vec![[1.0, 0.0], [2.0, 4.0], [2.0, 6.0], [4.0, 2.0]]).unwrap();
        let mean = |from: f64, to: f64| history.mean(from, to);
        assert_eq!([mean(0.0, 1.0), mean(1.0, 2.0), mean(2.0, 4.0), mean(5.0, 7.0)], [0.0, 2.0, 4.0, 2.0]);
        assert_eq!(mean(1.5, 2.5), 0.5 * 3.0 + 0.5 * 5.5);
        assert!(!history.changes(0.0, 0.9) && !history.changes(4.0, 9.0));
        assert!(history.changes(0.9, 1.1) && history.changes(1.2, 1.3) && history.changes(1.9, 2.1));
    }
}
