//! What is written of the solid's surface.

use coupler::CommonRefinement;
use mesh::{BLOCK, Geometry, Misfit};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use solid::SolidSolver;

use super::displacement::SurfaceDisplacement;
use super::pit::{Pit, Profile};
use super::rest::Rest;
use crate::case::{Case, LoadCase};
use crate::output::{Column, HistoryFile, OutputError, SeriesId};
use crate::run::record::column;
use crate::run::record::interface_history::{InterfaceHistory, InterfaceState, OnFaces, put_centres};
use crate::run::side::wall_faces::WallFaces;

/// Displacement of the surface, the pit in it, and under a load what presses on it.
pub struct SurfaceRecord {
    series: SeriesId,
    displacement: SurfaceDisplacement,
    rest: Rest,
    /// From the faces of the finest level to the grid of the history.
    map: CommonRefinement,
    cells: usize,
    /// Where there is no fluid whose part it is.
    load: Option<InterfaceHistory>,
    pressures: Vec<f64>,
    /// Whether the run ends when the surface is still.
    settles: bool,
}

/// What of it changes in time.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SurfaceState {
    displacement: SurfaceDisplacement,
    rest: Rest,
    load: Option<InterfaceState>,
}

impl SurfaceRecord {
    /// Adds the displacement to a history; `None` for a solid without a surface on which something acts.
    ///
    /// - `earlier`: the displacement at t = 0, if the wall has been hit before.
    pub fn create(
        case: &Case,
        solver: &SolidSolver<BLOCK>,
        (faces, earlier): (&WallFaces, Option<&[[f64; 2]]>),
        history: &mut HistoryFile,
    ) -> Result<Option<Self>, OutputError> {
        let displacement = SurfaceDisplacement::starting(solver, earlier.unwrap_or_default());
        let states = solver.interface().states();
        if states.is_empty() {
            return Ok(None);
        }
        let [begin, end] = solver.mesh().domain().r;
        let axisymmetric = case.geometry == Geometry::Axisymmetric;
        let count = displacement.len();
        let fluids = case.fluid.as_ref().map(|fluid| fluid.grid.finest()[1]);
        let cells = case.output.interface_cells.or(fluids).unwrap_or(count);
        let grid = edges([begin, end], cells);
        let mut map = CommonRefinement::default();
        map.update(begin, &edges([begin, end], count), &grid, axisymmetric);

        let load = match &case.coupling.load {
            Some(load) => {
                let pressures = match load {
                    LoadCase::Gaussian(_) => states.iter().map(|state| state.pressure).collect(),
                    // Its impulse is that beyond what the wall bore from the start.
                    LoadCase::Recorded(load) => on_faces(faces, load.at_start()),
                };
                Some(InterfaceHistory::create(case, faces, cells, &pressures, history)?)
            }
            None => {
                if case.fluid.is_none() {
                    put_centres(begin, &grid, history);
                }
                None
            }
        };
        let wide = |name, description| Column { name, unit: "m", description, width: cells };
        let columns = [
            column("displacement_time", "s", "time of the displacements"),
            wide("displacement_z", "displacement of the surface along +z since t = 0"),
            wide("displacement_r", "radial displacement of the surface since t = 0"),
        ];
        let series = history.add_series("/interface", &columns)?;
        let transit = (end - begin) / solver.setup().speeds.c2;
        let rest = Rest::new(
            &displacement,
            transit,
            case.coupling.load.as_ref().map_or(0.0, LoadCase::loaded_until),
        );
        let settles = case.time.settles;
        Ok(Some(Self { series, displacement, rest, map, cells, load, pressures: Vec::new(), settles }))
    }

    /// What has to be kept of it.
    pub fn saved(&self) -> SurfaceState {
        let Self { series: _, displacement, rest, map: _, cells: _, load, pressures: _, settles: _ } = self;
        SurfaceState {
            displacement: displacement.clone(),
            rest: rest.clone(),
            load: load.as_ref().map(InterfaceHistory::saved),
        }
    }

    /// Takes up what was kept of the same surface.
    pub fn restore(
        &mut self,
        saved: SurfaceState,
        solver: &SolidSolver<BLOCK>,
        faces: &WallFaces,
        history: &mut HistoryFile,
    ) -> Result<(), Misfit> {
        let SurfaceState { displacement, rest, load } = saved;
        displacement.fits(solver)?;
        if !rest.fits(displacement.len()) {
            return Err(Misfit("earlier displacements are not those of the surface".to_owned()));
        }
        (self.displacement, self.rest) = (displacement, rest);
        match (&mut self.load, load) {
            (Some(own), Some(saved)) => own.restore(saved, faces, history),
            (None, None) => Ok(()),
            _ => Err(Misfit("only one of both has a load".to_owned())),
        }
    }

