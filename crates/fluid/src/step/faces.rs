//! The Riemann problems on the faces of a block.

use mesh::Frame;

use super::TileStep;
use super::scratch::BlockScratch;
use crate::RiemannSolver;
use crate::boundary::Boundaries;
use crate::capillarity::FaceJumps;
use crate::physics::FluidStep;
use crate::reconstruction::Reconstruction;
use crate::reconstruction::dispersion::AlongFaces;
use crate::riemann::exact_rows::exact_faces;
use crate::riemann::godunov::flux_exact;
use crate::riemann::hllc::flux_and_roots;
use crate::riemann::hllc_rows::{has_roots, hllc_faces};
use crate::state::COUNT;
use crate::state::primitive::{PRESSURE, V_R, V_Z};
use crate::step::face_rows::{FaceRows, used_face};
use crate::two_phase::FaceState;

impl<const N: usize> TileStep<'_, N> {
    /// Fluxes through all faces: HLLC or exact between pure cells, the mixed cells' own, and those that the state of the wall to
    /// another medium makes.
    pub(super) fn solve_faces(&mut self, scratch: &mut BlockScratch<N>) {
        let ctx = self.ctx;
        let (frame, last) = (self.frame, self.frame.cells() as isize - 1);
        let stride = frame.stride();
        let BlockScratch {
            half,
            s_z,
            s_r,
            keep,
            sound,
            gas_shares,
            inverse_r,
            gas,
            capillary,
            used_faces,
            z_faces,
            r_faces,
            ..
        } = scratch;
        if self.gas.is_present() {
            z_faces.with_gas();
            r_faces.with_gas();
        }
        let [rho, v_z, v_r, p, phi] = half.split::<COUNT>();
        let [d_rho, d_v_z, d_v_r, d_p, d_phi] = s_z.split::<COUNT>();
        let along_z = Reconstruction {
            half: [rho, v_z, v_r, p, phi],
            differences: [d_rho, d_v_z, d_v_r, d_p, d_phi],
            keep,
            sound,
            gas_shares,
            with_gas: self.gas.is_present(),
            dispersion: ctx.model.dispersion(ctx.mesh.widths(self.id.level), ctx.dt, 0),
            along_faces: AlongFaces::new([V_Z, PRESSURE].map(|c| s_r.component(c)), stride),
        };
        let z_range = frame.index(-1, 0)..frame.index(last, last) + 1;
        // A tile of four does not touch the interface.
        let wall = ctx.interface.states_of::<N>(self.slot);
        let replaced = wall.map(|_| mesh::GHOSTS - 1);
        self.clips.clipped_roots =
            faces(ctx, &along_z, Faces { frame, step: 1, used: &used_faces[0] }, z_range, replaced, z_faces);
        if let Some(block) = self.gas.phases() {
            block.solve_faces(0, &along_z, inverse_r, capillary.along::<N>(0), gas, z_faces);
        }
        if let Some(jumps) = capillary.along::<N>(0) {
            faces_with_jumps(ctx, frame, &along_z, jumps, z_faces);
        }
        if let Some(wall) = wall {
            Boundaries::impose_wall(wall, frame, &along_z, &ctx.model.mixture, z_faces);
        }

        let [d_rho, d_v_z, d_v_r, d_p, d_phi] = s_r.split::<COUNT>();
        let along_r = Reconstruction {
            half: [rho, v_r, v_z, p, phi],
            differences: [d_rho, d_v_r, d_v_z, d_p, d_phi],
            dispersion: ctx.model.dispersion(ctx.mesh.widths(self.id.level), ctx.dt, 1),
            along_faces: AlongFaces::new([V_R, PRESSURE].map(|c| s_z.component(c)), 1),
            ..along_z
        };
        let r_range = frame.index(0, -1)..frame.index(last, last) + 1;
        self.clips.clipped_roots +=
            faces(ctx, &along_r, Faces { frame, step: stride, used: &used_faces[1] }, r_range, None, r_faces);
        if let Some(block) = self.gas.phases() {
            block.solve_faces(1, &along_r, inverse_r, capillary.along::<N>(1), gas, r_faces);
        }
        if let Some(jumps) = capillary.along::<N>(1) {
            faces_with_jumps(ctx, frame, &along_r, jumps, r_faces);
        }
        if let Some(block) = self.gas.phases() {
            block.gas_fluxes(gas, gas_shares, [z_faces, r_faces]);
        }
    }
}

