//! Where terms come into a step: of one block, as they are made block by block.

use mesh::{FaceState, TileRows};

use super::TileStep;
use super::scratch::BlockScratch;
use super::stages::block_sides;
use crate::WallHeat;
use crate::capillarity::CapillaryRows;
use crate::reconstruction::Rows;
use crate::state::COUNT;
use crate::state::primitive::PHI;
use crate::step::update::Metric;
use crate::terms::super_stepping::{SpreadBlock, Spreading, View};
use crate::terms::{FinishedCells, HeatBeyond, TermBlock};

impl<const N: usize> TileStep<'_, N> {
    /// The block as terms see it; `rows`: the padded cells as they are to see them, and at the beginning of the step.
    fn term_block<'b>(
        &'b self,
        metric: &'b Metric<'b>,
        inverse_r: &'b [f64],
        [state, before]: [Rows<'b>; 2],
        more: MoreForTerms<'b>,
    ) -> TermBlock<'b> {
        let MoreForTerms { capillary, gas_shares, vapour, wall, wall_temperatures } = more;
        let heat_beyond = match (&self.ctx.model.wall_heat, &self.ctx.model.wall_memory) {
            (WallHeat::Isothermal(temperature), _) => HeatBeyond::Kept(*temperature),
            (_, Some(memory)) => HeatBeyond::Wall {
                temperatures: wall_temperatures,
                resistance: memory.resistance(self.ctx.dt),
            },
            _ => HeatBeyond::Nothing,
        };
        TermBlock {
            cells: N,
            metric,
            inverse_r,
            state,
            before,
            sides: block_sides(self.ctx, self.slot),
            wall: (!wall.is_empty()).then_some(wall),
            capillary,
            gas: self.gas.mass(gas_shares),
            vapour,
            closure: (self.gas.phases().is_some() && self.ctx.model.scheme.phases.has_closure())
                .then_some(&self.ctx.model.mixture),
            heat_beyond,
            spread: View::of(self.ctx.prepared, self.ctx.mesh, self.slot),
        }
    }

    /// The vapour's part of the mass in the padded cells.
    fn vapour_in<'b>(&self, cells: &'b TileRows<N>) -> Option<&'b [f64]> {
        self.ctx.model.exchange.as_ref().map(|exchange| cells.component(exchange.vapour()))
    }

    /// What terms add to the states at mid-step.
    pub(super) fn predict_terms(&self, scratch: &mut BlockScratch<N>) {
        let terms = &self.ctx.model.terms;
        if !terms.is_diffusive {
            return;
        }
        let BlockScratch { cells, half, inverse_r, face_weight, inverse_weight, works, capillary, .. } =
            scratch;
        let BlockScratch { gas_shares, wall, wall_temperatures, .. } = scratch;
        let (metric, rows) = (self.metric(face_weight, inverse_weight), cells.split());
        let vapour = self.vapour_in(cells);
        let more = MoreForTerms { capillary, gas_shares, vapour, wall, wall_temperatures };
        let block = self.term_block(&metric, inverse_r, [rows; 2], more);
        let [_, v_z, v_r, p, _] = half.split_mut::<COUNT>();
        if terms.is_viscous {
            terms.predict(&block, [v_z, v_r], works);
        }
        if terms.conducts {
            terms.predict_pressure(&block, p, works);
        }
    }

    /// Begins what spreads in stages, see [`SpreadBlock::begin`]; the block has been predicted.
    pub(super) fn begin_spreading(
        &self,
        of: &dyn Spreading,
        group: &[bool],
        scratch: &mut BlockScratch<N>,
    ) -> (SpreadBlock, f64) {
        let BlockScratch { cells, half, inverse_r, face_weight, inverse_weight, capillary, .. } = scratch;
        let BlockScratch { gas_shares, wall, wall_temperatures, spread_work, .. } = scratch;
        let metric = self.metric(face_weight, inverse_weight);
        let vapour = self.vapour_in(cells);
        let more = MoreForTerms { capillary, gas_shares, vapour, wall, wall_temperatures };
        let block = self.term_block(&metric, inverse_r, [half.split(), cells.split()], more);
        SpreadBlock::begin(self.slot, of, &block, (self.ctx.mesh, group), spread_work)
    }

    /// What terms add to fluxes and cells.
    pub(super) fn add_to_fluxes(&mut self, scratch: &mut BlockScratch<N>) {
        let BlockScratch { z_faces, r_faces, face_weight, inverse_weight, half, with_sources, .. } = scratch;
        let BlockScratch { cells, inverse_r, works, capillary, gas_shares, .. } = scratch;
        let BlockScratch { wall, wall_temperatures, .. } = scratch;
        let metric = &self.metric(face_weight, inverse_weight);
        let rows = [half.split(), cells.split()];
        let vapour = self.vapour_in(cells);
        let more = MoreForTerms { capillary, gas_shares, vapour, wall, wall_temperatures };
        let block = self.term_block(metric, inverse_r, rows, more);
        with_sources.clear();
        with_sources.extend_from_slice(self.ctx.old.block(self.slot));
        self.clips += self.ctx.model.terms.add(&block, [z_faces, r_faces], works, with_sources);
    }

    /// What terms do to the cells of both phases at the end of the step.
    ///
    /// - returns: the work of surface tension in that, J per radian.
    pub(super) fn finish_terms(&self, scratch: &mut BlockScratch<N>, new: &mut [f64]) -> f64 {
        let BlockScratch { cells, face_weight, inverse_weight, speeds, works, capillary, .. } = scratch;
        let mut cells = FinishedCells {
            cells: N,
            metric: &self.metric(face_weight, inverse_weight),
            phi: cells.component(PHI),
            new,
            speeds: speeds.split_mut::<3>().map(|row| &mut row[..N * N]),
            capillary,
            mixture: &self.ctx.model.mixture,
            volume: &|j| self.ctx.mesh.volume(self.id, j),
            tension_work: 0.0,
        };
        self.ctx.model.terms.finish(&mut cells, works);
        cells.tension_work
    }
}

/// What of the scratch terms need besides.
struct MoreForTerms<'a> {
    capillary: &'a CapillaryRows,
    /// m_g/ρ of the padded cells.
    gas_shares: &'a [f64],
    /// See [`TermBlock::vapour`].
    vapour: Option<&'a [f64]>,
    /// See [`TermBlock::wall`]; empty where there is none.
    wall: &'a [FaceState],
    /// See [`HeatBeyond::Wall`].
    wall_temperatures: &'a [f64],
}
