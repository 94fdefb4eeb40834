//! `SolidSolver`: owns the mesh and the fields, and advances them.

use mesh::{
    Adaptation, Domain, Field, Horizon, Limiter, Mesh, Patch, ScratchPool, Side, SideStates, for_each_block,
    for_some_blocks,
};

use crate::analysis::Analysis;
use crate::block::{BlockReport, BlockScratch, StepContext, report_stresses, step_block};
use crate::boundary::{Boundaries, SurfaceState};
use crate::reflux::{self, Register};
use crate::rows::Elasticity;
use crate::state::component::COUNT;
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
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
    pub(crate) state: Field,
    pub(crate) next: Field,
    pub(crate) register: Register<N>,
    pub(crate) reports: Vec<BlockReport>,
    pub(crate) analysis: Analysis,
    pub(crate) horizon: Horizon,
    pub(crate) patches: ScratchPool<Patch<N>>,
    pub(crate) scratch: ScratchPool<BlockScratch<N>>,
    pub(crate) surface: Vec<SurfaceState>,
    pub(crate) surface_first: Vec<usize>,
    /// Slots of the blocks along z_max, in order.
    pub(crate) surface_blocks: Vec<usize>,
    pub(crate) time: f64,
    steps: u64,
    cell_updates: u64,
    ledger: BoundaryLedger,
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
        let sides = SideStates::new(&mesh, |centre, _| initial(centre));
        let mut solver = Self {
            elasticity: Elasticity::new(setup.speeds),
            boundaries: Boundaries::new(kinds, sides),
            reports: vec![BlockReport::default(); mesh.blocks()],
            next: state.clone(),
            register: Register::new(mesh.blocks()),
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
            ledger: BoundaryLedger::default(),
            setup,
            mesh,
        };
        solver.index_surface();
        for slot in 0..solver.mesh.blocks() {
            solver.measure(slot);
        }
        solver.check(0.0)?;
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

    /// Steps made.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Cells advanced so far, step by step.
    pub fn cell_updates(&self) -> u64 {
        self.cell_updates
    }

    /// What crossed the domain's sides so far.
    pub fn ledger(&self) -> &BoundaryLedger {
        &self.ledger
    }

    /// v_z, v_r, σ_zz, σ_zr, σ_rr, σ_φφ of all blocks.
    pub fn state(&self) -> &Field {
        &self.state
    }

    /// The largest step that the Courant number allows, s: cfl · min(h)/c₁.
    pub fn time_step_limit(&self, cfl: f64) -> f64 {
        self.mesh.tree().leaves().iter().fold(f64::INFINITY, |limit, id| {
            let [h_z, h_r] = self.mesh.widths(id.level);
            limit.min(cfl * h_z.min(h_r) / self.setup.speeds.c1)
        })
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
            yield_squared: self.setup.yield_strength * self.setup.yield_strength,
        }
    }

    /// Advances by `dt`. Under a fluid the surface's state must have been set, see
    /// [`SolidSolver::set_surface`].
    ///
    /// - errors: [`SolidError::NotFinite`]; the state before the step is then kept.
    pub fn step(&mut self, dt: f64) -> Result<(), SolidError> {
        let mut next = std::mem::replace(&mut self.next, Field::zeros(0, 0, 0));
        let mut reports = std::mem::take(&mut self.reports);
        let mut register = std::mem::replace(&mut self.register, Register::new(0));
        let context = self.context(dt);
        for_each_block(&mut next, register.values_mut(), &mut reports, |slot, new, stars, report| {
            *report = self.scratch.with(|scratch| step_block(&context, slot, new, stars, scratch));
        });
        let is_due = |slot: usize| Register::is_due(&self.mesh, slot);
        for_some_blocks(&mut next, &mut reports, is_due, |slot, new, report| {
            reflux::correct(&context, &register, slot, new, report);
        });
        (self.next, self.reports, self.register) = (next, reports, register);
        std::mem::swap(&mut self.state, &mut self.next);
        if let Err(error) = self.check(self.time + dt) {
            std::mem::swap(&mut self.state, &mut self.next);
            return Err(error);
        }
        // In the order of the slots, so that sums do not depend on threads.
        for report in &self.reports {
            for (side, [momentum, energy]) in report.inflow.into_iter().enumerate() {
                self.ledger.momentum[side] += momentum;
                self.ledger.energy[side] += energy;
            }
        }
        self.time += dt;
        self.steps += 1;
        self.cell_updates += self.mesh.cells() as u64;
        Ok(())
    }

    /// The largest von Mises stress in each block, Pa.
    pub(crate) fn mises_by_block(&self) -> impl Iterator<Item = f64> + '_ {
        self.reports.iter().map(|report| report.mises_squared.sqrt())
    }

    /// The volume in which the von Mises stress exceeds the yield strength, m³ (per radian).
    pub(crate) fn yielded(&self) -> f64 {
        self.reports.iter().map(|report| report.yielded).sum()
    }

    /// Fails if a number is not finite; its von Mises stress is then infinite.
    fn check(&self, time: f64) -> Result<(), SolidError> {
        if self.reports.iter().all(|report| report.mises_squared.is_finite()) {
            return Ok(());
        }
        for (slot, id) in self.mesh.tree().leaves().iter().enumerate() {
            for (k, _) in self.state.component(slot, 0).iter().enumerate() {
                if (0..COUNT).any(|c| self.state.component(slot, c)[k].abs() > f64::MAX.sqrt())
                    || (0..COUNT).any(|c| self.state.component(slot, c)[k].is_nan())
                {
                    let [z, r] = self.mesh.centre(*id, k % N, k / N);
                    return Err(SolidError::NotFinite { z, r, time, step: self.steps + 1 });
                }
            }
        }
        Ok(())
    }

    /// Stresses in a block of the initial state or one that is new; else they come with each step.
    pub(crate) fn measure(&mut self, slot: usize) {
        let mut report = self.reports[slot];
        report_stresses(&self.context(0.0), slot, self.state.block(slot), &mut report);
        self.reports[slot] = report;
    }
}
