//! The solid's part of the step loop: it answers the fluid's trace with what the wall did.

use std::time::{Duration, Instant};

use coupler::{FrameHeader, FrameKind, Kappa, KappaFactor, Link, RegisterRow, Scheme, StarSolver, TraceRow};
use mesh::BLOCK;
use serde_json::{Map, Value, json};
use solid::{Interface, SolidSolver};

use super::RunError;
use super::drive::Side;
use super::fluid_side::{Clock, Turn};
use super::load::Load;
use super::schedule::{Plan, Schedule};
use super::setup::solid_solver;
use super::solid_record::SolidRecord;
use super::stop::Stop;
use crate::case::{Case, SolidCase};
use crate::output::run_directory::SOLID_SUMMARY;
use crate::output::{ProgressLine, RunDirectory};

/// The solid with its place in a run.
pub struct SolidSide {
    solver: SolidSolver<BLOCK>,
    record: Option<SolidRecord>,
    interface: Interface,
    /// What presses on the surface where there is no fluid.
    load: Option<Load>,
    schedule: Schedule,
    cfl: f64,
    scheme: Scheme,
    star: StarSolver,
    kappa: Kappa,
    factor: KappaFactor,
    /// Outer radii of the fluid's faces on the interface; none before the first trace.
    fluid_edges: Vec<f64>,
    last_dt: f64,
    clock: Clock,
}

impl SolidSide {
    /// The solid of a case; with a directory it writes what happens.
    pub fn new(case: &Case, solid: &SolidCase, directory: Option<&RunDirectory>) -> Result<Self, RunError> {
        let solver = solid_solver(case, solid)?;
        let record = directory.map(|d| SolidRecord::create(case, Some(d), &solver)).transpose()?;
        Ok(Self::with(case, solver, record))
    }

    /// A solid that has been made already, in its initial state.
    pub fn with(case: &Case, solver: SolidSolver<BLOCK>, record: Option<SolidRecord>) -> Self {
        Self {
            load: case.coupling.load.as_ref().and_then(|load| Load::new(load, &solver)),
            solver,
            record,
            interface: Interface::default(),
            schedule: Schedule::new(&case.time.snapshots),
            cfl: case.time.cfl,
            scheme: case.coupling.scheme,
            star: case.coupling.star,
            kappa: case.coupling.kappa,
            factor: KappaFactor::default(),
            fluid_edges: Vec::new(),
            last_dt: 0.0,
            clock: Clock::default(),
        }
    }

    /// The solver.
    pub fn solver(&self) -> &SolidSolver<BLOCK> {
        &self.solver
    }

    /// What is recorded.
    pub fn record(&self) -> Option<&SolidRecord> {
        self.record.as_ref()
    }

    /// Writes the rows of the histories that are still in memory.
    pub fn flush(&mut self) -> Result<(), RunError> {
        self.record.as_mut().map_or(Ok(()), |record| record.flush()).map_err(RunError::Output)
    }

    /// When the next steps have to land, besides the times of snapshots; in a coupled run the fluid's counts.
    pub fn schedule_mut(&mut self) -> &mut Schedule {
        &mut self.schedule
    }

    /// The length of the last step, s.
    pub fn last_step(&self) -> f64 {
        self.last_dt
    }

    /// The first word: how long a step the solid allows. It is at rest.
    pub fn open(&mut self, link: &mut impl Link, stop: &Stop) -> Result<(), RunError> {
        self.answer(link, stop)
    }

    /// Sends the register of the last step, the admissible next step, and what this side was asked to do.
    fn answer(&mut self, link: &mut impl Link, stop: &Stop) -> Result<(), RunError> {
        let start = Instant::now();
        let faces = self.fluid_edges.len();
        let header = FrameHeader {
            step: self.solver.steps(),
            time: self.solver.time(),
            dt: self.last_dt,
            dt_max: self.solver.time_step_limit(self.cfl),
            fields: RegisterRow::COUNT as u64,
            count: faces as u64,
            cells: self.solver.mesh().cells() as u64,
            flags: stop.flags(),
            ..FrameHeader::new(FrameKind::Register)
        };
        let (solver, interface, edges) = (&self.solver, &mut self.interface, &self.fluid_edges);
        let (weak, first) = (self.scheme == Scheme::Weak, !interface.has_met());
        let mut filled = Duration::ZERO;
        link.send(header, |payload| {
            let put =
                |row: RegisterRow, face: usize, value: f64| payload[row as usize * faces + face] = value;
            if weak && faces > 0 {
                solver.write_cell_velocities(interface, edges, put);
            } else if !first {
                interface.write_register(put);
            }
            filled = start.elapsed();
        })?;
        // What comes after the frame is filled is the exchange.
        self.clock.computing += filled;
        Ok(())
    }

