//! One MUSCL-Hancock step of one block: the algorithm, part by part.

use mesh::{Field, Limiter, Mesh, Padded, Patch, Side, limited_differences};

use crate::analysis::Analysis;
use crate::boundary::{Boundaries, WallState};
use crate::reflux::register_fluxes;
use crate::rows::{self, FaceRows, Reconstruction};
use crate::state::conserved::COUNT;
use crate::update::{Extremes, Metric, update};
use crate::{Boundary, Mixture, RiemannSolver};

/// What all blocks of a step share.
pub(crate) struct StepContext<'a, const N: usize> {
    pub mesh: &'a Mesh<N>,
    pub mixture: &'a Mixture,
    pub analysis: &'a Analysis,
    pub limiter: Limiter,
    pub riemann: RiemannSolver,
    pub boundaries: &'a Boundaries,
    /// The state at the beginning of the step.
    pub old: &'a Field,
    /// Time at the beginning of the step, s.
    pub time: f64,
    pub dt: f64,
    /// The faces of the wall to the solid in the order of r, and each block's first one.
    pub wall: &'a [WallState],
    pub wall_first: &'a [usize],
}

/// Scratch of one thread.
pub(crate) struct BlockScratch<const N: usize> {
    pub cells: Padded<N>,
    pub patch: Patch<N>,
    pub s_z: Padded<N>,
    pub s_r: Padded<N>,
    pub half: Padded<N>,
    pub keep: Vec<f64>,
    pub inverse_r: Vec<f64>,
    z_faces: FaceRows,
    r_faces: FaceRows,
    speeds: Padded<N>,
    face_weight: Vec<f64>,
    inverse_weight: Vec<f64>,
}

impl<const N: usize> BlockScratch<N> {
    pub fn new() -> Self {
        let len = Padded::<N>::LEN;
        Self {
            cells: Padded::zeros(COUNT),
            patch: Patch::zeros(COUNT),
            s_z: Padded::zeros(COUNT),
            s_r: Padded::zeros(COUNT),
            half: Padded::zeros(COUNT),
            keep: vec![0.0; len],
            inverse_r: vec![0.0; len],
            z_faces: FaceRows::zeros(len),
            r_faces: FaceRows::zeros(len),
            speeds: Padded::zeros(3),
            face_weight: vec![0.0; N + 1],
            inverse_weight: vec![0.0; N],
        }
    }
}

/// What one block tells of its step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BlockReport<const N: usize> {
    pub extremes: Extremes,
    /// Cells that fell back to first order.
    pub fallbacks: u32,
    /// Cells lifted to the pressure floor, and the energy that took (per radian in axial symmetry), J.
    pub floored: u32,
    pub floor_energy: f64,
    /// What came in through each side of the domain: mass, axial momentum, energy (per radian).
    pub inflow: [[f64; 3]; 4],
    /// Pressure on the faces of z_min, Pa; 0 in blocks that do not touch it.
    pub wall_pressure: [f64; N],
}

impl<const N: usize> Default for BlockReport<N> {
    fn default() -> Self {
        Self {
            extremes: Extremes::default(),
            fallbacks: 0,
            floored: 0,
            floor_energy: 0.0,
            inflow: [[0.0; 3]; 4],
            wall_pressure: [0.0; N],
        }
    }
}

/// Assembles a block with its ghosts and reconstructs it: primitive variables in `cells`, limited
/// differences in `s_z`, `s_r`.
pub(crate) fn reconstruct<const N: usize>(
    ctx: &StepContext<'_, N>,
    slot: usize,
    scratch: &mut BlockScratch<N>,
) {
    let BlockScratch { cells, patch, s_z, s_r, inverse_r, .. } = scratch;
    cells.assemble(ctx.mesh, ctx.old, slot, ctx.analysis, patch);
    rows::to_primitive(cells.split_mut(), ctx.mixture);
    ctx.boundaries.fill_ghosts(ctx.mesh, slot, cells);
    for component in 0..COUNT {
        limited_differences(
            ctx.limiter,
            cells.component(component),
            Padded::<N>::STRIDE,
            s_z.component_mut(component),
            s_r.component_mut(component),
        );
    }
    let id = ctx.mesh.tree().leaves()[slot];
    ctx.mesh.inverse_radii(id, inverse_r);
}

