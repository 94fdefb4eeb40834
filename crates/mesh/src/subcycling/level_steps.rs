//! Local time steps: what a solver keeps for the levels that step less often than the finest.

use rayon::prelude::*;

use crate::kernels::parallel::for_some_blocks_lightly;
use crate::{CorrectedFace, Field, FluxRegister, GroupStep, LevelClock, Mesh, Neighbour, Side};

/// Clock and storage of local time steps (subcycling), and what passes between levels.
///
/// All groups of levels read `state` and write `next`, and the two are exchanged after each step of the finest. Within the
/// step of a coarser group those of its blocks that finer ones read move to its end linearly in time (Osher & Sanders 1983;
/// Berger & Colella 1989), whenever the next finer group begins a step: of them `state` then has the present and `next` the end.
/// Nobody asks in between, nor of the other blocks before the end, so they stay where they are, whatever the two fields are
/// called meanwhile. What finer blocks pass to coarser ones is kept as the mean over the coarser one's step.
#[derive(Clone, Debug)]
pub struct LevelSteps<const N: usize> {
    clock: LevelClock,
    registers: Registers<N>,
    follows: Vec<Follows>,
    /// Whether the fields have been exchanged an odd number of times since each group began its step.
    is_exchanged: Vec<bool>,
    /// The same, since its blocks that finer ones read were moved to where the next finer group began a step; and when that was, s.
    moved: Vec<(bool, f64)>,
    points: Vec<[f64; 2]>,
}

/// When the state of a block is asked for within its level's step.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Follows {
    /// Not before the end.
    Never,
    /// When the next finer group begins a step.
    WhenRead,
    /// At the end of each step of the finest group.
    Always,
}

/// What becomes of a block at the end of a step of the finest group, before the fields are exchanged.
#[derive(Clone, Copy, Debug)]
enum Move {
    Nowhere,
    /// `state` has the end of its step, which has come: `next` gets it, too.
    ToEnd,
    /// `state` has the present and `next` the end: both are put where they are looked for next, the present moved by this share.
    By(f64),
    /// The other way round: the present is moved by this share.
    InNext(f64),
}

impl Move {
    fn make(self, state: &mut [f64], next: &mut [f64]) {
        match self {
            Self::Nowhere => {}
            Self::ToEnd => next.copy_from_slice(state),
            Self::By(share) => {
                for (next, state) in next.iter_mut().zip(state) {
                    let end = *next;
                    *next = *state + share * (end - *state);
                    *state = end;
                }
            }
            Self::InNext(share) => {
                next.iter_mut().zip(state).for_each(|(next, end)| *next += share * (*end - *next));
            }
        }
    }
}

/// What the blocks have passed over faces between levels in their own steps, and its means over the steps of coarser ones.
#[derive(Clone, Debug)]
pub struct Registers<const N: usize> {
    own: FluxRegister<N>,
    means: FluxRegister<N>,
}

impl<const N: usize> Registers<N> {
    /// What the blocks pass in their own steps.
    pub fn own_mut(&mut self) -> &mut FluxRegister<N> {
        &mut self.own
    }

    /// What finer neighbours of a block on a level have passed during its step.
    pub fn finer_side(&self, clock: &LevelClock, level: u8) -> FinerSide<'_, N> {
        let is_one_step = clock.group(level) == clock.group(level + 1);
        FinerSide { own: &self.own, finer: if is_one_step { &self.own } else { &self.means } }
    }
}

/// What a block has passed over its faces, and its finer neighbours meanwhile.
#[derive(Clone, Copy)]
pub struct FinerSide<'a, const N: usize> {
    own: &'a FluxRegister<N>,
    finer: &'a FluxRegister<N>,
}

impl<const N: usize> FinerSide<'_, N> {
    /// [`FluxRegister::for_corrected_faces`].
    pub fn for_corrected_faces<const K: usize>(
        &self,
        mesh: &Mesh<N>,
        slot: usize,
        first: usize,
        correct: impl FnMut(CorrectedFace<K>),
    ) {
        self.own.for_corrected_faces(self.finer, mesh, slot, first, correct);
    }

    /// [`FluxRegister::for_corrected_sides`].
    pub fn for_corrected_sides<const K: usize>(
        &self,
        mesh: &Mesh<N>,
        slot: usize,
        first: usize,
        correct: impl FnMut(Side, f64, &[[f64; N]; K]),
    ) {
        self.own.for_corrected_sides(self.finer, mesh, slot, first, correct);
    }
}

impl<const N: usize> LevelSteps<N> {
    /// With registers of so many quantities.
    pub fn new(quantities: usize, blocks: usize) -> Self {
        Self {
            clock: LevelClock::default(),
            registers: Registers {
                own: FluxRegister::new(blocks, quantities),
                means: FluxRegister::new(0, quantities),
            },
            follows: Vec::new(),
            is_exchanged: Vec::new(),
            moved: Vec::new(),
            points: Vec::new(),
        }
    }

