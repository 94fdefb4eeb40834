//! Compressible two-phase flow: equations of state, Riemann solvers, [`FluidSolver`].
//!
//! The algorithm of a step reads in one place, `step/mod.rs`, stage by stage.

#![forbid(unsafe_code)]

mod analysis;
mod boundary;
mod bubble_cuts;
mod bubbles;
mod clips;
mod diagnostics;
mod dispersion;
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
mod ledger;
mod mixture;
mod model;
mod options;
mod outer_states;
mod participant;
mod physics;
mod predictor;
mod rayleigh;
mod reconstruction;
mod reflux;
mod report;
mod rows;
mod setup;
mod solver;
mod state;
mod step;
mod update;
mod wall_trace;

pub use analysis::Scales;
pub use boundary::PressureHistory;
pub use bubble_cuts::{BubbleCuts, TRACE_GAS};
pub use clips::Clips;
pub use diagnostics::{AxisState, Bubble, CELL_FIELDS, Snapshot, Totals, WallPressures};
pub use eos::StiffenedGas;
pub use error::FluidError;
pub use far_field::{FarField, FarFieldError};
pub use hllc::{Face, flux_hllc};
pub use initial::{InitialCondition, InitialPressure, Phase, PhaseState, Pulse, PulseShape, Region, Shape};
pub use ledger::{BoundaryLedger, Fixups};
pub use mixture::Mixture;
pub use options::{Boundary, Model, RiemannSolver, Sharpening};
pub use physics::Fluid;
pub use rayleigh::{RayleighError, RayleighField};
pub use setup::FluidSetup;
pub use solver::{FluidSolver, FluidState};
pub use state::Primitive;
