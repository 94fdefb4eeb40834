//! What the step loop needs of a solver, and the two kinds of steps that it makes in a coupled run.
//!
//! Each side keeps its own time step. The side with the longer one shows its trace and completes its step when it knows what
//! the interface did; the other side makes as many short steps meanwhile as it needs. See docs/coupling.md.

use coupler::{Meeting, Participant, ShortStep, StarSolver, TraceRow, WallRegister};
use fluid::FluidSolver;
use mesh::{BLOCK, Geometry, GroupStep, LevelClock, Mesh, Part};
use solid::SolidSolver;

use super::RunError;
use crate::case::Case;

/// An exchange may take no more steps of the finest level than waves stay within the blocks that adaptation made for them.
const LONGEST_EXCHANGE: f64 = 24.0;

/// A step of a level below this share of the whole one means that the solution has gone bad on the way: an exchange is planned
/// with [`LONGEST_EXCHANGE`] steps of the finest level, and what comes through the interface may be anything.
const SMALLEST_WITHIN: f64 = 1e-4;

/// How long steps may be.
#[derive(Clone, Copy, Debug)]
pub struct StepRule {
    /// The Courant number.
    pub cfl: f64,
    /// Whether levels step by themselves.
    pub local: bool,
    /// The most steps that one side makes within one of the other.
    pub ratio: u32,
}

/// A solver, whichever medium it is for.
pub trait Medium {
    /// Which side of the interface it is.
    const OWN: Participant;

    /// Its mesh.
    fn grid(&self) -> &Mesh<BLOCK>;
    /// The time that the finest level has reached, s.
    fn reached(&self) -> f64;
    /// How many steps of it have been made.
    fn made(&self) -> u64;
    /// Which levels step when.
    fn clock(&self) -> &LevelClock;
    /// The longest step of all cells alike, s.
    fn limit(&self, cfl: f64) -> f64;
    /// The longest step of the whole if levels finer than `base` halve theirs, s.
    fn local_limit(&self, cfl: f64, base: u8) -> f64;
    /// The finest level at the interface.
    fn finest_at_interface(&self) -> u8;

    /// Begins a step of length `dt` in which levels finer than `base` make steps of their own.
    fn begin_step(&mut self, dt: f64, base: u8);
    /// The longest step of the levels whose turn it is.
    fn due_limit(&self, cfl: f64) -> f64;
    /// Starts their step.
    fn start(&mut self, limit: f64) -> GroupStep;
    /// Makes a step that has been started, or a part of it.
    fn run(&mut self, step: GroupStep, part: Part) -> Result<(), RunError>;
    /// Ends the step of the finest level, and those that end with it.
    fn finish(&mut self) -> Result<(), RunError>;

