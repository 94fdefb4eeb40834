//! How far the surface of the solid is from rest.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use super::displacement::SurfaceDisplacement;
use super::pit::{far, is_far};

/// A pit shallower than this share of the largest indentation there was cannot be told from what the sides of the domain leave of
/// elastic waves: 1.5 % of it after the load, then falling, in a domain of 16 radii of the load (`tests/coupled/surface.rs`).
const FLOOR: f64 = 0.02;

/// Where there is no deep pit, changes are measured by this share of the largest indentation.
const SHALLOW: f64 = 0.1;

/// The surface is still if its displacement changes by no more than this share of the depth while a shear wave crosses it.
const STILL: f64 = 0.01;

/// How often within that time it is looked at.
const LOOKS: f64 = 4.0;

/// What has been seen of the surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rest {
    /// The time of a shear wave across the surface, s.
    transit: f64,
    /// Until when something presses on it, s.
    loaded_until: f64,
    /// The largest depth below the level far away, m: now, and ever.
    depth: f64,
    deepest: f64,
    /// Earlier times, s, with the displacements against the level far away, m: the first is a transit old or from t = 0.
    past: VecDeque<(f64, Vec<f64>)>,
    is_settled: bool,
}

impl Rest {
    /// A surface to which nothing has happened since t = 0.
    ///
    /// - `transit`: the time of a shear wave across it, s; `loaded_until`: when the last load ends, s.
    pub fn new(surface: &SurfaceDisplacement, transit: f64, loaded_until: f64) -> Self {
        Self::at(depth_of(surface), relative(surface), transit, loaded_until)
    }

    fn at(depth: f64, relative: Vec<f64>, transit: f64, loaded_until: f64) -> Self {
        let past = VecDeque::from([(0.0, relative)]);
        Self { transit, loaded_until, depth, deepest: depth, past, is_settled: false }
    }

    /// Whether it can be of a surface of so many faces.
    pub fn fits(&self, faces: usize) -> bool {
        !self.past.is_empty() && self.past.iter().all(|(_, relative)| relative.len() == faces)
    }

    /// Takes notice of the surface at the end of a step of the whole.
    pub fn look(&mut self, time: f64, surface: &SurfaceDisplacement) {
        self.see(time, depth_of(surface), || relative(surface));
    }

    fn see(&mut self, time: f64, depth: f64, relative: impl FnOnce() -> Vec<f64>) {
        (self.depth, self.deepest) = (depth, self.deepest.max(depth));
        let last = self.past.back().map_or(0.0, |(last, _)| *last);
        if !(time - last >= self.transit / LOOKS) {
            return;
        }
        self.past.push_back((time, relative()));
        while self.past.len() > 2 && self.past[1].0 <= time - self.transit {
            self.past.pop_front();
        }
        let (since, _) = self.past[0];
        let is_whole = since >= self.loaded_until && time - since >= self.transit;
        self.is_settled = is_whole && self.changed(&self.past[self.past.len() - 1].1) <= STILL;
    }

    /// The largest change of these displacements against any in the last transit time, as a share: what swings has come back in between.
    fn changed(&self, relative: &[f64]) -> f64 {
        let pairs = self.past.iter().flat_map(|(_, before)| before.iter().zip(relative));
        let change = pairs.fold(0.0_f64, |most, (before, now)| most.max((now - before).abs()));
        if change == 0.0 { 0.0 } else { change / self.depth.max(SHALLOW * self.deepest) }
    }

    /// How far from rest: by how much u_z against the level far away differs at most from what it was at any time looked at since a shear wave's
    /// time across the surface ago (or up to 5/4 of it), over the depth of the pit or over a tenth of the largest indentation there was, whichever is larger.
    pub fn still(&self, surface: &SurfaceDisplacement) -> f64 {
        self.changed(&relative(surface))
    }

    /// Whether the surface has become still after the last load.
    pub fn is_settled(&self) -> bool {
        self.is_settled
    }

    /// The depth of a pit that can be told from none, m.
    pub fn pit_floor(&self) -> f64 {
        FLOOR * self.deepest
    }

    /// The largest indentation there was, m.
    pub fn deepest(&self) -> f64 {
        self.deepest
    }
}

/// u_z against the level far away, m.
fn relative(surface: &SurfaceDisplacement) -> Vec<f64> {
    let mut displacement: Vec<f64> = surface.profile().iter().map(|[u_z, _]| *u_z).collect();
    let far = far(&displacement);
    displacement.iter_mut().for_each(|u| *u -= far);
    displacement
}

/// The largest depth below the level far away, m.
fn depth_of(surface: &SurfaceDisplacement) -> f64 {
    let (count, mut k) = (surface.len(), 0);
    let (mut sum, mut far, mut lowest) = (0.0, 0, f64::INFINITY);
    for (faces, u) in surface.faces() {
        if is_far(k, count) {
            (sum, far) = (sum + faces as f64 * u, far + faces);
        }
        lowest = u.min(lowest);
        k += faces;
    }
    if far == 0 { 0.0 } else { (sum / far as f64 - lowest).max(0.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Looks at a surface of one face every tenth of a transit time of 1; whether it has settled at the end.
    fn settled(from: f64, to: f64, rest: &mut Rest, depth: impl Fn(f64) -> f64) -> bool {
        let steps = ((to - from) * 10.0).round() as usize;
        for k in 1..=steps {
            let time = from + k as f64 / 10.0;
            rest.see(time, depth(time), || vec![-depth(time)]);
        }
        rest.is_settled()
    }

    #[test]
    fn a_surface_is_settled_when_it_has_been_still_for_a_transit_after_the_last_load() {
        let mut rest = Rest::at(0.0, vec![0.0], 1.0, 5.0);
        assert!(!settled(0.0, 4.0, &mut rest, |_| 0.0), "nothing has pressed on it yet");
        assert!(!settled(4.0, 5.5, &mut rest, |_| 1e-6));
        assert!(settled(5.5, 7.0, &mut rest, |_| 1e-6));
        assert_eq!(rest.changed(&[-1e-6]), 0.0);
        assert!((rest.changed(&[-1.1e-6]) - 0.1).abs() < 1e-12);
        // Something comes back.
        assert!(!settled(7.0, 8.0, &mut rest, |time| 1e-6 + 1e-7 * (time - 7.0)));
        assert!(rest.past.len() <= 6, "{}", rest.past.len());
        assert!((rest.pit_floor() - 0.02 * 1.1e-6).abs() < 1e-20);
    }

    #[test]
    fn a_surface_that_swings_is_not_still_where_it_comes_back() {
        let mut rest = Rest::at(0.0, vec![0.0], 1.0, 0.0);
        // With the transit as period it is after each where it was before.
        let swings = |time: f64| 1e-6 * (1.0 + 0.1 * (std::f64::consts::TAU * time).sin());
        assert!(!settled(0.0, 6.0, &mut rest, swings));
    }

    #[test]
    fn a_shallow_pit_is_judged_by_the_indentation_there_was() {
        let mut rest = Rest::at(0.0, vec![0.0], 1.0, 0.0);
        assert!(!settled(0.0, 3.0, &mut rest, |time| 1e-6 * (1.0 - (time - 1.0).abs())));
        // A slow return from a thousandth: over the depth it would be much.
        assert!(settled(3.0, 6.0, &mut rest, |time| 1e-9 * (1.0 - 0.3 * (time - 3.0))));
    }
}
