//! What the fluid's side writes: snapshots, histories, its part of the summary.

use fluid::{Bubble, BubbleCuts, FluidSolver};
use mesh::{BLOCK, Geometry, Side};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::case::{Case, Medium};
use crate::output::{Column, HistoryFile, OutputError, RunDirectory, SeriesId};
use crate::run::record::collapse::CollapseFinder;
use crate::run::record::film::{FilmRecord, ThinnestFilm};
use crate::run::record::interface_history::{InterfaceHistory, OnFaces};
use crate::run::record::of_side::Record;
use crate::run::record::side_files::SideFiles;
use crate::run::record::{CellCount, ProbeSeries, Ticker, column, entries, probe_series};
use crate::run::side::wall_faces::WallFaces;

mod columns;
mod conservation;
mod cut;
mod files;
mod fixups;
mod phases;
pub mod saved;

use columns::{BUBBLE_COLUMNS, PROBE_COLUMNS, STEP_COLUMNS};
use cut::CutRecord;

/// Everything that the fluid's side writes.
pub struct FluidRecord {
    files: SideFiles<fluid::Snapshot>,
    steps: SeriesId,
    /// How often bounds acted, every step.
    fixups: SeriesId,
    /// One row for each bubble side by side; absent with less than two.
    bubbles: Option<SeriesId>,
    interface: Option<InterfaceHistory>,
    conservation: SeriesId,
    /// What the cut of a bubble's gas adds to it, in cases with one.
    cut: CutRecord,
    ticker: Ticker,
    probes: Vec<ProbeSeries>,
    faces: WallFaces,
    wall_pressures: Vec<f64>,
    /// Of a viscous fluid; else none.
    wall_shears: Vec<f64>,
    /// Heat fluxes into the wall and its temperatures, where heat is conducted; else none.
    wall_heat: [Vec<f64>; 2],
    film: FilmRecord,
    seen: Seen,
    /// Finest cells along the radius of the first region, where that is a ball of gas.
    cells_per_radius: Option<f64>,
    /// Of the liquid far away, Pa.
    ambient_pressure: f64,
}

/// What it has seen so far, of which the summary tells.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Seen {
    cells: CellCount,
    collapse: CollapseFinder,
    /// Of each bubble, with several.
    each: Vec<CollapseFinder>,
    peaks: Peaks,
    last_bubble: Bubble,
    largest_thin_volume: f64,
    cuts: BubbleCuts,
    film: ThinnestFilm,
}

impl Seen {
    /// Whether no bubble has begun to collapse: each is larger than ever.
    fn only_grow(&self) -> bool {
        let one = std::slice::from_ref(&self.collapse);
        (if self.each.is_empty() { one } else { &self.each }).iter().all(CollapseFinder::is_growing)
    }
}

/// Largest values so far, with their times.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Peaks {
    wall: [f64; 2],
    wall_anywhere: [f64; 2],
    wall_interface: [f64; 2],
    jet: [f64; 2],
}

impl FluidRecord {
    /// Makes the files of the fluid's side and writes the state at t = 0. Without a directory histories stay in memory
    /// and there are no snapshots.
    pub fn create(
        case: &Case,
        directory: Option<&RunDirectory>,
        solver: &FluidSolver<BLOCK>,
    ) -> Result<Self, OutputError> {
        let mut record = Self::on(case, SideFiles::create(case, directory, files::names(solver))?, solver)?;
        record.seen.cells.see(solver.mesh().cells());
        let [fluxes, temperatures] = &mut record.wall_heat;
        solver.wall_face_heat(fluxes, temperatures);
        record.write(solver, 0.0)?;
        record.begun(solver)
    }

    /// A record in these files of a fluid as it is, with nothing written.
    fn on(
        case: &Case,
        mut files: SideFiles<fluid::Snapshot>,
        solver: &FluidSolver<BLOCK>,
    ) -> Result<Self, OutputError> {
        let mesh = solver.mesh();
        let history = &mut files.history;
        let cuts = case.fluid.as_ref().map(|fluid| BubbleCuts::of(&fluid.initial)).unwrap_or_default();
        let steps = history.add_series("", &STEP_COLUMNS)?;
        let fixups = history.add_series("/fixups", &fixups::columns())?;
        let bubbles = bubble_series(&cuts, history)?;
        let film = FilmRecord::create(history)?;
        let faces = WallFaces::new(mesh.generation(), mesh.domain().r[0], solver.interface_edges());
        let mut wall_pressures = Vec::new();
        solver.first_wall_face_pressures(&mut wall_pressures);
        // With a boundary of its own at z_min there is no wall to record.
        let wall = case.fluid.as_ref().filter(|fluid| fluid.boundary[Side::ZMin as usize].is_wall());
        let interface = match wall {
            Some(fluid) => {
                let cells = case.output.interface_cells.unwrap_or(fluid.grid.finest()[1]);
                Some(InterfaceHistory::create(case, &faces, cells, &wall_pressures, history)?)
            }
            None => None,
        };
        let conservation = history.add_series("/conservation/fluid", &conservation::columns())?;
        let cut = CutRecord::create(solver, history)?;
        let interface_z = case.solid.as_ref().map(|_| mesh.domain().z[0]);
        let probes = probe_series(case, Medium::Fluid, interface_z, &PROBE_COLUMNS, history)?;
        Ok(Self {
            files,
            steps,
            fixups,
            interface,
            conservation,
            cut,
            ticker: Ticker::of(case),
            probes,
            faces,
            wall_pressures,
            wall_shears: Vec::new(),
            wall_heat: Default::default(),
            bubbles,
            film,
            seen: Seen { cuts, ..Seen::default() },
            cells_per_radius: case.cells_per_radius(),
            ambient_pressure: case.fluid.as_ref().map_or(0.0, |fluid| fluid.initial.ambient.pressure),
        })
    }

