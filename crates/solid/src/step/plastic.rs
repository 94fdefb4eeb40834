//! Plastic flow within a step: the return of the new cells, and that of the states at mid-step.
//!
//! The update makes trial stresses, elastic over the whole step; the return then gives the stresses at its end. The fluxes are
//! those of mid-step, which the elastic predictor would put outside of the yield surface by 3μ times half a step's plastic
//! strain, an error of first order. So its states are returned, too, over half a step.

use mesh::{BlockId, Mesh, Padded, maximum};
use multiversion::multiversion;

use super::BlockStep;
use super::scratch::BlockScratch;
use crate::components::{PLASTIC_STRAIN, TEMPERATURE};
use crate::material::yield_criterion::von_mises_squared;
use crate::plasticity::{PlasticRows, Plasticity};
use crate::state::component::COUNT;
use crate::step::flow_of_strips::most_mises_at_rest;
use crate::step::mises::largest_mises;
use crate::step::report::{BlockReport, PlasticReport};

/// Cells that are returned together: whole rows of a block.
const BATCH: usize = 64;
/// The most rows that are.
const MOST_ROWS: usize = 8;
/// Cells that are looked at in a SIMD batch.
const LANES: usize = 8;

/// What a return in a step of time has besides the cells.
pub(crate) struct InStep<'a> {
    /// Its length, s.
    pub dt: f64,
    /// What has flowed until mid-step, in padded rows, if it is known.
    pub by_middle: Option<&'a [f64]>,
    /// Written: dε_p/dt, 1/s.
    pub rates: &'a mut [f64],
}

/// What a return of a block tells besides its [`PlasticReport`].
pub(crate) struct BlockReturn {
    /// How many cells flowed.
    pub cells: u32,
    /// The largest squared von Mises stress after it, Pa²; infinite if one is not a number.
    pub mises_squared: f64,
}

/// Returns the cells of a block onto their yield surfaces.
///
/// [`Plasticity::return_rows`]; what flows is counted.
///
/// - `block`: the trial stresses with plastic strain and temperature at the beginning. `step`: `None` after what is no step, a
///   correction along a level jump or a change of the grid: a law without rate returns all the same; one with rate does
///   not flow in no time, so what such a change has added stays as overstress and relaxes in the next step. (Another return
///   over Δt would let the overstress that a rate holds relax twice.)
/// - returns: `report` gets all but the counts.
/// - tested by: the change of the elastic energy; ledgers of adaptive runs.
pub(crate) fn return_block<const N: usize>(
    plasticity: &Plasticity,
    mesh: &Mesh<N>,
    id: BlockId,
    block: &mut [f64],
    mut step: Option<InStep<'_>>,
    report: &mut PlasticReport,
) -> BlockReturn {
    const { assert!(BATCH.is_multiple_of(N) && BATCH / N <= MOST_ROWS) };
    let mut components = block.chunks_exact_mut(N * N);
    let mut next = || components.next().expect("fields of what can yield have plastic strain");
    let [_, _, zz, zr, rr, phiphi, strain] = std::array::from_fn(|_| next());
    let temperature = if plasticity.has_heat() { components.next().unwrap_or_default() } else { &mut [] };
    let dt = step.as_ref().map_or(0.0, |step| step.dt);
    let (mut count, mut totals) = (0, Totals::default());
    let (mut increment, mut work, mut no_rates) = ([0.0; BATCH], [0.0; BATCH], [0.0; BATCH]);
    for first in (0..N * N).step_by(BATCH) {
        if plasticity.wants_guess() {
            increment.fill(0.0);
        }
        if let Some(by_middle) = step.as_ref().and_then(|step| step.by_middle) {
            for (row, increments) in increment.chunks_exact_mut(N).enumerate() {
                let at = Padded::<N>::index(0, (first / N + row) as isize);
                let half = by_middle[at..].iter();
                increments.iter_mut().zip(half).for_each(|(own, half)| *own = 2.0 * half);
            }
        }
        let mut rows = PlasticRows {
            stress_zz: &mut zz[first..][..BATCH],
            stress_zr: &mut zr[first..][..BATCH],
            stress_rr: &mut rr[first..][..BATCH],
            stress_phiphi: &mut phiphi[first..][..BATCH],
            strain: &mut strain[first..][..BATCH],
            temperature: temperature.get_mut(first..first + BATCH).unwrap_or_default(),
            increment: &mut increment,
            work: &mut work,
        };
        count += plasticity.return_rows(&mut rows, dt);
        let (per_second, rates) = match &mut step {
            Some(step) => (1.0 / step.dt, &mut step.rates[first..][..BATCH]),
            None => (0.0, &mut no_rates[..]),
        };
        let volumes: [f64; MOST_ROWS] =
            std::array::from_fn(|row| if row < BATCH / N { mesh.volume(id, first / N + row) } else { 0.0 });
        tally::<N>(rows.all_but_temperature(), volumes, per_second, rates, &mut totals);
    }
    report.work += totals.work.iter().sum::<f64>();
    if count > 0 && dt > 0.0 {
        report.rate = report.rate.max(maximum(&totals.increment) / dt);
    }
    (report.strain, report.temperature) = (maximum(&totals.strain), maximum(temperature));
    // No block has that many cells.
    let cells = u32::try_from(count).unwrap_or(u32::MAX);
    BlockReturn { cells, mises_squared: maximum(&totals.mises_squared) }
}

