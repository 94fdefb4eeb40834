//! What the step loops need of the fluid's side.

use crate::run::record::fluid_record::FluidRecord;
use coupler::{Link, LinkCounters, Participant};
use serde_json::{Map, Value};

use super::{FluidSide, Turn};
use crate::output::run_directory::FLUID_SUMMARY;
use crate::output::{OutputError, ProgressLine};
use crate::run::RunError;
use crate::run::checkpoints::Keeper;
use crate::run::process::stop::Stop;
use crate::run::record::timed::Timed;
use crate::run::side::RunSide;
use crate::run::side::cell_exchange::CellExchange;
use crate::run::side::coupled_solver;

impl RunSide for FluidSide {
    type Record = FluidRecord;
    const NAME: &'static str = "fluid";
    const SUMMARY: &'static str = FLUID_SUMMARY;

    fn step_alone(&mut self) -> Result<bool, RunError> {
        let own = self.own.rule.alone(&self.own.solver).limit;
        let Some(plan) = self.plan(own, f64::INFINITY)? else { return Ok(false) };
        let timed = Timed::new(&mut self.own.clock);
        let after = timed.recorded(&mut self.own.record, plan);
        coupled_solver::step_alone(&mut self.own.solver, plan.dt, &self.own.rule, |_, _| (), after)?;
        if !self.own.schedule.is_over() {
            self.adapt_if_due()?;
        }
        Ok(true)
    }

    fn turn(&mut self, link: &mut impl Link, stop: &Stop) -> Result<Turn, RunError> {
        let turn = if self.complete(link)? { self.begin(link, stop)? } else { Turn::Continues };
        self.meanwhile()?;
        Ok(turn)
    }

    fn summary(&self) -> Map<String, Value> {
        let mut part = self.own.summary();
        if let Some(iterations) = self.cells.as_ref().and_then(CellExchange::summary) {
            part.insert("coupling_iterations".to_owned(), iterations);
        }
        part
    }

    fn keep_by(&self, keeper: &mut Keeper, step: u64, counters: LinkCounters) -> Result<(), OutputError> {
        keeper.write(Participant::Fluid, step, &self.saved(counters))
    }

    fn line(&self) -> ProgressLine {
        let (own, solid_cells) = (self.own.line(self.limited_by), self.answer.cells);
        ProgressLine { cells: own.cells.saturating_add(solid_cells), solid_cells, ..own }
    }
}
