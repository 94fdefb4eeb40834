//! Participants without physics of ours: what a third party's solver, or a test, needs to take either side of the interface.
//!
//! [`WallParticipant`] takes the solid's side, [`FlowParticipant`] the fluid's, over any [`Link`]: a [`ProcessLink`] to another
//! process, or a [`direct_pair`] in one. Both are for the scheme `"riemann"`: one round trip per step of the fluid, in which
//! the side that follows makes as many steps of its own as it likes. Velocities count along +z, from the solid into the fluid.
//!
//! [`ProcessLink`]: crate::ProcessLink
//! [`direct_pair`]: crate::direct_pair

use crate::content::StepLength;
use crate::error::CouplerError;
use crate::exchange::{RegisterRow, TraceRow, WallRegister};
use crate::frame::FrameHeader;
use crate::kinds::FrameKind;
use crate::kinds::Participant;
use crate::link::Link;
use crate::star::{FluidTrace, InterfaceStar};

/// A step that the fluid is about to make, and its traces on the interface.
#[derive(Clone, Copy, Debug)]
pub struct FluidStep<'a> {
    /// Its number, from 0.
    pub number: u64,
    /// When it begins, s.
    pub begin: f64,
    /// Its length, s.
    pub dt: f64,
    faces: usize,
    payload: &'a [f64],
}

impl<'a> FluidStep<'a> {
    /// The outer radius of each face, ascending, m; the first one begins at the domain's r_min.
    pub fn edges(&self) -> &'a [f64] {
        TraceRow::Edge.of(self.payload, self.faces)
    }

    /// One row of the frame, a number per face; see [`TraceRow`] for units.
    pub fn row(&self, row: TraceRow) -> &'a [f64] {
        row.of(self.payload, self.faces)
    }

    /// Whether there is a state on every face throughout the step: linear in time, it is one if it is at both ends.
    fn require_states(&self) -> Result<(), CouplerError> {
        for time in [self.begin, self.begin + self.dt] {
            for (face, edge) in self.edges().iter().enumerate() {
                let state = self.trace_at(face, time);
                if !state.is_state() {
                    let (side, values) = (Participant::Fluid, format!("{state:?}"));
                    return Err(CouplerError::NoState { side, radius: *edge, time, values });
                }
            }
        }
        Ok(())
    }

    /// The fluid's own state on a face at a time within the step, linear in time; on all of it density and p + π are
    /// above zero.
    ///
    /// # Panics
    /// If there is no such face.
    pub fn trace_at(&self, face: usize, time: f64) -> FluidTrace {
        let value = |row: TraceRow| self.row(row)[face];
        let moved = |row, rate| value(row) + (time - self.begin) * value(rate);
        FluidTrace {
            pressure: moved(TraceRow::Pressure, TraceRow::PressureRate),
            velocity: moved(TraceRow::NormalVelocity, TraceRow::NormalVelocityRate),
            density: moved(TraceRow::Density, TraceRow::DensityRate),
            gamma: value(TraceRow::Gamma),
            pi: value(TraceRow::Pi),
        }
    }
}

/// What the interface does during a step of the fluid: means over it, face by face.
#[derive(Debug)]
pub struct WallMeans<'a> {
    faces: usize,
    payload: &'a mut [f64],
}

impl WallMeans<'_> {
    /// Adds the state during a part of the step.
    ///
    /// - `share`: of the step's length; those of a face have to add up to 1.
    ///
    /// # Panics
    /// If there is no such face.
    pub fn add(&mut self, face: usize, share: f64, star: &InterfaceStar) {
        for (row, value) in [
            (RegisterRow::Pressure, star.pressure),
            (RegisterRow::NormalVelocity, star.velocity),
            (RegisterRow::Power, star.pressure * star.velocity),
        ] {
            self.payload[row as usize * self.faces..][..self.faces][face] += share * value;
        }
    }
}

