//! The fluid's part of the step loop.
//!
//! In a coupled run the fluid leads: it chooses the longer of both sides' steps and whose it is. If it is its own, it sends
//! its trace on the wall and completes the step when the solid has answered with what the wall did; else it asks the solid
//! for its trace and answers. In the paper's schemes cell values cross instead, see [`crate::run::side::cell_exchange`].

mod cells;
mod side;

use std::time::Instant;

use coupler::{CommonRefinement, FrameHeader, FrameKind, Link, RegisterRow, StepLength, TraceRow};
use fluid::FluidSolver;
use mesh::{BLOCK, CompiledSolver as _, GroupStep, Misfit};

use crate::case::{Case, FluidCase, Medium};
use crate::output::RunDirectory;
use crate::run::RunError;
use crate::run::memory::MemoryWatch;
use crate::run::process::stop::Stop;
use crate::run::record::fluid_record::FluidRecord;
use crate::run::record::timed::Timed;
use crate::run::schedule::Plan;
use crate::run::setup::fluid_solver;
use crate::run::side::cell_exchange::CellExchange;
use crate::run::side::coupled_solver;
use crate::run::side::{InRun, RunSide};

pub mod saved;

/// What a turn came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Turn {
    /// The run goes on.
    Continues,
    /// The run is over, for the reason in the flags of the last frame (0: it is complete).
    Over(u32),
}

/// A step under way.
#[derive(Clone, Copy, Debug)]
enum Pending {
    /// The fluid's is the longer one, of which the solid has been shown the trace.
    Shown(Plan),
    /// What does not depend on the solid is done; it waits for what the solid makes of the rest.
    Long(Plan, GroupStep),
    /// The solid's is.
    Short(Plan),
    /// The solid makes its step first.
    Late(Plan),
    /// It is tried, until both sides agree on the interface.
    Trial(Plan, GroupStep),
    /// It is made here; the solid makes its own.
    Made,
}

/// The fluid with its place in a run.
pub struct FluidSide {
    own: InRun<FluidRecord>,
    /// What the paper's schemes need.
    cells: Option<CellExchange>,
    /// The step that waits for the solid.
    pending: Option<Pending>,
    /// The solid's last word: how long a step it allows, how many cells it has, what it was asked to do.
    answer: FrameHeader,
    /// The speed of sound of the liquid far away, m/s.
    sound: f64,
    /// The last word to the solid: what it answers has to be about that step.
    sent: FrameHeader,
    limited_by: &'static str,
    /// Whether the frame that this turn ends with asks the solid for its part of a checkpoint.
    tells_of_checkpoint: bool,
    /// Whether the solid's first word is about going on.
    is_resumed: bool,
}

mesh::derefs!([] FluidSide => InRun<FluidRecord>, own);

impl FluidSide {
    /// The fluid of a case; with a directory it writes what happens.
    pub fn new(case: &Case, fluid: &FluidCase, directory: Option<&RunDirectory>) -> Result<Self, RunError> {
        let solver = fluid_solver(case, fluid)?;
        let record = directory.map(|d| FluidRecord::create(case, Some(d), &solver)).transpose()?;
        Ok(Self::with(case, solver, record))
    }

    /// A fluid that has been made already, in its initial state.
    pub fn with(case: &Case, mut solver: FluidSolver<BLOCK>, record: Option<FluidRecord>) -> Self {
        for probe in case.probes.iter().filter(|probe| probe.medium == Medium::Fluid) {
            solver.watch(probe.position);
        }
        Self {
            cells: (case.coupling.scheme.exchanges_cells())
                .then(|| CellExchange::new(&case.coupling, solver.interface().faces())),
            pending: None,
            answer: FrameHeader::new(FrameKind::Register),
            sent: FrameHeader::new(FrameKind::Trace),
            sound: case.fluid.as_ref().map_or(0.0, |fluid| fluid.ambient_sound()),
            limited_by: "fluid",
            tells_of_checkpoint: false,
            is_resumed: false,
            own: InRun::new(case, solver, record, MemoryWatch::of(case.fluid_memory())),
        }
    }

    /// Ends the step under way with what the solid says; before the first step, takes its first word.
    ///
    /// - returns: whether the step has ended. If not, the solid has been told more, and its next word is to be waited for.
    pub fn complete(&mut self, link: &mut impl Link) -> Result<bool, RunError> {
        self.meanwhile()?;
        let pending = self.pending.take();
        if let Some(Pending::Short(plan)) = pending {
            self.step_shortly(link, plan)?;
            return Ok(true);
        }
        if pending.is_none() {
            return self.hear_first_word(link).map(|()| true);
        }
        self.answer = self.take_answer(link)?;
        match pending {
            Some(Pending::Long(plan, step)) => {
                let timed = Timed::new(&mut self.own.clock);
                let after = timed.recorded(&mut self.own.record, plan);
                coupled_solver::end_long(&mut self.own.solver, step, &self.own.rule, after)?;
            }
            Some(Pending::Late(plan)) => self.step_beside(plan)?,
            Some(Pending::Trial(plan, step)) => {
                self.judge(link, plan, step)?;
                return Ok(false);
            }
            Some(Pending::Short(_) | Pending::Shown(_) | Pending::Made) | None => {}
        }
        Ok(true)
    }