/// Faces of a tile along z or r.
#[derive(Clone, Copy)]
struct Faces<'a> {
    frame: Frame,
    /// Distance of the cells on both sides: 1 or that of the rows.
    step: usize,
    /// See [`crate::step::face_rows::used_faces`].
    used: &'a [f64],
}

/// Solves the faces of a tile along z or r.
///
/// - `replaced`: the column of padded cells whose upper faces get other fluxes.
/// - returns: at how many of the faces that count HLLC's sound speed was bounded.
fn faces<const N: usize>(
    ctx: &FluidStep<'_, N>,
    cells: &Reconstruction<'_>,
    Faces { frame, step, used }: Faces<'_>,
    range: std::ops::Range<usize>,
    replaced: Option<usize>,
    faces: &mut FaceRows,
) -> u64 {
    match ctx.model.scheme.riemann {
        riemann @ (RiemannSolver::Hllc | RiemannSolver::HllcLowMach) => {
            let (stride, mixture) = (frame.stride(), &ctx.model.mixture);
            let is_low_mach = riemann == RiemannSolver::HllcLowMach;
            if hllc_faces(cells, step, stride, range.clone(), mixture, is_low_mach, faces) {
                return 0;
            }
            let counts = |k: &usize| {
                used_face(frame, *k, step)
                    && replaced != Some(*k % stride)
                    && !(cells.is_own(*k) || cells.is_own(*k + step))
            };
            range.filter(counts).filter(|k| !has_roots(cells, *k, step, mixture)).count() as u64
        }
        RiemannSolver::Exact => {
            exact_faces(cells, step, frame.stride(), range, used, &ctx.model.mixture, faces);
            0
        }
    }
}

/// Solves the faces again that a jump of pressure lies on between cells that the kernels serve: in the paper's mixture all, in the
/// five-equation model those between traces in the outermost cells of an interface.
fn faces_with_jumps<const N: usize>(
    ctx: &FluidStep<'_, N>,
    frame: Frame,
    cells: &Reconstruction<'_>,
    jumps: FaceJumps<'_>,
    faces: &mut FaceRows,
) {
    let mixture = &ctx.model.mixture;
    let solve = |[lower, upper]: [FaceState; 2]| {
        let shares = [lower.gas_share, upper.gas_share];
        match ctx.model.scheme.riemann {
            RiemannSolver::Hllc => flux_and_roots::<true, false>(lower.w, upper.w, shares, mixture).0,
            RiemannSolver::HllcLowMach => flux_and_roots::<true, true>(lower.w, upper.w, shares, mixture).0,
            RiemannSolver::Exact => flux_exact(lower.w, upper.w, shares, mixture),
        }
    };
    let step = jumps.step;
    let is_own = |k: usize| cells.is_own(k) || cells.is_own(k + step);
    for k in (0..frame.len() - step).filter(|k| jumps.has(*k) && used_face(frame, *k, step) && !is_own(*k)) {
        let states = [(k, 1.0), (k + step, -1.0)].map(|(k, sign)| FaceState {
            w: cells.face_state(k, sign),
            // Without masses of their own phases have no covolumes, and it is without a say.
            gas_share: if ctx.model.analysis.has_phases { cells.gas_shares[k] } else { 0.0 },
        });
        let solution = solve(jumps.level(k, states, mixture));
        faces.set(k, jumps.settle(k, &states, solution, mixture));
    }
}
