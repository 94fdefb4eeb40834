//! The solid's part of the step loop: it answers the fluid's trace with what the wall did, or shows its own.

mod agreed;
mod cells;
mod side;

use std::time::Instant;

use coupler::{
    CouplerError, Frame, FrameHeader, FrameKind, Kappa, KappaFactor, Link, Meeting, RegisterRow, Scheme,
    StepLength, TraceRow,
};
use mesh::{BLOCK, CompiledSolver as _, GroupStep};
use solid::{ComingWaves, SolidSolver, WeakExchange};

use crate::case::{Case, SolidCase};
use crate::output::RunDirectory;
use crate::run::RunError;
use crate::run::memory::MemoryWatch;
use crate::run::process::stop::Stop;
use crate::run::record::of_side::Record;
use crate::run::record::solid_record::SolidRecord;
use crate::run::record::timed::Timed;
use crate::run::schedule::Plan;
use crate::run::setup::solid_and_displacement;
use crate::run::side::InRun;
use crate::run::side::coupled_solver;
use crate::run::side::load::Load;
use crate::run::side::solid_side::coming::WavesForFluid;
use crate::run::wall::WallLeaver;

mod coming;
pub mod saved;

/// The solid with its place in a run.
pub struct SolidSide {
    own: InRun<SolidRecord>,
    exchange: WeakExchange,
    /// What presses on the surface where there is no fluid.
    load: Option<Load>,
    scheme: Scheme,
    kappa: Kappa,
    factor: KappaFactor,
    /// Outer radii of the fluid's faces on the interface; none before the first trace.
    fluid_edges: Vec<f64>,
    /// The long step of which the fluid has been shown the trace; begun once all is done that does not depend on the fluid.
    pending: Option<(Plan, Option<GroupStep>)>,
    /// The step that is tried in the strong scheme.
    trial: Option<GroupStep>,
    /// The fluid's steps within the last long one; infinite after short ones.
    fluids_step: f64,
    /// How long a step this side has said last that it can follow, s.
    promised: f64,
    /// What the fluid is told of waves that come.
    coming: Option<WavesForFluid>,
    /// When the run ends: nothing adapts for what does not come.
    end: f64,
    /// Where something can stay in the wall.
    wall: Option<WallLeaver>,
}

mesh::derefs!([] SolidSide => InRun<SolidRecord>, own);

impl SolidSide {
    /// The solid of a case; with a directory it writes what happens.
    pub fn new(case: &Case, solid: &SolidCase, directory: Option<&RunDirectory>) -> Result<Self, RunError> {
        let (solver, displacement) = solid_and_displacement(case, solid)?;
        let create = |d| SolidRecord::create(case, Some(d), &solver, displacement.as_deref());
        let record = directory.map(create).transpose()?;
        Ok(Self::with(case, solver, record))
    }

    /// A solid that has been made already, in its initial state.
    pub fn with(case: &Case, mut solver: SolidSolver<BLOCK>, record: Option<SolidRecord>) -> Self {
        for probe in case.probes.iter().filter(|probe| probe.medium == crate::case::Medium::Solid) {
            solver.watch(probe.position);
        }
        Self {
            load: case.coupling.load.as_ref().and_then(|load| Load::new(load, &solver)),
            exchange: WeakExchange::default(),
            scheme: case.coupling.scheme,
            kappa: case.coupling.kappa,
            factor: KappaFactor::default(),
            fluid_edges: Vec::new(),
            pending: None,
            trial: None,
            fluids_step: f64::INFINITY,
            promised: 0.0,
            coming: WavesForFluid::of(case),
            end: case.time.end * (1.0 - 1e-12),
            wall: WallLeaver::of(case),
            own: InRun::new(case, solver, record, MemoryWatch::of(case.solid_memory())),
        }
    }