    /// Makes room for the blocks of another mesh.
    pub fn resize(&mut self, blocks: usize) {
        self.registers.own.resize(blocks);
    }

    /// Keeps the state at a point up to date within steps, too, in which its level makes a longer one.
    pub fn watch(&mut self, point: [f64; 2]) {
        self.points.push(point);
    }

    /// Begins a step of length `dt`, in which levels coarser than `base` step like `base`.
    ///
    /// - `watched`: slots of blocks whose state is asked for at all times, whatever their level, besides those at watched
    ///   points.
    pub fn begin<'a>(
        &mut self,
        mesh: &Mesh<N>,
        base: u8,
        now: f64,
        dt: f64,
        watched: impl IntoIterator<Item = &'a usize>,
    ) {
        let [coarsest, finest] = mesh.levels_present();
        self.clock.begin(base.max(coarsest).min(finest), finest, now, dt);
        self.is_exchanged.clear();
        self.is_exchanged.resize(self.clock.groups(), false);
        self.moved.clear();
        self.moved.resize(self.clock.groups(), (false, now));
        if self.clock.groups() == 1 {
            return;
        }
        self.registers.means.resize(mesh.blocks());
        let is_read = |slot: usize| {
            mesh.tree().neighbours(slot).iter().any(|neighbour| matches!(neighbour, Neighbour::Finer(_)))
        };
        self.follows.clear();
        let follows = |slot: usize| if is_read(slot) { Follows::WhenRead } else { Follows::Never };
        self.follows.extend((0..mesh.blocks()).map(follows));
        for slot in watched.into_iter().copied() {
            self.follows[slot] = Follows::Always;
        }
        // The slopes at a point are made with the neighbours, too.
        for (slot, ..) in self.points.iter().filter_map(|point| mesh.locate(*point)) {
            let around = mesh.tree().neighbours(slot).iter().flat_map(Neighbour::slots);
            for slot in std::iter::once(slot).chain(around) {
                self.follows[slot] = Follows::Always;
            }
        }
    }

    /// What the blocks pass in their own steps.
    pub fn passed(&self) -> &FluxRegister<N> {
        &self.registers.own
    }

    /// Which levels step when.
    pub fn clock(&self) -> &LevelClock {
        &self.clock
    }

    /// Starts the next step of the group that is due, see [`LevelClock::start`].
    pub fn start(&mut self, limit: f64) -> GroupStep {
        let step = self.clock.start(limit);
        self.is_exchanged[step.group] = false;
        self.moved[step.group] = (false, step.begin);
        step
    }

    /// The clock, and what blocks pass each other.
    pub fn parts(&mut self) -> (&LevelClock, &mut Registers<N>) {
        (&self.clock, &mut self.registers)
    }

    /// Whether a block is at present in the field of the new states: nobody has read it since the fields were exchanged.
    pub fn is_aside(&self, mesh: &Mesh<N>, slot: usize) -> bool {
        let clock = &self.clock;
        // Between steps nothing is aside, and the mesh may be another than the last step's.
        if clock.groups() < 2 || clock.is_over() {
            return false;
        }
        let group = clock.group_of(mesh, slot);
        let is_exchanged = match self.follows[slot] {
            Follows::Never => self.is_exchanged[group],
            Follows::WhenRead => self.moved[group].0,
            Follows::Always => false,
        };
        group != clock.finest() && is_exchanged && clock.end(group) > clock.now()
    }

    /// Takes what the blocks of a group have passed in their step into the means over the coarser group's step.
    pub fn gather(&mut self, mesh: &Mesh<N>, group: usize) {
        if group == 0 {
            return;
        }
        let (clock, weight) = (&self.clock, self.clock.weight(group));
        let is_read = |slot: usize, side: Side| {
            matches!(mesh.tree().neighbours(slot)[side as usize], Neighbour::Coarser(_))
        };
        let is_due = |slot: usize| {
            clock.group_of(mesh, slot) == group && Side::ALL.into_iter().any(|side| is_read(slot, side))
        };
        let Registers { own, means } = &mut self.registers;
        let means = means.values_mut();
        for_some_blocks_lightly(means, &mut vec![(); mesh.blocks()], is_due, |slot, means, ()| {
            for side in Side::ALL.into_iter().filter(|side| is_read(slot, *side)) {
                let means = FluxRegister::<N>::rows(means, side);
                let values = own.side(slot, side);
                if weight == 1.0 {
                    means.copy_from_slice(values);
                    continue;
                }
                for (mean, value) in means.iter_mut().zip(values) {
                    // By differences, so that the mean of what stays the same is the same to the last bit.
                    *mean += weight * (*value - *mean);
                }
            }
        });
    }

    /// Puts those blocks whose level ends its step with the finest where corrections look for them: what they began with, or have been
    /// moved to since, in `state`, the end in `next`.
    pub fn before_corrections(&mut self, mesh: &Mesh<N>, state: &mut Field, next: &mut Field) {
        let Self { clock, follows, moved, .. } = self;
        let later = clock.next();
        let is_due = |group: usize, is_exchanged: bool| is_exchanged && clock.end(group) == later;
        if !moved.iter().enumerate().any(|(group, (is_exchanged, _))| is_due(group, *is_exchanged)) {
            return;
        }
        for_both(state, next, |slot, state, next| {
            let group = clock.group_of(mesh, slot);
            if follows[slot] == Follows::WhenRead && is_due(group, moved[group].0) {
                state.swap_with_slice(next);
            }
        });
        for (group, (is_exchanged, _)) in moved.iter_mut().enumerate() {
            *is_exchanged &= clock.end(group) != later;
        }
    }

    /// Ends the finest group's step: `state` is then that of its end.
    ///
    /// To be called when the clock still shows the beginning, after all corrections.
    pub fn finish_step(&mut self, mesh: &Mesh<N>, state: &mut Field, next: &mut Field) {
        let Self { clock, follows, is_exchanged, moved, .. } = self;
        let (finest, later) = (clock.finest(), clock.next());
        let is_read = |group: usize| clock.end(group) > later && clock.end(group + 1) <= later;
        if finest > 0 {
            let moves = |group: usize| {
                let (is_moved, since) = moved[group];
                if clock.end(group) <= later {
                    let to_end = |is_exchanged| if is_exchanged { Move::ToEnd } else { Move::Nowhere };
                    return [to_end(is_exchanged[group]), to_end(is_moved), Move::Nowhere];
                }
                let share = (later - since) / (clock.end(group) - since);
                let when_read = match (is_read(group), is_moved) {
                    (false, _) => Move::Nowhere,
                    (true, false) => Move::By(share),
                    (true, true) => Move::InNext(share),
                };
                [Move::Nowhere, when_read, Move::By(clock.share_until(group, later))]
            };
            let moves: Vec<[Move; 3]> = (0..finest).map(moves).collect();
            for_both(state, next, |slot, state, next| {
                if let Some(moves) = moves.get(clock.group_of(mesh, slot)) {
                    moves[follows[slot] as usize].make(state, next);
                }
            });
            for group in 0..finest {
                let (is_exchanged, since) = &mut moved[group];
                *is_exchanged = !*is_exchanged;
                if is_read(group) {
                    (*is_exchanged, *since) = (false, later);
                }
            }
        }
        is_exchanged.iter_mut().for_each(|is_exchanged| *is_exchanged = !*is_exchanged);
        std::mem::swap(state, next);
        self.clock.advance();
    }
}