/// Of a block, by SIMD lanes.
#[derive(Clone, Copy, Default)]
struct Totals {
    /// Plastic work, J.
    work: [f64; LANES],
    /// The largest.
    increment: [f64; LANES],
    strain: [f64; LANES],
    mises_squared: [f64; LANES],
}

/// Looks once at all that a return has made of some rows of cells.
///
/// - `volumes`: of a cell in each row, m³. `rates`: written, the increments times `per_second`.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
fn tally<const N: usize>(
    cells: [&mut [f64]; 7],
    volumes: [f64; MOST_ROWS],
    per_second: f64,
    rates: &mut [f64],
    totals: &mut Totals,
) {
    let [zz, zr, rr, phiphi, strain, increment, work] = cells.map(|row| row.as_chunks::<LANES>().0);
    let rates = rates.as_chunks_mut::<LANES>().0;
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    // In registers.
    let mut own = *totals;
    for (row, volume) in volumes.into_iter().take(BATCH / N).enumerate() {
        for k in row * (N / LANES)..(row + 1) * (N / LANES) {
            for lane in 0..LANES {
                let grown = increment[k][lane];
                rates[k][lane] = grown * per_second;
                own.work[lane] += volume * work[k][lane];
                let mises = von_mises_squared(zz[k][lane], zr[k][lane], rr[k][lane], phiphi[k][lane]);
                let mises = if mises <= f64::MAX { mises } else { f64::INFINITY };
                own.mises_squared[lane] = larger(mises, own.mises_squared[lane]);
                own.increment[lane] = larger(grown, own.increment[lane]);
                own.strain[lane] = larger(strain[k][lane], own.strain[lane]);
            }
        }
    }
    *totals = own;
}

/// Takes the largest plastic strain and the highest temperature of a block's cells into its report.
pub(crate) fn measure_flow<const N: usize>(block: &[f64], report: &mut PlasticReport) {
    let largest = |component: usize| block.chunks_exact(N * N).nth(component).map_or(0.0, maximum);
    report.strain = largest(PLASTIC_STRAIN);
    report.temperature = largest(TEMPERATURE);
}