    /// The first word: how long a step the solid allows. It is at rest; or it says at what time it goes on.
    pub fn open(&mut self, link: &mut impl Link, stop: &Stop) -> Result<(), RunError> {
        let promised = self.promised;
        link.send(self.header(FrameKind::Register, 0, stop), |_| {})?;
        if self.own.solver.steps() > 0 {
            // The fluid goes on from what it was told before.
            self.promised = promised;
            self.own.past.leave_out(link.counters());
        }
        Ok(())
    }

    /// What a frame says besides its payload: the admissible step, and what this side was asked to do.
    fn header(&mut self, kind: FrameKind, fields: usize, stop: &Stop) -> FrameHeader {
        let header = FrameHeader {
            step: self.own.solver.steps(),
            time: self.own.solver.time(),
            dt: self.own.last_dt,
            dt_max: self.own.rule.counted(&self.own.solver),
            fields: fields as u64,
            cells: self.own.solver.mesh().cells() as u64,
            flags: stop.flags(),
            coming: self.coming_waves(),
            ..FrameHeader::new(kind)
        };
        self.promised = header.dt_max;
        header
    }

    /// What the fluid is told of waves that come.
    fn coming_waves(&self) -> ComingWaves {
        let told = |coming: WavesForFluid| coming.told(&self.own.solver, &self.own.rule);
        self.coming.map(told).unwrap_or_default()
    }

    /// Ends the long step under way with what the fluid made of it; does nothing if there is none.
    pub fn settle(&mut self, link: &mut impl Link) -> Result<(), RunError> {
        self.meanwhile()?;
        let Some((plan, Some(step))) = self.pending.take() else { return Ok(()) };
        let solver = &mut self.own.solver;
        link.receive(|frame| {
            frame.require(FrameKind::Register)?;
            frame.require_step(solver.time(), StepLength::Is(plan.dt))?;
            let register = frame.register(solver.interface().faces())?;
            solver.interface_mut().set_rows(register.rows());
            solver.interface_mut().set_friction(register.friction());
            Ok::<_, CouplerError>(())
        })??;
        let adapts = self.adapts(plan.dt);
        let timed = Timed::new(&mut self.own.clock);
        coupled_solver::end_long(
            &mut self.own.solver,
            step,
            &self.own.rule,
            timed.recorded(&mut self.own.record, plan),
        )?;
        self.adapt_if(adapts, plan.dt)
    }

    /// Does what of a long step does not depend on the fluid, if there is any left: while the fluid has its turn.
    pub fn meanwhile(&mut self) -> Result<(), RunError> {
        if let Some((plan, None)) = self.pending {
            self.pending = Some((plan, Some(self.own.begin_long(plan)?)));
        }
        Ok(())
    }

    /// Begins a long step: shows the trace.
    fn show_trace(&mut self, link: &mut impl Link, asked: Plan, stop: &Stop) -> Result<(), RunError> {
        let limit =
            self.own.rule.unless_collapsed(self.own.rule.long(&self.own.solver).limit, &self.own.solver)?;
        let plan =
            if asked.dt <= limit * (1.0 + 1e-10) { asked } else { Plan { dt: limit, snapshot: false } };
        self.own.last_dt = plan.dt;
        let faces = self.own.solver.interface().faces();
        let header =
            FrameHeader { count: faces as u64, ..self.header(FrameKind::Trace, TraceRow::COUNT, stop) };
        let filled = self.own.show_trace(link, header, plan.dt)?;
        self.own.clock.computing += filled;
        self.pending = Some((plan, None));
        Ok(())
    }

