//! What second order leaves out at the faces of weak waves in liquid, see [`mesh::curvature_share`].

use mesh::curvature_share;

use crate::block::StepContext;
use crate::rows::Reconstruction;

/// What face states of weak waves in liquid get besides, see [`mesh::curvature_share`].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Curvature {
    pub share: f64,
    /// π of the liquid, Pa.
    pub liquid_pi: f64,
}

impl Curvature {
    /// Differences of the pressure across a cell above this share of p + π belong to a strong front. The correction is a
    /// sixth of the larger difference at most; below, it keeps shocks that a few cells carry from being clipped.
    const WEAK: f64 = 0.2;
    /// Gas fractions up to this count as liquid.
    const LIQUID: f64 = 1e-6;

    /// The share between two cells that keep `keep` of their slopes; their states and differences at `k`.
    #[inline(always)]
    fn between(self, lower: &Reconstruction<'_>, upper: &Reconstruction<'_>, k: usize) -> f64 {
        let is_weak = |cell: &Reconstruction<'_>| {
            self.is_weak(cell.half[3][k], cell.half[4][k], cell.differences[3][k])
        };
        let share = self.share * (lower.keep[k] * upper.keep[k]);
        if is_weak(lower) & is_weak(upper) { share } else { 0.0 }
    }

    /// Whether a cell of this pressure and gas fraction with this difference of pressure is part of a weak wave in liquid.
    #[inline(always)]
    pub fn is_weak(self, p: f64, phi: f64, difference: f64) -> bool {
        (difference.abs() < Self::WEAK * (p + self.liquid_pi)) & (phi.abs() < Self::LIQUID)
    }
}

impl<const N: usize> StepContext<'_, N> {
    /// For the faces normal to an axis (0: z, 1: r) of a block of a level.
    pub fn curvature(&self, level: u8, axis: usize) -> Curvature {
        let courant = self.fastest[axis] * self.dt / self.mesh.widths(level)[axis];
        Curvature { share: curvature_share(courant), liquid_pi: self.mixture.at(0.0).pi }
    }
}

/// The states on both sides of the face between cells `k` of `lower` and of `upper`.
///
/// Normal velocity and pressure are all that matters in a weak wave; density and the rest stay as they are.
#[inline(always)]
pub(crate) fn states_at_face(
    lower: &Reconstruction<'_>,
    upper: &Reconstruction<'_>,
    k: usize,
) -> [[f64; 5]; 2] {
    let share = lower.curvature.between(lower, upper, k);
    let more = |c: usize| share * (upper.differences[c][k] - lower.differences[c][k]);
    let (velocity, pressure) = (more(1), more(3));
    [lower.face_state(k, 1.0), upper.face_state(k, -1.0)]
        .map(|[rho, v_n, v_t, p, phi]| [rho, v_n + velocity, v_t, p + pressure, phi])
}
