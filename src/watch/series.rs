//! The rows of one history that have come since the last look.

use std::fs;
use std::os::unix::fs::MetadataExt;
use std::path::Path;

use hdf5::File;

use crate::watch::curve::Curve;

/// One series of a history file: some datasets over the time of theirs.
///
/// The file is opened for reading and closed at once. Its writer never opens it again for writing but makes a new one that takes its
/// name, so a reader has the old one or the new one, whole, and neither waits for the other.
#[derive(Debug)]
pub struct Series {
    file: &'static str,
    time: &'static str,
    columns: Vec<Column>,
    /// Of what is there: identity, length and age of the file.
    version: Option<[i128; 3]>,
    /// Rows that have been read.
    rows: usize,
    /// Time of the last of them, s.
    last_time: f64,
    /// From the one before to the last, s.
    last_step: f64,
}

/// A dataset.
#[derive(Debug)]
struct Column {
    path: &'static str,
    /// Whether the file has it.
    is_there: bool,
    curve: Curve,
}

impl Series {
    /// These datasets of a file of the run directory, over the times in another one.
    #[must_use]
    pub fn new(file: &'static str, time: &'static str, columns: &[&'static str]) -> Self {
        let column = |path: &&'static str| Column { path, is_there: false, curve: Curve::default() };
        let columns = columns.iter().map(column).collect();
        Self { file, time, columns, version: None, rows: 0, last_time: 0.0, last_step: 0.0 }
    }

    /// Reads what is new.
    ///
    /// - errors: in words; what was read before stays. That there is no file is none: a run has just begun, or has no such side.
    pub fn read(&mut self, directory: &Path) -> Result<(), String> {
        let path = directory.join(self.file);
        let Ok(file) = fs::metadata(&path) else {
            let paths: Vec<_> = self.columns.iter().map(|column| column.path).collect();
            *self = Self::new(self.file, self.time, &paths);
            return Ok(());
        };
        let modified = i128::from(file.mtime()) * 1_000_000_000 + i128::from(file.mtime_nsec());
        let version = [i128::from(file.ino()), i128::from(file.size()), modified];
        if self.version == Some(version) {
            return Ok(());
        }
        self.read_rows(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        self.version = Some(version);
        Ok(())
    }

    fn read_rows(&mut self, path: &Path) -> hdf5::Result<()> {
        let file = File::open(path)?;
        if !has(&file, self.time) {
            return Ok(());
        }
        let times = file.dataset(self.time)?;
        let rows = times.size();
        // A run that was taken up again has forgotten rows; in place of the run another one may have begun.
        let goes_on = self.rows == 0
            || rows >= self.rows
                && times.read_slice_1d::<f64, _>(self.rows - 1..self.rows)?.first() == Some(&self.last_time);
        if !goes_on {
            self.rows = 0;
            self.columns.iter_mut().for_each(|column| column.curve = Curve::default());
        }
        let new = times.read_slice_1d::<f64, _>(self.rows..rows)?;
        for column in &mut self.columns {
            column.is_there = has(&file, column.path);
            if column.is_there {
                let values = file.dataset(column.path)?.read_slice_1d::<f64, _>(self.rows..rows)?;
                new.iter().zip(&values).for_each(|(time, value)| column.curve.push(*time, *value));
            }
        }
        for time in &new {
            (self.last_step, self.last_time) =
                (if self.rows == 0 { 0.0 } else { time - self.last_time }, *time);
            self.rows += 1;
        }
        Ok(())
    }

    /// Rows so far.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Time of the last row, s.
    #[must_use]
    pub fn last_time(&self) -> f64 {
        self.last_time
    }

    /// Time from the last row but one to the last, s.
    #[must_use]
    pub fn last_step(&self) -> f64 {
        self.last_step
    }

    /// The curve of a dataset, if the file has it.
    #[must_use]
    pub fn curve(&self, path: &str) -> Option<&Curve> {
        self.columns.iter().find(|column| column.path == path && column.is_there).map(|column| &column.curve)
    }
}

/// Whether a file has a dataset; asked group by group, as the library complains about one in a group that is not there.
fn has(file: &File, path: &str) -> bool {
    let ends = path.match_indices('/').map(|(at, _)| at).skip(1).chain([path.len()]);
    ends.into_iter().all(|end| file.link_exists(&path[..end]))
}
