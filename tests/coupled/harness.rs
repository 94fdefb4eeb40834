//! Two ways to drive both media: as a run does, from a case; and by hand, from functions of the place.

use std::path::Path;

use cav::case::{Case, LocalSteps};
use cav::run::process::stop::Stop;
use cav::run::side::RunSide as _;
use cav::run::side::coupled_solver::{self, CoupledSolver, StepRule};
use cav::run::side::fluid_side::{FluidSide, Turn};
use cav::run::side::solid_side::SolidSide;
use coupler::{
    DirectLink, Link as _, LinkCounters, Meeting, Participant, RegisterRow, ShortStep, StarSolver, TraceRow,
    WallRegister, direct_pair,
};
use fluid::{Boundary as FluidBoundary, FluidSetup, FluidSolver, Model, Primitive, StiffenedGas};
use mesh::{BLOCK, Domain, Geometry, Limiter, Mesh};
use solid::{Boundary as SolidBoundary, ElasticState, SolidSetup, SolidSolver, WaveSpeeds};

use crate::own_thread::keep_to_own_thread;

/// The fluid's solver as runs use it.
pub type Fluid = FluidSolver<BLOCK>;
/// The solid's solver as runs use it.
pub type Solid = SolidSolver<BLOCK>;

/// Water.
pub const WATER: StiffenedGas = StiffenedGas { gamma: 7.15, pi: 3e8 };
/// Structural steel: density, c1, c2.
pub const STEEL: [f64; 3] = [7800.0, 5990.0, 3458.0];

/// Lines of `[coupling]`: the paper's schemes, and in which order its media move.
pub const PAPERS_SCHEMES: [&str; 6] = [
    "scheme = \"explicit\"",
    "scheme = \"weak\"",
    "scheme = \"weak\"\nfirst = \"solid\"",
    "scheme = \"weak\"\nkappa = \"jump\"",
    "scheme = \"strong\"",
    "scheme = \"strong\"\nfirst = \"solid\"",
];

/// The speed of sound in water of 1000 kg/m³.
pub fn sound(pressure: f64) -> f64 {
    (WATER.gamma * (pressure + WATER.pi) / 1000.0).sqrt()
}

/// Reads a case from text.
pub fn case(text: &str) -> Case {
    keep_to_own_thread();
    Case::from_toml(text, "coupled", &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Both sides of a case, as a run in one process has them.
pub struct Sides {
    pub fluid: FluidSide,
    pub solid: SolidSide,
    to_solid: DirectLink,
    to_fluid: DirectLink,
    stop: Stop,
}

impl Sides {
    /// Ready for the first step, without a run directory.
    pub fn of(case: &Case) -> Self {
        let (Some(fluid), Some(solid)) = (&case.fluid, &case.solid) else { panic!("both media") };
        let (to_solid, mut to_fluid) = direct_pair(case.hash());
        let stop = Stop::default();
        let fluid = FluidSide::new(case, fluid, None).expect("the fluid");
        let mut solid = SolidSide::new(case, solid, None).expect("the solid");
        solid.open(&mut to_fluid, &stop).expect("the solid opens");
        Self { fluid, solid, to_solid, to_fluid, stop }
    }

    /// [`Sides::of`] a case whose text is that of these parts.
    pub fn of_parts(parts: &[&str]) -> Self {
        Self::of(&case(&parts.concat()))
    }

    /// [`Sides::of`] a case of `cases/`, its snapshots left out, with changes to it as `--set` has them.
    pub fn of_shipped<'a>(name: &str, changes: impl IntoIterator<Item = &'a str>) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("cases/{name}.toml"));
        let sets: Vec<String> = changes.into_iter().chain(["time.snapshots=[]"]).map(String::from).collect();
        Self::of(&Case::load(&path, &sets).unwrap_or_else(|errors| panic!("{errors}")))
    }

    /// A round of turns; `look` sees both between their turns: at the same time.
    ///
    /// - returns: whether the run goes on.
    pub fn round(&mut self, mut look: impl FnMut(&Fluid, &Solid)) -> bool {
        while !self.fluid.complete(&mut self.to_solid).expect("the fluid's step") {
            self.solid.turn(&mut self.to_fluid, &self.stop).expect("the solid's trial");
        }
        self.solid.settle(&mut self.to_fluid).expect("the solid's step");
        look(self.fluid.solver(), self.solid.solver());
        let turn = self.fluid.begin(&mut self.to_solid, &self.stop).expect("the fluid's turn");
        self.solid.turn(&mut self.to_fluid, &self.stop).expect("the solid's turn");
        turn == Turn::Continues
    }

    /// What the fluid's end of the link has done so far.
    pub fn exchanged(&self) -> LinkCounters {
        self.to_solid.counters()
    }

    /// To the end of the case.
    pub fn run(&mut self, mut look: impl FnMut(&Fluid, &Solid)) {
        while self.round(&mut look) {}
    }
}