/// The solid's side.
#[derive(Clone, Debug)]
pub struct WallParticipant {
    /// The fluid's steps are at most `coupling.step_ratio` times as long, s; infinite: as long as the fluid likes.
    pub max_step: f64,
    step: u64,
    begin: f64,
    dt: f64,
    payload: Vec<f64>,
    shape: usize,
}

impl Default for WallParticipant {
    fn default() -> Self {
        Self { max_step: f64::INFINITY, step: 0, begin: 0.0, dt: 0.0, payload: Vec::new(), shape: 0 }
    }
}

impl WallParticipant {
    /// Says the first word. To be called once, before the fluid waits for it.
    ///
    /// - errors: the peer is gone.
    pub fn open(&mut self, link: &mut impl Link) -> Result<(), CouplerError> {
        link.send(self.header(0), |_| {})
    }

    /// Takes part in a step: waits for the fluid's traces, and answers with what the wall makes of them.
    ///
    /// - `respond`: gets the traces and the means, all zero.
    /// - returns: `false` when the run is over.
    /// - errors: the peer is gone or sends what it must not: a step that does not begin where the last one has ended,
    ///   numbers that are none, faces that do not ascend, traces that are no state.
    pub fn turn(
        &mut self,
        link: &mut impl Link,
        respond: impl FnOnce(&FluidStep<'_>, &mut WallMeans<'_>),
    ) -> Result<bool, CouplerError> {
        let due = self.begin + self.dt;
        let Self { payload, shape, step, begin, dt, .. } = self;
        let goes_on = link.receive(|frame| {
            frame.require(FrameKind::Trace)?;
            frame.require_time(due)?;
            if frame.header.has(FrameHeader::LAST) {
                return Ok(false);
            }
            frame.require_step(due, StepLength::AtMost(f64::MAX))?;
            let (rows, faces) = frame.trace_on(None)?;
            payload.clear();
            payload.resize(RegisterRow::COUNT * faces, 0.0);
            (*shape, *step) = (faces, frame.header.step);
            (*begin, *dt) = (frame.header.time, frame.header.dt);
            let seen = FluidStep { number: *step, begin: *begin, dt: *dt, faces, payload: rows };
            seen.require_states()?;
            respond(&seen, &mut WallMeans { faces, payload });
            Ok::<_, CouplerError>(true)
        })??;
        if goes_on {
            let answer = &self.payload;
            link.send(self.header(self.shape), |payload| payload.copy_from_slice(answer))?;
        }
        Ok(goes_on)
    }

    fn header(&self, faces: usize) -> FrameHeader {
        FrameHeader {
            step: self.step,
            time: self.begin,
            dt: self.dt,
            dt_max: self.max_step,
            fields: RegisterRow::COUNT as u64,
            count: faces as u64,
            flags: FrameHeader::FOLLOWS,
            ..FrameHeader::new(FrameKind::Register)
        }
    }
}

/// What the fluid's side shows on one face at the beginning of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowTrace {
    /// Its state.
    pub state: FluidTrace,
    /// ∂p/∂t, Pa/s.
    pub pressure_rate: f64,
    /// ∂v/∂t, m/s².
    pub velocity_rate: f64,
}

impl FlowTrace {
    /// A pressure (Pa) that stays as it is whatever the wall does, and its rate of change (Pa/s): the trace of a medium
    /// without inertia. For steps of less than a second.
    #[must_use]
    pub fn load(pressure: f64, pressure_rate: f64) -> Self {
        // γ and π such that its waves are linear about any pressure that it comes to; and so light, in proportion, that p* is
        // the pressure to round-off: the impedance √(ργ(p + π)) is about 1e-20.
        let pi = 1.0 + 1e3 * pressure.abs() + pressure_rate.abs();
        let state = FluidTrace { pressure, velocity: 0.0, density: 1e-40 / pi, gamma: 2.0, pi };
        Self { state, pressure_rate, velocity_rate: 0.0 }
    }
}

