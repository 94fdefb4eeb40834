//! What a step leaves of a cell, and what the next one needs to know of it.

use super::ConservedCell;
use super::conserved::PHI;
use crate::Mixture;

/// A cell at the end of a step.
#[derive(Clone, Copy)]
pub(crate) struct FinishedCell {
    pub conserved: ConservedCell,
    /// |v_z| + c, |v_r| + c; infinite if the cell is not admissible: ρ > 0 and a sound speed.
    pub speed_z: f64,
    pub speed_r: f64,
    /// Energy per volume that the floor added.
    pub floor: f64,
}

impl FinishedCell {
    pub fn is_admissible(&self) -> bool {
        self.speed_z.is_finite() && self.speed_r.is_finite()
    }
}

/// Lifts a cell to the pressure floor, in rows of cells: with one division for both the pressure and the sound speed.
#[inline(always)]
pub(crate) fn finish_cell(u: ConservedCell, mixture: &Mixture) -> FinishedCell {
    lifted_to::<true>(mixture.pressure_floor(u[PHI]), u, mixture)
}

/// Lifts a single cell to the pressure floor.
pub(crate) fn finish_corrected(u: ConservedCell, mixture: &Mixture) -> FinishedCell {
    lifted_to::<false>(mixture.pressure_floor(u[PHI]), u, mixture)
}

/// A single cell as it is, below the floor or not.
pub(crate) fn measure_cell(u: ConservedCell, mixture: &Mixture) -> FinishedCell {
    lifted_to::<false>(f64::NEG_INFINITY, u, mixture)
}

/// - `IN_ROWS`: whether 1/β₁ is made once. Else the pressure is that of [`super::primitive_of`] to the last bit.
#[inline(always)]
fn lifted_to<const IN_ROWS: bool>(
    lowest: f64,
    [rho, mz, mr, energy, phi]: ConservedCell,
    mixture: &Mixture,
) -> FinishedCell {
    let inverse_rho = 1.0 / rho;
    let (v_z, v_r) = (mz * inverse_rho, mr * inverse_rho);
    let internal = energy - 0.5 * (mz * v_z + mr * v_r);
    let (beta1, beta2) = (mixture.beta1(phi), mixture.beta2(phi));
    let inverse_beta1 = 1.0 / beta1;
    let p = if IN_ROWS { (internal - beta2) * inverse_beta1 } else { (internal - beta2) / beta1 };
    let lifted = if p < lowest { lowest } else { p };
    let added = beta1 * (lifted - p);
    let above_vacuum = (1.0 + beta1) * lifted + beta2;
    let squared =
        if IN_ROWS { above_vacuum * (inverse_beta1 * inverse_rho) } else { above_vacuum / beta1 / rho };
    let sound = squared.sqrt();
    let sane = (rho > 0.0) & (sound < f64::MAX);
    let speed = |v: f64| if sane { v.abs() + sound } else { f64::INFINITY };
    FinishedCell {
        conserved: [rho, mz, mr, energy + added, phi],
        speed_z: speed(v_z),
        speed_r: speed(v_r),
        floor: added,
    }
}
