//! `SolidSolver`: owns the mesh and the fields, and advances them.

use mesh::{Domain, Field, Limiter, Mesh, ScratchPool, Side, for_each_block};

use crate::block::{BlockReport, BlockScratch, StepContext, step_block};
use crate::boundary::{Boundaries, SurfaceState};
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
    next: Field,
    reports: Vec<BlockReport>,
    pub(crate) scratch: ScratchPool<BlockScratch<N>>,
    pub(crate) surface: Vec<SurfaceState>,
    pub(crate) surface_first: Vec<usize>,
    /// Slots of the blocks along z_max, in order.
    pub(crate) surface_blocks: Vec<usize>,
    time: f64,
    steps: u64,
    ledger: BoundaryLedger,
}

impl<const N: usize> SolidSolver<N> {
    /// A solid filled point by point: `initial` gives the state at a cell's centre (z, r). Scratch is made for
    /// the current rayon pool's threads.
    ///
    /// - errors: [`SolidError::Mesh`], [`SolidError::NotFinite`].
    pub fn new(setup: SolidSetup, initial: impl Fn([f64; 2]) -> ElasticState) -> Result<Self, SolidError> {
        let kinds = setup.boundaries;
        let periodic = [Side::ZMin, Side::RMin].map(|side| kinds[side as usize] == Boundary::Periodic);
        let mesh = Mesh::<N>::uniform(setup.domain, setup.coarsest, setup.levels, periodic)?;
        let mut state = Field::zeros(mesh.blocks(), N * N, COUNT);
        for (slot, id) in mesh.tree().leaves().iter().enumerate() {
            let block = state.block_mut(slot);
            for j in 0..N {
                for i in 0..N {
                    for (c, value) in initial(mesh.centre(*id, i, j)).to_array().into_iter().enumerate() {
                        block[(c * N + j) * N + i] = value;
                    }
                }
            }
        }
        let along = Side::ALL.map(|side| edge_states(&mesh, &state, side));
        let mut surface_first = vec![usize::MAX; mesh.blocks()];
        let mut faces = 0;
        if kinds[Side::ZMax as usize] == Boundary::Interface {
            for slot in mesh.blocks_along(Side::ZMax) {
                surface_first[slot] = faces;
                faces += N;
            }
        }
        let mut solver = Self {
            elasticity: Elasticity::new(setup.speeds),
            boundaries: Boundaries::new(kinds, along),
            reports: vec![BlockReport::default(); mesh.blocks()],
            next: state.clone(),
            state,
            scratch: ScratchPool::new(BlockScratch::new),
            surface: vec![SurfaceState::default(); faces],
            surface_first,
            surface_blocks: mesh.blocks_along(Side::ZMax),
            time: 0.0,
            steps: 0,
            ledger: BoundaryLedger::default(),
            setup,
            mesh,
        };
        solver.measure();
        solver.check(0.0)?;
        Ok(solver)
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
        let context = self.context(dt);
        for_each_block(&mut next, &mut reports, |slot, new, report| {
            *report = self.scratch.with(|scratch| step_block(&context, slot, new, scratch));
        });
        (self.next, self.reports) = (next, reports);
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

    /// Stresses of the initial state; later ones come with each step.
    fn measure(&mut self) {
        for slot in 0..self.mesh.blocks() {
            let id = self.mesh.tree().leaves()[slot];
            let report = &mut self.reports[slot];
            for k in 0..N * N {
                let [_, _, zz, zr, rr, pp] = std::array::from_fn(|c| self.state.component(slot, c)[k]);
                let mises = crate::von_mises(zz, zr, rr, pp);
                let squared = mises * mises;
                report.mises_squared =
                    report.mises_squared.max(if squared < f64::MAX { squared } else { f64::INFINITY });
                if mises > self.setup.yield_strength {
                    report.yielded += self.mesh.volume(id, k / N);
                }
            }
        }
    }
}

/// The states of the cells along one side of the domain, in order.
fn edge_states<const N: usize>(mesh: &Mesh<N>, state: &Field, side: Side) -> Vec<ElasticState> {
    let mut states = Vec::new();
    for slot in mesh.blocks_along(side) {
        for along in 0..N {
            let (i, j) = match side {
                Side::ZMin => (0, along),
                Side::ZMax => (N - 1, along),
                Side::RMin => (along, 0),
                Side::RMax => (along, N - 1),
            };
            let w = std::array::from_fn(|c| state.component(slot, c)[j * N + i]);
            states.push(ElasticState::from_array(w));
        }
    }
    states
}