/// The fluid's side, which leads: it says how long steps are and when the run ends.
#[derive(Clone, Debug)]
pub struct FlowParticipant {
    /// Outer radii of its faces on the interface, ascending, m.
    pub edges: Vec<f64>,
    time: f64,
    step: u64,
    dt: f64,
    max_step: f64,
    payload: Vec<f64>,
}

impl FlowParticipant {
    /// Waits for the solid's first word.
    ///
    /// - `edges`: outer radii of the own faces on the interface, ascending, m.
    /// - errors: the peer is gone or sends what it must not.
    pub fn open(link: &mut impl Link, edges: Vec<f64>) -> Result<Self, CouplerError> {
        let mut own =
            Self { edges, time: 0.0, step: 0, dt: 0.0, max_step: f64::INFINITY, payload: Vec::new() };
        own.max_step = link.receive(|frame| {
            frame.require(FrameKind::Register)?;
            frame.require_empty()?;
            frame.require_time(0.0)?;
            frame.require_limit()
        })??;
        Ok(own)
    }

    /// The time at which the next step begins, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The solid's own longest step, s: within a longer one of this side it makes several.
    pub fn max_step(&self) -> f64 {
        self.max_step
    }

    /// Begins a step of length `dt` (s): shows the traces, face by face. The solid makes its steps meanwhile.
    ///
    /// The solid refuses a step that does not move time on or goes beyond the end of its case.
    ///
    /// - errors: the peer is gone.
    pub fn begin(
        &mut self,
        link: &mut impl Link,
        dt: f64,
        mut trace: impl FnMut(usize) -> FlowTrace,
    ) -> Result<(), CouplerError> {
        self.dt = dt;
        let faces = self.edges.len();
        let header = FrameHeader {
            step: self.step,
            time: self.time,
            dt,
            fields: TraceRow::COUNT as u64,
            count: faces as u64,
            ..FrameHeader::new(FrameKind::Trace)
        };
        link.send(header, |payload| {
            let mut put =
                |row: TraceRow, face: usize, value: f64| payload[row as usize * faces + face] = value;
            for (face, edge) in self.edges.iter().enumerate() {
                let FlowTrace { state, pressure_rate, velocity_rate } = trace(face);
                put(TraceRow::Edge, face, *edge);
                put(TraceRow::Pressure, face, state.pressure);
                put(TraceRow::NormalVelocity, face, state.velocity);
                put(TraceRow::Density, face, state.density);
                put(TraceRow::Gamma, face, state.gamma);
                put(TraceRow::Pi, face, state.pi);
                put(TraceRow::Impedance, face, state.impedance());
                put(TraceRow::PressureRate, face, pressure_rate);
                put(TraceRow::NormalVelocityRate, face, velocity_rate);
            }
        })
    }

