//! What the step loop needs of a solver, and the two kinds of steps that it makes in a coupled run.
//!
//! Each side keeps its own time step. The side with the longer one shows its trace and completes its step when it knows what
//! the interface did; the other side makes as many short steps meanwhile as it needs. See docs/theory/time-steps.md.

use std::ops::DerefMut;

use coupler::{Meeting, Participant, ShortStep, StarSolver, TraceRow};
use fluid::{Fluid, FluidSolver};
use mesh::{BLOCK, BlockSolver, CompiledSolver, Geometry, GroupStep, Model, Part};
use solid::{Solid, SolidSolver};

use crate::case::{Case, LocalSteps, SMALLEST_STEP};
use crate::run::RunError;

/// An exchange may take no more steps of the finest level than waves stay within the blocks that adaptation made for them: at Courant
/// numbers of at most ½ they cross 12 of a block's 16 cells, and adaptation looks at most 14 ahead. Half and twice of it:
/// `docs/verification/constants.md`.
const LONGEST_EXCHANGE: f64 = 24.0;

/// How long steps may be.
#[derive(Clone, Copy, Debug)]
pub struct StepRule {
    /// The Courant number.
    pub cfl: f64,
    /// Whether levels step by themselves.
    pub local: LocalSteps,
    /// The most steps that one side makes within one of the other.
    pub ratio: u32,
    /// A limit that is no longer than this, s, means that the solution has gone bad.
    pub smallest: f64,
}

/// A solver, whichever medium it is for: a [`BlockSolver`] that can show the other side what is on the interface.
pub trait CoupledSolver:
    CompiledSolver<Self::Physics> + DerefMut<Target = BlockSolver<Self::Physics, BLOCK>> + Sync
{
    /// What its cells obey.
    type Physics: Model<BLOCK, Error: Into<RunError>>;
    /// Which side of the interface it is.
    const OWN: Participant;

    /// [`CompiledSolver::run`].
    fn run_part(&mut self, step: GroupStep, part: Part) -> Result<(), RunError> {
        self.run(step, part).map_err(Into::into)
    }

    /// [`CompiledSolver::finish`].
    fn finish_step(&mut self) -> Result<(), RunError> {
        self.finish().map_err(Into::into)
    }

    /// [`CompiledSolver::step`].
    fn whole_step(&mut self, dt: f64) -> Result<(), RunError> {
        self.step(dt).map_err(Into::into)
    }

    /// Writes the traces on the faces of those blocks that are `due`, before a step of length `dt`.
    fn write_trace_of(
        &self,
        dt: f64,
        is_due: &dyn Fn(usize) -> bool,
        put: &mut dyn FnMut(TraceRow, usize, f64),
    );

    /// Writes the traces on all faces, before a long step of length `dt`.
    fn write_trace(&self, dt: f64, mut put: impl FnMut(TraceRow, usize, f64)) {
        self.write_trace_of(dt, &mesh::every_slot, &mut put);
    }

    /// Writes the traces on the faces of the levels that are about to step.
    fn write_group_trace(&self, step: GroupStep, mut put: impl FnMut(TraceRow, usize, f64)) {
        self.write_trace_of(step.dt, &|slot| self.makes(step, slot), &mut put);
    }
}

macro_rules! coupled_solver {
    ($solver:ident, $physics:ident) => {
        impl CoupledSolver for $solver<BLOCK> {
            type Physics = $physics;
            const OWN: Participant = Participant::$physics;

            fn write_trace_of(
                &self,
                dt: f64,
                is_due: &dyn Fn(usize) -> bool,
                put: &mut dyn FnMut(TraceRow, usize, f64),
            ) {
                self.compiled_trace(dt, is_due, put);
            }
        }
    };
}

coupled_solver!(FluidSolver, Fluid);
coupled_solver!(SolidSolver, Solid);

/// How a side's steps may be, and which of its levels step by themselves.
#[derive(Clone, Copy, Debug)]
pub struct Steps {
    /// The longest step of the whole, s.
    pub limit: f64,
    /// The level whose step that is; finer ones have shorter steps.
    pub base: u8,
}

impl StepRule {
    /// A case's rule. The paper's schemes are made for one step of both sides.
    pub fn of(case: &Case) -> Self {
        let common = case.coupling.scheme.exchanges_cells();
        Self {
            cfl: case.time.cfl,
            local: if common { LocalSteps::Never } else { case.time.local_steps },
            ratio: case.coupling.step_ratio,
            smallest: SMALLEST_STEP * case.time.end,
        }
    }

