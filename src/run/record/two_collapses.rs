//! The rebound of a bubble, its second collapse, and the loads of either on the wall, from the histories of a run.

use std::path::Path;

use hdf5::File;
use ndarray::Array2;
use serde_json::{Map, Value, json};

use crate::output::dataset_if_there;
use crate::run::record::load_impulse::LoadImpulse;

/// What a turn of the volume must be followed by to count, as a share of it: less is ringing.
const TURN: f64 = 0.01;

/// What follows the first collapse, by the rows of the history of the gas volume.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Turns {
    /// The largest volume after it.
    rebound: Option<usize>,
    /// The smallest one after that.
    second: Option<usize>,
}

impl Turns {
    /// A turn counts once the volume has come back from it by [`TURN`] of its size.
    ///
    /// - `volumes`: of the whole run; `collapse`: the row of the first collapse.
    fn after(collapse: usize, volumes: &[f64]) -> Self {
        let mut turns = Self::default();
        let mut extreme = collapse;
        for (row, &volume) in volumes.iter().enumerate().skip(collapse) {
            if turns.rebound.is_none() {
                if volume > volumes[extreme] {
                    extreme = row;
                }
                if volume < (1.0 - TURN) * volumes[extreme] {
                    (turns.rebound, extreme) = (Some(extreme), row);
                }
            } else {
                if volume < volumes[extreme] {
                    extreme = row;
                }
                if volume > (1.0 + TURN) * volumes[extreme] {
                    turns.second = Some(extreme);
                    break;
                }
            }
        }
        turns
    }
}

/// The part of the summary that is about the bubble's size at the start and, for a run with a collapse, the rebound and the second
/// collapse; empty for a run without a bubble.
///
/// - `collapse_time`: of the first collapse, s. `far`: the pressure far away, Pa.
pub fn summary(history: &Path, collapse_time: Option<f64>, far: f64) -> Map<String, Value> {
    let Ok(file) = File::open(history) else { return Map::new() };
    let mut part = collapse_time.and_then(|time| of_file(&file, time, far)).unwrap_or_default();
    if let Some(radius) = first_radius(&file) {
        part.insert("initial_equivalent_radius".to_owned(), json!(radius));
    }
    part
}

/// The equivalent radius of the gas at the start, m, if there is gas.
fn first_radius(file: &File) -> Option<f64> {
    let radii = dataset_if_there(file, "bubble/equivalent_radius")?;
    if radii.size() == 0 {
        return None;
    }
    let first = radii.read_slice_1d::<f64, _>(0..1).ok()?;
    first.first().copied().filter(|radius| *radius > 0.0)
}

fn of_file(file: &File, collapse_time: f64, far: f64) -> Option<Map<String, Value>> {
    let rows = |name: &str| -> Option<Vec<f64>> { dataset_if_there(file, name)?.read_raw().ok() };
    let (times, volumes, radii) = (rows("time")?, rows("bubble/volume")?, rows("bubble/equivalent_radius")?);
    if times.len() != volumes.len() || radii.len() != volumes.len() {
        return None;
    }
    let collapse = times.partition_point(|time| *time < collapse_time);
    let turns = Turns::after(collapse, &volumes);
    let mut part = Map::new();
    let mut put = |key: &str, value: Option<f64>| part.insert(key.to_owned(), json!(value));
    put("rebound_time", turns.rebound.map(|row| times[row]));
    put("rebound_equivalent_radius", turns.rebound.map(|row| radii[row]));
    put("second_collapse_time", turns.second.map(|row| times[row]));
    put("second_min_equivalent_radius", turns.second.map(|row| radii[row]));

    // What comes before the rebound is at its largest is of the first collapse, what comes after of the second.
    let split = turns.rebound.map(|row| times[row]);
    if let (Some(ends), Some(pressure)) = (rows("interface/time"), rows("wall/pressure_axis")) {
        let field = |name: &str| -> Option<Array2<f64>> { dataset_if_there(file, name)?.read_2d().ok() };
        let (impulse, pressures) = (field("interface/impulse")?, field("interface/pressure")?);
        let before = |time: f64| split.is_none_or(|split| time <= split);
        let peak = |of_first: bool| {
            let own = times.iter().zip(&pressure).filter(|(time, _)| before(**time) == of_first);
            own.map(|(_, pressure)| *pressure).reduce(f64::max)
        };
        // Fewer rows tell of neither.
        let is_told = ends.len() >= FEWEST_ROWS;
        let axis = rows("interface/r").map_or(0, |r| on_axis(&r));
        let at = |row: Option<usize>| impulse.get([row?, axis]).copied();
        let last_of_first = ends.iter().rposition(|time| before(*time)).filter(|row| *row < impulse.nrows());
        let whole = at(impulse.nrows().checked_sub(1));
        let first = at(last_of_first);
        put("wall_pressure_peak_first", peak(true));
        put("wall_pressure_peak_second", split.and_then(|_| peak(false)));
        let first = first.filter(|_| is_told);
        put("wall_impulse_first", first);
        put("wall_impulse_second", split.and(whole.zip(first)).map(|(whole, first)| whole - first));

        // Beyond the pressure far away, since the bubble was at its largest.
        let beyond = pressures.get([0, axis]).map_or(0.0, |at_start| at_start - far);
        let load = ends.iter().zip(impulse.rows()).map(|(end, row)| [*end, row[axis] + beyond * end]);
        let load: Vec<[f64; 2]> = load.collect();
        let began = largest_before(collapse, &volumes).map_or(0.0, |row| times[row]);
        let rise = |of_first: bool| {
            is_told.then(|| largest_rise(&load, |time| time > began && before(time) == of_first))
        };
        put("load_impulse_first", rise(true));
        put("load_impulse_second", split.and_then(|_| rise(false)));
    }
    Some(part)
}

