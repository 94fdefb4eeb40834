//! Compressible two-phase flow: equations of state, Riemann solvers, `FluidSolver`.

mod eos;
pub mod exact_riemann;
mod initial;
mod options;

pub use eos::StiffenedGas;
pub use initial::{InitialCondition, Phase, PhaseState, Pulse, PulseShape, Region, Shape};
pub use options::{Boundary, Model, RiemannSolver};
