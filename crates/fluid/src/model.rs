//! What the fluid is to the block solver.

use mesh::{
    BlockSolver, BlockWork, CellBits, Field, FinerSide, Interface, Mesh, Misfit, Model, Place, Remap,
    Reports, Scratches, Side, Tile,
};
use serde::{Deserialize, Serialize};

use crate::analysis::Analysis;
use crate::boundary::far_field::FarFieldMemory;
use crate::boundary::inflow::raise;
use crate::bubble::follow::Following;
use crate::bubble::look::follow_bubble;
use crate::capillarity::cell_at_wall;
use crate::diagnostics::bubbles::follow_sources;
use crate::physics::{Fluid, FluidStep, Tally};
use crate::state::conserved::{PHI, RHO};
use crate::state::finished::{FinishedCell, measure_cell};
use crate::state::{ConservedCell, primitive_of};
use crate::step::clips::{CountedAnalysis, SharedCount};
use crate::step::reflux::{self, QUANTITIES};
use crate::step::report::BlockReport;
use crate::step::update::Extremes;
use crate::step::{BlockScratch, STAGES, begin_spreading, is_one, step_tile};
use crate::terms::diffusion::most_diffusivity;
use crate::terms::super_stepping::{Spread, Spreading, spread_in};
use crate::thermodynamics::temperature::cell_temperature;
use crate::wall_heat::WallMemory;
use crate::{Boundary, BoundaryLedger, Fixups, FluidError, PhaseLedger, WallHeat, near_wall};

/// What of a fluid changes in time besides its cells.
#[derive(Serialize, Deserialize)]
pub struct FluidMemory {
    far: FarFieldMemory,
    fixups: Fixups,
    ledger: BoundaryLedger,
    bubble: Option<Following>,
    phases: PhaseLedger,
    wall: Option<WallMemory>,
}

impl Fluid {
    /// A cell of a block as it is.
    fn measured<const N: usize>(&self, block: &[f64], cell: usize) -> FinishedCell {
        let gas = self.scheme.phases.gas_component().map_or(0.0, |gas| block[gas * N * N + cell]);
        measure_cell(std::array::from_fn(|c| block[c * N * N + cell]), gas, &self.mixture)
    }

    /// The cells of a block that are not physical.
    fn failed_cells<const N: usize>(&self, block: &[f64]) -> impl Iterator<Item = usize> {
        (0..N * N).filter(|cell| !self.measured::<N>(block, *cell).is_admissible())
    }

    /// The largest diffusivity of the terms in a block, m²/s.
    pub(crate) fn diffusivity<const N: usize>(&self, block: &[f64]) -> f64 {
        self.terms.diffusivity(&block[RHO * N * N..][..N * N], &block[PHI * N * N..][..N * N])
    }

    /// How warm the wall on z_min is next to row `j` of a block before anything has passed, K.
    fn wall_temperature<const N: usize>(&self, block: &[f64], j: usize) -> f64 {
        match self.wall_heat {
            WallHeat::Isothermal(temperature) => temperature,
            WallHeat::Conducting(wall) => wall.temperature,
            WallHeat::Adiabatic => {
                let u: ConservedCell = std::array::from_fn(|c| block[c * N * N + j * N]);
                let gas = self.scheme.phases.gas_component().map(|gas| block[gas * N * N + j * N]);
                let [rho, _, _, p, phi] = primitive_of::<true>(u, gas.unwrap_or(0.0), &self.mixture);
                cell_temperature(&self.mixture, [rho, p, phi], gas)
            }
        }
    }

    /// Whether something spreads in a block so far within a step that it takes stages: further than a quarter of what a single one is
    /// stable with. What blocks beside it hold is taken to stay as it is meanwhile, if it does not spread so far in them.
    fn spreads_in_stages<const N: usize>(
        &self,
        of: &dyn Spreading,
        step: &FluidStep<'_, N>,
        slot: usize,
    ) -> bool {
        let inverse_h = step.mesh.widths(step.mesh.tree().leaves()[slot].level).map(|h| 1.0 / h);
        let [density, phi] = [RHO, PHI].map(|component| step.old.component(slot, component));
        of.diffusivity(density, phi) > 0.25 * most_diffusivity(step.dt, inverse_h)
    }

