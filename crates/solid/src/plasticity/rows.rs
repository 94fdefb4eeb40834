//! The radial return over rows of cells.

use std::ops::Range;

use super::closed::{BATCH, Line, LineCells, return_batch};
use super::return_map::{Plasticity, Returned};
use super::screen::{any_beyond, any_beyond_hot};
use super::stress::Stress;

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
}

impl Plasticity {
    /// The radial return of all cells of rows; see [`Plasticity::return_map`], which each cell's result equals bitwise.
    ///
    /// A first pass, free of branches, looks at batches of cells; only in batches where a cell may lie outside the cells
    /// are taken one by one.
    ///
    /// - `rows`: as [`PlasticRows`] says; elastic cells keep their bits. `dt`: s.
    /// - `on_return`: told index and result of each cell that flowed, in order.
    /// - returns: how many cells flowed.
    /// - valid for: as there.  errors: none; rows of unequal length panic.
    /// - tested by: equality with the single cells.
    pub fn return_rows(
        &self,
        rows: &mut PlasticRows<'_>,
        dt: f64,
        mut on_return: impl FnMut(usize, &Returned),
    ) -> usize {
        let (n, hot) = (rows.strain.len(), self.has_heat());
        let mut count = 0;
        for first in (0..n).step_by(BATCH) {
            let batch = first..(first + BATCH).min(n);
            let stress = [
                &rows.stress_zz[batch.clone()],
                &rows.stress_zr[batch.clone()],
                &rows.stress_rr[batch.clone()],
                &rows.stress_phiphi[batch.clone()],
            ];
            let strain = &rows.strain[batch.clone()];
            let any = if hot {
                any_beyond_hot(&self.screen, stress, strain, &rows.temperature[batch.clone()])
            } else {
                any_beyond(&self.screen, stress, strain)
            };
            if !any {
                continue;
            }
            if let Some(line) = self.line {
                count += self.return_lines(rows, line, batch, &mut on_return);
                continue;
            }
            for k in batch {
                let temperature = if hot { rows.temperature[k] } else { 0.0 };
                let Some(returned) = self.return_map(rows.stress(k), rows.strain[k], temperature, dt) else {
                    continue;
                };
                rows.set(k, &returned, hot);
                on_return(k, &returned);
                count += 1;
            }
        }
        count
    }

    /// A batch of a law in closed form.
    fn return_lines(
        &self,
        rows: &mut PlasticRows<'_>,
        line: Line,
        batch: Range<usize>,
        on_return: &mut impl FnMut(usize, &Returned),
    ) -> usize {
        let (mut increment, mut von_mises) = ([0.0; BATCH], [0.0; BATCH]);
        let cells = LineCells {
            stress: [
                &mut rows.stress_zz[batch.clone()],
                &mut rows.stress_zr[batch.clone()],
                &mut rows.stress_rr[batch.clone()],
                &mut rows.stress_phiphi[batch.clone()],
            ],
            strain: &mut rows.strain[batch.clone()],
            increment: &mut increment,
            von_mises: &mut von_mises,
        };
        return_batch(line, cells);
        let mut count = 0;
        for (k, (increment, von_mises)) in batch.zip(increment.into_iter().zip(von_mises)) {
            if increment > 0.0 {
                on_return(k, &self.returned(rows.stress(k), von_mises, rows.strain[k], 0.0, increment));
                count += 1;
            }
        }
        count
    }
}

impl PlasticRows<'_> {
    #[inline]
    fn stress(&self, k: usize) -> Stress {
        Stress {
            zz: self.stress_zz[k],
            zr: self.stress_zr[k],
            rr: self.stress_rr[k],
            phiphi: self.stress_phiphi[k],
        }
    }

    #[inline]
    fn set(&mut self, k: usize, returned: &Returned, hot: bool) {
        let Stress { zz, zr, rr, phiphi } = returned.stress;
        self.stress_zz[k] = zz;
        self.stress_zr[k] = zr;
        self.stress_rr[k] = rr;
        self.stress_phiphi[k] = phiphi;
        self.strain[k] = returned.strain;
        if hot {
            self.temperature[k] = returned.temperature;
        }
    }
}