    fn adapt(&mut self, dt: f64) {
        let start = Instant::now();
        self.solver.adapt(dt);
        let elapsed = start.elapsed();
        self.clock.computing += elapsed;
        self.clock.adapting += elapsed;
    }

    fn recorded(&mut self, plan: Plan) -> Result<(), RunError> {
        let start = Instant::now();
        if let Some(record) = &mut self.record {
            record.after_step(&self.solver, plan)?;
        }
        self.clock.recording += start.elapsed();
        Ok(())
    }
}

impl Side for SolidSide {
    const NAME: &'static str = "solid";
    const SUMMARY: &'static str = SOLID_SUMMARY;

    fn step_alone(&mut self) -> Result<bool, RunError> {
        let start = Instant::now();
        let limit = self.solver.time_step_limit(self.cfl);
        let Some(plan) = self.schedule.plan(self.solver.time(), limit) else { return Ok(false) };
        self.last_dt = plan.dt;
        let adapts = self.solver.adaptation_follows(plan.dt);
        if let Some(load) = &mut self.load {
            load.press(&mut self.solver, plan.dt);
        }
        self.solver.step(plan.dt)?;
        self.clock.computing += start.elapsed();
        self.recorded(plan)?;
        if adapts {
            self.adapt(plan.dt);
        }
        Ok(true)
    }

    fn turn(&mut self, link: &mut impl Link, stop: &Stop) -> Result<Turn, RunError> {
        let (scheme, star, kappa, cfl) = (self.scheme, self.star, self.kappa, self.cfl);
        let (solver, interface, factor, edges) =
            (&mut self.solver, &mut self.interface, &mut self.factor, &mut self.fluid_edges);
        let clock = &mut self.clock;
        let header = link.receive(|frame| {
            frame.require(FrameKind::Trace)?;
            if frame.header.has(FrameHeader::LAST) {
                return Ok(*frame.header);
            }
            let faces = frame.header.count as usize;
            frame.require_shape(TraceRow::COUNT, faces)?;
            let start = Instant::now();
            let dt = frame.header.dt;
            if edges.as_slice() != TraceRow::Edge.of(frame.payload, faces) {
                *edges = TraceRow::Edge.of(frame.payload, faces).to_vec();
            }
            if scheme == Scheme::Weak {
                let courant = cfl * dt / solver.time_step_limit(cfl);
                let factor = if kappa == Kappa::Off { 1.0 } else { factor.next(courant) };
                solver.load_weakly(interface, frame.payload, faces, dt, |received, own| match kappa {
                    Kappa::Off => received,
                    Kappa::Printed => factor * received,
                    Kappa::Jump => own + factor * (received - own),
                });
            } else {
                solver.meet_fluid(interface, frame.payload, faces, dt, star);
            }
            clock.computing += start.elapsed();
            Ok::<_, coupler::CouplerError>(*frame.header)
        })??;
        if header.has(FrameHeader::LAST) {
            return Ok(Turn::Over(header.flags & !FrameHeader::LAST));
        }
        let plan = Plan { dt: header.dt, snapshot: header.has(FrameHeader::SNAPSHOT) };
        self.last_dt = plan.dt;
        let adapts = self.solver.adaptation_follows(plan.dt);
        // In the Riemann scheme all that the fluid needs is known, and both sides make their steps at the same
        // time; but how long the next step may be is known only once the grid has adapted.
        let early = self.scheme != Scheme::Weak && !adapts;
        if early {
            self.answer(link, stop)?;
        }
        let start = Instant::now();
        self.solver.step(plan.dt)?;
        self.clock.computing += start.elapsed();
        self.recorded(plan)?;
        if adapts {
            self.adapt(plan.dt);
        }
        if !early {
            self.answer(link, stop)?;
        }
        Ok(Turn::Continues)
    }

    fn close(&mut self, failed: bool) -> Result<(), RunError> {
        if let Some(record) = &mut self.record {
            record.close(&self.solver, failed)?;
        }
        Ok(())
    }

    fn summary(&self) -> Map<String, Value> {
        let mut part = self.record.as_ref().map_or_else(Map::new, |record| record.summary(&self.solver));
        part.insert("fixups".to_owned(), json!({ "floored_stars": self.interface.floored() }));
        part
    }

    fn reached(&self) -> (f64, u64) {
        (self.solver.time(), self.solver.steps())
    }

    fn clock(&self) -> Clock {
        self.clock
    }

    fn line(&self) -> ProgressLine {
        ProgressLine {
            time: self.solver.time(),
            step: self.solver.steps(),
            dt: self.last_dt,
            limited_by: "solid".to_owned(),
            cells: self.solver.mesh().cells() as u64,
            wall: 0.0,
        }
    }
}
