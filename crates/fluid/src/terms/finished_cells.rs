//! The cells of a block at the end of its step, for terms that change them once more.

use crate::Mixture;
use crate::capillarity::CapillaryRows;
use crate::state::ConservedCell;
use crate::state::conserved::{self, ENERGY, GAS, MOMENTUM_R, MOMENTUM_Z, RHO};
use crate::state::finished::FinishedCell;
use crate::step::update::Metric;

/// The cells of a block at the end of its step.
pub(crate) struct FinishedCells<'a> {
    /// Cells along a side.
    pub cells: usize,
    pub metric: &'a Metric<'a>,
    /// φ of the padded cells at the beginning of the step.
    pub phi: &'a [f64],
    /// Conserved components `[component][j][i]` without ghosts.
    pub new: &'a mut [f64],
    /// |v_z| + c and |v_r| + c of those cells, and the energy that the floor added.
    pub speeds: [&'a mut [f64]; 3],
    /// Surface tension at the beginning of the step.
    pub capillary: &'a CapillaryRows,
    pub mixture: &'a Mixture,
    /// The volume of a cell in a row, per radian in axial symmetry.
    pub volume: &'a dyn Fn(usize) -> f64,
    /// What the cells' energy has changed by, J per radian: the work of surface tension, see [`SinglePressure`].
    ///
    /// [`SinglePressure`]: crate::capillarity::SinglePressure
    pub tension_work: f64,
}

impl FinishedCells<'_> {
    /// What is conserved in a cell and its φ, and its m_g.
    pub fn get(&self, cell: usize) -> (ConservedCell, f64) {
        let of = |component: usize| self.new[component * self.cells * self.cells + cell];
        ([RHO, MOMENTUM_Z, MOMENTUM_R, ENERGY, conserved::PHI].map(of), of(GAS))
    }

    /// Puts another state in the place of a cell's.
    pub fn set(&mut self, cell: usize, finished: FinishedCell) {
        let cells = self.cells * self.cells;
        for (component, value) in finished.conserved.into_iter().enumerate() {
            self.new[component * cells + cell] = value;
        }
        for (row, value) in self.speeds.iter_mut().zip([finished.speed_z, finished.speed_r]) {
            row[cell] = value;
        }
    }

    /// Changes the cells that hold gas and liquid: `change` gets one's conserved variables and m_g, its padded place and its row.
    pub fn change_mixed(
        &mut self,
        is_mixed: impl Fn(f64) -> bool,
        change: impl Fn(&Self, (ConservedCell, f64), (usize, usize)) -> Option<FinishedCell>,
    ) {
        let n = self.cells;
        for cell in 0..n * n {
            let (u, gas) = self.get(cell);
            if !(is_mixed(u[conserved::PHI]) && gas > 0.0 && u[RHO] > gas) {
                continue;
            }
            let k = self.metric.origin + cell / n * self.metric.stride + cell % n;
            if let Some(finished) = change(self, (u, gas), (k, cell / n)) {
                let gained = finished.conserved[conserved::ENERGY] - u[conserved::ENERGY];
                self.tension_work += gained * (self.volume)(cell / n);
                self.set(cell, finished);
            }
        }
    }
}
