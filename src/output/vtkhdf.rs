//! Cell fields on a changing mesh of quadrilaterals over time, as ParaView, VTK and PyVista read them.
//!
//! VTKHDF 2.2, `UnstructuredGrid` with `Steps`: <https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/>.
//! One entry of `NumberOfPoints`, `NumberOfCells` and `NumberOfConnectivityIds` per *mesh*; a snapshot on the mesh of the
//! one before repeats that one's offsets and stores its fields only.

use std::ops::Range;
use std::path::{Path, PathBuf};

use hdf5::{File, Group};

use super::hdf5_attributes::text;
use super::{CellMesh, CellValues, OutputError, hdf5_memory, safe_file};
use layout::{LARGEST_CHUNK, append_made, append_rows, create_datasets, write_mesh, write_step_count};

mod chunks;
mod end;
mod layout;

/// Above this length in bytes a file is extended in place instead of in a copy: copying then costs more than writing.
const COPY_LIMIT: u64 = 256 << 20;

/// How the values of a field are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Storage {
    /// As they are.
    #[default]
    F64,
    /// As whole numbers from 0 to 255, for levels and flags.
    U8,
}

/// A field on cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FieldSpec<'a> {
    /// Name of the dataset.
    pub name: &'a str,
    /// 1 for a scalar, 3 for a vector (z, r, 0).
    pub components: usize,
    /// SI unit, as `kg/m3`; `1` for a pure number.
    pub unit: &'a str,
    /// What it is, in a few words.
    pub description: &'a str,
    /// How it is stored.
    pub storage: Storage,
}

/// A file of snapshots, open only while one is appended.
#[derive(Debug)]
pub struct SeriesWriter {
    path: PathBuf,
    fields: Vec<Field>,
    end: End,
    /// The mesh of the last snapshot, if this writer wrote it.
    mesh_id: Option<u64>,
    copy_limit: u64,
    /// Whether a checkpoint counts on what is in the file now: the next change must leave a version of it.
    is_counted_on: bool,
}

#[derive(Debug)]
struct Field {
    name: String,
    components: usize,
    storage: Storage,
}

/// Where the datasets end: all counts are of what the first `steps` snapshots need.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct End {
    steps: usize,
    /// Start of the last mesh in each dataset.
    last: Offsets,
    /// End of the last mesh, so the start of the next.
    next: Offsets,
    /// Rows of each cell field.
    field_rows: usize,
}

/// Positions of a mesh in the datasets that hold all meshes.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Offsets {
    meshes: usize,
    points: usize,
    cells: usize,
    connectivity: usize,
}

