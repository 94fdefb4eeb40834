//! What defines a solid.

use mesh::{Adaptation, Domain, Limiter};

use crate::plasticity::Hardening;
use crate::{Boundary, WaveSpeeds, Weight};

/// Everything that defines a solid.
#[derive(Clone, Debug)]
pub struct SolidSetup {
    /// Where it is.
    pub domain: Domain,
    /// Cells of the coarsest grid along z and r.
    pub coarsest: [usize; 2],
    /// Levels of refinement: the finest grid has `coarsest · 2^levels` cells.
    pub levels: u8,
    /// Density and wave speeds.
    pub speeds: WaveSpeeds,
    /// Yield strength Y₀, Pa; infinite if none is known.
    pub yield_strength: f64,
    /// How it yields and hardens; elastic without.
    pub plasticity: Option<Hardening>,
    /// The slope limiter.
    pub limiter: Limiter,
    /// What bounds it, in the order of [`mesh::Side::ALL`].
    pub boundaries: [Boundary; 4],
    /// How the grid adapts; all cells are on the finest level without.
    pub adaptation: Option<Adaptation>,
    /// Reference value of stresses, by which adaptation measures details, Pa; velocities count with ρ̄c₁.
    pub stress_scale: f64,
    /// Its own weight, if it counts.
    pub weight: Option<Weight>,
}
