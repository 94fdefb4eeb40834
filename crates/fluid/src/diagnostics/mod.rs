//! Numbers that are read off the fluid's state.

pub(crate) mod bubble_cuts;
pub(crate) mod bubbles;
pub(crate) mod ledger;

use crate::state::primitive::{PRESSURE, V_R, V_Z};
use mesh::{CellField, CellLevels, CellSnapshot, Padded, limited_differences};
use serde::{Deserialize, Serialize};

use crate::components::is_component;
use crate::state::COUNT;
use crate::state::conserved::{ENERGY, GAS, MOMENTUM_Z, PHI, RHO};
use crate::step::{BlockScratch, reconstruct};
use crate::thermodynamics::temperature::cell_temperature;
use crate::{FluidSolver, Primitive};

/// The gas as a whole, or of one of several bubbles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Bubble {
    /// ∫ φ [φ > 1e-6] dV, m³ (planar: m² per metre of depth).
    pub volume: f64,
    /// ∫ φ [0 < φ ≤ 1e-6] dV, in the same unit.
    pub trace_volume: f64,
    /// ∫ φ [1e-6 < φ < 1e-2] dV, part of the volume: gas that the interface left behind, which tension may inflate.
    pub thin_volume: f64,
    /// (3V/4π)^(1/3), planar (V/π)^(1/2), m.
    pub equivalent_radius: f64,
    /// Mean z weighted with the gas fraction, m; NaN without gas.
    pub centroid_z: f64,
    /// Mass of the gas, traces included, kg (planar: kg per metre of depth); NaN with the paper's mixture, whose phases
    /// have no masses of their own.
    pub gas_mass: f64,
}

/// What happens on the axis (planar: in the first row of cells).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisState {
    /// The distal (largest z) crossing of φ = ½, m; NaN if there is none.
    pub jet_tip_z: f64,
    /// The fastest liquid (φ < ½) towards the wall, m/s, positive towards it; NaN if all is gas.
    pub jet_velocity: f64,
}

/// Cell means along z_min.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WallPressures {
    /// In the cell on the axis, Pa.
    pub axis: f64,
    /// The largest, Pa.
    pub anywhere: f64,
}

/// Integrals over the domain, per radian in axial symmetry, per metre of depth in planar geometry.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Totals {
    /// Mass, kg.
    pub mass: f64,
    /// Axial momentum, N s.
    pub momentum_z: f64,
    /// Energy, J.
    pub energy: f64,
    /// Mass of the gas, kg; NaN where phases have no masses of their own.
    pub gas_mass: f64,
}

/// The fields of a snapshot, cell by cell; SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    /// Density.
    pub density: Vec<f64>,
    /// Pressure.
    pub pressure: Vec<f64>,
    /// Velocity (z, r).
    pub velocity: Vec<[f64; 2]>,
    /// Volume fraction of gas.
    pub gas_fraction: Vec<f64>,
    /// Temperature; empty where the liquid's equation of state has none.
    pub temperature: Vec<f64>,
    /// Mass fraction of the tracer; empty without one.
    pub tracer: Vec<f64>,
    /// Mass fraction of the vapour; empty where nothing evaporates.
    pub vapour: Vec<f64>,
    /// Magnitude of the density gradient.
    pub schlieren: Vec<f64>,
    levels: CellLevels,
}

impl CellSnapshot for Snapshot {
    fn levels(&self) -> &CellLevels {
        &self.levels
    }
}

