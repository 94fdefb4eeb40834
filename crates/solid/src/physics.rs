//! What the cells of a solid obey, and what bounds them.

use mesh::Step;

use crate::analysis::Analysis;
use crate::boundary::Boundaries;
use crate::boundary::absorbing::SideMemory;
use crate::step::rows::Elasticity;
use crate::{BoundaryLedger, SolidSetup};

/// An elastic solid: what its cells obey, and what bounds them.
pub struct Solid {
    pub(crate) setup: SolidSetup,
    pub(crate) elasticity: Elasticity,
    pub(crate) boundaries: Boundaries,
    pub(crate) sides: SideMemory,
    pub(crate) analysis: Analysis,
    pub(crate) ledger: BoundaryLedger,
}

/// A step of the solid.
pub(crate) type SolidStep<'a, const N: usize> = Step<'a, Solid, N>;

impl Solid {
    /// Squared yield strength, Pa².
    pub(crate) fn yield_squared(&self) -> f64 {
        self.setup.yield_strength * self.setup.yield_strength
    }
}
