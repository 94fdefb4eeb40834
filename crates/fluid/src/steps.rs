//! How the fluid advances: in steps of the whole grid, or of its levels one by one.
//!
//! A whole step is begun, then made in sub-steps of the finest level; a coarser level starts its own first and is finished when
//! the finer ones have caught up. Without local time steps one sub-step is the whole.

use mesh::{Field, GroupStep, LevelClock, MOST_HALVINGS, Mesh, Part, Side, for_each_block, for_some_blocks};

use crate::block::{Marks, StepContext, step_block};
use crate::five_equation::marked_blocks;
use crate::reflux::{self, Register};
use crate::report::BlockReport;
use crate::state::conserved::COUNT;
use crate::{FluidError, FluidSolver, Mixture, Primitive};

impl<const N: usize> FluidSolver<N> {
    /// The largest |v| + c along z and r, m/s.
    pub fn largest_speeds(&self) -> [f64; 2] {
        self.reports.iter().fold([0.0_f64; 2], |[z, r], report| {
            [z.max(report.extremes.speed_z), r.max(report.extremes.speed_r)]
        })
    }

    /// The longest step of the block in `slot`, s.
    fn limit_of(&self, slot: usize, cfl: f64) -> f64 {
        let widths = self.mesh.widths(self.mesh.tree().leaves()[slot].level);
        let extremes = &self.reports[slot].extremes;
        mesh::longest_step(cfl, widths, [extremes.speed_z, extremes.speed_r])
    }

    /// The largest step that the Courant number allows all cells, s, see [`mesh::longest_step`].
    pub fn time_step_limit(&self, cfl: f64) -> f64 {
        (0..self.mesh.blocks()).fold(f64::INFINITY, |limit, slot| limit.min(self.limit_of(slot, cfl)))
    }

    /// The largest step of the whole that the Courant number allows if each level finer than `base` halves it once more, s.
    pub fn local_step_limit(&self, cfl: f64, base: u8) -> f64 {
        let leaves = self.mesh.tree().leaves();
        let (mut limit, mut shortest) = (f64::INFINITY, f64::INFINITY);
        for (slot, id) in leaves.iter().enumerate() {
            let own = self.limit_of(slot, cfl);
            shortest = shortest.min(own);
            limit = limit.min(own * f64::from(1_u32 << id.level.saturating_sub(base).min(MOST_HALVINGS)));
        }
        limit.min(shortest * f64::from(1_u32 << MOST_HALVINGS))
    }

    /// The finest level at the wall to the solid.
    pub fn finest_at_wall(&self) -> u8 {
        self.mesh.finest_among(&self.wall_blocks)
    }

    /// Which levels step when.
    pub fn clock(&self) -> &LevelClock {
        self.levels.clock()
    }

    /// Advances all cells by `dt`. With a solid behind z_min the wall's state must have been set, see
    /// [`FluidSolver::set_wall`].
    ///
    /// - errors: [`FluidError::NonPhysical`]; the state before the step is then kept.
    pub fn step(&mut self, dt: f64) -> Result<(), FluidError> {
        self.begin_step(dt, u8::MAX);
        self.sub_step(f64::INFINITY)
    }

    /// Begins a step of length `dt` in which levels finer than `base` make steps of their own.
    pub fn begin_step(&mut self, dt: f64, base: u8) {
        let watched = self.wall_blocks.iter().chain(&self.axis_blocks);
        self.levels.begin(&self.mesh, base, self.time, dt, watched);
    }

    /// Makes the next step of the finest level, and what coarser ones have to do before and after it.
    ///
    /// - `cfl`: bounds the steps of levels within the whole.
    /// - errors: as [`FluidSolver::step`].
    pub fn sub_step(&mut self, cfl: f64) -> Result<(), FluidError> {
        while self.clock().due().is_some() {
            let step = self.start(self.due_limit(cfl));
            self.run(step, Part::All)?;
        }
        self.finish()
    }

    /// The longest step of the group of levels that is due, s.
    pub fn due_limit(&self, cfl: f64) -> f64 {
        let Some(group) = self.clock().due().filter(|_| cfl.is_finite()) else { return cfl };
        (0..self.mesh.blocks())
            .filter(|slot| self.levels.group_of(&self.mesh, *slot) == group)
            .fold(f64::INFINITY, |limit, slot| limit.min(self.limit_of(slot, cfl)))
    }

    /// Starts the step of the group of levels that is due, of at most `limit`, see [`LevelClock::start`].
    pub fn start(&mut self, limit: f64) -> GroupStep {
        self.levels.start(limit)
    }

