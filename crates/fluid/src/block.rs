//! One MUSCL-Hancock step of one block: the algorithm, part by part.

use mesh::{AlignedRow, Padded, Patch, Side, limited_differences};

use crate::RiemannSolver;
use crate::boundary::Boundaries;
use crate::clips::{Clips, CountedAnalysis};
use crate::curvature::AlongFaces;
use crate::even::{even_slopes, predict_beside_mirrors};
use crate::exact_rows::exact_faces;
use crate::face_rows::FaceRows;
use crate::five_equation::{GasBlock, GasScratch, may_have_gas};
use crate::model::FluidStep;
use crate::predictor::{Predictor, predict};
use crate::reflux::register_fluxes;
use crate::report::{BlockReport, boundary_inflow, count_kept, far_field_gains};
use crate::rows::{self, Reconstruction};
use crate::state::conserved::{COUNT, GAS, PHI};
use crate::update::{Extremes, Metric, update};

/// Scratch of one thread.
pub struct BlockScratch<const N: usize> {
    pub(crate) cells: Padded<N>,
    pub(crate) patch: Patch<N>,
    pub(crate) s_z: Padded<N>,
    pub(crate) s_r: Padded<N>,
    pub(crate) half: Padded<N>,
    pub(crate) keep: AlignedRow,
    /// Sound speeds at the beginning of the step.
    sound: AlignedRow,
    pub(crate) inverse_r: Vec<f64>,
    z_faces: FaceRows,
    r_faces: FaceRows,
    speeds: Padded<N>,
    face_weight: Vec<f64>,
    inverse_weight: Vec<f64>,
    pub(crate) gas: GasScratch,
    /// Whether the rows of the gas fraction may hold anything but zeros.
    has_gas: bool,
}

impl<const N: usize> BlockScratch<N> {
    /// For fields of so many components.
    pub(crate) fn new(components: usize) -> Self {
        let len = Padded::<N>::LEN;
        Self {
            cells: Padded::zeros(components),
            patch: Patch::zeros(components),
            s_z: Padded::zeros(COUNT),
            s_r: Padded::zeros(COUNT),
            half: Padded::zeros(COUNT),
            keep: AlignedRow::zeros(len, Padded::<N>::STRIDE),
            sound: AlignedRow::zeros(len, Padded::<N>::STRIDE),
            inverse_r: vec![0.0; len],
            z_faces: FaceRows::zeros(len, Padded::<N>::STRIDE),
            r_faces: FaceRows::zeros(len, Padded::<N>::STRIDE),
            speeds: Padded::zeros(3),
            face_weight: vec![0.0; N + 1],
            inverse_weight: vec![0.0; N],
            gas: GasScratch::new::<N>(),
            has_gas: false,
        }
    }

    /// There is no gas in the block; most leave it at that.
    fn without_gas(&mut self) {
        if std::mem::take(&mut self.has_gas) {
            for rows in [&mut self.cells, &mut self.s_z, &mut self.s_r, &mut self.half] {
                rows.component_mut(PHI).fill(0.0);
            }
            self.cells.component_mut(GAS).fill(0.0);
        }
        self.z_faces.without_gas();
        self.r_faces.without_gas();
    }
}

/// Assembles a block with its ghosts: primitive variables in `cells`.
///
/// - `with_gas`: whether the gas is looked at; else there is none, neither in the block nor in its neighbours.
/// - returns: how many predictions of ghosts were limited.
fn assemble<const N: usize>(
    ctx: &FluidStep<'_, N>,
    slot: usize,
    with_gas: bool,
    scratch: &mut BlockScratch<N>,
) -> u64 {
    if !with_gas {
        scratch.without_gas();
    }
    scratch.has_gas = with_gas;
    let BlockScratch { cells, patch, inverse_r, .. } = scratch;
    let components = if with_gas { ctx.old.components() } else { PHI };
    let analysis = CountedAnalysis::new(&ctx.model.analysis);
    cells.assemble_first(components, ctx.mesh, ctx.old, slot, &analysis, patch);
    debug_assert!(with_gas || cells.component(PHI).iter().all(|phi| *phi == 0.0), "neighbours have no gas");
    rows::to_primitive(cells.split_mut(), with_gas, &ctx.model.mixture);
    ctx.model.boundaries.fill_ghosts(ctx.mesh, slot, cells);
    let id = ctx.mesh.tree().leaves()[slot];
    ctx.mesh.inverse_radii(id, inverse_r);
    analysis.limited()
}

