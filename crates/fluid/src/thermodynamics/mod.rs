//! Equations of state, and mixtures of two of them.

pub(crate) mod eos;
pub(crate) mod mixture;