/// The row of the largest volume up to the collapse, the first one of equals.
fn largest_before(collapse: usize, volumes: &[f64]) -> Option<usize> {
    let rows = 0..volumes.len().min(collapse + 1);
    rows.reduce(|largest, row| if volumes[row] > volumes[largest] { row } else { largest })
}

/// The largest rise of an integral, see [`LoadImpulse`], in the intervals that end at some times.
///
/// - `integral`: times, s, with what has been gathered until then.
fn largest_rise(integral: &[[f64; 2]], is_in: impl Fn(f64) -> bool) -> f64 {
    let mut load = LoadImpulse::default();
    for pair in integral.windows(2) {
        let [[begin, before], [end, after]] = [pair[0], pair[1]];
        if end > begin && is_in(end) {
            load.after_step((after - before) / (end - begin), (end, end - begin));
        }
    }
    load.peak()[0]
}

/// Rows of `/interface` in a run that are enough to tell one impulse from the next.
const FEWEST_ROWS: usize = 10;

/// Which of these centres of cells of equal width is that of the cell with r = 0, or of the nearest to it.
fn on_axis(r: &[f64]) -> usize {
    // Of a cell that ends there the centre is half a width below it, but for round-off.
    let half = if let [first, second, ..] = r { 0.499_999 * (second - first) } else { 0.0 };
    r.partition_point(|r| *r < -half).min(r.len().saturating_sub(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::record::collapse::CollapseFinder;

    #[test]
    fn the_axis_is_where_r_is_zero() {
        for (r, expected) in [
            (&[0.5, 1.5][..], 0),
            (&[-1.5, -0.5, 0.5], 2),
            (&[-1.0, -1e-17, 1.0], 1),
            (&[-1.3, -0.3, 0.7], 1),
            (&[-2.0, -1.0], 1),
            (&[], 0),
        ] {
            assert_eq!(on_axis(r), expected, "{r:?}");
        }
    }

    #[test]
    fn turns_are_found_where_the_volume_comes_back_and_ringing_is_none() {
        // Falls to 0.1, rises to 0.6, falls to 0.2, rises; with a ringing of half a per cent.
        let volume = |t: f64| {
            let shape = match t {
                t if t < 1.0 => 1.0 - 0.9 * t,
                t if t < 2.0 => 0.1 + 0.5 * (t - 1.0),
                t if t < 3.0 => 0.6 - 0.4 * (t - 2.0),
                _ => 0.2 + 0.1 * (t - 3.0),
            };
            shape * (1.0 + 0.004 * (700.0 * t).sin())
        };
        let volumes: Vec<f64> = (0..=400).map(|k| volume(f64::from(k) * 0.01)).collect();
        let mut finder = CollapseFinder::default();
        volumes.iter().enumerate().for_each(|(row, volume)| finder.push(row as f64, *volume));
        let first = finder.found().map(|collapse| collapse.time.ceil() as usize);
        let turns = Turns::after(first.unwrap_or_default(), &volumes);
        for (found, expected) in [(first, 100), (turns.rebound, 200), (turns.second, 300)] {
            assert!(found.is_some_and(|row| row.abs_diff(expected) <= 2), "{turns:?}");
        }
        assert_eq!(
            Turns::after(100, &volumes[..105]).rebound,
            None,
            "nothing is said of what has not come yet"
        );
        assert_eq!(Turns::after(100, &volumes[..250]).second, None);
        assert_eq!(Turns::after(1, &[1.0, 0.6, 1.0]), Turns::default(), "nor of a rise that goes on");
        assert_eq!(Turns::after(0, &[]), Turns::default());
        assert!(summary(Path::new("nowhere"), None, 0.0).is_empty(), "no collapse");
    }

    #[test]
    fn loads_are_rises_of_what_is_beyond_the_pressure_far_away() {
        // Grows until row 2, pulls, pushes by 5, is let go, pushes by 3 after the rebound.
        let gathered = [0.0, 4.0, 5.0, 3.0, 8.0, 7.0, 6.0, 9.0, 8.0];
        let integral: Vec<[f64; 2]> = gathered.iter().enumerate().map(|(k, sum)| [k as f64, *sum]).collect();
        let volumes = [0.1, 0.8, 1.0, 0.6, 0.1, 0.5, 0.6, 0.2, 0.3];
        assert_eq!(largest_before(4, &volumes), Some(2));
        assert_eq!(largest_before(9, &volumes[..2]), Some(1));
        assert_eq!(largest_before(0, &[]), None);
        let near =
            |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        near(largest_rise(&integral, |time| time <= 6.0), 8.0);
        near(largest_rise(&integral, |time| time > 2.0 && time <= 6.0), 5.0);
        near(largest_rise(&integral, |time| time > 6.0), 3.0);
        near(largest_rise(&integral[..1], |_| true), 0.0);
    }
}
