//! The numbers of a summary that grid convergence is looked at, with their units.

use std::collections::BTreeSet;

use mesh::Geometry;
use serde_json::{Map, Value};

use crate::output::per_depth;

/// Keys of `summary.json` with their units, in the order in which they are told; of planar runs those are [`per_depth`].
pub const KEY_NUMBERS: [(&str, &str); 54] = [
    ("wall_pressure_peak", "Pa"),
    ("wall_pressure_peak_time", "s"),
    ("wall_pressure_peak_interface", "Pa"),
    ("wall_pressure_peak_interface_time", "s"),
    ("wall_pressure_peak_anywhere", "Pa"),
    ("wall_pressure_peak_anywhere_time", "s"),
    ("wall_pressure_mean_peak", "Pa"),
    ("wall_pressure_mean_peak_time", "s"),
    ("wall_pressure_peak_first", "Pa"),
    ("wall_pressure_peak_second", "Pa"),
    ("wall_impulse", "Pa s"),
    ("wall_impulse_time", "s"),
    ("wall_impulse_first", "Pa s"),
    ("wall_impulse_second", "Pa s"),
    ("collapse_time", "s"),
    ("min_equivalent_radius", "m"),
    ("rebound_time", "s"),
    ("rebound_equivalent_radius", "m"),
    ("second_collapse_time", "s"),
    ("second_min_equivalent_radius", "m"),
    ("final_equivalent_radius", "m"),
    ("jet_velocity_peak", "m/s"),
    ("jet_velocity_peak_time", "s"),
    ("von_mises_peak", "Pa"),
    ("von_mises_peak_time", "s"),
    ("yielded_volume_peak", "m3"),
    ("plastic_strain_peak", "1"),
    ("plastic_strain_peak_time", "s"),
    ("plastic_strain_rate_peak", "1/s"),
    ("plastic_work", "J"),
    ("work_on_solid", "J"),
    ("plastic_work_share", "1"),
    ("work_per_pit_volume", "J/m3"),
    ("temperature_peak", "K"),
    ("plastic_zone_depth", "m"),
    ("plastic_zone_radius", "m"),
    ("plastic_volume", "m3"),
    ("plastic_zone_depth_2e-3", "m"),
    ("plastic_zone_radius_2e-3", "m"),
    ("plastic_volume_2e-3", "m3"),
    ("pit_depth", "m"),
    ("pit_depth_axis", "m"),
    ("pit_radius", "m"),
    ("pit_volume", "m3"),
    ("pit_rim", "m"),
    ("indentation_peak", "m"),
    ("load_impulse", "Pa s"),
    ("load_impulse_time", "s"),
    ("load_impulse_first", "Pa s"),
    ("load_impulse_second", "Pa s"),
    ("load_amplitude", "Pa"),
    ("load_radius", "m"),
    ("load_duration", "s"),
    ("load_time", "s"),
];

/// The same of each sensor, below `sensors.NAME`.
pub const SENSOR_NUMBERS: [(&str, &str); 5] = [
    ("pressure_peak", "Pa"),
    ("pressure_peak_time", "s"),
    ("force_peak", "N"),
    ("impulse", "N s"),
    ("load_impulse", "N s"),
];

/// A number by grid.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyNumber {
    /// Its key in the summary, tables joined by dots.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
    /// Of each grid, where that has one.
    pub values: Vec<Option<f64>>,
}

/// The numbers that some grid has.
///
/// - `summaries`: of the grids' runs; `None` for one that has not ended well.
/// - `geometry`: of all of them.
pub fn of_summaries(summaries: &[Option<&Map<String, Value>>], geometry: Geometry) -> Vec<KeyNumber> {
    let plain = KEY_NUMBERS.iter().map(|(key, unit)| (vec![(*key).to_owned()], *unit));
    let sensors: BTreeSet<&String> = (summaries.iter().flatten())
        .filter_map(|summary| summary.get("sensors")?.as_object())
        .flat_map(Map::keys)
        .collect();
    let of_sensor = |sensor: &String| {
        let sensor = sensor.clone();
        SENSOR_NUMBERS
            .iter()
            .map(move |(key, unit)| (vec!["sensors".to_owned(), sensor.clone(), (*key).to_owned()], *unit))
    };
    plain
        .chain(sensors.into_iter().flat_map(of_sensor))
        .map(|(path, unit)| {
            let values = summaries.iter().map(|summary| number(summary.as_ref()?, &path)).collect();
            let unit = if geometry == Geometry::Planar { per_depth(unit) } else { unit };
            KeyNumber { name: path.join("."), unit, values }
        })
        .filter(|number| number.values.iter().any(Option::is_some))
        .collect()
}

fn number(summary: &Map<String, Value>, path: &[String]) -> Option<f64> {
    let (first, rest) = path.split_first()?;
    rest.iter().try_fold(summary.get(first)?, |value, key| value.get(key))?.as_f64()
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn what_some_grid_has_is_found_with_its_unit_and_gaps_stay_gaps() {
        let one = json!({ "wall_pressure_peak": 2e8, "collapse_time": null, "steps": 7,
                          "sensors": { "disc": { "impulse": 3.0, "radius": 1.0 } } });
        let two =
            json!({ "wall_pressure_peak": 3e8, "pit_depth": 1e-6, "von_mises_peak_position": [0.0, 1.0] });
        let found = of_summaries(&[one.as_object(), None, two.as_object()], Geometry::Axisymmetric);
        let expected = [
            ("wall_pressure_peak", "Pa", [Some(2e8), None, Some(3e8)]),
            ("pit_depth", "m", [None, None, Some(1e-6)]),
            ("sensors.disc.impulse", "N s", [Some(3.0), None, None]),
        ];
        let expected: Vec<KeyNumber> = expected
            .into_iter()
            .map(|(name, unit, values)| KeyNumber { name: name.to_owned(), unit, values: values.to_vec() })
            .collect();
        assert_eq!(found, expected);
        assert!(of_summaries(&[None, None], Geometry::Axisymmetric).is_empty());
        let planar = of_summaries(&[one.as_object(), two.as_object()], Geometry::Planar);
        let units: Vec<&str> = planar.iter().map(|number| number.unit).collect();
        assert_eq!(units, ["Pa", "m", "N s/m"], "per metre of depth");
    }

    #[test]
    fn no_number_is_listed_twice() {
        let names: BTreeSet<_> = KEY_NUMBERS.iter().map(|(name, _)| name).collect();
        assert_eq!(names.len(), KEY_NUMBERS.len());
    }
}
