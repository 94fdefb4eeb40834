//! The fluid's steps in the paper's schemes.

use std::time::Instant;

use coupler::{FrameHeader, FrameKind, Link, Participant, Scheme, TraceRow};
use mesh::{GroupStep, Part};

use super::{FluidSide, Pending};
use crate::run::RunError;
use crate::run::schedule::Plan;
use crate::run::side::coupled_solver::CoupledSolver as _;

impl FluidSide {
    /// Begins a step of one of the paper's schemes.
    pub(super) fn begin_exchange(&mut self, link: &mut impl Link, plan: Plan) -> Result<(), RunError> {
        // The Courant number of this step: the limit belongs to `cfl`.
        let courant = self.own.rule.cfl * plan.dt / self.own.solver.time_step_limit(self.own.rule.cfl);
        let Some(cells) = &mut self.cells else { return Ok(()) };
        let start = Instant::now();
        cells.begin(&self.own.solver, plan.dt, courant);
        let (scheme, first) = (cells.scheme(), cells.first());
        self.own.clock.computing += start.elapsed();
        match (scheme, first) {
            (Scheme::Strong, _) => {
                let step = self.own.begin_long(plan)?;
                self.try_step(link, plan, step)?;
            }
            (Scheme::Weak, Participant::Fluid) => {
                // The step's number and time are those of its beginning.
                let header = self.header(FrameKind::Trace, self.own.edges.len(), plan.dt);
                self.step_beside(plan)?;
                self.send_cells(link, header, plan)?;
                self.pending = Some(Pending::Made);
            }
            (Scheme::Weak, Participant::Solid) => {
                let header = self.header(FrameKind::Trace, self.own.edges.len(), plan.dt);
                self.send_cells(link, header, plan)?;
                self.pending = Some(Pending::Late(plan));
            }
            _ => {
                let header = self.header(FrameKind::Trace, self.own.edges.len(), plan.dt);
                self.send_cells(link, header, plan)?;
                self.step_beside(plan)?;
                self.pending = Some(Pending::Made);
            }
        }
        Ok(())
    }

    /// Makes the step with the velocities that have been received, and records it.
    pub(super) fn step_beside(&mut self, plan: Plan) -> Result<(), RunError> {
        let start = Instant::now();
        if let Some(cells) = &self.cells {
            cells.set_wall(&mut self.own.solver);
        }
        self.own.solver.whole_step(plan.dt)?;
        self.own.clock.computing += start.elapsed();
        self.recorded(plan)
    }

    /// Sends the pressures of the cells at the wall: of the solver's state, or in a trial those to be tried.
    fn send_cells(&self, link: &mut impl Link, header: FrameHeader, plan: Plan) -> Result<(), RunError> {
        let faces = self.own.edges.len();
        let mut header = FrameHeader { fields: TraceRow::COUNT as u64, ..header };
        if plan.snapshot {
            header.flags |= FrameHeader::SNAPSHOT;
        }
        link.send(header, |payload| {
            payload[TraceRow::Edge as usize * faces..][..faces].copy_from_slice(&self.own.edges);
            let pressures = &mut payload[TraceRow::Pressure as usize * faces..][..faces];
            match self.cells.as_ref().filter(|_| header.has(FrameHeader::TRIAL)) {
                Some(cells) => cells.trial_pressures(&self.own.solver, |face, p| pressures[face] = p),
                None => self.own.solver.wall_cells(false, |face, p, _| pressures[face] = p),
            }
        })?;
        Ok(())
    }

    /// Shows the solid an iterate of the strong scheme, paper eqs. (34), (35).
    fn try_step(&mut self, link: &mut impl Link, plan: Plan, step: GroupStep) -> Result<(), RunError> {
        if self.cells.as_ref().is_some_and(|cells| cells.first() == Participant::Fluid) {
            self.run_at_wall(step)?;
        }
        let mut header = self.header(FrameKind::Trace, self.own.edges.len(), plan.dt);
        header.flags |= FrameHeader::TRIAL;
        self.send_cells(link, header, plan)?;
        self.pending = Some(Pending::Trial(plan, step));
        Ok(())
    }

    /// Makes the step anew where it depends on the solid.
    fn run_at_wall(&mut self, step: GroupStep) -> Result<(), RunError> {
        let start = Instant::now();
        if let Some(cells) = &self.cells {
            cells.set_wall(&mut self.own.solver);
        }
        self.own.solver.run_part(step, Part::AtInterface)?;
        self.own.clock.computing += start.elapsed();
        Ok(())
    }

    /// Goes on to the next iterate, or keeps the last one if the solid has answered with the same.
    pub(super) fn judge(
        &mut self,
        link: &mut impl Link,
        plan: Plan,
        step: GroupStep,
    ) -> Result<(), RunError> {
        if self.cells.as_ref().is_some_and(|cells| cells.first() == Participant::Solid) {
            self.run_at_wall(step)?;
        }
        if !self.cells.as_mut().is_some_and(|cells| cells.compare(&self.own.solver)) {
            return self.try_step(link, plan, step);
        }
        let mut header = self.header(FrameKind::Trace, 0, plan.dt);
        header.flags |= FrameHeader::SETTLED | if plan.snapshot { FrameHeader::SNAPSHOT } else { 0 };
        link.send(header, |_| {})?;
        self.pending = Some(Pending::Made);
        let start = Instant::now();
        self.own.solver.finish_step()?;
        self.own.clock.computing += start.elapsed();
        self.recorded(plan)
    }
}
