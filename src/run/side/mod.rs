//! What the step loops need of either side, and how a side's part of a run ends.
//!
//! | module | is |
//! |---|---|
//! | [`fluid_side`], [`solid_side`] | one medium's part |
//! | [`coupled_solver`] | long and short steps of a solver, whichever medium it is for |
//! | [`cell_exchange`] | the paper's coupling schemes |
//! | [`load`] | a given pressure on a solid without a fluid |
//! | [`wall_faces`] | the faces on the interface, which change with the mesh |
//! | [`past`] | what was done before a run was taken up again |

pub mod cell_exchange;
pub mod coupled_solver;
pub mod fluid_side;
pub mod load;
pub mod past;
pub mod solid_side;
pub mod wall_faces;

use std::ops::DerefMut;
use std::time::{Duration, Instant};

use coupler::{CouplerError, FrameHeader, Link, LinkCounters, Meeting, StarSolver, TraceRow};
use mesh::GroupStep;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::case::Case;
use crate::output::{OutputError, ProgressLine, RunDirectory, summary};
use crate::run::RunError;
use crate::run::checkpoints::Keeper;
use crate::run::memory::MemoryWatch;
use crate::run::process::stop::Stop;
use crate::run::record::of_side::Record;
use crate::run::record::timed::{Clock, Timed};
use crate::run::schedule::{Plan, Progressed, Schedule};
use crate::run::side::coupled_solver::{CoupledSolver, StepRule};
use crate::run::side::fluid_side::Turn;
use crate::run::side::past::{Done, Past};

/// A solver in a run, with what is recorded of it.
pub struct InRun<R: Record> {
    solver: R::Solver,
    record: Option<R>,
    schedule: Schedule,
    rule: StepRule,
    meeting: Meeting,
    star: StarSolver,
    /// Outer radii of the own faces on the interface.
    edges: Vec<f64>,
    last_dt: f64,
    clock: Clock,
    memory: MemoryWatch,
    keeper: Option<Keeper>,
    past: Past,
}

impl<R: Record<Solver: CoupledSolver>> InRun<R> {
    /// A solver in its initial state at the beginning of a run.
    fn new(case: &Case, solver: R::Solver, record: Option<R>, memory: MemoryWatch) -> Self {
        Self {
            edges: solver.interface_edges(),
            solver,
            record,
            schedule: Schedule::new(&case.time.snapshots),
            rule: StepRule::of(case),
            meeting: Meeting::default(),
            star: case.coupling.star,
            last_dt: 0.0,
            clock: Clock::default(),
            memory,
            keeper: None,
            past: Past::after(Done::default()),
        }
    }

    /// Keeps checkpoints from now on.
    pub fn keep_with(&mut self, keeper: Keeper) {
        self.keeper = Some(keeper);
    }

    /// The solver.
    pub fn solver(&self) -> &R::Solver {
        &self.solver
    }

    /// What is recorded.
    pub fn record(&self) -> Option<&R> {
        self.record.as_ref()
    }

    /// Writes the rows of the histories that are still in memory.
    pub fn flush(&mut self) -> Result<(), RunError> {
        self.record.as_mut().map_or(Ok(()), Record::flush).map_err(RunError::Output)
    }

    /// What is recorded of it in the summary.
    fn summary(&self) -> Map<String, Value> {
        self.record.as_ref().map_or_else(Map::new, |record| record.summary(&self.solver))
    }

    /// When the next steps have to land, besides the times of snapshots; in a coupled run the fluid's counts.
    pub fn schedule_mut(&mut self) -> &mut Schedule {
        &mut self.schedule
    }

    /// The length of the last step, s.
    pub fn last_step(&self) -> f64 {
        self.last_dt
    }

    /// Records a step that has been made.
    fn recorded(&mut self, plan: Plan) -> Result<(), RunError> {
        let start = Instant::now();
        if let Some(record) = &mut self.record {
            record.after_step(&self.solver, plan)?;
        }
        self.clock.recording += start.elapsed();
        Ok(())
    }

    /// What of it changes in time beside solver and record; the link's counters are `counters`.
    fn saved(&self, counters: LinkCounters) -> InRunState {
        // Field by field, so that a new one cannot be forgotten here.
        let Self {
            solver: _,
            record: _,
            schedule,
            rule: _,
            meeting,
            star: _,
            edges: _,
            last_dt,
            clock,
            memory: _,
            keeper: _,
            past,
        } = self;
        InRunState {
            schedule: schedule.saved(),
            floored: meeting.saved(),
            last_dt: *last_dt,
            clock: *clock,
            done: past.saved(counters),
        }
    }

