//! The files of one side: its histories and its snapshots.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use mesh::{BLOCK, CellField, CellSnapshot, Geometry, Mesh};
use serde::{Deserialize, Serialize};

use crate::case::Case;
use crate::output::{
    BackgroundWriter, BlockMesh, CellMesh, CellValues, FieldSpec, HistoryFile, OutputError, RunDirectory,
    SeriesWriter, Snapshot, Storage, safe_file,
};
use crate::run::record::{attributes, cell_geometry};

/// What the files of a side are called and what its snapshots may hold.
pub struct SideNames<S: 'static> {
    /// File of the histories.
    pub history: &'static str,
    /// File of the snapshots.
    pub snapshots: &'static str,
    /// The fields there are.
    pub fields: Vec<&'static CellField<S>>,
}

impl<S: CellSnapshot> SideNames<S> {
    /// The fields that the case asks for.
    fn wanted(&self, case: &Case) -> Vec<&'static CellField<S>> {
        let is_wanted = |field: &&CellField<S>| match &case.output.fields {
            Some(wanted) => wanted.iter().any(|name| name == field.name),
            None => true,
        };
        self.fields.iter().copied().filter(is_wanted).collect()
    }
}

/// How a field is written.
fn spec<S: CellSnapshot>(field: &CellField<S>) -> FieldSpec<'static> {
    let CellField { name, unit, description, .. } = *field;
    // Levels are whole numbers, and few.
    let storage = if name == "level" { Storage::U8 } else { Storage::F64 };
    FieldSpec { name, components: field.components(), unit, description, storage }
}

/// Some fields of a snapshot of a side.
#[derive(Debug)]
struct Taken<S: 'static> {
    fields: Vec<&'static CellField<S>>,
    snapshot: S,
}

impl<S: CellSnapshot> CellValues for Taken<S> {
    fn fields(&self) -> usize {
        self.fields.len()
    }

    fn len(&self, field: usize) -> usize {
        self.fields[field].components() * self.fields[field].cells(&self.snapshot)
    }

    fn add(&self, field: usize, numbers: Range<usize>, list: &mut Vec<f64>) {
        let field = self.fields[field];
        let components = field.components();
        field.add(&self.snapshot, numbers.start / components..numbers.end / components, list);
    }
}

/// The files of one side.
pub struct SideFiles<S: 'static> {
    /// Its histories.
    pub history: HistoryFile,
    /// Where snapshots go; without a directory nowhere.
    snapshots: Option<BackgroundWriter>,
    fields: Vec<&'static CellField<S>>,
    /// How many snapshots there are.
    taken: u64,
    /// The generation of the last one's mesh.
    mesh_id: Option<u64>,
    /// That mesh.
    geometry: Option<Arc<BlockMesh<BLOCK>>>,
}

/// How far the files of a side are.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct FilesState {
    rows: Vec<u64>,
    taken: u64,
    mesh_id: Option<u64>,
}

impl<S: CellSnapshot> SideFiles<S> {
    /// Makes the files, without any rows and snapshots. Without a directory histories stay in memory.
    pub fn create(
        case: &Case,
        directory: Option<&RunDirectory>,
        names: SideNames<S>,
    ) -> Result<Self, OutputError> {
        let is_planar = case.geometry == Geometry::Planar;
        let Some(directory) = directory else {
            return Ok(Self::of(HistoryFile::in_memory().planar(is_planar), None, vec![]));
        };
        let owned = attributes(case);
        let attributes: Vec<(&str, &str)> =
            owned.iter().map(|(name, value)| (*name, value.as_str())).collect();
        let history = HistoryFile::create(&directory.file(names.history), &attributes)?.planar(is_planar);
        let fields = names.wanted(case);
        let specs: Vec<FieldSpec<'_>> = fields.iter().map(|field| spec(field)).collect();
        let path = directory.file(names.snapshots);
        let writer = SeriesWriter::create(&path, &specs, case.output.compression, &attributes)?;
        Ok(Self::of(history, Some(BackgroundWriter::start(writer)?), fields))
    }

