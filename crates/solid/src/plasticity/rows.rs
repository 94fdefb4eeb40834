//! The radial return over rows of cells.

use std::ops::Range;

use mesh::Blend;
use multiversion::multiversion;

use super::closed;
use super::lanes::{LaneCells, PowerLaw, UNSOLVED, return_lanes};
use super::polyline;
use super::return_map::Plasticity;
use super::screen::{any_beyond, any_beyond_hot};
use super::stress::Stress;

/// Cells that are looked at together: with none of them beyond the surface, none is looked at closely.
const BATCH: usize = 64;

/// The rows of a block that a return changes, cells in one order, all of one length.
#[derive(Debug)]
pub struct PlasticRows<'a> {
    /// σ_zz, Pa: trial stress before, stress after.
    pub stress_zz: &'a mut [f64],
    /// σ_zr, Pa.
    pub stress_zr: &'a mut [f64],
    /// σ_rr, Pa.
    pub stress_rr: &'a mut [f64],
    /// σ_φφ, Pa.
    pub stress_phiphi: &'a mut [f64],
    /// Plastic strain.
    pub strain: &'a mut [f64],
    /// Temperature, K; empty where the law has no heat.
    pub temperature: &'a mut [f64],
    /// Before: a guess of Δε_p for laws that need an iteration, no guess where it is not positive. After: Δε_p, 0 where a cell stays
    /// elastic.
    pub increment: &'a mut [f64],
    /// Written: the plastic work q Δε_p, J/m³.
    pub work: &'a mut [f64],
}

impl Plasticity {
    /// The radial return of all cells of rows; see [`Plasticity::return_map`], which each cell's result equals bitwise where it had no
    /// guess, and to the accuracy said there where it had one.
    ///
    /// A first pass, free of branches, looks at batches of cells; only in batches where a cell may lie outside the cells are looked
    /// at closely. Laws on straight lines and that of Johnson and Cook are then solved many cells at once.
    ///
    /// - `rows`: as [`PlasticRows`] says; elastic cells keep their bits. `dt`: s.
    /// - returns: how many cells flowed.
    /// - valid for: as there.  errors: none; rows of unequal length panic.
    /// - tested by: equality with the single cells.
    pub fn return_rows(&self, rows: &mut PlasticRows<'_>, dt: f64) -> usize {
        if let Some(line) = self.line {
            // As cheap as to look first.
            let [zz, zr, rr, phiphi, strain, increment, work] = rows.all_but_temperature();
            return closed::return_batch(line, zz, zr, rr, phiphi, strain, increment, work);
        }
        if let Some(law) = &self.polyline {
            // Looks first, at fewer cells at a time.
            let [zz, zr, rr, phiphi, strain, increment, work] = rows.all_but_temperature();
            return polyline::return_batch(law, zz, zr, rr, phiphi, strain, increment, work);
        }
        let n = rows.strain.len();
        let mut count = 0;
        for first in (0..n).step_by(BATCH) {
            let mut batch = rows.part(first..(first + BATCH).min(n));
            let stress = [&*batch.stress_zz, &*batch.stress_zr, &*batch.stress_rr, &*batch.stress_phiphi];
            let any = if self.has_heat() {
                any_beyond_hot(&self.screen, stress, batch.strain, batch.temperature)
            } else {
                any_beyond(&self.screen, stress, batch.strain)
            };
            if !any {
                batch.increment.fill(0.0);
                batch.work.fill(0.0);
            } else if let Some(law) = &self.power {
                count += self.return_power(law, &mut batch, dt);
            } else {
                batch.increment.fill(UNSOLVED);
                count += self.return_singly(&mut batch, dt);
            }
        }
        count
    }

    /// The radial return of stresses alone, by laws on straight lines: others need a time, or heat.
    ///
    /// - `stress`: σ_zz, σ_zr, σ_rr, σ_φφ, Pa, trial stresses before. `strain`: plastic strains at the beginning, less than none counts as none; not
    ///   looked at where [`Plasticity::needs_strain`] is false.
    /// - returns: `false` where the law is no such one, nothing happens then.
    /// - tested by: equality with [`Plasticity::return_rows`].
    pub(crate) fn return_stresses(&self, [zz, zr, rr, phiphi]: [&mut [f64]; 4], strain: &[f64]) -> bool {
        match (&self.line, &self.polyline) {
            (Some(line), _) if line.is_level() => {
                closed::return_stresses_to_level(*line, zz, zr, rr, phiphi);
            }
            (Some(line), _) => closed::return_stresses(*line, zz, zr, rr, phiphi, strain),
            (None, Some(law)) => polyline::return_stresses(law, zz, zr, rr, phiphi, strain),
            (None, None) => return false,
        }
        true
    }

    /// A batch by the Johnson–Cook law.
    fn return_power(&self, law: &PowerLaw, batch: &mut PlasticRows<'_>, dt: f64) -> usize {
        let n = batch.strain.len();
        let (mut von_mises, mut rise, mut left) = ([0.0; BATCH], [0.0; BATCH], [0.0; BATCH]);
        begin(self.reference(), batch, &mut von_mises[..n], &mut rise[..n]);
        let cells = LaneCells {
            von_mises: &von_mises[..n],
            strain: batch.strain,
            rise: if self.has_heat() { &rise[..n] } else { &[] },
            increment: batch.increment,
            left: &mut left[..n],
        };
        return_lanes(law, cells, law.time(dt));
        let (solved, unsolved) = end(self.heating(), batch, &von_mises[..n], &left[..n]);
        if unsolved > 0 { solved + self.return_singly(batch, dt) } else { solved }
    }

