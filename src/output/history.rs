//! Named series over time, buffered in memory and written in batches: `fluid.h5` and `solid.h5`.

mod series;

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use hdf5::File;

use super::hdf5_attributes::{set_texts, text};
use super::{OutputError, hdf5_memory, per_depth, safe_file};
use series::{CHUNK_VALUES, OwnedColumn, Series, absolute, describe, make_parents};

/// Shortest time between two batches that [`HistoryFile::flush_if_due`] writes.
const FLUSH_INTERVAL: Duration = Duration::from_secs(1);
/// Largest share of the wall time that [`HistoryFile::flush_if_due`] spends: the other threads have nothing to do meanwhile.
const FLUSH_SHARE: f64 = 0.005;
/// Rows that take this much memory, bytes, and this share of the file wait no longer for a batch than [`FLUSH_INTERVAL`]: a
/// batch copies the file, so that a share is what keeps the copies in proportion to what they add.
const LARGEST_BUFFER: u64 = 1 << 22;
const BUFFER_SHARE: u64 = 16;
/// Rows that take this much and that share do not even wait so long.
const MOST_BUFFERED: u64 = 1 << 24;
/// A batch of this length, bytes, has rows of all series in the proportion in which they come.
const TYPICAL_BATCH: u64 = 1 << 16;

/// One column of a series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Column<'a> {
    /// Name of the dataset within the group; a `/` in it makes a group.
    pub name: &'a str,
    /// SI unit, as `kg/m3`; `1` for a pure number.
    pub unit: &'a str,
    /// What it is, in a few words.
    pub description: &'a str,
    /// Values per row: 1 gives a dataset of shape (rows,), more gives (rows, width).
    pub width: usize,
}

/// A series of a [`HistoryFile`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SeriesId(usize);

/// A column with what of it is in memory.
#[derive(Debug, Clone, PartialEq)]
pub struct BufferedColumn<'a> {
    /// Path of the dataset.
    pub path: &'a str,
    /// SI unit.
    pub unit: &'a str,
    /// What it is.
    pub description: &'a str,
    /// Values per row.
    pub width: usize,
    /// The values, row after row.
    pub values: Vec<f64>,
}

/// A file of named series in time and of arrays that do not change.
///
/// Rows are buffered until [`flush`](Self::flush) or [`flush_if_due`](Self::flush_if_due) writes them. A batch goes
/// into a copy that is renamed over the file, so the file on disk always holds whole batches, and all series of a
/// batch together. Datasets are not compressed: compressed chunks would move with every batch and leave holes.
#[derive(Debug)]
pub struct HistoryFile {
    /// Whether it stays in memory; the buffers are then all there is, and the path is empty.
    in_memory: bool,
    /// Whether what is a whole or per radian is per metre of depth.
    is_planar: bool,
    path: PathBuf,
    series: Vec<Series>,
    arrays: Vec<StaticArray>,
    last_flush: Instant,
    last_cost: Duration,
    /// Length of the file after the last batch, bytes.
    length: u64,
    /// Whether anything changed since the last batch.
    pending: bool,
    /// Batches of at least [`TYPICAL_BATCH`]; the first gives the buffers their final size.
    typical_batches: u64,
}

#[derive(Debug)]
struct StaticArray {
    path: String,
    unit: String,
    description: String,
    values: Vec<f64>,
}

impl HistoryFile {
    /// Makes the file, empty but for `attributes` (name, value) of its root. An existing one is replaced.
    pub fn create(path: &Path, attributes: &[(&str, &str)]) -> Result<Self, OutputError> {
        hdf5_memory::keep_none();
        safe_file::replace_hdf5(path, safe_file::HDF5_OVERHEAD, |temporary| {
            let make = || -> hdf5::Result<()> {
                let file = File::create(temporary)?;
                set_texts(&file, attributes)?;
                file.close()
            };
            make().map_err(OutputError::hdf5(path, "create"))
        })?;
        Ok(Self::at(path))
    }

    /// Opens a file written before; [`add_series`](Self::add_series) then continues the series it finds there.
    pub fn open(path: &Path) -> Result<Self, OutputError> {
        hdf5_memory::keep_none();
        File::open(path).map_err(OutputError::hdf5(path, "open"))?;
        Ok(Self::at(path))
    }

    /// Series that stay in memory: nothing is written, [`columns`](Self::columns) has everything.
    pub fn in_memory() -> Self {
        Self { in_memory: true, ..Self::at(Path::new("")) }
    }

    /// The same of a planar run: units of what is a whole or per radian are per metre of depth.
    #[must_use]
    pub fn planar(self, is_planar: bool) -> Self {
        Self { is_planar, ..self }
    }

    /// Where the file is; `None` for one in memory.
    pub fn path(&self) -> Option<&Path> {
        (!self.in_memory).then_some(self.path.as_path())
    }

