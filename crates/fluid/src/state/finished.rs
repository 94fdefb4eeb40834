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
///
/// - `B`: whether there may be a covolume; `gas`: m_g, kg/m³, without a say if not.
#[inline(always)]
pub(crate) fn finish_cell<const B: bool>(u: ConservedCell, gas: f64, mixture: &Mixture) -> FinishedCell {
    lifted_to::<true, B>(mixture.pressure_floor(u[PHI]), u, gas, mixture)
}

/// Lifts a single cell to the pressure floor.
pub(crate) fn finish_corrected(u: ConservedCell, gas: f64, mixture: &Mixture) -> FinishedCell {
    lifted_to::<false, true>(mixture.pressure_floor(u[PHI]), u, gas, mixture)
}

/// A single cell as it is, below the floor or not.
pub(crate) fn measure_cell(u: ConservedCell, gas: f64, mixture: &Mixture) -> FinishedCell {
    lifted_to::<false, true>(f64::NEG_INFINITY, u, gas, mixture)
}

/// - `IN_ROWS`: whether 1/β₁ is made once. Else the pressure is that of [`super::primitive_of`] to the last bit.
#[inline(always)]
fn lifted_to<const IN_ROWS: bool, const B: bool>(
    lowest: f64,
    [rho, mz, mr, energy, phi]: ConservedCell,
    gas: f64,
    mixture: &Mixture,
) -> FinishedCell {
    let inverse_rho = 1.0 / rho;
    let (v_z, v_r) = (mz * inverse_rho, mr * inverse_rho);
    let internal = energy - 0.5 * (mz * v_z + mr * v_r);
    let [beta1, beta2] = mixture.free_betas::<B>(phi, rho, gas);
    let inverse_beta1 = 1.0 / beta1;
    let p = if IN_ROWS { (internal - beta2) * inverse_beta1 } else { (internal - beta2) / beta1 };
    let lifted = if p < lowest { lowest } else { p };
    let added = beta1 * (lifted - p);
    // ρc² has β₁ and β₂ of the whole volumes above the line.
    let above_vacuum = (1.0 + mixture.beta1(phi)) * lifted + mixture.beta2(phi);
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
