//! When to stop, when to write, and so how long a step may be.

/// A step about to be made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Its length, s.
    pub dt: f64,
    /// Whether a snapshot is due at its end.
    pub snapshot: bool,
}

/// The times at which snapshots are due; the run ends with the last one.
#[derive(Clone, Debug, PartialEq)]
pub struct Schedule {
    times: Vec<f64>,
    next: usize,
}

impl Schedule {
    /// From ascending times, the last of which is the end of the run. Times at or before 0 are taken as done.
    pub fn new(times: &[f64]) -> Self {
        Self { times: times.to_vec(), next: times.partition_point(|t| *t <= 0.0) }
    }

    /// Whether the end has been reached.
    pub fn is_over(&self) -> bool {
        self.next == self.times.len()
    }

    /// The next step from `time` if none may be longer than `limit`. A step that would end shortly before a due
    /// time is halved rather than leaving a splinter. `None` when the run is over.
    pub fn plan(&mut self, time: f64, limit: f64) -> Option<Plan> {
        let due = *self.times.get(self.next)?;
        let left = due - time;
        if left <= limit * (1.0 + 1e-10) {
            self.next += 1;
            Some(Plan { dt: left, snapshot: true })
        } else if left < 2.0 * limit {
            Some(Plan { dt: 0.5 * left, snapshot: false })
        } else {
            Some(Plan { dt: limit, snapshot: false })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_land_on_due_times_without_splinters() {
        let mut schedule = Schedule::new(&[0.0, 1.0, 1.05, 2.0]);
        let (mut time, mut snapshots, mut shortest) = (0.0, vec![], f64::INFINITY);
        while let Some(plan) = schedule.plan(time, 0.3) {
            time += plan.dt;
            shortest = plan.dt.min(shortest);
            assert!(plan.dt <= 0.3 * (1.0 + 1e-9));
            if plan.snapshot {
                snapshots.push(time);
            }
        }
        assert!(schedule.is_over());
        assert_eq!(snapshots.len(), 3);
        for (got, want) in snapshots.iter().zip([1.0, 1.05, 2.0]) {
            assert!((got - want).abs() < 1e-15);
        }
        assert!(shortest > 0.04, "{shortest}");
    }
}
