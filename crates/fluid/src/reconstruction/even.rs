//! Slopes of the cells next to walls and to the axis.

use mesh::{Frame, Side, Tile, TileRows};

use crate::boundary::{axis, beside, tangential};
use crate::physics::FluidStep;
use crate::reconstruction::at;
use crate::state::primitive::{PHI, PRESSURE, RHO};
use crate::step::BlockScratch;
use crate::step::rows::Prediction;

/// Gas fractions of two cells may differ by this much where slopes are made.
const ONE_PHASE: f64 = 1e-6;

/// Gives the cells next to walls at rest and to the axis the slopes of even functions there.
///
/// Density, pressure and the velocity along a mirror are even about it. To a limiter the mirror image makes an extremum of
/// the cell beside it, which it clips: a wave that a wall throws back, or that runs along the axis, would lose of its
/// height in every step. Half of the difference to the next cell is the central slope, that of the parabola with its vertex on
/// the mirror, and no face state within goes beyond the next cell. Under a uniform acceleration a the pressure has the slope ρa on
/// the mirror, and what is even is the rest: half of ρah comes to its difference, and the image has the difference of that.
///
/// - `scratch`: its slopes have been made with mirror images for ghosts; where the next cell holds another phase they stay.
/// - tested by: the height of a spherical pulse that a wall throws back.
pub(crate) fn even_slopes<const N: usize>(ctx: &FluidStep<'_, N>, tile: Tile, scratch: &mut BlockScratch<N>) {
    let BlockScratch { cells, s_z, s_r, .. } = scratch;
    let phi = cells.component(PHI);
    for side in mirrors(ctx, tile) {
        let axis = axis(side);
        let slopes = if axis == 0 { &mut *s_z } else { &mut *s_r };
        let acceleration = ctx.model.terms.acceleration()[axis];
        let width = ctx.mesh.widths(ctx.mesh.first_of(tile).level)[axis];
        for [inner, ghost] in along_mirror(cells.frame(), side) {
            let next = 2 * inner - ghost;
            if (phi[next] - phi[inner]).abs() > ONE_PHASE {
                continue;
            }
            for component in [RHO, tangential(side), PRESSURE] {
                let row = cells.component(component);
                let towards_next = 0.5 * (row[next] - row[inner]);
                let slope = if next > inner { towards_next } else { -towards_next };
                let slopes = slopes.component_mut(component);
                (slopes[inner], slopes[ghost]) = (slope, -slope);
                if component == PRESSURE && acceleration != 0.0 {
                    let odd = cells.component(RHO)[inner] * acceleration * width;
                    (slopes[inner], slopes[ghost]) = (slope + 0.5 * odd, 1.5 * odd - slope);
                }
            }
        }
    }
}

/// The states at mid-step of the cells that [`even_slopes`] is about, with their slopes as they are.
///
/// - `inverse_h`: 1/h_z, 1/h_r. returns: whether all of them keep their slopes.
pub(crate) fn predict_beside_mirrors<const N: usize>(
    ctx: &FluidStep<'_, N>,
    tile: Tile,
    inverse_h: [f64; 2],
    scratch: &mut BlockScratch<N>,
) -> bool {
    let BlockScratch { cells, s_z, s_r, half, keep, inverse_r, gas_shares, has_gas, .. } = scratch;
    let mut all_keep = true;
    let mixture = &ctx.model.mixture;
    for side in mirrors(ctx, tile) {
        for [k, _] in along_mirror(cells.frame(), side) {
            let of = |rows: &TileRows<N>| at(&rows.split(), k);
            let (w, s_z, s_r) = (of(cells), of(s_z), of(s_r));
            let bound = mixture.bound_beta1::<true>(if *has_gas { gas_shares[k] } else { 0.0 });
            let (state, kept) =
                Prediction::<true>::new(w, s_z, s_r, inverse_h, inverse_r[k], 0.5 * ctx.dt, bound, mixture)
                    .half_step();
            for (component, value) in state.into_iter().enumerate() {
                half.component_mut(component)[k] = value;
            }
            keep[k] = kept;
            all_keep &= kept == 1.0;
        }
    }
    all_keep
}

/// The padded cells along a side and those beyond it; the first ghosts at both ends, too, which lie along it in other blocks.
fn along_mirror(frame: Frame, side: Side) -> impl Iterator<Item = [usize; 2]> {
    (-1..=frame.cells() as isize).map(move |along| beside(side, frame, along))
}

/// The sides of a tile that are walls at rest or the axis.
fn mirrors<const N: usize>(ctx: &FluidStep<'_, N>, tile: Tile) -> impl Iterator<Item = Side> {
    let is_mirror =
        move |side: &Side| ctx.mesh.tile_touches(tile, *side) && ctx.model.boundaries.kind(*side).is_mirror();
    Side::ALL.into_iter().filter(is_mirror)
}