    /// Opens the files of a run that is taken up again and forgets the snapshots made since `state`; the rows go when all series
    /// have been added, see [`SideFiles::forget_rows`].
    pub fn resume(
        case: &Case,
        directory: &RunDirectory,
        names: SideNames<S>,
        state: &FilesState,
    ) -> Result<Self, OutputError> {
        let is_planar = case.geometry == Geometry::Planar;
        let history = HistoryFile::open(&directory.file(names.history))?.planar(is_planar);
        let mut writer = SeriesWriter::open(&directory.file(names.snapshots))?;
        writer.truncate(state.taken as usize)?;
        let writer = BackgroundWriter::start(writer.with_mesh(state.mesh_id))?;
        let files = Self::of(history, Some(writer), names.wanted(case));
        Ok(Self { taken: state.taken, mesh_id: state.mesh_id, ..files })
    }

    fn of(
        history: HistoryFile,
        snapshots: Option<BackgroundWriter>,
        fields: Vec<&'static CellField<S>>,
    ) -> Self {
        Self { history, snapshots, fields, taken: 0, mesh_id: None, geometry: None }
    }

    /// Forgets the rows made since `state`.
    pub fn forget_rows(&mut self, state: &FilesState) -> Result<(), OutputError> {
        self.history.truncate_all(&state.rows)?;
        self.history.flush()
    }

    /// How far the files are.
    pub fn saved(&self) -> FilesState {
        let Self { history, snapshots: _, fields: _, taken, mesh_id, geometry: _ } = self;
        FilesState { rows: history.all_rows(), taken: *taken, mesh_id: *mesh_id }
    }

    /// Brings everything so far to the disk.
    pub fn settle(&mut self) -> Result<(), OutputError> {
        self.history.flush()?;
        let mut paths: Vec<_> = self.history.path().map(Path::to_path_buf).into_iter().collect();
        if let Some(snapshots) = &mut self.snapshots {
            snapshots.catch_up()?;
            paths.push(snapshots.path().to_path_buf());
        }
        for path in &paths {
            safe_file::sync(path)?;
        }
        // They were renamed to their names.
        paths.first().and_then(|path| path.parent()).map_or(Ok(()), safe_file::sync)
    }

    /// Hands a snapshot over to be written.
    pub fn snapshot(
        &mut self,
        time: f64,
        mesh: &Mesh<BLOCK>,
        take: impl FnOnce() -> S,
    ) -> Result<(), OutputError> {
        let Some(snapshots) = &mut self.snapshots else { return Ok(()) };
        let start = Instant::now();
        // Two at a time would be more than the state of the cells.
        snapshots.wait()?;
        let mesh_id = mesh.generation();
        let is_same = self.mesh_id == Some(mesh_id);
        let known = self.geometry.take().filter(|_| is_same);
        let geometry = known.unwrap_or_else(|| Arc::new(cell_geometry(mesh)));
        self.geometry = Some(Arc::clone(&geometry));
        let geometry: Arc<dyn CellMesh> = geometry;
        let values = Box::new(Taken { fields: self.fields.clone(), snapshot: take() });
        snapshots.append(Snapshot { time, mesh: geometry, mesh_id, values })?;
        self.taken += 1;
        self.mesh_id = Some(mesh_id);
        tracing::debug!(time, seconds = start.elapsed().as_secs_f64(), "handed a snapshot over");
        Ok(())
    }

    /// Writes a batch of the histories if one is due, and tells of what went wrong with snapshots.
    pub fn after_step(&mut self) -> Result<(), OutputError> {
        if let Some(snapshots) = &mut self.snapshots {
            snapshots.check()?;
        }
        self.history.flush_if_due()?;
        Ok(())
    }

    /// Writes everything that is still in memory; of what goes wrong the first is told.
    pub fn close(&mut self) -> Result<(), OutputError> {
        let snapshots = self.snapshots.as_mut().map_or(Ok(()), BackgroundWriter::close);
        self.history.flush()?;
        snapshots
    }
}