/// What a snapshot has. A field is added here, where the snapshot is filled, and in the estimate of memory if it is held.
pub const CELL_FIELDS: &[CellField<Snapshot>] = &[
    CellField::scalar("density", "kg/m3", "density", |taken| &taken.density),
    CellField::scalar("pressure", "Pa", "pressure", |taken| &taken.pressure),
    CellField::vector("velocity", "m/s", "velocity (z, r, 0)", |taken| &taken.velocity),
    CellField::scalar("gas_fraction", "1", "volume fraction of gas", |taken| &taken.gas_fraction),
    CellField::scalar("temperature", "K", "temperature", |taken| &taken.temperature),
    CellField::scalar("tracer", "1", "mass fraction of the tracer", |taken| &taken.tracer),
    CellField::scalar("vapour", "1", "mass fraction of the vapour", |taken| &taken.vapour),
    CellField::scalar("schlieren", "kg/m4", "magnitude of the density gradient", |taken| &taken.schlieren),
    CellField::LEVEL,
];

/// The places of a block's own cells among the padded ones, row by row.
fn own_cells<const N: usize>() -> impl Iterator<Item = usize> {
    (0..N as isize).flat_map(|j| (0..N as isize).map(move |i| Padded::<N>::index(i, j)))
}

impl<const N: usize> FluidSolver<N> {
    /// The primitive variables of one cell.
    pub fn cell(&self, slot: usize, i: usize, j: usize) -> Primitive {
        self.cell_of(self.block(slot), i, j)
    }

    /// [`FluidSolver::cell`] of a block's components.
    pub(crate) fn cell_of(&self, block: &[f64], i: usize, j: usize) -> Primitive {
        let of = |component: usize| block[component * N * N + j * N + i];
        let u: [f64; COUNT] = std::array::from_fn(of);
        let gas = self.model().scheme.phases.gas_component().map_or(0.0, of);
        Primitive::from_conserved(u, gas, &self.model().mixture)
    }

    /// What happens on the axis.
    pub fn axis(&self) -> AxisState {
        let mut state = AxisState { jet_tip_z: f64::NAN, jet_velocity: f64::NAN };
        let mut before: Option<(f64, f64)> = None;
        for &slot in &self.model().axis_blocks {
            let Some(j) = self.mesh().axis_row(slot) else { continue };
            let id = self.mesh().tree().leaves()[slot];
            let rows = [RHO, MOMENTUM_Z, PHI].map(|component| self.component(slot, component));
            for i in 0..N {
                let z = self.mesh().centre(id, i, j)[0];
                let [rho, momentum, phi] = rows.map(|row| row[j * N + i]);
                if phi < 0.5 {
                    state.jet_velocity = state.jet_velocity.max(-momentum / rho);
                }
                if let Some((z0, phi0)) = before
                    && (phi0 < 0.5) != (phi < 0.5)
                {
                    state.jet_tip_z = z0 + (z - z0) * (0.5 - phi0) / (phi - phi0);
                }
                before = Some((z, phi));
            }
        }
        state
    }

    /// Cell means of the pressure along z_min.
    pub fn wall_pressures(&self) -> WallPressures {
        let mut pressures = WallPressures { axis: f64::NAN, anywhere: f64::NEG_INFINITY };
        for &slot in self.interface().blocks() {
            let on_axis = self.mesh().axis_row(slot);
            for j in 0..N {
                let pressure = self.cell(slot, 0, j).pressure;
                if on_axis == Some(j) {
                    pressures.axis = pressure;
                }
                pressures.anywhere = pressures.anywhere.max(pressure);
            }
        }
        pressures
    }

    /// Mean pressure of its level's present or last step on each face of z_min, in the order of r, Pa.
    pub fn wall_face_pressures(&self, pressures: &mut Vec<f64>) {
        pressures.clear();
        for slot in self.interface().blocks() {
            let sides = self.reports().pending[*slot].sides.as_deref();
            pressures.extend_from_slice(sides.map_or(&[0.0; N], |sides| &sides.wall_pressure));
        }
    }

    /// Pressure on each face of z_min of a fluid that no step has been made of, in the order of r, Pa: that of its cell, and of the weight
    /// between the cell's centre and the face.
    pub fn first_wall_face_pressures(&self, pressures: &mut Vec<f64>) {
        pressures.clear();
        let acceleration = self.model().terms.acceleration()[0];
        for &slot in self.interface().blocks() {
            let level = self.mesh().tree().leaves()[slot].level;
            let below = 0.5 * self.mesh().widths(level)[0];
            pressures.extend((0..N).map(|j| {
                let cell = self.cell_of(self.state().block(slot), 0, j);
                cell.pressure - cell.density * acceleration * below
            }));
        }
    }

