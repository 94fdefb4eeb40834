//! Evaporation and condensation where the phases meet, and liquid that opens under tension.
//!
//! It acts on single cells at the end of a block's step: mass goes from one phase to the other at the cell's mass, momentum and energy,
//! reference energies counted. The field has one component more, the vapour's mass, which the gas's mass flux carries
//! (`components/carried.rs`). Before that gas slips past liquid to where it condenses (`terms/gas_slip.rs`). Equations and limits: `docs/theory/phase-change.md`.

mod equilibrium;
mod exchange;
mod holding;
mod laws;
mod rate;
mod root;
mod saturation;
mod surface;

pub(crate) use exchange::{BlockExchange, BlockPlace, Exchange};
pub(crate) use holding::{HELD, holds_both};
pub use laws::{EvaporationLaw, PhaseChange};
pub use saturation::Saturation;
pub(crate) use surface::{area_density, facing};
