//! The pressure on the wall of a finished run, to be put on a solid alone.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use hdf5::File;
use ndarray::Array2;
use serde_json::Value;

use crate::output::run_directory::{CASE, HISTORY, SUMMARY};
use crate::output::{dataset_if_there, summary};

/// `[coupling.load] run = "DIR"`: the pressure that the wall got there, over r and t.
///
/// Between two rows of `/interface` it is a parabola through the pressures of both rows whose mean is what the impulse says, limited
/// as in the piecewise parabolic method (Colella and Woodward, J. Comput. Phys. 54, 174, 1984). A step gets the mean over it: no
/// impulse is lost however far apart the rows are, and however long the steps. After the last row it stays.
#[derive(Clone, Debug)]
pub struct RecordedLoad {
    run: PathBuf,
    is_whole: bool,
    record: Arc<Record>,
}

/// Runs that repeat the load of another one more often than this do so in a circle.
const MOST_REPETITIONS: usize = 100;

/// What was read; shared by the copies of a case.
#[derive(Debug)]
struct Record {
    /// Pressure far away before anything happened, Pa.
    ambient: f64,
    /// Outer radii of the cells, m.
    edges: Vec<f64>,
    /// Times of the rows, s.
    times: Vec<f64>,
    /// The pressure at the first row, Pa.
    initial: Vec<f64>,
    /// In the intervals between rows: intervals × cells.
    parabolas: Array2<Parabola>,
}

/// The pressure in an interval, Pa.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Parabola {
    begin: f64,
    end: f64,
    mean: f64,
}

impl Parabola {
    /// Of a mean and the values at both ends. They are kept between this mean and that of the interval beside; where the mean lies
    /// between them, one is changed until all in between does, too (Colella and Woodward's eq. 1.10).
    fn limited(mean: f64, [before, after]: [f64; 2], [begin, end]: [f64; 2]) -> Self {
        let between = |value: f64, beside: f64| value.max(mean.min(beside)).min(mean.max(beside));
        let (begin, end) = (between(begin, before), between(end, after));
        if (end - mean) * (mean - begin) <= 0.0 {
            return Self { begin, end, mean };
        }
        let rise = end - begin;
        let bend = rise * (mean - 0.5 * (begin + end));
        let bound = rise * rise / 6.0;
        if bend > bound {
            Self { begin: 3.0 * mean - 2.0 * end, end, mean }
        } else if bend < -bound {
            Self { begin, end: 3.0 * mean - 2.0 * begin, mean }
        } else {
            Self { begin, end, mean }
        }
    }

    /// The mean between two shares of the interval.
    fn between(&self, low: f64, high: f64) -> f64 {
        if low >= 1.0 {
            return self.end;
        }
        let curve = 6.0 * self.mean - 3.0 * (self.begin + self.end);
        let slope = self.end - self.begin + curve;
        self.begin + 0.5 * slope * (low + high) - curve / 3.0 * (low * low + low * high + high * high)
    }
}

/// The same run.
impl PartialEq for RecordedLoad {
    fn eq(&self, other: &Self) -> bool {
        let [own, other_record] = [&self.record, &other.record];
        self.run == other.run && own.times == other_record.times && own.parabolas == other_record.parabolas
    }
}

impl RecordedLoad {
    /// Reads what the wall got in a run.
    ///
    /// # Errors
    /// In words: there is no such run, or it had no wall.
    pub fn read(run: &Path) -> Result<Self, String> {
        let path = run.join(HISTORY);
        if !path.is_file() {
            return Err(format!(
                "there is no {HISTORY} in {}: not the directory of a finished run{}",
                run.display(),
                from_where(run)
            ));
        }
        let ambient = ambient_of(run)?;
        let file =
            File::open(&path).map_err(|error| format!("{} cannot be read: {error}", path.display()))?;
        let record = Record::read(&file, ambient)
            .ok_or_else(|| format!("{} has no pressure on a wall", path.display()))?;
        // What goes on, or was broken off, says that it is not complete.
        let summary = summary::read(&run.join(SUMMARY)).unwrap_or_default();
        let is_whole = summary.get("completed") != Some(&Value::Bool(false));
        Ok(Self { run: run.to_path_buf(), is_whole, record: Arc::new(record) })
    }

    /// The run's directory.
    pub fn run(&self) -> &Path {
        &self.run
    }

    /// Pressure far away before anything happened, Pa.
    pub fn ambient(&self) -> f64 {
        self.record.ambient
    }

    /// Whether the run had reached its end when it was read.
    pub fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// When the record ends, s.
    pub fn end(&self) -> f64 {
        self.record.times[self.record.times.len() - 1]
    }

    /// The largest difference from the ambient pressure, Pa.
    pub fn largest(&self) -> f64 {
        let Record { ambient, initial, parabolas, .. } = &*self.record;
        let values = parabolas.iter().flat_map(|parabola| [parabola.begin, parabola.mean, parabola.end]);
        values.chain(initial.iter().copied()).fold(0.0, |most: f64, p| most.max((p - ambient).abs()))
    }

