//! Conductances of faces, and the heat that passes them.

use mesh::Side;

use super::ConductionTerm;
use super::caloric::CellHeat;
use super::rows::{bounded, conductances_of_liquid, heat};
use crate::phase_change::holds_both;
use crate::reconstruction::Rows;
use crate::state::primitive::{PHI, PRESSURE, RHO};
use crate::terms::diffusion::most_diffusivity;
use crate::terms::{GasMass, TermBlock, beside_padded};

/// Rows that a block takes: T, C, the gas's part of C, what cells gain until mid-step, conductances and fluxes along z and r.
const ROWS: usize = 8;

/// The rows that conduction works in, padded.
pub(super) struct Work<'a> {
    pub temperature: &'a mut [f64],
    pub capacity: &'a mut [f64],
    pub gas_share: &'a mut [f64],
    /// Energy per volume until mid-step, J/m³.
    pub gain: &'a mut [f64],
    /// Indexed by the cell below the face, W/(m² K).
    pub conductances: [&'a mut [f64]; 2],
    /// Likewise, W/m².
    pub fluxes: [&'a mut [f64]; 2],
    /// The heat that the wall on z_min gets on each of the block's faces (W/m²), and its temperature there (K).
    wall: [&'a mut [f64]; 2],
}

impl<'a> Work<'a> {
    pub fn of(work: &'a mut Vec<f64>, block: &TermBlock<'_>) -> Self {
        let (len, n) = (block.before[RHO].len(), block.cells);
        work.resize(ROWS * len + 2 * n, 0.0);
        let (rows, wall) = work.split_at_mut(ROWS * len);
        let mut rows = rows.chunks_exact_mut(len);
        let [temperature, capacity, gas_share, gain, g_z, g_r, z, r] =
            std::array::from_fn(|_| rows.next().expect("resized to that many"));
        let (flux, surface) = wall.split_at_mut(n);
        Self {
            temperature,
            capacity,
            gas_share,
            gain,
            conductances: [g_z, g_r],
            fluxes: [z, r],
            wall: [flux, surface],
        }
    }

    /// The fluxes along z and r that were left in a work.
    ///
    /// - `len`: of a padded row.
    pub fn fluxes_in(work: &[f64], len: usize) -> [&[f64]; 2] {
        [ROWS - 2, ROWS - 1].map(|row| &work[row * len..(row + 1) * len])
    }

    /// What was left of the wall, see [`Work::note_wall`].
    pub fn wall_in(work: &[f64], len: usize) -> [&[f64]; 2] {
        let (flux, surface) = work[ROWS * len..].split_at((work.len() - ROWS * len) / 2);
        [flux, surface]
    }

    pub fn set(&mut self, k: usize, heat: CellHeat) {
        let CellHeat { temperature, capacity, gas_share } = heat;
        (self.temperature[k], self.capacity[k], self.gas_share[k]) = (temperature, capacity, gas_share);
    }

    /// Puts the temperatures of what is beyond the sides of the domain into the ghosts.
    pub fn set_beyond(block: &TermBlock<'_>, temperature: &mut [f64]) {
        for (side, kind) in block.bounding_sides() {
            for along in -1..=block.cells as isize {
                let [inner, ghost] = beside_padded(side, block.cells, block.metric, along);
                let beyond = block.heat_beyond.at(side, kind, along);
                temperature[ghost] = beyond.map_or(temperature[inner], |[beyond, _]| beyond);
            }
        }
    }

    /// The fluxes through the faces of a block and of its first ghosts.
    pub fn conduct(&mut self, block: &TermBlock<'_>) {
        let Self { temperature, conductances: [g_z, g_r], fluxes: [z, r], .. } = self;
        let faces = [(&**g_z, &mut **z), (&**g_r, &mut **r)];
        conduct(block.cells, [block.metric.origin, block.metric.stride], temperature, faces);
    }

    /// Takes down what the wall on z_min gets, and how warm it is.
    pub fn note_wall(&mut self, block: &TermBlock<'_>) {
        let Some(kind) = block.sides[Side::ZMin as usize].filter(|kind| kind.is_wall()) else { return };
        for j in 0..block.cells {
            let [inner, ghost] = beside_padded(Side::ZMin, block.cells, block.metric, j as isize);
            let flux = -self.fluxes[0][ghost];
            self.wall[0][j] = flux;
            let beyond = block.heat_beyond.at(Side::ZMin, kind, j as isize);
            // A wall that lets nothing through has the temperature of the fluid on it.
            self.wall[1][j] =
                beyond.map_or(self.temperature[inner], |[beyond, resistance]| beyond + flux * resistance);
        }
    }
}

/// q = G (T_low − T_high) on the faces of a block and of its first ghosts.
///
/// - `origin`, `stride`: of the padded rows; `faces`: conductances and fluxes along z and r.
pub(super) fn conduct(
    cells: usize,
    [origin, stride]: [usize; 2],
    temperature: &[f64],
    faces: [(&[f64], &mut [f64]); 2],
) {
    for ((conductance, flux), step) in faces.into_iter().zip([1, stride]) {
        let range = face_range(cells, [origin, stride], step);
        let (low, high) = (&temperature[range.clone()], &temperature[range.start + step..range.end + step]);
        let faces = flux[range.clone()].iter_mut().zip(&conductance[range]);
        for ((flux, conductance), (low, high)) in faces.zip(low.iter().zip(high)) {
            *flux = conductance * (low - high);
        }
    }
}

/// The cells below the faces of a block and of its first ghosts, and some more.
fn face_range(cells: usize, [origin, stride]: [usize; 2], step: usize) -> std::ops::Range<usize> {
    origin - stride - 1 - step..origin + cells * stride + cells + 1
}

impl ConductionTerm {
    /// The heat in a cell of a block.
    ///
    /// - `rows`: where its ρ and p are; its gas is that of the beginning of the step.
    #[inline(always)]
    pub(super) fn heat_in(&self, rows: &Rows<'_>, block: &TermBlock<'_>, k: usize) -> CellHeat {
        let (rho, p, phi) = (rows[RHO][k], rows[PRESSURE][k], block.before[PHI][k]);
        match block.gas {
            GasMass::Absent => self.caloric.of_phases([rho, p, 0.0], 0.0),
            GasMass::Unknown => self.caloric.of_mixture([rho, p, phi]),
            GasMass::Shares(shares) => self.caloric.of_phases([rho, p, phi], shares[k] * rho),
        }
    }

    /// Takes the temperatures of the padded cells of a block, and of what is beyond the domain.
    pub(super) fn gather(&self, rows: &Rows<'_>, block: &TermBlock<'_>, work: &mut Work<'_>) {
        let Work { temperature, capacity, gas_share, .. } = work;
        let cells = [rows[RHO], rows[PRESSURE], block.before[PHI]];
        heat(&self.caloric, cells, block.gas, [temperature, capacity, gas_share]);
        Work::set_beyond(block, work.temperature);
    }

    /// The conductances of the faces of a block and of its first ghosts: 1/(R_low + R_high) of what [`super::Resistivity`] says.
    ///
    /// Where phases that meet are in equilibrium an interface has one temperature, whatever the layers are: what evaporates on one side of it and
    /// condenses on the other carries the heat. Between mixed cells whose heat is mostly the liquid's the better conductor's λ stands
    /// for that.
    ///
    /// - `is_bounded`: whether no face conducts more than the cell of less heat capacity bears in a step.
    pub(super) fn conductances(&self, block: &TermBlock<'_>, work: &mut Work<'_>, is_bounded: bool) {
        let metric = block.metric;
        let most = if is_bounded { most_diffusivity(metric.dt, metric.inverse_h) } else { f64::INFINITY };
        let phi = block.before[PHI];
        let Work { capacity, gas_share, conductances, .. } = work;
        for ((axis, step), conductance) in [1, metric.stride].into_iter().enumerate().zip(&mut *conductances)
        {
            let inverse = metric.inverse_h[axis];
            let range = face_range(block.cells, [metric.origin, metric.stride], step);
            if matches!(block.gas, GasMass::Absent) {
                let of_step = (self.asked.liquid, most, inverse);
                conductances_of_liquid(of_step, (range, step), capacity, conductance);
                continue;
            }
            for k in range {
                let [low, high] = [k, k + step].map(|k| phi[k].clamp(0.0, 1.0));
                let [low_share, high_share] = [k, k + step].map(|k| gas_share[k].clamp(0.0, 1.0));
                let is_towards_gas = high > low;
                let below = self.resistivity.to_face(low, low_share, is_towards_gas);
                let above = self.resistivity.to_face(high, high_share, !is_towards_gas);
                let layers = 1.0 / (below + above);
                let by_vapour = self.boils
                    && [(low, low_share), (high, high_share)]
                        .into_iter()
                        .all(|(phi, gas_share)| holds_both(phi) && gas_share < 0.5);
                let conductivity = if by_vapour { self.asked.gas.max(self.asked.liquid) } else { layers };
                conductance[k] = inverse * bounded(conductivity, most, [capacity[k], capacity[k + step]]);
            }
        }
        for (side, kind) in block.bounding_sides() {
            let axis = crate::boundary::axis(side);
            for along in -1..=block.cells as isize {
                let [inner, ghost] = beside_padded(side, block.cells, metric, along);
                let through = block.heat_beyond.at(side, kind, along).map_or(0.0, |[_, resistance]| {
                    // The wall is on the side that the next cell is not on.
                    let (next, own) = (phi[2 * inner - ghost], phi[inner].clamp(0.0, 1.0));
                    let share = gas_share[inner].clamp(0.0, 1.0);
                    let within = self.resistivity.to_face(own, share, own > next);
                    let conductivity = 1.0 / (within + resistance * metric.inverse_h[axis]);
                    // Half a cell lies before the wall, of twice the conductance: so much is as stable there.
                    metric.inverse_h[axis] * bounded(conductivity, 2.0 * most, [capacity[inner]; 2])
                });
                conductances[axis][inner.min(ghost)] = through;
            }
        }
    }

    /// How many cells of a block conduct more than the step is stable with.
    pub(super) fn count_bounded(&self, block: &TermBlock<'_>, capacity: &[f64]) -> u64 {
        let TermBlock { cells: n, metric, .. } = *block;
        let most = most_diffusivity(metric.dt, metric.inverse_h);
        let is_bounded = |k: &usize| {
            self.resistivity.of_cell(block.before[PHI][*k].clamp(0.0, 1.0)) * most * capacity[*k] < 1.0
        };
        (0..n)
            .flat_map(|j| (0..n).map(move |i| metric.origin + j * metric.stride + i))
            .filter(is_bounded)
            .count() as u64
    }
}
