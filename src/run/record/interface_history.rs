//! The history of the interface on a fixed radial grid, whatever faces the mesh has there.

use coupler::CommonRefinement;
use mesh::{Geometry, Misfit};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::case::Case;
use crate::output::{Column, HistoryFile, OutputError, SeriesId};
use crate::run::record::column;
use crate::run::record::sensors::{SensorState, Sensors};
use crate::run::record::wall_axis::WallAxis;
use crate::run::record::wall_heat::WallHeat;
use crate::run::record::wall_shear::WallShear;
use crate::run::side::wall_faces::WallFaces;

/// Pressure, velocity and impulse on the interface, as means over the cells of a fixed grid.
pub struct InterfaceHistory {
    series: SeriesId,
    /// From the present faces to the grid.
    map: CommonRefinement,
    axisymmetric: bool,
    /// Outer radii of the grid's cells.
    grid: Vec<f64>,
    /// Pressure at t = 0.
    initial: Vec<f64>,
    /// Pressure of the last step.
    pressure: Vec<f64>,
    impulse: Vec<f64>,
    sensors: Sensors,
    axis: WallAxis,
    /// Under a viscous fluid.
    shear: Option<WallShear>,
    /// Under a fluid that conducts heat.
    heat: Option<WallHeat>,
}

/// What has happened on the faces in a step, means over it.
#[derive(Clone, Copy)]
pub struct OnFaces<'a> {
    /// Pa.
    pub pressures: &'a [f64],
    /// σ_zr, Pa; none without viscosity.
    pub stresses: &'a [f64],
    /// Heat fluxes into the wall, W/m², and its temperatures, K; none without conduction.
    pub heat: [&'a [f64]; 2],
}

impl<'a> OnFaces<'a> {
    /// Under a load, of which nothing else is known.
    pub fn of_pressures(pressures: &'a [f64]) -> Self {
        Self { pressures, stresses: &[], heat: [&[]; 2] }
    }
}

/// What of it changes in time, and what hangs on the faces that there were at t = 0.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct InterfaceState {
    grid: Vec<f64>,
    initial: Vec<f64>,
    pressure: Vec<f64>,
    impulse: Vec<f64>,
    sensors: Vec<SensorState>,
    axis: WallAxis,
    shear: Option<WallShear>,
    heat: Option<WallHeat>,
}

impl InterfaceHistory {
    /// What has to be kept of it.
    pub fn saved(&self) -> InterfaceState {
        let Self {
            series: _,
            map: _,
            axisymmetric: _,
            grid,
            initial,
            pressure,
            impulse,
            sensors,
            axis,
            shear,
            heat,
        } = self;
        InterfaceState {
            grid: grid.clone(),
            initial: initial.clone(),
            pressure: pressure.clone(),
            impulse: impulse.clone(),
            sensors: sensors.saved(),
            axis: axis.clone(),
            shear: shear.clone(),
            heat: heat.clone(),
        }
    }

    /// Takes up what was kept of the same history; `faces` are those of now.
    pub fn restore(
        &mut self,
        saved: InterfaceState,
        faces: &WallFaces,
        history: &mut HistoryFile,
    ) -> Result<(), Misfit> {
        let InterfaceState { grid, initial, pressure, impulse, sensors, axis, shear, heat } = saved;
        if [grid.len(), initial.len(), pressure.len(), impulse.len()] != [self.grid.len(); 4] {
            return Err(Misfit(format!("the interface's history has {} cells", grid.len())));
        }
        if !self.sensors.restore(sensors) {
            return Err(Misfit("the sensors on the wall are others".to_owned()));
        }
        (self.grid, self.initial, self.pressure, self.impulse) = (grid, initial, pressure, impulse);
        (self.axis, self.shear, self.heat) = (axis, shear, heat);
        put_centres(faces.begin(), &self.grid, history);
        self.follow(faces);
        Ok(())
    }

