//! A process killed at a random moment leaves files that hold all earlier batches.
//!
//! The process to kill is this test program itself, asked by an environment variable to write until it is killed.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::time::Duration;

use cav::output::{BackgroundWriter, Column, HistoryFile, SeriesWriter, Snapshot};
use hdf5::File;

use crate::snapshots::{FIELDS, check_step, squares, values};

const ROLE: &str = "CAV_TEST_WRITE_UNTIL_KILLED";
const KILLS: u64 = 20;

#[test]
fn writer_to_be_killed() {
    let Some(directory) = std::env::var_os(ROLE).map(PathBuf::from) else { return };
    let mut history = HistoryFile::create(&directory.join("fluid.h5"), &[]).unwrap();
    let columns = [("row", 1), ("group/wide", 300)].map(|(name, width)| Column {
        name,
        unit: "1",
        description: "the number of the row",
        width,
    });
    let id = history.add_series("", &columns).unwrap();
    let writer = SeriesWriter::create(&directory.join("fluid.vtkhdf"), &FIELDS, 1, &[]).unwrap();
    let mut writer = BackgroundWriter::start(writer).unwrap();
    let meshes = [squares(30, 20), squares(50, 40)].map(Arc::new);
    for step in 0.. {
        for _ in 0..20 {
            let row = history.rows(id) as f64;
            history.push(id, &[row; 301]).unwrap();
        }
        history.flush().unwrap();
        // The mesh changes at every third snapshot.
        let mesh = &meshes[step / 3 % 2];
        let values = Box::new(Vec::from(values(mesh.quads.len(), step)));
        let (time, mesh_id) = (0.5 * step as f64, step as u64 / 3);
        writer.append(Snapshot { time, mesh: mesh.clone(), mesh_id, values }).unwrap();
    }
}

fn start_writer(directory: &Path) -> Child {
    Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "kill::writer_to_be_killed", "--nocapture"])
        .env(ROLE, directory)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

#[test]
fn files_of_a_killed_writer_hold_whole_batches() {
    let meshes = [squares(30, 20), squares(50, 40)];
    let (mut rows_in_all, mut steps_in_all) = (0, 0);
    for number in 0..KILLS {
        let directory = tempfile::tempdir().unwrap();
        let mut child = start_writer(directory.path());
        let history = directory.path().join("fluid.h5");
        let fields = directory.path().join("fluid.vtkhdf");
        while !fields.exists() {
            assert!(child.try_wait().unwrap().is_none(), "the writer has ended by itself");
            std::thread::sleep(Duration::from_millis(1));
        }
        // Scattered moments within 150 ms, the same in every run of the test.
        std::thread::sleep(Duration::from_micros(number * 7_919_000 % 150_000));
        child.kill().unwrap();
        child.wait().unwrap();

        let file = File::open(&history).unwrap();
        if let Ok(dataset) = file.dataset("row") {
            let rows: Vec<f64> = dataset.read_raw().unwrap();
            assert!(rows.len().is_multiple_of(20), "{} rows, not whole batches", rows.len());
            assert!(
                rows.iter().enumerate().all(|(number, &row)| row == number as f64),
                "rows are contiguous"
            );
            let wide: Vec<f64> = file.dataset("group/wide").unwrap().read_raw().unwrap();
            assert_eq!(wide.len(), 300 * rows.len());
            assert!(wide.chunks(300).zip(&rows).all(|(values, row)| values.iter().all(|value| value == row)));
            rows_in_all += rows.len();
        }
        let root = File::open(&fields).unwrap().group("VTKHDF").unwrap();
        let steps: i64 = root.group("Steps").unwrap().attr("NSteps").unwrap().read_scalar().unwrap();
        for step in (0..steps as usize).rev().take(4) {
            check_step(&root, step, &meshes[step / 3 % 2]);
        }
        steps_in_all += steps;
    }
    assert!(rows_in_all > 100 && steps_in_all > 10, "too little was written to show anything");
}
