//! Flux correction at level jumps: the finer side's star states pass for both.

use mesh::{FluxRegister, Mesh, Padded, Side};

use crate::block::{BlockReport, StepContext, report_stresses};
use crate::rows::FaceRows;
use crate::state::component::COUNT;

/// What is registered of a face: v_n, v_t, σ_nn, σ_nt.
pub(crate) const QUANTITIES: usize = 4;

/// The solid's register.
pub(crate) type Register<const N: usize> = FluxRegister<N, QUANTITIES>;

/// The outer face of a side, as the flat index of the cell below it.
fn face<const N: usize>(side: Side, along: usize) -> usize {
    let (n, along) = (N as isize, along as isize);
    match side {
        Side::ZMin => Padded::<N>::index(-1, along),
        Side::ZMax => Padded::<N>::index(n - 1, along),
        Side::RMin => Padded::<N>::index(along, -1),
        Side::RMax => Padded::<N>::index(along, n - 1),
    }
}

/// Keeps the star states on those sides of a block that meet another level.
pub(crate) fn register_stars<const N: usize>(
    mesh: &Mesh<N>,
    slot: usize,
    z_faces: &FaceRows,
    r_faces: &FaceRows,
    values: &mut [f64],
) {
    for side in Side::ALL {
        if !Register::<N>::is_needed(mesh, slot, side) {
            continue;
        }
        let faces = if matches!(side, Side::ZMin | Side::ZMax) { z_faces } else { r_faces };
        let rows = Register::<N>::rows(values, side);
        for along in 0..N {
            let k = face::<N>(side, along);
            for (quantity, row) in [&faces.v_n, &faces.v_t, &faces.s_nn, &faces.s_nt].into_iter().enumerate()
            {
                rows[quantity * N + along] = row[k];
            }
        }
    }
}

/// Whether a block has finer neighbours beside it.
pub(crate) fn is_due<const N: usize>(mesh: &Mesh<N>, slot: usize) -> bool {
    Side::ALL.into_iter().any(|side| Register::<N>::is_corrected(mesh, slot, side))
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
    for side in Side::ALL {
        if !Register::<N>::is_corrected(ctx.mesh, slot, side) {
            continue;
        }
        let sign = if matches!(side, Side::ZMin | Side::RMin) { -1.0 } else { 1.0 };
        for along in 0..N {
            let (i, j) = match side {
                Side::ZMin => (0, along),
                Side::ZMax => (N - 1, along),
                Side::RMin => (along, 0),
                Side::RMax => (along, N - 1),
            };
            let [v_n, v_t, s_nn, s_nt] = register.difference(ctx.mesh, slot, side, along);
            let changes = if matches!(side, Side::ZMin | Side::ZMax) {
                let [v_n, v_t, s_nn, s_nt] = [v_n, v_t, s_nn, s_nt].map(|d| sign * ctx.dt / h_z * d);
                [
                    e.inverse_density * s_nn,
                    e.inverse_density * s_nt,
                    e.p_modulus * v_n,
                    e.mu * v_t,
                    e.lambda * v_n,
                    e.lambda * v_n,
                ]
            } else {
                let r = ctx.mesh.centre(id, 0, j)[1];
                // Half of the geometric terms stems from either face; planar geometry has none.
                let half = match ctx.mesh.domain().geometry {
                    mesh::Geometry::Axisymmetric => 0.5 * ctx.dt / r,
                    mesh::Geometry::Planar => 0.0,
                };
                let difference = |d: f64| sign * ctx.dt / h_r * d;
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
                debug_assert!(c < COUNT);
                new[(c * N + j) * N + i] += change;
            }
        }
    }
    report_stresses(ctx, slot, new, report);
}
