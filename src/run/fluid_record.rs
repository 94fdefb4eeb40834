//! What the fluid's side writes: snapshots, histories, its part of the summary.

use coupler::CommonRefinement;
use fluid::{Bubble, FluidSolver};
use mesh::{BLOCK, Geometry, Side};
use serde_json::{Map, Value, json};

use super::collapse::CollapseFinder;
use super::record::{CellGeometry, ProbeSeries, Ticker, attributes, between_faces, column, probe_series};
use super::schedule::Plan;
use crate::case::{Case, FLUID_FIELDS, Medium};
use crate::output::run_directory::{FLUID_FIELDS as FIELDS_FILE, FLUID_HISTORY};
use crate::output::{
    Column, FieldSpec, HistoryFile, OutputError, QuadMesh, RunDirectory, SeriesId, SeriesWriter, Storage,
};

/// Everything that the fluid's side writes.
pub struct FluidRecord {
    history: HistoryFile,
    snapshots: SeriesWriter,
    fields: Vec<&'static str>,
    geometry: CellGeometry,
    steps: SeriesId,
    interface: Option<InterfaceHistory>,
    conservation: SeriesId,
    ticker: Ticker,
    probes: Vec<ProbeSeries>,
    edges: Vec<f64>,
    begin: f64,
    wall_pressures: Vec<f64>,
    collapse: CollapseFinder,
    peaks: Peaks,
    last_bubble: Bubble,
}

/// Largest values so far, with their times.
#[derive(Clone, Copy, Debug, Default)]
struct Peaks {
    wall: [f64; 2],
    wall_anywhere: [f64; 2],
    wall_interface: [f64; 2],
    jet: [f64; 2],
}

/// The history of the wall on a fixed radial grid.
struct InterfaceHistory {
    series: SeriesId,
    map: CommonRefinement,
    cells: usize,
    initial: Vec<f64>,
    impulse: Vec<f64>,
}

impl FluidRecord {
    /// Makes the files of the fluid's side and writes the state at t = 0.
    pub fn create(
        case: &Case,
        directory: &RunDirectory,
        solver: &FluidSolver<BLOCK>,
    ) -> Result<Self, OutputError> {
        let owned = attributes(case);
        let attributes: Vec<(&str, &str)> =
            owned.iter().map(|(name, value)| (*name, value.as_str())).collect();
        let mut history = HistoryFile::create(&directory.file(FLUID_HISTORY), &attributes)?;
        let steps = history.add_series("", &STEP_COLUMNS)?;
        let edges = solver.wall_edges();
        let begin = solver.mesh().domain().r[0];
        let axisymmetric = case.geometry == Geometry::Axisymmetric;
        // With a boundary of its own at z_min there is no wall to record.
        let interface = if case.fluid.as_ref().is_some_and(|fluid| {
            matches!(fluid.boundary[Side::ZMin as usize], fluid::Boundary::Interface | fluid::Boundary::Wall)
        }) {
            Some(InterfaceHistory::create(case, &edges, begin, axisymmetric, solver, &mut history)?)
        } else {
            None
        };
        let conservation = history.add_series("/conservation/fluid", &CONSERVATION_COLUMNS)?;
        let interface_z = case.solid.as_ref().map(|_| solver.mesh().domain().z[0]);
        let probes = probe_series(case, Medium::Fluid, interface_z, &PROBE_COLUMNS, &mut history)?;

        let fields: Vec<&'static str> = (FLUID_FIELDS.iter())
            .filter(|name| case.output.fields.as_ref().is_none_or(|wanted| wanted.iter().any(|w| w == *name)))
            .copied()
            .collect();
        let specs: Vec<FieldSpec<'_>> = fields.iter().map(|name| field_spec(name)).collect();
        let path = directory.file(FIELDS_FILE);
        let snapshots = SeriesWriter::create(&path, &specs, case.output.compression, &attributes)?;
        let mut record = Self {
            history,
            snapshots,
            fields,
            geometry: CellGeometry::of(solver.mesh()),
            steps,
            interface,
            conservation,
            ticker: Ticker::of(case),
            probes,
            edges,
            begin,
            wall_pressures: Vec::new(),
            collapse: CollapseFinder::default(),
            peaks: Peaks::default(),
            last_bubble: Bubble::default(),
        };
        record.write(solver, 0.0)?;
        record.snapshot(solver)?;
        record.history.flush()?;
        Ok(record)
    }

