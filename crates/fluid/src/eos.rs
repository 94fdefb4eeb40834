//! The stiffened-gas equation of state.

/// A stiffened gas: p = (γ − 1) ρe − γπ, paper eq. (6). With π = 0 it is the ideal gas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StiffenedGas {
    /// Adiabatic exponent γ > 1.
    pub gamma: f64,
    /// Stiffness π ≥ 0, Pa.
    pub pi: f64,
}
