//! Frames of a run that are not what the peer has sent.
//!
//! A small run of two sides; one frame on its way between them is changed. Whoever gets it may refuse it, or take it and go on: into
//! the mapping between the faces, the Riemann problems of the meeting, the fluid's wall and the solid's surface, and the steps after
//! them. Neither may panic or go on for ever, and none may be left with an interface that is not finite.

use cav::case::Case;
use cav::run::RunError;
use cav::run::process::stop::Stop;
use cav::run::side::RunSide as _;
use cav::run::side::fluid_side::{FluidSide, Turn};
use cav::run::side::solid_side::SolidSide;
use coupler::{
    CouplerError, DirectLink, Expected, FlowParticipant, FlowTrace, Frame, FrameHeader, InterfaceStar, Link,
    LinkCounters, TraceRow, WallParticipant, direct_pair, fluid_at_moving_wall,
};

#[path = "../tests/fixture/mod.rs"]
mod fixture;

use fixture::{AIR, bubble, grid, steel, water};

/// Rounds of a run: some frames after the one that is changed.
const ROUNDS: usize = 4;

/// Bytes of one change: what, where, and a number.
pub const CHANGE: usize = 11;

/// What each run is of: the schemes, both ratios of steps, grids that adapt, another program on either side.
pub const RUNS: [(&[&str], bool, bool); 9] = [
    (&[], true, true),
    // The fluid's cells are so flat that the solid's step is the longer one.
    (&["fluid.z=[0.0,0.0001]", "fluid.region.0.centre=[0.0,0.0]"], true, true),
    (
        &["coupling.star=\"acoustic\"", "time.local_steps=true", "fluid.levels=1", "solid.levels=1"],
        true,
        true,
    ),
    (&["coupling.scheme=\"explicit\""], true, true),
    (&["coupling.scheme=\"weak\"", "coupling.kappa=\"jump\""], true, true),
    (&["coupling.scheme=\"strong\""], true, true),
    (&["coupling.scheme=\"strong\"", "coupling.first=\"solid\""], true, true),
    (&["coupling.scheme=\"external\""], true, false),
    (&["coupling.scheme=\"external\""], false, true),
];

fn case((sets, has_fluid, has_solid): (&[&str], bool, bool)) -> Case {
    let lines = |z| grid(z, 0.0016, [16, 16]) + "levels = 0\n";
    let fluid = water(&lines([0.0, 0.0016]), 1e7) + &bubble([0.0004, 0.0], 0.0006, AIR);
    let solid = steel(&lines([-0.0016, 0.0]));
    let part = |is_there: bool, text: String| if is_there { text } else { String::new() };
    let text = ["[time]\nend = 2e-6\n", &part(has_fluid, fluid), &part(has_solid, solid)].concat();
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    Case::from_toml(&text, "frames", &sets).unwrap_or_else(|errors| panic!("{errors}"))
}

/// A link on which one of the received frames is changed.
struct Changed<'a> {
    inner: DirectLink,
    /// Frames until then.
    left: Option<u8>,
    changes: &'a [u8],
}

impl Link for Changed<'_> {
    fn send(&mut self, header: FrameHeader, fill: impl FnOnce(&mut [f64])) -> Result<(), CouplerError> {
        self.inner.send(header, fill)
    }

    fn try_receive<R>(&mut self, read: impl FnOnce(&Frame<'_>) -> R) -> Result<Option<R>, CouplerError> {
        let Self { inner, left, changes } = self;
        let received = inner.try_receive(|frame| {
            let is_due = *left == Some(0);
            *left = left.and_then(|left| left.checked_sub(1));
            if !is_due {
                return Ok(read(frame));
            }
            let (mut header, mut payload) = (*frame.header, frame.payload.to_vec());
            change(&mut header, &mut payload, changes);
            let changed = Frame { header: &header, payload: &payload, sender: frame.sender };
            let FrameHeader { case_hash, sequence, pid, .. } = *frame.header;
            changed.check(&Expected { case_hash, sequence, pid: Some(pid) })?;
            Ok(read(&changed))
        })?;
        received.transpose()
    }

    fn wait(&mut self) -> Result<(), CouplerError> {
        self.inner.wait()
    }

    fn counters(&self) -> LinkCounters {
        self.inner.counters()
    }
}

/// Changes a frame as the bytes say, [`CHANGE`] of them at a time.
fn change(header: &mut FrameHeader, payload: &mut Vec<f64>, bytes: &[u8]) {
    for bytes in bytes.as_chunks::<CHANGE>().0 {
        let [what, low, high, number @ ..] = *bytes;
        let (at, bits) = (usize::from(u16::from_le_bytes([low, high])), u64::from_le_bytes(number));
        let value = f64::from_bits(bits);
        let (len, rows) = (payload.len(), header.fields.clamp(1, 64) as usize);
        match what % 16 {
            0..=3 if len > 0 => payload[at % len] = value,
            4 if len > 0 => payload[at % len] *= value,
            5 if len > 0 => {
                let row = at % rows;
                payload[row * (len / rows)..][..len / rows].fill(value);
            }
            6 => header.time = value,
            7 => header.dt = value,
            8 => header.dt *= value,
            9 => header.dt_max = value,
            10 => header.flags ^= 1 << (at % 32),
            11 => header.kind = at as u32,
            // Other faces, evenly spaced as far as there are more of them.
            12 => {
                let (old, new) = (header.count as usize, at % 40);
                let row = |k: usize| payload.get(k * old..(k + 1) * old).unwrap_or_default();
                let face = |row: &[f64], j: usize| row.get(j * old / new.max(1)).copied().unwrap_or(value);
                *payload = (0..rows).flat_map(|k| (0..new).map(move |j| face(row(k), j))).collect();
                header.count = new as u64;
            }
            13 => header.count = bits,
            14 => header.fields = bits,
            15 => (header.cells, header.step, header.ready_ns, header.code) = (bits, bits, bits, bits),
            _ => {}
        }
    }
}