    /// Takes notice of a finished step.
    pub fn after_step(&mut self, solver: &FluidSolver<BLOCK>, plan: Plan) -> Result<(), OutputError> {
        self.write(solver, plan.dt)?;
        if plan.snapshot {
            self.snapshot(solver)?;
        }
        self.history.flush_if_due()?;
        Ok(())
    }

    /// Writes what is still in memory; after a numerical failure the last good state as a snapshot, too.
    pub fn close(&mut self, solver: &FluidSolver<BLOCK>, failed: bool) -> Result<(), OutputError> {
        if failed {
            self.snapshot(solver)?;
        }
        self.history.flush()
    }

    fn write(&mut self, solver: &FluidSolver<BLOCK>, dt: f64) -> Result<(), OutputError> {
        let time = solver.time();
        let bubble = solver.bubble();
        let axis = solver.axis();
        let wall = solver.wall_pressures();
        let fixups = solver.fixups();
        if dt > 0.0 {
            solver.wall_face_pressures(&mut self.wall_pressures);
        } else {
            self.wall_pressures.clear();
            solver.wall_cells(|_, pressure, _| self.wall_pressures.push(pressure));
        }
        let limit = |value: f64| if value.is_nan() { 0.0 } else { value };
        self.history.push(
            self.steps,
            &[
                time,
                dt,
                bubble.volume,
                bubble.equivalent_radius,
                bubble.centroid_z,
                axis.jet_tip_z,
                axis.jet_velocity,
                bubble.trace_volume,
                wall.axis,
                wall.anywhere,
                fixups.first_order as f64,
                fixups.floored as f64,
                fixups.floor_energy,
            ],
        )?;
        self.collapse.push(time, bubble.volume);
        self.last_bubble = bubble;
        let peaks = &mut self.peaks;
        for (peak, value) in [
            (&mut peaks.wall, wall.axis),
            (&mut peaks.wall_anywhere, wall.anywhere),
            (&mut peaks.wall_interface, self.wall_pressures.first().copied().unwrap_or(f64::NAN)),
            (&mut peaks.jet, limit(axis.jet_velocity)),
        ] {
            if value > peak[0] {
                *peak = [value, time];
            }
        }

        let due = self.ticker.is_due(time);
        if let Some(interface) = &mut self.interface {
            interface.add(&self.wall_pressures, dt);
            if due {
                interface.write(time, &self.wall_pressures, solver, &mut self.history)?;
            }
        }
        if due {
            let totals = solver.totals();
            let ledger = solver.ledger();
            let mut row = vec![time, totals.mass, totals.momentum_z, totals.energy];
            for side in 0..4 {
                row.extend([ledger.mass[side], ledger.momentum[side], ledger.energy[side]]);
            }
            row.extend([fixups.floor_energy, ledger.wall_impulse, ledger.wall_work]);
            self.history.push(self.conservation, &row)?;
        }
        for probe in &self.probes {
            let Some(state) = solver.sample(probe.probe.position) else { continue };
            let [mut pressure, mut v_z] = [state.pressure, state.v_z];
            if probe.on_interface && dt > 0.0 {
                let at = |value: &dyn Fn(usize) -> f64| {
                    between_faces(&self.edges, self.begin, probe.probe.position[1], value)
                };
                pressure = at(&|k| self.wall_pressures[k]);
                v_z = at(&|k| solver.wall()[k].velocity);
            }
            let row = [time, pressure, state.density, v_z, state.v_r, state.phi];
            self.history.push(probe.series, &row)?;
        }
        Ok(())
    }

    fn snapshot(&mut self, solver: &FluidSolver<BLOCK>) -> Result<(), OutputError> {
        let snapshot = solver.snapshot();
        let values: Vec<&[f64]> = (self.fields.iter())
            .map(|name| match *name {
                "density" => snapshot.density.as_slice(),
                "pressure" => &snapshot.pressure,
                "velocity" => &snapshot.velocity,
                "gas_fraction" => &snapshot.gas_fraction,
                "schlieren" => &snapshot.schlieren,
                _ => &snapshot.level,
            })
            .collect();
        let mesh = QuadMesh { points: &self.geometry.points, quads: &self.geometry.quads };
        self.snapshots.append(solver.time(), &mesh, 0, &values)
    }