/// How much q grows elastically between two rows of stresses, over 3μ: a guess of what flows where it stays on its surface.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
fn guess_flow(before: [&[f64]; 4], trial: [&[f64]; 4], three_mu: f64, guess: &mut [f64]) {
    let n = guess.len();
    let (before, trial) = (before.map(|row| &row[..n]), trial.map(|row| &row[..n]));
    let ([zz, zr, rr, phiphi], [a, b, c, d]) = (trial, before);
    for k in 0..n {
        let grown = von_mises_squared(zz[k], zr[k], rr[k], phiphi[k]).sqrt()
            - von_mises_squared(a[k], b[k], c[k], d[k]).sqrt();
        guess[k] = grown / three_mu;
    }
}

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
        let [_, _, zz, zr, rr, phiphi] = half.split_mut::<COUNT>().map(|row| &mut row[first..][..n]);
        let cold = plasticity.reference();
        let is_warm = plasticity.has_heat() && !self.is_untouched;
        let hottest = if is_warm { maximum(&cells.component(TEMPERATURE)[first..][..n]) } else { cold };
        // Most blocks need no look at their cells. What has just flowed goes on with it.
        let most_mises = most_mises_at_rest(plasticity, hottest);
        let has_flowed = self.ctx.model.flows(self.slot);
        flow.acts = has_flowed || !(largest_mises([&*zz, &*zr, &*rr, &*phiphi]) <= most_mises);
        if !flow.acts {
            return;
        }
        let strain = &mut flow.strain[first..][..n];
        if self.is_untouched {
            strain.fill(0.0);
        } else {
            // Ghosts that are predicted or continued may have less than none.
            let old = &cells.component(PLASTIC_STRAIN)[first..][..n];
            strain.iter_mut().zip(old).for_each(|(own, old)| *own = old.max(0.0));
        }
        let temperature = flow.temperature.get_mut(first..first + n).unwrap_or_default();
        if is_warm {
            temperature.copy_from_slice(&cells.component(TEMPERATURE)[first..][..n]);
        } else {
            temperature.fill(cold);
        }
        let increment = &mut flow.increment[first..][..n];
        if plasticity.wants_guess() {
            let [_, _, a, b, c, d] = cells.split::<COUNT>().map(|row| &row[first..][..n]);
            guess_flow([a, b, c, d], [&*zz, &*zr, &*rr, &*phiphi], 3.0 * plasticity.mu(), increment);
        }
        let mut rows = PlasticRows {
            stress_zz: zz,
            stress_zr: zr,
            stress_rr: rr,
            stress_phiphi: phiphi,
            strain,
            temperature,
            increment,
            work: &mut flow.work[first..][..n],
        };
        plasticity.return_rows(&mut rows, 0.5 * self.ctx.dt);
    }

    /// The return of the new cells.
    pub(super) fn flow(&self, scratch: &BlockScratch<N>, new: &mut [f64], report: &mut BlockReport) {
        let Self { ctx, slot, id, .. } = *self;
        let model = ctx.model;
        let (Some(plasticity), Some(following)) = (&model.plasticity, &model.following) else { return };
        let stays = COUNT * N * N..new.len();
        let has_yielded = model.untouched.has_yielded(slot);
        let mut follower = following.of_block(slot);
        follower.count(ctx.time, ctx.dt, ctx.old.block(slot));
        let rates = &mut follower.rates;
        let is_within =
            |temperature: f64| report.mises_squared <= most_mises_at_rest(plasticity, temperature);
        if !has_yielded && is_within(plasticity.reference()) {
            if !model.untouched.is_written(slot, new) {
                new[stays.clone()].copy_from_slice(&ctx.old.block(slot)[stays]);
            }
            report.plastic.temperature = plasticity.reference();
            return rates.clear();
        }
        new[stays.clone()].copy_from_slice(&ctx.old.block(slot)[stays]);
        if plasticity.has_heat() || is_within(plasticity.reference()) {
            measure_flow::<N>(new, &mut report.plastic);
            if is_within(report.plastic.temperature) {
                return rates.clear();
            }
        }
        let has_guess = scratch.flow.acts && plasticity.wants_guess();
        let by_middle = has_guess.then_some(&scratch.flow.increment[..]);
        let step = InStep { dt: ctx.dt, by_middle, rates: &mut rates.cells };
        let returned = return_block(plasticity, ctx.mesh, id, new, Some(step), &mut report.plastic);
        (report.plastic.returned, report.mises_squared) = (returned.cells, returned.mises_squared);
        rates.is_zero = returned.cells == 0;
        if !rates.is_zero {
            model.untouched.yields(slot);
        }
    }
}

#[cfg(test)]
mod tests {
    use mesh::{Domain, Geometry};

    use super::*;
    use crate::WaveSpeeds;
    use crate::plasticity::{Hardening, Stress};

    /// The elastic energy that the cells lose is the plastic work and what the trial was beyond the surface, whatever the law.
    #[test]
    fn a_return_takes_the_plastic_work_and_the_overshoot_of_the_trial() {
        const N: usize = 8;
        let speeds = WaveSpeeds { density: 7800.0, c1: 5990.0, c2: 3458.0 };
        let domain = Domain { geometry: Geometry::Axisymmetric, z: [0.0, 1.0], r: [0.0, 1.0] };
        let mesh = Mesh::<N>::uniform(domain, [N, N], 0, [false, false]).unwrap_or_else(|e| panic!("{e}"));
        let id = mesh.tree().leaves()[0];
        for law in [Hardening::perfect(4e8), Hardening::linear(4e8, 8e9)] {
            let plasticity = Plasticity::new(law.unwrap_or_else(|e| panic!("{e}")), speeds);
            let mut block: Vec<f64> = (0..7 * N * N).map(|k| 1e9 * (k as f64 * 0.37).sin()).collect();
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
            let mut rates = vec![0.0; N * N];
            let step = InStep { dt: 1e-6, by_middle: None, rates: &mut rates };
            let count = return_block(&plasticity, &mesh, id, &mut block, Some(step), &mut report).cells;
            assert_eq!(rates.iter().filter(|rate| **rate > 0.0).count(), count as usize);
            let square = |(k, rate): (usize, &f64)| mesh.volume(id, k / N) * (1e-6 * rate).powi(2);
            let overshoot = 1.5 * plasticity.mu() * rates.iter().enumerate().map(square).sum::<f64>();
            let lost = before - energy(&block);
            assert!(
                count > 20 && ((report.work + overshoot) / lost - 1.0).abs() < 1e-12,
                "{lost} {report:?}"
            );
            assert!(report.work > 0.0 && report.rate > 0.0 && report.strain > 1e-3, "{report:?}");
        }
    }
}