    /// Outer radii of the faces on the interface, m.
    fn edges(&self) -> Vec<f64>;
    /// Which levels, as a group, a face belongs to.
    fn group_of_face(&self, face: usize) -> usize;
    /// Writes the traces on all faces, before a long step of length `dt`.
    fn write_trace(&self, dt: f64, put: impl FnMut(TraceRow, usize, f64));
    /// Writes the traces on the faces of the levels that are about to step.
    fn write_group_trace(&self, step: GroupStep, put: impl FnMut(TraceRow, usize, f64));
    /// Sets p*, v*, p*v* on a face for the next step of its level.
    fn set_face(&mut self, face: usize, state: [f64; 3]);
    /// Sets the states of all faces for the long step under way.
    fn set_register(&mut self, register: &WallRegister<'_>);
}

macro_rules! medium {
    ($solver:ident, $own:ident, $faces:ident, $finest:ident, $set_face:ident, $set_register:ident) => {
        impl Medium for $solver<BLOCK> {
            const OWN: Participant = Participant::$own;

            fn grid(&self) -> &Mesh<BLOCK> {
                self.mesh()
            }
            fn reached(&self) -> f64 {
                self.time()
            }
            fn made(&self) -> u64 {
                self.steps()
            }
            fn clock(&self) -> &LevelClock {
                $solver::clock(self)
            }
            fn limit(&self, cfl: f64) -> f64 {
                self.time_step_limit(cfl)
            }
            fn local_limit(&self, cfl: f64, base: u8) -> f64 {
                self.local_step_limit(cfl, base)
            }
            fn finest_at_interface(&self) -> u8 {
                self.$finest()
            }
            fn begin_step(&mut self, dt: f64, base: u8) {
                $solver::begin_step(self, dt, base);
            }
            fn due_limit(&self, cfl: f64) -> f64 {
                $solver::due_limit(self, cfl)
            }
            fn start(&mut self, limit: f64) -> GroupStep {
                $solver::start(self, limit)
            }
            fn run(&mut self, step: GroupStep, part: Part) -> Result<(), RunError> {
                Ok($solver::run(self, step, part)?)
            }
            fn finish(&mut self) -> Result<(), RunError> {
                Ok($solver::finish(self)?)
            }
            fn edges(&self) -> Vec<f64> {
                self.$faces()
            }
            fn group_of_face(&self, face: usize) -> usize {
                $solver::group_of_face(self, face)
            }
            fn write_trace(&self, dt: f64, put: impl FnMut(TraceRow, usize, f64)) {
                $solver::write_trace(self, dt, put);
            }
            fn write_group_trace(&self, step: GroupStep, put: impl FnMut(TraceRow, usize, f64)) {
                $solver::write_group_trace(self, step, put);
            }
            fn set_face(&mut self, face: usize, state: [f64; 3]) {
                self.$set_face(face, state);
            }
            fn set_register(&mut self, register: &WallRegister<'_>) {
                self.$set_register(register);
            }
        }
    };
}

medium!(FluidSolver, Fluid, wall_edges, finest_at_wall, set_wall_face, set_wall);
medium!(SolidSolver, Solid, surface_edges, finest_at_surface, set_surface_face, set_surface_register);

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
        Self { cfl: case.time.cfl, local: case.time.local_steps && !common, ratio: case.coupling.step_ratio }
    }

    /// About how many steps of the finest level a step of length `dt` holds.
    pub fn steps_in(&self, dt: f64, medium: &impl Medium) -> u32 {
        mesh::steps_in(dt, medium.limit(self.cfl)) as u32
    }

    /// Steps alone, or short ones within a long one of the other side.
    pub fn alone(&self, medium: &impl Medium) -> Steps {
        let base = if self.local { medium.grid().coarsest_base() } else { u8::MAX };
        self.steps(medium, base)
    }

    /// Steps that are long ones for the other side: no level at the interface may have shorter ones.
    pub fn long(&self, medium: &impl Medium) -> Steps {
        let finest = medium.finest_at_interface();
        let base = if self.local { medium.grid().coarsest_base().max(finest) } else { u8::MAX };
        self.steps(medium, base)
    }

    fn steps(&self, medium: &impl Medium, base: u8) -> Steps {
        let limit = if self.local { medium.local_limit(self.cfl, base) } else { medium.limit(self.cfl) };
        Steps { limit, base }
    }

    /// The step by which the other side counts how many of this side's go into one of its own, s.
    pub fn counted(&self, medium: &impl Medium) -> f64 {
        let longest = LONGEST_EXCHANGE / f64::from(self.ratio) * medium.limit(self.cfl);
        self.long(medium).limit.min(longest.max(medium.limit(self.cfl)))
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
pub fn begin_long<M: Medium>(medium: &mut M, dt: f64, rule: &StepRule) -> Result<GroupStep, RunError> {
    medium.begin_step(dt, rule.long(medium).base);
    let step = medium.start(f64::INFINITY);
    medium.run(step, Part::AwayFromInterface)?;
    Ok(step)
}

/// Ends it, once the state of the interface is set. `after(medium, dt)` is called after each step of the finest level.
pub fn end_long<M: Medium>(
    medium: &mut M,
    step: GroupStep,
    rule: &StepRule,
    after: impl FnMut(&M, f64) -> Result<(), RunError>,
) -> Result<(), RunError> {
    medium.run(step, Part::AtInterface)?;
    // No level that is still to step has faces on the interface.
    step_to_end(medium, rule, |_, _| (), after)
}

/// Makes a step that does not depend on another side; `before(medium, step)` is called before each step of a level.
pub fn step_alone<M: Medium>(
    medium: &mut M,
    dt: f64,
    rule: &StepRule,
    mut before: impl FnMut(&mut M, GroupStep),
    after: impl FnMut(&M, f64) -> Result<(), RunError>,
) -> Result<(), RunError> {
    medium.begin_step(dt, rule.alone(medium).base);
    let step = medium.start(f64::INFINITY);
    before(medium, step);
    medium.run(step, Part::All)?;
    step_to_end(medium, rule, before, after)
}

fn step_to_end<M: Medium>(
    medium: &mut M,
    rule: &StepRule,
    mut before: impl FnMut(&mut M, GroupStep),
    mut after: impl FnMut(&M, f64) -> Result<(), RunError>,
) -> Result<(), RunError> {
    loop {
        while medium.clock().due().is_some() {
            let limit = within(medium, medium.clock().length(0), medium.due_limit(rule.cfl))?;
            let step = medium.start(limit);
            before(medium, step);
            medium.run(step, Part::All)?;
        }
        if end_sub_step(medium, &mut after)? {
            return Ok(());
        }
    }
}

/// The limit of a step within one of length `whole`.
///
/// - errors: it has collapsed.
fn within<M: Medium>(medium: &M, whole: f64, limit: f64) -> Result<f64, RunError> {
    if limit > SMALLEST_WITHIN * whole {
        return Ok(limit);
    }
    Err(RunError::TimeStepCollapsed {
        dt: limit,
        time: medium.reached(),
        step: medium.made() + 1,
        limited_by: M::OWN.name(),
    })
}

/// Ends the step of the finest level and tells of it; whether the whole step is over.
fn end_sub_step<M: Medium>(
    medium: &mut M,
    after: &mut impl FnMut(&M, f64) -> Result<(), RunError>,
) -> Result<bool, RunError> {
    let dt = medium.clock().length(medium.clock().finest());
    medium.finish()?;
    after(medium, dt)?;
    Ok(medium.clock().is_over())
}

/// Begins to meet the other side's trace.
pub fn begin_meeting<M: Medium>(medium: &M, meeting: &mut Meeting, trace: (&[f64], usize)) {
    let mesh = medium.grid();
    let domain = mesh.domain();
    let axisymmetric = domain.geometry == Geometry::Axisymmetric;
    let own = (mesh.generation(), || medium.edges());
    meeting.begin(trace, medium.reached(), own, domain.r[0], axisymmetric);
}

/// Makes the short steps within the other side's long one, of length `dt`.
///
/// - `answer`: called as soon as all is known that the interface will do. `after`: as in [`end_long`].
/// - errors: those of the medium, what meets is no state, the steps collapse on the way.
pub fn short_steps<M: Medium>(
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
            let limit = if group == 0 { rule.alone(medium).limit } else { medium.due_limit(rule.cfl) };
            let step = medium.start(within(medium, dt, limit)?);
            let (rows, faces) = meeting.own_trace();
            medium.write_group_trace(step, |row, face, value| rows[row as usize * faces + face] = value);
            let is_due = |face: usize| medium.group_of_face(face) == group;
            let short = ShortStep { begin: step.begin, dt: step.dt };
            meeting.meet(M::OWN, short, star, is_due)?;
            meeting.own_means(|face, state| {
                if medium.group_of_face(face) == group {
                    medium.set_face(face, state);
                }
            });
            if !is_answered
                && (0..faces).step_by(BLOCK).all(|face| medium.clock().is_last(medium.group_of_face(face)))
            {
                answer(medium, meeting)?;
                is_answered = true;
            }
            medium.run(step, Part::All)?;
        }
        if end_sub_step(medium, &mut after)? {
            return Ok(());
        }
    }
}
