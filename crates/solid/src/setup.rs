//! What defines a solid.

use std::sync::Arc;

use mesh::{Adaptation, Domain, Entering, Entry, Limiter, Mesh, Side};

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
    /// The pressure that will press on its surface, Pa, if that is known before: adaptation has fine cells there when it comes.
    pub load: Option<Arc<dyn Entering>>,
}

impl SolidSetup {
    /// The level that each block should have for the load that is about to come, see [`Entry::demanded_levels`]; none where none is known.
    pub(crate) fn demanded_levels<const N: usize>(&self, mesh: &Mesh<N>, base: u8, time: f64) -> Vec<u8> {
        let (Some(entering), Some(adaptation)) = (self.load.as_deref(), &self.adaptation) else {
            return Vec::new();
        };
        let Some(side) =
            Side::ALL.into_iter().find(|side| self.boundaries[*side as usize] == Boundary::Interface)
        else {
            return Vec::new();
        };
        let (speed, scale, epsilon) = (self.speeds.c1, self.stress_scale, adaptation.epsilon);
        Entry { entering, side, speed, scale, time, epsilon, base }.demanded_levels(mesh)
    }
}