/// Advances one block by one step from `ctx.old` into `new`; `fluxes` is its part of the flux register.
pub(crate) fn step_block<const N: usize>(
    ctx: &StepContext<'_, N>,
    slot: usize,
    new: &mut [f64],
    fluxes: &mut [f64],
    scratch: &mut BlockScratch<N>,
) -> BlockReport<N> {
    let stride = Padded::<N>::STRIDE;
    let id = ctx.mesh.tree().leaves()[slot];
    let [h_z, h_r] = ctx.mesh.widths(id.level);
    let inverse_h = [1.0 / h_z, 1.0 / h_r];

    reconstruct(ctx, slot, scratch);
    rows::predict(
        scratch.cells.split(),
        scratch.s_z.split(),
        scratch.s_r.split(),
        &scratch.inverse_r,
        inverse_h,
        0.5 * ctx.dt,
        stride,
        ctx.mixture,
        scratch.half.split_mut(),
        &mut scratch.keep,
    );
    ctx.boundaries.impose_outer(
        ctx.mesh,
        slot,
        ctx.time + 0.5 * ctx.dt,
        ctx.mixture,
        &mut scratch.half,
        &mut scratch.keep,
    );

    let [rho, v_z, v_r, p, phi] = scratch.half.split::<COUNT>();
    let [d_rho, d_v_z, d_v_r, d_p, d_phi] = scratch.s_z.split::<COUNT>();
    let along_z = Reconstruction {
        half: [rho, v_z, v_r, p, phi],
        differences: [d_rho, d_v_z, d_v_r, d_p, d_phi],
        keep: &scratch.keep,
    };
    let z_range = Padded::<N>::index(-1, 0)..Padded::<N>::index(N as isize - 1, N as isize - 1) + 1;
    faces(ctx, &along_z, 1, z_range, &mut scratch.z_faces);
    if ctx.boundaries.kind(Side::ZMin) == Boundary::Interface && ctx.mesh.touches(slot, Side::ZMin) {
        let first = ctx.wall_first[slot];
        Boundaries::impose_wall::<N>(
            &ctx.wall[first..first + N],
            &along_z,
            ctx.mixture,
            &mut scratch.z_faces,
        );
    }

    let [d_rho, d_v_z, d_v_r, d_p, d_phi] = scratch.s_r.split::<COUNT>();
    let along_r = Reconstruction {
        half: [rho, v_r, v_z, p, phi],
        differences: [d_rho, d_v_r, d_v_z, d_p, d_phi],
        keep: &scratch.keep,
    };
    let r_range = Padded::<N>::index(0, -1)..Padded::<N>::index(N as isize - 1, N as isize - 1) + 1;
    faces(ctx, &along_r, stride, r_range, &mut scratch.r_faces);

    register_fluxes(ctx.mesh, slot, &scratch.z_faces, &scratch.r_faces, fluxes);
    let r_low = ctx.mesh.origin(id)[1];
    for (j, weight) in scratch.face_weight.iter_mut().enumerate() {
        *weight = ctx.mesh.weight(r_low + j as f64 * h_r);
    }
    for (j, inverse) in scratch.inverse_weight.iter_mut().enumerate() {
        *inverse = 1.0 / ctx.mesh.weight(ctx.mesh.centre(id, 0, j)[1]);
    }
    let metric = Metric {
        n: N,
        stride,
        origin: Padded::<N>::index(0, 0),
        inverse_h,
        face_weight: &scratch.face_weight,
        inverse_weight: &scratch.inverse_weight,
    };
    let old = ctx.old.block(slot);
    let [speed_z, speed_r, floor] = scratch.speeds.split_mut::<3>().map(|row| &mut row[..N * N]);
    let extremes = update(
        std::array::from_fn(|c| &old[c * N * N..(c + 1) * N * N]),
        &scratch.z_faces,
        &scratch.r_faces,
        ctx.dt,
        &metric,
        ctx.mixture,
        split_block::<N>(new),
        [speed_z, speed_r, floor],
    );

    let mut report = BlockReport { extremes, ..BlockReport::default() };
    report.fallbacks = count_fallbacks::<N>(&scratch.keep);
    if extremes.floor > 0.0 {
        let floor = scratch.speeds.component(2);
        for j in 0..N {
            for added in floor[j * N..(j + 1) * N].iter().filter(|added| **added > 0.0) {
                report.floored += 1;
                report.floor_energy += added * ctx.mesh.volume(id, j);
            }
        }
    }
    if ctx.mesh.touches(slot, Side::ZMin) {
        for (j, pressure) in report.wall_pressure.iter_mut().enumerate() {
            *pressure = scratch.z_faces.pressure[Padded::<N>::index(-1, j as isize)];
        }
    }
    report.inflow = boundary_inflow(ctx, slot, &scratch.z_faces, &scratch.r_faces, &scratch.face_weight);
    report
}

