//! What the solid's side writes: snapshots, histories, its part of the summary.

mod plastic;

use mesh::{BLOCK, Misfit};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use solid::SolidSolver;

use self::plastic::PlasticPeak;
use crate::case::{Case, Medium};
use crate::output::run_directory::{SOLID_FIELDS as FIELDS_FILE, SOLID_HISTORY};
use crate::output::{Column, OutputError, RunDirectory, SeriesId};
use crate::run::RunError;
use crate::run::record::of_side::Record;
use crate::run::record::side_files::{FilesState, SideFiles, SideNames};
use crate::run::record::surface::surface_record::{SurfaceRecord, SurfaceState};
use crate::run::record::{
    CellCount, MOMENTUM, PROBE_VELOCITY, ProbeSeries, StepEnds, TIME, TIME_AFTER_STEP, Ticker, column,
    entries, probe_series, restore_probes, saved_probes, through_sides,
};
use crate::run::side::wall_faces::WallFaces;

/// Everything that the solid's side writes.
pub struct SolidRecord {
    files: SideFiles<solid::Snapshot>,
    steps: SeriesId,
    /// `/time`, which the fluid writes where there is one.
    time: Option<SeriesId>,
    conservation: SeriesId,
    ticker: Ticker,
    probes: Vec<ProbeSeries>,
    faces: WallFaces,
    surface: Option<SurfaceRecord>,
    cells: CellCount,
    peak: Peak,
    plastic: PlasticPeak,
    initial_energy: f64,
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Peak {
    stress: f64,
    time: f64,
    position: [f64; 2],
    yielded: f64,
}

/// What of a record changes in time, and what hangs on the state at t = 0.
#[derive(Serialize, Deserialize)]
pub struct SolidRecordState {
    files: FilesState,
    ticker: Ticker,
    probes: Vec<StepEnds>,
    surface: Option<SurfaceState>,
    cells: CellCount,
    peak: Peak,
    plastic: PlasticPeak,
    initial_energy: f64,
}

impl SolidRecord {
    /// Makes the files of the solid's side and writes the state at t = 0. Without a directory histories stay in memory
    /// and there are no snapshots.
    ///
    /// - `displacement`: of the surface at t = 0, if the wall has been hit before, see [`SurfaceRecord::create`].
    pub fn create(
        case: &Case,
        directory: Option<&RunDirectory>,
        solver: &SolidSolver<BLOCK>,
        displacement: Option<&[[f64; 2]]>,
    ) -> Result<Self, OutputError> {
        let files = SideFiles::create(case, directory, names(solver))?;
        let mut record = Self::on(case, files, solver, displacement)?;
        record.cells.see(solver.mesh().cells());
        record.write(solver, 0.0)?;
        record.begun(solver)
    }

    /// Takes up the files of a run, and what was kept of its record; what was written since is forgotten.
    pub fn resume(
        case: &Case,
        directory: &RunDirectory,
        solver: &SolidSolver<BLOCK>,
        saved: SolidRecordState,
    ) -> Result<Self, RunError> {
        let files = SideFiles::resume(case, directory, names(solver), &saved.files)?;
        let mut record = Self::on(case, files, solver, None)?;
        let SolidRecordState { files, ticker, probes, surface, cells, peak, plastic, initial_energy } = saved;
        record.ticker = ticker;
        restore_probes(&mut record.probes, probes)?;
        match (&mut record.surface, surface) {
            (Some(own), Some(saved)) => {
                own.restore(saved, solver, &record.faces, &mut record.files.history)?;
            }
            (None, None) => {}
            _ => return Err(Misfit("only one of both has a surface".to_owned()).into()),
        }
        record.cells = cells;
        record.peak = peak;
        record.plastic = plastic;
        record.initial_energy = initial_energy;
        record.files.forget_rows(&files)?;
        Ok(record)
    }

    /// What has to be kept of it.
    pub fn saved(&self) -> SolidRecordState {
        // Field by field, so that a new one cannot be forgotten here.
        let Self {
            files,
            steps: _,
            time: _,
            conservation: _,
            ticker,
            probes,
            faces: _,
            surface,
            cells,
            peak,
            plastic,
            initial_energy,
        } = self;
        SolidRecordState {
            files: files.saved(),
            ticker: *ticker,
            probes: saved_probes(probes),
            surface: surface.as_ref().map(SurfaceRecord::saved),
            cells: *cells,
            peak: *peak,
            plastic: *plastic,
            initial_energy: *initial_energy,
        }
    }