    fn write(&mut self, solver: &FluidSolver<BLOCK>, dt: f64) -> Result<(), OutputError> {
        let time = solver.time();
        let bubble = solver.bubble();
        let axis = solver.axis();
        let wall = solver.wall_pressures();
        let history = &mut self.files.history;
        history.push(
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
                bubble.thin_volume,
                bubble.gas_mass,
                wall.axis,
                wall.anywhere,
            ],
        )?;
        history.push(self.fixups, &fixups::row(&solver.fixups()))?;
        if let Some(series) = self.bubbles {
            self.seen.cuts.follow(solver);
            let numbers = |b: Bubble| [b.volume, b.equivalent_radius, b.centroid_z, b.gas_mass];
            let bubbles = solver.bubbles(&self.seen.cuts);
            self.seen.each.resize_with(bubbles.len(), CollapseFinder::default);
            for (finder, bubble) in self.seen.each.iter_mut().zip(&bubbles) {
                finder.push(time, bubble.volume);
            }
            let row: Vec<f64> = bubbles.into_iter().flat_map(numbers).collect();
            history.push(series, &row)?;
        }
        self.film.after_step(solver, &mut self.seen.film, history)?;
        self.seen.collapse.push(time, bubble.volume);
        self.seen.last_bubble = bubble;
        self.seen.largest_thin_volume = self.seen.largest_thin_volume.max(bubble.thin_volume);
        let only_grow = self.cells_per_radius.is_some() && self.seen.only_grow();
        let peaks = &mut self.seen.peaks;
        if only_grow {
            // What a bubble pushes away in its growth is no jet, and no load that its collapse puts on the wall.
            peaks.jet = [0.0; 2];
            self.interface.iter_mut().for_each(InterfaceHistory::forget_load);
        }
        for (peak, value) in [
            (&mut peaks.wall, wall.axis),
            (&mut peaks.wall_anywhere, wall.anywhere),
            (&mut peaks.wall_interface, self.faces.on_axis(&self.wall_pressures).unwrap_or(f64::NAN)),
            (&mut peaks.jet, axis.jet_velocity.max(0.0)),
        ] {
            if value > peak[0] {
                *peak = [value, time];
            }
        }

        // Between the ends of whole steps levels are at different times, and nothing adds up.
        let due = solver.clock().is_over() && self.ticker.is_due(time);
        if let Some(interface) = &mut self.interface {
            let on_faces = OnFaces {
                pressures: &self.wall_pressures,
                stresses: &self.wall_shears,
                heat: self.wall_heat.each_ref().map(|row| &row[..]),
            };
            interface.after_step(&self.faces, on_faces, (time, dt), history)?;
            if due {
                let velocity =
                    |face: usize| solver.interface().states().get(face).map_or(0.0, |wall| wall.velocity);
                interface.write(time, velocity, history)?;
            }
        }
        if due {
            history.push(self.conservation, &conservation::row(solver))?;
            self.cut.write(solver, history)?;
        }
        for probe in &mut self.probes {
            let Some(state) = solver.sample(probe.probe.position) else { continue };
            let [mut pressure, mut v_z] = [state.pressure, state.v_z];
            if probe.on_interface && dt > 0.0 {
                let r = probe.probe.position[1];
                let mean = self.faces.at(r, |k| self.wall_pressures[k]);
                let velocity = self.faces.at(r, |k| solver.interface().states()[k].velocity);
                let clock = solver.clock();
                let middle = clock.middle(solver.group_of_face(self.faces.nearest(r)));
                [pressure, v_z] = probe.star.at([mean, velocity], middle, time);
            }
            let row = [time, pressure, state.density, v_z, state.v_r, state.phi];
            history.push(probe.series, &row)?;
        }
        Ok(())
    }
}