    /// Mean shear stress σ_zr of its level's present or last step on each face of z_min, in the order of r, Pa: positive where the fluid
    /// drags the wall along +r. None without viscosity.
    pub fn wall_face_shears(&self, shears: &mut Vec<f64>) {
        shears.clear();
        if !self.model().terms.is_viscous {
            return;
        }
        for slot in self.interface().blocks() {
            let sides = self.reports().pending[*slot].sides.as_deref();
            shears.extend_from_slice(sides.map_or(&[0.0; N], |sides| &sides.wall_shear));
        }
    }

    /// The heat flux into the wall on z_min, W/m², and the wall's temperature, K: means over its level's present or last step on each face, in
    /// the order of r. None where nothing conducts, or z_min is no wall.
    pub fn wall_face_heat(&self, fluxes: &mut Vec<f64>, temperatures: &mut Vec<f64>) {
        fluxes.clear();
        temperatures.clear();
        if !(self.model().terms.conducts && self.model().has_wall()) {
            return;
        }
        for slot in self.interface().blocks() {
            let sides = self.reports().pending[*slot].sides.as_deref();
            fluxes.extend_from_slice(sides.map_or(&[0.0; N], |sides| &sides.wall_heat));
            temperatures.extend_from_slice(sides.map_or(&[0.0; N], |sides| &sides.wall_temperature));
        }
    }

    /// Mass, axial momentum, energy and the gas's mass in the domain, added up row by row and block by block.
    pub fn totals(&self) -> Totals {
        let has_phases = self.model().analysis.has_phases;
        let components = [RHO, MOMENTUM_Z, ENERGY, GAS];
        let components = if has_phases { &components[..] } else { &components[..3] };
        let leaves = self.mesh().tree().leaves();
        let of_block = |slot: usize| {
            let mut block = [0.0; 4];
            for j in 0..N {
                let volume = self.mesh().volume(leaves[slot], j);
                for (sum, component) in block.iter_mut().zip(components) {
                    let row = &self.component(slot, *component)[j * N..(j + 1) * N];
                    *sum += volume * mesh::sum(row);
                }
            }
            block
        };
        let mut totals = Totals { gas_mass: if has_phases { 0.0 } else { f64::NAN }, ..Totals::default() };
        for block in mesh::map_in_order(leaves.len(), mesh::SUMS_AT_ONCE, of_block) {
            totals.mass += block[0];
            totals.momentum_z += block[1];
            totals.energy += block[2];
            totals.gas_mass += block[3];
        }
        totals
    }

    /// Whether its snapshots have a field.
    pub fn has_field(&self, name: &str) -> bool {
        match name {
            "temperature" => self.model().mixture.has_temperature(),
            name => !is_component(name) || self.model().carried.iter().any(|carried| carried.name == name),
        }
    }

    /// The names and masses of what the mass carries besides, kg (planar: kg per metre of depth).
    pub fn carried_masses(&self) -> impl Iterator<Item = (&'static str, f64)> {
        let leaves = self.mesh().tree().leaves();
        let of_block = move |component: usize, slot: usize| {
            let rows = self.component(slot, component).chunks_exact(N).enumerate();
            rows.map(|(j, row)| self.mesh().volume(leaves[slot], j) * mesh::sum(row)).sum::<f64>()
        };
        let carried = self.model().carried.iter().zip(self.model().carried_components());
        carried.map(move |(carried, component)| {
            let mass = (0..leaves.len()).fold(0.0, |sum, slot| sum + of_block(component, slot));
            (carried.name, self.mesh().domain().geometry.turn() * mass)
        })
    }