    /// The fluid's part of the summary.
    pub fn summary(&self, solver: &FluidSolver<BLOCK>) -> Map<String, Value> {
        let radius = |volume: f64| match solver.mesh().domain().geometry {
            Geometry::Axisymmetric => (0.75 * volume / std::f64::consts::PI).cbrt(),
            Geometry::Planar => (volume / std::f64::consts::PI).sqrt(),
        };
        let collapse = self.collapse.found();
        let fixups = solver.fixups();
        let with_wall = self.interface.is_some();
        let peak = |[value, _]: [f64; 2]| if with_wall { json!(value) } else { Value::Null };
        let peak_time = |[_, time]: [f64; 2]| if with_wall { json!(time) } else { Value::Null };
        let value = json!({
            "cells": { "fluid": solver.mesh().cells() },
            "collapse_time": collapse.map(|c| c.time),
            "min_equivalent_radius": collapse.map(|c| radius(c.volume.max(0.0))),
            "final_equivalent_radius": self.last_bubble.equivalent_radius,
            "trace_gas_volume": self.last_bubble.trace_volume,
            "wall_pressure_peak": peak(self.peaks.wall),
            "wall_pressure_peak_time": peak_time(self.peaks.wall),
            "wall_pressure_peak_interface": peak(self.peaks.wall_interface),
            "wall_pressure_peak_interface_time": peak_time(self.peaks.wall_interface),
            "wall_pressure_peak_anywhere": peak(self.peaks.wall_anywhere),
            "wall_pressure_peak_anywhere_time": peak_time(self.peaks.wall_anywhere),
            "jet_velocity_peak": self.peaks.jet[0],
            "jet_velocity_peak_time": self.peaks.jet[1],
            "fixups": {
                "first_order": fixups.first_order,
                "floored": fixups.floored,
                "floor_energy": fixups.floor_energy,
            },
        });
        match value {
            Value::Object(map) => map,
            _ => unreachable!("an object was written"),
        }
    }
}

impl InterfaceHistory {
    fn create(
        case: &Case,
        edges: &[f64],
        begin: f64,
        axisymmetric: bool,
        solver: &FluidSolver<BLOCK>,
        history: &mut HistoryFile,
    ) -> Result<Self, OutputError> {
        let end = edges.last().copied().unwrap_or(begin);
        let cells = case.output.interface_cells.unwrap_or(edges.len());
        let grid: Vec<f64> = if cells == edges.len() {
            edges.to_vec()
        } else {
            (1..=cells)
                .map(|k| if k == cells { end } else { begin + (end - begin) * k as f64 / cells as f64 })
                .collect()
        };
        let mut map = CommonRefinement::default();
        map.update(begin, edges, &grid, axisymmetric);
        let centres: Vec<f64> =
            (0..cells).map(|k| 0.5 * (grid[k] + if k == 0 { begin } else { grid[k - 1] })).collect();
        history.put("/interface/r", "m", "centres of the radial grid", &centres);
        let wide = |name, unit, description| Column { name, unit, description, width: cells };
        let series = history.add_series(
            "/interface",
            &[
                column("time", "s", "end of the step"),
                wide("pressure", "Pa", "pressure of the star state, mean over the step"),
                wide("normal_velocity", "m/s", "velocity of the star state along +z, mean over the step"),
                wide("impulse", "Pa s", "time integral of the pressure minus that at t = 0"),
            ],
        )?;
        let mut initial = Vec::with_capacity(edges.len());
        solver.wall_cells(|_, pressure, _| initial.push(pressure));
        Ok(Self { series, map, cells, impulse: vec![0.0; initial.len()], initial })
    }

    fn add(&mut self, pressures: &[f64], dt: f64) {
        for ((impulse, pressure), initial) in self.impulse.iter_mut().zip(pressures).zip(&self.initial) {
            *impulse += dt * (pressure - initial);
        }
    }

    fn write(
        &self,
        time: f64,
        pressures: &[f64],
        solver: &FluidSolver<BLOCK>,
        history: &mut HistoryFile,
    ) -> Result<(), OutputError> {
        let mut row = vec![0.0; 1 + 3 * self.cells];
        row[0] = time;
        let face = |k: usize| self.map.sub_faces()[k].first;
        let mut put = |block: usize, value: &dyn Fn(usize) -> f64| {
            self.map.means(true, |k| value(face(k)), |cell, mean| row[1 + block * self.cells + cell] = mean);
        };
        put(0, &|face| pressures[face]);
        put(1, &|face| solver.wall().get(face).map_or(0.0, |wall| wall.velocity));
        put(2, &|face| self.impulse[face]);
        history.push(self.series, &row)
    }
}

