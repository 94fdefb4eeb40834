//! The five-equation model: a true collapse of the gas in a smeared interface.
//!
//! The state of a cell is m_g = φρ_g and ρ = m_g + m_l with m_l = (1 − φ)ρ_l, the momentum, the energy and the gas fraction φ.
//! Pure cells, nearly all, are served by the kernels of the paper's mixture, to which the model then reduces; what is
//! here serves the mixed ones, found in `cells.rs` and taken in SIMD batches of eight (`windows.rs`): the closure that tells how they
//! are compressed (`closure.rs`), their face states (`reconstruction.rs`, `thinc.rs`), their fluxes (`mixed.rs`) and
//! their update (`update.rs`, `relaxation.rs`).

mod cells;
mod closure;
mod expansion;
mod face_states;
mod gas_block;
mod marks;
mod mixed;
mod phase_model;
mod reconstruction;
mod relaxation;
mod scratch;
mod thinc;
mod traces;
mod update;
mod windows;

pub(crate) use cells::{Cells, FaceState};
pub(crate) use closure::{Compression, is_compliant, is_mixed, phase_densities};
pub(crate) use face_states::FaceStates;
pub(crate) use gas_block::{Before, BlockGas, may_have_gas};
pub(crate) use phase_model::PhaseModel;
pub(crate) use reconstruction::face_states;
pub(crate) use relaxation::isentropic_fraction;
pub(crate) use scratch::GasScratch;
pub(crate) use update::{is_zero, missing_mass, remove_traces};
pub(crate) use windows::Window;
