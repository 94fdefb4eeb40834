//! How components are carried by the mass: reconstruction, fluxes, update.

use mesh::{AlignedRow, Limiter, Padded, limited_differences};

use crate::step::face_rows::FaceRows;
use crate::step::update::Metric;

/// What a thread works in for one component.
pub(crate) struct CarriedScratch {
    s_z: AlignedRow,
    s_r: AlignedRow,
    half: AlignedRow,
    /// ρY times the velocity through the faces along z and r, indexed as [`FaceRows`].
    pub fluxes: [AlignedRow; 2],
}

/// Padded cells at the beginning of the step.
pub(crate) struct CarriedCells<'a> {
    /// Y of the component.
    pub fraction: &'a [f64],
    /// v_z, v_r.
    pub velocity: [&'a [f64]; 2],
    /// Distance between cells that neighbour each other along r.
    pub stride: usize,
    /// 1/h_z, 1/h_r.
    pub inverse_h: [f64; 2],
}

impl CarriedScratch {
    pub fn new<const N: usize>() -> Self {
        let row = || AlignedRow::zeros(Padded::<N>::LEN, Padded::<N>::STRIDE);
        Self { s_z: row(), s_r: row(), half: row(), fluxes: [row(), row()] }
    }

    /// The fluxes of a component: the mass flux times the mass fraction of the cell that it comes from, on the face and at mid-step.
    ///
    /// MUSCL-Hancock for Y,t + v·∇Y = 0. What has one mass fraction everywhere keeps it to round-off: its flux is that of the mass.
    ///
    /// - `faces`: the mass fluxes along z and r.
    pub fn carry(&mut self, cells: &CarriedCells<'_>, limiter: Limiter, dt: f64, faces: [&FaceRows; 2]) {
        let CarriedCells { fraction, velocity, stride, inverse_h } = *cells;
        limited_differences(limiter, fraction, stride, &mut self.s_z, &mut self.s_r);
        let half_dt = 0.5 * dt;
        for (k, half) in self.half.iter_mut().enumerate() {
            let along_z = velocity[0][k] * self.s_z[k] * inverse_h[0];
            let along_r = velocity[1][k] * self.s_r[k] * inverse_h[1];
            *half = fraction[k] - half_dt * (along_z + along_r);
        }
        for ((fluxes, faces), (slopes, step)) in
            self.fluxes.iter_mut().zip(faces).zip([(&self.s_z, 1), (&self.s_r, stride)])
        {
            let count = fraction.len() - step;
            for k in 0..count {
                let mass = faces.mass[k];
                let upwind = if mass > 0.0 {
                    self.half[k] + 0.5 * slopes[k]
                } else {
                    self.half[k + step] - 0.5 * slopes[k + step]
                };
                fluxes[k] = mass * upwind;
            }
        }
    }

    /// The fluxes of a component that is a part of the gas: the gas's mass flux times the part of its mass in the cell that it comes from.
    ///
    /// At first order, as the gas's own part of the mass is: what has one part of the gas everywhere keeps it to the last bit.
    ///
    /// - `fraction`: Y; `gas_shares`: m_g/ρ, both of the padded cells; `stride`: as [`CarriedCells::stride`].
    pub fn carry_with_gas(
        &mut self,
        fraction: &[f64],
        gas_shares: &[f64],
        stride: usize,
        faces: [&FaceRows; 2],
    ) {
        for ((part, own), gas) in self.half.iter_mut().zip(fraction).zip(gas_shares) {
            *part = if *gas > 0.0 { (own / gas).clamp(0.0, 1.0) } else { 0.0 };
        }
        for ((fluxes, faces), step) in self.fluxes.iter_mut().zip(faces).zip([1, stride]) {
            let gas = faces.gas();
            for k in 0..fraction.len() - step {
                fluxes[k] = gas[k] * self.half[if gas[k] >= 0.0 { k } else { k + step }];
            }
        }
    }

    /// Adds to the fluxes along z and r.
    pub fn add(&mut self, more: [&[f64]; 2]) {
        for (fluxes, more) in self.fluxes.iter_mut().zip(more) {
            fluxes.iter_mut().zip(more).for_each(|(flux, more)| *flux += more);
        }
    }

    /// The component's new cells: ρY of the beginning less what has left through the faces.
    pub fn update<const N: usize>(&self, old: &[f64], metric: &Metric<'_>, new: &mut [f64]) {
        let [z, r] = &self.fluxes;
        for j in 0..N {
            let row = metric.row(j);
            for i in 0..N {
                let (cell, k) = (j * N + i, metric.origin + j * metric.stride + i);
                new[cell] = old[cell] - (row.axial(z[k], z[k - 1]) + row.radial(r[k], r[k - metric.stride]));
            }
        }
    }
}
