//! The interface between two solvers: frames, transports, coupling schemes. No PDE.
//!
//! - [`Frame`], [`Link`]: what crosses and how: [`ProcessLink`] between processes, [`DirectLink`] within one.
//! - [`WallParticipant`], [`FlowParticipant`]: either side, played by somebody else's solver.
//! - [`TraceRow`], [`RegisterRow`]: what the numbers in a frame mean.
//! - [`CommonRefinement`]: two non-matching sets of interface faces; [`Meeting`]: the interface during a long step of one
//!   side, which is several of the other.
//! - [`exact_star`], [`acoustic_star`]: the Riemann problem between the two media; [`fluid_at_moving_wall`] and its like:
//!   one half of it; [`KappaFactor`]: the paper's damping of the weak scheme; [`Aitken`]: the relaxation of the
//!   strong one.
//! - [`WaveCurve`], [`curve_root`]: shock and isentrope of a stiffened gas, of which the fluid's Riemann solver is made, too.

#![forbid(unsafe_code)]
#![cfg_attr(test, allow(clippy::unwrap_used))]

mod aitken;
mod content;
mod direct;
mod domain;
mod error;
mod exchange;
mod frame;
mod kinds;
mod latency;
mod link;
mod making;
mod mapping;
mod meeting;
mod notice;
mod one_sided;
mod options;
mod participant;
mod ports;
mod process;
mod silence;
mod star;
mod watch;
mod wave_curve;
mod weak;

pub use aitken::Aitken;
pub use content::StepLength;
pub use direct::{DirectLink, direct_pair};
pub use domain::Domain;
pub use error::CouplerError;
pub use exchange::{FaceTrace, RegisterRow, TraceRow, WallRegister};
pub use frame::{Expected, FRAME_VERSION, Frame, FrameHeader};
pub use kinds::{Fault, FrameKind, Participant};
pub use latency::Latencies;
pub use link::{Link, LinkCounters};
pub use making::clean_up_dead;
pub use mapping::{CommonRefinement, SubFace};
pub use meeting::{Meeting, ShortStep};
pub use notice::Notice;
pub use one_sided::{fluid_at_moving_wall, fluid_under_pressure, solid_moved, solid_under_pressure};
pub use options::{Kappa, Scheme, StarSolver};
pub use participant::{FlowParticipant, FlowTrace, FluidStep, WallMeans, WallParticipant};
pub use process::{Endpoint, Interrupt, ProcessLink, check_run_id};
pub use star::{FluidTrace, InterfaceStar, SolidTrace, acoustic_star, exact_star, star_density};
pub use wave_curve::{
    CurvePoint, CurveRoot, MAX_ITERATIONS, VACUUM_PRESSURE, WaveCurve, curve_root, ln_pressure_ratio,
};
pub use weak::KappaFactor;
