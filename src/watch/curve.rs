//! A curve over time that keeps its extremes while it is thinned.

/// More points than this are thinned.
const MOST_POINTS: usize = 1 << 15;

/// Of so many neighbouring points the smallest and the largest remain.
const THINNED: usize = 4;

/// A quantity over time. Points come in the order of time and are kept in it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Curve {
    points: Vec<[f64; 2]>,
    last: Option<[f64; 2]>,
    least: Option<[f64; 2]>,
    largest: Option<[f64; 2]>,
}

impl Curve {
    /// Adds the value at a time; what is no number leaves a gap.
    pub fn push(&mut self, time: f64, value: f64) {
        if !(time.is_finite() && value.is_finite()) {
            return;
        }
        let point = [time, value];
        self.last = Some(point);
        if self.least.is_none_or(|least| value < least[1]) {
            self.least = Some(point);
        }
        if self.largest.is_none_or(|largest| value > largest[1]) {
            self.largest = Some(point);
        }
        self.points.push(point);
        if self.points.len() >= MOST_POINTS {
            self.points = extremes(self.points.chunks(THINNED));
        }
    }

    /// Its points, for a picture of so many columns: the smallest and the largest value within each.
    ///
    /// - `end`: where the last column ends.
    #[must_use]
    pub fn in_columns(&self, columns: usize, end: f64) -> Vec<[f64; 2]> {
        let column = |point: &[f64; 2]| (point[0] / end * columns as f64) as usize;
        extremes(self.points.chunk_by(|a, b| column(a) == column(b)))
    }

    /// Time and value at the end.
    #[must_use]
    pub fn last(&self) -> Option<[f64; 2]> {
        self.last
    }

    /// When it was smallest, and how small; the first time if there are several.
    #[must_use]
    pub fn least(&self) -> Option<[f64; 2]> {
        self.least
    }

    /// When it was largest, and how large; the first time if there are several.
    #[must_use]
    pub fn largest(&self) -> Option<[f64; 2]> {
        self.largest
    }
}

/// Of each group the points with the smallest and the largest value, in the order of time.
fn extremes<'a>(groups: impl Iterator<Item = &'a [[f64; 2]]>) -> Vec<[f64; 2]> {
    let mut kept = Vec::new();
    for group in groups {
        let by_value = |a: &&[f64; 2], b: &&[f64; 2]| a[1].total_cmp(&b[1]);
        let (least, largest) = (group.iter().min_by(by_value), group.iter().max_by(by_value));
        let mut both: Vec<[f64; 2]> = least.into_iter().chain(largest).copied().collect();
        both.sort_by(|a, b| a[0].total_cmp(&b[0]));
        both.dedup();
        kept.extend(both);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_peak_of_one_step_is_there_however_long_the_run_and_narrow_the_picture() {
        let (peak, dip) = (76_543, 123_456);
        let mut curve = Curve::default();
        for step in 0..200_000 {
            let value = match step {
                _ if step == peak => 1e9,
                _ if step == dip => -5.0,
                _ => f64::from(step % 7),
            };
            curve.push(f64::from(step), value);
        }
        assert!(curve.points.len() < MOST_POINTS);
        assert_eq!(curve.largest(), Some([f64::from(peak), 1e9]));
        assert_eq!(curve.least(), Some([f64::from(dip), -5.0]));
        assert_eq!(curve.last(), Some([199_999.0, f64::from(199_999 % 7)]));
        let drawn = curve.in_columns(40, 2e5);
        assert!(drawn.len() <= 80, "{}", drawn.len());
        assert!(drawn.contains(&[f64::from(peak), 1e9]) && drawn.contains(&[f64::from(dip), -5.0]));
        assert!(drawn.is_sorted_by(|a, b| a[0] <= b[0]));
    }

    #[test]
    fn what_is_no_number_is_left_out() {
        let mut curve = Curve::default();
        for (time, value) in [(0.0, f64::NAN), (1.0, 2.0), (2.0, f64::INFINITY), (f64::NAN, 1.0)] {
            curve.push(time, value);
        }
        assert_eq!(
            (curve.least(), curve.largest(), curve.last()),
            (Some([1.0, 2.0]), Some([1.0, 2.0]), Some([1.0, 2.0]))
        );
        assert_eq!(Curve::default().in_columns(10, 0.0), Vec::<[f64; 2]>::new());
    }
}