const STEP_COLUMNS: [Column<'static>; 13] = [
    column("time", "s", "time after the step"),
    column("time_step", "s", "length of the step"),
    column("bubble/volume", "m3", "volume integral of the gas fraction where it exceeds 1e-6"),
    column("bubble/equivalent_radius", "m", "radius of the ball of that volume"),
    column("bubble/centroid_z", "m", "mean z weighted with the gas fraction"),
    column("bubble/jet_tip_z", "m", "distal crossing of gas fraction 1/2 on the axis"),
    column("bubble/jet_velocity", "m/s", "fastest liquid on the axis, positive towards the wall"),
    column("bubble/trace_gas_volume", "m3", "volume integral of the gas fraction where it is at most 1e-6"),
    column("wall/pressure_axis", "Pa", "cell mean at z_min on the axis"),
    column("wall/pressure_max", "Pa", "largest cell mean along z_min"),
    column("fixups/first_order", "1", "cell-steps at first order so far"),
    column("fixups/floored", "1", "cell-steps lifted to the pressure floor so far"),
    column("fixups/floor_energy", "J/rad", "energy that the floor added so far (planar: J/m)"),
];

const CONSERVATION_COLUMNS: [Column<'static>; 19] = [
    column("time", "s", "time"),
    column("mass", "kg/rad", "mass in the domain (planar: kg/m)"),
    column("momentum_z", "N s/rad", "axial momentum in the domain"),
    column("energy", "J/rad", "energy in the domain"),
    column(
        "mass_in_z_min",
        "kg/rad",
        "mass that came in through z_min; under a solid the wall's motion carries it",
    ),
    column("momentum_in_z_min", "N s/rad", "axial momentum and impulse of the pressure through z_min"),
    column("energy_in_z_min", "J/rad", "energy and work of the pressure through z_min"),
    column("mass_in_z_max", "kg/rad", "the same through z_max"),
    column("momentum_in_z_max", "N s/rad", "the same through z_max"),
    column("energy_in_z_max", "J/rad", "the same through z_max"),
    column("mass_in_r_min", "kg/rad", "the same through r_min"),
    column("momentum_in_r_min", "N s/rad", "the same through r_min"),
    column("energy_in_r_min", "J/rad", "the same through r_min"),
    column("mass_in_r_max", "kg/rad", "the same through r_max"),
    column("momentum_in_r_max", "N s/rad", "the same through r_max"),
    column("energy_in_r_max", "J/rad", "the same through r_max"),
    column("energy_from_floor", "J/rad", "energy that the pressure floor added"),
    column(
        "interface_impulse",
        "N s/rad",
        "impulse of p* on the interface: minus the solid's momentum_in_z_max",
    ),
    column("interface_work", "J/rad", "work of p* on the fluid: minus the solid's energy_in_z_max"),
];

const PROBE_COLUMNS: [Column<'static>; 6] = [
    column("time", "s", "time after the step"),
    column("pressure", "Pa", "pressure; on the interface that of the star state, mean over the step"),
    column("density", "kg/m3", "density"),
    column(
        "velocity_z",
        "m/s",
        "axial velocity; on the interface that of the star state, mean over the step",
    ),
    column("velocity_r", "m/s", "radial velocity"),
    column("gas_fraction", "1", "gas fraction"),
];

fn field_spec(name: &'static str) -> FieldSpec<'static> {
    let spec =
        |components, unit, description, storage| FieldSpec { name, components, unit, description, storage };
    match name {
        "density" => spec(1, "kg/m3", "density", Storage::F64),
        "pressure" => spec(1, "Pa", "pressure", Storage::F64),
        "velocity" => spec(3, "m/s", "velocity (z, r, 0)", Storage::F64),
        "gas_fraction" => spec(1, "1", "volume fraction of gas", Storage::F64),
        "schlieren" => spec(1, "kg/m4", "magnitude of the density gradient", Storage::F64),
        _ => spec(1, "1", "refinement level", Storage::U8),
    }
}
