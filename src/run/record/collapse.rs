//! The collapse time: the first minimum of the gas volume.

use serde::{Deserialize, Serialize};

/// Follows the gas volume from step to step and finds its first minimum below half the initial volume that a
/// rise of one per cent follows; the time by a parabola through the three steps about it.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct CollapseFinder {
    initial: Option<f64>,
    /// The last two samples (time, volume).
    last: [Option<[f64; 2]>; 2],
    /// The lowest sample so far with its neighbours, once below half.
    lowest: Option<[[f64; 2]; 3]>,
    /// The lowest sample whose right neighbour has not come yet.
    pending: Option<[[f64; 2]; 2]>,
    found: Option<Collapse>,
}

/// The first minimum of the gas volume.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Collapse {
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
            if let Some([before, low]) = self.pending.take() {
                self.lowest = Some([before, low, sample]);
            }
            let lowest = self.lowest.map_or(0.5 * initial, |three| three[1][1]);
            if let (Some(before), true) = (self.last[1], volume < lowest) {
                self.pending = Some([before, sample]);
            }
            if let Some(three) = self.lowest
                && volume > 1.01 * three[1][1]
            {
                self.found = Some(vertex(three));
            }
        }
        self.last = [self.last[1], Some(sample)];
    }

    /// The minimum, once it is certain.
    pub fn found(&self) -> Option<Collapse> {
        self.found
    }
}

/// The vertex of the parabola through three samples, or the middle one if they lie on a line.
fn vertex([[t0, v0], [t1, v1], [t2, v2]]: [[f64; 2]; 3]) -> Collapse {
    let (left, right) = ((v1 - v0) / (t1 - t0), (v2 - v1) / (t2 - t1));
    let curvature = (right - left) / (t2 - t0);
    if curvature <= 0.0 || !curvature.is_finite() {
        return Collapse { time: t1, volume: v1 };
    }
    // v = v1 + slope (t − t1) + curvature (t − t1)²
    let slope = left + curvature * (t1 - t0);
    let shift = -slope / (2.0 * curvature);
    Collapse { time: t1 + shift, volume: v1 - slope * slope / (4.0 * curvature) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn find(volume: impl Fn(f64) -> f64) -> Option<Collapse> {
        let mut finder = CollapseFinder::default();
        (0..=200).for_each(|k| finder.push(f64::from(k) * 0.013, volume(f64::from(k) * 0.013)));
        finder.found()
    }

    #[test]
    fn a_parabola_is_found_exactly() {
        let collapse = find(|t| 0.1 + (t - 1.234) * (t - 1.234)).unwrap();
        assert!((collapse.time - 1.234).abs() < 1e-12);
        assert!((collapse.volume - 0.1).abs() < 1e-12);
    }

    #[test]
    fn a_dip_above_half_or_without_a_rise_is_none() {
        assert_eq!(find(|t| 0.8 + 0.1 * (3.0 * t).cos()), None);
        assert_eq!(find(|t| (-t).exp()), None);
        // A wiggle of less than one per cent on the way down is passed over.
        let collapse = find(|t| 0.2 + (t - 1.5) * (t - 1.5) + 5e-4 * (60.0 * t).sin()).unwrap();
        assert!((collapse.time - 1.5).abs() < 0.05);
    }
}