    /// Whether z_min is a wall, rigid or not.
    pub(crate) fn has_wall(&self) -> bool {
        self.boundaries.kind(Side::ZMin).is_wall()
    }
}

/// Whether all cells of a block are physical: else its speed is infinite.
fn is_sane<const N: usize>(report: &BlockReport<N>) -> bool {
    report.extremes.speed_z.is_finite() && report.extremes.speed_r.is_finite()
}

impl<const N: usize> Model<N> for Fluid {
    const NAME: &'static str = "fluid";
    const INTERFACE: Side = Side::ZMin;
    type Analysis = Analysis;
    type Report = BlockReport<N>;
    type Scratch = BlockScratch<N>;
    type Error = FluidError;
    type Memory = FluidMemory;
    type Prepared = Spread;
    const STAGES: &'static [&'static str] = STAGES;
    const RETRIES: bool = true;

    fn analysis(&self) -> &Analysis {
        &self.analysis
    }

    fn registered(&self) -> usize {
        QUANTITIES + self.carried.len()
    }

    fn has_interface(&self) -> bool {
        self.boundaries.kind(Side::ZMin) == Boundary::Interface
    }

    fn watched(&self) -> &[usize] {
        &self.axis_blocks
    }

    fn prepares(&self) -> bool {
        self.terms.spreads
    }

    /// Lets spread in stages what spreads over more than a cell.
    fn prepare(
        &self,
        step: &FluidStep<'_, N>,
        slots: &[usize],
        spread: &mut Spread,
        scratch: Scratches<'_, BlockScratch<N>>,
    ) {
        spread.clear();
        let mut group = vec![false; step.mesh.blocks()];
        slots.iter().for_each(|slot| group[*slot] = true);
        for of in self.terms.spreading() {
            let is_due = |slot: &&usize| self.spreads_in_stages(of, step, **slot);
            let due: Vec<usize> = slots.iter().filter(is_due).copied().collect();
            spread_in(spread, of, step.mesh, &due, step.dt, |slot| {
                scratch.with(|scratch| begin_spreading(step, (slot, &group), of, scratch))
            });
        }
    }

    fn step_block(
        &self,
        step: &FluidStep<'_, N>,
        slot: usize,
        work: BlockWork<'_, BlockScratch<N>>,
    ) -> BlockReport<N> {
        let mut report = [BlockReport::default()];
        step_tile(step, Tile::one(slot), work, &mut report);
        let [report] = report;
        report
    }

    fn step_tile(
        &self,
        step: &FluidStep<'_, N>,
        tile: Tile,
        mut work: BlockWork<'_, BlockScratch<N>>,
        reports: &mut [BlockReport<N>],
    ) {
        if !tile.is_one()
            && is_one(step, tile)
            && let Some(of_four) = &mut work.scratch.of_four
        {
            step_tile(step, tile, BlockWork { scratch: of_four, ..work }, reports);
            return;
        }
        work.each_of(tile, reports, |slot, work, report| {
            step_tile(step, Tile::one(slot), work, std::slice::from_mut(report));
        });
    }

    fn correct(
        &self,
        step: &FluidStep<'_, N>,
        finer: FinerSide<'_, N>,
        slot: usize,
        new: &mut [f64],
        report: &mut BlockReport<N>,
    ) {
        reflux::correct(step, finer, slot, new, report);
    }

    fn measure(&self, mesh: &Mesh<N>, slot: usize, block: &[f64], report: &mut BlockReport<N>) {
        if self.terms.forbids_contact() {
            let found = cell_at_wall(mesh, slot, self.analysis.boundaries, block);
            report.contact = found.map(|cell| cell as u32);
        }
        let mut extremes = Extremes::default();
        (0..N * N).for_each(|cell| extremes.add(&self.measured::<N>(block, cell)));
        report.extremes = extremes;
        report.diffusivity = self.diffusivity::<N>(block);
        if self.terms.conducts && mesh.touches(slot, Side::ZMin) {
            let sides = report.sides.get_or_insert_default();
            sides.wall_temperature = std::array::from_fn(|j| self.wall_temperature::<N>(block, j));
        }
        report.has_gas = self.scheme.phases.has_gas::<N>(block);
    }

    fn signal_speeds(&self, report: &BlockReport<N>) -> [f64; 2] {
        [report.extremes.speed_z, report.extremes.speed_r]
    }

    fn step_limit(&self, report: &BlockReport<N>, widths: [f64; 2]) -> f64 {
        self.terms.step_limit(widths, report.diffusivity)
    }

    fn is_clean(&self, report: &BlockReport<N>) -> bool {
        report.marked.is_empty() && report.contact.is_none() && is_sane(report)
    }

    fn inadmissible_cell(&self, report: &BlockReport<N>, block: &[f64]) -> Option<usize> {
        if is_sane(report) {
            return report.contact.map(|cell| cell as usize);
        }
        self.failed_cells::<N>(block).next()
    }

    fn error(&self, block: &[f64], cell: usize, Place { z, r, time, step }: Place) -> FluidError {
        if self.measured::<N>(block, cell).is_admissible() {
            return FluidError::Contact { z, r, time };
        }
        let [density, _, _, energy, phi] = std::array::from_fn(|c| block[c * N * N + cell]);
        FluidError::NonPhysical { z, r, time, step, density, energy, phi }
    }

    /// Mixed cells of which a phase would be drained, those that the pressure floor would lift, and any that are not physical
    /// any more. What the floor still lifts after all then stays lifted.
    fn cells_to_redo(&self, report: &BlockReport<N>, block: &[f64]) -> CellBits<N> {
        let mut cells = report.marked;
        if !is_sane(report) {
            cells.extend(self.failed_cells::<N>(block));
        }
        cells
    }

    fn note_redone(&self, report: &mut BlockReport<N>, cells: usize, volume: f64) {
        report.redone = cells as u32;
        report.redone_volume = volume;
    }

    fn has_news(&self, _: &Mesh<N>, _: usize, report: &BlockReport<N>) -> bool {
        report.has_news()
    }

    fn account(
        &mut self,
        mesh: &Mesh<N>,
        slot: usize,
        dt: f64,
        report: &BlockReport<N>,
        interface: &Interface,
    ) {
        let Tally { fixups, ledger, phases, .. } = &mut self.tally;
        phases.add(&report.exchange);
        fixups.first_order += u64::from(report.fallbacks);
        fixups.redone += u64::from(report.redone);
        fixups.redone_volume += report.redone_volume;
        fixups.floored_volume += report.floored_volume;
        fixups.floored += u64::from(report.floored);
        fixups.floor_energy += report.floor_energy;
        fixups.gas_mass_added += report.phase_mass_added[0];
        fixups.liquid_mass_added += report.phase_mass_added[1];
        fixups.clips += report.clips;
        let sides = report.sides.as_deref();
        for (side, [mass, momentum, energy, gas_mass]) in sides.iter().flat_map(|s| s.inflow).enumerate() {
            ledger.mass[side] += mass;
            ledger.momentum[side] += momentum;
            ledger.energy[side] += energy;
            ledger.gas_mass[side] += gas_mass;
        }
        ledger.tension_impulse += report.tension[0];
        ledger.tension_work += report.tension[1];
        let id = mesh.tree().leaves()[slot];
        if let Some(sides) = sides.filter(|_| self.terms.conducts && mesh.touches(slot, Side::ZMin)) {
            let h_r = mesh.widths(id.level)[1];
            for (j, flux) in sides.wall_heat.iter().enumerate() {
                ledger.wall_heat += dt * mesh.weight(mesh.centre(id, 0, j)[1]) * h_r * flux;
            }
            if let Some(memory) = &mut self.wall_memory {
                memory.take_from(mesh, id, dt, &sides.wall_heat);
            }
        }
        if let Some(states) = interface.states_of::<N>(slot) {
            let h_r = mesh.widths(id.level)[1];
            for (j, state) in states.iter().enumerate() {
                let area = mesh.weight(mesh.centre(id, 0, j)[1]) * h_r;
                ledger.wall_impulse += dt * area * state.pressure;
                ledger.wall_work += dt * area * state.power;
            }
        }
        for (side, sides) in Side::ALL.into_iter().filter_map(|side| Some((side, sides?))) {
            if self.boundaries.has_far_field(side) && mesh.touches(slot, side) {
                for (along, gain) in sides.impulse[side as usize].0.into_iter().enumerate() {
                    self.far.impulses.add(side, id.level, id.first_face::<N>(side) + along, gain);
                }
            }
        }
    }

    fn reports_changed(&mut self, reports: &Reports<BlockReport<N>>) {
        self.has_gas.clear();
        let both = reports.finished.iter().zip(&reports.pending);
        self.has_gas.extend(both.map(|(finished, pending)| finished.has_gas | pending.has_gas));
    }

    fn mesh_changed(&mut self, mesh: &Mesh<N>) {
        self.axis_blocks = mesh.blocks_on_axis();
    }

    fn demanded_levels(
        &self,
        (mesh, field, time): (&Mesh<N>, &Field, f64),
        base: u8,
        travel: &(dyn Fn(usize) -> f64 + Sync),
    ) -> Vec<u8> {
        let is_near_wall = self.near_wall.levels() > 0 && self.has_wall();
        let of_all = [
            is_near_wall.then(|| {
                near_wall::demanded_levels(&self.near_wall, (mesh, field, &self.mixture), base, travel)
            }),
            self.incoming.as_ref().map(|wave| wave.demanded_levels(mesh, &self.analysis, base, time)),
            Some(self.expected.demanded_levels(mesh, base)),
        ];
        let mut levels = Vec::new();
        for demanded in of_all.into_iter().flatten() {
            raise(&mut levels, demanded);
        }
        levels
    }

    fn finest_for_details(&self, mesh: &Mesh<N>, base: u8) -> u8 {
        self.follower.as_ref().map_or(base, |follower| follower.finest_for_details(mesh, base))
    }

    /// How many predictions are limited is counted.
    fn remap(&mut self, remap: &Remap<'_, N>, _: f64, new: &mut Field) {
        let analysis = CountedAnalysis::new(&self.analysis);
        remap.by(&analysis, new);
        self.tally.fixups.clips.limited_predictions += analysis.limited();
    }

    fn whole_step_ended(solver: &mut BlockSolver<Self, N>) {
        follow_bubble(solver);
        follow_sources(solver);
    }

    fn memory(&self) -> FluidMemory {
        FluidMemory {
            far: self.far.clone(),
            // Those of the traces shown are among them.
            fixups: self.tally.all_fixups(),
            ledger: self.tally.ledger,
            bubble: self.follower.as_ref().map(|follower| follower.now.clone()),
            phases: self.tally.phases,
            wall: self.wall_memory.clone(),
        }
    }

    fn restore(&mut self, memory: FluidMemory) -> Result<(), Misfit> {
        let FluidMemory { far, fixups, ledger, bubble, phases, wall } = memory;
        if !far.impulses.fits(&self.far.impulses) {
            return Err(Misfit("the far field's faces are not those of the fluid's sides".to_owned()));
        }
        match (&mut self.follower, bubble) {
            (Some(own), Some(saved)) => own.now = saved,
            (None, None) => {}
            _ => return Err(Misfit("only one of both follows a bubble".to_owned())),
        }
        match (&mut self.wall_memory, wall) {
            (Some(own), Some(saved)) if own.fits(&saved) => *own = saved,
            (None, None) => {}
            _ => return Err(Misfit("the wall does not conduct heat alike".to_owned())),
        }
        self.far = far;
        self.tally = Tally { fixups, ledger, phases, scaled_traces: SharedCount::default() };
        Ok(())
    }
}
