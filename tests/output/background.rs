//! Snapshots written by a thread of their own, on meshes that adapt.

use std::path::Path;
use std::sync::Arc;

use cav::output::{BackgroundWriter, OutputError, OwnedQuadMesh, SeriesWriter, Snapshot};
use hdf5::File;

use crate::snapshots::{FIELDS, check_step, integers, values};

/// The unit square cut into cells, finer towards the point `front` of its diagonal: leaves of a quadtree, level by level.
struct Adapted {
    mesh: OwnedQuadMesh,
    levels: Vec<f64>,
}

impl Adapted {
    fn towards(front: f64, finest: u32) -> Self {
        let mut adapted = Self { mesh: OwnedQuadMesh::default(), levels: Vec::new() };
        adapted.cell([0.0, 0.0], 0, finest, front);
        adapted
    }

    fn cell(&mut self, [z, r]: [f64; 2], level: u32, finest: u32, front: f64) {
        let width = 0.5_f64.powi(level as i32);
        let meets = [z, r].iter().all(|low| (*low..*low + width).contains(&front));
        if level < finest && (meets || level == 0) {
            let half = 0.5 * width;
            for [dz, dr] in [[0.0, 0.0], [half, 0.0], [0.0, half], [half, half]] {
                self.cell([z + dz, r + dr], level + 1, finest, front);
            }
            return;
        }
        let first = self.mesh.points.len() / 3;
        for [dz, dr] in [[0.0, 0.0], [width, 0.0], [width, width], [0.0, width]] {
            self.mesh.points.extend([z + dz, r + dr, 0.0]);
        }
        self.mesh.quads.push([first, first + 1, first + 2, first + 3]);
        self.levels.push(f64::from(level));
    }
}

fn start(path: &Path) -> BackgroundWriter {
    BackgroundWriter::start(SeriesWriter::create(path, &FIELDS, 4, &[]).unwrap()).unwrap()
}

fn snapshot(adapted: &Adapted, step: usize) -> Snapshot {
    let [pressure, velocity, _] = values(adapted.levels.len(), step);
    Snapshot {
        time: 0.5 * step as f64,
        mesh: Arc::new(adapted.mesh.clone()),
        mesh_id: step as u64,
        values: Box::new(vec![pressure, velocity, adapted.levels.clone()]),
    }
}

#[test]
fn a_series_on_a_mesh_that_changes_from_step_to_step_is_read_back_with_its_levels() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("fluid.vtkhdf");
    let meshes: Vec<Adapted> = [(0.1, 2), (0.3, 5), (0.6, 4), (0.9, 1)]
        .map(|(front, finest)| Adapted::towards(front, finest))
        .into();
    let mut writer = start(&path);
    for (step, adapted) in meshes.iter().enumerate() {
        writer.append(snapshot(adapted, step)).unwrap();
        writer.check().unwrap();
    }
    writer.close().unwrap();

    let root = File::open(&path).unwrap().group("VTKHDF").unwrap();
    let cells: Vec<i64> = meshes.iter().map(|adapted| adapted.levels.len() as i64).collect();
    assert_eq!(cells, [7, 16, 13, 4]);
    assert_eq!(integers(&root, "NumberOfCells"), cells);
    assert_eq!(integers(&root, "NumberOfPoints"), cells.iter().map(|n| 4 * n).collect::<Vec<_>>());
    let steps = root.group("Steps").unwrap();
    assert_eq!(integers(&steps, "PartOffsets"), [0, 1, 2, 3]);
    assert_eq!(integers(&steps, "CellOffsets"), [0, 7, 23, 36]);
    assert_eq!(integers(&steps, "PointOffsets"), [0, 28, 92, 144]);
    let levels: Vec<u8> = root.dataset("CellData/level").unwrap().read_raw().unwrap();
    let mut expected = meshes.iter().flat_map(|adapted| adapted.levels.iter().map(|level| *level as u8));
    assert!(levels.iter().copied().eq(&mut expected), "{levels:?}");
    assert_eq!((levels.iter().min(), levels.iter().max()), (Some(&1), Some(&5)));
    let pressure: Vec<f64> = root.dataset("CellData/pressure").unwrap().read_raw().unwrap();
    for (step, adapted) in meshes.iter().enumerate() {
        let first = integers(&steps.group("CellDataOffsets").unwrap(), "pressure")[step] as usize;
        let points = integers(&steps, "PointOffsets")[step] as usize;
        let stored: Vec<f64> = root.dataset("Points").unwrap().read_raw().unwrap();
        assert_eq!(stored[3 * points..][..adapted.mesh.points.len()], adapted.mesh.points);
        assert_eq!(pressure[first..][..adapted.levels.len()], values(adapted.levels.len(), step)[0]);
        let area: f64 = adapted.levels.iter().map(|level| 0.25_f64.powi(*level as i32)).sum();
        assert_eq!(area, 1.0, "the cells fill the square");
    }
}

#[test]
fn a_writer_that_is_dropped_loses_nothing() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("fluid.vtkhdf");
    let adapted = Adapted::towards(0.3, 4);
    let mut writer = start(&path);
    for step in 0..5 {
        let cells = adapted.levels.len();
        let values = Box::new(Vec::from(values(cells, step)));
        writer.append(Snapshot { values, mesh_id: 0, ..snapshot(&adapted, step) }).unwrap();
    }
    drop(writer);
    let root = File::open(&path).unwrap().group("VTKHDF").unwrap();
    assert_eq!(integers(&root, "NumberOfCells"), [adapted.levels.len() as i64]);
    for step in 0..5 {
        check_step(&root, step, &adapted.mesh);
    }
}

#[test]
fn what_goes_wrong_is_told_once_and_nothing_is_written_after_it() {
    let place = tempfile::tempdir().unwrap();
    let adapted = Adapted::towards(0.3, 3);
    for told_by_close in [true, false] {
        let directory = place.path().join("run");
        std::fs::create_dir(&directory).unwrap();
        let mut writer = start(&directory.join("fluid.vtkhdf"));
        std::fs::remove_dir_all(&directory).unwrap();
        writer.append(snapshot(&adapted, 0)).unwrap();
        let error = if told_by_close { writer.close() } else { writer.append(snapshot(&adapted, 1)) };
        let error = error.unwrap_err();
        assert!(
            matches!(&error, OutputError::Io { .. }) && error.to_string().contains("fluid.vtkhdf"),
            "{error}"
        );
        let again = writer.append(snapshot(&adapted, 2)).unwrap_err();
        assert!(matches!(again, OutputError::Closed { .. }), "{again}");
        writer.close().unwrap();
    }
}

#[test]
fn a_check_tells_of_an_error_without_waiting() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("fluid.vtkhdf");
    let mut writer = start(&path);
    std::fs::remove_file(&path).unwrap();
    writer.append(snapshot(&Adapted::towards(0.3, 3), 0)).unwrap();
    let told = (0..1000).find_map(|_| {
        std::thread::sleep(std::time::Duration::from_millis(5));
        writer.check().err()
    });
    assert!(matches!(told, Some(OutputError::Io { .. })), "{told:?}");
}