    /// Ends the step: means over it of p*, v* and p*v* on the own faces.
    ///
    /// - errors: the peer is gone or sends what it must not.
    pub fn complete(&mut self, link: &mut impl Link) -> Result<WallRegister<'_>, CouplerError> {
        let (faces, begin, dt) = (self.edges.len(), self.time, self.dt);
        let payload = &mut self.payload;
        self.max_step = link.receive(|frame| {
            frame.require(FrameKind::Register)?;
            frame.require_step(begin, StepLength::Is(dt))?;
            frame.register(faces)?;
            payload.clear();
            payload.extend_from_slice(frame.payload);
            frame.require_limit()
        })??;
        self.step += 1;
        self.time += self.dt;
        Ok(WallRegister::of(&self.payload, faces))
    }

    /// Says that the run is over.
    ///
    /// - errors: the peer is gone.
    pub fn close(&mut self, link: &mut impl Link) -> Result<(), CouplerError> {
        let flags = FrameHeader::LAST;
        link.send(
            FrameHeader { step: self.step, time: self.time, flags, ..FrameHeader::new(FrameKind::Trace) },
            |_| {},
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{SolidTrace, acoustic_star, direct_pair, exact_star};

    #[test]
    fn two_participants_without_physics_meet() {
        let (mut to_wall, mut to_flow) = direct_pair([3; 32]);
        let mut wall = WallParticipant { max_step: 0.25, ..WallParticipant::default() };
        wall.open(&mut to_flow).unwrap();
        let mut flow = FlowParticipant::open(&mut to_wall, vec![1.0, 2.0]).unwrap();
        assert_eq!(flow.max_step(), 0.25);
        for step in 0..3 {
            let state = FluidTrace { pressure: 7.0, velocity: 0.5, density: 1.0, gamma: 2.0, pi: 3.0 };
            let trace = |face| FlowTrace { state, pressure_rate: face as f64, velocity_rate: 2.0 };
            flow.begin(&mut to_wall, 1.0, trace).unwrap();
            let goes_on = wall.turn(&mut to_flow, |seen, means| {
                assert_eq!((seen.number, seen.begin, seen.dt), (step, step as f64, 1.0));
                assert_eq!(seen.edges(), [1.0, 2.0]);
                // Two parts of the step, the wall at rest.
                for face in 0..2 {
                    for (share, middle) in [(0.25, 0.125), (0.75, 0.625)] {
                        let trace = seen.trace_at(face, seen.begin + middle);
                        assert_eq!(trace.velocity, 0.5 + 2.0 * middle);
                        let pressure = trace.pressure;
                        means.add(
                            face,
                            share,
                            &InterfaceStar { pressure, velocity: 0.1, iterations: 0, floored: false },
                        );
                    }
                }
            });
            assert!(goes_on.unwrap());
            let means = flow.complete(&mut to_wall).unwrap();
            assert_eq!(means.pressure, [7.0, 7.5]);
            assert!(means.velocity.iter().all(|v| (v - 0.1).abs() < 1e-15));
            assert!(means.power.iter().zip([0.7, 0.75]).all(|(a, b)| (a - b).abs() < 1e-15));
        }
        assert_eq!(flow.time(), 3.0);
        flow.close(&mut to_wall).unwrap();
        assert!(!wall.turn(&mut to_flow, |_, _| unreachable!("the run is over")).unwrap());
    }

    /// What a participant makes of a frame, in its first step.
    fn wall_sees(header: FrameHeader, payload: &[f64]) -> Result<bool, CouplerError> {
        let (mut to_wall, mut to_flow) = direct_pair([3; 32]);
        to_wall.send(header, |place| place.copy_from_slice(payload)).unwrap();
        WallParticipant::default().turn(&mut to_flow, |_, _| ())
    }

    fn trace(dt: f64, edges: [f64; 2]) -> (FrameHeader, Vec<f64>) {
        let header = FrameHeader {
            dt,
            fields: TraceRow::COUNT as u64,
            count: 2,
            ..FrameHeader::new(FrameKind::Trace)
        };
        (header, [edges.to_vec(), vec![2.0; 30]].concat())
    }

    #[test]
    fn a_wall_refuses_traces_that_make_no_sense() {
        let (header, payload) = trace(1.0, [1.0, 2.0]);
        assert_eq!(wall_sees(header, &payload), Ok(true));
        for dt in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let error = wall_sees(FrameHeader { dt, ..header }, &payload).expect_err("no step");
            assert!(matches!(error, CouplerError::BadStep { .. }), "{error}");
        }
        for time in [1.0, -1.0, f64::NAN] {
            for flags in [0, FrameHeader::LAST] {
                let error = wall_sees(FrameHeader { time, flags, ..header }, &payload).expect_err("no time");
                assert!(matches!(error, CouplerError::BadStep { .. }), "{error}");
            }
        }
        for edges in [[2.0, 1.0], [1.0, 1.0], [f64::NAN, 1.0], [1.0, f64::INFINITY]] {
            let (header, payload) = trace(1.0, edges);
            assert!(wall_sees(header, &payload).expect_err("no faces").is_refusal());
        }
        for (row, value) in [(TraceRow::Density, -1.0), (TraceRow::DensityRate, -3.0), (TraceRow::Gamma, 1.0)]
        {
            let mut payload = payload.clone();
            payload[2 * row as usize + 1] = value;
            let error = wall_sees(header, &payload).expect_err("no state");
            assert!(matches!(error, CouplerError::NoState { .. }), "{error}");
        }
        let nothing = FrameHeader { count: 0, ..header };
        assert!(matches!(wall_sees(nothing, &[]), Err(CouplerError::BadFaces { .. })));
    }

    #[test]
    fn a_flow_refuses_answers_to_other_steps_and_numbers_that_are_none() {
        let answered = |change: fn(&mut FrameHeader, &mut [f64])| {
            let (mut to_wall, mut to_flow) = direct_pair([3; 32]);
            WallParticipant::default().open(&mut to_flow).unwrap();
            let mut flow = FlowParticipant::open(&mut to_wall, vec![1.0]).unwrap();
            flow.begin(&mut to_wall, 0.5, |_| FlowTrace::load(1.0, 0.0)).unwrap();
            to_flow.receive(|_| ()).unwrap();
            let mut header = FrameHeader {
                dt: 0.5,
                dt_max: 1.0,
                fields: RegisterRow::COUNT as u64,
                count: 1,
                ..FrameHeader::new(FrameKind::Register)
            };
            let mut payload = [0.0; RegisterRow::COUNT];
            change(&mut header, &mut payload);
            to_flow.send(header, |place| place.copy_from_slice(&payload)).unwrap();
            flow.complete(&mut to_wall).map(|_| ())
        };
        assert_eq!(answered(|_, _| ()), Ok(()));
        let bad: [fn(&mut FrameHeader, &mut [f64]); 6] = [
            |header, _| header.time = 0.5,
            |header, _| header.dt = 0.25,
            |header, _| header.dt = f64::NAN,
            |header, _| header.dt_max = f64::NAN,
            |header, _| header.dt_max = -1.0,
            |_, payload| payload[1] = f64::INFINITY,
        ];
        for change in bad {
            assert!(answered(change).expect_err("must be refused").is_refusal());
        }
    }

    /// A load that falls through zero within a step is a state all the time.
    #[test]
    fn a_load_may_change_its_sign_within_a_step() {
        let FlowTrace { state, pressure_rate, .. } = FlowTrace::load(1e3, -1e14);
        let pressure = state.pressure + 1e-6 * pressure_rate;
        assert_eq!(pressure, 1e3 - 1e8);
        let fluid = FluidTrace { pressure, ..state };
        let solid = SolidTrace { pressure: 3e5, velocity: 2.0, impedance: 4e7 };
        for star in [exact_star(&fluid, &solid), acoustic_star(&fluid, &solid)] {
            assert!((star.pressure - pressure).abs() <= 1e-12 * pressure.abs(), "{star:?}");
        }
    }

    #[test]
    fn a_load_is_the_pressure_whatever_the_wall_does() {
        for pressure in [1e6, -2e7, 0.0, 5e9] {
            let fluid = FlowTrace::load(pressure, 0.0).state;
            let solid = SolidTrace { pressure: 3e5, velocity: 2.0, impedance: 4e7 };
            for star in [exact_star(&fluid, &solid), acoustic_star(&fluid, &solid)] {
                assert!((star.pressure - pressure).abs() <= 1e-12 * pressure.abs() + 1e-12, "{star:?}");
                assert!((star.velocity - (2.0 + (3e5 - pressure) / 4e7)).abs() < 1e-9, "{star:?}");
            }
        }
    }
}
