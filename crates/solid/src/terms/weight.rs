//! The solid's own weight.

use super::Term;
use crate::state::component::V_Z;

/// A uniform acceleration along z: v_z gains gΔt in a step, gΔt/2 until mid-step.
///
/// Solid at rest under σ_zz = σ₀ − ρg(z − z₀) stays at rest to round-off, over jumps of levels, under a free surface and beside open
/// sides; on a fixed side across z the stress is taken for even, which is second-order. What falls freely gains gΔt exactly.
///
/// - tested by: `tests/verification/weight.rs`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weight {
    /// Along z, m/s²; negative away from a fluid above.
    pub acceleration: f64,
    /// Where the axial stress is that of the case, m: the surface.
    pub level: f64,
}

impl Weight {
    /// What σ_zz is more at rest at z than at the level, Pa: −ρg(z − z₀).
    pub fn stress(&self, density: f64, z: f64) -> f64 {
        -density * self.acceleration * (z - self.level)
    }
}

impl Term for Weight {
    fn acceleration(&self) -> [f64; 2] {
        [self.acceleration, 0.0]
    }

    fn add_sources(&self, dt: f64, cells: usize, block: &mut [f64]) {
        let gain = dt * self.acceleration;
        block[V_Z * cells..(V_Z + 1) * cells].iter_mut().for_each(|v| *v += gain);
    }

    /// Nothing falls through a cell in a step: ½|g|Δt² ≤ h_z.
    fn step_limit(&self, [h_z, _]: [f64; 2]) -> f64 {
        (2.0 * h_z / self.acceleration.abs()).sqrt()
    }
}
