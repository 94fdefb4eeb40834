//! When to adapt next.

use serde::{Deserialize, Serialize};

/// How long the marks of an adaptation hold.
///
/// Blocks are kept fine as far as waves travel until the next adaptation; if steps grow, or waves would get
/// farther than the next block, it comes sooner than its number of steps says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Horizon {
    steps: u32,
    until: f64,
}

impl Horizon {
    /// Takes notice of `made` steps; whether to adapt before the next ones, which take `dt` from `time`.
    pub fn is_due(&mut self, every: u32, made: u32, time: f64, dt: f64) -> bool {
        self.steps = self.steps.saturating_add(made);
        self.steps >= every || time + dt > self.until * (1.0 + 1e-12)
    }

    /// Sets the time until which the marks made at `time` hold: `every` steps, or so many times `dt` in which `made` of them
    /// are made, no longer than `longest`. Returns the span, s.
    pub fn renew(&mut self, every: u32, made: u32, time: f64, dt: f64, longest: f64) -> f64 {
        let span = ((f64::from(every) / f64::from(made)).max(1.0) * dt).min(longest);
        *self = Self { steps: 0, until: time + span };
        span
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn adaptation_comes_after_its_steps_or_sooner_if_they_grow() {
        let mut horizon = Horizon::default();
        assert!(horizon.is_due(4, 1, 0.0, 1.0), "at once, at first");
        assert_eq!(horizon.renew(4, 1, 0.0, 1.0, 100.0), 4.0);
        assert!(!horizon.is_due(4, 1, 1.0, 1.0));
        assert!(!horizon.is_due(4, 1, 2.0, 2.0));
        assert!(horizon.is_due(4, 1, 4.0, 2.0), "the third step would end beyond the horizon");
        assert_eq!(horizon.renew(4, 1, 4.0, 2.0, 3.0), 3.0);
        assert!(!horizon.is_due(4, 1, 4.5, 0.5));
        assert!(!horizon.is_due(4, 1, 5.0, 0.5));
        assert!(!horizon.is_due(4, 1, 5.5, 0.5));
        assert!(horizon.is_due(4, 1, 6.0, 0.5));
    }
}