    /// Adds `/interface` to a history: `cells` of equal width, `pressures` on the faces at t = 0.
    pub fn create(
        case: &Case,
        faces: &WallFaces,
        cells: usize,
        pressures: &[f64],
        history: &mut HistoryFile,
    ) -> Result<Self, OutputError> {
        let begin = faces.begin();
        let end = faces.edges().last().copied().unwrap_or(begin);
        let grid: Vec<f64> = (1..=cells)
            .map(|k| if k == cells { end } else { begin + (end - begin) * k as f64 / cells as f64 })
            .collect();
        put_centres(begin, &grid, history);
        let wide = |name, unit, description| Column { name, unit, description, width: cells };
        let terms = case.fluid.as_ref().map(|fluid| &fluid.terms);
        let is_viscous = terms.is_some_and(|terms| terms.viscosity.is_some());
        let conducts = terms.is_some_and(|terms| terms.conduction.is_some());
        let mut columns = vec![
            column("time", "s", "end of the step"),
            wide("pressure", "Pa", "pressure of the star state, mean over the step"),
            wide("normal_velocity", "m/s", "velocity of the star state along +z, mean over the step"),
            wide("impulse", "Pa s", "time integral of the pressure minus that at t = 0"),
        ];
        if is_viscous {
            let about = "shear stress with which the fluid drags the wall along +r, mean over the step";
            columns.push(wide("shear", "Pa", about));
        }
        if conducts {
            let about = "temperature of the wall; of one that lets nothing through that of the fluid on it";
            columns.push(wide("wall_temperature", "K", about));
            columns.push(wide("heat_flux", "W/m2", "heat flux into the wall, mean over the step"));
        }
        let series = history.add_series("/interface", &columns)?;
        let zero = vec![0.0; cells];
        let mut interface = Self {
            series,
            map: CommonRefinement::default(),
            axisymmetric: case.geometry == Geometry::Axisymmetric,
            grid,
            initial: zero.clone(),
            pressure: zero.clone(),
            impulse: zero,
            sensors: Sensors::create(case, faces, pressures, history)?,
            axis: WallAxis::new(case.mean_time(), faces.on_axis(pressures), case.ambient_pressure()),
            shear: is_viscous.then(|| WallShear::new(cells)),
            heat: conducts.then(|| WallHeat::new(cells)),
        };
        interface.follow(faces);
        interface.add(pressures, 0.0);
        interface.initial.clone_from(&interface.pressure);
        Ok(interface)
    }

    /// Takes notice of other faces than before.
    pub fn follow(&mut self, faces: &WallFaces) {
        self.map.update(faces.begin(), faces.edges(), &self.grid, self.axisymmetric);
    }

    /// Takes notice of a step with this on the faces that it follows; sensors get their rows.
    pub fn after_step(
        &mut self,
        faces: &WallFaces,
        OnFaces { pressures, stresses, heat: of_heat }: OnFaces<'_>,
        (time, dt): (f64, f64),
        history: &mut HistoryFile,
    ) -> Result<(), OutputError> {
        self.add(pressures, dt);
        if let Some(shear) = self.shear.as_mut().filter(|_| !stresses.is_empty()) {
            shear.after_step(faces, &self.map, stresses, time);
        }
        if let Some(heat) = self.heat.as_mut().filter(|_| !of_heat[0].is_empty()) {
            heat.after_step(faces, &self.map, of_heat, time);
        }
        self.axis.after_step(faces.on_axis(pressures), (time, dt));
        self.sensors.after_step(faces, pressures, (time, dt), history)
    }

    /// Forgets the load so far, see [`WallAxis::forget_load`].
    pub fn forget_load(&mut self) {
        self.axis.forget_load();
        self.sensors.forget_load();
    }

    /// Its part of the summary.
    pub fn summary(&self) -> Map<String, Value> {
        let mut part = self.axis.summary();
        part.extend(self.sensors.summary());
        part.extend(self.shear.iter().flat_map(|shear| shear.peak.summary("wall_shear_peak")));
        part.extend(self.heat.iter().flat_map(|heat| heat.peak.summary("wall_temperature_peak")));
        part
    }

