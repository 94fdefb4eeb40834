//! Numbers that are read off the solid's state.

pub(crate) mod ledger;
pub(crate) mod plastic;
pub(crate) mod strain_peak;
mod totals;

pub use totals::Totals;

use mesh::{CellField, CellLevels, CellSnapshot, Padded};

use crate::state::component::{COUNT, S_NORMAL, S_PHIPHI, S_ZR, V_R, V_Z};
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

/// The fields of a snapshot, cell by cell, and what others are made from; SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    /// Velocity (z, r).
    pub velocity: Vec<[f64; 2]>,
    /// Axial stress, positive in tension.
    pub stress_zz: Vec<f64>,
    /// Shear stress.
    pub stress_zr: Vec<f64>,
    /// Radial stress.
    pub stress_rr: Vec<f64>,
    /// Hoop stress.
    pub stress_phiphi: Vec<f64>,
    /// Plastic strain; empty in elastic solids, as all that follows.
    pub plastic_strain: Vec<f64>,
    /// Rate of the plastic strain in the last step.
    pub plastic_strain_rate: Vec<f64>,
    /// Displacement (u_z, u_r) since t = 0.
    pub displacement: Vec<[f64; 2]>,
    /// Temperature, where the hardening law has heat.
    pub temperature: Vec<f64>,
    levels: CellLevels,
    yield_strength: f64,
}

impl Snapshot {
    /// The von Mises stress of a cell, Pa.
    pub fn von_mises(&self, cell: usize) -> f64 {
        let Self { stress_zz, stress_zr, stress_rr, stress_phiphi, .. } = self;
        von_mises(stress_zz[cell], stress_zr[cell], stress_rr[cell], stress_phiphi[cell])
    }
}

impl CellSnapshot for Snapshot {
    fn levels(&self) -> &CellLevels {
        &self.levels
    }
}

/// What a snapshot has. A field is added here, where the snapshot is filled, and in the estimate of memory if it is held.
pub const CELL_FIELDS: &[CellField<Snapshot>] = &[
    CellField::vector("velocity", "m/s", "velocity (z, r, 0)", |taken| &taken.velocity),
    CellField::scalar("stress_zz", "Pa", "axial stress, positive in tension", |taken| &taken.stress_zz),
    CellField::scalar("stress_zr", "Pa", "shear stress", |taken| &taken.stress_zr),
    CellField::scalar("stress_rr", "Pa", "radial stress", |taken| &taken.stress_rr),
    CellField::scalar("stress_phiphi", "Pa", "hoop stress", |taken| &taken.stress_phiphi),
    CellField::made("von_mises", "Pa", "von Mises stress", Snapshot::von_mises),
    CellField::made("yield_function", "Pa", "von Mises stress minus yield strength", |taken, cell| {
        yield_function(taken.von_mises(cell), taken.yield_strength)
    }),
    CellField::scalar("plastic_strain", "1", "plastic strain", |taken| &taken.plastic_strain),
    CellField::scalar("plastic_strain_rate", "1/s", "rate of the plastic strain in the last step", |taken| {
        &taken.plastic_strain_rate
    }),
    CellField::vector("displacement", "m", "displacement (u_z, u_r, 0) since t = 0", |taken| {
        &taken.displacement
    }),
    CellField::scalar("temperature", "K", "temperature", |taken| &taken.temperature),
    CellField::LEVEL,
];

impl<const N: usize> SolidSolver<N> {
    /// The state of one cell.
    pub fn cell(&self, slot: usize, i: usize, j: usize) -> ElasticState {
        let block = self.block(slot);
        ElasticState::from_array(std::array::from_fn(|c| block[c * N * N + j * N + i]))
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
        let levels = CellLevels::of(self.mesh());
        let yield_strength = self.setup().yield_strength;
        let mut snapshot = Snapshot { levels, yield_strength, ..Snapshot::default() };
        // Room at once: lists that grow side by side leave holes behind, of as much memory again.
        let cells = self.mesh().cells();
        snapshot.velocity.reserve_exact(cells);
        let Snapshot { stress_zz, stress_zr, stress_rr, stress_phiphi, .. } = &mut snapshot;
        for values in [stress_zz, stress_zr, stress_rr, stress_phiphi] {
            values.reserve_exact(cells);
        }
        let [s_zz, s_rr] = S_NORMAL;
        for slot in 0..self.mesh().blocks() {
            let [v_z, v_r] = [V_Z, V_R].map(|component| self.component(slot, component));
            snapshot.velocity.extend(v_z.iter().zip(v_r).map(|(v_z, v_r)| [*v_z, *v_r]));
            let Snapshot { stress_zz, stress_zr, stress_rr, stress_phiphi, .. } = &mut snapshot;
            for (values, component) in
                [(stress_zz, s_zz), (stress_zr, S_ZR), (stress_rr, s_rr), (stress_phiphi, S_PHIPHI)]
            {
                values.extend_from_slice(self.component(slot, component));
            }
            for (number, component) in self.model().components.iter().enumerate() {
                (component.put)(&mut snapshot, self.component(slot, COUNT + number));
            }
            if let Some(following) = &self.model().following {
                let follower = following.of_block(slot);
                snapshot.plastic_strain_rate.extend(&follower.rates.cells);
                let moved: Vec<f64> = follower.displacement(self.time(), self.block(slot)).collect();
                let (u_z, u_r) = moved.split_at(N * N);
                snapshot.displacement.extend(u_z.iter().zip(u_r).map(|(u_z, u_r)| [*u_z, *u_r]));
            }
        }
        snapshot
    }
}