    /// Does what of a step under way does not depend on the solid, if there is any left: while the solid has its turn.
    pub fn meanwhile(&mut self) -> Result<(), RunError> {
        if let Some(Pending::Shown(plan)) = self.pending {
            self.pending = Some(Pending::Long(plan, self.own.begin_long(plan)?));
        }
        Ok(())
    }

    /// Takes the solid's first word, which it says before it knows of any faces: how long a step it allows. If a run was taken
    /// up again, only where it is: its last answer is known.
    fn hear_first_word(&mut self, link: &mut impl Link) -> Result<(), RunError> {
        let (time, is_resumed) = (self.own.solver.time(), std::mem::take(&mut self.is_resumed));
        let word = link.receive(|frame| {
            frame.require(FrameKind::Register)?;
            frame.require_empty()?;
            frame.require_limit()?;
            match frame.require_time(time) {
                Err(_) if is_resumed => {
                    let word = frame.header.time;
                    let what = format!("the fluid is at t = {time:e} s, the solid at {word:e} s");
                    return Err(Misfit(what).into());
                }
                other => other?,
            }
            Ok::<_, RunError>(*frame.header)
        })??;
        if is_resumed {
            self.own.past.leave_out(link.counters());
        } else {
            self.answer = word;
        }
        Ok(())
    }

    /// Begins a step: plans it and sends the trace on the wall, or asks the solid for its own.
    pub fn begin(&mut self, link: &mut impl Link, stop: &Stop) -> Result<Turn, RunError> {
        let stopped =
            self.answer.flags & (FrameHeader::STOP_INTERRUPT | FrameHeader::STOP_TERMINATE) | stop.flags();
        let is_over = stopped != 0 || self.own.schedule.is_over();
        let is_due = stopped != 0 || !is_over && self.own.checkpoint_is_due();
        self.tells_of_checkpoint =
            is_due && self.own.solver.steps() > 0 && self.keep(self.own.solver.steps(), link.counters())?;
        if is_over {
            let mut header = self.header(FrameKind::Trace, 0, 0.0);
            header.flags |= stopped | FrameHeader::LAST;
            link.send(header, |_| {})?;
            return Ok(Turn::Over(stopped));
        }
        self.adapt_if_due()?;
        let (own, others) = (self.own.rule.long(&self.own.solver).limit, self.answer.dt_max);
        let is_long = own >= others || self.own.rule.ratio == 1 || self.answer.has(FrameHeader::FOLLOWS);
        // No longer than the side with the longer steps allows, and than the other one can follow.
        let limit = if is_long {
            self.own.rule.longest(others)
        } else {
            others.min(self.own.rule.longest(self.own.rule.counted(&self.own.solver)))
        };
        let Some(plan) = self.plan(if is_long { own } else { f64::INFINITY }, limit)? else {
            return Ok(Turn::Over(0));
        };
        if self.cells.is_some() {
            self.begin_exchange(link, plan)?
        } else if is_long {
            self.show_trace(link, plan)?
        } else {
            self.ask_for_trace(link, plan)?
        }
        self.tells_of_checkpoint = false;
        Ok(Turn::Continues)
    }

    /// Asks the solid, whose step is the longer one, for its trace.
    fn ask_for_trace(&mut self, link: &mut impl Link, plan: Plan) -> Result<(), RunError> {
        let mut header = self.header(FrameKind::Yours, 0, plan.dt);
        header.dt_max = self.own.solver.time_step_limit(self.own.rule.cfl);
        if plan.snapshot {
            header.flags |= FrameHeader::SNAPSHOT;
        }
        link.send(header, |_| {})?;
        self.pending = Some(Pending::Short(plan));
        Ok(())
    }

    /// Shows the trace on the wall.
    fn show_trace(&mut self, link: &mut impl Link, plan: Plan) -> Result<(), RunError> {
        let faces = self.own.solver.interface().faces();
        let mut header = self.header(FrameKind::Trace, faces, plan.dt);
        if plan.snapshot {
            header.flags |= FrameHeader::SNAPSHOT;
        }
        header.fields = TraceRow::COUNT as u64;
        let filled = self.own.show_trace(link, header, plan.dt)?;
        // What comes after the frame is filled is the exchange.
        self.own.clock.computing += filled;
        self.pending = Some(Pending::Shown(plan));
        Ok(())
    }

