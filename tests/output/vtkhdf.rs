//! Snapshots.

use cav::output::{OutputError, OwnedQuadMesh, SeriesWriter};
use hdf5::types::{FixedAscii, VarLenUnicode};
use hdf5::{File, Group};

use crate::snapshots::{FIELDS, check_step, integers, squares, values};

fn append(writer: &mut SeriesWriter, mesh: &OwnedQuadMesh, mesh_id: u64) -> Result<(), OutputError> {
    let step = writer.steps();
    let values = values(mesh.quads.len(), step);
    let slices: Vec<&[f64]> = values.iter().map(|field| &field[..]).collect();
    writer.append(0.5 * step as f64, mesh, mesh_id, &slices)
}

fn step_count(root: &Group) -> i64 {
    root.group("Steps").unwrap().attr("NSteps").unwrap().read_scalar().unwrap()
}

#[test]
fn snapshots_on_a_changing_mesh_are_read_back_by_the_rules_of_the_format() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("fluid.vtkhdf");
    let (coarse, fine) = (squares(4, 4), squares(8, 8));
    // Mesh 2 is the coarse one again, but under a new number it is a new mesh.
    let meshes = [(&coarse, 0), (&coarse, 0), (&fine, 1), (&fine, 1), (&coarse, 2)];
    for compression in [0, 4] {
        let mut writer =
            SeriesWriter::create(&path, &FIELDS, compression, &[("case_hash", "abc µ")]).unwrap();
        for (mesh, mesh_id) in meshes {
            append(&mut writer, mesh, mesh_id).unwrap();
        }
        let file = File::open(&path).unwrap();
        let root = file.group("VTKHDF").unwrap();
        assert_eq!(step_count(&root), 5);
        assert_eq!(integers(&root, "NumberOfCells"), [16, 64, 16], "a mesh is stored once");
        for (step, (mesh, _)) in meshes.iter().enumerate() {
            check_step(&root, step, mesh);
        }
        let times: Vec<f64> = root.dataset("Steps/Values").unwrap().read_raw().unwrap();
        assert_eq!(times, [0.0, 0.5, 1.0, 1.5, 2.0]);
        assert_eq!(root.attr("Version").unwrap().read_raw::<i64>().unwrap(), [2, 2]);
        let kind: FixedAscii<16> = root.attr("Type").unwrap().read_scalar().unwrap();
        assert_eq!(kind.as_str(), "UnstructuredGrid");
        let text = |location: &hdf5::Location, name: &str| -> String {
            location.attr(name).unwrap().read_scalar::<VarLenUnicode>().unwrap().to_string()
        };
        assert_eq!(text(&file, "case_hash"), "abc µ");
        assert_eq!(text(&root.dataset("CellData/pressure").unwrap(), "units"), "Pa");
        assert_eq!(text(&root.dataset("CellData/velocity").unwrap(), "description"), "z, r, 0");
        assert!(root.dataset("CellData/level").unwrap().dtype().unwrap().is::<u8>());
    }
}

#[test]
fn what_is_cut_off_leaves_nothing_behind() {
    let directory = tempfile::tempdir().unwrap();
    let (coarse, fine) = (squares(20, 30), squares(50, 40));
    let paths = ["straight", "cut"].map(|name| directory.path().join(name));
    for (path, detour) in paths.iter().zip([false, true]) {
        let mut writer = SeriesWriter::create(path, &FIELDS, 1, &[]).unwrap();
        append(&mut writer, &coarse, 3).unwrap();
        if detour {
            append(&mut writer, &fine, 4).unwrap();
            append(&mut writer, &coarse, 5).unwrap();
            drop(writer);
            writer = SeriesWriter::open(path).unwrap();
            writer.truncate(1).unwrap();
            writer = writer.with_mesh(Some(3));
        }
        // On the mesh of the first snapshot, which is not stored again.
        append(&mut writer, &coarse, 3).unwrap();
        assert!(writer.truncate(3).is_err(), "there are only two");
    }
    let [straight, cut] = paths.map(|path| {
        let root = File::open(path).unwrap().group("VTKHDF").unwrap();
        let shape = |name: &str| (name.to_owned(), root.dataset(name).unwrap().shape());
        let names = [
            "NumberOfPoints",
            "NumberOfCells",
            "NumberOfConnectivityIds",
            "Points",
            "Connectivity",
            "Offsets",
        ];
        let of_steps =
            ["Types", "CellData/velocity", "CellData/level", "Steps/Values", "Steps/CellDataOffsets/level"];
        names.into_iter().chain(of_steps).map(shape).collect::<Vec<_>>()
    });
    assert_eq!(straight, cut);
}