    /// Passes a limit of a medium's step on unless it has collapsed: steps of no length would go on for ever.
    pub fn unless_collapsed<M: CoupledSolver>(&self, limit: f64, medium: &M) -> Result<f64, RunError> {
        if limit > self.smallest {
            return Ok(limit);
        }
        Err(RunError::TimeStepCollapsed {
            dt: limit,
            time: medium.time(),
            step: medium.steps() + 1,
            limited_by: M::OWN.name(),
        })
    }

    /// About how many steps of the finest level a step of length `dt` holds.
    pub fn steps_in(&self, dt: f64, medium: &impl CoupledSolver) -> u32 {
        mesh::steps_in(dt, medium.time_step_limit(self.cfl)) as u32
    }

    /// Steps alone, or short ones within a long one of the other side.
    pub fn alone(&self, medium: &impl CoupledSolver) -> Steps {
        self.steps_from(medium, 0)
    }

    /// Steps that are long ones for the other side: no level at the interface may have shorter ones.
    pub fn long(&self, medium: &impl CoupledSolver) -> Steps {
        self.steps_from(medium, medium.finest_at_interface())
    }

    /// Steps of which those of levels up to `coarsest` are the longest.
    fn steps_from(&self, medium: &impl CoupledSolver, coarsest: u8) -> Steps {
        let base = match self.local {
            LocalSteps::Never => u8::MAX,
            LocalSteps::Auto => medium.cheapest_base(self.cfl, coarsest),
            LocalSteps::Always => medium.mesh().coarsest_base().max(coarsest),
        };
        Steps { limit: medium.local_step_limit(self.cfl, base), base }
    }

    /// The step by which the other side counts how many of this side's go into one of its own, s.
    pub fn counted(&self, medium: &impl CoupledSolver) -> f64 {
        let longest = LONGEST_EXCHANGE / f64::from(self.ratio) * medium.time_step_limit(self.cfl);
        self.long(medium).limit.min(longest.max(medium.time_step_limit(self.cfl)))
    }

    /// The most steps of the finest level that a side counts within one of the other.
    pub fn most_steps(&self) -> f64 {
        LONGEST_EXCHANGE.max(f64::from(self.ratio))
    }

    /// The longest step if one of the other side counts as `others`, s.
    pub fn longest(&self, others: f64) -> f64 {
        f64::from(self.ratio) * others
    }
}

/// Begins a step whose end depends on the interface: what does not is done at once.
pub fn begin_long<M: CoupledSolver>(medium: &mut M, dt: f64, rule: &StepRule) -> Result<GroupStep, RunError> {
    let base = rule.long(medium).base;
    medium.begin_step(dt, base);
    let step = medium.start(f64::INFINITY);
    medium.run_part(step, Part::AwayFromInterface)?;
    Ok(step)
}

/// Ends it, once the state of the interface is set. `after(medium, dt)` is called after each step of the finest level.
pub fn end_long<M: CoupledSolver>(
    medium: &mut M,
    step: GroupStep,
    rule: &StepRule,
    after: impl FnMut(&M, f64) -> Result<(), RunError>,
) -> Result<(), RunError> {
    medium.run_part(step, Part::AtInterface)?;
    // No level that is still to step has faces on the interface.
    step_to_end(medium, rule, |_, _| (), after)
}

/// Makes a step that does not depend on another side; `before(medium, step)` is called before each step of a level.
pub fn step_alone<M: CoupledSolver>(
    medium: &mut M,
    dt: f64,
    rule: &StepRule,
    mut before: impl FnMut(&mut M, GroupStep),
    after: impl FnMut(&M, f64) -> Result<(), RunError>,
) -> Result<(), RunError> {
    let base = rule.alone(medium).base;
    medium.begin_step(dt, base);
    let step = medium.start(f64::INFINITY);
    before(medium, step);
    medium.run_part(step, Part::All)?;
    step_to_end(medium, rule, before, after)
}

