//! What the cells of a solid obey, and what bounds them.

use mesh::{Mesh, Neighbour, Step};

use crate::analysis::Analysis;
use crate::boundary::Boundaries;
use crate::boundary::absorbing::SideMemory;
use crate::components::Component;
use crate::components::following::Following;
use crate::components::untouched::Untouched;
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
    /// What only follows the cells; `None` where nothing can yield.
    pub(crate) following: Option<Following>,
    pub(crate) untouched: Untouched,
    pub(crate) terms: Terms,
    pub(crate) boundaries: Boundaries,
    pub(crate) sides: SideMemory,
    pub(crate) analysis: Analysis,
    pub(crate) ledger: BoundaryLedger,
    pub(crate) plastic: PlasticLedger,
    pub(crate) ways: Ways,
}

/// How blocks are stepped where there is a choice: the results are the same to the last bit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ways {
    /// Whether four siblings are, as one.
    pub has_tiles: bool,
    /// Whether what has only waves is, in one sweep.
    pub has_sweeps: bool,
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

    /// Whether cells of a block flowed in its last step.
    pub(crate) fn flows(&self, slot: usize) -> bool {
        self.following.as_ref().is_some_and(|following| !following.of_block(slot).rates.is_zero)
    }

    /// Whether neither a block nor a neighbour of it has yielded so far.
    pub(crate) fn is_untouched<const N: usize>(&self, mesh: &Mesh<N>, slot: usize) -> bool {
        let around = mesh.tree().neighbours(slot).iter().flat_map(Neighbour::slots);
        !self.untouched.has_yielded(slot)
            && around.into_iter().all(|other| !self.untouched.has_yielded(other))
    }
}
