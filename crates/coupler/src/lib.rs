//! The interface between two solvers: frames, transports, coupling schemes. No PDE.

#![forbid(unsafe_code)]
#![cfg_attr(test, allow(clippy::unwrap_used))]

mod direct;
mod domain;
mod error;
mod frame;
mod link;
mod options;
mod ports;
mod process;
mod watch;

pub use direct::{DirectLink, direct_pair};
pub use domain::{Domain, clean_up_dead};
pub use error::CouplerError;
pub use frame::{Expected, FRAME_VERSION, Fault, Frame, FrameHeader, FrameKind};
pub use link::{Link, LinkCounters, Participant};
pub use options::{Kappa, Scheme, StarSolver};
pub use process::{Endpoint, Interrupt, ProcessLink};
