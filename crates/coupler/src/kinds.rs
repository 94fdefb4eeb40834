//! Who takes part, what a frame is for, and why a participant gives up.

use std::fmt;

/// The two parts of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Participant {
    /// The liquid with its bubble.
    Fluid,
    /// The wall.
    Solid,
}

impl Participant {
    /// As in service names, logs and command lines.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fluid => "fluid",
            Self::Solid => "solid",
        }
    }

    /// The other part.
    pub fn peer(self) -> Self {
        match self {
            Self::Fluid => Self::Solid,
            Self::Solid => Self::Fluid,
        }
    }
}

impl fmt::Display for Participant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What a frame is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum FrameKind {
    /// First frame each way: version and case are compared.
    Hello = 1,
    /// From the side with the longer step: its state at the wall and the rates.
    Trace = 2,
    /// The answer: time means over that step of what the interface did.
    Register = 3,
    /// The sender cannot go on; `code` is a [`Fault`].
    Fault = 4,
    /// The sender leaves; links send it themselves.
    Goodbye = 5,
    /// The step that is planned is a long one for the receiver, which sends the trace.
    Yours = 6,
}

impl fmt::Display for FrameKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Hello => "hello",
            Self::Trace => "trace",
            Self::Register => "register",
            Self::Fault => "fault",
            Self::Goodbye => "goodbye",
            Self::Yours => "yours",
        })
    }
}

/// Why a participant gives up, as it tells its peer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u64)]
pub enum Fault {
    /// Non-physical state, collapsed time step.
    Numerical = 1,
    /// It was interrupted or terminated.
    Stopped = 2,
    /// Output or checkpoint could not be written.
    Output = 3,
    /// It got a frame it could not accept.
    Protocol = 4,
    /// Anything else.
    Other = 5,
}

impl Fault {
    /// From a frame's `code`; an unknown one is [`Fault::Other`].
    pub fn from_code(code: u64) -> Self {
        [Self::Numerical, Self::Stopped, Self::Output, Self::Protocol]
            .into_iter()
            .find(|fault| *fault as u64 == code)
            .unwrap_or(Self::Other)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Numerical => "its solution failed numerically",
            Self::Stopped => "it was stopped",
            Self::Output => "it could not write its output",
            Self::Protocol => "it could not accept a frame",
            Self::Other => "it failed",
        })
    }
}
