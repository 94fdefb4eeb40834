//! What can go wrong in the solid.

/// An error of the solid solver.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolidError {
    /// The mesh cannot be made.
    #[error(transparent)]
    Mesh(#[from] mesh::MeshError),
    /// A number is no longer finite.
    #[error(
        "the solid is not finite at z = {z:.6e} m, r = {r:.6e} m, t = {time:.6e} s (step {step}); \
         try a smaller time.cfl or solid.limiter = \"minmod\""
    )]
    NotFinite {
        /// Position, m.
        z: f64,
        /// Position, m.
        r: f64,
        /// Time at the end of the step, s.
        time: f64,
        /// Number of the step.
        step: u64,
    },
}
