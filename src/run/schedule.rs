//! When to stop, when to write, and so how long a step may be.

use serde::{Deserialize, Serialize};

/// A step about to be made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Its length, s.
    pub dt: f64,
    /// Whether a snapshot is due at its end.
    pub snapshot: bool,
}

/// How far a schedule is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Progressed {
    next: usize,
    landing: Option<f64>,
}

/// The times at which snapshots are due; the run ends with the last one.
#[derive(Clone, Debug, PartialEq)]
pub struct Schedule {
    times: Vec<f64>,
    next: usize,
    /// A time at which a step has to end besides, without a snapshot.
    landing: Option<f64>,
    /// The same, once a step to it is planned.
    planned: Option<f64>,
}

impl Schedule {
    /// From ascending times, the last of which is the end of the run. Times at or before 0 are taken as done.
    pub fn new(times: &[f64]) -> Self {
        Self {
            times: times.to_vec(),
            next: times.partition_point(|t| *t <= 0.0),
            landing: None,
            planned: None,
        }
    }

    /// How far it is.
    pub fn saved(&self) -> Progressed {
        let Self { times: _, next, landing, planned: _ } = self;
        Progressed { next: *next, landing: *landing }
    }

    /// Goes on where a schedule of the same times was.
    pub fn restore(&mut self, Progressed { next, landing }: Progressed) {
        self.next = next.min(self.times.len());
        self.landing = landing;
    }

    /// Whether the end has been reached.
    pub fn is_over(&self) -> bool {
        self.next == self.times.len()
    }

    /// The time at which the run ends.
    pub fn end_time(&self) -> f64 {
        self.times.last().copied().unwrap_or(0.0)
    }

    /// Ends the run with the step that has been made.
    pub fn end(&mut self) {
        self.next = self.times.len();
    }

    /// Makes a step end at `time`, too, once; a time that is past is forgotten.
    pub fn land_at(&mut self, time: f64) {
        self.landing = Some(time);
    }

    /// The time that [`Schedule::land_at`] has set, until a step to it is planned.
    pub fn landing(&self) -> Option<f64> {
        self.landing
    }

    /// The next step from `time` if none may be longer than `limit`. A step that would end shortly before a due
    /// time is halved rather than leaving a splinter. `None` when the run is over.
    pub fn plan(&mut self, time: f64, limit: f64) -> Option<Plan> {
        let snapshot_due = *self.times.get(self.next)?;
        self.landing = self.landing.filter(|landing| *landing > time);
        self.planned = None;
        let due = self.landing.map_or(snapshot_due, |landing| landing.min(snapshot_due));
        let left = due - time;
        if left <= limit * (1.0 + 1e-10) {
            let snapshot = due == snapshot_due;
            self.next += usize::from(snapshot);
            self.planned = self.landing.filter(|landing| *landing <= due);
            self.landing = self.landing.filter(|landing| *landing > due);
            Some(Plan { dt: left, snapshot })
        } else if left < 2.0 * limit {
            Some(Plan { dt: 0.5 * left, snapshot: false })
        } else {
            Some(Plan { dt: limit, snapshot: false })
        }
    }

    /// The plan that takes the place of one which turns out to be too long: shorter, and with nothing due at its end.
    pub fn shorten(&mut self, plan: Plan, dt: f64) -> Plan {
        self.next -= usize::from(plan.snapshot);
        self.landing = self.landing.or(self.planned.take());
        Plan { dt, snapshot: false }
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

    #[test]
    fn a_step_lands_where_it_is_asked_to_and_makes_no_snapshot_there() {
        let mut schedule = Schedule::new(&[0.0, 1.0]);
        schedule.land_at(0.5);
        let mut time = 0.0;
        while schedule.landing().is_some() {
            let plan = schedule.plan(time, 0.2).expect("not over");
            assert!(!plan.snapshot);
            time += plan.dt;
        }
        assert!((time - 0.5).abs() < 1e-15, "{time}");
        assert_eq!(schedule.plan(time, 0.2), Some(Plan { dt: 0.2, snapshot: false }));
        // A step to it that turns out to be too long leaves it as it is.
        schedule.land_at(0.6);
        let plan = schedule.plan(0.5, 0.2).expect("not over");
        assert_eq!((schedule.shorten(plan, 0.04).dt, schedule.landing()), (0.04, Some(0.6)));
        let plan = schedule.plan(0.54, 0.2).expect("not over");
        assert!((plan.dt - 0.06).abs() < 1e-15 && schedule.landing().is_none(), "{plan:?}");
        // On a snapshot's own time it is the snapshot that counts; what is past is forgotten.
        schedule.land_at(1.0);
        assert_eq!(schedule.plan(0.9, 0.2), Some(Plan { dt: 1.0 - 0.9, snapshot: true }));
        assert!(schedule.is_over());
    }
}
