//! What the solid is to the block solver.

use mesh::{BlockWork, Field, FinerSide, Interface, Mesh, Misfit, Model, Place, Remap, Side};
use serde::{Deserialize, Serialize};

use crate::analysis::Analysis;
use crate::boundary::absorbing::SideFilters;
use crate::components::admissible::Admissible;
use crate::physics::{Solid, SolidStep};
use crate::step::plastic::{measure_flow, return_block};
use crate::step::reflux::{self, QUANTITIES};
use crate::step::report::{BlockReport, PlasticReport, report_stresses};
use crate::step::{BlockScratch, STAGES, step_block};
use crate::{Boundary, BoundaryLedger, PlasticLedger, SolidError};

/// What of a solid changes in time besides its cells.
#[derive(Serialize, Deserialize)]
pub struct SolidMemory {
    sides: [SideFilters; 4],
    ledger: BoundaryLedger,
    plastic: PlasticLedger,
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
        work: BlockWork<'_, BlockScratch<N>>,
    ) -> BlockReport {
        step_block(step, slot, work)
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
    fn remap(&mut self, remap: &Remap<'_, N>, new: &mut Field) {
        let Some(plasticity) = &self.plasticity else { return remap.by(&self.analysis, new) };
        remap.by(&Admissible { analysis: &self.analysis, plasticity }, new);
        let adapted = remap.adapted;
        for slot in adapted.fresh() {
            let mut report = PlasticReport::default();
            let id = adapted.mesh.tree().leaves()[slot];
            report.corrected =
                return_block(plasticity, &adapted.mesh, id, new.block_mut(slot), 0.0, &mut report);
            self.plastic.take(&report);
        }
    }

    fn memory(&self) -> SolidMemory {
        SolidMemory { sides: self.sides.kept().clone(), ledger: self.ledger, plastic: self.plastic }
    }

    fn restore(&mut self, SolidMemory { sides, ledger, plastic }: SolidMemory) -> Result<(), Misfit> {
        if !self.sides.restore(sides) {
            return Err(Misfit("what absorbing sides remember is not of the solid's sides".to_owned()));
        }
        (self.ledger, self.plastic) = (ledger, plastic);
        Ok(())
    }
}
