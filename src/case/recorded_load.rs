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
/// Between two rows of `/interface` it is the mean that the impulse says, so that no impulse is lost however far apart they are;
/// linear between the middles of those intervals. After the last one it stays.
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
    /// Times of the rows, s: 0, then the middles of the intervals.
    times: Vec<f64>,
    /// When the last interval ends, s.
    end: f64,
    /// Pa.
    pressure: Array2<f64>,
}

/// The same run.
impl PartialEq for RecordedLoad {
    fn eq(&self, other: &Self) -> bool {
        self.run == other.run && self.record.pressure == other.record.pressure
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
        self.record.end
    }

    /// The largest difference from the ambient pressure, Pa.
    pub fn largest(&self) -> f64 {
        self.record.pressure.iter().fold(0.0, |most: f64, p| most.max((p - self.record.ambient).abs()))
    }

    /// All that it is made of: what makes it another one.
    pub fn numbers(&self) -> impl Iterator<Item = f64> {
        let Record { ambient, edges, times, end, pressure } = &*self.record;
        [*ambient, *end]
            .into_iter()
            .chain(edges.iter().copied())
            .chain(times.iter().copied())
            .chain(pressure.iter().copied())
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
            record.pressure.get([0, cell]).copied().unwrap_or(record.ambient)
        }
    }

    /// The pressure in the cells at a time, Pa.
    pub fn at(&self, time: f64, mut put: impl FnMut(usize, f64)) {
        let Record { times, pressure, .. } = &*self.record;
        let after = times.partition_point(|own| *own <= time);
        let (low, high) = (after.saturating_sub(1), after.min(times.len() - 1));
        let share = if low == high { 0.0 } else { (time - times[low]) / (times[high] - times[low]) };
        for (cell, (before, after)) in pressure.row(low).iter().zip(pressure.row(high)).enumerate() {
            put(cell, before + share * (after - before));
        }
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

        let initial = pressure.row(0).to_owned();
        let (mut times, mut rows) = (vec![ends[0]], initial.to_vec());
        let mut last = 0;
        for k in 1..ends.len() {
            let dt = ends[k] - ends[last];
            if !(dt > 0.0) {
                continue;
            }
            times.push(0.5 * (ends[last] + ends[k]));
            rows.extend((0..cells).map(|c| initial[c] + (impulse[[k, c]] - impulse[[last, c]]) / dt));
            last = k;
        }
        let pressure = Array2::from_shape_vec((times.len(), cells), rows).ok()?;
        let is_finite = pressure.iter().chain(&times).all(|value| value.is_finite());
        (last > 0 && is_finite).then_some(Self { ambient, edges, end: ends[last], times, pressure })
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