/// Assembles a block with its ghosts and reconstructs it: primitive variables in `cells`, limited
/// differences in `s_z`, `s_r`. A step makes the differences together with the state at mid-step instead.
pub(crate) fn reconstruct<const N: usize>(
    ctx: &FluidStep<'_, N>,
    slot: usize,
    scratch: &mut BlockScratch<N>,
) {
    assemble(ctx, slot, may_have_gas(ctx, slot), scratch);
    let BlockScratch { cells, s_z, s_r, .. } = scratch;
    for component in 0..COUNT {
        limited_differences(
            if component == PHI { ctx.model.scheme.fraction_limiter() } else { ctx.model.scheme.limiter },
            cells.component(component),
            Padded::<N>::STRIDE,
            s_z.component_mut(component),
            s_r.component_mut(component),
        );
    }
    even_slopes(ctx, slot, scratch);
}

/// Advances one block by one step from `ctx.old` into `new`; `fluxes` is its part of the flux register.
pub(crate) fn step_block<const N: usize>(
    ctx: &FluidStep<'_, N>,
    slot: usize,
    new: &mut [f64],
    fluxes: &mut [f64],
    scratch: &mut BlockScratch<N>,
) -> BlockReport<N> {
    let stride = Padded::<N>::STRIDE;
    let id = ctx.mesh.tree().leaves()[slot];
    let [h_z, h_r] = ctx.mesh.widths(id.level);
    let inverse_h = [1.0 / h_z, 1.0 / h_r];

    let may_have_gas = may_have_gas(ctx, slot);
    let limited_predictions = assemble(ctx, slot, may_have_gas, scratch);
    let gas_block = if may_have_gas { GasBlock::of(ctx, slot, &scratch.cells) } else { None };
    let with_gas = ctx.model.scheme.two_phase.is_none() || gas_block.is_some();
    if !with_gas {
        scratch.without_gas();
    }
    let predictor = Predictor {
        limiter: ctx.model.scheme.limiter,
        fraction_limiter: ctx.model.scheme.fraction_limiter(),
        stride,
        inverse_h,
        inverse_r: &scratch.inverse_r,
        half_dt: 0.5 * ctx.dt,
        with_gas,
        with_mixed: ctx.model.scheme.two_phase.is_none(),
    };
    predict(
        scratch.cells.split(),
        predictor,
        &ctx.model.mixture,
        scratch.s_z.split_mut(),
        scratch.s_r.split_mut(),
        scratch.half.split_mut(),
        &mut scratch.keep,
        &mut scratch.sound,
    );
    even_slopes(ctx, slot, scratch);
    predict_beside_mirrors(ctx, slot, inverse_h, scratch);
    let slopes = [&scratch.s_z, &scratch.s_r];
    ctx.model.boundaries.impose_outer(ctx, slot, slopes, &mut scratch.half, &mut scratch.keep);

    if !ctx.marks.is_empty() {
        at_first_order(ctx, slot, scratch);
    }

    if let Some(block) = &gas_block {
        block.collect(scratch);
    }

    let [rho, v_z, v_r, p, phi] = scratch.half.split::<COUNT>();
    let [d_rho, d_v_z, d_v_r, d_p, d_phi] = scratch.s_z.split::<COUNT>();
    let along_z = Reconstruction {
        half: [rho, v_z, v_r, p, phi],
        differences: [d_rho, d_v_z, d_v_r, d_p, d_phi],
        keep: &scratch.keep,
        sound: &scratch.sound,
        with_gas,
        curvature: ctx.model.curvature(ctx.mesh, ctx.dt, id.level, 0),
        along_faces: AlongFaces::new([1, 3].map(|c| scratch.s_r.component(c)), stride),
    };
    let z_range = Padded::<N>::index(-1, 0)..Padded::<N>::index(N as isize - 1, N as isize - 1) + 1;
    let wall = ctx.interface.states_of::<N>(slot);
    let replaced = wall.map(|_| mesh::GHOSTS - 1);
    let mut clipped_roots = faces(ctx, &along_z, 1, z_range, replaced, &mut scratch.z_faces);
    if let Some(block) = &gas_block {
        block.solve_faces(0, &along_z, &scratch.inverse_r, &mut scratch.gas, &mut scratch.z_faces);
    }
    if let Some(wall) = wall {
        Boundaries::impose_wall::<N>(wall, &along_z, &ctx.model.mixture, &mut scratch.z_faces);
    }

    let [d_rho, d_v_z, d_v_r, d_p, d_phi] = scratch.s_r.split::<COUNT>();
    let along_r = Reconstruction {
        half: [rho, v_r, v_z, p, phi],
        differences: [d_rho, d_v_r, d_v_z, d_p, d_phi],
        keep: &scratch.keep,
        sound: &scratch.sound,
        with_gas,
        curvature: ctx.model.curvature(ctx.mesh, ctx.dt, id.level, 1),
        along_faces: AlongFaces::new([2, 3].map(|c| scratch.s_z.component(c)), 1),
    };
    let r_range = Padded::<N>::index(0, -1)..Padded::<N>::index(N as isize - 1, N as isize - 1) + 1;
    clipped_roots += faces(ctx, &along_r, stride, r_range, None, &mut scratch.r_faces);
    if let Some(block) = &gas_block {
        block.solve_faces(1, &along_r, &scratch.inverse_r, &mut scratch.gas, &mut scratch.r_faces);
        block.gas_fluxes(&mut scratch.gas, [&mut scratch.z_faces, &mut scratch.r_faces]);
    }

    register_fluxes(ctx.mesh, slot, &scratch.z_faces, &scratch.r_faces, fluxes);
    let r_low = ctx.mesh.origin(id)[1];
    for (j, weight) in scratch.face_weight.iter_mut().enumerate() {
        *weight = ctx.mesh.weight(r_low + j as f64 * h_r);
    }
    for (j, inverse) in scratch.inverse_weight.iter_mut().enumerate() {
        *inverse = 1.0 / ctx.mesh.weight(ctx.mesh.centre(id, 0, j)[1]);
    }
    let metric = Metric {
        stride,
        origin: Padded::<N>::index(0, 0),
        inverse_h,
        face_weight: &scratch.face_weight,
        inverse_weight: &scratch.inverse_weight,
    };
    let old = ctx.old.block(slot);
    let old_rows: [&[f64]; COUNT] = std::array::from_fn(|c| &old[c * N * N..(c + 1) * N * N]);
    let mut speeds = scratch.speeds.split_mut::<3>().map(|row| &mut row[..N * N]);
    let [speed_z, speed_r, floor] = &mut speeds;
    update::<N>(
        old_rows,
        &scratch.z_faces,
        &scratch.r_faces,
        ctx.dt,
        &metric,
        with_gas,
        &ctx.model.mixture,
        split_block::<N>(new),
        [speed_z, speed_r, floor],
    );

    let [fallbacks, halved] = count_kept::<N>(&scratch.keep);
    let clips =
        Clips { halved_slopes: u64::from(halved), limited_predictions, clipped_roots, ..Clips::default() };
    let mut report = BlockReport { fallbacks, clips, ..BlockReport::default() };
    if let Some(block) = &gas_block {
        let faces = [&scratch.z_faces, &scratch.r_faces];
        let pressure = scratch.cells.component(3);
        block.update(
            &mut scratch.gas,
            old_rows,
            pressure,
            faces,
            &metric,
            &scratch.inverse_r,
            new,
            &mut speeds,
            &mut report,
        );
    } else if !with_gas {
        new[PHI * N * N..].fill(0.0);
    }
    let [speed_z, speed_r, floor] = &speeds;
    report.extremes = Extremes::of(&new[PHI * N * N..(PHI + 1) * N * N], [speed_z, speed_r, floor]);
    if report.extremes.floor > 0.0 {
        for (cell, added) in floor.iter().enumerate().filter(|(_, added)| **added > 0.0) {
            report.marked.insert(cell);
            report.lift_pressure(*added, ctx.mesh.volume(id, cell / N));
        }
    }
    if ctx.mesh.touches(slot, Side::ZMin) {
        for (j, pressure) in report.wall_pressure.iter_mut().enumerate() {
            *pressure = scratch.z_faces.pressure[Padded::<N>::index(-1, j as isize)];
        }
    }
    report.inflow = boundary_inflow(ctx, slot, &scratch.z_faces, &scratch.r_faces, &scratch.face_weight);
    report.impulse = far_field_gains(ctx, slot, &scratch.half, &scratch.z_faces, &scratch.r_faces);
    report
}

