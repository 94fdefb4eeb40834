//! Gravity along the axis.

use super::{Term, TermBlock};
use crate::PhaseState;
use crate::state::conserved::{ENERGY, MOMENTUM_Z, RHO};
use crate::state::primitive::V_Z;
use crate::step::face_rows::FaceRows;

/// A uniform acceleration along z: ρg in the balance of axial momentum, ρg v_z in that of energy.
///
/// The momentum gains g Δt times the mean of a cell's density at the beginning and the end of the step, the energy that times v_z at
/// mid-step. So fluid at rest under p = p₀ + ρg(z − z₀) stays at rest to round-off, between walls, too, where the pressure's slope is
/// ρg; and whatever falls freely gains gΔt to round-off, interfaces between gas and liquid in it.
///
/// - tested by: `tests/verification/gravity.rs`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gravity {
    /// Along z, m/s²; negative towards the wall at z_min.
    pub acceleration: f64,
    /// Where the ambient pressure is that of the initial condition, m.
    pub level: f64,
}

impl Gravity {
    /// How much higher the pressure of liquid at rest is at z than at the level, Pa: ρg(z − z₀).
    pub fn head(&self, density: f64, z: f64) -> f64 {
        density * self.acceleration * (z - self.level)
    }

    /// The ambient liquid at a height.
    pub fn at_height(&self, ambient: PhaseState, z: f64) -> PhaseState {
        PhaseState { pressure: ambient.pressure + self.head(ambient.density, z), ..ambient }
    }
}

impl Term for Gravity {
    fn acceleration(&self) -> [f64; 2] {
        [self.acceleration, 0.0]
    }

    fn add_sources(&self, block: &TermBlock<'_>, [z, r]: [&FaceRows; 2], _: &[f64], block_rows: &mut [f64]) {
        let TermBlock { cells: n, metric, state, .. } = *block;
        let (z_mass, r_mass, v_z) = (&z.mass, &r.mass, state[V_Z]);
        for j in 0..n {
            let row = metric.row(j);
            for i in 0..n {
                let (cell, k) = (j * n + i, metric.origin + j * metric.stride + i);
                let left =
                    row.axial(z_mass[k], z_mass[k - 1]) + row.radial(r_mass[k], r_mass[k - metric.stride]);
                let gain = metric.dt * self.acceleration * (block_rows[RHO * n * n + cell] - 0.5 * left);
                block_rows[MOMENTUM_Z * n * n + cell] += gain;
                block_rows[ENERGY * n * n + cell] += gain * v_z[k];
            }
        }
    }

    /// Nothing falls through a cell in a step: ½|g|Δt² ≤ h_z.
    fn step_limit(&self, [h_z, _]: [f64; 2], _: f64) -> f64 {
        (2.0 * h_z / self.acceleration.abs()).sqrt()
    }
}
