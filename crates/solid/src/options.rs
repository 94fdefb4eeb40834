//! The choices a case makes by name.

/// What bounds the solid on one side of its domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boundary {
    /// The axis r = 0 of an axisymmetric domain.
    Axis,
    /// Waves leave: the incoming characteristics are held at the initial state there.
    NonReflecting,
    /// Waves leave, oblique ones and those along the surface too: the incoming characteristics are what has left over the side,
    /// as it goes on beyond.
    Absorbing,
    /// No traction.
    Free,
    /// No velocity.
    Fixed,
    /// No normal velocity and no shear traction.
    Symmetry,
    /// The opposite side of the domain.
    Periodic,
    /// The interface to the fluid.
    Interface,
}

impl Boundary {
    /// Those a case file may name.
    pub const NAMES: [(&'static str, Self); 6] = [
        ("absorbing", Self::Absorbing),
        ("non-reflecting", Self::NonReflecting),
        ("free", Self::Free),
        ("fixed", Self::Fixed),
        ("symmetry", Self::Symmetry),
        ("periodic", Self::Periodic),
    ];

    /// Whether waves leave over it.
    #[must_use]
    pub fn is_open(self) -> bool {
        matches!(self, Self::Absorbing | Self::NonReflecting)
    }
}

/// The stress that balances the fluid's ambient pressure p at t = 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InitialStress {
    /// σ_zz = −p and nothing else, as the paper has it; the von Mises stress is |p| from the start.
    Uniaxial,
    /// σ = −p I.
    Hydrostatic,
}

impl InitialStress {
    /// Names as they stand in case files.
    pub const NAMES: [(&'static str, Self); 2] =
        [("uniaxial", Self::Uniaxial), ("hydrostatic", Self::Hydrostatic)];
}

/// A spherical P wave at rest: displacement u = ∇(Φ exp(−R²/a²)) about a centre on the axis, v = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PotentialPulse {
    /// Centre (z, r), m.
    pub centre: [f64; 2],
    /// Width a, m.
    pub width: f64,
    /// Amplitude Φ of the displacement potential, m².
    pub amplitude: f64,
}
