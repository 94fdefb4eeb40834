//! Shock and isentrope of a stiffened gas, and the root of a sum of such curves.
//!
//! The interface's Riemann problem stands on the same curves, so that they are the coupler's: this is where they come in.

pub(crate) use coupler::{CurvePoint, VACUUM_PRESSURE, WaveCurve, curve_root, ln_pressure_ratio};

#[cfg(test)]
pub(crate) use coupler::MAX_ITERATIONS;
