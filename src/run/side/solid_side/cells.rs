//! The solid's steps in the paper's schemes.

use std::time::Instant;

use coupler::{FrameHeader, FrameKind, Link, RegisterRow};
use mesh::Part;

use super::SolidSide;
use crate::run::RunError;
use crate::run::process::stop::Stop;
use crate::run::schedule::Plan;
use crate::run::side::coupled_solver::{self, CoupledSolver as _};

impl SolidSide {
    /// Makes a step under the pressures that have been read, paper eqs. (32), (37), or the one that has been tried, and
    /// answers with the velocities of its end.
    pub(super) fn step_beside(
        &mut self,
        link: &mut impl Link,
        plan: Plan,
        stop: &Stop,
    ) -> Result<(), RunError> {
        let (step, time) = (self.own.solver.steps(), self.own.solver.time());
        let adapts = self.adapts(plan.dt);
        let start = Instant::now();
        match self.trial.take() {
            Some(_) => self.own.solver.finish_step()?,
            None => self.own.solver.whole_step(plan.dt)?,
        }
        self.own.clock.computing += start.elapsed();
        self.recorded(plan)?;
        self.adapt_if(adapts, plan.dt)?;
        self.answer_with_cells(link, (step, time), stop)
    }

    /// Tries a step under the pressures that have been read, paper eq. (35), and answers with the velocities of its end.
    pub(super) fn try_step(&mut self, link: &mut impl Link, plan: Plan, stop: &Stop) -> Result<(), RunError> {
        let start = Instant::now();
        let step = match self.trial {
            Some(step) => step,
            None => coupled_solver::begin_long(&mut self.own.solver, plan.dt, &self.own.rule)?,
        };
        self.trial = Some(step);
        self.own.solver.run_part(step, Part::AtInterface)?;
        self.own.clock.computing += start.elapsed();
        self.answer_with_cells(link, (self.own.solver.steps(), self.own.solver.time()), stop)
    }

    /// Sends the velocities of the cells under the surface: of the new state that is tried, or of the state.
    ///
    /// - `step`, `time`: number and beginning of the step that this answers.
    fn answer_with_cells(
        &mut self,
        link: &mut impl Link,
        (step, time): (u64, f64),
        stop: &Stop,
    ) -> Result<(), RunError> {
        let faces = self.fluid_edges.len();
        let header = FrameHeader {
            count: faces as u64,
            step,
            time,
            ..self.header(FrameKind::Register, RegisterRow::COUNT, stop)
        };
        let is_trial = self.trial.is_some();
        let (solver, interface, edges) = (&self.own.solver, &mut self.exchange, &self.fluid_edges);
        link.send(header, |payload| {
            solver.write_cell_velocities(interface, edges, is_trial, |row, face, value| {
                payload[row as usize * faces + face] = value;
            });
        })?;
        Ok(())
    }
}
