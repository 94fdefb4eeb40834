//! Numbers that are read off the solid's state.

pub(crate) mod ledger;
pub(crate) mod plastic;
mod totals;

pub use totals::Totals;

use mesh::Padded;

use crate::state::component::{COUNT, S_PHIPHI};
use crate::step::{BlockScratch, reconstruct};
use crate::{ElasticState, SolidSolver, von_mises, yield_function};

/// The largest von Mises stress and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MisesPeak {
    /// Stress, Pa.
    pub stress: f64,
    /// Centre of the cell (z, r), m.
    pub position: [f64; 2],
}

mesh::cell_fields! {
    Snapshot, CELL_FIELDS {
        velocity: 3, "m/s", "velocity (z, r, 0)";
        stress_zz: 1, "Pa", "axial stress, positive in tension";
        stress_zr: 1, "Pa", "shear stress";
        stress_rr: 1, "Pa", "radial stress";
        stress_phiphi: 1, "Pa", "hoop stress";
        von_mises: 1, "Pa", "von Mises stress";
        yield_function: 1, "Pa", "von Mises stress minus yield strength";
        plastic_strain: 1, "1", "plastic strain";
        plastic_strain_rate: 1, "1/s", "rate of the plastic strain in the last step";
        displacement: 3, "m", "displacement (u_z, u_r, 0) since t = 0";
        temperature: 1, "K", "temperature";
        level: 1, "1", "refinement level";
    }
}

impl<const N: usize> SolidSolver<N> {
    /// The state of one cell.
    pub fn cell(&self, slot: usize, i: usize, j: usize) -> ElasticState {
        ElasticState::from_array(std::array::from_fn(|c| self.state().component(slot, c)[j * N + i]))
    }

    /// The largest von Mises stress and where it is.
    pub fn mises_peak(&self) -> MisesPeak {
        let (slot, _) = (self.mises_by_block().enumerate())
            .fold((0, -1.0), |best, (slot, stress)| if stress > best.1 { (slot, stress) } else { best });
        let id = self.mesh().tree().leaves()[slot];
        let mut peak = MisesPeak { stress: -1.0, position: [f64::NAN; 2] };
        for j in 0..N {
            for i in 0..N {
                let w = self.cell(slot, i, j);
                let stress = von_mises(w.stress_zz, w.stress_zr, w.stress_rr, w.stress_phiphi);
                if stress > peak.stress {
                    peak = MisesPeak { stress, position: self.mesh().centre(id, i, j) };
                }
            }
        }
        peak
    }

    /// The largest von Mises stress in each block, Pa.
    fn mises_by_block(&self) -> impl Iterator<Item = f64> + '_ {
        self.reports().finished.iter().map(|report| report.mises_squared.sqrt())
    }

    /// The volume in which the von Mises stress exceeds the yield strength, m³ (planar: m² per metre of depth).
    pub fn yielded_volume(&self) -> f64 {
        self.mesh().domain().geometry.turn()
            * self.reports().finished.iter().map(|report| report.yielded).sum::<f64>()
    }

    /// The state at a point by the linear reconstruction in the cell that contains it; `None` outside.
    pub fn sample(&self, point: [f64; 2]) -> Option<ElasticState> {
        let ((slot, i, j), [a, b]) = self.mesh().place_in_cell(point)?;
        let k = Padded::<N>::index(i as isize, j as isize);
        Some(self.with_scratch(|scratch| {
            reconstruct(&self.context(0.0), slot, scratch);
            let BlockScratch { cells, s_z, s_r, .. } = scratch;
            let hoop = cells.component(S_PHIPHI);
            let stride = Padded::<N>::STRIDE;
            let limiter = self.setup().limiter;
            let hoop_slope =
                |step: usize| limiter.difference(hoop[k] - hoop[k - step], hoop[k + step] - hoop[k]);
            ElasticState::from_array(std::array::from_fn(|c| {
                let (d_z, d_r) = if c == S_PHIPHI {
                    (hoop_slope(1), hoop_slope(stride))
                } else {
                    (s_z.component(c)[k], s_r.component(c)[k])
                };
                cells.component(c)[k] + a * d_z + b * d_r
            }))
        }))
    }

    /// All fields, cell by cell.
    pub fn snapshot(&self) -> Snapshot {
        let mut snapshot = Snapshot::default();
        // Room at once: lists that grow side by side leave holes behind, of as much memory again.
        let cells = self.mesh().cells();
        snapshot.velocity.reserve_exact(3 * cells);
        let Snapshot { stress_zz, stress_zr, stress_rr, stress_phiphi, level, .. } = &mut snapshot;
        let stresses = [stress_zz, stress_zr, stress_rr, stress_phiphi];
        stresses.into_iter().chain([level]).for_each(|values| values.reserve_exact(cells));
        snapshot.von_mises.reserve_exact(cells);
        snapshot.yield_function.reserve_exact(cells);
        for (slot, id) in self.mesh().tree().leaves().iter().enumerate() {
            for j in 0..N {
                for i in 0..N {
                    let w = self.cell(slot, i, j);
                    let mises = von_mises(w.stress_zz, w.stress_zr, w.stress_rr, w.stress_phiphi);
                    snapshot.velocity.extend([w.v_z, w.v_r, 0.0]);
                    snapshot.stress_zz.push(w.stress_zz);
                    snapshot.stress_zr.push(w.stress_zr);
                    snapshot.stress_rr.push(w.stress_rr);
                    snapshot.stress_phiphi.push(w.stress_phiphi);
                    snapshot.von_mises.push(mises);
                    snapshot.yield_function.push(yield_function(mises, self.setup().yield_strength));
                    snapshot.level.push(f64::from(id.level));
                }
            }
            for (number, component) in self.model().components.iter().enumerate() {
                (component.put)(&mut snapshot, self.state().component(slot, COUNT + number));
            }
            if let Some(following) = &self.model().following {
                let follower = following.of_block(slot);
                snapshot.plastic_strain_rate.extend(&follower.rates.cells);
                let moved: Vec<f64> = follower.displacement(self.time(), self.state().block(slot)).collect();
                let (u_z, u_r) = moved.split_at(N * N);
                snapshot.displacement.extend(u_z.iter().zip(u_r).flat_map(|(u_z, u_r)| [*u_z, *u_r, 0.0]));
            }
        }
        snapshot
    }
}