/// The components of one block of a field.
pub(crate) fn split_block<const N: usize>(block: &mut [f64]) -> [&mut [f64]; COUNT] {
    let mut rows = block.chunks_exact_mut(N * N);
    std::array::from_fn(|_| rows.next().expect("a block has that many components"))
}

fn faces<const N: usize>(
    ctx: &StepContext<'_, N>,
    cells: &Reconstruction<'_>,
    step: usize,
    range: std::ops::Range<usize>,
    faces: &mut FaceRows,
) {
    match ctx.riemann {
        RiemannSolver::Hllc => rows::hllc_faces(cells, step, range, ctx.mixture, faces),
        RiemannSolver::Exact => {
            // Only the faces that are used: what lies between the rows of a block may be no state at all.
            for k in range.filter(|k| used_face::<N>(*k, step)) {
                let (left, right) = (cells.face_state(k, 1.0), cells.face_state(k + step, -1.0));
                faces.set(k, crate::godunov::flux_exact(left, right, ctx.mixture));
            }
        }
    }
}

/// Whether the face above cell `k` (along z for step 1, else along r) bounds a cell of the block.
fn used_face<const N: usize>(k: usize, step: usize) -> bool {
    let (i, j) = (k % Padded::<N>::STRIDE, k / Padded::<N>::STRIDE);
    let inner = mesh::GHOSTS..mesh::GHOSTS + N;
    let faces = mesh::GHOSTS - 1..mesh::GHOSTS + N;
    if step == 1 {
        faces.contains(&i) && inner.contains(&j)
    } else {
        inner.contains(&i) && faces.contains(&j)
    }
}

fn count_fallbacks<const N: usize>(keep: &[f64]) -> u32 {
    let mut dropped = 0;
    for j in 0..N {
        let at = Padded::<N>::index(0, j as isize);
        dropped += keep[at..at + N].iter().filter(|share| **share == 0.0).count() as u32;
    }
    dropped
}

/// Mass, axial momentum and energy that a block took in through the sides of the domain.
fn boundary_inflow<const N: usize>(
    ctx: &StepContext<'_, N>,
    slot: usize,
    z_faces: &FaceRows,
    r_faces: &FaceRows,
    face_weight: &[f64],
) -> [[f64; 3]; 4] {
    let mut inflow = [[0.0; 3]; 4];
    let id = ctx.mesh.tree().leaves()[slot];
    let [h_z, h_r] = ctx.mesh.widths(id.level);
    for side in Side::ALL {
        if !ctx.mesh.touches(slot, side) {
            continue;
        }
        let total = &mut inflow[side as usize];
        for along in 0..N {
            let [mass, momentum, energy] = match side {
                Side::ZMin | Side::ZMax => {
                    let i = if side == Side::ZMin { -1 } else { N as isize - 1 };
                    let k = Padded::<N>::index(i, along as isize);
                    let area = ctx.mesh.weight(ctx.mesh.centre(id, 0, along)[1]) * h_r;
                    let momentum = z_faces.mass[k] * z_faces.velocity[k] + z_faces.pressure[k];
                    [area * z_faces.mass[k], area * momentum, area * z_faces.energy[k]]
                }
                Side::RMin | Side::RMax => {
                    let j = if side == Side::RMin { -1 } else { N as isize - 1 };
                    let k = Padded::<N>::index(along as isize, j);
                    let area = face_weight[(j + 1) as usize] * h_z;
                    [area * r_faces.mass[k], area * r_faces.shear[k], area * r_faces.energy[k]]
                }
            };
            let sign = if matches!(side, Side::ZMin | Side::RMin) { ctx.dt } else { -ctx.dt };
            total[0] += sign * mass;
            total[1] += sign * momentum;
            total[2] += sign * energy;
        }
    }
    inflow
}