/// Takes the marked cells' means for the states on their faces.
fn at_first_order<const N: usize>(ctx: &FluidStep<'_, N>, slot: usize, scratch: &mut BlockScratch<N>) {
    let BlockScratch { cells, half, keep, gas, .. } = scratch;
    for k in gas.mark(ctx.mesh, slot, ctx.marks) {
        keep[k] = 0.0;
        for component in 0..COUNT {
            half.component_mut(component)[k] = cells.component(component)[k];
        }
    }
}

/// The first components of one block of a field.
pub(crate) fn split_block<const N: usize>(block: &mut [f64]) -> [&mut [f64]; COUNT] {
    let mut rows = block.chunks_exact_mut(N * N);
    std::array::from_fn(|_| rows.next().expect("a block has that many components"))
}

/// Solves the faces of a block along z (`step` 1) or r.
///
/// - `replaced`: the column of padded cells whose upper faces get other fluxes.
/// - returns: at how many of the faces that count HLLC's sound speed was bounded.
fn faces<const N: usize>(
    ctx: &FluidStep<'_, N>,
    cells: &Reconstruction<'_>,
    step: usize,
    range: std::ops::Range<usize>,
    replaced: Option<usize>,
    faces: &mut FaceRows,
) -> u64 {
    match ctx.model.scheme.riemann {
        RiemannSolver::Hllc => {
            let has_all =
                rows::hllc_faces(cells, step, Padded::<N>::STRIDE, range.clone(), &ctx.model.mixture, faces);
            if has_all {
                return 0;
            }
            // Mixed cells of the five-equation model have states and fluxes of their own: their share is −0.
            let is_own = |k: usize| cells.keep[k].to_bits() >> 63 == 1;
            let counts = |k: &usize| {
                used_face::<N>(*k, step)
                    && replaced != Some(*k % Padded::<N>::STRIDE)
                    && !(is_own(*k) || is_own(*k + step))
            };
            range.filter(counts).filter(|k| !rows::has_roots(cells, *k, step, &ctx.model.mixture)).count()
                as u64
        }
        RiemannSolver::Exact => {
            let stride = Padded::<N>::STRIDE;
            exact_faces(cells, step, stride, range, used_face::<N>, &ctx.model.mixture, faces);
            0
        }
    }
}

/// Whether the face above cell `k` (along z for step 1, else along r) bounds a cell of the block.
pub(crate) fn used_face<const N: usize>(k: usize, step: usize) -> bool {
    let (i, j) = (k % Padded::<N>::STRIDE, k / Padded::<N>::STRIDE);
    let inner = mesh::GHOSTS..mesh::GHOSTS + N;
    let faces = mesh::GHOSTS - 1..mesh::GHOSTS + N;
    if step == 1 {
        faces.contains(&i) && inner.contains(&j)
    } else {
        inner.contains(&i) && faces.contains(&j)
    }
}
