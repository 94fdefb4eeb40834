//! Flux correction at level jumps: the finer side's star states pass for both.

use mesh::{CorrectedFace, FluxRegister, Geometry, Mesh, Side};

use crate::block::{BlockReport, StepContext, report_stresses};
use crate::rows::FaceRows;
use crate::state::component::COUNT;

/// What is registered of a face: v_n, v_t, σ_nn, σ_nt.
pub(crate) const QUANTITIES: usize = 4;

/// The solid's register.
pub(crate) type Register<const N: usize> = FluxRegister<N, QUANTITIES>;

/// Keeps the star states on those sides of a block that meet another level.
pub(crate) fn register_stars<const N: usize>(
    mesh: &Mesh<N>,
    slot: usize,
    z_faces: &FaceRows,
    r_faces: &FaceRows,
    values: &mut [f64],
) {
    Register::<N>::record(mesh, slot, values, |side, k| {
        let faces = if matches!(side, Side::ZMin | Side::ZMax) { z_faces } else { r_faces };
        [faces.v_n[k], faces.v_t[k], faces.s_nn[k], faces.s_nt[k]]
    });
}

/// Corrects the cells of a block along its finer neighbours, after all blocks have made their step; the formulas
/// are those of the update for one face.
pub(crate) fn correct<const N: usize>(
    ctx: &StepContext<'_, N>,
    register: &Register<N>,
    slot: usize,
    new: &mut [f64],
    report: &mut BlockReport,
) {
    let id = ctx.mesh.tree().leaves()[slot];
    let [h_z, h_r] = ctx.mesh.widths(id.level);
    let e = ctx.elasticity;
    register.for_corrected_faces(ctx.mesh, slot, |face| {
        let CorrectedFace { side, outward, cell: [i, j], difference: [v_n, v_t, s_nn, s_nt] } = face;
        let changes: [f64; COUNT] = if matches!(side, Side::ZMin | Side::ZMax) {
            let [v_n, v_t, s_nn, s_nt] = [v_n, v_t, s_nn, s_nt].map(|d| outward * ctx.dt / h_z * d);
            [
                e.inverse_density * s_nn,
                e.inverse_density * s_nt,
                e.p_modulus * v_n,
                e.mu * v_t,
                e.lambda * v_n,
                e.lambda * v_n,
            ]
        } else {
            // Half of the geometric terms stems from either face; planar geometry has none.
            let half = match ctx.mesh.domain().geometry {
                Geometry::Axisymmetric => 0.5 * ctx.dt / ctx.mesh.centre(id, 0, j)[1],
                Geometry::Planar => 0.0,
            };
            let difference = |d: f64| outward * ctx.dt / h_r * d;
            let (radial, hoop) = (difference(v_n), half * v_n);
            [
                e.inverse_density * (difference(s_nt) + half * s_nt),
                e.inverse_density * (difference(s_nn) + half * s_nn),
                e.lambda * (radial + hoop),
                e.mu * difference(v_t),
                e.p_modulus * radial + e.lambda * hoop,
                e.p_modulus * hoop + e.lambda * radial,
            ]
        };
        for (c, change) in changes.into_iter().enumerate() {
            new[(c * N + j) * N + i] += change;
        }
    });
    report_stresses(ctx, slot, new, report);
}
