//! The `[[sensor]]` tables: discs on the wall about the axis.

use super::reader::{Faults, Given, Table};
use super::shared::name_of;
use super::{GridCase, Sensor};

/// A sensor and where its radius stands.
pub(super) struct PlacedSensor {
    pub sensor: Sensor,
    pub radius: Given<f64>,
}

pub(super) fn sensors(root: &mut Table<'_>, faults: &mut Faults) -> Vec<PlacedSensor> {
    let mut sensors: Vec<PlacedSensor> = Vec::new();
    for mut table in root.tables("sensor", faults) {
        let name = name_of(
            &mut table,
            "sensor",
            |name| sensors.iter().any(|other| other.sensor.name == name),
            faults,
        );
        let place = table.place("radius");
        let radius = table.required_positive("radius", faults);
        let rise_time = table.positive("rise_time", faults);
        table.finish(faults);
        if let (Some(name), Some(radius), Some(place)) = (name, radius, place) {
            let sensor = Sensor { name, radius, rise_time: rise_time.unwrap_or(0.0) };
            let Given { path, span, .. } = place;
            sensors.push(PlacedSensor { sensor, radius: Given { value: radius, path, span } });
        }
    }
    sensors
}

/// Every sensor lies on a wall.
///
/// - `wall`: the side that records the pressure on it; `None` where the case has no wall.
pub(super) fn on_wall(
    sensors: Vec<PlacedSensor>,
    wall: Option<&GridCase>,
    faults: &mut Faults,
) -> Vec<Sensor> {
    for PlacedSensor { radius, .. } in &sensors {
        match wall {
            None => {
                let help = "remove the sensor, or take a coupling.scheme with a wall: \"riemann\", \"rigid\", \"load\"";
                faults.of(radius, "this case has no wall that a sensor could be on", help);
            }
            Some(grid) if radius.value > grid.r[1] => {
                let message = format!(
                    "{:?} m reaches beyond the wall, which ends at r = {:?} m",
                    radius.value, grid.r[1]
                );
                faults.of(radius, message, format!("give at most {:?} m", grid.r[1]));
            }
            Some(_) => {}
        }
    }
    sensors.into_iter().map(|placed| placed.sensor).collect()
}
