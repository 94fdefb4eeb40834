//! The solver of both media: what it holds, and how it is made and looked at.

pub(crate) mod stage_timer;

mod adapt;
mod advance;
mod compiled;
mod interface;
mod limits;
mod model;
mod retry;
mod saved;

use std::sync::atomic::AtomicBool;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

pub use compiled::CompiledSolver;
pub use interface::{FaceState, Interface};
pub use model::{BlockWork, Marks, Model, Place, Scratches, Step};
pub use saved::SavedBlocks;

use limits::Limits;

use crate::{
    Adaptation, Field, GroupStep, Horizon, LevelClock, LevelSteps, Mesh, Patch, ScratchPool, Side,
    StageTimer, Tile,
};

/// Cells, time, and how they advance: everything of a solver but the physics, which is its [`Model`].
///
/// It alone knows how a step of all levels, or of each by itself, is begun, made, corrected along level jumps and finished,
/// how the grid adapts, and how all that is kept and taken up again.
pub struct BlockSolver<M: Model<N>, const N: usize> {
    model: M,
    mesh: Mesh<N>,
    state: Field,
    next: Field,
    levels: LevelSteps<N>,
    reports: Reports<M::Report>,
    interface: Interface,
    adapting: Adapting<N>,
    progress: Progress,
    workers: ScratchPool<Worker<M::Scratch>>,
    prepared: M::Prepared,
    /// Those of the part of a step that is being made, kept for their memory.
    due_tiles: Vec<Tile>,
    /// Whether a block of the step under way has to be looked at, see [`Model::is_clean`].
    is_suspect: AtomicBool,
    /// How long steps may be, from [`Reports::finished`].
    limits: Limits,
    /// Which blocks have something to account for at the end of a step, kept for its memory.
    news: Vec<bool>,
}

/// What a thread works with.
struct Worker<S> {
    scratch: S,
    timer: StageTimer,
}

impl<S> Worker<S> {
    /// Begins the step of a block or a tile.
    fn begin<'a>(&'a mut self, new: &'a mut [f64], register: &'a mut [f64]) -> BlockWork<'a, S> {
        self.timer.begin();
        BlockWork { new, register, scratch: &mut self.scratch, timer: &mut self.timer }
    }
}

/// What each block has told of its steps.
#[derive(Clone, Debug)]
pub struct Reports<R> {
    /// Of the last step that is finished.
    pub finished: Vec<R>,
    /// Of the step that it is in, or the same.
    pub pending: Vec<R>,
}

/// How the grid adapts.
struct Adapting<const N: usize> {
    settings: Option<Adaptation>,
    horizon: Horizon,
    patches: ScratchPool<Patch<N>>,
}

/// How far a solver has come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// Time, s.
    pub time: f64,
    /// Steps made, of the finest level.
    pub steps: u64,
    /// Cells advanced, step by step.
    pub cell_updates: u64,
    /// Cells that would have been advanced if all levels made the steps of the finest.
    pub common_updates: u64,
}

impl<M: Model<N>, const N: usize> BlockSolver<M, N> {
    /// A solver at t = 0. Scratch is made for the current rayon pool's threads.
    ///
    /// - `adaptation`: how the grid adapts; it stays as it is without.
    /// - errors: a cell is no admissible state.
    pub fn new(
        model: M,
        mesh: Mesh<N>,
        state: Field,
        adaptation: Option<Adaptation>,
        scratch: impl Fn() -> M::Scratch,
    ) -> Result<Self, M::Error> {
        let components = state.components();
        let mut solver = Self {
            next: state.clone(),
            levels: LevelSteps::new(model.registered(), mesh.blocks()),
            reports: Reports::new(mesh.blocks()),
            interface: Interface::new(&mesh, M::INTERFACE, model.has_interface()),
            adapting: Adapting {
                settings: adaptation,
                horizon: Horizon::default(),
                patches: ScratchPool::new(|| Patch::zeros(components)),
            },
            progress: Progress::default(),
            workers: ScratchPool::new(|| Worker { scratch: scratch(), timer: StageTimer::default() }),
            prepared: M::Prepared::default(),
            due_tiles: Vec::new(),
            is_suspect: AtomicBool::new(false),
            limits: Limits::new(),
            news: Vec::new(),
            model,
            mesh,
            state,
        };
        solver.model.mesh_changed(&solver.mesh);
        solver.measure(0..solver.mesh.blocks());
        advance::check(&solver.model, &solver.mesh, &solver.state, &solver.reports.finished, (0.0, 1))?;
        Ok(solver)
    }

    /// The physics.
    pub fn model(&self) -> &M {
        &self.model
    }

