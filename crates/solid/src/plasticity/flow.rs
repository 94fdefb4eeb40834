//! What a hardening law says of a state.

/// Flow stress and its derivatives by the logarithms of what it depends on, all Pa.
///
/// Logarithmic ones, because ∂Y/∂ε_p of a power law is infinite at ε_p = 0, and ∂Y/∂ ln ε_p = 0 there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flow {
    /// Y.
    pub stress: f64,
    /// ∂Y/∂ ln ε_p.
    pub per_log_strain: f64,
    /// ∂Y/∂ ln ε̇.
    pub per_log_rate: f64,
    /// ∂Y/∂ ln(T − T_r).
    pub per_log_rise: f64,
}
