//! What the step loop asks of the solid's side.

use coupler::{FrameHeader, FrameKind, Link, LinkCounters, Participant};
use mesh::BLOCK;
use serde_json::{Map, Value, json};
use solid::SolidSolver;

use super::SolidSide;
use crate::output::run_directory::SOLID_SUMMARY;
use crate::output::{OutputError, ProgressLine, RunDirectory};
use crate::run::RunError;
use crate::run::checkpoints::Keeper;
use crate::run::process::stop::Stop;
use crate::run::record::solid_record::SolidRecord;
use crate::run::record::timed::Timed;
use crate::run::schedule::Plan;
use crate::run::side::RunSide;
use crate::run::side::coupled_solver;
use crate::run::side::fluid_side::Turn;

impl RunSide for SolidSide {
    type Record = SolidRecord;
    const NAME: &'static str = "solid";
    const SUMMARY: &'static str = SOLID_SUMMARY;

    fn step_alone(&mut self) -> Result<bool, RunError> {
        let limit =
            self.own.rule.unless_collapsed(self.own.rule.alone(&self.own.solver).limit, &self.own.solver)?;
        let Some(plan) = self.own.schedule.plan(self.own.solver.time(), limit) else { return Ok(false) };
        self.own.last_dt = plan.dt;
        let adapts = self.adapts(plan.dt);
        let timed = Timed::new(&mut self.own.clock);
        let load = &mut self.load;
        let press = |solver: &mut SolidSolver<BLOCK>, step| {
            if let Some(load) = load {
                load.press(solver, step);
            }
        };
        let after = timed.recorded(&mut self.own.record, plan);
        coupled_solver::step_alone(&mut self.own.solver, plan.dt, &self.own.rule, press, after)?;
        self.end_if_settled(plan)?;
        self.adapt_if(adapts && !self.own.schedule.is_over(), plan.dt)?;
        Ok(true)
    }

    fn turn(&mut self, link: &mut impl Link, stop: &Stop) -> Result<Turn, RunError> {
        let turn = self.answer(link, stop)?;
        self.meanwhile()?;
        Ok(turn)
    }

    fn leave(&self, directory: &RunDirectory) -> Result<(), RunError> {
        let Some(wall) = &self.wall else { return Ok(()) };
        let surface = self.own.record.as_ref().and_then(SolidRecord::surface);
        let displacement = surface.map_or_else(Vec::new, |surface| surface.displacement().profile());
        Ok(wall.leave(&self.own.solver, displacement, directory)?)
    }

    fn summary(&self) -> Map<String, Value> {
        let mut part = self.own.summary();
        part.insert("fixups".to_owned(), json!({ "floored_stars": self.own.meeting.floored() }));
        part
    }

    fn keep_by(&self, keeper: &mut Keeper, step: u64, counters: LinkCounters) -> Result<(), OutputError> {
        keeper.write(Participant::Solid, step, &self.saved(counters))
    }

    fn line(&self) -> ProgressLine {
        let own = self.own.line("solid");
        ProgressLine { solid_cells: own.cells, ..own }
    }
}

impl SolidSide {
    /// Answers the fluid, or shows it the trace of a long step, of which [`SolidSide::meanwhile`] does its share.
    pub fn answer(&mut self, link: &mut impl Link, stop: &Stop) -> Result<Turn, RunError> {
        self.settle(link)?;
        // As they stand before this frame, which comes again if the run is taken up here.
        let counters = self.own.keeper.is_some().then(|| link.counters());
        let header = link.receive(|frame| {
            self.require_turn(frame)?;
            if frame.header.has(FrameHeader::CHECKPOINT)
                && let Some(counters) = counters
            {
                self.keep(frame.header.step, counters)?;
            }
            let has_rows = frame.require(FrameKind::Trace).is_ok()
                && !frame.header.has(FrameHeader::LAST | FrameHeader::SETTLED);
            if has_rows {
                self.read_trace(frame)?;
            }
            Ok::<_, RunError>(*frame.header)
        })??;
        if header.has(FrameHeader::LAST) {
            return Ok(Turn::Over(
                header.flags & (FrameHeader::STOP_INTERRUPT | FrameHeader::STOP_TERMINATE),
            ));
        }
        let plan = Plan { dt: header.dt, snapshot: header.has(FrameHeader::SNAPSHOT) };
        if header.kind == FrameKind::Yours as u32 {
            self.fluids_step = header.dt_max;
            self.show_trace(link, plan, stop)?;
            return Ok(Turn::Continues);
        }
        self.own.last_dt = plan.dt;
        self.fluids_step = f64::INFINITY;
        if header.has(FrameHeader::TRIAL) {
            self.try_step(link, plan, stop)?;
        } else if self.scheme.exchanges_cells() {
            self.step_beside(link, plan, stop)?;
        } else {
            self.step_shortly(link, plan, stop)?;
        }
        Ok(Turn::Continues)
    }
}