    /// The physics, to be told what it cannot see by itself.
    pub fn model_mut(&mut self) -> &mut M {
        &mut self.model
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh<N> {
        &self.mesh
    }

    /// The components of all blocks, between two steps of the whole; within one see [`BlockSolver::block`].
    pub fn state(&self) -> &Field {
        &self.state
    }

    /// The components of a block, also within a step of the whole. Blocks of coarser levels that no finer one reads are then as they
    /// were when their level began its step.
    pub fn block(&self, slot: usize) -> &[f64] {
        self.present(slot).block(slot)
    }

    /// A component of [`BlockSolver::block`].
    pub fn component(&self, slot: usize, component: usize) -> &[f64] {
        self.present(slot).component(slot, component)
    }

    /// The field that has a block as it is at present.
    fn present(&self, slot: usize) -> &Field {
        if self.levels.is_aside(&self.mesh, slot) { &self.next } else { &self.state }
    }

    /// The same, of the new state of a step that has been run and not finished, in which all levels step alike.
    pub fn trial_state(&self) -> &Field {
        &self.next
    }

    /// The components of all blocks, to put something else into cells; for tests and studies.
    pub fn state_mut(&mut self) -> &mut Field {
        &mut self.state
    }

    /// What the blocks have told.
    pub fn reports(&self) -> &Reports<M::Report> {
        &self.reports
    }

    /// The faces towards the other medium.
    pub fn interface(&self) -> &Interface {
        &self.interface
    }

    /// The same, to set their states for the next step.
    pub fn interface_mut(&mut self) -> &mut Interface {
        &mut self.interface
    }

    /// Time, s.
    pub fn time(&self) -> f64 {
        self.progress.time
    }

    /// Steps made, of the finest level.
    pub fn steps(&self) -> u64 {
        self.progress.steps
    }

    /// Cells advanced so far, step by step.
    pub fn cell_updates(&self) -> u64 {
        self.progress.cell_updates
    }

    /// Cells that would have been advanced if all levels made the steps of the finest.
    pub fn common_updates(&self) -> u64 {
        self.progress.common_updates
    }

    /// Which levels step when.
    pub fn clock(&self) -> &LevelClock {
        self.levels.clock()
    }

    /// Keeps the state at a point up to date within steps, too, in which its level makes a longer one.
    pub fn watch(&mut self, point: [f64; 2]) {
        self.levels.watch(point);
    }

    /// What has passed the faces along a side of the domain in a block's last step: a quantity of the model's registers, a mean over the
    /// step. Lasts until the grid adapts.
    pub fn passed(&self, slot: usize, side: Side, quantity: usize) -> &[f64; N] {
        self.levels.passed().row(slot, side, quantity)
    }

    /// The finest level at the interface.
    pub fn finest_at_interface(&self) -> u8 {
        self.mesh.finest_among(self.interface.blocks())
    }

    /// What `work` makes of each block at the interface that is due, in the order of r, in parallel on the current rayon pool. Nothing
    /// without another medium.
    ///
    /// - `made`: gets it, block by block; a step should allocate nothing of that size.
    /// - returns: the numbers of the blocks' first faces.
    pub fn map_interface<T: Send>(
        &self,
        is_due: impl Fn(usize) -> bool,
        work: impl Fn(usize) -> T + Sync + Send,
        made: &mut Vec<T>,
    ) -> Vec<usize> {
        /// So many are worth it to wake a thread.
        const BLOCKS_AT_ONCE: usize = 2;
        let with_face = |slot: &usize| Some((self.interface.first_face(*slot)?, *slot));
        let due = self.interface.blocks().iter().filter(|slot| is_due(**slot));
        let due: Vec<(usize, usize)> = due.filter_map(with_face).collect();
        due.par_iter().with_min_len(BLOCKS_AT_ONCE).map(|(_, slot)| work(*slot)).collect_into_vec(made);
        due.into_iter().map(|(first, _)| first).collect()
    }

    /// The group of levels that a face of the interface belongs to.
    pub fn group_of_face(&self, face: usize) -> usize {
        self.clock().group_of(&self.mesh, self.interface.blocks()[face / N])
    }

    /// Whether a block belongs to the levels that make a step.
    pub fn makes(&self, step: GroupStep, slot: usize) -> bool {
        self.clock().group_of(&self.mesh, slot) == step.group
    }

    /// [`Interface::edges`].
    pub fn interface_edges(&self) -> Vec<f64> {
        self.interface.edges(&self.mesh)
    }

    /// A step of length `dt` from the present state; of no length, to look at that.
    pub fn context(&self, dt: f64) -> Step<'_, M, N> {
        let Self { model, mesh, state, interface, progress, prepared, .. } = self;
        Step {
            model,
            mesh,
            old: state,
            interface,
            prepared,
            marks: Step::<M, N>::NO_MARKS,
            time: progress.time,
            dt,
        }
    }

    /// Runs `work` with this thread's scratch.
    pub fn with_scratch<R>(&self, work: impl FnOnce(&mut M::Scratch) -> R) -> R {
        self.workers.with(|worker| work(&mut worker.scratch))
    }

    /// The stages of the blocks' steps so far, and how long they have taken in all threads together, s; from a sample.
    pub fn stage_seconds(&self) -> Vec<(&'static str, f64)> {
        let mut seconds: Vec<(&'static str, f64)> = M::STAGES.iter().map(|name| (*name, 0.0)).collect();
        self.workers.for_each(|worker| {
            for (stage, (_, seconds)) in seconds.iter_mut().enumerate() {
                *seconds += worker.timer.seconds(stage);
            }
        });
        seconds
    }
}