fn step_to_end<M: CoupledSolver>(
    medium: &mut M,
    rule: &StepRule,
    mut before: impl FnMut(&mut M, GroupStep),
    mut after: impl FnMut(&M, f64) -> Result<(), RunError>,
) -> Result<(), RunError> {
    loop {
        while medium.clock().due().is_some() {
            let limit = rule.unless_collapsed(medium.due_limit(rule.cfl), medium)?;
            let step = medium.start(limit);
            before(medium, step);
            medium.run_part(step, Part::All)?;
        }
        if end_sub_step(medium, &mut after)? {
            return Ok(());
        }
    }
}

/// Ends the step of the finest level and tells of it; whether the whole step is over.
fn end_sub_step<M: CoupledSolver>(
    medium: &mut M,
    after: &mut impl FnMut(&M, f64) -> Result<(), RunError>,
) -> Result<bool, RunError> {
    let dt = medium.clock().length(medium.clock().finest());
    medium.finish_step()?;
    after(medium, dt)?;
    Ok(medium.clock().is_over())
}

/// Begins to meet the other side's trace.
pub fn begin_meeting<M: CoupledSolver>(medium: &M, meeting: &mut Meeting, trace: (&[f64], usize)) {
    let mesh = medium.mesh();
    let domain = mesh.domain();
    let axisymmetric = domain.geometry == Geometry::Axisymmetric;
    let own = (mesh.generation(), || medium.interface_edges());
    meeting.begin(trace, medium.time(), own, domain.r[0], axisymmetric);
}

/// Makes the short steps within the other side's long one, of length `dt`.
///
/// - `answer`: called as soon as all is known that the interface will do. `after`: as in [`end_long`].
/// - errors: those of the medium, what meets is no state, the steps collapse on the way.
pub fn short_steps<M: CoupledSolver>(
    medium: &mut M,
    meeting: &mut Meeting,
    (dt, star): (f64, StarSolver),
    rule: &StepRule,
    mut answer: impl FnMut(&M, &Meeting) -> Result<(), RunError>,
    mut after: impl FnMut(&M, f64) -> Result<(), RunError>,
) -> Result<(), RunError> {
    let Steps { base, .. } = rule.alone(medium);
    medium.begin_step(dt, base);
    let mut is_answered = false;
    loop {
        while let Some(group) = medium.clock().due() {
            // The whole is the other side's: how many steps of the coarsest level it holds follows from that level's limit.
            let limit =
                if group == 0 { medium.local_step_limit(rule.cfl, base) } else { medium.due_limit(rule.cfl) };
            let limit = rule.unless_collapsed(limit, medium)?;
            let step = medium.start(limit);
            let (rows, faces) = meeting.own_trace();
            medium.write_group_trace(step, |row, face, value| rows[row as usize * faces + face] = value);
            let is_due = |face: usize| medium.group_of_face(face) == group;
            let short = ShortStep { begin: step.begin, dt: step.dt };
            meeting.meet(M::OWN, short, star, is_due)?;
            meeting.own_means(|face, state| {
                if medium.group_of_face(face) == group {
                    medium.interface_mut().set(face, state.into());
                }
            });
            if !is_answered
                && (0..faces).step_by(BLOCK).all(|face| medium.clock().is_last(medium.group_of_face(face)))
            {
                answer(medium, meeting)?;
                is_answered = true;
            }
            medium.run_part(step, Part::All)?;
        }
        if end_sub_step(medium, &mut after)? {
            return Ok(());
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::run::setup::solid_solver;

    #[test]
    fn a_step_that_has_collapsed_ends_the_solids_run_too() {
        let text = "[time]\nend = 1e-6\n[coupling]\nscheme = \"none\"\n[solid]\nz = [0, 1]\nr = [0, 1]\ncells = [16, 16]\n\
                    material = \"copper\"\n";
        let case = Case::from_toml(text, "small", &[]).unwrap();
        let solver = solid_solver(&case, case.solid.as_ref().unwrap()).unwrap();
        let rule = StepRule::of(&case);
        assert_eq!(rule.unless_collapsed(2e-15, &solver).unwrap(), 2e-15);
        for limit in [0.5e-15, 0.0, -1.0, f64::NAN] {
            let error = rule.unless_collapsed(limit, &solver).unwrap_err();
            assert_eq!(error.exit_code(), 3);
            let said = error.to_string();
            assert!(
                said.contains("limited by the solid") && said.contains("try a smaller time.cfl"),
                "{said}"
            );
        }
    }
}
