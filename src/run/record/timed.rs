//! Shares of a run's wall time.

use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use crate::run::RunError;
use crate::run::record::of_side::Record;
use crate::run::schedule::Plan;
use crate::run::side::coupled_solver::CoupledSolver;

/// Shares of the run's wall time.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Clock {
    /// Time in the solver and in the exchange's own computation.
    pub computing: Duration,
    /// Of that, adapting the grid.
    pub adapting: Duration,
    /// Time in diagnostics and output.
    pub recording: Duration,
    /// Time in checkpoints, what they wait for in output included.
    pub checkpointing: Duration,
}

/// A stretch of computing, interrupted by recording.
pub struct Timed<'a> {
    clock: &'a mut Clock,
    since: Instant,
}

impl<'a> Timed<'a> {
    /// Begins now.
    pub fn new(clock: &'a mut Clock) -> Self {
        Self { clock, since: Instant::now() }
    }

    /// What is to be called after each step of the finest level: it is recorded, the last one with the snapshot that
    /// `plan` asks for.
    pub fn recorded<M: CoupledSolver + 'a, R: Record<Solver = M>>(
        mut self,
        record: &'a mut Option<R>,
        plan: Plan,
    ) -> impl FnMut(&M, f64) -> Result<(), RunError> + 'a {
        move |solver, dt| {
            self.clock.computing += self.since.elapsed();
            let start = Instant::now();
            if let Some(record) = record {
                let snapshot = plan.snapshot && solver.clock().is_over();
                record.after_step(solver, Plan { dt, snapshot })?;
            }
            self.clock.recording += start.elapsed();
            self.since = Instant::now();
            Ok(())
        }
    }
}