    /// Makes a part of a step that has been started. The parts of group 0 may be made one after the other.
    ///
    /// - errors: as [`FluidSolver::step`].
    pub fn run(&mut self, step: GroupStep, part: Part) -> Result<(), FluidError> {
        let mut target = self.levels.take_target(step.group, &mut self.next);
        let mut pending = std::mem::take(&mut self.pending);
        let mut register = std::mem::replace(&mut self.register, Register::new(0));
        let context = self.context(step.dt);
        let is_due = |slot: usize| {
            let at_interface = self.wall_first[slot] != usize::MAX;
            part.has(at_interface) && self.levels.group_of(&self.mesh, slot) == step.group
        };
        for_each_block(
            &mut target,
            register.values_mut(),
            &mut pending,
            is_due,
            |slot, new, fluxes, report| {
                *report = self.scratch.with(|scratch| step_block(&context, slot, new, fluxes, scratch));
            },
        );
        // A cell that falls back changes what its neighbours get: first all parts must be there.
        let is_whole = part != Part::AwayFromInterface;
        let in_group = |slot: usize| self.levels.group_of(&self.mesh, slot) == step.group;
        if is_whole {
            self.rescue(&context, &mut target, &mut register, &mut pending, in_group);
        }
        let due = (0..self.mesh.blocks()).filter(|slot| is_due(*slot)).count();
        let end = self.time + step.dt;
        let checked = if is_whole {
            check(&self.mesh, &self.mixture, &target, &pending, end, self.steps + 1)
        } else {
            Ok(())
        };
        self.levels.put_target(step.group, &mut self.next, target);
        (self.pending, self.register) = (pending, register);
        checked?;
        self.levels.gather(&self.mesh, &self.register, step.group);
        self.cell_updates += (due * N * N) as u64;
        self.note_gas();
        Ok(())
    }

    /// Does cells again at first order that the step has taken too far: mixed ones of which a phase would be drained, those that
    /// the pressure floor would lift, and any that are not physical any more. Whatever the floor still lifts then stays lifted;
    /// what is still not physical is for [`check`] to find.
    fn rescue(
        &self,
        context: &StepContext<'_, N>,
        next: &mut Field,
        register: &mut Register<N>,
        reports: &mut [BlockReport<N>],
        is_due: impl Fn(usize) -> bool + Sync,
    ) {
        /// The neighbours of a cell at first order may fail in turn.
        const ROUNDS: usize = 4;
        let mut marks = Marks::new();
        for _ in 0..ROUNDS {
            let mut is_new = false;
            for (slot, cell) in self.cells_at_fault(next, reports, &is_due) {
                let known = marks.entry(slot).or_default();
                if !known.contains(&cell) {
                    known.push(cell);
                    is_new = true;
                }
            }
            if !is_new {
                return;
            }
            self.redo(context, &marks, next, register, reports, &is_due);
        }
    }

    /// The cells of blocks that are due which should be done again: those that the blocks have marked, and those that are not
    /// physical.
    fn cells_at_fault(
        &self,
        next: &Field,
        reports: &[BlockReport<N>],
        is_due: impl Fn(usize) -> bool,
    ) -> Vec<(usize, usize)> {
        let has_any = |slot: &usize| {
            let report = &reports[*slot];
            is_due(*slot) && !(report.marked.is_empty() && is_sane(report))
        };
        let of_block = |slot: usize| {
            let failed = |cell: &usize| failed_state::<N>(&self.mixture, next, slot, *cell).is_some();
            let failed = (0..N * N).filter(failed).filter(|_| !is_sane(&reports[slot]));
            reports[slot].marked.cells().chain(failed).map(move |cell| (slot, cell)).collect::<Vec<_>>()
        };
        (0..self.mesh.blocks()).filter(has_any).flat_map(of_block).collect()
    }

    /// Does the blocks around marked cells again, with those cells at first order. Beyond the group's blocks the fluxes are
    /// those of the finer side.
    fn redo(
        &self,
        context: &StepContext<'_, N>,
        marks: &Marks,
        next: &mut Field,
        register: &mut Register<N>,
        reports: &mut [BlockReport<N>],
        is_due: impl Fn(usize) -> bool + Sync,
    ) {
        let context = StepContext { marks, ..*context };
        let around = marked_blocks(&self.mesh, marks);
        let is_around = |slot: usize| is_due(slot) && around.contains(&slot);
        for_each_block(next, register.values_mut(), reports, is_around, |slot, new, fluxes, report| {
            *report = self.scratch.with(|scratch| step_block(&context, slot, new, fluxes, scratch));
        });
        for (slot, cells) in marks {
            let id = self.mesh.tree().leaves()[*slot];
            reports[*slot].redone = cells.len() as u32;
            reports[*slot].redone_volume = cells.iter().map(|cell| self.mesh.volume(id, cell / N)).sum();
        }
    }

