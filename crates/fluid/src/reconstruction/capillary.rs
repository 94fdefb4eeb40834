//! Slopes and states at mid-step of cells beside a jump of pressure.

use mesh::{Padded, TileRows};

use crate::physics::FluidStep;
use crate::reconstruction::at;
use crate::state::primitive::PRESSURE;
use crate::step::BlockScratch;
use crate::step::rows::Prediction;

/// Gives cells beside interfaces with tension the slopes that their pressure has but for the jumps, and the states at mid-step that go
/// with them.
///
/// What is left of p between two cells is p_above − p_below − JΔψ: nothing where Laplace's law holds, so that such a fluid stays at rest.
///
/// - `inverse_h`: 1/h_z, 1/h_r; `scratch`: its slopes have been made with the jumps in.
pub(crate) fn level_slopes<const N: usize>(
    ctx: &FluidStep<'_, N>,
    inverse_h: [f64; 2],
    scratch: &mut BlockScratch<N>,
) {
    let BlockScratch { cells, s_z, s_r, half, keep, inverse_r, gas_shares, capillary, .. } = scratch;
    let Some(jumps) = capillary.jumps() else { return };
    let mixture = &ctx.model.mixture;
    let limiter = ctx.model.scheme.limiter;
    for &k in capillary.cells() {
        let p = cells.component(PRESSURE);
        for (axis, slopes) in [&mut *s_z, &mut *s_r].into_iter().enumerate() {
            let step = if axis == 0 { 1 } else { Padded::<N>::STRIDE };
            let (below, above) = (jumps[axis][k - step], jumps[axis][k]);
            if below != 0.0 || above != 0.0 {
                let levelled = limiter.difference(p[k] - p[k - step] - below, p[k + step] - p[k] - above);
                slopes.component_mut(PRESSURE)[k] = levelled;
            }
        }
        let of = |rows: &TileRows<N>| at(&rows.split(), k);
        let (w, along_z, along_r) = (of(cells), of(s_z), of(s_r));
        let bound = if mixture.has_covolume() { mixture.bound_beta1::<true>(gas_shares[k]) } else { 0.0 };
        let half_dt = 0.5 * ctx.dt;
        let (state, kept) =
            Prediction::<true>::new(w, along_z, along_r, inverse_h, inverse_r[k], half_dt, bound, mixture)
                .half_step();
        for (component, value) in state.into_iter().enumerate() {
            half.component_mut(component)[k] = value;
        }
        keep[k] = kept;
    }
}
