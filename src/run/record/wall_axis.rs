//! The wall pressure on the axis, beyond its peak in one step: its largest mean over a while, and its impulse.
//!
//! All are of p* on the wall's face at the axis, which is known as the mean over each step: sums over all steps, whatever is written.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::run::record::load_impulse::LoadImpulse;
use crate::run::record::running_mean::RunningMean;

/// What of it changes in time, and the pressure at t = 0.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct WallAxis {
    /// Over how long the mean is taken, s; `None` where there is none.
    window: Option<f64>,
    /// Pressure at t = 0, Pa.
    initial: f64,
    /// Pressure far away, Pa.
    ambient: f64,
    /// Of the pressure beyond the initial one.
    mean: RunningMean,
    /// Largest mean over the whole while so far, Pa, and at its end, s.
    mean_peak: Option<[f64; 2]>,
    /// Largest impulse so far, Pa s, and when, s; 0 at t = 0.
    impulse_peak: [f64; 2],
    load: LoadImpulse,
}

impl WallAxis {
    /// Of a wall with this pressure on the axis at t = 0, and that far away.
    pub fn new(window: Option<f64>, pressure: Option<f64>, ambient: f64) -> Self {
        Self { window, initial: pressure.unwrap_or(0.0), ambient, ..Self::default() }
    }

    /// Forgets the load so far: a bubble that grows pushes on the wall before its collapse does.
    pub fn forget_load(&mut self) {
        self.load = LoadImpulse::default();
    }

    /// Takes notice of a step of length `dt` that ended at `time` with this mean pressure on the axis.
    pub fn after_step(&mut self, pressure: Option<f64>, (time, dt): (f64, f64)) {
        let Some(pressure) = pressure.filter(|_| dt > 0.0) else { return };
        let mean = self.mean.push(self.window.unwrap_or(0.0), dt, pressure - self.initial);
        // Before the while is full there is no mean over it.
        let is_full = self.window.is_some_and(|window| self.mean.time() >= window);
        let value = self.initial + mean;
        if is_full && self.mean_peak.is_none_or(|[peak, _]| value > peak) {
            self.mean_peak = Some([value, time]);
        }
        if self.mean.integral() > self.impulse_peak[0] {
            self.impulse_peak = [self.mean.integral(), time];
        }
        self.load.after_step(pressure - self.ambient, (time, dt));
    }

    /// Its part of the summary.
    pub fn summary(&self) -> Map<String, Value> {
        let mut part = Map::new();
        if let Some(window) = self.window {
            let [peak, time] = self.mean_peak.map_or([None; 2], |[peak, time]| [Some(peak), Some(time)]);
            part.insert("wall_pressure_mean_time".to_owned(), json!(window));
            part.insert("wall_pressure_mean_peak".to_owned(), json!(peak));
            part.insert("wall_pressure_mean_peak_time".to_owned(), json!(time));
        }
        part.insert("wall_impulse".to_owned(), json!(self.impulse_peak[0]));
        part.insert("wall_impulse_time".to_owned(), json!(self.impulse_peak[1]));
        let [impulse, time] = self.load.peak();
        part.insert("load_impulse".to_owned(), json!(impulse));
        part.insert("load_impulse_time".to_owned(), json!(time));
        part
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The wall's numbers after steps of these lengths with these pressures.
    fn after(window: Option<f64>, steps: &[[f64; 2]]) -> Map<String, Value> {
        let mut axis = WallAxis::new(window, Some(1.0), 2.5);
        let mut time = 0.0;
        for [dt, pressure] in steps {
            time += dt;
            axis.after_step(Some(*pressure), (time, *dt));
        }
        axis.summary()
    }

    #[test]
    fn a_mean_counts_once_there_has_been_time_for_it_and_an_impulse_from_the_start() {
        let steps = [[0.5, 8.0], [0.5, 3.0], [1.0, 4.0], [0.5, 0.0]];
        let found = after(Some(1.0), &steps);
        let number = |key: &str| found[key].as_f64().unwrap_or(f64::NAN);
        // 8 over the first half is no mean over the whole of 1.
        assert!(
            (number("wall_pressure_mean_peak") - 5.5).abs() < 1e-14
                && number("wall_pressure_mean_peak_time") == 1.0
        );
        assert!(
            (number("wall_impulse") - (3.5 + 1.0 + 3.0)).abs() < 1e-14 && number("wall_impulse_time") == 2.0
        );
        assert_eq!(number("wall_pressure_mean_time"), 1.0);
        // Beyond 2.5.
        assert_eq!([number("load_impulse"), number("load_impulse_time")], [2.75 + 0.25 + 1.5, 2.0]);
        // A while that is longer than the run, and none.
        assert_eq!(after(Some(9.0), &steps)["wall_pressure_mean_peak"], Value::Null);
        let without = after(None, &steps);
        assert!(
            !without.contains_key("wall_pressure_mean_peak")
                && without["wall_impulse"] == found["wall_impulse"]
        );
    }

    #[test]
    fn a_load_is_what_the_pressure_far_away_is_passed_by() {
        // It begins below that, is hit, and ends at it: however long that lasts.
        let steps = [[3.0, 1.0], [0.5, 7.5], [0.5, 3.5], [1.0, 1.5], [100.0, 2.5]];
        let found = after(None, &steps);
        assert_eq!([&found["load_impulse"], &found["load_impulse_time"]], [&json!(3.0), &json!(4.0)]);
        assert!(found["wall_impulse"].as_f64().is_some_and(|beyond_the_first| beyond_the_first > 150.0));
        let mut axis = WallAxis::new(None, Some(1.0), 2.5);
        axis.after_step(Some(9.0), (1.0, 1.0));
        axis.forget_load();
        axis.after_step(Some(3.5), (2.0, 1.0));
        assert_eq!(axis.summary()["load_impulse"], json!(1.0));
    }

    #[test]
    fn steps_of_any_length_have_the_same_mean_and_impulse() {
        let coarse = after(Some(0.75), &[[1.0, 3.0], [0.5, 7.0], [0.5, 2.0]]);
        let steps: Vec<[f64; 2]> =
            [(8, 3.0), (4, 7.0), (4, 2.0)].iter().flat_map(|(n, p)| vec![[0.125, *p]; *n]).collect();
        let fine = after(Some(0.75), &steps);
        for key in
            ["wall_pressure_mean_peak", "wall_pressure_mean_peak_time", "wall_impulse", "wall_impulse_time"]
        {
            assert_eq!(coarse[key], fine[key], "{key}");
        }
        assert_eq!(fine["wall_impulse"], json!(5.5));
    }
}
