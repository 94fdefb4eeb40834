//! Compressible two-phase flow: equations of state, Riemann solvers, [`FluidSolver`].
//!
//! The algorithm of a step reads in one place, `step/mod.rs`, stage by stage.

#![forbid(unsafe_code)]

mod analysis;
mod boundary;
mod bubble;
mod capillarity;
mod components;
mod diagnostics;
mod error;
mod initial;
mod model;
mod near_wall;
mod options;
mod phase_change;
mod physics;
mod reconstruction;
mod riemann;
mod setup;
mod solver;
mod state;
mod step;
mod terms;
mod thermodynamics;
mod two_phase;
mod wall_heat;

pub use analysis::Scales;
pub use boundary::far_field::{FarField, FarFieldError};
pub use boundary::history::PressureHistory;
pub use bubble::content::{BubbleContent, GasState};
pub use bubble::rule::{BubbleReset, FollowedBubble, ResetReport};
pub use diagnostics::bubble_cuts::{BubbleCuts, TRACE_GAS};
pub use diagnostics::ledger::{BoundaryLedger, Fixups, PhaseLedger};
pub use diagnostics::{AxisState, Bubble, CELL_FIELDS, Snapshot, Totals, WallPressures};
pub use error::FluidError;
pub use initial::rayleigh::{Beneath, HarmonicBeneath, RayleighError, RayleighField};
pub use initial::{InitialCondition, InitialPressure, Phase, PhaseState, Pulse, PulseShape, Region, Shape};
pub use near_wall::NearWall;
pub use near_wall::film::Film;
pub use options::{Boundary, Model, RiemannSolver, Sharpening};
pub use phase_change::{EvaporationLaw, PhaseChange, Saturation};
pub use physics::Fluid;
pub use riemann::exact_riemann;
pub use riemann::hllc::{Face, flux_hllc, flux_hllc_low_mach};
pub use setup::FluidSetup;
pub use solver::{FluidSolver, FluidState};
pub use state::Primitive;
pub use step::clips::Clips;
pub use terms::conduction::Conduction;
pub use terms::diffusion::ThinGas;
pub use terms::gravity::Gravity;
pub use terms::surface_tension::SurfaceTension;
pub use terms::viscosity::{PhaseViscosity, Viscosity};
pub use thermodynamics::eos::StiffenedGas;
pub use thermodynamics::library::NamedFluid;
pub use thermodynamics::mixture::Mixture;
pub use thermodynamics::noble_abel::{Heat, NobleAbelStiffenedGas};
pub use wall_heat::{ConductingWall, WallHeat};
