//! Numbers of plastic flow.

use mesh::Field;

use crate::SolidSolver;
use crate::components::{PLASTIC_STRAIN, TEMPERATURE};

/// The cells whose plastic strain exceeds a threshold.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlasticZone {
    /// How far below z_max the lowest of them ends, m.
    pub depth: f64,
    /// Where the outermost of them ends, m.
    pub radius: f64,
    /// Their volume, m³ (planar: m² per metre of depth).
    pub volume: f64,
}

impl<const N: usize> SolidSolver<N> {
    /// Whether it can yield.
    pub fn is_plastic(&self) -> bool {
        self.model().plasticity.is_some()
    }

    /// Whether temperature is a part of its state.
    pub fn has_heat(&self) -> bool {
        self.state().components() > TEMPERATURE
    }

    /// The plastic strain of one cell; 0 where nothing can yield.
    pub fn plastic_strain(&self, slot: usize, i: usize, j: usize) -> f64 {
        self.component_or(0.0, PLASTIC_STRAIN, slot, j * N + i)
    }

    /// The temperature of one cell, K; NaN where it is no part of the state.
    pub fn temperature(&self, slot: usize, i: usize, j: usize) -> f64 {
        if self.has_heat() { self.component_or(f64::NAN, TEMPERATURE, slot, j * N + i) } else { f64::NAN }
    }

    /// The displacement (u_z, u_r) of one cell since t = 0, m: the integral of its velocity; `None` where nothing can yield, and none is
    /// kept.
    pub fn displacement(&self, slot: usize, i: usize, j: usize) -> Option<[f64; 2]> {
        let follower = self.model().following.as_ref()?.of_block(slot);
        let mut moved = follower.displacement(self.time(), self.block(slot)).skip(j * N + i).step_by(N * N);
        Some([moved.next()?, moved.next()?])
    }

    /// u_z and u_r of all cells, as [`SolidSolver::displacement`]: what a wall that is hit again starts with.
    pub fn displacements(&self) -> Option<Field> {
        Some(self.model().following.as_ref()?.displacements(N * N, self.time(), |slot| self.block(slot)))
    }

    fn component_or(&self, other: f64, component: usize, slot: usize, cell: usize) -> f64 {
        if component < self.state().components() { self.component(slot, component)[cell] } else { other }
    }

    /// The largest plastic strain of a cell; 0 where nothing can yield.
    pub fn plastic_strain_max(&self) -> f64 {
        self.reports().finished.iter().map(|report| report.plastic.strain).fold(0.0, f64::max)
    }

    /// The highest temperature, K; 0 where it is no part of the state.
    pub fn temperature_max(&self) -> f64 {
        self.reports().finished.iter().map(|report| report.plastic.temperature).fold(0.0, f64::max)
    }

    /// The cells whose plastic strain exceeds a threshold.
    pub fn plastic_zone(&self, threshold: f64) -> PlasticZone {
        let domain = self.mesh().domain();
        let mut zone = PlasticZone::default();
        for (slot, id) in self.mesh().tree().leaves().iter().enumerate() {
            if self.reports().finished[slot].plastic.strain <= threshold {
                continue;
            }
            let [h_z, h_r] = self.mesh().widths(id.level);
            for j in 0..N {
                for i in (0..N).filter(|i| self.plastic_strain(slot, *i, j) > threshold) {
                    let [z, r] = self.mesh().centre(*id, i, j);
                    zone.depth = zone.depth.max(domain.z[1] - (z - 0.5 * h_z));
                    zone.radius = zone.radius.max(r + 0.5 * h_r);
                    zone.volume += domain.geometry.turn() * self.mesh().volume(*id, j);
                }
            }
        }
        zone
    }

    /// The integral of the plastic strain over the domain, m³, per radian in axial symmetry, per metre of depth in planar geometry.
    pub fn plastic_strain_integral(&self) -> f64 {
        let block = |(slot, id): (usize, &mesh::BlockId)| -> f64 {
            let cells = self.component(slot, PLASTIC_STRAIN).chunks_exact(N).enumerate();
            cells.map(|(j, row)| self.mesh().volume(*id, j) * row.iter().sum::<f64>()).sum()
        };
        if self.is_plastic() { self.mesh().tree().leaves().iter().enumerate().map(block).sum() } else { 0.0 }
    }
}