    /// Takes notice of a step of length `dt`.
    ///
    /// - `changed`: whether `faces` are others than before.
    pub fn after_step(
        &mut self,
        solver: &SolidSolver<BLOCK>,
        dt: f64,
        (faces, changed): (&WallFaces, bool),
        history: &mut HistoryFile,
    ) -> Result<(), OutputError> {
        self.displacement.after_step(solver, dt);
        if solver.clock().is_over() {
            self.rest.look(solver.time(), &self.displacement);
        }
        if let Some(load) = &mut self.load {
            if changed {
                load.follow(faces);
            }
            self.pressures.clear();
            self.pressures.extend(solver.interface().states().iter().map(|state| state.pressure));
            load.after_step(faces, OnFaces::of_pressures(&self.pressures), (solver.time(), dt), history)?;
        }
        Ok(())
    }

    /// Adds a row to the histories.
    pub fn write(&self, solver: &SolidSolver<BLOCK>, history: &mut HistoryFile) -> Result<(), OutputError> {
        let time = solver.time();
        let profile = self.displacement.profile();
        let mut row = Vec::with_capacity(1 + 2 * self.cells);
        row.push(time);
        for c in 0..2 {
            let value = |k: usize| profile[self.map.sub_faces()[k].first][c];
            self.map.means(true, value, |_, mean| row.push(mean));
        }
        history.push(self.series, &row)?;
        let velocity =
            |face: usize| solver.interface().states().get(face).map_or(0.0, |state| state.velocity);
        self.load.as_ref().map_or(Ok(()), |load| load.write(time, velocity, history))
    }

    /// Whether the run is over, as the surface has become still.
    pub fn is_settled(&self) -> bool {
        self.settles && self.rest.is_settled()
    }

    /// The displacement so far.
    pub fn displacement(&self) -> &SurfaceDisplacement {
        &self.displacement
    }

    /// Its part of the summary.
    pub fn summary(&self, solver: &SolidSolver<BLOCK>) -> Map<String, Value> {
        let domain = solver.mesh().domain();
        let displacement: Vec<f64> = self.displacement.profile().iter().map(|[u_z, _]| *u_z).collect();
        let width = (domain.r[1] - domain.r[0]) / displacement.len() as f64;
        let profile =
            Profile { begin: domain.r[0], width, geometry: domain.geometry, displacement: &displacement };
        let (pit, floor) = (profile.pit(), self.rest.pit_floor());
        // What has not flowed only swings.
        let has_flowed = solver.plastic_strain_max() > 0.0;
        let pit = if has_flowed && pit.depth > floor { pit } else { Pit::default() };
        let mut part = Map::from_iter([
            ("pit_depth".to_owned(), json!(pit.depth)),
            ("pit_depth_axis".to_owned(), json!(pit.depth_axis)),
            ("pit_radius".to_owned(), json!(pit.radius)),
            ("pit_volume".to_owned(), json!(pit.volume)),
            ("pit_rim".to_owned(), json!(pit.rim)),
            ("pit_floor".to_owned(), json!(floor)),
            ("indentation_peak".to_owned(), json!(self.rest.deepest())),
            ("surface_still".to_owned(), json!(self.rest.still(&self.displacement))),
        ]);
        part.extend(self.load.iter().flat_map(InterfaceHistory::summary));
        if self.settles {
            part.insert("settled".to_owned(), json!(self.rest.is_settled()));
        }
        part
    }
}

/// A function of r at the centres of the faces.
fn on_faces(faces: &WallFaces, value: impl Fn(f64) -> f64) -> Vec<f64> {
    let lower = std::iter::once(faces.begin()).chain(faces.edges().iter().copied());
    lower.zip(faces.edges()).map(|(low, high)| value(0.5 * (low + high))).collect()
}

/// Outer edges of so many cells of equal width.
fn edges([begin, end]: [f64; 2], cells: usize) -> Vec<f64> {
    (1..=cells)
        .map(|k| if k == cells { end } else { begin + (end - begin) * k as f64 / cells as f64 })
        .collect()
}
