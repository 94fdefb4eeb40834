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
mod tests;
