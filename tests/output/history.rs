//! Histories and their union.

use std::path::Path;
use std::time::{Duration, Instant};

use cav::output::{Column, HistoryFile, Join, OutputError, SeriesId, join_histories};
use hdf5::File;
use hdf5::types::VarLenUnicode;

fn column<'a>(name: &'a str, unit: &'a str, width: usize) -> Column<'a> {
    Column { name, unit, description: "of the test", width }
}

fn read(file: &File, path: &str) -> Vec<f64> {
    file.dataset(path).unwrap_or_else(|e| panic!("{path}: {e}")).read_raw().unwrap()
}

/// The fluid's side of a run: a series per step, one at intervals with a row per interface face, and a fixed grid.
fn fluid(path: &Path, steps: usize) -> (HistoryFile, SeriesId) {
    let mut file = HistoryFile::create(path, &[("case_hash", "1234")]).unwrap();
    let columns = [
        column("time", "s", 1),
        column("bubble/volume", "m3", 1),
        column("bubble/jet_velocity", "m/s", 1),
        column("conservation/fluid/mass", "kg", 1),
        column("probes/wall/pressure", "Pa", 1),
    ];
    let each_step = file.add_series("", &columns).unwrap();
    let interface =
        file.add_series("interface", &[column("time", "s", 1), column("pressure", "Pa", 4)]).unwrap();
    file.put("/interface/r", "m", "radius of the faces", &[0.5, 1.5, 2.5, 3.5]);
    for step in 0..steps {
        let t = step as f64;
        file.push(each_step, &[t, 10.0 * t, -t, 1.0, 1e5 + t]).unwrap();
        if step % 2 == 0 {
            file.push(interface, &[t, t, t + 0.1, t + 0.2, t + 0.3]).unwrap();
        }
    }
    file.flush().unwrap();
    (file, each_step)
}

fn solid(path: &Path, times: &[f64]) {
    let mut file = HistoryFile::create(path, &[("side", "solid")]).unwrap();
    let columns = [
        column("time", "s", 1),
        column("solid/von_mises_max", "Pa", 1),
        column("solid/von_mises_max_position", "m", 2),
        column("conservation/solid/mass", "kg", 1),
        column("probes/depth/stress_zz", "Pa", 1),
    ];
    let id = file.add_series("/", &columns).unwrap();
    for &t in times {
        file.push(id, &[t, 2.0 * t, 0.25, t, 7.0, -t]).unwrap();
    }
    file.flush().unwrap();
}

#[test]
fn wholes_of_planar_runs_are_per_metre_of_depth() {
    for (is_planar, units) in [(false, ["m3", "N s/rad", "Pa"]), (true, ["m2", "N s/m", "Pa"])] {
        let mut file = HistoryFile::in_memory().planar(is_planar);
        let columns =
            [column("volume", "m3", 1), column("momentum", "N s/rad", 1), column("pressure", "Pa", 1)];
        file.add_series("", &columns).unwrap();
        file.put("/mass", "kg", "mass", &[1.0]);
        let found: Vec<&str> = file.columns().map(|column| column.unit).collect();
        assert_eq!(found[1..], units, "{is_planar}");
        assert_eq!(found[0], if is_planar { "kg/m" } else { "kg" });
    }
}

#[test]
fn series_come_back_row_by_row_with_units_over_several_batches() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("fluid.h5");
    let (mut history, id) = fluid(&path, 5);
    history.push(id, &[5.0, 50.0, -5.0, 1.0, 1e5 + 5.0]).unwrap();
    assert_eq!(read(&File::open(&path).unwrap(), "/time").len(), 5, "a buffered row is not in the file");
    history.flush().unwrap();
    assert_eq!(history.rows(id), 6);

    let file = File::open(&path).unwrap();
    assert_eq!(read(&file, "/time"), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    assert_eq!(read(&file, "/bubble/volume"), [0.0, 10.0, 20.0, 30.0, 40.0, 50.0]);
    assert_eq!(read(&file, "/interface/r"), [0.5, 1.5, 2.5, 3.5]);
    assert_eq!(file.dataset("/interface/pressure").unwrap().shape(), [3, 4]);
    assert_eq!(read(&file, "/interface/pressure")[4..8], [2.0, 2.1, 2.2, 2.3]);
    let unit: VarLenUnicode =
        file.dataset("/probes/wall/pressure").unwrap().attr("units").unwrap().read_scalar().unwrap();
    assert_eq!(unit.as_str(), "Pa");
}

#[test]
fn a_row_of_the_wrong_length_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    let (mut history, id) = fluid(&directory.path().join("fluid.h5"), 1);
    let error = history.push(id, &[1.0, 2.0]).unwrap_err();
    assert!(matches!(error, OutputError::Length { found: 2, expected: 5, .. }), "{error}");
    assert_eq!(history.rows(id), 1);
}