    /// Makes short steps within the fluid's, of which the trace has been read.
    fn step_shortly(&mut self, link: &mut impl Link, plan: Plan, stop: &Stop) -> Result<(), RunError> {
        let adapts = self.adapts(plan.dt);
        // How long the next step may be is known only once the grid has adapted. Where steps have to be the same on both
        // sides, the answer waits for that; else both sides go on at the same time.
        let early = !adapts || self.own.rule.ratio > 1;
        let faces = self.fluid_edges.len();
        let header = FrameHeader {
            count: faces as u64,
            dt: plan.dt,
            ..self.header(FrameKind::Register, RegisterRow::COUNT, stop)
        };
        let mut send = |meeting: &Meeting, header: FrameHeader| -> Result<(), RunError> {
            link.send(header, |payload| meeting.write_register(payload))?;
            Ok(())
        };
        self.own.short_steps(plan, |_, meeting| if early { send(meeting, header) } else { Ok(()) })?;
        self.adapt_if(adapts, plan.dt)?;
        if !early {
            let dt_max = self.own.rule.counted(&self.own.solver);
            self.promised = dt_max;
            let cells = self.own.solver.mesh().cells() as u64;
            let coming = self.coming_waves();
            send(&self.own.meeting, FrameHeader { dt_max, cells, coming, ..header })?;
        }
        Ok(())
    }

    /// Takes over what a trace frame says.
    fn read_trace(&mut self, frame: &Frame<'_>) -> Result<(), CouplerError> {
        let start = Instant::now();
        let (rows, faces) = frame.trace(self.own.solver.mesh().domain().r)?;
        if self.fluid_edges.as_slice() != TraceRow::Edge.of(rows, faces) {
            self.fluid_edges = TraceRow::Edge.of(rows, faces).to_vec();
        }
        if self.scheme.exchanges_cells() {
            let (kappa, dt) = (self.kappa, frame.header.dt);
            let courant = self.own.rule.cfl * dt / self.own.solver.time_step_limit(self.own.rule.cfl);
            let factor = if kappa == Kappa::Off { 1.0 } else { self.factor.next(courant) };
            let pressure_of = |received: f64, own: f64| match kappa {
                Kappa::Off => received,
                Kappa::Printed => factor * received,
                Kappa::Jump => own + factor * (received - own),
            };
            self.own.solver.load_weakly(&mut self.exchange, rows, faces, dt, pressure_of);
        } else {
            coupled_solver::begin_meeting(&self.own.solver, &mut self.own.meeting, (rows, faces));
        }
        self.own.clock.computing += start.elapsed();
        Ok(())
    }

    /// Whether the grid adapts after a step of length `dt`; to be asked once for each.
    fn adapts(&mut self, dt: f64) -> bool {
        let steps = self.steps_in(dt);
        self.own.solver.time() + dt < self.end && self.own.solver.adaptation_follows(dt, steps)
    }

    /// About how many steps, the own or the fluid's, a step of length `dt` holds. What comes through the interface comes in
    /// the fluid's: while the solid's cells are still too wide for it, adaptation must not wait for its long steps.
    fn steps_in(&self, dt: f64) -> u32 {
        let fluids = (dt / self.fluids_step).ceil() as u32;
        self.own.rule.steps_in(dt, &self.own.solver).max(fluids)
    }

    fn adapt_if(&mut self, adapts: bool, dt: f64) -> Result<(), RunError> {
        if !adapts {
            return Ok(());
        }
        let start = Instant::now();
        let steps = self.steps_in(dt);
        if self.own.solver.adapt(dt, steps) {
            self.own.edges = self.own.solver.interface_edges();
        }
        let elapsed = start.elapsed();
        self.own.clock.computing += elapsed;
        self.own.clock.adapting += elapsed;
        self.own.memory.look(self.own.solver.mesh().cells(), self.own.solver.time(), "solid")
    }

    /// Ends the run after a step alone if that is what the surface's rest is for.
    fn end_if_settled(&mut self, plan: Plan) -> Result<(), RunError> {
        let Some(record) = &mut self.own.record else { return Ok(()) };
        let is_settled = record.surface().is_some_and(|surface| surface.is_settled());
        if is_settled && !self.own.schedule.is_over() {
            self.own.schedule.end();
            if !plan.snapshot {
                record.snapshot(&self.own.solver)?;
            }
        }
        Ok(())
    }
}