/// Calls `work(slot, block of state, block of next)` for all blocks, in parallel.
fn for_both(state: &mut Field, next: &mut Field, work: impl Fn(usize, &mut [f64], &mut [f64]) + Sync) {
    let len = state.block_len();
    (state.as_mut_slice().par_chunks_mut(len))
        .zip(next.as_mut_slice().par_chunks_mut(len))
        .enumerate()
        .with_min_len(16)
        .for_each(|(slot, (state, next))| work(slot, state, next));
}

impl LevelClock {
    /// The group of a block.
    pub fn group_of<const N: usize>(&self, mesh: &Mesh<N>, slot: usize) -> usize {
        self.group(mesh.tree().leaves()[slot].level)
    }
}

impl<const N: usize> Mesh<N> {
    /// The coarsest and the finest level that there are leaves of.
    pub fn levels_present(&self) -> [u8; 2] {
        let levels = self.tree().leaves().iter().map(|id| id.level);
        levels.fold([u8::MAX, 0], |[low, high], level| [level.min(low), level.max(high)])
    }

    /// The coarsest level that steps by itself: levels below it step with it.
    pub fn coarsest_base(&self) -> u8 {
        let [coarsest, finest] = self.levels_present();
        finest.saturating_sub(MOST_HALVINGS).max(coarsest)
    }

    /// The finest level of some blocks, 0 of none.
    pub fn finest_among(&self, slots: &[usize]) -> u8 {
        slots.iter().map(|slot| self.tree().leaves()[*slot].level).max().unwrap_or(0)
    }
}

/// All blocks, where some are asked for by their slots.
#[must_use]
pub fn every_slot(_slot: usize) -> bool {
    true
}

/// Which blocks a part of a step is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// All of the group.
    All,
    /// Those that do not touch the interface between the media: they need not know what the other side does.
    AwayFromInterface,
    /// Those that do.
    AtInterface,
}

impl Part {
    /// Whether a block is in it.
    pub fn has(self, at_interface: bool) -> bool {
        match self {
            Self::All => true,
            Self::AwayFromInterface => !at_interface,
            Self::AtInterface => at_interface,
        }
    }
}

/// The levels below the finest that have steps of their own: what coarser ones would save is little, and their steps would be
/// longer than the grid holds.
pub const MOST_HALVINGS: u8 = 3;
