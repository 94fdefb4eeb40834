//! Compressible two-phase flow: equations of state, Riemann solvers, [`FluidSolver`].
//!
//! The algorithm of a step reads in one place, `step/mod.rs`, stage by stage.

#![forbid(unsafe_code)]

mod analysis;
mod boundary;
mod bubbles;
mod clips;
mod curvature;
mod diagnostics;
mod elementary;
mod eos;
mod error;
mod even;
pub mod exact_riemann;
mod exact_rows;
mod face_rows;
mod far_field;
mod fill;
mod five_equation;
mod godunov;
mod hllc;
mod initial;
mod initial_mesh;
mod mixture;
mod model;
mod options;
mod participant;
mod predictor;
mod rayleigh;
mod reflux;
mod report;
mod rows;
mod solver;
mod state;
mod step;
mod update;
mod wall_trace;

pub use analysis::Scales;
pub use boundary::PressureHistory;
pub use bubbles::{BubbleCuts, TRACE_GAS};
pub use clips::Clips;
pub use diagnostics::{AxisState, Bubble, CELL_FIELDS, Snapshot, Totals, WallPressures};
pub use eos::StiffenedGas;
pub use error::FluidError;
pub use far_field::{FarField, FarFieldError};
pub use hllc::{Face, flux_hllc};
pub use initial::{InitialCondition, InitialPressure, Phase, PhaseState, Pulse, PulseShape, Region, Shape};
pub use mixture::Mixture;
pub use model::Fluid;
pub use options::{Boundary, Model, RiemannSolver, Sharpening};
pub use rayleigh::{RayleighError, RayleighField};
pub use solver::{BoundaryLedger, Fixups, FluidSetup, FluidSolver, FluidState};
pub use state::Primitive;
