//! The choices a case makes by name.

/// The two-phase model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// One density, advected gas fraction, linear β₁ and β₂: the paper's mixture (Saurel & Abgrall 1999).
    SaurelAbgrall,
}

impl Model {
    /// Names as they stand in case files.
    pub const NAMES: [(&'static str, Self); 1] = [("saurel-abgrall", Self::SaurelAbgrall)];
}

/// The Riemann solver at cell faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RiemannSolver {
    /// Harten–Lax–van Leer with contact (Toro, Spruce & Speares 1994).
    Hllc,
    /// The exact solver for two stiffened gases.
    Exact,
}

impl RiemannSolver {
    /// Names as they stand in case files.
    pub const NAMES: [(&'static str, Self); 2] = [("hllc", Self::Hllc), ("exact", Self::Exact)];
}

/// What bounds the fluid on one side of its domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boundary {
    /// The axis r = 0 of an axisymmetric domain.
    Axis,
    /// A rigid, frictionless wall.
    Wall,
    /// Waves leave: the incoming characteristic is held at the initial state there.
    NonReflecting,
    /// A pressure history enters as a plane wave.
    Inflow,
    /// The opposite side of the domain.
    Periodic,
    /// The interface to the solid.
    Interface,
}

impl Boundary {
    /// Those a case file may name.
    pub const NAMES: [(&'static str, Self); 4] = [
        ("wall", Self::Wall),
        ("non-reflecting", Self::NonReflecting),
        ("inflow", Self::Inflow),
        ("periodic", Self::Periodic),
    ];
}
