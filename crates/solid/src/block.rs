//! One MUSCL-Hancock step of one block: the algorithm, part by part.

use mesh::{Mesh, Padded, Patch, Side, curvature_share, limited_differences, maximum};
use serde::{Deserialize, Serialize};

use crate::boundary::Boundaries;
use crate::model::{Solid, SolidStep};
use crate::predictor::{ALONG_R, ALONG_Z, Predictor, predict};
use crate::reflux::register_stars;
use crate::rows::{self, Elasticity, FaceRows, Reconstruction};
use crate::state::component::{COUNT, S_NORMAL, S_PHIPHI, V_R};
use crate::update::{Metric, update};

impl Solid {
    /// For the faces normal to an axis (0: z, 1: r) of a block of a level, in a step of length `dt`.
    pub(crate) fn curvature<const N: usize>(
        &self,
        mesh: &Mesh<N>,
        dt: f64,
        level: u8,
        axis: usize,
    ) -> [f64; 2] {
        let per_speed = dt / mesh.widths(level)[axis];
        let Elasticity { inverse_density, z1, z2, .. } = self.elasticity;
        [z1, z2].map(|impedance| curvature_share(per_speed * inverse_density * impedance))
    }
}

/// Scratch of one thread.
pub struct BlockScratch<const N: usize> {
    pub(crate) cells: Padded<N>,
    pub(crate) patch: Patch<N>,
    pub(crate) s_z: Padded<N>,
    pub(crate) s_r: Padded<N>,
    half: Padded<N>,
    pub(crate) inverse_r: Vec<f64>,
    z_faces: FaceRows,
    r_faces: FaceRows,
}

impl<const N: usize> BlockScratch<N> {
    pub(crate) fn new() -> Self {
        let len = Padded::<N>::LEN;
        Self {
            cells: Padded::zeros(COUNT),
            patch: Patch::zeros(COUNT),
            s_z: Padded::zeros(COUNT),
            s_r: Padded::zeros(COUNT),
            half: Padded::zeros(COUNT),
            inverse_r: vec![0.0; len],
            z_faces: FaceRows::zeros(len, Padded::<N>::STRIDE),
            r_faces: FaceRows::zeros(len, Padded::<N>::STRIDE),
        }
    }
}

/// What one block tells of its step.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct BlockReport {
    /// Largest squared von Mises stress, Pa²; infinite if a number is not finite.
    pub(crate) mises_squared: f64,
    /// Volume in which the yield strength is exceeded (per radian).
    pub(crate) yielded: f64,
    /// What came in through each side of the domain: axial momentum, energy (per radian).
    pub(crate) inflow: [[f64; 2]; 4],
}

/// Assembles a block with its ghosts: the state in `cells`.
fn assemble<const N: usize>(ctx: &SolidStep<'_, N>, slot: usize, scratch: &mut BlockScratch<N>) {
    let BlockScratch { cells, patch, inverse_r, .. } = scratch;
    cells.assemble(ctx.mesh, ctx.old, slot, &ctx.model.analysis, patch);
    ctx.model.boundaries.fill_ghosts(ctx.mesh, slot, cells);
    ctx.mesh.inverse_radii(ctx.mesh.tree().leaves()[slot], inverse_r);
}

