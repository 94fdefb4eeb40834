//! Plastic flow within a step: the return of the new cells, and that of the states at mid-step.
//!
//! The update makes trial stresses, elastic over the whole step; the return then gives the stresses at its end. The fluxes are
//! those of mid-step, which the elastic predictor would put outside of the yield surface by 3μ times half a step's plastic
//! strain, an error of first order. So its states are returned, too, over half a step.

use mesh::{BlockId, Mesh, Padded, maximum};

use super::BlockStep;
use super::scratch::BlockScratch;
use crate::components::{self, PLASTIC_STRAIN, TEMPERATURE, acting};
use crate::plasticity::{PlasticRows, Plasticity, Returned};
use crate::state::component::COUNT;
use crate::step::report::{BlockReport, PlasticReport, report_stresses};

/// Returns the cells of a block onto their yield surfaces.
///
/// [`Plasticity::return_rows`]; what flows is counted.
///
/// - `block`: the trial stresses with plastic strain and temperature at the beginning. `dt`: s. After what is no step, a
///   correction along a level jump or a change of the grid, it is 0: a law without rate returns all the same; one with rate does
///   not flow in no time, so what such a change has added stays as overstress and relaxes in the next step. (Another return
///   over Δt would let the overstress that a rate holds relax twice.)
/// - returns: how many cells flowed; `report` gets all but the counts.
/// - tested by: the change of the elastic energy; ledgers of adaptive runs.
pub(crate) fn return_block<const N: usize>(
    plasticity: &Plasticity,
    mesh: &Mesh<N>,
    id: BlockId,
    block: &mut [f64],
    dt: f64,
    report: &mut PlasticReport,
) -> u32 {
    let mut components = block.chunks_exact_mut(N * N);
    let mut next = || components.next().expect("fields of what can yield have plastic strain");
    let [_, _, stress_zz, stress_zr, stress_rr, stress_phiphi, strain] = std::array::from_fn(|_| next());
    let temperature = if plasticity.has_heat() { components.next().unwrap_or_default() } else { &mut [] };
    let mut rows = PlasticRows { stress_zz, stress_zr, stress_rr, stress_phiphi, strain, temperature };
    let (mut sums, mut largest): ([[f64; 2]; N], f64) = ([[0.0; 2]; N], 0.0);
    let count = plasticity.return_rows(&mut rows, dt, |cell, returned: &Returned| {
        let of_row = &mut sums[cell / N];
        of_row[0] += returned.plastic_work;
        of_row[1] += returned.energy_released;
        largest = largest.max(returned.increment);
    });
    if count > 0 {
        for (j, [work, released]) in sums.into_iter().enumerate() {
            let volume = mesh.volume(id, j);
            report.work += volume * work;
            report.released += volume * released;
        }
        if dt > 0.0 {
            report.rate = report.rate.max(largest / dt);
        }
    }
    measure_flow::<N>(block, report);
    // No block has that many cells.
    u32::try_from(count).unwrap_or(u32::MAX)
}

/// Takes the largest plastic strain and the highest temperature of a block's cells into its report.
pub(crate) fn measure_flow<const N: usize>(block: &[f64], report: &mut PlasticReport) {
    let acting = acting(block.len() / (N * N));
    let largest = |component: usize| {
        if component < acting { maximum(&block[component * N * N..(component + 1) * N * N]) } else { 0.0 }
    };
    report.strain = largest(PLASTIC_STRAIN);
    report.temperature = largest(TEMPERATURE);
}

/// Of the squared flow stress: rounding must not keep a cell from its return.
const LEAST: f64 = 1.0 - 1e-9;