    /// Takes notice of a step of length `dt` with these mean pressures on the faces.
    fn add(&mut self, pressures: &[f64], dt: f64) {
        let Self { map, pressure, impulse, initial, .. } = self;
        map.means(
            true,
            |k| pressures[map.sub_faces()[k].first],
            |cell, mean| {
                pressure[cell] = mean;
                impulse[cell] += dt * (mean - initial[cell]);
            },
        );
    }

    /// Adds a row: the last step's pressures, the `velocity` on the faces, the impulse so far.
    pub fn write(
        &self,
        time: f64,
        velocity: impl Fn(usize) -> f64,
        history: &mut HistoryFile,
    ) -> Result<(), OutputError> {
        let cells = self.grid.len();
        let mut row = Vec::with_capacity(1 + 6 * cells);
        row.push(time);
        row.extend_from_slice(&self.pressure);
        self.map.means(true, |k| velocity(self.map.sub_faces()[k].first), |_, mean| row.push(mean));
        row.extend_from_slice(&self.impulse);
        row.extend(self.shear.iter().flat_map(WallShear::means));
        row.extend(self.heat.iter().flat_map(WallHeat::rows));
        history.push(self.series, &row)
    }
}

/// Sets `/interface/r` to the centres of the cells that have these outer radii.
pub fn put_centres(begin: f64, grid: &[f64], history: &mut HistoryFile) {
    let centre = |k: usize| 0.5 * (grid[k] + if k == 0 { begin } else { grid[k - 1] });
    let centres: Vec<f64> = (0..grid.len()).map(centre).collect();
    history.put("/interface/r", "m", "centres of the radial grid", &centres);
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Faces of the unit disc by their outer radii.
    fn faces(edges: &[f64]) -> WallFaces {
        WallFaces::new(0, 0.0, edges.to_vec())
    }

    fn case() -> Case {
        let text = "[time]\nend = 1e-6\n[solid]\nz = [-1.0, 0.0]\nr = [0.0, 1.0]\ncells = [16, 16]\nmaterial = \"structural-steel\"\n\
                    [coupling]\nscheme = \"none\"\n";
        Case::from_toml(text, "disc", &[]).unwrap()
    }

    #[test]
    fn the_impulse_goes_on_when_the_faces_change_and_none_of_it_is_lost() {
        let directory = tempfile::tempdir().unwrap();
        let mut history = HistoryFile::create(&directory.path().join("fluid.h5"), &[]).unwrap();
        let coarse = faces(&[0.5, 1.0]);
        let mut interface = InterfaceHistory::create(&case(), &coarse, 4, &[3.0, 3.0], &mut history).unwrap();
        assert_eq!(interface.initial, [3.0; 4]);
        let area = |low: f64, high: f64| 0.5 * (high * high - low * low);
        let mut expected = 0.0;
        let mut step = |interface: &mut InterfaceHistory, edges: &[f64], pressures: &[f64], dt: f64| {
            interface.follow(&faces(edges));
            interface.add(pressures, dt);
            let mut low = 0.0;
            for (edge, pressure) in edges.iter().zip(pressures) {
                expected += dt * (pressure - 3.0) * area(low, *edge);
                low = *edge;
            }
        };
        step(&mut interface, &[0.5, 1.0], &[5.0, 3.0], 0.1);
        assert_eq!(interface.impulse, [0.2, 0.2, 0.0, 0.0], "a coarse face's pressure is its cells'");
        step(&mut interface, &[0.25, 0.5, 0.75, 1.0], &[4.0, 3.0, 3.0, 7.0], 0.2);
        step(&mut interface, &[0.125, 0.25, 0.375, 0.5, 1.0], &[9.0, 4.0, 3.0, 2.0, 1.0], 0.3);
        let impulse: f64 =
            (0..4).map(|k| interface.impulse[k] * area(0.25 * k as f64, 0.25 * (k + 1) as f64)).sum();
        assert!((impulse / expected - 1.0).abs() < 1e-14, "{impulse} {expected}");
        // A pressure that is the same everywhere stays the same to the last bit.
        interface.add(&[0.1; 5], 0.0);
        assert_eq!(interface.pressure, [0.1; 4]);
        interface.write(1.0, |face| face as f64, &mut history).unwrap();
    }
}