    /// Goes on where it was when that was kept.
    fn restore(&mut self, InRunState { schedule, floored, last_dt, clock, done }: InRunState) {
        self.schedule.restore(schedule);
        self.meeting = Meeting::restored(floored);
        self.last_dt = last_dt;
        self.clock = clock;
        self.past = Past::after(done);
    }

    /// A progress line of it alone.
    fn line(&self, limited_by: &str) -> ProgressLine {
        ProgressLine {
            time: self.solver.time(),
            step: self.solver.steps(),
            dt: self.last_dt,
            limited_by: limited_by.to_owned(),
            cells: self.solver.mesh().cells() as u64,
            solid_cells: 0,
            wall: 0.0,
        }
    }

    /// Shows the other side its trace before a step of length `dt`; how long it took to fill the frame.
    fn show_trace(
        &self,
        link: &mut impl Link,
        header: FrameHeader,
        dt: f64,
    ) -> Result<Duration, CouplerError> {
        let (start, mut filled) = (Instant::now(), Duration::ZERO);
        let faces = self.edges.len();
        link.send(header, |payload| {
            payload[TraceRow::Edge as usize * faces..][..faces].copy_from_slice(&self.edges);
            self.solver.write_trace(dt, |row, face, value| payload[row as usize * faces + face] = value);
            filled = start.elapsed();
        })?;
        Ok(filled)
    }

    /// Begins a step whose end depends on the other side, see [`coupled_solver::begin_long`].
    fn begin_long(&mut self, plan: Plan) -> Result<GroupStep, RunError> {
        let start = Instant::now();
        let step = coupled_solver::begin_long(&mut self.solver, plan.dt, &self.rule)?;
        self.clock.computing += start.elapsed();
        Ok(step)
    }

    /// Makes short steps within the other side's, of which the trace has been read; see [`coupled_solver::short_steps`].
    fn short_steps(
        &mut self,
        plan: Plan,
        answer: impl FnMut(&R::Solver, &Meeting) -> Result<(), RunError>,
    ) -> Result<(), RunError> {
        let Self { solver, record, rule, meeting, star, clock, .. } = self;
        let after = Timed::new(clock).recorded(record, plan);
        coupled_solver::short_steps(solver, meeting, (plan.dt, *star), rule, answer, after)
    }

    /// Whether it is time to keep a checkpoint, before the next step.
    fn checkpoint_is_due(&mut self) -> bool {
        // No more than two steps such as the last are left.
        let left = self.schedule.end_time() - self.solver.time();
        let ends = left > 0.0 && left <= 2.0 * self.last_dt * (1.0 + 1e-9);
        self.keeper.as_mut().is_some_and(|keeper| keeper.is_due(ends))
    }
}

/// What `InRun::saved` keeps.
#[derive(Serialize, Deserialize)]
pub struct InRunState {
    schedule: Progressed,
    floored: u64,
    last_dt: f64,
    clock: Clock,
    done: Done,
}

/// What the loops need of either side; [`fluid_side::FluidSide`] and [`solid_side::SolidSide`] are the two.
pub trait RunSide: DerefMut<Target = InRun<Self::Record>> {
    /// What is recorded of it.
    type Record: Record<Solver: CoupledSolver>;
    /// "fluid" or "solid".
    const NAME: &'static str;
    /// The file of its part of the summary.
    const SUMMARY: &'static str;

    /// One step without the other side; `false` when the run is over.
    fn step_alone(&mut self) -> Result<bool, RunError>;
    /// Its part of a coupled step.
    fn turn(&mut self, link: &mut impl Link, stop: &Stop) -> Result<Turn, RunError>;
    /// Leaves what another run can begin with, once this one is complete.
    fn leave(&self, _directory: &RunDirectory) -> Result<(), RunError> {
        Ok(())
    }
    /// Its part of the summary.
    fn summary(&self) -> Map<String, Value>;
    /// Writes a checkpoint.
    fn keep_by(&self, keeper: &mut Keeper, step: u64, counters: LinkCounters) -> Result<(), OutputError>;
    /// What a progress line says of it; `cells` are its own and those of the other side that it knows of, `wall` is
    /// left at 0.
    fn line(&self) -> ProgressLine;

