//! The choices a case makes by name.

/// How fluid and solid meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// The Riemann problem between the two media; the default.
    Riemann,
    /// The paper's alternating scheme, eqs. (36)–(37).
    Weak,
    /// No solid: z_min of the fluid is a rigid wall.
    Rigid,
    /// No fluid: a given pressure on z_max of the solid.
    Load,
    /// One medium alone; every side has a boundary of its own.
    None,
}

impl Scheme {
    /// Names as they stand in case files.
    pub const NAMES: [(&'static str, Self); 5] = [
        ("riemann", Self::Riemann),
        ("weak", Self::Weak),
        ("rigid", Self::Rigid),
        ("load", Self::Load),
        ("none", Self::None),
    ];
}

/// How the fluid's side of the interface Riemann problem is described.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StarSolver {
    /// The shock or isentrope of the stiffened gas.
    Exact,
    /// Its tangent, the acoustic impedance.
    Acoustic,
}

impl StarSolver {
    /// Names as they stand in case files.
    pub const NAMES: [(&'static str, Self); 2] = [("exact", Self::Exact), ("acoustic", Self::Acoustic)];
}

/// The paper's factors κ̂ of eqs. (42)–(43), for the weak scheme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kappa {
    /// κ = 1.
    Off,
    /// On the received value, as printed.
    Printed,
    /// On the jump across the interface.
    Jump,
}

impl Kappa {
    /// Names as they stand in case files.
    pub const NAMES: [(&'static str, Self); 3] =
        [("off", Self::Off), ("printed", Self::Printed), ("jump", Self::Jump)];
}
