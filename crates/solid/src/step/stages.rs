//! The stages of a block's step.

use mesh::{Frame, Padded, Tile, dispersion_share, limited_differences};

use super::BlockStep;
use super::scratch::BlockScratch;
use crate::boundary::Boundaries;
use crate::boundary::outer_states::MidStep;
use crate::components::following::Following;
use crate::physics::{Solid, SolidStep};
use crate::reconstruction::predictor::{ALONG_R, ALONG_Z, Predicted, Predictor, predict};
use crate::state::component::{COUNT, S_NORMAL, S_PHIPHI, V_R, V_Z};
use crate::step::reflux::register_stars;
use crate::step::report::{BlockReport, boundary_inflow, yielded_volume};
use crate::step::rows::{self, Elasticity, Reconstruction};
use crate::step::update::{Metric, split_block, update};

impl Solid {
    /// For the faces normal to an axis (0: z, 1: r) of cells of these widths, in a step of length `dt`.
    pub(crate) fn dispersion(&self, widths: [f64; 2], dt: f64, axis: usize) -> [f64; 2] {
        let per_speed = dt / widths[axis];
        let Elasticity { inverse_density, z1, z2, .. } = self.elasticity;
        [z1, z2].map(|impedance| dispersion_share(per_speed * inverse_density * impedance))
    }
}

/// Assembles a tile with its ghosts: the first so many components of the state in `cells`.
pub(super) fn assemble<const N: usize>(
    ctx: &SolidStep<'_, N>,
    tile: Tile,
    components: usize,
    scratch: &mut BlockScratch<N>,
) {
    let BlockScratch { cells, patch, inverse_r, .. } = scratch;
    cells.assemble(components, ctx.mesh, ctx.old, tile, &ctx.model.analysis, patch);
    ctx.model.boundaries.fill_ghosts(ctx.mesh, tile, ctx.model.setup.limiter, cells);
    ctx.mesh.inverse_radii(tile, inverse_r);
}

/// Assembles a block with its ghosts and reconstructs it: the state in `cells`, limited differences in `s_z`, `s_r`.
/// A step makes the differences together with the state at mid-step instead.
pub(crate) fn reconstruct<const N: usize>(
    ctx: &SolidStep<'_, N>,
    slot: usize,
    scratch: &mut BlockScratch<N>,
) {
    assemble(ctx, Tile::one(slot), ctx.old.components(), scratch);
    let BlockScratch { cells, s_z, s_r, .. } = scratch;
    // No derivative of the hoop stress enters.
    for component in 0..S_PHIPHI {
        limited_differences(
            ctx.model.setup.limiter,
            cells.component(component),
            Padded::<N>::STRIDE,
            s_z.component_mut(component),
            s_r.component_mut(component),
        );
    }
}

impl<'a, const N: usize> BlockStep<'a, N> {
    /// The state of the block and its ghosts.
    pub(super) fn assemble(ctx: &'a SolidStep<'a, N>, slot: usize, scratch: &mut BlockScratch<N>) -> Self {
        let is_untouched = ctx.model.is_untouched(ctx.mesh, slot);
        assemble(ctx, Tile::one(slot), if is_untouched { COUNT } else { ctx.old.components() }, scratch);
        Self::of(ctx, slot, is_untouched)
    }

    /// Of a block that has been assembled.
    pub(super) fn of(ctx: &'a SolidStep<'a, N>, slot: usize, is_untouched: bool) -> Self {
        let id = ctx.mesh.tree().leaves()[slot];
        let inverse_h = ctx.mesh.widths(id.level).map(|h| 1.0 / h);
        Self { ctx, slot, id, inverse_h, is_untouched }
    }

    /// Fetches a third of what is needed soon into the cache.
    pub(super) fn look_ahead(&self, new: &[f64], part: usize) {
        let target = if self.is_untouched { &new[..COUNT * N * N] } else { new };
        let following = self.ctx.model.following.as_ref();
        let beside = following.map_or(0, Following::numbers);
        if self.ctx.mesh.look_ahead((self.ctx.old, beside), self.slot, target, part, 3)
            && let Some(following) = following
        {
            following.of_block(self.slot).look_ahead(part, 3);
        }
    }

    /// Limited differences, and the states at mid-step.
    pub(super) fn predict(&self, scratch: &mut BlockScratch<N>) {
        let predictor = Predictor {
            limiter: self.ctx.model.setup.limiter,
            stride: Padded::<N>::STRIDE,
            inverse_h: self.inverse_h,
            inverse_r: &scratch.inverse_r,
            half_dt: 0.5 * self.ctx.dt,
        };
        let [z0, z1, z2, z3, _, _] = scratch.s_z.split_mut::<COUNT>();
        let [r0, r1, _, r3, r4, _] = scratch.s_r.split_mut::<COUNT>();
        let out = Predicted { s_z: [z0, z1, z2, z3], s_r: [r0, r1, r3, r4], half: scratch.half.split_mut() };
        predict(scratch.cells.split(), predictor, &self.ctx.model.elasticity, out);
        if let Some(gain) = self.ctx.model.terms.velocity_gain(0.5 * self.ctx.dt) {
            for (component, gain) in [V_Z, V_R].into_iter().zip(gain) {
                scratch.half.component_mut(component).iter_mut().for_each(|v| *v += gain);
            }
        }
    }