    /// All that it is made of: what makes it another one.
    pub fn numbers(&self) -> impl Iterator<Item = f64> {
        let Record { ambient, edges, times, initial, parabolas } = &*self.record;
        let values = parabolas.iter().flat_map(|&Parabola { begin, end, mean }| [begin, end, mean]);
        let lists = [edges, times, initial].into_iter().flatten().copied();
        std::iter::once(*ambient).chain(lists).chain(values)
    }

    /// Outer radii of the cells that the pressure is given on, ascending, m.
    pub fn edges(&self) -> &[f64] {
        &self.record.edges
    }

    /// The pressure at t = 0 at a radius (m), Pa.
    pub fn at_start(&self) -> impl Fn(f64) -> f64 + Sync + use<> {
        let record = Arc::clone(&self.record);
        move |r| {
            let cell = record.edges.partition_point(|edge| *edge < r);
            record.initial.get(cell).copied().unwrap_or(record.ambient)
        }
    }

    /// What has been gained at a radius (m) since t = 0 by the mean from `begin` on for `length` > 0 (s), Pa: linear between the middles of
    /// cells.
    pub fn gained_at(&self, radius: f64, begin: f64, length: f64) -> f64 {
        let Record { edges, parabolas, initial, .. } = &*self.record;
        let cells = edges.len();
        let width = if cells > 1 { edges[1] - edges[0] } else { edges[0] };
        let place = ((radius - edges[0]) / width + 0.5).clamp(0.0, cells as f64);
        let gained = |cell: usize| {
            if cell >= cells {
                return 0.0;
            }
            let parts = self.parts(begin, length);
            let mean: f64 =
                parts.map(|(k, [low, high], share)| share * parabolas[[k, cell]].between(low, high)).sum();
            mean - initial[cell]
        };
        let (cell, share) = (place.floor() as usize, place.fract());
        let first = gained(cell);
        if share > 0.0 { first + share * (gained(cell + 1) - first) } else { first }
    }

    /// The mean of the pressure in each cell from `begin` on for `length` > 0 (s), Pa.
    ///
    /// - `means`: takes them; cleared first.
    pub fn mean(&self, begin: f64, length: f64, means: &mut Vec<f64>) {
        let Record { parabolas, initial, .. } = &*self.record;
        means.clear();
        means.resize(initial.len(), 0.0);
        for (k, [low, high], share) in self.parts(begin, length) {
            means
                .iter_mut()
                .zip(parabolas.row(k))
                .for_each(|(mean, parabola)| *mean += share * parabola.between(low, high));
        }
    }

    /// What a stretch of time has of the intervals between rows: an interval, the part of it by its shares, and what that is of the
    /// stretch. After the last row the end of the last interval stays.
    fn parts(&self, begin: f64, length: f64) -> impl Iterator<Item = (usize, [f64; 2], f64)> {
        let Record { times, parabolas, .. } = &*self.record;
        let last = parabolas.nrows() - 1;
        let first = times.partition_point(|time| *time <= begin).saturating_sub(1).min(last);
        let part = move |k: usize| {
            let width = times[k + 1] - times[k];
            let low = ((begin - times[k]) / width).clamp(0.0, 1.0);
            let high = ((begin + length - times[k]) / width).clamp(0.0, 1.0);
            (k, [low, high], (high - low) * width / length)
        };
        let beyond = ((begin + length - times[last + 1]) / length).clamp(0.0, 1.0);
        (first..=last)
            .map(part)
            .take_while(move |(k, [_, high], _)| *k == first || *high > 0.0)
            .chain((beyond > 0.0).then_some((last, [1.0, 1.0], beyond)))
    }
}

impl Record {
    fn read(file: &File, ambient: f64) -> Option<Self> {
        let named = |name: &str| dataset_if_there(file, &format!("interface/{name}"));
        let ends: Vec<f64> = named("time")?.read_raw().ok()?;
        let centres: Vec<f64> = named("r")?.read_raw().ok()?;
        let pressure: Array2<f64> = named("pressure")?.read_2d().ok()?;
        let impulse: Array2<f64> = named("impulse")?.read_2d().ok()?;
        let (first, cells) = (centres.first()?, centres.len());
        if pressure.dim() != (ends.len(), cells) || impulse.dim() != pressure.dim() || ends.len() < 2 {
            return None;
        }
        let width = if cells > 1 { centres[1] - first } else { 2.0 * first };
        let edges = centres.iter().map(|centre| centre + 0.5 * width).collect();

        // Rows at other times than the one before.
        let mut rows = vec![0];
        (1..ends.len()).for_each(|k| rows.extend((ends[k] > ends[rows[rows.len() - 1]]).then_some(k)));
        let times: Vec<f64> = rows.iter().map(|row| ends[*row]).collect();
        let initial = pressure.row(0).to_vec();
        let mean = |k: usize, c: usize| {
            let gained = impulse[[rows[k + 1], c]] - impulse[[rows[k], c]];
            initial[c] + gained / (times[k + 1] - times[k])
        };
        let last = rows.len().checked_sub(2)?;
        let parabolas = Array2::from_shape_fn((last + 1, cells), |(k, c)| {
            let ends = [pressure[[rows[k], c]], pressure[[rows[k + 1], c]]];
            // It begins with what is there; of how the last interval ends no other one tells.
            let before = if k == 0 { initial[c] } else { mean(k - 1, c) };
            Parabola::limited(mean(k, c), [before, mean((k + 1).min(last), c)], ends)
        });
        let record = Self { ambient, edges, times, initial, parabolas };
        let is_finite = |Parabola { begin, end, mean }: &Parabola| (begin + end + mean).is_finite();
        (record.times.iter().all(|time| time.is_finite()) && record.parabolas.iter().all(is_finite))
            .then_some(record)
    }
}