impl SeriesWriter {
    /// Makes the file without snapshots; an existing one is replaced.
    ///
    /// `compression` is the deflate level, 0 to 9; 0 stores the values as they are. `attributes` (name, value) go to
    /// the root of the file.
    pub fn create(
        path: &Path,
        fields: &[FieldSpec<'_>],
        compression: u8,
        attributes: &[(&str, &str)],
    ) -> Result<Self, OutputError> {
        hdf5_memory::keep_none();
        safe_file::replace_hdf5(path, safe_file::HDF5_OVERHEAD, |temporary| {
            create_datasets(temporary, fields, compression, attributes)
                .map_err(OutputError::hdf5(path, "create"))
        })?;
        let fields = fields
            .iter()
            .map(|field| Field {
                name: field.name.to_owned(),
                components: field.components,
                storage: field.storage,
            })
            .collect();
        Ok(Self {
            path: path.to_path_buf(),
            fields,
            end: End::default(),
            mesh_id: None,
            copy_limit: COPY_LIMIT,
            is_counted_on: false,
        })
    }

    /// Opens a file written before, to append to its snapshots. The fields and their order are the file's. If a kill has left it
    /// half changed, it is as it was at the last checkpoint, or somewhat later.
    pub fn open(path: &Path) -> Result<Self, OutputError> {
        hdf5_memory::keep_none();
        safe_file::recover(path)?;
        let read = || -> hdf5::Result<(Vec<Field>, End)> {
            let root = File::open(path)?.group("VTKHDF")?;
            let steps: i64 = root.group("Steps")?.attr("NSteps")?.read_scalar()?;
            let order = text(&root, "FieldOrder").ok_or("the order of the fields is missing")?;
            let fields =
                order.split(' ').map(|name| Field::read(&root, name)).collect::<hdf5::Result<_>>()?;
            Ok((fields, End::read(&root, steps.max(0) as usize)?))
        };
        let (fields, end) = read().map_err(OutputError::hdf5(path, "open as a series of snapshots"))?;
        Ok(Self {
            path: path.to_path_buf(),
            fields,
            end,
            mesh_id: None,
            copy_limit: COPY_LIMIT,
            is_counted_on: true,
        })
    }

    /// Sets the length in bytes above which the file is extended in place, 256 MiB if not set. In place a kill within the
    /// few milliseconds in which HDF5 updates its indices may spoil the file; [`open`](Self::open) then takes the version that
    /// was kept at the last checkpoint.
    #[must_use]
    pub fn with_copy_limit(mut self, bytes: u64) -> Self {
        self.copy_limit = bytes;
        self
    }

    /// A checkpoint counts on what is in the file now.
    pub fn count_on_it(&mut self) {
        self.is_counted_on = true;
    }

    /// Removes what was kept for the case of a kill: nothing more is to come.
    pub fn finish(&mut self) -> Result<(), OutputError> {
        safe_file::forget_before(&self.path)
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Number of snapshots.
    pub fn steps(&self) -> usize {
        self.end.steps
    }

    /// Which mesh the last snapshot is on, where another writer has written it: the next one on the same mesh does not store it
    /// again.
    #[must_use]
    pub fn with_mesh(mut self, mesh_id: Option<u64>) -> Self {
        self.mesh_id = mesh_id;
        self
    }

    /// Forgets the snapshots from number `steps` on, as a restart from an earlier time needs; nothing of them is left.
    ///
    /// - errors: there are fewer, or the file cannot be changed.
    pub fn truncate(&mut self, steps: usize) -> Result<(), OutputError> {
        if steps > self.end.steps {
            let what = format!("it has {} snapshots where {steps} are looked for", self.end.steps);
            return Err(OutputError::Mismatch { path: self.path.clone(), what });
        }
        let end = self.update(0, |path| {
            let shorten = || -> hdf5::Result<End> {
                let file = File::open_rw(path)?;
                let root = file.group("VTKHDF")?;
                let end = End::read(&root, steps)?;
                write_step_count(&root, steps)?;
                end.cut(&root)?;
                drop(root);
                file.close()?;
                Ok(end)
            };
            shorten().map_err(OutputError::hdf5(&self.path, "shorten"))
        })?;
        self.end = end;
        self.mesh_id = None;
        Ok(())
    }

    /// Appends a snapshot: the values of each field in the order given to [`create`](Self::create).
    ///
    /// A `mesh_id` equal to that of the snapshot before says that the mesh is the same; it is then not stored again.
    pub fn append(
        &mut self,
        time: f64,
        mesh: &dyn CellMesh,
        mesh_id: u64,
        values: &dyn CellValues,
    ) -> Result<(), OutputError> {
        self.check_lengths(mesh, values)?;
        let is_new_mesh = self.mesh_id != Some(mesh_id);
        let end = self.end.after(mesh, is_new_mesh);
        let values_len: usize = (0..values.fields()).map(|field| values.len(field)).sum();
        let mesh_len = if is_new_mesh { 3 * mesh.points() + 8 * mesh.cells() } else { 0 };
        self.update(size_of::<f64>() * (values_len + mesh_len), |path| {
            let write = || -> hdf5::Result<()> {
                let file = File::open_rw(path)?;
                let root = file.group("VTKHDF")?;
                if is_new_mesh {
                    write_mesh(&root, mesh, &end)?;
                }
                for (number, field) in self.fields.iter().enumerate() {
                    field.append(&root, (values, number), self.end.field_rows)?;
                }
                // What readers go by comes last, once the data it points to are in the file.
                file.flush()?;
                self.write_step(&root, time, &end)?;
                drop(root);
                file.close()
            };
            write().map_err(OutputError::hdf5(&self.path, "append a snapshot to"))
        })?;
        self.end = end;
        self.mesh_id = Some(mesh_id);
        self.is_counted_on = false;
        Ok(())
    }

    /// Changes the file: a copy that replaces it, or, when it is long and nobody reads it just then, the file itself.
    ///
    /// - `more`: bytes of the numbers that are added.
    fn update<T>(
        &self,
        more: usize,
        change: impl FnOnce(&Path) -> Result<T, OutputError>,
    ) -> Result<T, OutputError> {
        // A chunk that is begun for each dataset, besides.
        let room = safe_file::HDF5_OVERHEAD + (more + (self.fields.len() + 4) * LARGEST_CHUNK) as u64;
        let is_long = std::fs::metadata(&self.path).is_ok_and(|file| file.len() > self.copy_limit);
        if is_long && self.is_counted_on {
            safe_file::keep_before(&self.path)?;
        }
        // A reader that has the file open holds a lock on it, under which HDF5 refuses to write.
        if !is_long || self.is_counted_on || File::open_rw(&self.path).is_err() {
            safe_file::update_hdf5(&self.path, room, change)
        } else {
            safe_file::change_hdf5(&self.path, room, change)
        }
    }

    fn check_lengths(&self, mesh: &dyn CellMesh, values: &dyn CellValues) -> Result<(), OutputError> {
        let cells = mesh.cells();
        let check = |what: String, found, expected| {
            if found == expected {
                return Ok(());
            }
            Err(OutputError::Length { path: self.path.clone(), what, found, expected })
        };
        check("the list of fields".to_owned(), values.fields(), self.fields.len())?;
        for (number, field) in self.fields.iter().enumerate() {
            check(format!("field {}", field.name), values.len(number), cells * field.components)?;
        }
        Ok(())
    }

    /// Enters the snapshot that `end` ends with into the list of steps.
    fn write_step(&self, root: &Group, time: f64, end: &End) -> hdf5::Result<()> {
        let steps = root.group("Steps")?;
        let at = end.steps - 1;
        append_rows(&steps.dataset("Values")?, &[time], at)?;
        append_rows(&steps.dataset("PartOffsets")?, &[end.last.meshes as i64], at)?;
        append_rows(&steps.dataset("NumberOfParts")?, &[1i64], at)?;
        append_rows(&steps.dataset("PointOffsets")?, &[end.last.points as i64], at)?;
        append_rows(&steps.dataset("CellOffsets")?, &[end.last.cells as i64], at)?;
        append_rows(&steps.dataset("ConnectivityIdOffsets")?, &[end.last.connectivity as i64], at)?;
        let offsets = steps.group("CellDataOffsets")?;
        for field in &self.fields {
            append_rows(&offsets.dataset(&field.name)?, &[self.end.field_rows as i64], at)?;
        }
        write_step_count(root, end.steps)
    }
}

impl Field {
    fn read(root: &Group, name: &str) -> hdf5::Result<Self> {
        let dataset = root.group("CellData")?.dataset(name)?;
        let components = dataset.shape().get(1).copied().unwrap_or(1);
        let storage = if dataset.dtype()?.is::<u8>() { Storage::U8 } else { Storage::F64 };
        Ok(Self { name: name.to_owned(), components, storage })
    }

    /// Writes its values from row `row` on.
    ///
    /// - `values`: of a snapshot, and the number of this field among them.
    fn append(
        &self,
        root: &Group,
        (values, number): (&dyn CellValues, usize),
        row: usize,
    ) -> hdf5::Result<()> {
        let dataset = root.group("CellData")?.dataset(&self.name)?;
        let rows = values.len(number) / self.components;
        let numbers = |rows: Range<usize>| rows.start * self.components..rows.end * self.components;
        match self.storage {
            Storage::F64 => {
                append_made(&dataset, rows, row, |rows, piece| values.add(number, numbers(rows), piece))
            }
            Storage::U8 => {
                let mut exact = Vec::new();
                append_made(&dataset, rows, row, |rows, piece| {
                    exact.clear();
                    values.add(number, numbers(rows), &mut exact);
                    piece.extend(exact.iter().map(|value| value.round() as u8));
                })
            }
        }
    }
}
