//! `SolidSolver`: how a solid is made.

use std::ops::{Deref, DerefMut};

use mesh::{Adaptation, BlockSolver, Domain, Limiter, SavedBlocks, SideStates};
use serde::{Deserialize, Serialize};

use crate::absorbing::SideMemory;
use crate::analysis::Analysis;
use crate::boundary::Boundaries;
use crate::model::{Solid, SolidMemory};
use crate::report::BlockReport;
use crate::rows::Elasticity;
use crate::step::BlockScratch;
use crate::{Boundary, ElasticState, SolidError, WaveSpeeds};

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
    /// The slope limiter.
    pub limiter: Limiter,
    /// What bounds it, in the order of [`mesh::Side::ALL`].
    pub boundaries: [Boundary; 4],
    /// How the grid adapts; all cells are on the finest level without.
    pub adaptation: Option<Adaptation>,
    /// Reference value of stresses, by which adaptation measures details, Pa; velocities count with ρ̄c₁.
    pub stress_scale: f64,
}

/// What crossed the sides of the domain since the start, inwards, in the order of [`mesh::Side::ALL`].
///
/// Per radian in axial symmetry, per metre of depth in planar geometry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BoundaryLedger {
    /// Axial momentum (the impulse of the tractions), N s.
    pub momentum: [f64; 4],
    /// Energy (the work of the tractions), J.
    pub energy: [f64; 4],
}

/// The solid: a [`BlockSolver`] of elastic waves, which says how it is advanced, adapted, kept and taken up again.
///
/// `N` is the number of cells along a block's side.
pub struct SolidSolver<const N: usize>(BlockSolver<Solid, N>);

/// What of a solid changes in time.
pub type SolidState<'a> = SavedBlocks<'a, BlockReport, SolidMemory>;

impl<const N: usize> SolidSolver<N> {
    /// A solid filled point by point: `initial` gives the state at a cell's centre (z, r). Scratch is made for
    /// the current rayon pool's threads.
    ///
    /// - errors: [`SolidError::Mesh`], [`SolidError::NotFinite`].
    pub fn new(
        setup: SolidSetup,
        initial: impl Fn([f64; 2]) -> ElasticState + Sync,
    ) -> Result<Self, SolidError> {
        let kinds = setup.boundaries;
        let analysis =
            Analysis { boundaries: kinds, stress_scale: setup.stress_scale, impedance: setup.speeds.z1() };
        let (mesh, state) = crate::initial::initial_mesh(&setup, &analysis, &initial)?;
        let initial_states = SideStates::new(&mesh, |centre, _| initial(centre));
        let adaptation = setup.adaptation.clone();
        let solid = Solid {
            elasticity: Elasticity::new(setup.speeds),
            boundaries: Boundaries::new(kinds, initial_states),
            sides: SideMemory::new(&mesh, kinds),
            analysis,
            ledger: BoundaryLedger::default(),
            setup,
        };
        Ok(Self(BlockSolver::new(solid, mesh, state, adaptation, BlockScratch::new)?))
    }

    /// What it is made of.
    pub fn setup(&self) -> &SolidSetup {
        &self.model().setup
    }

    /// What crossed the domain's sides so far.
    pub fn ledger(&self) -> &BoundaryLedger {
        &self.model().ledger
    }
}

impl<const N: usize> Deref for SolidSolver<N> {
    type Target = BlockSolver<Solid, N>;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl<const N: usize> DerefMut for SolidSolver<N> {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.0
    }
}
