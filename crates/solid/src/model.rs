//! What the solid is to the block solver.

use mesh::{BlockWork, Field, FinerSide, Interface, Mesh, Misfit, Model, Place, Remap, Reports, Side, Tile};
use serde::{Deserialize, Serialize};

use crate::analysis::Analysis;
use crate::boundary::absorbing::SideFilters;
use crate::components::admissible::Admissible;
use crate::components::following::{Following, SavedFollowing};
use crate::physics::{Solid, SolidStep, Ways};
use crate::step::plastic::{measure_flow, return_block};
use crate::step::reflux::{self, QUANTITIES};
use crate::step::report::{BlockReport, PlasticReport, report_stresses};
use crate::step::{BlockScratch, STAGES, can_be_swept, step_block, step_tile};
use crate::{Boundary, BoundaryLedger, PlasticLedger, SolidError};

/// What of a solid changes in time besides its cells.
#[derive(Serialize, Deserialize)]
pub struct SolidMemory {
    sides: [SideFilters; 4],
    ledger: BoundaryLedger,
    plastic: PlasticLedger,
    following: Option<SavedFollowing>,
}

impl<const N: usize> Model<N> for Solid {
    const NAME: &'static str = "solid";
    const INTERFACE: Side = Side::ZMax;
    type Analysis = Analysis;
    type Report = BlockReport;
    type Scratch = BlockScratch<N>;
    type Error = SolidError;
    type Prepared = ();
    type Memory = SolidMemory;
    const STAGES: &'static [&'static str] = STAGES;

    fn analysis(&self) -> &Analysis {
        &self.analysis
    }

    fn registered(&self) -> usize {
        QUANTITIES
    }

    fn has_interface(&self) -> bool {
        self.boundaries.kind(Side::ZMax) == Boundary::Interface
    }

    fn step_block(
        &self,
        step: &SolidStep<'_, N>,
        slot: usize,
        mut work: BlockWork<'_, BlockScratch<N>>,
    ) -> BlockReport {
        let mut report = [BlockReport::default()];
        let tile = Tile::one(slot);
        if self.ways.has_sweeps && can_be_swept(step, tile) && step_tile(step, tile, &mut work, &mut report) {
            let [report] = report;
            return report;
        }
        step_block(step, slot, work)
    }

    fn step_tile(
        &self,
        step: &SolidStep<'_, N>,
        tile: Tile,
        mut work: BlockWork<'_, BlockScratch<N>>,
        reports: &mut [BlockReport],
    ) {
        let Ways { has_tiles, has_sweeps } = self.ways;
        let is_one = !tile.is_one() && has_tiles && has_sweeps && can_be_swept(step, tile);
        if !(is_one && step_tile(step, tile, &mut work, reports)) {
            work.each_of(tile, reports, |slot, work, report| *report = self.step_block(step, slot, work));
        }
    }

    fn correct(
        &self,
        step: &SolidStep<'_, N>,
        finer: FinerSide<'_, N>,
        slot: usize,
        new: &mut [f64],
        report: &mut BlockReport,
    ) {
        reflux::correct(step, finer, slot, new, report);
    }

    fn measure(&self, mesh: &Mesh<N>, slot: usize, block: &[f64], report: &mut BlockReport) {
        report_stresses(mesh, slot, block, self.yield_squared(), report);
        measure_flow::<N>(block, &mut report.plastic);
    }

    fn signal_speeds(&self, _: &BlockReport) -> [f64; 2] {
        [self.setup.speeds.c1; 2]
    }

    fn step_limit(&self, _: &BlockReport, widths: [f64; 2]) -> f64 {
        self.terms.step_limit(widths)
    }

    fn is_clean(&self, report: &BlockReport) -> bool {
        report.mises_squared.is_finite()
    }

    fn inadmissible_cell(&self, report: &BlockReport, block: &[f64]) -> Option<usize> {
        if report.mises_squared.is_finite() {
            return None;
        }
        let is_sane =
            |cell: usize| block.iter().skip(cell).step_by(N * N).all(|w| w.abs() <= f64::MAX.sqrt());
        (0..N * N).find(|cell| !is_sane(*cell))
    }

    fn error(&self, _: &[f64], _: usize, Place { z, r, time, step }: Place) -> SolidError {
        SolidError::NotFinite { z, r, time, step }
    }

    fn has_news(&self, mesh: &Mesh<N>, slot: usize, report: &BlockReport) -> bool {
        report.plastic.has_flow() || Side::ALL.into_iter().any(|side| mesh.touches(slot, side))
    }

    fn account(&mut self, mesh: &Mesh<N>, slot: usize, _: f64, report: &BlockReport, _: &Interface) {
        for (side, [momentum, energy]) in report.inflow.into_iter().enumerate() {
            self.ledger.momentum[side] += momentum;
            self.ledger.energy[side] += energy;
        }
        self.plastic.take(&report.plastic);
        self.sides.take_over(mesh, slot);
    }

    /// What can yield stays within its yield surface, see `Admissible`; what rounding and laws that soften by heat leave outside
    /// is returned, and counted.
    fn remap(&mut self, remap: &Remap<'_, N>, time: f64, new: &mut Field) {
        let Some(plasticity) = &self.plasticity else { return remap.by(&self.analysis, new) };
        let adapted = remap.adapted;
        if let Some(following) = &mut self.following {
            following.remap(adapted, (remap.mesh, remap.field), &self.analysis, time);
        }
        remap.by(&Admissible { analysis: &self.analysis, plasticity }, new);
        for slot in adapted.fresh() {
            let mut report = PlasticReport::default();
            let id = adapted.mesh.tree().leaves()[slot];
            report.corrected =
                return_block(plasticity, &adapted.mesh, id, new.block_mut(slot), None, &mut report).cells;
            self.plastic.take(&report);
        }
    }

    fn reports_changed(&mut self, reports: &Reports<BlockReport>) {
        let Some(plasticity) = &self.plasticity else { return };
        let cold = plasticity.reference();
        let yielded = |report: &BlockReport| report.plastic.strain > 0.0 || report.plastic.temperature > cold;
        let Reports { finished, pending, .. } = reports;
        let of_slot = |(slot, report)| yielded(report) || pending.get(slot).is_some_and(yielded);
        self.untouched.take(finished.iter().enumerate().map(of_slot));
    }

    fn demanded_levels(
        &self,
        (mesh, _, time): (&Mesh<N>, &Field, f64),
        base: u8,
        _: &(dyn Fn(usize) -> f64 + Sync),
    ) -> Vec<u8> {
        self.setup.demanded_levels(mesh, base, time)
    }

    fn mesh_changed(&mut self, mesh: &Mesh<N>) {
        self.untouched.mesh_changed(mesh.blocks());
    }

    fn memory(&self) -> SolidMemory {
        let following = self.following.as_ref().map(Following::saved);
        SolidMemory {
            sides: self.sides.kept().clone(),
            ledger: self.ledger,
            plastic: self.plastic,
            following,
        }
    }

    fn restore(&mut self, memory: SolidMemory) -> Result<(), Misfit> {
        let SolidMemory { sides, ledger, plastic, following } = memory;
        if !self.sides.restore(sides) {
            return Err(Misfit("what absorbing sides remember is not of the solid's sides".to_owned()));
        }
        match (&mut self.following, following) {
            (Some(own), Some(saved)) => own.restore(&saved, self.untouched.blocks())?,
            (None, None) => {}
            _ => return Err(Misfit("only one of both can yield".to_owned())),
        }
        (self.ledger, self.plastic) = (ledger, plastic);
        Ok(())
    }
}