/// Makes the series of the single bubbles, `bubbles/1` the one nearest to the wall, where there are several.
fn bubble_series(cuts: &BubbleCuts, history: &mut HistoryFile) -> Result<Option<SeriesId>, OutputError> {
    if cuts.bubbles() < 2 {
        return Ok(None);
    }
    let names: Vec<[String; 4]> = (1..=cuts.bubbles())
        .map(|number| BUBBLE_COLUMNS.map(|(name, ..)| format!("bubbles/{number}/{name}")))
        .collect();
    let columns: Vec<Column<'_>> = names
        .iter()
        .flat_map(|names| names.iter().zip(BUBBLE_COLUMNS))
        .map(|(name, (_, unit, description))| column(name, unit, description))
        .collect();
    history.add_series("", &columns).map(Some)
}

impl Record for FluidRecord {
    type Solver = FluidSolver<BLOCK>;
    type Snapshot = fluid::Snapshot;

    fn follow(&mut self, solver: &FluidSolver<BLOCK>, dt: f64) -> Result<(), OutputError> {
        let mesh = solver.mesh();
        self.seen.cells.see(mesh.cells());
        if self.faces.update(mesh.generation(), || solver.interface_edges())
            && let Some(interface) = &mut self.interface
        {
            interface.follow(&self.faces);
        }
        if solver.interface().states().is_empty() {
            solver.wall_face_pressures(&mut self.wall_pressures);
        } else {
            self.wall_pressures.clear();
            self.wall_pressures.extend(solver.interface().states().iter().map(|wall| wall.pressure));
        }
        solver.wall_face_shears(&mut self.wall_shears);
        let [fluxes, temperatures] = &mut self.wall_heat;
        solver.wall_face_heat(fluxes, temperatures);
        self.write(solver, dt)
    }

    fn snapshot(&mut self, solver: &FluidSolver<BLOCK>) -> Result<(), OutputError> {
        self.files.snapshot(solver.time(), solver.mesh(), || solver.snapshot())
    }

    fn summary(&self, solver: &FluidSolver<BLOCK>) -> Map<String, Value> {
        let radius = |volume: f64| match solver.mesh().domain().geometry {
            Geometry::Axisymmetric => (0.75 * volume / std::f64::consts::PI).cbrt(),
            Geometry::Planar => (volume / std::f64::consts::PI).sqrt(),
        };
        let collapse = self.seen.collapse.found();
        let grown = self.seen.collapse.grown();
        let largest = self.seen.collapse.largest().filter(|largest| largest.volume > 0.0);
        let with_wall = self.interface.is_some();
        let peak = |[value, _]: [f64; 2]| if with_wall { json!(value) } else { Value::Null };
        let peak_time = |[_, time]: [f64; 2]| if with_wall { json!(time) } else { Value::Null };
        // What a collapse from there sets free, J/rad (planar: J/m).
        let turn = solver.mesh().domain().geometry.turn();
        let collapse_energy = largest.map_or(0.0, |largest| self.ambient_pressure * largest.volume / turn);
        let mut map = entries(json!({
            "collapse_time": collapse.map(|c| c.time),
            "min_equivalent_radius": collapse.map(|c| radius(c.volume.max(0.0))),
            "growth_time": grown.map(|largest| largest.time),
            "max_equivalent_radius": largest.map(|largest| radius(largest.volume)),
            "final_equivalent_radius": self.seen.last_bubble.equivalent_radius,
            "trace_gas_volume": self.seen.last_bubble.trace_volume,
            "thin_gas_volume": self.seen.last_bubble.thin_volume,
            "thin_gas_volume_largest": self.seen.largest_thin_volume,
            "wall_pressure_peak": peak(self.seen.peaks.wall),
            "wall_pressure_peak_time": peak_time(self.seen.peaks.wall),
            "wall_pressure_peak_interface": peak(self.seen.peaks.wall_interface),
            "wall_pressure_peak_interface_time": peak_time(self.seen.peaks.wall_interface),
            "wall_pressure_peak_anywhere": peak(self.seen.peaks.wall_anywhere),
            "wall_pressure_peak_anywhere_time": peak_time(self.seen.peaks.wall_anywhere),
            "jet_velocity_peak": self.seen.peaks.jet[0],
            "jet_velocity_peak_time": self.seen.peaks.jet[1],
            "fixups": fixups::summary(solver.fixups(), collapse_energy),
        }));
        map.extend(self.seen.cells.summary("fluid", solver.cell_updates(), solver.common_updates()));
        map.extend(self.seen.film.summary());
        let bubbles = Some(self.seen.cuts.bubbles()).filter(|count| *count > 1);
        map.extend(bubbles.map(|count| ("bubbles".to_owned(), json!(count))));
        map.extend(cut::summary(solver, radius));
        let masses = solver.carried_masses();
        map.extend(self.interface.iter().flat_map(InterfaceHistory::summary));
        map.extend(masses.map(|(name, mass)| (format!("{name}_mass"), json!(mass))));
        map.extend(phases::summary(solver));
        map.extend(self.cells_per_radius.map(|cells| ("cells_per_radius".to_owned(), json!(cells))));
        map
    }

    fn files(&self) -> &SideFiles<fluid::Snapshot> {
        &self.files
    }

    fn files_mut(&mut self) -> &mut SideFiles<fluid::Snapshot> {
        &mut self.files
    }
}
