//! `FluidSolver`: how a fluid is made.

use std::sync::Mutex;

use mesh::{BLOCK, BlockSolver, Domain, Mesh, SavedBlocks, Side, SideStates, Tile};

use crate::analysis::Analysis;
use crate::boundary::Boundaries;
use crate::boundary::far_field::FarFieldMemory;
use crate::boundary::inflow::IncomingWave;
use crate::boundary::participant::BlockTraces;
use crate::bubble::follow::Follower;
use crate::bubble::look::follow_bubble;
use crate::capillarity::level_mixed_cells;
use crate::diagnostics::bubbles::follow_sources;
use crate::initial::exact_share::with_exact_share;
use crate::initial::fill;
use crate::model::FluidMemory;
use crate::near_wall::expected::Expected;
use crate::phase_change::Exchange;
use crate::physics::{Fluid, Scheme, Tally};
use crate::setup::{AsksForFiner, InitialState};
use crate::state::COUNT;
use crate::state::Contents;
use crate::step::BlockScratch;
use crate::step::report::BlockReport;
use crate::terms::Terms;
use crate::two_phase::PhaseModel;
use crate::wall_heat::WallMemory;
use crate::{
    Boundary, BoundaryLedger, Fixups, FluidError, FluidSetup, InitialCondition, Mixture, PhaseLedger,
    Primitive, RayleighField, WallHeat, components,
};

/// The fluid: a [`BlockSolver`] of compressible two-phase flow, which says how it is advanced, adapted, kept and taken up again.
///
/// `N` is the number of cells along a block's side. What is shown on the interface is made in memory that is kept.
pub struct FluidSolver<const N: usize>(BlockSolver<Fluid, N>, pub(crate) Mutex<Vec<BlockTraces<N>>>);

/// What of a fluid changes in time.
pub type FluidState<'a, const N: usize> = SavedBlocks<'a, BlockReport<N>, FluidMemory>;

impl<const N: usize> FluidSolver<N> {
    /// A fluid filled with an initial condition. Scratch is made for the current rayon pool's threads.
    ///
    /// - errors: [`FluidError::Mesh`], [`FluidError::NoInflow`], [`FluidError::Rayleigh`],
    ///   [`FluidError::NonPhysical`].
    pub fn new(setup: &FluidSetup, initial: &InitialCondition) -> Result<Self, FluidError> {
        let mixture = setup.mixture();
        let (Domain { geometry, .. }, gravity) = (setup.domain, setup.gravity);
        let field = RayleighField::of(initial, gravity, &setup.domain, setup.boundaries)?;
        Self::with(
            setup,
            &|centre, widths| {
                let mut contents = fill::average(initial, field.as_ref(), geometry, &mixture, centre, widths);
                if setup.surface_tension.is_some() {
                    contents = with_exact_share(contents, initial, geometry, centre, widths);
                }
                fill::under_gravity(contents, gravity, centre)
            },
            &|low, high, widths| fill::asks_for_finer(initial, low, high, widths),
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
        if setup.conduction.is_some() && [setup.liquid, setup.gas].iter().any(|law| law.heat.is_none()) {
            return Err(FluidError::NoHeatCapacity);
        }
        let periodic = [Side::ZMin, Side::RMin].map(|side| kinds[side as usize] == Boundary::Periodic);
        let mixture = setup.mixture();
        let components = setup.field_components();
        let has_phases = setup.model.components() > COUNT;
        let carried = setup.model.components()..components;
        let carried_count = carried.len();
        let vapour = components::vapour_among(&components::of(setup)).map(|number| carried.start + number);
        let exchange =
            setup.phase_change.zip(vapour).and_then(|(asked, vapour)| Exchange::of(asked, &mixture, vapour));
        let scales = setup.scales;
        let analysis = Analysis { mixture, boundaries: kinds, scales, has_phases, carried, direction: None };
        let incoming = IncomingWave::of(setup, initial);
        let (mesh, mut state) = crate::initial::mesh::initial_mesh(
            setup,
            periodic,
            (&analysis, incoming.as_ref()),
            initial,
            asks_for_finer,
        )?;
        if let Some(tension) = setup.surface_tension {
            level_mixed_cells(&mesh, &mixture, kinds, (tension.coefficient, has_phases), &mut state);
        }
        // By way of the conserved variables, as the cells have it: rest then stays at rest to the last bit.
        let sides = SideStates::new(&mesh, |_, centre, widths| {
            let Contents { state, gas } = initial(centre, widths);
            (Primitive::from_conserved(state.to_conserved(gas, &mixture), gas, &mixture), gas / state.density)
        });
        let boundaries = Boundaries::new(kinds, sides, setup.inflow.clone(), setup.far_field.clone());
        let fluid = Fluid {
            far: FarFieldMemory {
                impulses: boundaries.initial_impulses(&mesh, &mixture),
                sources: boundaries.source_history(&setup.domain),
            },
            has_gas: Vec::new(),
            axis_blocks: Vec::new(),
            scheme: Scheme {
                limiter: setup.limiter,
                riemann: setup.riemann,
                phases: PhaseModel::of(setup.model, setup.sharpening),
            },
            boundaries,
            terms: Terms::of(setup),
            wall_heat: setup.conduction.map_or(WallHeat::Adiabatic, |conduction| conduction.wall),
            wall_memory: wall_memory(setup, &mesh),
            exchange: exchange.filter(|_| has_phases),
            carried: components::of(setup),
            analysis,
            near_wall: setup.near_wall,
            incoming,
            expected: Expected::default(),
            has_tiles: Tile::holds_four::<N>(),
            follower: setup.followed.clone().map(Follower::new),
            tally: Tally::default(),
            mixture,
        };
        let scratch = || BlockScratch::new(components, carried_count);
        let mut blocks = BlockSolver::new(fluid, mesh, state, setup.adaptation.clone(), scratch)?;
        follow_bubble(&mut blocks);
        follow_sources(&mut blocks);
        Ok(Self(blocks, Mutex::default()))
    }

    /// The equations of state.
    pub fn mixture(&self) -> &Mixture {
        &self.model().mixture
    }

    /// Corrections made so far.
    pub fn fixups(&self) -> Fixups {
        self.model().tally.all_fixups()
    }

    /// Whether its phases can change into each other.
    pub fn changes_phase(&self) -> bool {
        self.model().exchange.is_some()
    }

    /// What has changed phase so far.
    pub fn phase_ledger(&self) -> &PhaseLedger {
        &self.model().tally.phases
    }

    /// What crossed the domain's sides so far.
    pub fn ledger(&self) -> &BoundaryLedger {
        &self.model().tally.ledger
    }
}

impl FluidSolver<BLOCK> {
    /// [`FluidSolver::new`], compiled here as [`mesh::CompiledSolver`] is.
    ///
    /// - errors: as there.
    pub fn compiled(setup: &FluidSetup, initial: &InitialCondition) -> Result<Self, FluidError> {
        Self::new(setup, initial)
    }
}

/// The memory of the wall on z_min, if that conducts heat.
fn wall_memory<const N: usize>(setup: &FluidSetup, mesh: &Mesh<N>) -> Option<WallMemory> {
    let WallHeat::Conducting(wall) = setup.conduction?.wall else { return None };
    let is_wall = setup.boundaries[Side::ZMin as usize].is_wall();
    is_wall.then(|| WallMemory::new(wall, setup.coarsest[1] << mesh.tree().finest()))
}

mesh::derefs!([const N: usize] FluidSolver<N> => BlockSolver<Fluid, N>, 0);
mesh::compiled_solver!(FluidSolver<BLOCK>, Fluid);
