//! `FluidSolver`: how a fluid is made.

use std::ops::{Deref, DerefMut};

use mesh::{Adaptation, BlockSolver, Domain, Limiter, SavedBlocks, Side, SideStates};
use serde::{Deserialize, Serialize};

use crate::analysis::{Analysis, Scales};
use crate::boundary::{Boundaries, PressureHistory};
use crate::bubbles::follow_sources;
use crate::clips::Clips;
use crate::model::{Fluid, FluidMemory, Scheme, Tally};
use crate::options::TwoPhaseOptions;
use crate::report::BlockReport;
use crate::state::Contents;
use crate::state::conserved::COUNT;
use crate::step::BlockScratch;
use crate::{
    Boundary, FarField, FluidError, InitialCondition, Mixture, Model, Primitive, RayleighField,
    RiemannSolver, Sharpening, StiffenedGas,
};

/// Everything that defines a fluid.
#[derive(Clone, Debug)]
pub struct FluidSetup {
    /// Where it is.
    pub domain: Domain,
    /// Cells of the coarsest grid along z and r.
    pub coarsest: [usize; 2],
    /// Levels of refinement: the finest grid has `coarsest · 2^levels` cells.
    pub levels: u8,
    /// The liquid's equation of state.
    pub liquid: StiffenedGas,
    /// The gas's equation of state.
    pub gas: StiffenedGas,
    /// The two-phase model.
    pub model: Model,
    /// What keeps the interface sharp; without a say in the paper's mixture.
    pub sharpening: Sharpening,
    /// The Riemann solver at cell faces.
    pub riemann: RiemannSolver,
    /// The slope limiter.
    pub limiter: Limiter,
    /// What bounds it, in the order of [`Side::ALL`].
    pub boundaries: [Boundary; 4],
    /// What enters through sides of kind [`Boundary::Inflow`].
    pub inflow: Option<PressureHistory>,
    /// What sides of kind [`Boundary::FarField`] hold.
    pub far_field: Option<FarField>,
    /// How the grid adapts; all cells are on the finest level without.
    pub adaptation: Option<Adaptation>,
    /// What adaptation measures details by.
    pub scales: Scales,
}

/// What fills a cell (centre, widths) at t = 0.
pub(crate) type InitialState<'a> = dyn Fn([f64; 2], [f64; 2]) -> Contents + Sync + 'a;

/// Whether a block (low corner, high corner, widths of its cells) is too coarse for what is in it at t = 0.
pub(crate) type AsksForFiner<'a> = dyn Fn([f64; 2], [f64; 2], [f64; 2]) -> bool + Sync + 'a;

/// Corrections that were made where the scheme left the admissible states.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Fixups {
    /// Cell-steps at first order, because a reconstructed face state was not admissible.
    pub first_order: u64,
    /// Cell-steps of mixed cells done again at first order, because a phase would have been drained.
    pub redone: u64,
    /// Volume of those cells, summed over the steps, m³ (per radian in axial symmetry, m² in planar geometry).
    pub redone_volume: f64,
    /// Cell-steps lifted to the pressure floor.
    pub floored: u64,
    /// Volume of those cells, likewise.
    pub floored_volume: f64,
    /// Energy that the floor added, J (per radian in axial symmetry, per metre of depth in planar geometry).
    pub floor_energy: f64,
    /// Mass that the gas got from the liquid in cells where it had less than none, kg (likewise).
    pub gas_mass_added: f64,
    /// Mass that the liquid got from the gas, likewise.
    pub liquid_mass_added: f64,
    /// How often other bounds acted.
    pub clips: Clips,
}

/// What crossed the sides of the domain since the start, inwards, in the order of [`Side::ALL`].
///
/// Per radian in axial symmetry, per metre of depth in planar geometry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BoundaryLedger {
    /// Mass, kg.
    pub mass: [f64; 4],
    /// Axial momentum, N s: what flows in and the impulse of the pressure.
    pub momentum: [f64; 4],
    /// Energy, J.
    pub energy: [f64; 4],
    /// Impulse of p* on the wall to the solid, N s: what the solid got. The momentum through z_min has the ρ*v*² of the
    /// wall's motion besides.
    pub wall_impulse: f64,
    /// Work of p* on the wall to the solid, J: what the fluid got.
    pub wall_work: f64,
}

/// The fluid: a [`BlockSolver`] of compressible two-phase flow, which says how it is advanced, adapted, kept and taken up again.
///
/// `N` is the number of cells along a block's side.
pub struct FluidSolver<const N: usize>(BlockSolver<Fluid, N>);

