//! Surface tension between gas and liquid.

use super::{Term, TermBlock};
use crate::state::conserved::{ENERGY, MOMENTUM_R, MOMENTUM_Z};
use crate::step::face_rows::FaceRows;

/// The tension σ of the interface between gas and liquid.
///
/// Its force σκ∇φ stands in the Riemann problems of the faces as a jump of pressure, see `capillarity`; both cells feel half
/// of it beside the pressure of the flux, and its work on the velocity of the face. That is what this term adds.
///
/// - tested by: `tests/verification/surface_tension.rs`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceTension {
    /// σ, N/m.
    pub coefficient: f64,
    /// ρ of the denser phase, kg/m³, for the limit on the step.
    pub density: f64,
    /// Whether interfaces may meet walls; at right angles then.
    pub may_touch_walls: bool,
}

impl Term for SurfaceTension {
    fn surface_tension(&self) -> Option<f64> {
        Some(self.coefficient)
    }

    fn forbids_contact(&self) -> bool {
        !self.may_touch_walls
    }

    fn add_sources(
        &self,
        block: &TermBlock<'_>,
        [z_faces, r_faces]: [&FaceRows; 2],
        _: &[f64],
        block_rows: &mut [f64],
    ) {
        let TermBlock { cells: n, metric, capillary, .. } = *block;
        let velocities = [&z_faces.velocity[..], &r_faces.velocity[..]];
        capillary.for_gains(n, metric, velocities, |cell, [axial, radial, work]| {
            block_rows[MOMENTUM_Z * n * n + cell] += axial;
            block_rows[MOMENTUM_R * n * n + cell] += radial;
            block_rows[ENERGY * n * n + cell] += work;
        });
    }

    /// The shortest capillary wave on the grid does not cross its length in a step: Δt ≤ √(ρh³/(2πσ)) (Brackbill, Kothe & Zemach
    /// 1992).
    fn step_limit(&self, [h_z, h_r]: [f64; 2], _: f64) -> f64 {
        let h = h_z.min(h_r);
        (self.density * h * h * h / (std::f64::consts::TAU * self.coefficient)).sqrt()
    }
}
