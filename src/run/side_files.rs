//! The files of one side: its histories and its snapshots.

use std::sync::Arc;
use std::time::Instant;

use mesh::{BLOCK, Mesh};

use super::record::{attributes, cell_geometry};
use crate::case::Case;
use crate::output::{
    BackgroundWriter, FieldSpec, HistoryFile, OutputError, OwnedQuadMesh, RunDirectory, SeriesWriter,
    Snapshot,
};

/// What the files of a side are called and what its snapshots may hold.
pub struct SideNames {
    /// File of the histories.
    pub history: &'static str,
    /// File of the snapshots.
    pub snapshots: &'static str,
    /// The fields there are.
    pub fields: Vec<&'static str>,
    /// What each of them is.
    pub spec: fn(&'static str) -> FieldSpec<'static>,
}

/// The files of one side.
pub struct SideFiles {
    /// Its histories.
    pub history: HistoryFile,
    /// Where snapshots go; without a directory nowhere.
    snapshots: Option<BackgroundWriter>,
    fields: Vec<&'static str>,
    /// The mesh of the last snapshot with its generation.
    geometry: Option<(u64, Arc<OwnedQuadMesh>)>,
}

impl SideFiles {
    /// Makes the files, without any rows and snapshots. Without a directory histories stay in memory.
    pub fn create(
        case: &Case,
        directory: Option<&RunDirectory>,
        names: SideNames,
    ) -> Result<Self, OutputError> {
        let Some(directory) = directory else {
            return Ok(Self {
                history: HistoryFile::in_memory(),
                snapshots: None,
                fields: vec![],
                geometry: None,
            });
        };
        let owned = attributes(case);
        let attributes: Vec<(&str, &str)> =
            owned.iter().map(|(name, value)| (*name, value.as_str())).collect();
        let history = HistoryFile::create(&directory.file(names.history), &attributes)?;
        let wanted = |name: &&str| match &case.output.fields {
            Some(wanted) => wanted.iter().any(|w| w == name),
            None => true,
        };
        let fields: Vec<&'static str> = names.fields.into_iter().filter(wanted).collect();
        let specs: Vec<FieldSpec<'_>> = fields.iter().map(|name| (names.spec)(name)).collect();
        let path = directory.file(names.snapshots);
        let writer = SeriesWriter::create(&path, &specs, case.output.compression, &attributes)?;
        let snapshots = Some(BackgroundWriter::start(writer)?);
        Ok(Self { history, snapshots, fields, geometry: None })
    }

    /// Hands a snapshot over to be written: `values` gives the fields of these names, cell by cell.
    pub fn snapshot(
        &mut self,
        time: f64,
        mesh: &Mesh<BLOCK>,
        values: impl FnOnce(&[&'static str]) -> Vec<Vec<f64>>,
    ) -> Result<(), OutputError> {
        let Some(snapshots) = &mut self.snapshots else { return Ok(()) };
        let start = Instant::now();
        let mesh_id = mesh.generation();
        let geometry = match self.geometry.take() {
            Some((id, geometry)) if id == mesh_id => geometry,
            _ => Arc::new(cell_geometry(mesh)),
        };
        self.geometry = Some((mesh_id, Arc::clone(&geometry)));
        let values = values(&self.fields);
        snapshots.append(Snapshot { time, mesh: geometry, mesh_id, values })?;
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