    /// A record in these files of a solid as it is, with nothing written.
    fn on(
        case: &Case,
        mut files: SideFiles<solid::Snapshot>,
        solver: &SolidSolver<BLOCK>,
        displacement: Option<&[[f64; 2]]>,
    ) -> Result<Self, OutputError> {
        let mesh = solver.mesh();
        let history = &mut files.history;
        let steps = history.add_series("/solid", &columns(&STEP_COLUMNS, &plastic::STEP_COLUMNS, solver))?;
        let time = match &case.fluid {
            Some(_) => None,
            None => Some(history.add_series("", &[TIME_AFTER_STEP])?),
        };
        let through_sides = (0..4).flat_map(|side| THROUGH_SIDES.map(|quantity| quantity[side]));
        let always: Vec<Column<'_>> = CONSERVATION_COLUMNS.into_iter().chain(through_sides).collect();
        let columns = columns(&always, &[plastic::CONSERVATION_COLUMN], solver);
        let conservation = history.add_series("/conservation/solid", &columns)?;
        // A load has a star state, too; a boundary has not.
        let covered = case.coupling.scheme != coupler::Scheme::None;
        let interface_z = covered.then(|| mesh.domain().z[1]);
        let probes = probe_series(case, Medium::Solid, interface_z, &PROBE_COLUMNS, history)?;
        let faces = WallFaces::new(mesh.generation(), mesh.domain().r[0], solver.interface_edges());
        let surface = SurfaceRecord::create(case, solver, (&faces, displacement), history)?;
        let totals = solver.totals();
        Ok(Self {
            files,
            steps,
            time,
            conservation,
            ticker: Ticker::of(case),
            probes,
            faces,
            surface,
            cells: CellCount::default(),
            plastic: PlasticPeak::default(),
            peak: Peak { stress: -1.0, time: 0.0, position: [f64::NAN; 2], yielded: 0.0 },
            initial_energy: totals.kinetic + totals.elastic,
        })
    }

    fn write(&mut self, solver: &SolidSolver<BLOCK>, dt: f64) -> Result<(), OutputError> {
        let time = solver.time();
        let mises = solver.mises_peak();
        let yielded = solver.yielded_volume();
        let history = &mut self.files.history;
        let mut row = vec![time, mises.stress, mises.position[0], mises.position[1], yielded];
        if solver.is_plastic() {
            row.extend(self.plastic.follow(solver));
        }
        history.push(self.steps, &row)?;
        if let Some(series) = self.time {
            history.push(series, &[time])?;
        }
        if mises.stress > self.peak.stress {
            self.peak = Peak { stress: mises.stress, time, position: mises.position, ..self.peak };
        }
        self.peak.yielded = self.peak.yielded.max(yielded);
        // Between the ends of whole steps levels are at different times, and nothing adds up.
        if solver.clock().is_over() && self.ticker.is_due(time) {
            let totals = solver.totals();
            let ledger = solver.ledger();
            let energy = totals.kinetic + totals.elastic;
            let plastic = solver.plastic_ledger().work;
            let dissipated = self.initial_energy + ledger.energy.iter().sum::<f64>() - energy - plastic;
            let mut row = vec![
                time,
                totals.mass,
                totals.momentum_z,
                energy,
                totals.kinetic,
                totals.elastic,
                dissipated,
            ];
            for side in 0..4 {
                row.extend([ledger.momentum[side], ledger.energy[side]]);
            }
            if solver.is_plastic() {
                row.push(plastic);
            }
            history.push(self.conservation, &row)?;
            if let Some(surface) = &self.surface {
                surface.write(solver, history)?;
            }
        }
        for probe in &mut self.probes {
            let Some(state) = solver.sample(probe.probe.position) else { continue };
            let mut row = [
                time,
                state.v_z,
                state.v_r,
                state.stress_zz,
                state.stress_zr,
                state.stress_rr,
                state.stress_phiphi,
            ];
            if probe.on_interface && dt > 0.0 {
                let r = probe.probe.position[1];
                let velocity = self.faces.at(r, |k| solver.interface().states()[k].velocity);
                let stress = self.faces.at(r, |k| -solver.interface().states()[k].pressure);
                let clock = solver.clock();
                let middle = clock.middle(solver.group_of_face(self.faces.nearest(r)));
                [row[1], row[3]] = probe.star.at([velocity, stress], middle, time);
                row[4] = self.faces.at(r, |k| solver.interface().states()[k].shear);
            }
            history.push(probe.series, &row)?;
        }
        Ok(())
    }

