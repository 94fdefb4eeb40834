//! `SolidSolver`: how a solid is made.

use std::sync::Mutex;

use mesh::{BLOCK, BlockId, BlockSolver, Field, Mesh, MeshError, SavedBlocks, SideStates, Tile};

use crate::analysis::Analysis;
use crate::boundary::Boundaries;
use crate::boundary::absorbing::SideMemory;
use crate::boundary::held::Held;
use crate::boundary::participant::BlockTraces;
use crate::components::following::Following;
use crate::components::untouched::Untouched;
use crate::components::{self, Component};
use crate::initial::InitialState;
use crate::model::SolidMemory;
use crate::physics::{Solid, Ways};
use crate::plasticity::Plasticity;
use crate::step::BlockScratch;
use crate::step::report::BlockReport;
use crate::step::rows::Elasticity;
use crate::terms::Terms;
use crate::{BoundaryLedger, ElasticState, PlasticLedger, SolidError, SolidSetup};

/// The solid: a [`BlockSolver`] of elastic and plastic waves, which says how it is advanced, adapted, kept and taken up again.
///
/// `N` is the number of cells along a block's side. What is shown on the interface is made in memory that is kept.
pub struct SolidSolver<const N: usize>(BlockSolver<Solid, N>, pub(crate) Mutex<Vec<BlockTraces<N>>>);

/// Of the steps that are expected while a new solid's grid is made.
const COURANT: f64 = 0.5;

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
        Self::under_load(setup, initial, |_| ElasticState::default())
    }

    /// The same under what presses on its surface from the start.
    ///
    /// - `at_rest`: what of `initial` is in equilibrium with that, besides what is uniform and the setup's weight: open sides hold it as it is
    ///   in each cell.
    /// - errors: as [`SolidSolver::new`].
    pub fn under_load(
        setup: SolidSetup,
        initial: impl Fn([f64; 2]) -> ElasticState + Sync,
        at_rest: impl Fn([f64; 2]) -> ElasticState + Sync,
    ) -> Result<Self, SolidError> {
        Self::filled(setup, &initial, &at_rest)
    }

    fn filled(
        setup: SolidSetup,
        initial: &InitialState<'_>,
        at_rest: &InitialState<'_>,
    ) -> Result<Self, SolidError> {
        let plasticity = plasticity(&setup);
        let components = components::of(plasticity.as_ref(), setup.speeds);
        let analysis = analysis(&setup, &components);
        let (mesh, state) = crate::initial::initial_mesh(&setup, &analysis, &components, initial)?;
        let beyond = Held::along_sides(&mesh, initial, &with_weight(&setup, at_rest));
        Self::with(setup, plasticity, (components, analysis), (mesh, state, None), beyond)
    }

    /// A solid at rest in the cells of an earlier one, with the stress, plastic strain, temperature and displacement that it had.
    ///
    /// - `leaves`, `cells`, `displacement`: of a solid of the same domain and coarsest cells, in their order, see
    ///   [`SolidSolver::displacements`]. A temperature that it has not is that of what never yielded. `change`: added to the stresses at
    ///   a cell's centre (z, r); its velocities are not looked at.
    /// - errors: [`SolidError::Mesh`] where the leaves are not those of such a domain, [`SolidError::NotFinite`].
    pub fn at_rest_with(
        setup: SolidSetup,
        leaves: Vec<BlockId>,
        cells: &Field,
        displacement: Option<Field>,
        change: impl Fn([f64; 2]) -> ElasticState + Sync,
    ) -> Result<Self, SolidError> {
        let plasticity = plasticity(&setup);
        let components = components::of(plasticity.as_ref(), setup.speeds);
        let analysis = analysis(&setup, &components);
        let (mesh, state) = crate::initial::earlier_cells(&setup, &components, leaves, cells, &change)?;
        let blocks = mesh.blocks();
        if displacement.as_ref().is_some_and(|moved| !moved.has_shape(blocks, N * N, 2)) {
            return Err(MeshError::NoTiling { blocks }.into());
        }
        let at = |point: [f64; 2]| {
            let (slot, i, j) = mesh.locate(point).expect("cells along the sides are in the domain");
            ElasticState::from_array(std::array::from_fn(|c| state.component(slot, c)[j * N + i]))
        };
        let beyond = Held::along_sides(&mesh, &at, &with_weight(&setup, &change));
        let mut solid =
            Self::with(setup, plasticity, (components, analysis), (mesh, state, displacement), beyond)?;
        solid.rise_for_the_load();
        Ok(solid)
    }

    /// Makes the grid of an earlier solid as fine as a load that begins at once needs it: a new solid's is made so.
    fn rise_for_the_load(&mut self) {
        for _ in 0..self.setup().levels {
            let Some(base) = self.finest_by_details() else { return };
            let demanded = self.setup().demanded_levels(self.mesh(), base, self.time());
            let dt = self.time_step_limit(COURANT);
            if !self.lacks_levels(&demanded) || !self.adapt(dt, 1) {
                return;
            }
        }
    }

    fn with(
        setup: SolidSetup,
        plasticity: Option<Plasticity>,
        (components, analysis): (Vec<Component>, Analysis),
        (mesh, state, displacement): (Mesh<N>, Field, Option<Field>),
        beyond: SideStates<Held>,
    ) -> Result<Self, SolidError> {
        let kinds = setup.boundaries;
        let adaptation = setup.adaptation.clone();
        let count = state.components();
        let displacement = displacement.unwrap_or_else(|| Field::zeros(mesh.blocks(), N * N, 2));
        let following = plasticity.as_ref().map(|_| Following::new(&displacement, N * N));
        let solid = Solid {
            elasticity: Elasticity::new(setup.speeds),
            plasticity,
            components,
            following,
            untouched: Untouched::default(),
            terms: Terms::of(&setup),
            boundaries: Boundaries::new(kinds, beyond),
            sides: SideMemory::new(&mesh, kinds),
            analysis,
            ledger: BoundaryLedger::default(),
            plastic: PlasticLedger::default(),
            ways: Ways { has_tiles: Tile::holds_four::<N>(), has_sweeps: N <= Tile::MOST_CELLS },
            setup,
        };
        let blocks = BlockSolver::new(solid, mesh, state, adaptation, || BlockScratch::new(count))?;
        Ok(Self(blocks, Mutex::default()))
    }

    /// What it is made of.
    pub fn setup(&self) -> &SolidSetup {
        &self.model().setup
    }

    /// What plastic flow did so far.
    pub fn plastic_ledger(&self) -> &PlasticLedger {
        &self.model().plastic
    }

    /// What crossed the domain's sides so far.
    pub fn ledger(&self) -> &BoundaryLedger {
        &self.model().ledger
    }
}