    /// Makes short steps within the solid's, once its trace is there.
    fn step_shortly(&mut self, link: &mut impl Link, asked: Plan) -> Result<(), RunError> {
        let (solver, meeting, begin) = (&self.own.solver, &mut self.own.meeting, self.sent.time);
        let answer = link.receive(|frame| {
            frame.require(FrameKind::Trace)?;
            frame.require_step(begin, StepLength::AtMost(asked.dt))?;
            frame.require_limit()?;
            let trace = frame.trace(solver.mesh().domain().r)?;
            coupled_solver::begin_meeting(solver, meeting, trace);
            Ok::<_, coupler::CouplerError>(*frame.header)
        })??;
        self.answer = answer;
        // The solid's grid may have become finer meanwhile: what it says of its step counts.
        let plan = if answer.dt == asked.dt { asked } else { self.own.schedule.shorten(asked, answer.dt) };
        self.own.last_dt = plan.dt;
        let faces = answer.count as usize;
        let mut header = self.header(FrameKind::Register, faces, plan.dt);
        header.fields = RegisterRow::COUNT as u64;
        self.own.short_steps(plan, |_, meeting| {
            link.send(header, |payload| meeting.write_register(payload))?;
            Ok(())
        })
    }

    /// Reads the solid's register frame in place.
    fn take_answer(&mut self, link: &mut impl Link) -> Result<FrameHeader, RunError> {
        let faces = self.own.solver.interface().faces();
        let FrameHeader { time, dt, .. } = self.sent;
        let (solver, cells) = (&mut self.own.solver, &mut self.cells);
        let header = link.receive(|frame| {
            frame.require(FrameKind::Register)?;
            frame.require_step(time, StepLength::Is(dt))?;
            frame.require_limit()?;
            let register = frame.register(faces)?;
            if let Some(cells) = cells {
                cells.received.copy_from_slice(register.velocity);
            } else {
                solver.interface_mut().set_rows(register.rows());
                solver.interface_mut().set_friction(register.friction());
            }
            Ok::<_, coupler::CouplerError>(*frame.header)
        })??;
        Ok(header)
    }

    /// Adapts the grid if it is time to, with all that is kept per face of the wall.
    fn adapt_if_due(&mut self) -> Result<(), RunError> {
        let start = Instant::now();
        let mut changed = false;
        self.own.solver.expect_waves(self.answer.coming.map(|[time, reach]| [time * self.sound, reach]));
        if self.own.solver.steps() > 0 {
            let steps = self.own.rule.steps_in(self.own.last_dt, &self.own.solver);
            changed = self.own.solver.adapt_if_due(self.own.last_dt, steps);
        }
        // What comes through the wall at once cannot wait for a level with every adaptation.
        for _ in 0..self.own.solver.mesh().tree().finest() {
            if !self.own.solver.is_too_coarse_for_waves() {
                break;
            }
            let dt = self.own.rule.long(&self.own.solver).limit;
            let steps = self.own.rule.steps_in(dt, &self.own.solver);
            if !self.own.solver.adapt(dt, steps) {
                break;
            }
            changed = true;
        }
        if changed {
            let edges = self.own.solver.interface_edges();
            if let Some(cells) = &mut self.cells {
                let domain = self.own.solver.mesh().domain();
                let axisymmetric = domain.geometry == mesh::Geometry::Axisymmetric;
                let mut map = CommonRefinement::default();
                map.update(domain.r[0], &self.own.edges, &edges, axisymmetric);
                let received = &mut cells.received;
                let old = std::mem::replace(received, vec![0.0; edges.len()]);
                map.means(true, |k| old[map.sub_faces()[k].first], |face, mean| received[face] = mean);
            }
            self.own.edges = edges;
        }
        let elapsed = start.elapsed();
        self.own.clock.computing += elapsed;
        self.own.clock.adapting += elapsed;
        self.own.memory.look(self.own.solver.mesh().cells(), self.own.solver.time(), "fluid")
    }

    /// The next step: no longer than either side's limit.
    fn plan(&mut self, own: f64, others_limit: f64) -> Result<Option<Plan>, RunError> {
        self.limited_by = if own <= others_limit { "fluid" } else { "solid" };
        let limit = own.min(others_limit);
        if !(limit > self.own.rule.smallest) {
            return Err(RunError::TimeStepCollapsed {
                dt: limit,
                time: self.own.solver.time(),
                step: self.own.solver.steps() + 1,
                limited_by: self.limited_by,
            });
        }
        let plan = self.own.schedule.plan(self.own.solver.time(), limit);
        self.own.last_dt = plan.map_or(self.own.last_dt, |plan| plan.dt);
        Ok(plan)
    }

    /// What a frame about the step of length `dt` that begins now says besides its payload.
    fn header(&mut self, kind: FrameKind, count: usize, dt: f64) -> FrameHeader {
        self.sent = FrameHeader {
            step: self.own.solver.steps(),
            time: self.own.solver.time(),
            dt,
            count: count as u64,
            flags: if self.tells_of_checkpoint { FrameHeader::CHECKPOINT } else { 0 },
            ..FrameHeader::new(kind)
        };
        self.sent
    }
}
