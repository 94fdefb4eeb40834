//! How far the surface of the solid is from rest.

use serde::{Deserialize, Serialize};

use super::displacement::SurfaceDisplacement;
use super::pit::is_far;

/// A pit shallower than this share of the largest indentation there was cannot be told from what elastic waves and the sides of the
/// domain leave.
const FLOOR: f64 = 0.01;

/// Where there is no deep pit, motion is measured by this share of the largest indentation.
const SHALLOW: f64 = 0.1;

/// The surface is still if what moves would change the depth by no more than this share of it while a shear wave crosses it.
const STILL: f64 = 0.01;

/// What has been seen of the surface.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rest {
    /// The time of a shear wave across the surface, s.
    transit: f64,
    /// Until when something presses on it, s.
    loaded_until: f64,
    /// The depth below the level far away, m, and the largest there was.
    depth: f64,
    deepest: f64,
    /// The largest speed on the surface, m/s.
    fastest: f64,
    /// Since when it has been still, s.
    since: Option<f64>,
}

impl Rest {
    /// A surface on which nothing has happened.
    ///
    /// - `transit`: the time of a shear wave across it, s; `loaded_until`: when the last load ends, s.
    pub fn new(transit: f64, loaded_until: f64) -> Self {
        Self { transit, loaded_until, depth: 0.0, deepest: 0.0, fastest: 0.0, since: None }
    }

    /// Takes notice of the surface at the end of a step of the whole.
    pub fn look(&mut self, time: f64, surface: &SurfaceDisplacement) {
        self.see(time, surface.fastest(), depth_of(surface));
    }

    fn see(&mut self, time: f64, fastest: f64, depth: f64) {
        (self.fastest, self.depth, self.deepest) = (fastest, depth, self.deepest.max(depth));
        let is_still = time >= self.loaded_until && self.still() <= STILL;
        self.since = if is_still { self.since.or(Some(time)) } else { None };
    }

    /// How far from rest: the largest speed on the surface times the transit time, over the depth of the pit or over a tenth of the
    /// largest indentation there was, whichever is larger. 0 where nothing moves.
    pub fn still(&self) -> f64 {
        if self.fastest == 0.0 {
            return 0.0;
        }
        self.fastest * self.transit / self.depth.max(SHALLOW * self.deepest)
    }

    /// Whether the surface has been still for as long as a shear wave takes across it, after the last load.
    pub fn is_settled(&self, time: f64) -> bool {
        self.since.is_some_and(|since| time - since >= self.transit)
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

    #[test]
    fn a_surface_is_settled_a_transit_after_it_has_come_to_rest_and_not_before_the_last_load() {
        let mut rest = Rest::new(2.0, 5.0);
        rest.see(1.0, 0.0, 0.0);
        assert_eq!(rest.still(), 0.0);
        assert!(!rest.is_settled(4.0), "nothing has pressed on it yet");
        rest.see(4.0, 1e-6, 1e-6);
        assert_eq!(rest.still(), 2.0);
        rest.see(5.0, 4.9e-9, 1e-6);
        assert!(!rest.is_settled(6.9) && rest.is_settled(7.1));
        // Something comes back.
        rest.see(6.0, 6e-9, 1e-6);
        assert!(!rest.is_settled(9.0));
        // A shallow pit is judged by the indentation there was.
        rest.see(7.0, 4.9e-10, 1e-9);
        assert!((rest.still() - 0.0098).abs() < 1e-12);
        assert!(rest.is_settled(9.1));
        assert_eq!(rest.pit_floor(), 1e-8);
    }
}