impl SolidSolver<BLOCK> {
    /// [`SolidSolver::under_load`], compiled here as [`mesh::CompiledSolver`] is.
    ///
    /// - errors: as there.
    pub fn compiled_under_load(
        setup: SolidSetup,
        initial: &InitialState<'_>,
        at_rest: &InitialState<'_>,
    ) -> Result<Self, SolidError> {
        Self::filled(setup, initial, at_rest)
    }

    /// [`SolidSolver::at_rest_with`], compiled here.
    ///
    /// - errors: as there.
    pub fn compiled_at_rest_with(
        setup: SolidSetup,
        leaves: Vec<BlockId>,
        cells: &Field,
        displacement: Option<Field>,
        change: &InitialState<'_>,
    ) -> Result<Self, SolidError> {
        Self::at_rest_with(setup, leaves, cells, displacement, change)
    }
}

/// Stresses and those of the setup's weight, if it has one.
fn with_weight(setup: &SolidSetup, stress: &InitialState<'_>) -> impl Fn([f64; 2]) -> ElasticState + Sync {
    let (weight, density) = (setup.weight, setup.speeds.density);
    move |point| {
        let mut state = stress(point);
        state.stress_zz += weight.map_or(0.0, |weight| weight.stress(density, point[0]));
        state
    }
}

fn plasticity(setup: &SolidSetup) -> Option<Plasticity> {
    setup.plasticity.clone().map(|law| Plasticity::new(law, setup.speeds))
}

fn analysis(setup: &SolidSetup, components: &[Component]) -> Analysis {
    Analysis {
        boundaries: setup.boundaries,
        stress_scale: setup.stress_scale,
        impedances: [setup.speeds.z1(), setup.speeds.z2()],
        direction: None,
        strain_modulus: components.iter().map(|component| component.as_stress).fold(0.0, f64::max),
    }
}

mesh::derefs!([const N: usize] SolidSolver<N> => BlockSolver<Solid, N>, 0);
mesh::compiled_solver!(SolidSolver<BLOCK>, Solid);