    /// States beyond the sides of the domain, and slopes on the surface under another medium.
    pub(super) fn impose_boundaries(&self, scratch: &mut BlockScratch<N>) {
        let Self { ctx, slot, .. } = *self;
        let BlockScratch { cells, half, s_z, s_r, .. } = scratch;
        let rows = -1..N as isize + 1;
        let [z0, z1, z2, z3, _, _] = s_z.split_mut::<COUNT>();
        let [r0, r1, _, r3, r4, _] = s_r.split_mut::<COUNT>();
        let differences = [[z0, z1, z2, z3], [r0, r1, r3, r4]];
        let mut mid_step = MidStep { first: 0, half: half.split_mut(), differences };
        ctx.model.boundaries.impose_outer(ctx, Tile::one(slot), cells, rows, &mut mid_step);
        if ctx.interface.states_of::<N>(slot).is_some() {
            let limiter = ctx.model.setup.limiter;
            Boundaries::complete_shear_differences(limiter, |c| half.component(c), s_z);
        }
    }

    /// Star states on all faces: the exact solution of the elastic Riemann problem, and what the state of the surface makes.
    ///
    /// - `new`: of the blocks to come, a part is fetched into the cache.
    pub(super) fn solve_faces(&self, scratch: &mut BlockScratch<N>, new: &mut [f64]) {
        let Self { ctx, slot, id, .. } = *self;
        let stride = Padded::<N>::STRIDE;
        let [v_z, v_r, zz, zr, rr, _] = scratch.half.split::<COUNT>();
        let differences = scratch.s_z.split::<COUNT>();
        let dispersion = ctx.model.dispersion(ctx.mesh.widths(id.level), ctx.dt, 0);
        let along_z = Reconstruction {
            half: [v_z, v_r, zz, zr],
            differences: ALONG_Z.map(|c| differences[c]),
            dispersion,
        };
        let z_range = Padded::<N>::index(-1, 0)..Padded::<N>::index(N as isize - 1, N as isize - 1) + 1;
        rows::faces(&along_z, 1, stride, z_range, &ctx.model.elasticity, &mut scratch.z_faces);
        if let Some(surface) = ctx.interface.states_of::<N>(slot) {
            Boundaries::impose_surface::<N>(surface, &along_z, &ctx.model.elasticity, &mut scratch.z_faces);
        }

        self.look_ahead(new, 1);
        let differences = scratch.s_r.split::<COUNT>();
        let [d_vz, d_vr, d_zr, d_rr] = ALONG_R.map(|c| differences[c]);
        let dispersion = ctx.model.dispersion(ctx.mesh.widths(id.level), ctx.dt, 1);
        let along_r =
            Reconstruction { half: [v_r, v_z, rr, zr], differences: [d_vr, d_vz, d_rr, d_zr], dispersion };
        let r_range = Padded::<N>::index(0, -1)..Padded::<N>::index(N as isize - 1, N as isize - 1) + 1;
        rows::faces(&along_r, stride, stride, r_range, &ctx.model.elasticity, &mut scratch.r_faces);
        self.ctx.model.terms.add_to_faces(self.inverse_h, [&mut scratch.z_faces, &mut scratch.r_faces]);
        scratch.sweep.rim.take_block(Frame::of(N), &scratch.z_faces, &scratch.r_faces);
    }

    /// What terms add to the new cells, before they yield.
    pub(super) fn add_sources(&self, new: &mut [f64]) {
        self.ctx.model.terms.add_sources(self.ctx.dt, N * N, new);
    }

    /// What passes to blocks of other levels.
    pub(super) fn register_stars(&self, scratch: &BlockScratch<N>, stars: &mut [f64]) {
        register_stars(self.ctx.mesh, self.slot, [0, 0], &scratch.sweep.rim, stars);
    }

    /// The new cells.
    pub(super) fn update(&self, scratch: &mut BlockScratch<N>, new: &mut [f64], report: &mut BlockReport) {
        let Self { ctx, slot, inverse_h, .. } = *self;
        let metric = Metric {
            stride: Padded::<N>::STRIDE,
            origin: Padded::<N>::index(0, 0),
            inverse_h,
            inverse_r: &scratch.inverse_r,
        };
        let old = ctx.old.block(slot);
        report.mises_squared = update::<N>(
            std::array::from_fn(|c| &old[c * N * N..(c + 1) * N * N]),
            &scratch.z_faces,
            &scratch.r_faces,
            [V_R, S_NORMAL[1], S_PHIPHI].map(|c| scratch.half.component(c)),
            ctx.dt,
            &metric,
            &ctx.model.elasticity,
            split_block::<N>(new),
        );
    }

    /// What the block tells of the step.
    pub(super) fn report(&self, scratch: &BlockScratch<N>, new: &[f64], report: &mut BlockReport) {
        let Self { ctx, slot, .. } = *self;
        report.yielded = yielded_volume(ctx.mesh, slot, new, report.mises_squared, ctx.model.yield_squared());
        report.inflow = boundary_inflow(ctx, slot, [0, 0], &scratch.sweep.rim);
    }
}