/// What of a fluid changes in time.
pub type FluidState<'a, const N: usize> = SavedBlocks<'a, BlockReport<N>, FluidMemory>;

impl<const N: usize> FluidSolver<N> {
    /// A fluid filled with an initial condition. Scratch is made for the current rayon pool's threads.
    ///
    /// - errors: [`FluidError::Mesh`], [`FluidError::NoInflow`], [`FluidError::Rayleigh`],
    ///   [`FluidError::NonPhysical`].
    pub fn new(setup: &FluidSetup, initial: &InitialCondition) -> Result<Self, FluidError> {
        let mixture = Mixture::new(setup.liquid, setup.gas);
        let Domain { geometry, z: [z_min, _], .. } = setup.domain;
        let field = RayleighField::of(initial, geometry, z_min, setup.boundaries[Side::ZMin as usize])?;
        Self::with(
            setup,
            &|centre, widths| {
                crate::fill::average(initial, field.as_ref(), geometry, &mixture, centre, widths)
            },
            &|low, high, widths| crate::fill::asks_for_finer(initial, low, high, widths),
        )
    }

    /// A fluid filled point by point: `state` gives the primitive variables at a cell's centre (z, r), of one phase
    /// where phases have densities of their own.
    ///
    /// - errors: as [`FluidSolver::new`].
    pub fn from_fn(
        setup: &FluidSetup,
        state: impl Fn([f64; 2]) -> Primitive + Sync,
    ) -> Result<Self, FluidError> {
        Self::with(setup, &|centre, _| state(centre).into(), &|_, _, _| false)
    }

    fn with(
        setup: &FluidSetup,
        initial: &InitialState<'_>,
        asks_for_finer: &AsksForFiner<'_>,
    ) -> Result<Self, FluidError> {
        let kinds = setup.boundaries;
        if kinds.contains(&Boundary::Inflow) && setup.inflow.is_none() {
            return Err(FluidError::NoInflow);
        }
        if kinds.contains(&Boundary::FarField) && setup.far_field.is_none() {
            return Err(FluidError::NoFarField);
        }
        let periodic = [Side::ZMin, Side::RMin].map(|side| kinds[side as usize] == Boundary::Periodic);
        let mixture = Mixture::new(setup.liquid, setup.gas);
        let components = setup.model.components();
        let has_phases = components > COUNT;
        let analysis = Analysis { mixture, boundaries: kinds, scales: setup.scales, has_phases };
        let (mesh, state) =
            crate::initial_mesh::initial_mesh(setup, periodic, &analysis, initial, asks_for_finer)?;
        // By way of the conserved variables, as the cells have it: rest then stays at rest to the last bit.
        let sides = SideStates::new(&mesh, |centre, widths| {
            let Contents { state, gas } = initial(centre, widths);
            (Primitive::from_conserved(state.to_conserved(&mixture), &mixture), gas / state.density)
        });
        let boundaries = Boundaries::new(kinds, sides, setup.inflow.clone(), setup.far_field.clone());
        let fluid = Fluid {
            impulses: boundaries.initial_impulses(&mesh, &mixture),
            sources: boundaries.source_history(&setup.domain),
            has_gas: Vec::new(),
            axis_blocks: Vec::new(),
            scheme: Scheme {
                limiter: setup.limiter,
                riemann: setup.riemann,
                two_phase: TwoPhaseOptions::of(setup.model, setup.sharpening),
            },
            boundaries,
            analysis,
            tally: Tally::default(),
            mixture,
        };
        let scratch = || BlockScratch::new(components);
        let mut blocks = BlockSolver::new(fluid, mesh, state, setup.adaptation.clone(), scratch)?;
        follow_sources(&mut blocks);
        Ok(Self(blocks))
    }

    /// The equations of state.
    pub fn mixture(&self) -> &Mixture {
        &self.model().mixture
    }

    /// Corrections made so far.
    pub fn fixups(&self) -> Fixups {
        self.model().tally.fixups()
    }

    /// What crossed the domain's sides so far.
    pub fn ledger(&self) -> &BoundaryLedger {
        &self.model().tally.ledger
    }
}

impl<const N: usize> Deref for FluidSolver<N> {
    type Target = BlockSolver<Fluid, N>;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl<const N: usize> DerefMut for FluidSolver<N> {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.0
    }
}
