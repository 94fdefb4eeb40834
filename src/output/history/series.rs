//! One series of a [`super::HistoryFile`]: its columns, the rows that wait, and how they get into the file.

use hdf5::{Dataset, File};
use ndarray::ArrayView2;

use super::{BufferedColumn, LARGEST_BUFFER};
use crate::output::hdf5_attributes::set_text;

/// Values per chunk of a dataset, 32 KiB: small enough that a short history stays a small file.
pub(super) const CHUNK_VALUES: usize = 4096;

#[derive(Debug)]
pub(super) struct Series {
    pub(super) group: String,
    pub(super) columns: Vec<OwnedColumn>,
    /// Values per row, all columns together.
    pub(super) width: usize,
    /// Rows in the file.
    pub(super) written: usize,
    /// Whether the datasets exist in the file.
    pub(super) created: bool,
    /// Rows not yet in the file.
    pub(super) buffer: Vec<f64>,
}

#[derive(Debug)]
pub(super) struct OwnedColumn {
    pub(super) path: String,
    pub(super) unit: String,
    pub(super) description: String,
    pub(super) width: usize,
}

impl Series {
    pub(super) fn buffered_rows(&self) -> usize {
        self.buffer.len() / self.width.max(1)
    }

    /// Takes into use what its share of a batch may need, going by this one: how long a batch waits depends on the machine,
    /// and the memory of a long run should not.
    ///
    /// - `buffered`: memory of the batch, of all series, bytes.
    pub(super) fn reserve(&mut self, buffered: u64) {
        let share = (LARGEST_BUFFER as usize * self.buffer.len()).div_ceil(buffered.max(1) as usize);
        // Rows come in while a batch that is due waits for its turn.
        self.buffer.resize(share + share / 4, 0.0);
    }

    /// Every column with its buffered rows.
    pub(super) fn buffered_columns(&self) -> impl Iterator<Item = BufferedColumn<'_>> {
        let mut offset = 0;
        self.columns.iter().map(move |column| {
            let place = offset..offset + column.width;
            offset += column.width;
            let rows = self.buffer.chunks_exact(self.width);
            BufferedColumn {
                path: &column.path,
                unit: &column.unit,
                description: &column.description,
                width: column.width,
                values: rows.flat_map(|row| row[place.clone()].iter().copied()).collect(),
            }
        })
    }

    /// Writes the buffered rows into the datasets, which are made where they do not exist.
    ///
    /// A chunk's worth at a time: a batch that had to wait longer than all before takes no more memory than they did.
    pub(super) fn write(&self, file: &File) -> hdf5::Result<()> {
        let new_rows = self.buffered_rows();
        let mut offset = 0;
        for column in &self.columns {
            let dataset = if self.created { file.dataset(&column.path)? } else { column.create(file)? };
            let end = self.written + new_rows;
            if column.width == 1 { dataset.resize(end) } else { dataset.resize((end, column.width)) }?;
            let most_rows = column.chunk_rows();
            let mut values = Vec::with_capacity(most_rows * column.width);
            for (number, part) in self.buffer.chunks(most_rows * self.width).enumerate() {
                values.clear();
                for row in part.chunks_exact(self.width) {
                    values.extend_from_slice(&row[offset..offset + column.width]);
                }
                let first = self.written + number * most_rows;
                let rows = first..first + part.len() / self.width;
                if column.width == 1 {
                    dataset.write_slice(&values[..], rows)?;
                } else {
                    let view = ArrayView2::from_shape((rows.len(), column.width), &values)?;
                    dataset.write_slice(view, ndarray::s![rows, ..])?;
                }
            }
            offset += column.width;
        }
        Ok(())
    }
}

impl OwnedColumn {
    /// Rows per chunk of the dataset.
    fn chunk_rows(&self) -> usize {
        (CHUNK_VALUES / self.width.max(1)).max(1)
    }

    fn create(&self, file: &File) -> hdf5::Result<Dataset> {
        make_parents(file, &self.path)?;
        let builder = file.new_dataset::<f64>();
        let chunk_rows = self.chunk_rows();
        let dataset = if self.width == 1 {
            builder.chunk((chunk_rows,)).shape((0..,)).create(self.path.as_str())?
        } else {
            builder.chunk((chunk_rows, self.width)).shape((0.., self.width)).create(self.path.as_str())?
        };
        describe(&dataset, &self.unit, &self.description)?;
        Ok(dataset)
    }
}

/// The path from the root of `name` in `group`.
pub(super) fn absolute(group: &str, name: &str) -> String {
    let group = group.trim_matches('/');
    let name = name.trim_matches('/');
    if group.is_empty() { format!("/{name}") } else { format!("/{group}/{name}") }
}

/// Makes the groups that `path` lies in.
pub(super) fn make_parents(file: &File, path: &str) -> hdf5::Result<()> {
    for (end, _) in path.match_indices('/').skip(1) {
        if !file.link_exists(&path[..end]) {
            file.create_group(&path[..end])?;
        }
    }
    Ok(())
}

pub(super) fn describe(dataset: &Dataset, unit: &str, description: &str) -> hdf5::Result<()> {
    set_text(dataset, "units", unit)?;
    set_text(dataset, "description", description)
}