    /// Cells of a batch one by one, those whose increments are [`UNSOLVED`].
    fn return_singly(&self, batch: &mut PlasticRows<'_>, dt: f64) -> usize {
        let hot = self.has_heat();
        let mut count = 0;
        for k in 0..batch.strain.len() {
            if batch.increment[k] != UNSOLVED {
                continue;
            }
            (batch.increment[k], batch.work[k]) = (0.0, 0.0);
            let temperature = if hot { batch.temperature[k] } else { 0.0 };
            let stress = Stress {
                zz: batch.stress_zz[k],
                zr: batch.stress_zr[k],
                rr: batch.stress_rr[k],
                phiphi: batch.stress_phiphi[k],
            };
            let returned = self.return_bracketed(stress, batch.strain[k], temperature, dt);
            let Some(returned) = returned else { continue };
            let Stress { zz, zr, rr, phiphi } = returned.stress;
            (batch.stress_zz[k], batch.stress_zr[k]) = (zz, zr);
            (batch.stress_rr[k], batch.stress_phiphi[k]) = (rr, phiphi);
            (batch.strain[k], batch.increment[k]) = (returned.strain, returned.increment);
            batch.work[k] = returned.plastic_work;
            if hot {
                batch.temperature[k] = returned.temperature;
            }
            count += 1;
        }
        count
    }
}

/// q of the trial stresses, Pa, and T − T_r, K.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
fn begin(reference: f64, batch: &PlasticRows<'_>, von_mises: &mut [f64], rise: &mut [f64]) {
    let n = von_mises.len();
    let (zz, zr) = (&batch.stress_zz[..n], &batch.stress_zr[..n]);
    let (rr, phiphi) = (&batch.stress_rr[..n], &batch.stress_phiphi[..n]);
    for k in 0..n {
        let trial = Stress { zz: zz[k], zr: zr[k], rr: rr[k], phiphi: phiphi[k] };
        von_mises[k] = trial.von_mises_squared().sqrt();
    }
    for (rise, temperature) in rise.iter_mut().zip(&*batch.temperature) {
        *rise = temperature - reference;
    }
}

/// Takes solved increments into the cells; tells how many flowed, and how many are not solved.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
fn end(heating: f64, batch: &mut PlasticRows<'_>, von_mises: &[f64], left: &[f64]) -> (usize, usize) {
    let n = von_mises.len();
    let left = &left[..n];
    let (zz, zr) = (&mut batch.stress_zz[..n], &mut batch.stress_zr[..n]);
    let (rr, phiphi) = (&mut batch.stress_rr[..n], &mut batch.stress_phiphi[..n]);
    let (strain, work) = (&mut batch.strain[..n], &mut batch.work[..n]);
    let increment = &batch.increment[..n];
    let (mut solved, mut unsolved, blend) = (0_u64, 0_u64, Blend::new());
    for k in 0..n {
        let flows = increment[k] > 0.0;
        let trial = Stress { zz: zz[k], zr: zr[k], rr: rr[k], phiphi: phiphi[k] };
        let stress = trial.with_deviator_times(left[k] / von_mises[k]);
        let stress = stress.or(blend, flows, trial);
        (zz[k], zr[k], rr[k], phiphi[k]) = (stress.zz, stress.zr, stress.rr, stress.phiphi);
        let select = |new: f64, old: f64| blend.choose(flows, new, old);
        strain[k] = select(strain[k] + increment[k], strain[k]);
        work[k] = select(left[k] * increment[k], 0.0);
        solved += u64::from(flows);
        unsolved += u64::from(increment[k] == UNSOLVED);
    }
    for (temperature, work) in batch.temperature.iter_mut().zip(&*work) {
        *temperature += heating * work;
    }
    (solved as usize, unsolved as usize)
}

impl PlasticRows<'_> {
    /// Some of the cells.
    fn part(&mut self, cells: Range<usize>) -> PlasticRows<'_> {
        PlasticRows {
            stress_zz: &mut self.stress_zz[cells.clone()],
            stress_zr: &mut self.stress_zr[cells.clone()],
            stress_rr: &mut self.stress_rr[cells.clone()],
            stress_phiphi: &mut self.stress_phiphi[cells.clone()],
            strain: &mut self.strain[cells.clone()],
            temperature: self.temperature.get_mut(cells.clone()).unwrap_or_default(),
            increment: &mut self.increment[cells.clone()],
            work: &mut self.work[cells],
        }
    }

    /// All but the temperature, in the order of the fields.
    pub(crate) fn all_but_temperature(&mut self) -> [&mut [f64]; 7] {
        let Self { stress_zz, stress_zr, stress_rr, stress_phiphi, strain, increment, work, .. } = self;
        [stress_zz, stress_zr, stress_rr, stress_phiphi, strain, increment, work]
    }
}
