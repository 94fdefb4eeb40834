//! `SolidSolver`: owns the mesh and the fields, and advances them.

use mesh::{
    Adaptation, Domain, Field, Horizon, LevelSteps, Limiter, Mesh, Patch, ScratchPool, Side, SideStates,
};

use serde::{Deserialize, Serialize};

use crate::absorbing::SideMemory;
use crate::analysis::Analysis;
use crate::block::{BlockReport, BlockScratch, StepContext, report_stresses};
use crate::boundary::{Boundaries, SurfaceState};
use crate::reflux::{QUANTITIES, Register};
use crate::rows::Elasticity;
use crate::state::component::COUNT;
use crate::steps::check;
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
    /// What bounds it, in the order of [`Side::ALL`].
    pub boundaries: [Boundary; 4],
    /// How the grid adapts; all cells are on the finest level without.
    pub adaptation: Option<Adaptation>,
    /// Reference value of stresses, by which adaptation measures details, Pa; velocities count with ρ̄c₁.
    pub stress_scale: f64,
}

/// What crossed the sides of the domain since the start, inwards, in the order of [`Side::ALL`].
///
/// Per radian in axial symmetry, per metre of depth in planar geometry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BoundaryLedger {
    /// Axial momentum (the impulse of the tractions), N s.
    pub momentum: [f64; 4],
    /// Energy (the work of the tractions), J.
    pub energy: [f64; 4],
}

/// The solid: state, time, and how to advance it.
///
/// `N` is the number of cells along a block's side.
pub struct SolidSolver<const N: usize> {
    pub(crate) mesh: Mesh<N>,
    pub(crate) setup: SolidSetup,
    pub(crate) elasticity: Elasticity,
    pub(crate) boundaries: Boundaries,
    pub(crate) sides: SideMemory,
    pub(crate) state: Field,
    pub(crate) next: Field,
    pub(crate) register: Register<N>,
    pub(crate) levels: LevelSteps<N, QUANTITIES>,
    /// Of each block's last finished step, and of the one it is in.
    pub(crate) reports: Vec<BlockReport>,
    pub(crate) pending: Vec<BlockReport>,
    pub(crate) analysis: Analysis,
    pub(crate) horizon: Horizon,
    pub(crate) patches: ScratchPool<Patch<N>>,
    pub(crate) scratch: ScratchPool<BlockScratch<N>>,
    pub(crate) surface: Vec<SurfaceState>,
    pub(crate) surface_first: Vec<usize>,
    /// Slots of the blocks along z_max, in order.
    pub(crate) surface_blocks: Vec<usize>,
    pub(crate) time: f64,
    pub(crate) steps: u64,
    pub(crate) cell_updates: u64,
    pub(crate) common_updates: u64,
    pub(crate) ledger: BoundaryLedger,
}

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
        let (mesh, state) = crate::adapt::initial_mesh(&setup, &analysis, &initial)?;
        let initial_states = SideStates::new(&mesh, |centre, _| initial(centre));
        let mut solver = Self {
            elasticity: Elasticity::new(setup.speeds),
            boundaries: Boundaries::new(kinds, initial_states),
            sides: SideMemory::new(&mesh, kinds),
            reports: vec![BlockReport::default(); mesh.blocks()],
            next: state.clone(),
            register: Register::new(mesh.blocks()),
            levels: LevelSteps::new(COUNT),
            pending: Vec::new(),
            state,
            analysis,
            horizon: Horizon::default(),
            patches: ScratchPool::new(|| Patch::zeros(COUNT)),
            scratch: ScratchPool::new(BlockScratch::new),
            surface: Vec::new(),
            surface_first: Vec::new(),
            surface_blocks: Vec::new(),
            time: 0.0,
            steps: 0,
            cell_updates: 0,
            common_updates: 0,
            ledger: BoundaryLedger::default(),
            setup,
            mesh,
        };
        solver.index_surface();
        for slot in 0..solver.mesh.blocks() {
            solver.measure(slot);
        }
        solver.pending.clone_from(&solver.reports);
        check(&solver.mesh, &solver.state, &solver.reports, 0.0, 1)?;
        Ok(solver)
    }

    /// Numbers the faces of the surface under the fluid.
    pub(crate) fn index_surface(&mut self) {
        self.surface_blocks = self.mesh.blocks_along(Side::ZMax);
        self.surface_first = vec![usize::MAX; self.mesh.blocks()];
        let mut faces = 0;
        if self.boundaries.kind(Side::ZMax) == Boundary::Interface {
            for slot in &self.surface_blocks {
                self.surface_first[*slot] = faces;
                faces += N;
            }
        }
        self.surface = vec![SurfaceState::default(); faces];
    }

    /// Keeps the state at a point up to date within steps, too, in which its level makes a longer one.
    pub fn watch(&mut self, point: [f64; 2]) {
        self.levels.watch(point);
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh<N> {
        &self.mesh
    }

    /// What it is made of.
    pub fn setup(&self) -> &SolidSetup {
        &self.setup
    }

    /// Time, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Steps made, of the finest level.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Cells advanced so far, step by step.
    pub fn cell_updates(&self) -> u64 {
        self.cell_updates
    }

    /// Cells that would have been advanced if all levels made the steps of the finest.
    pub fn common_updates(&self) -> u64 {
        self.common_updates
    }

    /// What crossed the domain's sides so far.
    pub fn ledger(&self) -> &BoundaryLedger {
        &self.ledger
    }

    /// v_z, v_r, σ_zz, σ_zr, σ_rr, σ_φφ of all blocks.
    pub fn state(&self) -> &Field {
        &self.state
    }

    /// What all blocks of a step of length `dt` share.
    pub(crate) fn context(&self, dt: f64) -> StepContext<'_, N> {
        StepContext {
            mesh: &self.mesh,
            elasticity: &self.elasticity,
            analysis: &self.analysis,
            limiter: self.setup.limiter,
            boundaries: &self.boundaries,
            old: &self.state,
            dt,
            surface: &self.surface,
            surface_first: &self.surface_first,
            sides: &self.sides,
            yield_squared: self.setup.yield_strength * self.setup.yield_strength,
        }
    }

    /// The largest von Mises stress in each block, Pa.
    pub(crate) fn mises_by_block(&self) -> impl Iterator<Item = f64> + '_ {
        self.reports.iter().map(|report| report.mises_squared.sqrt())
    }

    /// The volume in which the von Mises stress exceeds the yield strength, m³ (per radian).
    pub(crate) fn yielded(&self) -> f64 {
        self.reports.iter().map(|report| report.yielded).sum()
    }

    /// Stresses in a block of the initial state or one that is new; else they come with each step.
    pub(crate) fn measure(&mut self, slot: usize) {
        let mut report = self.reports[slot];
        report_stresses(&self.context(0.0), slot, self.state.block(slot), &mut report);
        self.reports[slot] = report;
    }
}
