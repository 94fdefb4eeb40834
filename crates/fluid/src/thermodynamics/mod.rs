//! Equations of state, and mixtures of two of them.

pub(crate) mod eos;
pub(crate) mod library;
pub(crate) mod mixture;
pub(crate) mod noble_abel;
pub(crate) mod temperature;
pub(crate) mod wave_curve;
