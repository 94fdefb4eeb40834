//! The choices a case makes by name.

use mesh::Limiter;

mesh::named! {
    /// The two-phase model.
    pub enum Model {
        /// Partial densities, one velocity and one pressure, and a gas fraction that feels compression: five equations in
        /// one dimension (Kapila et al. 2001). The default.
        FiveEquation = "five-equation",
        /// The same without the K term: the gas fraction is only advected (Allaire, Clerc & Kokh 2002). For study.
        Allaire = "allaire",
        /// One density, advected gas fraction, linear β₁ and β₂: the paper's mixture (Saurel & Abgrall 1999).
        SaurelAbgrall = "saurel-abgrall",
    }
}

impl Model {
    /// Numbers in a cell: ρ, ρv_z, ρv_r, ρE, φ, and the gas's mass m_g where phases have densities of their own.
    pub fn components(self) -> usize {
        if self == Self::SaurelAbgrall { 5 } else { 6 }
    }
}

mesh::named! {
    /// What keeps the interface between gas and liquid sharp.
    pub enum Sharpening {
        /// The gas fraction on a mixed cell's faces is that of a step (THINC; Shyue & Xiao 2014).
        Thinc = "thinc",
        /// The limited linear reconstruction serves it, too.
        None = "none",
    }
}

/// What the five-equation model does in mixed cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TwoPhaseOptions {
    /// Whether the phases are compressed by their own stiffness (the K term).
    pub has_closure: bool,
    /// Whether THINC makes the gas fraction on faces.
    pub is_sharp: bool,
}

impl TwoPhaseOptions {
    /// The limiter of the gas fraction's slopes where there is no step, beside `limiter` for all else.
    ///
    /// A sharp interface is THINC's business, whatever serves the waves: what `minmod` adds in the cells next to a step are
    /// traces of gas that the interface leaves behind, a third more mixed cells.
    pub fn fraction_limiter(self, limiter: Limiter) -> Limiter {
        if self.is_sharp && limiter == Limiter::Minmod { Limiter::Mc } else { limiter }
    }
}

mesh::named! {
    /// The Riemann solver at cell faces.
    pub enum RiemannSolver {
        /// Harten–Lax–van Leer with contact (Toro, Spruce & Speares 1994).
        Hllc = "hllc",
        /// The same with less damping where flow is slow against sound, see [`crate::flux_hllc_low_mach`].
        HllcLowMach = "hllc-lm",
        /// The exact solver for two stiffened gases.
        Exact = "exact",
    }
}

mesh::named! {
    /// What bounds the fluid on one side of its domain.
    pub enum Boundary {
        /// The axis r = 0 of an axisymmetric domain.
        Axis,
        /// A rigid wall, frictionless in fluids without viscosity; those with it stick to it.
        Wall = "wall",
        /// A plane of symmetry, which is a wall that fluids slip along.
        Symmetry = "symmetry",
        /// Waves leave: the incoming characteristic is held at the initial state there.
        NonReflecting = "non-reflecting",
        /// Waves leave, and liquid flows to the bubbles and back as in unbounded liquid, see [`crate::FarField`].
        FarField = "far-field",
        /// A pressure history enters as a plane wave.
        Inflow = "inflow",
        /// The opposite side of the domain.
        Periodic = "periodic",
        /// The interface to the solid.
        Interface,
    }
}

impl Boundary {
    /// Whether fluid passes: the side holds a state outside.
    pub fn is_open(self) -> bool {
        matches!(self, Self::NonReflecting | Self::FarField | Self::Inflow)
    }

    /// Whether what is beyond it is the mirror image of what is within.
    pub fn is_mirror(self) -> bool {
        matches!(self, Self::Axis | Self::Wall | Self::Symmetry)
    }

    /// Whether it stops the fluid: a rigid wall, or the solid.
    pub fn is_wall(self) -> bool {
        matches!(self, Self::Wall | Self::Interface)
    }
}