/// Both media coupled by hand, in the steps that the sides of a run make.
pub struct Pair {
    pub fluid: Fluid,
    pub solid: Solid,
    meeting: Meeting,
    star: StarSolver,
    trace: Vec<f64>,
    register: Vec<f64>,
}

impl Pair {
    /// Of two solvers with the interface between them.
    pub fn of(fluid: Fluid, solid: Solid) -> Self {
        let faces = fluid.interface().faces();
        let mut trace = vec![0.0; TraceRow::COUNT * faces];
        trace[..faces].copy_from_slice(&fluid.interface_edges());
        Self {
            trace,
            register: vec![0.0; RegisterRow::COUNT * faces],
            meeting: Meeting::default(),
            star: StarSolver::Exact,
            fluid,
            solid,
        }
    }

    /// One step of `dt`.
    pub fn step(&mut self, dt: f64) {
        let Self { fluid, solid, meeting, star, trace, register } = self;
        let faces = fluid.interface().faces();
        CoupledSolver::write_trace(fluid, dt, |row, face, value| trace[row as usize * faces + face] = value);
        let domain = solid.mesh().domain();
        let axisymmetric = domain.geometry == Geometry::Axisymmetric;
        let own = (solid.mesh().generation(), || solid.interface_edges());
        meeting.begin((&*trace, faces), solid.time(), own, domain.r[0], axisymmetric);
        let (rows, count) = meeting.own_trace();
        CoupledSolver::write_trace(solid, dt, |row, face, value| rows[row as usize * count + face] = value);
        let step = ShortStep { begin: solid.time(), dt };
        meeting.meet(Participant::Solid, step, *star, |_| true).expect("two states");
        meeting.own_means(|face, state| solid.interface_mut().set(face, state.into()));
        meeting.write_register(register);
        fluid.interface_mut().set_rows(WallRegister::of(register, faces).rows());
        solid.whole_step(dt).expect("the solid's step");
        fluid.whole_step(dt).expect("the fluid's step");
    }

    /// Steps until `end` of which each is a long one of one side and `ratio` short ones of the other.
    ///
    /// - `long`: whose steps are the longer ones; `local`: whether levels step by themselves.
    pub fn run_in_ratio(&mut self, end: f64, cfl: f64, long: Participant, ratio: u32, local: bool) {
        let Self { fluid, solid, .. } = self;
        let limits = [fluid.time_step_limit(cfl), solid.time_step_limit(cfl)];
        // Of the long step, the other side's Courant number allows that many, or more.
        let (own, others) =
            if long == Participant::Fluid { (limits[0], limits[1]) } else { (limits[1], limits[0]) };
        let limit = own.min(f64::from(ratio) * others) / 1.001;
        let steps = (end / limit).ceil();
        let dt = end / steps;
        let local = if local { LocalSteps::Always } else { LocalSteps::Never };
        let rule = |cfl: f64| StepRule { cfl, local, ratio, smallest: 0.0 };
        // So that as many are made as asked for.
        let short = rule(cfl * dt / (f64::from(ratio) * others));
        for _ in 0..steps as usize {
            match long {
                Participant::Fluid => {
                    exchange(&mut self.fluid, &mut self.solid, dt, [rule(cfl), short], self.star);
                }
                Participant::Solid => {
                    exchange(&mut self.solid, &mut self.fluid, dt, [rule(cfl), short], self.star);
                }
            }
        }
    }

    /// Steps at the Courant number `cfl` until `end`, all of one length.
    pub fn run(&mut self, end: f64, cfl: f64, mut look: impl FnMut(&Fluid, &Solid)) {
        // The fluid hardly moves in the problems that are driven so: a little room is enough.
        let limit = self.fluid.time_step_limit(cfl).min(self.solid.time_step_limit(cfl)) / 1.001;
        let steps = (end / limit).ceil();
        for _ in 0..steps as usize {
            self.step(end / steps);
            look(&self.fluid, &self.solid);
        }
    }
}