/// Assembles a block with its ghosts and reconstructs it: the state in `cells`, limited differences in `s_z`, `s_r`.
/// A step makes the differences together with the state at mid-step instead.
pub(crate) fn reconstruct<const N: usize>(
    ctx: &SolidStep<'_, N>,
    slot: usize,
    scratch: &mut BlockScratch<N>,
) {
    assemble(ctx, slot, scratch);
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

/// Advances one block by one step from `ctx.old` into `new`; `stars` is its part of the flux register.
pub(crate) fn step_block<const N: usize>(
    ctx: &SolidStep<'_, N>,
    slot: usize,
    new: &mut [f64],
    stars: &mut [f64],
    scratch: &mut BlockScratch<N>,
) -> BlockReport {
    let stride = Padded::<N>::STRIDE;
    let id = ctx.mesh.tree().leaves()[slot];
    let inverse_h = ctx.mesh.widths(id.level).map(|h| 1.0 / h);

    assemble(ctx, slot, scratch);
    let predictor = Predictor {
        limiter: ctx.model.setup.limiter,
        stride,
        inverse_h,
        inverse_r: &scratch.inverse_r,
        half_dt: 0.5 * ctx.dt,
    };
    let [z0, z1, z2, z3, _, _] = scratch.s_z.split_mut::<COUNT>();
    let [r0, r1, _, r3, r4, _] = scratch.s_r.split_mut::<COUNT>();
    predict(
        scratch.cells.split(),
        predictor,
        &ctx.model.elasticity,
        [z0, z1, z2, z3],
        [r0, r1, r3, r4],
        scratch.half.split_mut(),
    );
    ctx.mesh.look_ahead(ctx.old, slot, new, 0, 3);
    let BlockScratch { cells, half, s_z, s_r, .. } = scratch;
    ctx.model.boundaries.impose_outer(ctx, slot, cells, half, s_z, s_r);
    let surface = ctx.interface.states_of::<N>(slot);
    if surface.is_some() {
        Boundaries::complete_shear_differences(ctx.model.setup.limiter, &scratch.half, &mut scratch.s_z);
    }

    let [v_z, v_r, zz, zr, rr, _] = scratch.half.split::<COUNT>();
    let differences = scratch.s_z.split::<COUNT>();
    let curvature = ctx.model.curvature(ctx.mesh, ctx.dt, id.level, 0);
    let along_z =
        Reconstruction { half: [v_z, v_r, zz, zr], differences: ALONG_Z.map(|c| differences[c]), curvature };
    let z_range = Padded::<N>::index(-1, 0)..Padded::<N>::index(N as isize - 1, N as isize - 1) + 1;
    rows::faces(&along_z, 1, stride, z_range, &ctx.model.elasticity, &mut scratch.z_faces);
    if let Some(surface) = surface {
        Boundaries::impose_surface::<N>(surface, &along_z, &ctx.model.elasticity, &mut scratch.z_faces);
    }

    ctx.mesh.look_ahead(ctx.old, slot, new, 1, 3);
    let differences = scratch.s_r.split::<COUNT>();
    let [d_vz, d_vr, d_zr, d_rr] = ALONG_R.map(|c| differences[c]);
    let curvature = ctx.model.curvature(ctx.mesh, ctx.dt, id.level, 1);
    let along_r =
        Reconstruction { half: [v_r, v_z, rr, zr], differences: [d_vr, d_vz, d_rr, d_zr], curvature };
    let r_range = Padded::<N>::index(0, -1)..Padded::<N>::index(N as isize - 1, N as isize - 1) + 1;
    rows::faces(&along_r, stride, stride, r_range, &ctx.model.elasticity, &mut scratch.r_faces);

    ctx.mesh.look_ahead(ctx.old, slot, new, 2, 3);
    register_stars(ctx.mesh, slot, &scratch.z_faces, &scratch.r_faces, stars);
    let metric =
        Metric { stride, origin: Padded::<N>::index(0, 0), inverse_h, inverse_r: &scratch.inverse_r };
    let old = ctx.old.block(slot);
    let largest = update::<N>(
        std::array::from_fn(|c| &old[c * N * N..(c + 1) * N * N]),
        &scratch.z_faces,
        &scratch.r_faces,
        [V_R, S_NORMAL[1], S_PHIPHI].map(|c| scratch.half.component(c)),
        ctx.dt,
        &metric,
        &ctx.model.elasticity,
        split_block::<N>(new),
    );
    BlockReport {
        mises_squared: largest,
        yielded: yielded_volume(ctx.mesh, slot, new, largest, ctx.model.yield_squared()),
        inflow: boundary_inflow(ctx, slot, &scratch.z_faces, &scratch.r_faces),
    }
}

/// Reports the von Mises stresses of a block anew.
///
/// - `yield_squared`: squared yield strength, Pa².
pub(crate) fn report_stresses<const N: usize>(
    mesh: &Mesh<N>,
    slot: usize,
    block: &[f64],
    yield_squared: f64,
    report: &mut BlockReport,
) {
    report.mises_squared = largest_mises::<N>(block);
    report.yielded = yielded_volume(mesh, slot, block, report.mises_squared, yield_squared);
}

/// The largest squared von Mises stress of a block, infinite if one is not a number.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
fn largest_mises<const N: usize>(block: &[f64]) -> f64 {
    let mut largest = [0.0_f64; N];
    for j in 0..N {
        for (largest, squared) in largest.iter_mut().zip(mises_of_row::<N>(block, j)) {
            let squared = if squared <= f64::MAX { squared } else { f64::INFINITY };
            *largest = largest.max(squared);
        }
    }
    maximum(&largest)
}

/// The squared von Mises stresses of the cells in a row of a block.
#[inline(always)]
fn mises_of_row<const N: usize>(block: &[f64], j: usize) -> [f64; N] {
    let [zz, zr, rr, pp] = [2, 3, 4, 5].map(|c| row::<N>(&block[(c * N + j) * N..]));
    std::array::from_fn(|i| crate::yield_criterion::von_mises_squared(zz[i], zr[i], rr[i], pp[i]))
}

/// The first N numbers of a row.
fn row<const N: usize>(numbers: &[f64]) -> &[f64; N] {
    numbers.first_chunk().expect("rows are whole")
}

/// The components of one block of a field.
pub(crate) fn split_block<const N: usize>(block: &mut [f64]) -> [&mut [f64]; COUNT] {
    let mut rows = block.chunks_exact_mut(N * N);
    std::array::from_fn(|_| rows.next().expect("a block has that many components"))
}

/// The volume in which the yield strength is exceeded (per radian).
///
/// - `largest`: squared von Mises stress of the block, Pa².
fn yielded_volume<const N: usize>(
    mesh: &Mesh<N>,
    slot: usize,
    block: &[f64],
    largest: f64,
    yield_squared: f64,
) -> f64 {
    if largest <= yield_squared {
        return 0.0;
    }
    let id = mesh.tree().leaves()[slot];
    let cells_of_row =
        |j| mises_of_row::<N>(block, j).into_iter().filter(|mises| *mises > yield_squared).count();
    (0..N).map(|j| cells_of_row(j) as f64 * mesh.volume(id, j)).sum()
}

/// Axial momentum and energy that a block took in through the sides of the domain.
fn boundary_inflow<const N: usize>(
    ctx: &SolidStep<'_, N>,
    slot: usize,
    z_faces: &FaceRows,
    r_faces: &FaceRows,
) -> [[f64; 2]; 4] {
    let mut inflow = [[0.0; 2]; 4];
    let id = ctx.mesh.tree().leaves()[slot];
    let [h_z, h_r] = ctx.mesh.widths(id.level);
    let r_low = ctx.mesh.origin(id)[1];
    for side in Side::ALL {
        if !ctx.mesh.touches(slot, side) {
            continue;
        }
        let outward = if matches!(side, Side::ZMin | Side::RMin) { -1.0 } else { 1.0 };
        let total = &mut inflow[side as usize];
        for along in 0..N {
            let [traction_z, power, area] = match side {
                Side::ZMin | Side::ZMax => {
                    let i = if side == Side::ZMin { -1 } else { N as isize - 1 };
                    let k = Padded::<N>::index(i, along as isize);
                    let area = ctx.mesh.weight(ctx.mesh.centre(id, 0, along)[1]) * h_r;
                    [z_faces.s_nn[k], power(z_faces, k), area]
                }
                Side::RMin | Side::RMax => {
                    let j = if side == Side::RMin { -1 } else { N as isize - 1 };
                    let k = Padded::<N>::index(along as isize, j);
                    let area = ctx.mesh.weight(r_low + (j + 1) as f64 * h_r) * h_z;
                    [r_faces.s_nt[k], power(r_faces, k), area]
                }
            };
            total[0] += outward * ctx.dt * area * traction_z;
            total[1] += outward * ctx.dt * area * power;
        }
        if side == Side::ZMax
            && let Some(surface) = ctx.interface.states_of::<N>(slot)
        {
            // The mean of the product, not the product of the means, is what the fluid gave.
            total[1] = -(surface.iter().enumerate())
                .map(|(j, s)| ctx.mesh.weight(ctx.mesh.centre(id, 0, j)[1]) * h_r * s.power)
                .sum::<f64>()
                * ctx.dt;
        }
    }
    inflow
}

/// Power of the traction on a face with outward normal along the axis, W/m².
fn power(faces: &FaceRows, k: usize) -> f64 {
    faces.s_nn[k] * faces.v_n[k] + faces.s_nt[k] * faces.v_t[k]
}
