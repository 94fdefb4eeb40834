//! What the step loops need of the fluid's side.

use coupler::{Link, LinkCounters};
use fluid::FluidSolver;
use mesh::BLOCK;
use serde_json::{Map, Value};

use super::{FluidSide, Turn};
use crate::output::ProgressLine;
use crate::output::run_directory::FLUID_SUMMARY;
use crate::run::RunError;
use crate::run::checkpoints::Keeper;
use crate::run::process::stop::Stop;
use crate::run::record::timed::{Clock, Timed};
use crate::run::side::RunSide;
use crate::run::side::cell_exchange::CellExchange;
use crate::run::side::coupled_solver;
use crate::run::side::past::Past;

impl RunSide for FluidSide {
    type Solver = FluidSolver<BLOCK>;
    const NAME: &'static str = "fluid";
    const SUMMARY: &'static str = FLUID_SUMMARY;

    fn step_alone(&mut self) -> Result<bool, RunError> {
        let own = self.rule.alone(&self.solver).limit;
        let Some(plan) = self.plan(own, f64::INFINITY)? else { return Ok(false) };
        let timed = Timed::new(&mut self.clock);
        let after = timed.recorded(&mut self.record, plan);
        coupled_solver::step_alone(&mut self.solver, plan.dt, &self.rule, |_, _| (), after)?;
        self.adapt_if_due()?;
        Ok(true)
    }

    fn turn(&mut self, link: &mut impl Link, stop: &Stop) -> Result<Turn, RunError> {
        if self.complete(link)? { self.begin(link, stop) } else { Ok(Turn::Continues) }
    }

    fn close(&mut self, failed: bool) -> Result<(), RunError> {
        if let Some(record) = &mut self.record {
            record.close(&self.solver, failed)?;
        }
        Ok(())
    }

    fn summary(&self) -> Map<String, Value> {
        let mut part = self.record.as_ref().map_or_else(Map::new, |record| record.summary(&self.solver));
        if let Some(iterations) = self.cells.as_ref().and_then(CellExchange::summary) {
            part.insert("coupling_iterations".to_owned(), iterations);
        }
        part
    }

    fn solver(&self) -> &Self::Solver {
        &self.solver
    }

    fn clock(&self) -> Clock {
        self.clock
    }

    fn past(&self) -> &Past {
        &self.past
    }

    fn keep_alone(&mut self, is_stopped: bool) -> Result<(), RunError> {
        if is_stopped || self.keeper.as_ref().is_some_and(Keeper::is_due) {
            self.keep(LinkCounters::default())?;
        }
        Ok(())
    }

    fn line(&self) -> ProgressLine {
        ProgressLine {
            time: self.solver.time(),
            step: self.solver.steps(),
            dt: self.last_dt,
            limited_by: self.limited_by.to_owned(),
            cells: (self.solver.mesh().cells() as u64).saturating_add(self.answer.cells),
            solid_cells: self.answer.cells,
            wall: 0.0,
        }
    }
}