/// A long step of one side and the short ones of the other.
fn exchange<L: CoupledSolver, S: CoupledSolver>(
    long: &mut L,
    short: &mut S,
    dt: f64,
    rules: [StepRule; 2],
    star: StarSolver,
) {
    let edges = long.interface_edges();
    let faces = edges.len();
    let mut trace = vec![0.0; TraceRow::COUNT * faces];
    trace[..faces].copy_from_slice(&edges);
    long.write_trace(dt, |row, face, value| trace[row as usize * faces + face] = value);
    let step = coupled_solver::begin_long(long, dt, &rules[0]).expect("the long step");
    let mut meeting = Meeting::default();
    coupled_solver::begin_meeting(short, &mut meeting, (&trace, faces));
    coupled_solver::short_steps(short, &mut meeting, (dt, star), &rules[1], |_, _| Ok(()), |_, _| Ok(()))
        .expect("the short steps");
    let mut register = vec![0.0; RegisterRow::COUNT * faces];
    meeting.write_register(&mut register);
    long.interface_mut().set_rows(WallRegister::of(&register, faces).rows());
    coupled_solver::end_long(long, step, &rules[0], |_, _| Ok(())).expect("the long step's end");
}

/// Water on a grid.
pub fn water(
    domain: Domain,
    cells: [usize; 2],
    limiter: Limiter,
    boundaries: [FluidBoundary; 4],
    state: impl Fn([f64; 2]) -> Primitive + Sync,
) -> Fluid {
    keep_to_own_thread();
    let setup = FluidSetup {
        model: Model::SaurelAbgrall,
        sharpening: fluid::Sharpening::None,
        limiter,
        ..FluidSetup::new(domain, cells, boundaries)
    };
    Fluid::from_fn(&setup, state).expect("water")
}

/// A solid on a grid.
pub fn elastic(
    domain: Domain,
    cells: [usize; 2],
    [density, c1, c2]: [f64; 3],
    limiter: Limiter,
    boundaries: [SolidBoundary; 4],
    state: impl Fn([f64; 2]) -> ElasticState + Sync,
) -> Solid {
    let setup = SolidSetup {
        domain,
        coarsest: cells,
        levels: 0,
        speeds: WaveSpeeds { density, c1, c2 },
        yield_strength: f64::INFINITY,
        plasticity: None,
        limiter,
        boundaries,
        adaptation: None,
        stress_scale: 1e6,
        weight: None,
        load: None,
    };
    Solid::new(setup, state).expect("a solid")
}

/// A strip in planar geometry.
pub fn strip(z: [f64; 2], r: f64) -> Domain {
    Domain { geometry: Geometry::Planar, z, r: [0.0, r] }
}

/// The value farthest from zero, with its sign.
pub fn extreme(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most: f64, value| if value.abs() > most.abs() { value } else { most })
}

/// All cells of a mesh: centre and state.
fn cells<T>(mesh: &Mesh<BLOCK>, state: impl Fn(usize, usize, usize) -> T) -> Vec<([f64; 2], T)> {
    let mut cells = Vec::new();
    for (slot, id) in mesh.tree().leaves().iter().enumerate() {
        for j in 0..BLOCK {
            cells.extend((0..BLOCK).map(|i| (mesh.centre(*id, i, j), state(slot, i, j))));
        }
    }
    cells
}

/// All cells of a fluid: centre and state.
pub fn fluid_cells(fluid: &Fluid) -> Vec<([f64; 2], Primitive)> {
    cells(fluid.mesh(), |slot, i, j| fluid.cell(slot, i, j))
}

/// All cells of a solid: centre and state.
pub fn solid_cells(solid: &Solid) -> Vec<([f64; 2], ElasticState)> {
    cells(solid.mesh(), |slot, i, j| solid.cell(slot, i, j))
}

/// The value of a column of a series at a time, which is the first.
pub fn at<const COLUMNS: usize>(rows: &[[f64; COLUMNS]], time: f64, column: usize) -> f64 {
    let after = rows.partition_point(|row| row[0] < time).clamp(1, rows.len() - 1);
    let [before, next] = [rows[after - 1], rows[after]];
    before[column] + (next[column] - before[column]) * (time - before[0]) / (next[0] - before[0])
}