/// What a run comes to if a frame is changed. The bytes: which run, who receives the frame (0 the fluid, 1 the solid), which one of
/// those that it receives, and the changes.
pub fn changed_run(bytes: &[u8]) -> Result<(), RunError> {
    let [run, whose, number, changes @ ..] = bytes else { return Ok(()) };
    let run = RUNS[usize::from(*run) % RUNS.len()];
    let case = case(run);
    let (to_solid, to_fluid) = direct_pair(case.hash());
    let link = |inner: DirectLink, is_it: bool| Changed {
        inner,
        left: is_it.then_some(number % (2 * ROUNDS as u8)),
        changes,
    };
    let (mut to_solid, mut to_fluid) = (link(to_solid, whose % 2 == 0), link(to_fluid, whose % 2 == 1));
    match run {
        (_, true, true) => both(&case, &mut to_solid, &mut to_fluid),
        (_, true, false) => beside_a_wall(&case, &mut to_solid, &mut to_fluid),
        _ => under_a_flow(&case, &mut to_solid, &mut to_fluid),
    }
}

/// [`changed_run`]: an error or none.
pub fn interface_frame(bytes: &[u8]) {
    if let Err(error) = changed_run(bytes) {
        assert!(!error.to_string().is_empty());
    }
}

/// Both sides of ours.
fn both(case: &Case, to_solid: &mut impl Link, to_fluid: &mut impl Link) -> Result<(), RunError> {
    let stop = Stop::default();
    let mut fluid = FluidSide::new(case, case.fluid.as_ref().unwrap(), None)?;
    let mut solid = SolidSide::new(case, case.solid.as_ref().unwrap(), None)?;
    solid.open(to_fluid, &stop)?;
    fluid.complete(to_solid)?;
    for _ in 0..ROUNDS {
        let turn = fluid.begin(to_solid, &stop)?;
        if solid.turn(to_fluid, &stop)? != turn || turn != Turn::Continues {
            break;
        }
        while !fluid.complete(to_solid)? {
            solid.turn(to_fluid, &stop)?;
        }
        solid.settle(to_fluid)?;
        is_finite(&fluid);
        for state in solid.solver().interface().states() {
            assert!(state.pressure.is_finite() && state.velocity.is_finite() && state.power.is_finite());
        }
    }
    Ok(())
}

/// Our fluid, and a wall of another program's that moves with a given velocity.
fn beside_a_wall(case: &Case, to_wall: &mut impl Link, to_fluid: &mut impl Link) -> Result<(), RunError> {
    let stop = Stop::default();
    let mut fluid = FluidSide::new(case, case.fluid.as_ref().unwrap(), None)?;
    let mut wall = WallParticipant::default();
    wall.max_step = 1e-7;
    wall.open(to_fluid)?;
    for _ in 0..ROUNDS {
        if fluid.turn(to_wall, &stop)? != Turn::Continues {
            break;
        }
        is_finite(&fluid);
        let goes_on = wall.turn(to_fluid, |step, means| {
            for face in 0..step.edges().len() {
                let trace = step.trace_at(face, step.begin + 0.5 * step.dt);
                assert!(trace.is_state() && step.row(TraceRow::Edge)[face].is_finite());
                let InterfaceStar { pressure, velocity, .. } = fluid_at_moving_wall(&trace, 1.0);
                let star = InterfaceStar { pressure, velocity, iterations: 0, floored: false };
                means.add(face, 1.0, &star);
            }
        })?;
        if !goes_on {
            break;
        }
    }
    Ok(())
}

/// Our solid, and another program's load.
fn under_a_flow(case: &Case, to_solid: &mut impl Link, to_flow: &mut impl Link) -> Result<(), RunError> {
    let stop = Stop::default();
    let mut solid = SolidSide::new(case, case.solid.as_ref().unwrap(), None)?;
    solid.open(to_flow, &stop)?;
    let mut flow = FlowParticipant::open(to_solid, vec![0.0005, 0.0016])?;
    for _ in 0..ROUNDS {
        flow.begin(to_solid, 5e-8, |face| FlowTrace::load(1e6, -1e13 * face as f64))?;
        if solid.turn(to_flow, &stop)? != Turn::Continues {
            break;
        }
        let means = flow.complete(to_solid)?;
        let rows = [means.pressure, means.velocity, means.power];
        assert!(rows.concat().iter().all(|value| value.is_finite()), "{means:?}");
    }
    Ok(())
}

fn is_finite(fluid: &FluidSide) {
    for state in fluid.solver().interface().states() {
        assert!(state.pressure.is_finite() && state.velocity.is_finite() && state.power.is_finite());
    }
}
