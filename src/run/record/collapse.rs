//! Growth and collapse: the first maximum and the first minimum of the gas volume.

use serde::{Deserialize, Serialize};

/// A bubble has grown when its volume has passed this many times the initial one.
const GROWN: f64 = 1.01;

/// Follows the gas volume from step to step and finds its first minimum below half the largest volume before it that a
/// rise of one per cent follows, and that largest volume; the times by parabolas through the three steps about them.
///
/// Of a bubble that starts at its largest the largest volume is the initial one.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct CollapseFinder {
    initial: Option<f64>,
    /// The last two samples (time, volume).
    last: [Option<[f64; 2]>; 2],
    /// The largest sample so far, and with its neighbours once both are there.
    largest: Option<[f64; 2]>,
    crest: Option<[[f64; 2]; 3]>,
    /// The lowest sample so far with its neighbours, once below half.
    lowest: Option<[[f64; 2]; 3]>,
    /// The lowest sample whose right neighbour has not come yet.
    pending: Option<[[f64; 2]; 2]>,
    found: Option<Extremum>,
}

/// A maximum or a minimum of the gas volume.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Extremum {
    /// When, s.
    pub time: f64,
    /// The volume then, in the unit of the samples.
    pub volume: f64,
}

impl CollapseFinder {
    /// Takes the next sample.
    pub fn push(&mut self, time: f64, volume: f64) {
        let initial = *self.initial.get_or_insert(volume);
        let sample = [time, volume];
        if self.found.is_none() && initial > 0.0 {
            self.follow_growth(sample);
            let largest = self.largest.map_or(initial, |[_, volume]| volume);
            if let Some([before, low]) = self.pending.take() {
                self.lowest = Some([before, low, sample]);
            }
            let lowest = self.lowest.map_or(0.5 * largest, |three| three[1][1]);
            if let (Some(before), true) = (self.last[1], volume < lowest) {
                self.pending = Some([before, sample]);
            }
            if let Some(three) = self.lowest
                && volume > 1.01 * three[1][1]
            {
                self.found = Some(Extremum::between(three));
            }
        }
        self.last = [self.last[1], Some(sample)];
    }

    fn follow_growth(&mut self, sample: [f64; 2]) {
        if self.lowest.is_some() {
            return;
        }
        if let (Some(largest), [Some(before), Some(last)]) = (self.largest, self.last)
            && last == largest
            && sample[1] < last[1]
        {
            self.crest = Some([before, last, sample]);
        }
        if self.largest.is_none_or(|[_, volume]| sample[1] > volume) {
            self.largest = Some(sample);
        }
    }

    /// The minimum, once it is certain.
    pub fn found(&self) -> Option<Extremum> {
        self.found
    }

    /// Whether the bubble has grown from its start, and is larger now than ever before: nothing of its collapse has begun.
    pub fn is_growing(&self) -> bool {
        let grown = GROWN * self.initial.unwrap_or(0.0);
        self.lowest.is_none() && self.largest.is_some_and(|top| Some(top) == self.last[1] && top[1] > grown)
    }

    /// The largest volume so far, or before the collapse.
    pub fn largest(&self) -> Option<Extremum> {
        let [time, volume] = self.largest?;
        match self.crest {
            Some(three) if three[1] == [time, volume] => Some(Extremum::between(three)),
            _ => Some(Extremum { time, volume }),
        }
    }

    /// That of a bubble that has grown from its start, once it is certain that it grows no more before the collapse.
    pub fn grown(&self) -> Option<Extremum> {
        let largest = self.largest().filter(|largest| largest.volume > GROWN * self.initial.unwrap_or(0.0));
        let has_turned = self.crest.is_some_and(|three| self.largest.is_some_and(|top| top == three[1]));
        largest.filter(|_| has_turned)
    }
}

impl Extremum {
    fn between(three: [[f64; 2]; 3]) -> Self {
        let [time, volume] = vertex(three);
        Self { time, volume }
    }
}

/// The vertex (t, v) of the parabola through three samples about an extremum, or the middle one if they lie on a line.
pub fn vertex([[t0, v0], [t1, v1], [t2, v2]]: [[f64; 2]; 3]) -> [f64; 2] {
    let (left, right) = ((v1 - v0) / (t1 - t0), (v2 - v1) / (t2 - t1));
    let curvature = (right - left) / (t2 - t0);
    let bends = if v1 < v0 { curvature > 0.0 } else { curvature < 0.0 };
    if !bends || !curvature.is_finite() {
        return [t1, v1];
    }
    // v = v1 + slope (t − t1) + curvature (t − t1)²
    let slope = left + curvature * (t1 - t0);
    let shift = -slope / (2.0 * curvature);
    [t1 + shift, v1 - slope * slope / (4.0 * curvature)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn followed(volume: impl Fn(f64) -> f64) -> CollapseFinder {
        let mut finder = CollapseFinder::default();
        (0..=200).for_each(|k| finder.push(f64::from(k) * 0.013, volume(f64::from(k) * 0.013)));
        finder
    }

    fn find(volume: impl Fn(f64) -> f64) -> Option<Extremum> {
        followed(volume).found()
    }

    #[test]
    fn a_parabola_is_found_exactly() {
        let finder = followed(|t| 0.1 + (t - 1.234) * (t - 1.234));
        let collapse = finder.found().unwrap();
        assert!((collapse.time - 1.234).abs() < 1e-12);
        assert!((collapse.volume - 0.1).abs() < 1e-12);
        // It starts at its largest.
        assert_eq!(finder.largest(), Some(Extremum { time: 0.0, volume: 0.1 + 1.234 * 1.234 }));
        assert_eq!(finder.grown(), None);
    }

    #[test]
    fn a_dip_above_half_or_without_a_rise_is_none() {
        assert_eq!(find(|t| 0.8 + 0.1 * (3.0 * t).cos()), None);
        assert_eq!(find(|t| (-t).exp()), None);
        // A wiggle of less than one per cent on the way down is passed over.
        let collapse = find(|t| 0.2 + (t - 1.5) * (t - 1.5) + 5e-4 * (60.0 * t).sin()).unwrap();
        assert!((collapse.time - 1.5).abs() < 0.05);
    }

    #[test]
    fn a_bubble_that_grows_first_collapses_relative_to_its_largest_volume() {
        // From 0.1 to 1 at 0.8, to 0.3 at 1.8, which is more than half of what it started from, and above it.
        let volume = |t: f64| {
            if t < 1.4 {
                1.0 - 0.9 * ((t - 0.8) / 0.8).powi(2)
            } else {
                let fall = 1.0 - 0.9 * (0.75_f64).powi(2) - 0.3;
                0.3 + fall * ((t - 1.8) / 0.4).powi(2)
            }
        };
        let finder = followed(volume);
        let [collapse, largest] = [finder.found(), finder.grown()].map(Option::unwrap);
        assert!((collapse.time - 1.8).abs() < 1e-9 && (collapse.volume - 0.3).abs() < 1e-9, "{collapse:?}");
        assert!((largest.time - 0.8).abs() < 1e-9 && (largest.volume - 1.0).abs() < 1e-9, "{largest:?}");
        assert!(!finder.is_growing());
        // While it still grows nothing is said of a maximum.
        let growing = followed(|t| 1.0 + t);
        assert_eq!((growing.found(), growing.grown()), (None, None));
        assert!(growing.is_growing());
        // What falls and rises again, even beyond its start, does not grow towards a collapse.
        assert!(!followed(|t| 0.1 + (t - 1.0) * (t - 1.0)).is_growing());
    }
}