    /// Keeps a checkpoint, named by the fluid's `step` in a coupled run, if this run keeps any; whether it did.
    fn keep(&mut self, step: u64, counters: LinkCounters) -> Result<bool, RunError> {
        let Some(mut keeper) = self.keeper.take() else { return Ok(false) };
        let start = Instant::now();
        if let Some(record) = &mut self.record {
            record.settle()?;
        }
        let kept = self.keep_by(&mut keeper, step, counters);
        self.keeper = Some(keeper);
        self.clock.checkpointing += start.elapsed();
        Ok(kept.map(|()| true)?)
    }

    /// The same of a side that steps alone, if it is time to or the run is stopped.
    fn keep_alone(&mut self, is_stopped: bool) -> Result<(), RunError> {
        if is_stopped || self.checkpoint_is_due() {
            self.keep(self.solver.steps(), LinkCounters::default())?;
        }
        Ok(())
    }
}

/// A side's progress.
pub(super) fn line(side: &impl RunSide) -> ProgressLine {
    ProgressLine { wall: side.past.wall().as_secs_f64(), ..side.line() }
}

/// Writes what is left to write of a side, and its part of the summary.
pub(super) fn end<S: RunSide>(
    side: &mut S,
    directory: Option<&RunDirectory>,
    result: Result<Turn, RunError>,
    counters: LinkCounters,
) -> Result<(), RunError> {
    let failed = matches!(&result, Err(error) if error.exit_code() == 3);
    let InRun { solver, record, .. } = &mut **side;
    if let Some(record) = record {
        record.close(solver, failed)?;
    }
    if let Some(directory) = directory {
        if matches!(result, Ok(Turn::Over(0))) {
            side.leave(directory)?;
        }
        summary::write(directory, S::SUMMARY, &part(side, &result, counters))?;
    }
    concluded(result)
}

/// A side's part of the summary.
pub(super) fn part<S: RunSide>(
    side: &S,
    result: &Result<Turn, RunError>,
    counters: LinkCounters,
) -> Map<String, Value> {
    let mut part = side.summary();
    part.extend(progress_part(side, result, counters));
    part
}

fn concluded(result: Result<Turn, RunError>) -> Result<(), RunError> {
    match result? {
        Turn::Over(flags) => Stop::error(flags).map_or(Ok(()), Err),
        Turn::Continues => unreachable!("a loop ends with the end"),
    }
}

/// What the summary says of a side's part in the run.
fn progress_part<S: RunSide>(
    side: &S,
    result: &Result<Turn, RunError>,
    counters: LinkCounters,
) -> Map<String, Value> {
    let completed = matches!(result, Ok(Turn::Over(0)));
    let (solver, clock) = (side.solver(), side.clock);
    let counters = side.past.exchanged(counters);
    let mut coupling = json!({
        "exchanges": counters.received,
        "bytes": counters.bytes,
    });
    coupling[S::NAME] = json!({
        "seconds_computing": clock.computing.as_secs_f64(),
        "seconds_adapting": clock.adapting.as_secs_f64(),
        "seconds_recording": clock.recording.as_secs_f64(),
        "seconds_checkpointing": clock.checkpointing.as_secs_f64(),
        "seconds_waited": counters.waited.as_secs_f64(),
        "seconds_exchanging": counters.exchanging.as_secs_f64(),
        "exchange_seconds": {
            "p50": counters.latencies.percentile(0.5),
            "p90": counters.latencies.percentile(0.9),
            "p99": counters.latencies.percentile(0.99),
            "p999": counters.latencies.percentile(0.999),
            "largest": counters.latencies.percentile(1.0),
        },
    });
    let stages: Map<String, Value> =
        solver.stage_seconds().into_iter().map(|(name, seconds)| (name.to_owned(), json!(seconds))).collect();
    let mut part = Map::new();
    part.insert("stage_seconds".to_owned(), json!({ S::NAME: stages }));
    part.insert("completed".to_owned(), json!(completed));
    part.insert("t_end".to_owned(), json!(solver.time()));
    part.insert("steps".to_owned(), json!(solver.steps()));
    part.insert("wall_seconds".to_owned(), json!(side.past.wall().as_secs_f64()));
    part.insert("coupling".to_owned(), coupling);
    if let Err(error) = result {
        part.insert("error".to_owned(), json!(error.to_string()));
        part.insert("exit_code".to_owned(), json!(error.exit_code()));
    }
    part
}
