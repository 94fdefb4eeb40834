//! What one block tells of its step.

use mesh::{Mesh, Side, maximum};
use serde::{Deserialize, Serialize};

use crate::PlasticLedger;
use crate::physics::SolidStep;
use crate::step::rim::Rim;

/// What one block tells of its step.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct BlockReport {
    /// Largest squared von Mises stress, Pa²; infinite if a number is not finite.
    pub(crate) mises_squared: f64,
    /// Volume in which the yield strength is exceeded (per radian).
    pub(crate) yielded: f64,
    /// What came in through each side of the domain: axial momentum, energy (per radian).
    pub(crate) inflow: [[f64; 2]; 4],
    /// What plastic flow did.
    pub(crate) plastic: PlasticReport,
}

/// What plastic flow did in a block; energies per radian.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct PlasticReport {
    /// Cells that flowed in the step.
    pub(crate) returned: u32,
    /// Cells that flowed once more, as a correction along a level jump had moved them.
    pub(crate) corrected: u32,
    /// Plastic work q Δε_p, J.
    pub(crate) work: f64,
    /// Largest rate of plastic strain, 1/s.
    pub(crate) rate: f64,
    /// Largest plastic strain after the step.
    pub(crate) strain: f64,
    /// Highest temperature after the step, K.
    pub(crate) temperature: f64,
}

impl PlasticReport {
    /// Whether anything flowed in the step.
    pub(crate) fn has_flow(&self) -> bool {
        self.returned + self.corrected > 0 || [self.work, self.rate] != [0.0; 2]
    }
}

/// Reports the von Mises stresses of a block anew.
///
/// - `yield_squared`: squared yield strength, Pa².
pub(crate) fn report_stresses<const N: usize>(
    mesh: &Mesh<N>,
    slot: usize,
    block: &[f64],
    yield_squared: f64,
    report: &mut BlockReport,
) {
    report.mises_squared = largest_mises_of_block::<N>(block);
    report.yielded = yielded_volume(mesh, slot, block, report.mises_squared, yield_squared);
}

/// The largest squared von Mises stress of a block, infinite if one is not a number.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn largest_mises_of_block<const N: usize>(block: &[f64]) -> f64 {
    let mut largest = [0.0_f64; N];
    for j in 0..N {
        for (largest, squared) in largest.iter_mut().zip(mises_of_row::<N>(block, j)) {
            let squared = if squared <= f64::MAX { squared } else { f64::INFINITY };
            *largest = largest.max(squared);
        }
    }
    maximum(&largest)
}

/// The squared von Mises stresses of the cells in a row of a block.
#[inline(always)]
fn mises_of_row<const N: usize>(block: &[f64], j: usize) -> [f64; N] {
    let [zz, zr, rr, pp] = [2, 3, 4, 5].map(|c| row::<N>(&block[(c * N + j) * N..]));
    std::array::from_fn(|i| crate::material::yield_criterion::von_mises_squared(zz[i], zr[i], rr[i], pp[i]))
}

/// The first N numbers of a row.
fn row<const N: usize>(numbers: &[f64]) -> &[f64; N] {
    numbers.first_chunk().expect("rows are whole")
}

/// The volume in which the yield strength is exceeded (per radian).
///
/// - `largest`: squared von Mises stress of the block, Pa².
pub(crate) fn yielded_volume<const N: usize>(
    mesh: &Mesh<N>,
    slot: usize,
    block: &[f64],
    largest: f64,
    yield_squared: f64,
) -> f64 {
    if largest <= yield_squared {
        return 0.0;
    }
    let id = mesh.tree().leaves()[slot];
    let cells_of_row =
        |j| mises_of_row::<N>(block, j).into_iter().filter(|mises| *mises > yield_squared).count();
    (0..N).map(|j| cells_of_row(j) as f64 * mesh.volume(id, j)).sum()
}

/// Axial momentum and energy that a block took in through the sides of the domain.
///
/// - `place`: of the block in the tile that the rim is of.
pub(crate) fn boundary_inflow<const N: usize>(
    ctx: &SolidStep<'_, N>,
    slot: usize,
    place: [usize; 2],
    rim: &Rim,
) -> [[f64; 2]; 4] {
    let mut inflow = [[0.0; 2]; 4];
    let id = ctx.mesh.tree().leaves()[slot];
    let [h_z, h_r] = ctx.mesh.widths(id.level);
    let r_low = ctx.mesh.origin(id)[1];
    for side in Side::ALL {
        if !ctx.mesh.touches(slot, side) {
            continue;
        }
        let outward = if matches!(side, Side::ZMin | Side::RMin) { -1.0 } else { 1.0 };
        let total = &mut inflow[side as usize];
        let [v_n, v_t, s_nn, s_nt] = rim.of_block::<N>(side, place);
        for along in 0..N {
            // Of the traction on a face with outward normal along the axis, W/m².
            let power = s_nn[along] * v_n[along] + s_nt[along] * v_t[along];
            let [traction_z, area] = match side {
                Side::ZMin | Side::ZMax => {
                    [s_nn[along], ctx.mesh.weight(ctx.mesh.centre(id, 0, along)[1]) * h_r]
                }
                Side::RMin => [s_nt[along], ctx.mesh.weight(r_low) * h_z],
                Side::RMax => [s_nt[along], ctx.mesh.weight(r_low + N as f64 * h_r) * h_z],
            };
            total[0] += outward * ctx.dt * area * traction_z;
            total[1] += outward * ctx.dt * area * power;
        }
        if side == Side::ZMax
            && let Some(surface) = ctx.interface.states_of::<N>(slot)
        {
            // The mean of the product, not the product of the means, is what the fluid gave.
            total[1] = -(surface.iter().enumerate())
                .map(|(j, s)| ctx.mesh.weight(ctx.mesh.centre(id, 0, j)[1]) * h_r * s.power)
                .sum::<f64>()
                * ctx.dt;
        }
    }
    inflow
}

impl PlasticLedger {
    /// Adds what plastic flow did in a block.
    pub(crate) fn take(&mut self, report: &PlasticReport) {
        self.returns += u64::from(report.returned) + u64::from(report.corrected);
        self.after_corrections += u64::from(report.corrected);
        self.work += report.work;
        self.rate_peak = self.rate_peak.max(report.rate);
    }
}
