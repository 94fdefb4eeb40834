//! Conduction in many stages within one step.

use super::ConductionTerm;
use super::caloric::CellHeat;
use super::faces::{Work, conduct};
use crate::state::primitive::RHO;
use crate::terms::super_stepping::{Frame, Shape, Spreading, View};
use crate::terms::{TermBlock, for_cells_without_mid_step};

impl ConductionTerm {
    /// The axes of the rows of fluxes.
    pub(super) const AXES: [usize; 2] = [0, 1];

    /// Takes the temperatures at mid-step as waves alone make them, of cells that have none those before.
    fn take_temperatures(&self, block: &TermBlock<'_>, work: &mut Work<'_>) {
        self.gather(&block.state, block, work);
        for_cells_without_mid_step(block, |k| {
            let heat: CellHeat = self.heat_in(&block.before, block, k);
            work.set(k, heat);
        });
        Work::set_beyond(block, work.temperature);
    }
}

impl Spreading for ConductionTerm {
    /// Variable: T. Constants: C, and the conductances along z and r.
    fn shape(&self) -> Shape {
        Shape { kind: View::HEAT, variables: 1, constants: 3, axes: &Self::AXES }
    }

    /// λ/C of gas, twice where liquid beside it conducts all there is; of liquid.
    fn diffusivity(&self, density: &[f64], phi: &[f64]) -> f64 {
        let [c_g, c_l] = self.caloric.capacities();
        let [gas, liquid] = [2.0 * self.asked.gas / c_g, self.asked.liquid / c_l];
        super::rows::most_diffusivity([gas, liquid], density, phi)
    }

    /// The largest rate of decay is no more than twice the largest Σ G_f A_f/(C V) of a cell (Gershgorin).
    fn begin(&self, block: &TermBlock<'_>, work: &mut Vec<f64>, kept: [&mut [f64]; 2]) -> f64 {
        let [constants, values] = kept;
        let mut work = Work::of(work, block);
        self.take_temperatures(block, &mut work);
        self.conductances(block, &mut work, false);
        let Work { temperature, capacity, conductances: [g_z, g_r], .. } = work;
        values.copy_from_slice(temperature);
        let mut rows = constants.chunks_exact_mut(temperature.len());
        for row in [&*capacity, g_z, g_r] {
            rows.next().expect("as many as there are").copy_from_slice(row);
        }
        let (n, metric) = (block.cells, block.metric);
        let ([inverse_z, inverse_h], stride) = (metric.inverse_h, metric.stride);
        let mut fastest = 0.0_f64;
        for j in 0..n {
            for k in (0..n).map(|i| metric.origin + j * stride + i) {
                let [low, high] = [-0.5, 0.5].map(|half| 1.0 + half * block.inverse_r[k] / inverse_h);
                let along_z = inverse_z * (g_z[k] + g_z[k - 1]);
                let along_r = inverse_h * (high * g_r[k] + low * g_r[k - stride]);
                fastest = fastest.max(2.0 * (along_z + along_r) / capacity[k]);
            }
        }
        fastest
    }

    fn bounded(&self, block: &TermBlock<'_>, work: &mut Vec<f64>, fluxes: &mut [f64]) {
        let mut work = Work::of(work, block);
        self.take_temperatures(block, &mut work);
        self.conductances(block, &mut work, true);
        work.conduct(block);
        let len = block.state[RHO].len();
        fluxes.chunks_exact_mut(len).zip(work.fluxes).for_each(|(to, from)| to.copy_from_slice(from));
    }

    fn conduct(&self, frame: &Frame, constants: &[f64], values: &mut [f64], fluxes: &mut [f64]) {
        let len = values.len();
        let (z, r) = fluxes.split_at_mut(len);
        let [g_z, g_r] = [1, 2].map(|row| &constants[row * len..(row + 1) * len]);
        conduct(frame.cells, [frame.origin, frame.stride], values, [(g_z, z), (g_r, r)]);
    }

    fn change(&self, frame: &Frame, constants: &[f64], fluxes: &[f64], rates: &mut [f64]) {
        let len = rates.len();
        let (z, r) = fluxes.split_at(len);
        let capacity = &constants[..len];
        let ([inverse_z, inverse_h], stride) = (frame.inverse_h, frame.stride);
        for j in 0..frame.cells {
            for k in (0..frame.cells).map(|i| frame.origin + j * stride + i) {
                let [low, high] = [-0.5, 0.5].map(|half| 1.0 + half * frame.inverse_r[k] / inverse_h);
                let out = inverse_z * (z[k] - z[k - 1]) + inverse_h * (high * r[k] - low * r[k - stride]);
                rates[k] = -out / capacity[k];
            }
        }
    }
}