    /// Ends the present step of the finest level, and those of coarser ones that end with it.
    ///
    /// - errors: as [`FluidSolver::step`].
    pub fn finish(&mut self) -> Result<(), FluidError> {
        let later = self.clock().next();
        let ended = |clock: &LevelClock, group: usize| clock.end(group) == later;
        for group in (0..self.clock().groups()).rev() {
            if ended(self.clock(), group) {
                self.correct(group)?;
            }
        }
        for slot in 0..self.mesh.blocks() {
            let group = self.levels.group_of(&self.mesh, slot);
            if ended(self.clock(), group) {
                self.account(slot, self.clock().length(group));
            }
        }
        self.levels.turn(&self.mesh, &mut self.state, &mut self.next);
        self.note_gas();
        self.time = later;
        self.steps += 1;
        self.common_updates += self.mesh.cells() as u64;
        if self.clock().is_over() {
            self.follow_sources();
        }
        Ok(())
    }

    /// Corrects the cells of a group along finer neighbours.
    fn correct(&mut self, group: usize) -> Result<(), FluidError> {
        let mut target = self.levels.take_target(group, &mut self.next);
        let mut pending = std::mem::take(&mut self.pending);
        let context = self.context(self.clock().length(group));
        let (levels, register, mesh) = (&self.levels, &self.register, &self.mesh);
        let is_due = |slot: usize| levels.group_of(mesh, slot) == group && Register::is_due(mesh, slot);
        for_some_blocks(&mut target, &mut pending, is_due, |slot, new, report| {
            let finer = levels.finer_side(mesh, slot, register);
            reflux::correct(&context, register, finer, slot, new, report);
        });
        let end = self.clock().next();
        let checked = check(&self.mesh, &self.mixture, &target, &pending, end, self.steps + 1);
        self.levels.put_target(group, &mut self.next, target);
        self.pending = pending;
        checked
    }

    /// Takes over the report of a block's step that has ended: in the order of the slots, so that sums do not depend on
    /// threads.
    fn account(&mut self, slot: usize, dt: f64) {
        let report = self.pending[slot];
        self.reports[slot] = report;
        self.fixups.first_order += u64::from(report.fallbacks);
        self.fixups.redone += u64::from(report.redone);
        self.fixups.redone_volume += report.redone_volume;
        self.fixups.floored_volume += report.floored_volume;
        self.fixups.floored += u64::from(report.floored);
        self.fixups.floor_energy += report.floor_energy;
        self.fixups.gas_mass_added += report.phase_mass_added[0];
        self.fixups.liquid_mass_added += report.phase_mass_added[1];
        self.fixups.clips += report.clips;
        for (side, [mass, momentum, energy]) in report.inflow.into_iter().enumerate() {
            self.ledger.mass[side] += mass;
            self.ledger.momentum[side] += momentum;
            self.ledger.energy[side] += energy;
        }
        let id = self.mesh.tree().leaves()[slot];
        for side in Side::ALL {
            if self.boundaries.has_far_field(side) && self.mesh.touches(slot, side) {
                for (along, gain) in report.impulse[side as usize].0.into_iter().enumerate() {
                    self.impulses.add(side, id.level, id.first_face::<N>(side) + along, gain);
                }
            }
        }
        let first = self.wall_first[slot];
        if first == usize::MAX {
            return;
        }
        let h_r = self.mesh.widths(id.level)[1];
        for j in 0..N {
            let area = self.mesh.weight(self.mesh.centre(id, 0, j)[1]) * h_r;
            let state = self.wall[first + j];
            self.ledger.wall_impulse += dt * area * state.pressure;
            self.ledger.wall_work += dt * area * state.power;
        }
    }
}

/// Whether all cells of a block are physical: else its speed is infinite.
fn is_sane<const N: usize>(report: &BlockReport<N>) -> bool {
    report.extremes.speed_z.is_finite() && report.extremes.speed_r.is_finite()
}

/// The conserved variables of a cell that is not physical.
fn failed_state<const N: usize>(
    mixture: &Mixture,
    state: &Field,
    slot: usize,
    cell: usize,
) -> Option<[f64; COUNT]> {
    let u: [f64; COUNT] = std::array::from_fn(|c| state.component(slot, c)[cell]);
    let w = Primitive::from_conserved(u, mixture);
    let stiffness = mixture.stiffness(w.pressure, w.phi);
    let is_physical = w.density > 0.0 && stiffness >= 0.0 && (stiffness / w.density).is_finite();
    (!is_physical).then_some(u)
}

/// Fails if a cell of a new state is not physical.
pub(crate) fn check<const N: usize>(
    mesh: &Mesh<N>,
    mixture: &Mixture,
    state: &Field,
    reports: &[BlockReport<N>],
    time: f64,
    step: u64,
) -> Result<(), FluidError> {
    for (slot, id) in mesh.tree().leaves().iter().enumerate().filter(|(slot, _)| !is_sane(&reports[*slot])) {
        for cell in 0..N * N {
            if let Some([density, _, _, energy, phi]) = failed_state::<N>(mixture, state, slot, cell) {
                let [z, r] = mesh.centre(*id, cell % N, cell / N);
                return Err(FluidError::NonPhysical { z, r, time, step, density, energy, phi });
            }
        }
    }
    Ok(())
}
