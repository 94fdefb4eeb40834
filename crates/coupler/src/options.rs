//! The choices a case makes by name.

use crate::kinds::Participant;

/// How fluid and solid meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// The Riemann problem between the two media; the default.
    Riemann,
    /// Cell values of the old time cross both ways, paper eqs. (31)–(32).
    Explicit,
    /// The paper's alternating scheme, eqs. (36)–(37).
    Weak,
    /// The same repeated until cell values of the new time agree, paper eqs. (34)–(35).
    Strong,
    /// [`Scheme::Riemann`] with another program on the other side of the interface, see [`crate::WallParticipant`].
    External,
    /// No solid: z_min of the fluid is a rigid wall.
    Rigid,
    /// No fluid: a given pressure on z_max of the solid.
    Load,
    /// One medium alone; every side has a boundary of its own.
    None,
}

impl Scheme {
    /// Names as they stand in case files.
    pub const NAMES: [(&'static str, Self); 8] = [
        ("riemann", Self::Riemann),
        ("explicit", Self::Explicit),
        ("weak", Self::Weak),
        ("strong", Self::Strong),
        ("external", Self::External),
        ("rigid", Self::Rigid),
        ("load", Self::Load),
        ("none", Self::None),
    ];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, named)| *named == self).map_or("", |(name, _)| name)
    }

    /// Whether a fluid and a solid meet in it, be one of them another program's.
    #[must_use]
    pub fn is_coupled(self) -> bool {
        matches!(self, Self::Riemann | Self::External) || self.exchanges_cells()
    }

    /// Whether it is one of the paper's, in which cell values cross the interface and both sides make the same steps.
    #[must_use]
    pub fn exchanges_cells(self) -> bool {
        matches!(self, Self::Explicit | Self::Weak | Self::Strong)
    }
}

impl Participant {
    /// Names as they stand in case files.
    pub const NAMES: [(&'static str, Self); 2] = [("fluid", Self::Fluid), ("solid", Self::Solid)];
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