    /// The state at a point by the linear reconstruction in the cell that contains it; `None` outside.
    ///
    /// Slopes are limited along each direction. In the cell's corners both add up, so the sum is kept within the values of the cell and its
    /// four neighbours: beside a bubble's surface densities would fall below 0. At a wall behind a film of one cell the gas fraction still
    /// would: there it is the state of the cell.
    pub fn sample(&self, point: [f64; 2]) -> Option<Primitive> {
        let ((slot, i, j), [a, b]) = self.mesh().place_in_cell(point)?;
        let k = Padded::<N>::index(i as isize, j as isize);
        Some(self.with_scratch(|scratch| {
            reconstruct(&self.context(0.0), slot, scratch);
            let BlockScratch { cells, s_z, s_r, .. } = scratch;
            let here = std::array::from_fn(|c| cells.component(c)[k]);
            let there: [f64; COUNT] = std::array::from_fn(|c| {
                let values = cells.component(c);
                let near = [k - 1, k + 1, k - Padded::<N>::STRIDE, k + Padded::<N>::STRIDE];
                let near = near.map(|k| values[k]).into_iter();
                let [low, high] =
                    near.fold([values[k]; 2], |[low, high], value| [low.min(value), high.max(value)]);
                (values[k] + a * s_z.component(c)[k] + b * s_r.component(c)[k]).clamp(low, high)
            });
            Primitive::from_array(if (0.0..=1.0).contains(&there[PHI]) { there } else { here })
        }))
    }

    /// All fields, cell by cell.
    pub fn snapshot(&self) -> Snapshot {
        let mut snapshot = Snapshot { levels: CellLevels::of(self.mesh()), ..Snapshot::default() };
        // Room at once: lists that grow side by side leave holes behind, of as much memory again.
        let cells = self.mesh().cells();
        snapshot.velocity.reserve_exact(cells);
        let Snapshot { density, pressure, gas_fraction, schlieren, .. } = &mut snapshot;
        for values in [density, pressure, gas_fraction, schlieren] {
            values.reserve_exact(cells);
        }
        for (slot, id) in self.mesh().tree().leaves().iter().enumerate() {
            let [h_z, h_r] = self.mesh().widths(id.level);
            self.with_scratch(|scratch| {
                reconstruct(&self.context(0.0), slot, scratch);
                let BlockScratch { cells, s_z, s_r, .. } = scratch;
                limited_differences(
                    mesh::Limiter::None,
                    cells.component(RHO),
                    Padded::<N>::STRIDE,
                    s_z.component_mut(RHO),
                    s_r.component_mut(RHO),
                );
                for k in own_cells::<N>() {
                    let at = |c: usize| cells.component(c)[k];
                    snapshot.density.push(at(RHO));
                    snapshot.velocity.push([at(V_Z), at(V_R)]);
                    snapshot.pressure.push(at(PRESSURE));
                    snapshot.gas_fraction.push(at(PHI));
                    let gradient = [s_z.component(RHO)[k] / h_z, s_r.component(RHO)[k] / h_r];
                    snapshot.schlieren.push(gradient[0].hypot(gradient[1]));
                }
                if self.model().mixture.has_temperature() {
                    let gas = self.model().scheme.phases.gas_component().map(|gas| cells.component(gas));
                    let [rho, p, phi] = [RHO, PRESSURE, PHI].map(|c| cells.component(c));
                    for k in own_cells::<N>() {
                        let gas = gas.map(|gas| gas[k]);
                        let temperature =
                            cell_temperature(&self.model().mixture, [rho[k], p[k], phi[k]], gas);
                        snapshot.temperature.push(temperature);
                    }
                }
                for (carried, component) in self.model().carried.iter().zip(self.model().carried_components())
                {
                    let (cells, values) = (cells.component(component), (carried.values)(&mut snapshot));
                    for j in 0..N as isize {
                        values.extend_from_slice(&cells[Padded::<N>::index(0, j)..][..N]);
                    }
                }
            });
        }
        snapshot
    }
}
