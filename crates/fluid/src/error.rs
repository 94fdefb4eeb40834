//! What can go wrong in the fluid.

/// An error of the fluid solver.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FluidError {
    /// The mesh cannot be made.
    #[error(transparent)]
    Mesh(#[from] mesh::MeshError),
    /// A side is an inflow, but there is no pressure history.
    #[error("a side of the fluid is an inflow, but there is no pressure history for it")]
    NoInflow,
    /// A side is that of a far field, but there is none.
    #[error("a side of the fluid is to have a far field, but there is none for it")]
    NoFarField,
    /// Heat is to be conducted, but there are no temperatures.
    #[error("heat is to be conducted, but a phase of the fluid has no heat capacity, and so no temperature")]
    NoHeatCapacity,
    /// The liquid's pressure cannot be the harmonic one.
    #[error("the initial pressure cannot be Rayleigh's: {0}")]
    Rayleigh(#[from] crate::RayleighError),
    /// An interface with tension has come to a wall, and nothing is said of its angle there.
    #[error(
        "the interface is at the wall at z = {z:.6e} m, r = {r:.6e} m, t = {time:.6e} s, and with surface tension its angle there \
         must be known; give fluid.terms.contact_angle = 90, or leave fluid.terms.surface_tension out"
    )]
    Contact {
        /// Position, m.
        z: f64,
        /// Position, m.
        r: f64,
        /// Time at the end of the step, s.
        time: f64,
    },
    /// A cell left the range in which the equations make sense.
    #[error(
        "the fluid is not physical at z = {z:.6e} m, r = {r:.6e} m, t = {time:.6e} s (step {step}): \
         density {density:.4e} kg/m3, energy {energy:.4e} J/m3, gas fraction {phi:.4e}; \
         try a smaller time.cfl or fluid.limiter = \"minmod\""
    )]
    NonPhysical {
        /// Position, m.
        z: f64,
        /// Position, m.
        r: f64,
        /// Time at the end of the step, s.
        time: f64,
        /// Number of the step.
        step: u64,
        /// Density, kg/m³.
        density: f64,
        /// Total energy per volume, J/m³.
        energy: f64,
        /// Gas fraction.
        phi: f64,
    },
}
