//! What a tile's blocks tell of the step: its last stage.

use mesh::Side;

use super::TileStep;
use super::scratch::BlockScratch;
use crate::capillarity::cell_at_wall;
use crate::state::primitive::PHI;
use crate::step::report::{BlockReport, SideReport, boundary_inflow, count_kept, far_field_gains};
use crate::step::update::extremes;

impl<const N: usize> TileStep<'_, N> {
    /// The axial momentum and the energy that surface tension has added to the block (per radian).
    fn tension_gains(&self, scratch: &BlockScratch<N>) -> [f64; 2] {
        let BlockScratch { z_faces, r_faces, face_weight, inverse_weight, capillary, .. } = scratch;
        let mut gains = [0.0; 2];
        let metric = self.metric(face_weight, inverse_weight);
        capillary.for_gains(N, &metric, [&z_faces.velocity, &r_faces.velocity], |cell, [axial, _, work]| {
            let volume = self.ctx.mesh.volume(self.id, cell / N);
            gains[0] += volume * axial;
            gains[1] += volume * work;
        });
        gains
    }

    /// What a block tells of the step.
    ///
    /// - arguments: those of [`TileStep::update`].
    pub(super) fn report(
        &self,
        number: usize,
        scratch: &mut BlockScratch<N>,
        new: &[f64],
        report: &mut BlockReport<N>,
    ) {
        let (ctx, slot) = (self.ctx, self.slot + number);
        let (id, at) = (ctx.mesh.tree().leaves()[slot], self.tile.frame_of::<N>(number));
        if !self.all_keep {
            let [fallbacks, halved] = count_kept::<N>(&scratch.keep, at.origin(), at.stride());
            report.fallbacks += fallbacks;
            report.clips.halved_slopes += u64::from(halved);
        }
        if number == 0 {
            report.clips += self.clips;
        }
        let speeds = scratch.speeds.split::<3>().map(|row| &row[..N * N]);
        let [_, _, floor] = speeds;
        report.extremes = extremes(&new[PHI * N * N..(PHI + 1) * N * N], speeds);
        if report.extremes.floor > 0.0 {
            for (cell, added) in floor.iter().enumerate().filter(|(_, added)| **added > 0.0) {
                report.marked.insert(cell);
                report.lift_pressure(*added, ctx.mesh.volume(id, cell / N));
            }
        }
        if scratch.capillary.is_present() {
            for (sum, gain) in report.tension.iter_mut().zip(self.tension_gains(scratch)) {
                *sum += gain;
            }
            if ctx.model.terms.forbids_contact() {
                let found = cell_at_wall(ctx.mesh, slot, ctx.model.analysis.boundaries, new);
                report.contact = found.map(|cell| cell as u32);
            }
        }
        if ctx.model.terms.is_diffusive {
            report.diffusivity = ctx.model.diffusivity::<N>(new);
        }
        if Side::ALL.into_iter().any(|side| ctx.mesh.touches(slot, side)) {
            let sides = report.sides.get_or_insert_default();
            self.report_sides(number, scratch, sides);
        }
    }

    /// What a block that touches sides of the domain tells of them.
    fn report_sides(&self, number: usize, scratch: &BlockScratch<N>, sides: &mut SideReport<N>) {
        let (ctx, slot) = (self.ctx, self.slot + number);
        let at = self.tile.frame_of::<N>(number);
        let BlockScratch { z_faces, r_faces, face_weight, inverse_weight, half, works, .. } = scratch;
        let metric = self.metric_of(number, face_weight, inverse_weight);
        *sides = SideReport {
            inflow: boundary_inflow(ctx, (slot, at), z_faces, r_faces, metric.face_weight),
            impulse: far_field_gains(ctx, (slot, at), half, z_faces, r_faces),
            ..SideReport::default()
        };
        if !ctx.mesh.touches(slot, Side::ZMin) {
            return;
        }
        sides.wall_pressure = std::array::from_fn(|j| z_faces.pressure[at.index(-1, j as isize)]);
        if ctx.model.terms.is_viscous {
            let wall = ctx.interface.states_of::<N>(slot);
            // Through a wall at rest no mass carries any momentum along.
            let of_rest = |j: usize| -z_faces.shear[at.index(-1, j as isize)];
            sides.wall_shear = std::array::from_fn(|j| wall.map_or_else(|| of_rest(j), |wall| wall[j].shear));
        }
        if ctx.model.has_wall()
            && let Some([flux, temperature]) = ctx.model.terms.wall_heat(works, at.len())
        {
            sides.wall_heat.copy_from_slice(flux);
            sides.wall_temperature.copy_from_slice(temperature);
        }
    }
}
