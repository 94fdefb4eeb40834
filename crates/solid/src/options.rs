//! The choices a case makes by name.

mesh::named! {
    /// What bounds the solid on one side of its domain.
    pub enum Boundary {
        /// The axis r = 0 of an axisymmetric domain.
        Axis,
        /// Waves leave, oblique ones and those along the surface too: the incoming characteristics are what has left over the side,
        /// as it goes on beyond.
        Absorbing = "absorbing",
        /// Waves leave: the incoming characteristics are held at the initial state there.
        NonReflecting = "non-reflecting",
        /// No traction.
        Free = "free",
        /// No velocity.
        Fixed = "fixed",
        /// No normal velocity and no shear traction.
        Symmetry = "symmetry",
        /// The opposite side of the domain.
        Periodic = "periodic",
        /// The interface to the fluid.
        Interface,
    }
}

impl Boundary {
    /// Whether what is beyond it is the mirror image of what is within.
    #[must_use]
    pub fn is_mirror(self) -> bool {
        matches!(self, Self::Axis | Self::Symmetry)
    }

    /// Whether waves leave over it.
    #[must_use]
    pub fn is_open(self) -> bool {
        matches!(self, Self::Absorbing | Self::NonReflecting)
    }
}

mesh::named! {
    /// The stress that balances the fluid's ambient pressure p at t = 0.
    pub enum InitialStress {
        /// σ_zz = −p and nothing else, as the paper has it; the von Mises stress is |p| from the start.
        Uniaxial = "uniaxial",
        /// σ = −p I.
        Hydrostatic = "hydrostatic",
    }
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
