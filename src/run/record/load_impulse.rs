//! The impulse of a load: of what the pressure on the wall has beyond the pressure far away.

use serde::{Deserialize, Serialize};

/// The largest rise of the time integral of the pressure beyond that far away, above its lowest value before.
///
/// Where a run begins with another pressure than that far away, the impulse beyond the first one grows for as long as the run goes
/// on; this does not.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct LoadImpulse {
    /// Time integral since t = 0, and the least of it so far, Pa s.
    integral: f64,
    lowest: f64,
    /// Largest rise so far, Pa s, and at its end, s.
    peak: [f64; 2],
}

impl LoadImpulse {
    /// Takes notice of a step of length `dt` that ended at `time` with this mean pressure beyond that far away, Pa.
    pub fn after_step(&mut self, beyond: f64, (time, dt): (f64, f64)) {
        self.integral += dt * beyond;
        self.lowest = self.lowest.min(self.integral);
        if self.integral - self.lowest > self.peak[0] {
            self.peak = [self.integral - self.lowest, time];
        }
    }

    /// The largest rise so far, Pa s, and when it ended, s.
    pub fn peak(&self) -> [f64; 2] {
        self.peak
    }
}
