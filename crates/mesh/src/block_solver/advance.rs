//! How the cells advance: in steps of the whole grid, or level by level (subcycling).
//!
//! A whole step is begun, then made in sub-steps of the finest level; a coarser level starts its own first and is finished when
//! the finer ones have caught up. Without local time steps one sub-step is the whole.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::limits::{Limits, limits_of, together};
use super::{BlockSolver, Model, Place, Reports, Scratches, Step};
use crate::kernels::parallel::{LOOKS_AT_ONCE, for_each_tile, for_some_blocks_lightly};
use crate::{Field, FluxRegister, GroupStep, LevelClock, Mesh, Part};

impl<M: Model<N>, const N: usize> BlockSolver<M, N> {
    /// Advances all cells by `dt`. With another medium beyond the interface its states must have been set.
    ///
    /// - errors: a cell is no admissible state any more; the state before the step is then kept.
    pub fn step(&mut self, dt: f64) -> Result<(), M::Error> {
        self.begin_step(dt, u8::MAX);
        self.sub_step(f64::INFINITY)
    }

    /// [`BlockSolver::step`] of the length that the Courant number allows.
    pub fn step_at(&mut self, cfl: f64) -> Result<(), M::Error> {
        self.step(self.time_step_limit(cfl))
    }

    /// A step of the length that the Courant number allows the coarsest level that steps by itself, in which finer ones make steps of
    /// their own; returns its length, s.
    ///
    /// - errors: as [`BlockSolver::step`].
    pub fn step_locally_at(&mut self, cfl: f64) -> Result<f64, M::Error> {
        let base = self.mesh.coarsest_base();
        let dt = self.local_step_limit(cfl, base);
        self.begin_step(dt, base);
        while !self.clock().is_over() {
            self.sub_step(cfl)?;
        }
        Ok(dt)
    }

    /// Begins a step of length `dt` in which levels finer than `base` make steps of their own.
    pub fn begin_step(&mut self, dt: f64, base: u8) {
        let watched = self.interface.blocks().iter().chain(self.model.watched());
        self.levels.begin(&self.mesh, base, self.progress.time, dt, watched);
    }

    /// Makes the next step of the finest level, and what coarser ones have to do before and after it.
    ///
    /// - `cfl`: bounds the steps of levels within the whole.
    /// - errors: as [`BlockSolver::step`].
    pub fn sub_step(&mut self, cfl: f64) -> Result<(), M::Error> {
        while self.clock().due().is_some() {
            let step = self.start(self.due_limit(cfl));
            self.run(step, Part::All)?;
        }
        self.finish()
    }

    /// Starts the step of the group of levels that is due, of at most `limit`, see [`LevelClock::start`], and has its blocks prepared.
    pub fn start(&mut self, limit: f64) -> GroupStep {
        let step = self.levels.start(limit);
        if self.model.prepares() {
            self.prepare(step);
        }
        step
    }

    fn prepare(&mut self, step: GroupStep) {
        let mut prepared = std::mem::take(&mut self.prepared);
        let in_group = |slot: &usize| self.clock().group_of(&self.mesh, *slot) == step.group;
        let slots: Vec<usize> = (0..self.mesh.blocks()).filter(in_group).collect();
        self.model.prepare(&self.context(step.dt), &slots, &mut prepared, Scratches(&self.workers));
        self.prepared = prepared;
    }

    /// Makes a part of a step that has been started. The parts of group 0 may be made one after the other.
    ///
    /// - errors: as [`BlockSolver::step`].
    pub fn run(&mut self, step: GroupStep, part: Part) -> Result<(), M::Error> {
        let Self {
            model,
            mesh,
            state,
            next,
            levels,
            reports,
            interface,
            workers,
            progress,
            prepared,
            due_tiles,
            is_suspect,
            ..
        } = self;
        let (clock, registers) = levels.parts();
        let register = registers.own_mut();
        let (time, dt, marks) = (progress.time, step.dt, Step::<M, N>::NO_MARKS);
        let context = Step { model: &*model, mesh, old: state, interface, prepared, marks, time, dt };
        let in_group = |slot: usize| clock.group_of(mesh, slot) == step.group;
        let is_due = |slot: usize| part.has(interface.first_face(slot).is_some()) && in_group(slot);
        let pending = &mut reports.pending;
        let lens = [next.block_len(), register.values().block_len()];
        due_tiles.clear();
        due_tiles.extend(mesh.tree().tiles().iter().filter(|tile| tile.slots().any(is_due)));
        for_each_tile(due_tiles, next, register.values_mut(), pending, |tile, new, fluxes, reports| {
            if tile.slots().all(is_due) {
                workers.with(|worker| model.step_tile(&context, tile, worker.begin(new, fluxes), reports));
            } else {
                let parts = new.chunks_exact_mut(lens[0]).zip(fluxes.chunks_exact_mut(lens[1]));
                let of_slots = tile.slots().zip(parts.zip(&mut *reports));
                for (slot, ((new, fluxes), report)) in of_slots.filter(|(slot, _)| is_due(*slot)) {
                    *report =
                        workers.with(|worker| model.step_block(&context, slot, worker.begin(new, fluxes)));
                }
            }
            look_at(model, reports, is_suspect);
        });
        // A cell that falls back changes what its neighbours get: first all parts must be there.
        if (!M::RETRIES || part != Part::AwayFromInterface) && std::mem::take(is_suspect.get_mut()) {
            if M::RETRIES {
                context.retry(next, register, pending, in_group, workers);
            }
            check(model, mesh, next, pending, (progress.time + step.dt, progress.steps + 1))?;
        }
        let due: usize = due_tiles.iter().map(|tile| tile.slots().filter(|slot| is_due(*slot)).count()).sum();
        progress.cell_updates += (due * N * N) as u64;
        levels.gather(mesh, step.group);
        // Where all levels step alike no block reads another one's new state before they have finished.
        if levels.clock().groups() > 1 {
            model.reports_changed(reports);
        }
        Ok(())
    }

