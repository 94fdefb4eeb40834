//! Sensor discs on the wall: the mean pressure on each, its force and impulse, as a transducer would see them.

use mesh::Geometry;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::case::{Case, Sensor};
use crate::output::{Column, HistoryFile, OutputError, SeriesId};
use crate::run::record::column;
use crate::run::record::load_impulse::LoadImpulse;
use crate::run::record::running_mean::RunningMean;
use crate::run::side::wall_faces::WallFaces;

const COLUMNS: [Column<'static>; 4] = [
    column("time", "s", "end of the step"),
    column("pressure", "Pa", "mean over the disc and the rise time of the pressure minus that at t = 0"),
    column("force", "N", "force of it (planar: N/m)"),
    column("impulse", "N s", "time integral of the force, without the rise time (planar: N s/m)"),
];

/// All sensors of a case.
pub struct Sensors {
    geometry: Geometry,
    /// Pressure far away, Pa.
    ambient: f64,
    sensors: Vec<OnWall>,
}

struct OnWall {
    sensor: Sensor,
    area: f64,
    series: SeriesId,
    state: SensorState,
}

/// What of a sensor changes in time, and the pressure at t = 0.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct SensorState {
    /// Mean pressure at t = 0, Pa.
    initial: f64,
    /// Over the rise time, of the pressure beyond the initial one.
    mean: RunningMean,
    /// Largest pressure shown so far, Pa, and when, s.
    peak: [f64; 2],
    load: LoadImpulse,
}

impl Sensors {
    /// Adds `/sensors` to a history, where the case has any.
    ///
    /// - `pressures`: on the faces at t = 0.
    pub fn create(
        case: &Case,
        faces: &WallFaces,
        pressures: &[f64],
        history: &mut HistoryFile,
    ) -> Result<Self, OutputError> {
        let geometry = case.geometry;
        let add = |sensor: &Sensor| {
            let series = history.add_series(&format!("/sensors/{}", sensor.name), &COLUMNS)?;
            history.push(series, &[0.0; 4])?;
            let initial = mean(geometry, faces, sensor.radius, pressures);
            let area = area(geometry, inner(faces, sensor.radius), sensor.radius);
            let state = SensorState { initial, ..SensorState::default() };
            Ok(OnWall { sensor: sensor.clone(), area, series, state })
        };
        let ambient = case.ambient_pressure();
        Ok(Self {
            geometry,
            ambient,
            sensors: case.sensors.iter().map(add).collect::<Result<_, OutputError>>()?,
        })
    }

    /// What has to be kept of them.
    pub fn saved(&self) -> Vec<SensorState> {
        self.sensors.iter().map(|own| own.state.clone()).collect()
    }

    /// Takes up what was kept of the same sensors; says whether they were.
    pub fn restore(&mut self, saved: Vec<SensorState>) -> bool {
        let fits = saved.len() == self.sensors.len();
        self.sensors.iter_mut().zip(saved).for_each(|(own, state)| own.state = state);
        fits
    }

    /// Takes notice of a step with these mean pressures on the faces, and adds a row for each sensor.
    pub fn after_step(
        &mut self,
        faces: &WallFaces,
        pressures: &[f64],
        (time, dt): (f64, f64),
        history: &mut HistoryFile,
    ) -> Result<(), OutputError> {
        if !(dt > 0.0) {
            return Ok(());
        }
        for OnWall { sensor, area, series, state } in &mut self.sensors {
            let pressure = mean(self.geometry, faces, sensor.radius, pressures);
            state.load.after_step(pressure - self.ambient, (time, dt));
            let shown = state.mean.push(sensor.rise_time, dt, pressure - state.initial);
            if shown > state.peak[0] {
                state.peak = [shown, time];
            }
            history.push(*series, &[time, shown, shown * *area, state.mean.integral() * *area])?;
        }
        Ok(())
    }

    /// Forgets the load so far: a bubble that grows pushes on the wall before its collapse does.
    pub fn forget_load(&mut self) {
        self.sensors.iter_mut().for_each(|own| own.state.load = LoadImpulse::default());
    }

    /// Their part of the summary.
    pub fn summary(&self) -> Map<String, Value> {
        let of = |own: &OnWall| {
            let [peak, time] = own.state.peak;
            let numbers = json!({
                "radius": own.sensor.radius,
                "rise_time": own.sensor.rise_time,
                "pressure_peak": peak,
                "pressure_peak_time": time,
                "force_peak": peak * own.area,
                "impulse": own.state.mean.integral() * own.area,
                "load_impulse": own.state.load.peak()[0] * own.area,
            });
            (own.sensor.name.clone(), numbers)
        };
        let sensors = Map::from_iter(self.sensors.iter().map(of));
        if sensors.is_empty() { Map::new() } else { Map::from_iter([("sensors".to_owned(), json!(sensors))]) }
    }
}

/// The part of the wall between two radii, m² (planar: m).
fn area(geometry: Geometry, low: f64, high: f64) -> f64 {
    match geometry {
        Geometry::Planar => high - low,
        Geometry::Axisymmetric => std::f64::consts::PI * (high * high - low * low),
    }
}

/// Where a sensor begins on a wall: at r = 0, or in the plane on the other side of it.
fn inner(faces: &WallFaces, radius: f64) -> f64 {
    faces.begin().max(-radius)
}

/// The mean of the pressures on the faces over the wall up to a radius; a face that reaches beyond counts with its part within.
fn mean(geometry: Geometry, faces: &WallFaces, radius: f64, pressures: &[f64]) -> f64 {
    let begin = inner(faces, radius);
    let (mut low, mut sum) = (begin, 0.0);
    for (edge, pressure) in faces.edges().iter().zip(pressures).filter(|(edge, _)| **edge > begin) {
        if low >= radius {
            break;
        }
        sum += area(geometry, low, edge.min(radius)) * pressure;
        low = *edge;
    }
    sum / area(geometry, begin, radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean over the wall up to a radius.
    fn over(geometry: Geometry, edges: &[f64], radius: f64, pressures: &[f64]) -> f64 {
        mean(geometry, &WallFaces::new(0, 0.0, edges.to_vec()), radius, pressures)
    }

    #[test]
    fn a_disc_has_the_mean_over_its_area_whatever_the_faces() {
        let (coarse, pressures) = ([1.0, 2.0, 4.0], [9.0, 3.0, 1.8]);
        // Over r < 3: areas 1, 3, 5 (of π).
        assert!((over(Geometry::Axisymmetric, &coarse, 3.0, &pressures) - 3.0).abs() < 1e-15);
        let (finer, same) = ([0.5, 1.0, 1.5, 2.0, 3.0, 4.0], [9.0, 9.0, 3.0, 3.0, 1.8, 1.8]);
        assert!((over(Geometry::Axisymmetric, &finer, 3.0, &same) - 3.0).abs() < 1e-15);
        assert_eq!(over(Geometry::Planar, &coarse, 4.0, &[4.0, 2.0, 1.0]), 2.0);
        assert_eq!(over(Geometry::Axisymmetric, &coarse, 0.5, &pressures), 9.0, "a sensor within one face");
    }
}
