//! Slope limiters of the linear reconstruction.

/// How the slope in a cell is made from the differences to its two neighbours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limiter {
    /// Monotonised central (van Leer 1977): second order, total-variation diminishing; the default.
    Mc,
    /// The smaller difference, zero where the signs differ.
    Minmod,
    /// The smaller difference in absolute value whatever the signs: the paper's printed rule, not TVD.
    Eno,
    /// The central difference, unlimited: for smooth solutions and orders of convergence.
    None,
}

impl Limiter {
    /// Names as they stand in case files.
    pub const NAMES: [(&'static str, Self); 4] =
        [("mc", Self::Mc), ("minmod", Self::Minmod), ("eno", Self::Eno), ("none", Self::None)];
}