/// What a path is relative to, in words for an error; nothing of one that is not.
pub fn from_where(path: &Path) -> String {
    match std::env::current_dir() {
        Ok(here) if path.is_relative() => {
            format!(" (the path counts from the working directory, {})", here.display())
        }
        _ => String::new(),
    }
}

/// The ambient pressure of a run's fluid by its effective case, which says everything, Pa; 0 where it had none and repeated no other run.
fn ambient_of(run: &Path) -> Result<f64, String> {
    let mut run = run.to_path_buf();
    for _ in 0..MOST_REPETITIONS {
        let path = run.join(CASE);
        let text = fs::read_to_string(&path)
            .map_err(|error| format!("{} cannot be read: {error}", path.display()))?;
        let case: toml::Table =
            toml::from_str(&text).map_err(|error| format!("{} is no case: {error}", path.display()))?;
        let inner = |keys: [&str; 3]| case.get(keys[0])?.get(keys[1])?.get(keys[2]);
        if let Some(pressure) = inner(["fluid", "ambient", "pressure"]).and_then(toml::Value::as_float) {
            return Ok(pressure);
        }
        let Some(earlier) = inner(["coupling", "load", "run"]).and_then(toml::Value::as_str) else {
            return Ok(0.0);
        };
        run = PathBuf::from(earlier);
    }
    Err(format!("runs repeat each other's loads, {} among them, and none of them had a fluid", run.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn recorded(times: &[f64], initial: f64, parabolas: &[[f64; 3]]) -> RecordedLoad {
        let parabolas = parabolas.iter().map(|&[begin, mean, end]| Parabola { begin, end, mean }).collect();
        let shape = (times.len() - 1, 1);
        let record = Record {
            ambient: 1.0,
            edges: vec![1.0],
            times: times.to_vec(),
            initial: vec![initial],
            parabolas: Array2::from_shape_vec(shape, parabolas).expect("one cell"),
        };
        RecordedLoad { run: PathBuf::new(), is_whole: true, record: Arc::new(record) }
    }

    #[test]
    fn steps_get_all_of_the_impulse_however_they_lie() {
        let load = recorded(&[0.0, 1.0, 1.5, 4.0], 1.0, &[[1.0, 3.0, 7.0], [7.0, 8.0, 5.0], [5.0, 2.0, 2.0]]);
        let (mut time, mut impulse, mut means) = (0.0, 0.0, vec![]);
        for length in [0.3, 0.1, 0.9, 0.01, 2.0, 0.19, 0.5, 1.0] {
            load.mean(time, length, &mut means);
            (time, impulse) = (time + length, impulse + length * means[0]);
        }
        // The last pressure stays from 4 to 5.
        approx::assert_relative_eq!(time, 5.0, max_relative = 1e-14);
        approx::assert_relative_eq!(impulse, 3.0 + 0.5 * 8.0 + 2.5 * 2.0 + 2.0, max_relative = 1e-14);
        load.mean(1.0 - 1e-9, 1e-9, &mut means);
        approx::assert_relative_eq!(means[0], 7.0, max_relative = 1e-7);
    }

    #[test]
    fn parabolas_stay_between_what_is_beside_them() {
        // Of a curve that rises smoothly they are the curve.
        let smooth = Parabola::limited(1.0 / 3.0, [-0.5, 4.0], [0.0, 1.0]);
        assert_eq!(smooth, Parabola { begin: 0.0, end: 1.0, mean: 1.0 / 3.0 });
        approx::assert_relative_eq!(smooth.between(0.0, 0.5), 0.25 / 3.0, max_relative = 1e-14);
        // A jump at the end of an interval does not draw what is before it below zero.
        let before = Parabola::limited(1.0, [0.0, 1000.0], [0.5, 1000.0]);
        let values = (0..100).map(|k| before.between(f64::from(k) / 100.0, f64::from(k + 1) / 100.0));
        assert!(values.clone().all(|value| (0.5..=2.0).contains(&value)), "{:?}", values.collect::<Vec<_>>());
        // A pulse within one interval keeps its impulse and pulls nowhere.
        let pulse = Parabola::limited(10.0, [0.0, 0.0], [-3.0, 0.0]);
        assert_eq!(pulse, Parabola { begin: 0.0, end: 0.0, mean: 10.0 });
        assert!((pulse.between(0.49, 0.51) - 15.0).abs() < 0.1);
    }
}