    /// Ends the present step of the finest level, and those of coarser ones that end with it.
    ///
    /// - errors: as [`BlockSolver::step`].
    pub fn finish(&mut self) -> Result<(), M::Error> {
        let later = self.clock().next();
        let ended = |clock: &LevelClock, group: usize| clock.end(group) == later;
        self.levels.before_corrections(&self.mesh, &mut self.state, &mut self.next);
        for group in (0..self.clock().groups()).rev() {
            if ended(self.clock(), group) {
                self.correct(group)?;
            }
        }
        let Self { model, mesh, state, next, levels, reports, interface, progress, limits, news, .. } = self;
        let clock = levels.clock();
        let Reports { finished, pending } = &mut *reports;
        news.clear();
        news.resize(finished.len(), false);
        let parts = (finished.par_chunks_mut(LOOKS_AT_ONCE))
            .zip(pending.par_chunks(LOOKS_AT_ONCE))
            .zip(news.par_chunks_mut(LOOKS_AT_ONCE));
        let of_parts: Vec<Limits> = (parts.enumerate())
            .map(|(part, ((finished, pending), news))| {
                let first = part * LOOKS_AT_ONCE;
                let both = finished.iter_mut().zip(pending).zip(news);
                for (slot, ((finished, pending), has_news)) in (first..).zip(both) {
                    if ended(clock, clock.group_of(mesh, slot)) {
                        finished.clone_from(pending);
                        *has_news = model.has_news(mesh, slot, pending);
                    }
                }
                limits_of(model, mesh, first, finished)
            })
            .collect();
        *limits = together(mesh, of_parts);
        // In the order of the slots, so that sums do not depend on threads.
        for (slot, _) in news.iter().enumerate().filter(|(_, has_news)| **has_news) {
            let dt = clock.length(clock.group_of(mesh, slot));
            model.account(mesh, slot, dt, &finished[slot], interface);
        }
        levels.finish_step(mesh, state, next);
        model.reports_changed(reports);
        progress.time = later;
        progress.steps += 1;
        progress.common_updates += mesh.cells() as u64;
        if self.clock().is_over() {
            M::whole_step_ended(self);
        }
        Ok(())
    }

    /// Corrects the cells of a group along finer neighbours.
    fn correct(&mut self, group: usize) -> Result<(), M::Error> {
        let Self {
            model, mesh, state, next, levels, reports, interface, progress, prepared, is_suspect, ..
        } = self;
        let (clock, registers) = levels.parts();
        let (time, dt, marks) = (progress.time, clock.length(group), Step::<M, N>::NO_MARKS);
        let context = Step { model: &*model, mesh, old: state, interface, prepared, marks, time, dt };
        let is_due = |slot: usize| clock.group_of(mesh, slot) == group && FluxRegister::is_due(mesh, slot);
        for_some_blocks_lightly(next, &mut reports.pending, is_due, |slot, new, report| {
            let finer = registers.finer_side(clock, mesh.tree().leaves()[slot].level);
            model.correct(&context, finer, slot, new, report);
            look_at(model, std::slice::from_ref(report), is_suspect);
        });
        if !std::mem::take(is_suspect.get_mut()) {
            return Ok(());
        }
        check(model, mesh, next, &reports.pending, (clock.next(), progress.steps + 1))
    }
}

/// Notes whether some of the blocks that these reports are of have to be looked at.
fn look_at<M: Model<N>, const N: usize>(model: &M, reports: &[M::Report], is_suspect: &AtomicBool) {
    if !reports.iter().all(|report| model.is_clean(report)) {
        is_suspect.store(true, Ordering::Relaxed);
    }
}

/// The slots of the blocks that have to be looked at, ascending.
pub(super) fn to_be_looked_at<M: Model<N>, const N: usize>(model: &M, reports: &[M::Report]) -> Vec<usize> {
    let slots = (0..reports.len()).into_par_iter().with_min_len(LOOKS_AT_ONCE);
    slots.filter(|slot| !model.is_clean(&reports[*slot])).collect()
}

/// Fails if a cell of a new state is not admissible.
///
/// - `time`, `step`: of that state.
pub(super) fn check<M: Model<N>, const N: usize>(
    model: &M,
    mesh: &Mesh<N>,
    state: &Field,
    reports: &[M::Report],
    (time, step): (f64, u64),
) -> Result<(), M::Error> {
    for slot in to_be_looked_at(model, reports) {
        let (id, block) = (mesh.tree().leaves()[slot], state.block(slot));
        if let Some(cell) = model.inadmissible_cell(&reports[slot], block) {
            let [z, r] = mesh.centre(id, cell % N, cell / N);
            return Err(model.error(block, cell, Place { z, r, time, step }));
        }
    }
    Ok(())
}

impl<R: Clone + Default> Reports<R> {
    /// Of so many blocks, nothing yet.
    pub(super) fn new(blocks: usize) -> Self {
        Self { finished: vec![R::default(); blocks], pending: Vec::new() }
    }
}
