//! How the solid advances: in steps of the whole grid, or of its levels one by one.
//!
//! A whole step is begun, then made in sub-steps of the finest level; a coarser level starts its own first and is finished when
//! the finer ones have caught up. Without local time steps one sub-step is the whole.

use mesh::{Field, GroupStep, LevelClock, Mesh, Part, for_each_block, for_some_blocks};

use crate::block::{BlockReport, step_block};
use crate::reflux::{self, Register};
use crate::state::component::COUNT;
use crate::{SolidError, SolidSolver};

impl<const N: usize> SolidSolver<N> {
    /// The longest step of a level, s, with c₁ in both directions.
    fn limit_of(&self, level: u8, cfl: f64) -> f64 {
        mesh::longest_step(cfl, self.mesh.widths(level), [self.setup.speeds.c1; 2])
    }

    /// The finest level there is.
    fn finest(&self) -> u8 {
        self.mesh.levels_present()[1]
    }

    /// The largest step that the Courant number allows all cells, s, see [`mesh::longest_step`].
    pub fn time_step_limit(&self, cfl: f64) -> f64 {
        self.limit_of(self.finest(), cfl)
    }

    /// The largest step of the whole that the Courant number allows if each level finer than `base` halves it once more, s.
    pub fn local_step_limit(&self, cfl: f64, base: u8) -> f64 {
        self.limit_of(base.clamp(self.mesh.coarsest_base(), self.finest()), cfl)
    }

    /// The finest level at the surface under the fluid.
    pub fn finest_at_surface(&self) -> u8 {
        self.mesh.finest_among(&self.surface_blocks)
    }

    /// Which levels step when.
    pub fn clock(&self) -> &LevelClock {
        self.levels.clock()
    }

    /// Advances all cells by `dt`. Under a fluid the surface's state must have been set, see
    /// [`SolidSolver::set_surface`].
    ///
    /// - errors: [`SolidError::NotFinite`]; the state before the step is then kept.
    pub fn step(&mut self, dt: f64) -> Result<(), SolidError> {
        self.begin_step(dt, u8::MAX);
        self.sub_step(f64::INFINITY)
    }

    /// Begins a step of length `dt` in which levels finer than `base` make steps of their own.
    pub fn begin_step(&mut self, dt: f64, base: u8) {
        self.levels.begin(&self.mesh, base, self.time, dt, &self.surface_blocks);
    }

    /// Makes the next step of the finest level, and what coarser ones have to do before and after it.
    ///
    /// - `cfl`: bounds the steps of levels within the whole.
    /// - errors: as [`SolidSolver::step`].
    pub fn sub_step(&mut self, cfl: f64) -> Result<(), SolidError> {
        while self.clock().due().is_some() {
            let step = self.start(self.due_limit(cfl));
            self.run(step, Part::All)?;
        }
        self.finish()
    }

    /// The longest step of the group of levels that is due, s.
    pub fn due_limit(&self, cfl: f64) -> f64 {
        let Some(group) = self.clock().due().filter(|_| cfl.is_finite()) else { return cfl };
        let levels = self.mesh.tree().leaves().iter().map(|id| id.level);
        let finest = levels.filter(|level| self.clock().group(*level) == group).max();
        finest.map_or(f64::INFINITY, |level| self.limit_of(level, cfl))
    }

    /// Starts the step of the group of levels that is due, of at most `limit`, see [`LevelClock::start`].
    pub fn start(&mut self, limit: f64) -> GroupStep {
        self.levels.start(limit)
    }

    /// Makes a part of a step that has been started. The parts of group 0 may be made one after the other.
    ///
    /// - errors: as [`SolidSolver::step`].
    pub fn run(&mut self, step: GroupStep, part: Part) -> Result<(), SolidError> {
        let mut target = self.levels.take_target(step.group, &mut self.next);
        let mut pending = std::mem::take(&mut self.pending);
        let mut register = std::mem::replace(&mut self.register, Register::new(0));
        let context = self.context(step.dt);
        let is_due = |slot: usize| {
            let at_interface = self.surface_first[slot] != usize::MAX;
            part.has(at_interface) && self.levels.group_of(&self.mesh, slot) == step.group
        };
        for_each_block(
            &mut target,
            register.values_mut(),
            &mut pending,
            is_due,
            |slot, new, stars, report| {
                *report = self.scratch.with(|scratch| step_block(&context, slot, new, stars, scratch));
            },
        );
        let due = (0..self.mesh.blocks()).filter(|slot| is_due(*slot)).count();
        let checked = check(&self.mesh, &target, &pending, self.time + step.dt, self.steps + 1);
        self.levels.put_target(step.group, &mut self.next, target);
        (self.pending, self.register) = (pending, register);
        checked?;
        self.levels.gather(&self.mesh, &self.register, step.group);
        self.cell_updates += (due * N * N) as u64;
        Ok(())
    }

    /// Ends the present step of the finest level, and those of coarser ones that end with it.
    ///
    /// - errors: as [`SolidSolver::step`].
    pub fn finish(&mut self) -> Result<(), SolidError> {
        let later = self.clock().next();
        for group in (0..self.clock().groups()).rev() {
            if self.clock().end(group) == later {
                self.correct(group)?;
            }
        }
        // In the order of the slots, so that sums do not depend on threads.
        for slot in 0..self.mesh.blocks() {
            if self.clock().end(self.levels.group_of(&self.mesh, slot)) == later {
                let report = self.pending[slot];
                self.reports[slot] = report;
                for (side, [momentum, energy]) in report.inflow.into_iter().enumerate() {
                    self.ledger.momentum[side] += momentum;
                    self.ledger.energy[side] += energy;
                }
                self.sides.take_over(&self.mesh, slot);
            }
        }
        self.levels.turn(&self.mesh, &mut self.state, &mut self.next);
        self.time = later;
        self.steps += 1;
        self.common_updates += self.mesh.cells() as u64;
        Ok(())
    }

    /// Corrects the cells of a group along finer neighbours.
    fn correct(&mut self, group: usize) -> Result<(), SolidError> {
        let mut target = self.levels.take_target(group, &mut self.next);
        let mut pending = std::mem::take(&mut self.pending);
        let context = self.context(self.clock().length(group));
        let (levels, register, mesh) = (&self.levels, &self.register, &self.mesh);
        let is_due = |slot: usize| levels.group_of(mesh, slot) == group && Register::is_due(mesh, slot);
        for_some_blocks(&mut target, &mut pending, is_due, |slot, new, report| {
            let finer = levels.finer_side(mesh, slot, register);
            reflux::correct(&context, register, finer, slot, new, report);
        });
        let checked = check(&self.mesh, &target, &pending, self.clock().next(), self.steps + 1);
        self.levels.put_target(group, &mut self.next, target);
        self.pending = pending;
        checked
    }
}

/// Fails if a number of a new state is not finite; its block's von Mises stress is then infinite.
pub(crate) fn check<const N: usize>(
    mesh: &Mesh<N>,
    state: &Field,
    reports: &[BlockReport],
    time: f64,
    step: u64,
) -> Result<(), SolidError> {
    for (slot, id) in mesh.tree().leaves().iter().enumerate() {
        if reports[slot].mises_squared.is_finite() {
            continue;
        }
        for k in 0..N * N {
            let is_sane = |c: usize| state.component(slot, c)[k].abs() <= f64::MAX.sqrt();
            if !(0..COUNT).all(is_sane) {
                let [z, r] = mesh.centre(*id, k % N, k / N);
                return Err(SolidError::NotFinite { z, r, time, step });
            }
        }
    }
    Ok(())
}
