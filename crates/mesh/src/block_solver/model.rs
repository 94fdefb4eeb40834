//! What a physics is to the block solver.

use std::collections::BTreeMap;

use super::Worker;
use crate::{BlockSolver, Field, FinerSide, Interface, Mesh, Misfit, Multiresolution, Remap, Reports};
use crate::{CellBits, ScratchPool, Side, StageTimer, Tile};

/// Cells that a step makes at first order, block by block.
pub type Marks<const N: usize> = BTreeMap<usize, CellBits<N>>;

/// What the [`BlockSolver`] must know of a physics, and what it tells it. Two implementers: the fluid and the solid.
///
/// `N` is the number of cells along a block's side. Everything that is about levels, time, storage and threads is the solver's;
/// what is asked here is about one block at a time, from whatever thread.
pub trait Model<const N: usize>: Sized + Sync {
    /// What messages call it.
    const NAME: &'static str;
    /// The side of the domain beyond which the other medium is, if there is one.
    const INTERFACE: Side;
    /// What adaptation must know of the components.
    type Analysis: Multiresolution;
    /// What one block tells of its step.
    type Report: Clone + Default + Send + Sync;
    /// What a thread works in.
    type Scratch: Send;
    /// Why a step fails.
    type Error;

    /// What adaptation must know of the components.
    fn analysis(&self) -> &Self::Analysis;
    /// Numbers that are registered of each face between levels.
    fn registered(&self) -> usize;
    /// Whether another medium is beyond [`Model::INTERFACE`].
    fn has_interface(&self) -> bool;
    /// Blocks besides those at the interface whose state is asked for at all times within a step.
    fn watched(&self) -> &[usize] {
        &[]
    }

    /// The names of the stages of a block's step, in their order.
    const STAGES: &'static [&'static str];

    /// What blocks find out together before they make a step.
    type Prepared: Default + Send + Sync;

    /// Finds out what the blocks of a group have to know of each other beyond the state at the beginning of their step: it is in
    /// `step.prepared` then, until the next group is prepared.
    ///
    /// - `slots`: of the group's blocks; `prepared`: what was found last.
    fn prepare(
        &self,
        _step: &Step<'_, Self, N>,
        _slots: &[usize],
        _prepared: &mut Self::Prepared,
        _scratch: Scratches<'_, Self::Scratch>,
    ) {
    }

    /// Whether there is anything to prepare.
    fn prepares(&self) -> bool {
        false
    }

    /// Advances a block by one step from `step.old`.
    fn step_block(
        &self,
        step: &Step<'_, Self, N>,
        slot: usize,
        work: BlockWork<'_, Self::Scratch>,
    ) -> Self::Report;
    /// Advances the blocks of a tile as [`Model::step_block`] does each, to the last bit.
    fn step_tile(
        &self,
        step: &Step<'_, Self, N>,
        tile: Tile,
        mut work: BlockWork<'_, Self::Scratch>,
        reports: &mut [Self::Report],
    ) {
        work.each_of(tile, reports, |slot, work, report| *report = self.step_block(step, slot, work));
    }
    /// Corrects the cells of a block along its finer neighbours.
    fn correct(
        &self,
        step: &Step<'_, Self, N>,
        finer: FinerSide<'_, N>,
        slot: usize,
        new: &mut [f64],
        report: &mut Self::Report,
    );
    /// Takes into the report of a block what its cells say; a step does so by itself.
    fn measure(&self, mesh: &Mesh<N>, slot: usize, block: &[f64], report: &mut Self::Report);
    /// The fastest signals of a block along z and r, m/s.
    fn signal_speeds(&self, report: &Self::Report) -> [f64; 2];

    /// The longest step of a block that what is not waves allows, s; `widths`: of its cells.
    fn step_limit(&self, _report: &Self::Report, _widths: [f64; 2]) -> f64 {
        f64::INFINITY
    }

    /// Whether a report alone says that no cell of the block is inadmissible, and none is to be redone: [`Model::inadmissible_cell`]
    /// and [`Model::cells_to_redo`] are not asked then.
    fn is_clean(&self, report: &Self::Report) -> bool;
    /// The first cell of a block that is no admissible state.
    fn inadmissible_cell(&self, report: &Self::Report, block: &[f64]) -> Option<usize>;
    /// That a cell of a block is not, and where.
    fn error(&self, block: &[f64], cell: usize, place: Place) -> Self::Error;
    /// Whether cells may make their step again at first order. Cells of a model without are looked at as soon as they are made.
    const RETRIES: bool = false;
    /// Cells of a block that should.
    fn cells_to_redo(&self, _report: &Self::Report, _block: &[f64]) -> CellBits<N> {
        CellBits::default()
    }
    /// Takes into a report that so many cells of this volume have made their step again.
    fn note_redone(&self, _report: &mut Self::Report, _cells: usize, _volume: f64) {}

    /// Whether there is anything in the report of a block's step for [`Model::account`].
    fn has_news(&self, mesh: &Mesh<N>, slot: usize, report: &Self::Report) -> bool;
    /// Takes the report of a block's step of length `dt` into what is added up over the run; in the order of the slots.
    fn account(&mut self, mesh: &Mesh<N>, slot: usize, dt: f64, report: &Self::Report, interface: &Interface);
    /// Takes notice that the blocks have new reports.
    fn reports_changed(&mut self, _reports: &Reports<Self::Report>) {}
    /// Takes notice of a new mesh.
    fn mesh_changed(&mut self, _mesh: &Mesh<N>) {}
    /// The level that something besides the details demands of each block, 0 if nothing does; empty where nothing ever does.
    ///
    /// - `base`: the finest level that details may ask for, see [`crate::Adaptation::base`].
    /// - `travel`: how many of its cells a wave in the block of a slot crosses before the next adaptation.
    fn demanded_levels(
        &self,
        _state: (&Mesh<N>, &Field, f64),
        _base: u8,
        _travel: &(dyn Fn(usize) -> f64 + Sync),
    ) -> Vec<u8> {
        Vec::new()
    }
    /// The finest level that details may ask for at present: `base`, that of the settings, or a coarser one.
    ///
    /// Thresholds are those of a grid that ends there, see [`crate::Adaptation::epsilon`].
    fn finest_for_details(&self, _mesh: &Mesh<N>, base: u8) -> u8 {
        base
    }
    /// Carries a field over to another mesh; `_time`: of the field, s.
    fn remap(&mut self, remap: &Remap<'_, N>, _time: f64, new: &mut Field) {
        remap.by(self.analysis(), new);
    }
    /// Called when all levels have come to the end of a whole step.
    fn whole_step_ended(_solver: &mut BlockSolver<Self, N>) {}

    /// What of it changes in time besides the cells and their reports.
    type Memory;
    /// That, to be kept.
    fn memory(&self) -> Self::Memory;
    /// Takes up what was kept.
    ///
    /// - errors: it is not of such a model.
    fn restore(&mut self, memory: Self::Memory) -> Result<(), Misfit>;
}

