//! What a fluid is asked for about its change of phase.

/// Evaporation and condensation of a fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhaseChange {
    /// How fast the phases come to equilibrium.
    pub law: EvaporationLaw,
    /// The part of the gas's mass that is vapour at t = 0, from 0 to 1; the rest never condenses.
    pub vapour_fraction: f64,
    /// The pressure below which liquid opens, Pa; it never does without.
    pub cavitation: Option<f64>,
}

/// How fast the phases of a cell come to equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EvaporationLaw {
    /// At the rate of the kinetic theory of gases, Hertz (1882) and Knudsen (1915).
    HertzKnudsen {
        /// The part α of the molecules that stick, in (0, 1].
        accommodation: f64,
    },
    /// At once: one pressure, one temperature, one Gibbs energy.
    Equilibrium,
}
