//! What the cells of a solid obey, and what bounds them.

use mesh::Step;

use crate::analysis::Analysis;
use crate::boundary::Boundaries;
use crate::boundary::absorbing::SideMemory;
use crate::components::Component;
use crate::plasticity::Plasticity;
use crate::step::rows::Elasticity;
use crate::terms::Terms;
use crate::{BoundaryLedger, PlasticLedger, SolidSetup};

/// An elastic or elastoplastic solid: what its cells obey, and what bounds them.
pub struct Solid {
    pub(crate) setup: SolidSetup,
    pub(crate) elasticity: Elasticity,
    /// How it yields; `None` where it is elastic.
    pub(crate) plasticity: Option<Plasticity>,
    /// What fields hold beyond velocity and stress.
    pub(crate) components: Vec<Component>,
    pub(crate) terms: Terms,
    pub(crate) boundaries: Boundaries,
    pub(crate) sides: SideMemory,
    pub(crate) analysis: Analysis,
    pub(crate) ledger: BoundaryLedger,
    pub(crate) plastic: PlasticLedger,
}

/// A step of the solid.
pub(crate) type SolidStep<'a, const N: usize> = Step<'a, Solid, N>;

impl Solid {
    /// Squared yield strength, Pa², beyond which a cell counts as one that yields.
    pub(crate) fn yield_squared(&self) -> f64 {
        // A cell returned onto the surface is there but for rounding.
        const ROUNDING: f64 = 1.0 + 1e-9;
        let strength = self.setup.yield_strength;
        let strength = if self.plasticity.is_some() { ROUNDING * strength } else { strength };
        strength * strength
    }
}