    /// All columns that are in memory, and the arrays that do not change: of a file in memory everything, of another
    /// one what the last batch has left.
    pub fn columns(&self) -> impl Iterator<Item = BufferedColumn<'_>> {
        let arrays = self.arrays.iter().map(|array| BufferedColumn {
            path: &array.path,
            unit: &array.unit,
            description: &array.description,
            width: 1,
            values: array.values.clone(),
        });
        arrays.chain(self.series.iter().flat_map(Series::buffered_columns))
    }

    fn at(path: &Path) -> Self {
        Self {
            in_memory: false,
            is_planar: false,
            path: path.to_path_buf(),
            series: Vec::new(),
            arrays: Vec::new(),
            last_flush: Instant::now(),
            last_cost: Duration::ZERO,
            length: 0,
            pending: false,
            typical_batches: 0,
        }
    }

    /// Adds the series whose rows are `columns` side by side, as datasets of `group` (`""` or `"/"` is the root).
    ///
    /// Where the datasets exist already (after [`open`](Self::open)), new rows follow those that are there.
    pub fn add_series(&mut self, group: &str, columns: &[Column<'_>]) -> Result<SeriesId, OutputError> {
        let columns: Vec<OwnedColumn> = columns
            .iter()
            .map(|column| OwnedColumn {
                path: absolute(group, column.name),
                unit: self.unit(column.unit).to_owned(),
                description: column.description.to_owned(),
                width: column.width,
            })
            .collect();
        let written = if self.in_memory { None } else { self.rows_on_file(&columns)? };
        self.pending = true;
        self.series.push(Series {
            group: absolute(group, ""),
            width: columns.iter().map(|column| column.width).sum(),
            columns,
            written: written.unwrap_or(0),
            created: written.is_some(),
            buffer: Vec::new(),
        });
        Ok(SeriesId(self.series.len() - 1))
    }

    /// Sets the array `path`, which does not change in time; it is written with the next batch.
    pub fn put(&mut self, path: &str, unit: &str, description: &str, values: &[f64]) {
        let unit = self.unit(unit).to_owned();
        self.pending = true;
        self.arrays.push(StaticArray {
            path: absolute("", path),
            unit,
            description: description.to_owned(),
            values: values.to_vec(),
        });
    }

    fn unit<'a>(&self, unit: &'a str) -> &'a str {
        if self.is_planar { per_depth(unit) } else { unit }
    }

    /// Adds one row: the values of all columns, one column after the other.
    pub fn push(&mut self, id: SeriesId, row: &[f64]) -> Result<(), OutputError> {
        let series = &mut self.series[id.0];
        if row.len() != series.width {
            return Err(OutputError::Length {
                path: self.path.clone(),
                what: format!("a row of the series in {}", series.group),
                found: row.len(),
                expected: series.width,
            });
        }
        series.buffer.extend_from_slice(row);
        self.pending = true;
        Ok(())
    }

    /// Rows of a series, in the file and in the buffer.
    pub fn rows(&self, id: SeriesId) -> usize {
        let series = &self.series[id.0];
        series.written + series.buffered_rows()
    }

    /// Rows of all series, in the order in which they were added.
    pub fn all_rows(&self) -> Vec<u64> {
        (0..self.series.len()).map(|number| self.rows(SeriesId(number)) as u64).collect()
    }

    /// Forgets what was added to any series since [`all_rows`](Self::all_rows) were these; the file follows with the next batch.
    ///
    /// - errors: there are other series, or fewer rows.
    pub fn truncate_all(&mut self, rows: &[u64]) -> Result<(), OutputError> {
        let found = self.all_rows();
        let are_there =
            found.len() == rows.len() && found.iter().zip(rows).all(|(found, wanted)| found >= wanted);
        if !are_there {
            let what = format!("its series have {found:?} rows where {rows:?} are looked for");
            return Err(OutputError::Mismatch { path: self.path.clone(), what });
        }
        for (number, rows) in rows.iter().enumerate() {
            self.truncate(SeriesId(number), *rows as usize);
        }
        Ok(())
    }

    /// Forgets the rows from `rows` on, as a restart from an earlier time needs; the file follows with the next batch.
    pub fn truncate(&mut self, id: SeriesId, rows: usize) {
        let series = &mut self.series[id.0];
        let kept = rows.saturating_sub(series.written);
        series.buffer.truncate(kept * series.width);
        series.written = series.written.min(rows);
        self.pending = true;
    }

    /// Whether a batch is due: a second after the last one at the earliest, and late enough that a batch that costs as
    /// much as the last one stays under 0.5 % of the wall time; at any cost when the rows fill their memory, 4 MiB or a
    /// sixteenth of the file, and for the first two batches of a run; at once when they fill 16 MiB or more.
    pub fn is_flush_due(&self) -> bool {
        let elapsed = self.last_flush.elapsed();
        let is_cheap = self.last_cost.as_secs_f64() < FLUSH_SHARE * elapsed.as_secs_f64();
        elapsed >= FLUSH_INTERVAL && (is_cheap || self.is_full() || self.is_beginning())
            || self.buffered() >= MOST_BUFFERED.max(self.length / BUFFER_SHARE)
    }

    /// Whether this is one of the run's first batches. The first gives the buffers their final size, the second makes the
    /// library read all that the first has written: a run holds at its beginning what it will hold.
    fn is_beginning(&self) -> bool {
        self.typical_batches < 2 && self.buffered() >= TYPICAL_BATCH
    }

    fn is_full(&self) -> bool {
        self.buffered() >= LARGEST_BUFFER.max(self.length / BUFFER_SHARE)
    }

    /// Memory of the rows that are not in the file yet, bytes.
    fn buffered(&self) -> u64 {
        self.series.iter().map(|series| (size_of::<f64>() * series.buffer.len()) as u64).sum()
    }

    /// Writes a batch if one is due; says whether it did.
    pub fn flush_if_due(&mut self) -> Result<bool, OutputError> {
        let due = !self.in_memory && self.is_flush_due();
        if due {
            self.flush()?;
        }
        Ok(due)
    }

    /// Writes everything that is buffered. After an error the buffer is as before, and the file too.
    pub fn flush(&mut self) -> Result<(), OutputError> {
        if !self.pending || self.in_memory {
            return Ok(());
        }
        let start = Instant::now();
        safe_file::update_hdf5(&self.path, self.room(), |copy| {
            // The library serves one thread at a time. As one turn the batch waits once for a thread that compresses
            // snapshots, not at each of its calls.
            hdf5::sync::sync(|| self.write_batch(copy))
                .map_err(OutputError::hdf5(&self.path, "write a batch to"))
        })?;
        let buffered = self.buffered();
        let is_typical = buffered >= TYPICAL_BATCH;
        for series in &mut self.series {
            series.written += series.buffered_rows();
            if is_typical && self.typical_batches == 0 {
                series.reserve(buffered);
            }
            series.buffer.clear();
            series.created = true;
        }
        self.typical_batches += u64::from(is_typical);
        self.arrays.clear();
        self.pending = false;
        self.last_flush = Instant::now();
        self.last_cost = start.elapsed();
        self.length = fs::metadata(&self.path).map_or(0, |file| file.len());
        tracing::debug!(seconds = self.last_cost.as_secs_f64(), "wrote a batch of histories");
        Ok(())
    }

    /// What a batch may take at most, bytes: numbers, and a chunk that is begun for each column.
    fn room(&self) -> u64 {
        let number = size_of::<f64>();
        let of_series = |series: &Series| {
            number * (series.buffer.len() + 2 * series.columns.len() * CHUNK_VALUES.max(series.width))
        };
        let arrays: usize = self.arrays.iter().map(|array| number * array.values.len()).sum();
        let numbers = arrays + self.series.iter().map(of_series).sum::<usize>();
        safe_file::HDF5_OVERHEAD + numbers as u64
    }

    fn write_batch(&self, copy: &Path) -> hdf5::Result<()> {
        // One chunk in the cache: the library's 1 MiB would fill as far as the longest batch so far reaches.
        let chunk = CHUNK_VALUES * size_of::<f64>();
        let file = File::with_options().with_fapl(|list| list.chunk_cache(1, chunk, 1.0)).open_rw(copy)?;
        for array in &self.arrays {
            if file.link_exists(&array.path) {
                file.unlink(&array.path)?;
            }
            make_parents(&file, &array.path)?;
            let dataset =
                file.new_dataset_builder().with_data(&array.values[..]).create(array.path.as_str())?;
            describe(&dataset, &array.unit, &array.description)?;
        }
        for series in &self.series {
            series.write(&file)?;
        }
        file.close()
    }

    /// Rows that the datasets of `columns` have in the file; `None` where none of them exists.
    fn rows_on_file(&self, columns: &[OwnedColumn]) -> Result<Option<usize>, OutputError> {
        let file = File::open(&self.path).map_err(OutputError::hdf5(&self.path, "open"))?;
        let mut rows = Vec::new();
        for column in columns {
            let Ok(dataset) = file.dataset(&column.path) else { continue };
            let shape = dataset.shape();
            if shape.get(1).copied().unwrap_or(1) != column.width || !dataset.is_resizable() {
                let what = format!("{} has shape {shape:?}, not rows of {}", column.path, column.width);
                return Err(OutputError::Mismatch { path: self.path.clone(), what });
            }
            rows.push(shape[0]);
        }
        match rows.first() {
            None => Ok(None),
            Some(&first) if rows.len() == columns.len() && rows.iter().all(|&n| n == first) => {
                Ok(Some(first))
            }
            Some(_) => {
                let what = format!("the datasets beside {} are missing or unequally long", columns[0].path);
                Err(OutputError::Mismatch { path: self.path.clone(), what })
            }
        }
    }
}

/// The name of the case that a file was written for, if it says so.
pub fn case_name(path: &Path) -> Option<String> {
    attribute(path, "case_name")
}

/// The program that wrote a file, if it says so.
pub fn program(path: &Path) -> Option<String> {
    attribute(path, "program")
}

fn attribute(path: &Path, name: &str) -> Option<String> {
    path.exists().then(|| File::open(path).ok().and_then(|file| text(&file, name)))?
}