/// What the step of a block, or of those of a tile, works on.
pub struct BlockWork<'a, S> {
    /// Its part of the new state, to be filled; block after block.
    pub new: &'a mut [f64],
    /// Its part of the flux register, likewise.
    pub register: &'a mut [f64],
    /// What a thread keeps.
    pub scratch: &'a mut S,
    /// To be told of the end of each stage.
    pub timer: &'a mut StageTimer,
}

impl<S> BlockWork<'_, S> {
    /// Goes through the blocks of a tile, whose work this is: slot, work and report of each.
    pub fn each_of<R>(
        &mut self,
        tile: Tile,
        reports: &mut [R],
        mut step: impl FnMut(usize, BlockWork<'_, S>, &mut R),
    ) {
        let (len, registered) = (self.new.len() / tile.blocks(), self.register.len() / tile.blocks());
        let parts = self.new.chunks_exact_mut(len).zip(self.register.chunks_exact_mut(registered));
        for (slot, ((new, register), report)) in tile.slots().zip(parts.zip(reports)) {
            step(slot, BlockWork { new, register, scratch: self.scratch, timer: self.timer }, report);
        }
    }
}

/// What all blocks of a step share.
pub struct Step<'a, M: Model<N>, const N: usize> {
    /// The physics.
    pub model: &'a M,
    /// Where the cells are.
    pub mesh: &'a Mesh<N>,
    /// The state at the beginning of the step.
    pub old: &'a Field,
    /// The faces towards the other medium, with their states during the step.
    pub interface: &'a Interface,
    /// What the blocks of the group have found out together, see [`Model::prepare`].
    pub prepared: &'a M::Prepared,
    /// Cells that are made at first order.
    pub marks: &'a Marks<N>,
    /// Time at the beginning of the step, s.
    pub time: f64,
    /// Its length, s.
    pub dt: f64,
}

impl<M: Model<N>, const N: usize> Step<'_, M, N> {
    /// No cell falls back.
    pub(super) const NO_MARKS: &'static Marks<N> = &Marks::new();

    /// The middle of the step, s.
    pub fn middle(&self) -> f64 {
        self.time + 0.5 * self.dt
    }
}

/// The scratch of the threads.
pub struct Scratches<'a, S>(pub(super) &'a ScratchPool<Worker<S>>);

impl<S> Scratches<'_, S> {
    /// Runs `work` with this thread's.
    pub fn with<R>(&self, work: impl FnOnce(&mut S) -> R) -> R {
        self.0.with(|worker| work(&mut worker.scratch))
    }
}

/// Where and when a cell is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Its centre, m.
    pub z: f64,
    /// Its centre, m.
    pub r: f64,
    /// At the end of the step, s.
    pub time: f64,
    /// The step's number, from 1.
    pub step: u64,
}