    /// The surface, where something acts on it.
    pub fn surface(&self) -> Option<&SurfaceRecord> {
        self.surface.as_ref()
    }
}

/// Columns, and those that are only there where the solid can yield.
fn columns(
    always: &[Column<'static>],
    plastic: &[Column<'static>],
    solver: &SolidSolver<BLOCK>,
) -> Vec<Column<'static>> {
    let plastic = if solver.is_plastic() { plastic } else { &[] };
    always.iter().chain(plastic).copied().collect()
}

impl Record for SolidRecord {
    type Solver = SolidSolver<BLOCK>;
    type Snapshot = solid::Snapshot;

    fn follow(&mut self, solver: &SolidSolver<BLOCK>, dt: f64) -> Result<(), OutputError> {
        let mesh = solver.mesh();
        self.cells.see(mesh.cells());
        let changed = self.faces.update(mesh.generation(), || solver.interface_edges());
        if let Some(surface) = &mut self.surface {
            surface.after_step(solver, dt, (&self.faces, changed), &mut self.files.history)?;
        }
        self.write(solver, dt)
    }

    fn snapshot(&mut self, solver: &SolidSolver<BLOCK>) -> Result<(), OutputError> {
        self.files.snapshot(solver.time(), solver.mesh(), || solver.snapshot())
    }

    fn summary(&self, solver: &SolidSolver<BLOCK>) -> Map<String, Value> {
        let strength = solver.setup().yield_strength;
        let mut map = entries(json!({
            "von_mises_peak": self.peak.stress,
            "von_mises_peak_time": self.peak.time,
            "von_mises_peak_position": self.peak.position,
            "yield_strength": strength.is_finite().then_some(strength),
            "yielded_volume_peak": self.peak.yielded,
        }));
        if solver.is_plastic() {
            map.extend(self.plastic.summary(solver));
        }
        map.extend(self.surface.iter().flat_map(|surface| surface.summary(solver)));
        map.extend(self.cells.summary("solid", solver.cell_updates(), solver.common_updates()));
        map
    }

    fn files(&self) -> &SideFiles<solid::Snapshot> {
        &self.files
    }

    fn files_mut(&mut self) -> &mut SideFiles<solid::Snapshot> {
        &mut self.files
    }
}

const STEP_COLUMNS: [Column<'static>; 4] = [
    TIME_AFTER_STEP,
    column("von_mises_max", "Pa", "largest von Mises stress in a cell"),
    Column { name: "von_mises_max_position", unit: "m", description: "centre (z, r) of that cell", width: 2 },
    column("yielded_volume", "m3", "volume in which the von Mises stress exceeds the yield strength"),
];

const CONSERVATION_COLUMNS: [Column<'static>; 7] = [
    TIME,
    column("mass", "kg/rad", "mass in the domain, constant (planar: kg/m)"),
    MOMENTUM,
    column("energy", "J/rad", "kinetic and elastic energy in the domain"),
    column("kinetic_energy", "J/rad", "kinetic energy in the domain"),
    column("elastic_energy", "J/rad", "elastic energy in the domain"),
    column(
        "energy_dissipated",
        "J/rad",
        "work done on the solid minus the growth of its energy and the plastic work: the scheme's loss",
    ),
];

/// Axial momentum and energy that came in, on each side.
const THROUGH_SIDES: [[Column<'static>; 4]; 2] = [
    through_sides!(
        "momentum",
        "N s/rad",
        [
            "axial impulse of the traction on z_min",
            "the same on z_max; under a fluid the interface",
            "the same on "
        ]
    ),
    through_sides!(
        "energy",
        "J/rad",
        ["work of the traction on z_min", "the same on z_max; under a fluid the interface", "the same on "]
    ),
];

const PROBE_COLUMNS: [Column<'static>; 7] = [
    TIME_AFTER_STEP,
    PROBE_VELOCITY[0],
    PROBE_VELOCITY[1],
    column("stress_zz", "Pa", "axial stress; on the interface that of the star state"),
    column("stress_zr", "Pa", "shear stress"),
    column("stress_rr", "Pa", "radial stress"),
    column("stress_phiphi", "Pa", "hoop stress"),
];

fn names(solver: &SolidSolver<BLOCK>) -> SideNames<solid::Snapshot> {
    // A material without a yield strength has no yield function.
    let has_yield_strength = solver.setup().yield_strength.is_finite();
    let is_there = |name: &str| match name {
        "yield_function" => has_yield_strength,
        "plastic_strain" | "plastic_strain_rate" | "displacement" => solver.is_plastic(),
        "temperature" => solver.has_heat(),
        _ => true,
    };
    let fields = solid::CELL_FIELDS.iter().filter(|field| is_there(field.name));
    SideNames { history: SOLID_HISTORY, snapshots: FIELDS_FILE, fields: fields.collect() }
}
