//! Flux correction at level jumps: the finer side's star states pass for both.

use mesh::{FinerSide, FluxRegister, Geometry, Mesh, Side};

use crate::physics::SolidStep;
use crate::state::component::COUNT;
use crate::step::plastic::return_block;
use crate::step::report::{BlockReport, report_stresses};
use crate::step::rim::Rim;
use crate::step::update::FACES;

/// What is registered of a face: v_n, v_t, σ_nn, σ_nt.
pub(crate) const QUANTITIES: usize = 4;

/// Keeps the star states on those sides of a block that meet another level.
///
/// - `place`: of the block in the tile that the rim is of.
pub(crate) fn register_stars<const N: usize>(
    mesh: &Mesh<N>,
    slot: usize,
    place: [usize; 2],
    rim: &Rim,
    values: &mut [f64],
) {
    for side in FluxRegister::<N>::recorded(mesh, slot) {
        let rows = FluxRegister::<N>::rows(values, side).chunks_exact_mut(N);
        rows.zip(rim.of_block::<N>(side, place)).for_each(|(row, faces)| row.copy_from_slice(faces));
    }
}

/// Corrects the cells of a block along its finer neighbours, after all blocks have made their step; the formulas
/// are those of the update for one face. What can yield is then returned once more, see [`return_block`].
pub(crate) fn correct<const N: usize>(
    ctx: &SolidStep<'_, N>,
    finer: FinerSide<'_, N>,
    slot: usize,
    new: &mut [f64],
    report: &mut BlockReport,
) {
    let id = ctx.mesh.tree().leaves()[slot];
    let [h_z, h_r] = ctx.mesh.widths(id.level);
    let e = &ctx.model.elasticity;
    finer.for_corrected_sides(
        ctx.mesh,
        slot,
        0,
        |side, outward, [v_n, v_t, s_nn, s_nt]: &[_; QUANTITIES]| {
            if matches!(side, Side::ZMin | Side::ZMax) {
                let i = if side == Side::ZMin { 0 } else { N - 1 };
                let scale = outward * ctx.dt / h_z;
                for j in 0..N {
                    let (v_n, v_t) = (scale * v_n[j], scale * v_t[j]);
                    let (s_nn, s_nt) = (scale * s_nn[j], scale * s_nt[j]);
                    let changes = [
                        e.inverse_density * s_nn,
                        e.inverse_density * s_nt,
                        e.p_modulus * v_n,
                        e.mu * v_t,
                        e.lambda * v_n,
                        e.lambda * v_n,
                    ];
                    add(new, j * N + i, N * N, changes);
                }
            } else {
                let j = if side == Side::RMin { 0 } else { N - 1 };
                // What of the terms with 1/r stems from a face; planar geometry has none.
                let over_r = match ctx.mesh.domain().geometry {
                    Geometry::Axisymmetric => ctx.dt / ctx.mesh.centre(id, 0, j)[1],
                    Geometry::Planar => 0.0,
                };
                let scale = outward * ctx.dt / h_r;
                for i in 0..N {
                    let (v_n, v_t, s_nn, s_nt) = (v_n[i], v_t[i], s_nn[i], s_nt[i]);
                    let (radial, hoop) = (scale * v_n, FACES * over_r * v_n);
                    let changes = [
                        e.inverse_density * (scale * s_nt + 0.5 * over_r * s_nt),
                        e.inverse_density * (scale * s_nn),
                        e.lambda * (radial + hoop),
                        e.mu * (scale * v_t),
                        e.p_modulus * radial + e.lambda * hoop,
                        e.p_modulus * hoop + e.lambda * radial,
                    ];
                    add(new, j * N + i, N * N, changes);
                }
            }
        },
    );
    if let Some(plasticity) = &ctx.model.plasticity {
        let returned = return_block(plasticity, ctx.mesh, id, new, None, &mut report.plastic);
        report.plastic.corrected += returned.cells;
    }
    report_stresses(ctx.mesh, slot, new, ctx.model.yield_squared(), report);
}

/// Adds to the cell `k` of a block, whose components are `len` numbers.
fn add(block: &mut [f64], k: usize, len: usize, changes: [f64; COUNT]) {
    for (cells, change) in block.chunks_exact_mut(len).zip(changes) {
        cells[k] += change;
    }
}