impl<const N: usize> BlockStep<'_, N> {
    /// Returns the states at mid-step, all stresses of which are the elastic predictor's, over half a step: those of the cells
    /// and of the first layer of ghosts.
    ///
    /// A law with rate finds its rate itself that way: overstress is what the material carries at that rate. The plastic strain
    /// that the return makes is that of mid-step and goes with it.
    pub(super) fn flow_to_mid_step(&self, scratch: &mut BlockScratch<N>) {
        let Some(plasticity) = &self.ctx.model.plasticity else { return };
        let BlockScratch { cells, half, flow, .. } = scratch;
        let (first, n) = (Padded::<N>::index(-2, -1), (N + 2) * Padded::<N>::STRIDE);
        let (strain, temperature) = flow.split_at_mut(Padded::<N>::LEN);
        // Ghosts that are predicted or continued may have less than none.
        for (own, old) in strain.iter_mut().zip(cells.component(PLASTIC_STRAIN)) {
            *own = old.max(0.0);
        }
        if !temperature.is_empty() {
            temperature.copy_from_slice(cells.component(TEMPERATURE));
        }
        let [_, _, zz, zr, rr, phiphi] = half.split_mut::<COUNT>();
        let mut rows = PlasticRows {
            stress_zz: &mut zz[first..][..n],
            stress_zr: &mut zr[first..][..n],
            stress_rr: &mut rr[first..][..n],
            stress_phiphi: &mut phiphi[first..][..n],
            strain: &mut strain[first..][..n],
            temperature: temperature.get_mut(first..first + n).unwrap_or_default(),
        };
        plasticity.return_rows(&mut rows, 0.5 * self.ctx.dt, |_, _| {});
    }

    /// Moves the cells by the mean of their velocities before and after the step.
    fn displace(&self, new: &mut [f64]) {
        let old = self.ctx.old.block(self.slot);
        let half = 0.5 * self.ctx.dt;
        let (velocities, rest) = new.split_at_mut(2 * N * N);
        let first = components::displacement(old.len() / (N * N)).start * N * N;
        let displacement = &mut rest[first - 2 * N * N..][..2 * N * N];
        let before = old[..2 * N * N].iter().zip(&old[first..]);
        for ((u, v), (v_old, u_old)) in displacement.iter_mut().zip(velocities).zip(before) {
            *u = u_old + half * (v_old + *v);
        }
    }

    /// The return of the new cells.
    pub(super) fn flow(&self, new: &mut [f64], report: &mut BlockReport) {
        let Self { ctx, slot, id, .. } = *self;
        let Some(plasticity) = &ctx.model.plasticity else { return };
        let old = ctx.old.block(slot);
        let places = new.len() / (N * N);
        let (stays, rate) = (COUNT * N * N..acting(places) * N * N, components::rate(places) * N * N);
        new[stays.clone()].copy_from_slice(&old[stays]);
        new[rate..rate + N * N].fill(0.0);
        self.displace(new);
        // Flow stress never falls with plastic strain, so most blocks need no look at their cells.
        measure_flow::<N>(new, &mut report.plastic);
        let least = plasticity.hardening().yield_stress(0.0, 0.0, report.plastic.temperature);
        if report.mises_squared <= LEAST * least * least {
            return;
        }
        report.plastic.returned = return_block(plasticity, ctx.mesh, id, new, ctx.dt, &mut report.plastic);
        if report.plastic.returned > 0 {
            let per_second = 1.0 / ctx.dt;
            for k in 0..N * N {
                let at = PLASTIC_STRAIN * N * N + k;
                new[rate + k] = (new[at] - old[at]) * per_second;
            }
            report_stresses(ctx.mesh, slot, new, ctx.model.yield_squared(), report);
        }
    }
}

#[cfg(test)]
mod tests {
    use mesh::{Domain, Geometry};

    use super::*;
    use crate::WaveSpeeds;
    use crate::plasticity::{Hardening, Stress};

    /// The energy that returns take is what the cells then lack, whatever the law does within a step.
    #[test]
    fn what_a_return_releases_is_the_loss_of_elastic_energy() {
        const N: usize = 8;
        let speeds = WaveSpeeds { density: 7800.0, c1: 5990.0, c2: 3458.0 };
        let domain = Domain { geometry: Geometry::Axisymmetric, z: [0.0, 1.0], r: [0.0, 1.0] };
        let mesh = Mesh::<N>::uniform(domain, [N, N], 0, [false, false]).unwrap_or_else(|e| panic!("{e}"));
        let id = mesh.tree().leaves()[0];
        for law in [Hardening::perfect(4e8), Hardening::linear(4e8, 8e9)] {
            let plasticity = Plasticity::new(law.unwrap_or_else(|e| panic!("{e}")), speeds);
            let mut block: Vec<f64> = (0..10 * N * N).map(|k| 1e9 * (k as f64 * 0.37).sin()).collect();
            block[6 * N * N..7 * N * N].fill(1e-3);
            let energy = |block: &[f64]| -> f64 {
                let at = |c: usize, k: usize| block[c * N * N + k];
                let of = |k: usize| {
                    let stress = Stress { zz: at(2, k), zr: at(3, k), rr: at(4, k), phiphi: at(5, k) };
                    mesh.volume(id, k / N) * stress.deviatoric_energy(speeds.shear_modulus())
                };
                (0..N * N).map(of).sum()
            };
            let (before, mut report) = (energy(&block), PlasticReport::default());
            let count = return_block(&plasticity, &mesh, id, &mut block, 1e-6, &mut report);
            let lost = before - energy(&block);
            assert!(count > 20 && (report.released / lost - 1.0).abs() < 1e-12, "{lost} {report:?}");
            assert!(report.work < report.released && report.rate > 0.0 && report.strain > 1e-3, "{report:?}");
        }
    }
}