#[test]
fn a_history_opened_again_is_continued_from_any_row_and_only_by_columns_that_fit() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("solid.h5");
    solid(&path, &[0.0, 1.0, 2.0, 3.0]);
    let mut history = HistoryFile::open(&path).unwrap();
    let columns = [column("time", "s", 1), column("solid/von_mises_max_position", "m", 2)];
    let id = history.add_series("", &columns).unwrap();
    assert_eq!(history.rows(id), 4);
    history.push(id, &[9.0, 9.0, 9.0]).unwrap();
    history.truncate(id, 2);
    history.push(id, &[2.5, 0.5, 0.75]).unwrap();
    history.flush().unwrap();
    let file = File::open(&path).unwrap();
    assert_eq!(read(&file, "/time"), [0.0, 1.0, 2.5]);
    assert_eq!(read(&file, "/solid/von_mises_max_position"), [0.25, 0.0, 0.25, 1.0, 0.5, 0.75]);

    let wide = history.add_series("", &[column("solid/von_mises_max", "Pa", 3)]);
    assert!(wide.unwrap_err().to_string().contains("/solid/von_mises_max"));
    let unequal = history.add_series("", &[column("time", "s", 1), column("solid/von_mises_max", "Pa", 1)]);
    assert!(matches!(unequal, Err(OutputError::Mismatch { .. })));
}

#[test]
fn batches_are_due_a_second_apart_at_the_earliest() {
    let directory = tempfile::tempdir().unwrap();
    let (mut history, id) = fluid(&directory.path().join("fluid.h5"), 1);
    history.push(id, &[0.0; 5]).unwrap();
    assert!(!history.flush_if_due().unwrap());
    // Later where the last one has cost more than 5 ms: on a busy machine.
    let start = Instant::now();
    while !history.flush_if_due().unwrap() {
        assert!(start.elapsed() < Duration::from_secs(60));
        std::thread::sleep(Duration::from_millis(20));
    }
    assert!(start.elapsed() > Duration::from_millis(900));
    assert!(!history.is_flush_due());
}

#[test]
fn joined_histories_show_both_sides_by_links_and_by_copies() {
    let directory = tempfile::tempdir().unwrap();
    let run = directory.path().join("run");
    std::fs::create_dir(&run).unwrap();
    let (mut history, id) = fluid(&run.join("fluid.h5"), 5);
    solid(&run.join("solid.h5"), &[0.0, 1.0, 2.0]);
    let parts = ["fluid.h5", "solid.h5", "none.h5"];
    let check = |path: &Path, rows: usize| {
        let file = File::open(path).unwrap();
        assert_eq!(read(&file, "/time").len(), rows);
        assert_eq!(read(&file, "/bubble/jet_velocity").len(), rows);
        assert_eq!(read(&file, "/conservation/fluid/mass").len(), rows);
        assert_eq!(read(&file, "/conservation/solid/mass"), [7.0; 3]);
        assert_eq!(read(&file, "/solid/von_mises_max"), [0.0, 2.0, 4.0]);
        assert_eq!(read(&file, "/probes/wall/pressure").len(), rows);
        assert_eq!(read(&file, "/probes/depth/stress_zz"), [0.0, -1.0, -2.0]);
        assert_eq!(read(&file, "/interface/r").len(), 4);
        let dataset = file.dataset("/probes/depth/stress_zz").unwrap();
        assert_eq!(dataset.attr("units").unwrap().read_scalar::<VarLenUnicode>().unwrap().as_str(), "Pa");
        assert!(file.attr("case_hash").is_ok() && file.attr("side").is_ok());
    };

    assert!(join_histories(&run, &parts, Join::Links).unwrap().is_empty());
    check(&run.join("history.h5"), 5);
    history.push(id, &[5.0; 5]).unwrap();
    history.flush().unwrap();
    check(&run.join("history.h5"), 6);
    let moved = directory.path().join("moved");
    std::fs::rename(&run, &moved).unwrap();
    check(&moved.join("history.h5"), 6);

    assert!(join_histories(&moved, &parts, Join::Copy).unwrap().is_empty());
    let alone = directory.path().join("alone.h5");
    std::fs::copy(moved.join("history.h5"), &alone).unwrap();
    std::fs::remove_dir_all(&moved).unwrap();
    check(&alone, 6);
}

#[test]
fn a_dataset_that_both_sides_have_and_that_differs_is_reported() {
    let directory = tempfile::tempdir().unwrap();
    drop(fluid(&directory.path().join("fluid.h5"), 5));
    solid(&directory.path().join("solid.h5"), &[0.0, 1.0, 2.5]);
    for how in [Join::Links, Join::Copy] {
        let differing = join_histories(directory.path(), &["fluid.h5", "solid.h5"], how).unwrap();
        assert_eq!(differing, ["/time"]);
        let file = File::open(directory.path().join("history.h5")).unwrap();
        assert_eq!(read(&file, "/time").len(), 5);
    }
}
