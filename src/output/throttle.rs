//! One call per interval.

use std::time::{Duration, Instant};

/// Lets through one call per interval: a side's process asks it before it tells the launcher of a step.
#[derive(Debug)]
pub struct Throttle {
    interval: Duration,
    last: Option<Instant>,
}

impl Throttle {
    /// One call per `interval`.
    pub fn new(interval: Duration) -> Self {
        Self { interval, last: None }
    }

    /// Whether the interval has passed since this last said yes; the first time it says yes.
    pub fn is_due(&mut self) -> bool {
        self.is_due_at(Instant::now())
    }

    fn is_due_at(&mut self, now: Instant) -> bool {
        let due = self.last.is_none_or(|last| now.duration_since(last) >= self.interval);
        if due {
            self.last = Some(now);
        }
        due
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_throttle_lets_one_call_through_per_interval() {
        let mut throttle = Throttle::new(Duration::from_secs(2));
        let start = Instant::now();
        let due: Vec<bool> =
            (0..6).map(|second| throttle.is_due_at(start + Duration::from_secs(second))).collect();
        assert_eq!(due, [true, false, true, false, true, false]);
    }
}