#[test]
fn a_long_file_spoilt_by_a_kill_is_as_it_was_at_the_last_checkpoint() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("fluid.vtkhdf");
    let beside = |suffix: &str| directory.path().join(format!("fluid.vtkhdf{suffix}"));
    let mesh = squares(20, 30);
    let mut writer = SeriesWriter::create(&path, &FIELDS, 1, &[]).unwrap().with_copy_limit(0);
    append(&mut writer, &mesh, 0).unwrap();
    append(&mut writer, &mesh, 0).unwrap();
    assert!(!beside(".before").exists(), "nobody counts on it yet");
    writer.count_on_it();
    append(&mut writer, &mesh, 0).unwrap();
    append(&mut writer, &mesh, 0).unwrap();
    assert!(beside(".before").exists() && !beside(".changing").exists());
    drop(writer);

    // Killed in the middle of a change.
    let length = std::fs::metadata(&path).unwrap().len();
    std::fs::OpenOptions::new().write(true).open(&path).unwrap().set_len(length / 2).unwrap();
    std::fs::write(beside(".changing"), b"").unwrap();
    let mut writer = SeriesWriter::open(&path).unwrap();
    assert_eq!(writer.steps(), 2, "as many as the checkpoint counts on");
    append(&mut writer, &mesh, 1).unwrap();
    let root = File::open(&path).unwrap().group("VTKHDF").unwrap();
    (0..3).for_each(|step| check_step(&root, step, &mesh));
    assert!(!beside(".changing").exists());
    writer.finish().unwrap();
    assert!(!beside(".before").exists());

    // Without a version of before there is nothing to go on from, and that is said.
    std::fs::write(beside(".changing"), b"").unwrap();
    let error = SeriesWriter::open(&path).expect_err("half changed");
    assert!(error.to_string().contains("whole version"), "{error}");
}

#[test]
fn a_file_opened_again_goes_on_where_it_or_an_earlier_snapshot_ends() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("solid.vtkhdf");
    let (coarse, fine) = (squares(2, 3), squares(5, 4));
    let mut writer = SeriesWriter::create(&path, &FIELDS, 1, &[]).unwrap();
    for (mesh, mesh_id) in [(&coarse, 0), (&fine, 1), (&fine, 1)] {
        append(&mut writer, mesh, mesh_id).unwrap();
    }
    drop(writer);

    let mut writer = SeriesWriter::open(&path).unwrap();
    assert_eq!(writer.steps(), 3);
    append(&mut writer, &coarse, 1).unwrap();
    for (step, mesh) in [&coarse, &fine, &fine, &coarse].into_iter().enumerate() {
        check_step(&File::open(&path).unwrap().group("VTKHDF").unwrap(), step, mesh);
    }

    writer.truncate(1).unwrap();
    append(&mut writer, &fine, 7).unwrap();
    append(&mut writer, &fine, 7).unwrap();
    let root = File::open(&path).unwrap().group("VTKHDF").unwrap();
    assert_eq!(step_count(&root), 3);
    for (step, mesh) in [&coarse, &fine, &fine].into_iter().enumerate() {
        check_step(&root, step, mesh);
    }
    assert_eq!(integers(&root, "NumberOfCells"), [6, 20], "the meshes forgotten are overwritten");

    let mut writer = SeriesWriter::open(&path).unwrap();
    writer.truncate(0).unwrap();
    append(&mut writer, &coarse, 0).unwrap();
    check_step(&File::open(&path).unwrap().group("VTKHDF").unwrap(), 0, &coarse);
}

#[test]
fn wrong_lengths_are_refused_and_leave_the_file_as_it_was() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("fluid.vtkhdf");
    let mesh = squares(2, 2);
    let mut writer = SeriesWriter::create(&path, &FIELDS, 1, &[]).unwrap();
    append(&mut writer, &mesh, 0).unwrap();
    let before = std::fs::read(&path).unwrap();
    let short = writer.append(1.0, &mesh, 0, &vec![[1.0; 4]; 3]);
    let message = short.unwrap_err().to_string();
    assert!(message.contains("field velocity") && message.contains("12"), "{message}");
    assert!(writer.append(1.0, &mesh, 0, &vec![[1.0; 4]]).is_err());
    assert_eq!(std::fs::read(&path).unwrap(), before);
    assert_eq!(writer.steps(), 1);
}

#[test]
fn a_file_that_cannot_be_made_or_is_gone_is_named() {
    let directory = tempfile::tempdir().unwrap();
    let missing = directory.path().join("missing").join("fluid.vtkhdf");
    let message = SeriesWriter::create(&missing, &FIELDS, 1, &[]).unwrap_err().to_string();
    assert!(message.contains("missing/fluid.vtkhdf"), "{message}");
    let path = directory.path().join("fluid.vtkhdf");
    let mut writer = SeriesWriter::create(&path, &FIELDS, 1, &[]).unwrap();
    std::fs::remove_file(&path).unwrap();
    let error = append(&mut writer, &squares(2, 2), 0).unwrap_err();
    assert!(matches!(error, OutputError::Io { .. }) && error.to_string().contains("--out"), "{error}");
    assert!(SeriesWriter::open(&path).is_err());
}

#[test]
fn a_long_file_is_extended_in_place_unless_somebody_reads_it() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("fluid.vtkhdf");
    let inode = || std::os::unix::fs::MetadataExt::ino(&std::fs::metadata(&path).unwrap());
    let mesh = squares(3, 3);
    let mut writer = SeriesWriter::create(&path, &FIELDS, 1, &[]).unwrap().with_copy_limit(0);
    let first = inode();
    append(&mut writer, &mesh, 0).unwrap();
    assert_eq!(inode(), first, "in place");

    let reader = File::open(&path).unwrap();
    append(&mut writer, &mesh, 0).unwrap();
    assert_ne!(inode(), first, "in a copy");
    assert_eq!(step_count(&reader.group("VTKHDF").unwrap()), 1, "the reader is not disturbed");
    drop(reader);
    for step in 0..2 {
        check_step(&File::open(&path).unwrap().group("VTKHDF").unwrap(), step, &mesh);
    }
}
