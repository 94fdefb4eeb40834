//! Snapshots.

use cav::output::{FieldSpec, OutputError, QuadMesh, SeriesWriter, Storage};
use hdf5::types::{FixedAscii, VarLenUnicode};
use hdf5::{File, Group};

/// A mesh of `nx` by `ny` unit squares that share their corners.
pub struct Squares {
    pub points: Vec<f64>,
    pub quads: Vec<[usize; 4]>,
}

impl Squares {
    pub fn new(nx: usize, ny: usize) -> Self {
        let points = (0..=ny).flat_map(|j| (0..=nx).flat_map(move |i| [i as f64, j as f64, 0.0])).collect();
        let corner = |i: usize, j: usize| j * (nx + 1) + i;
        let quads = (0..ny)
            .flat_map(|j| (0..nx).map(move |i| (i, j)))
            .map(|(i, j)| [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)])
            .collect();
        Self { points, quads }
    }

    pub fn mesh(&self) -> QuadMesh<'_> {
        QuadMesh { points: &self.points, quads: &self.quads }
    }
}

pub const FIELDS: [FieldSpec<'static>; 3] = [
    FieldSpec {
        name: "pressure",
        components: 1,
        unit: "Pa",
        description: "mixture pressure",
        storage: Storage::F64,
    },
    FieldSpec { name: "velocity", components: 3, unit: "m/s", description: "z, r, 0", storage: Storage::F64 },
    FieldSpec { name: "level", components: 1, unit: "1", description: "level", storage: Storage::U8 },
];

/// Values of [`FIELDS`] that differ from cell to cell and from snapshot to snapshot.
pub fn values(cells: usize, step: usize) -> [Vec<f64>; 3] {
    let pressure = (0..cells).map(|cell| 1e5 * step as f64 + cell as f64).collect();
    let velocity = (0..3 * cells).map(|entry| entry as f64 - 0.5 * step as f64).collect();
    [pressure, velocity, (0..cells).map(|cell| ((cell + step) % 7) as f64).collect()]
}

pub fn append(writer: &mut SeriesWriter, squares: &Squares, mesh_id: u64) -> Result<(), OutputError> {
    let step = writer.steps();
    let values = values(squares.quads.len(), step);
    let slices: Vec<&[f64]> = values.iter().map(|field| &field[..]).collect();
    writer.append(0.5 * step as f64, &squares.mesh(), mesh_id, &slices)
}

fn integers(group: &Group, name: &str) -> Vec<i64> {
    group.dataset(name).unwrap().read_raw().unwrap()
}

/// Reads snapshot `step` by the rules of the format and compares it with what [`append`] wrote on `squares`.
pub fn check_step(root: &Group, step: usize, squares: &Squares) {
    let steps = root.group("Steps").unwrap();
    let part = integers(&steps, "PartOffsets")[step] as usize;
    assert_eq!(integers(&steps, "NumberOfParts")[step], 1);
    let cells = integers(root, "NumberOfCells")[part] as usize;
    let points = integers(root, "NumberOfPoints")[part] as usize;
    assert_eq!((cells, points), (squares.quads.len(), squares.points.len() / 3), "size of mesh {part}");
    assert_eq!(integers(root, "NumberOfConnectivityIds")[part] as usize, 4 * cells);

    let point = integers(&steps, "PointOffsets")[step] as usize;
    let stored: Vec<f64> = root.dataset("Points").unwrap().read_raw().unwrap();
    assert_eq!(stored[3 * point..3 * (point + points)], squares.points);
    let cell = integers(&steps, "CellOffsets")[step] as usize;
    let offsets = integers(root, "Offsets");
    let offsets = &offsets[cell + part..=cell + part + cells];
    let connectivity = integers(root, "Connectivity");
    let connectivity = &connectivity[integers(&steps, "ConnectivityIdOffsets")[step] as usize..];
    for (number, quad) in squares.quads.iter().enumerate() {
        let corners = &connectivity[offsets[number] as usize..offsets[number + 1] as usize];
        assert!(corners.iter().map(|&corner| corner as usize).eq(*quad), "cell {number}: {corners:?}");
    }
    let types: Vec<u8> = root.dataset("Types").unwrap().read_raw().unwrap();
    assert!(types[cell..cell + cells].iter().all(|&kind| kind == 9));

    for (field, expected) in FIELDS.iter().zip(values(cells, step)) {
        let offset = integers(&steps.group("CellDataOffsets").unwrap(), field.name)[step] as usize;
        let data = root.group("CellData").unwrap().dataset(field.name).unwrap();
        let stored: Vec<f64> = data.as_reader().read_raw().unwrap();
        let range = offset * field.components..(offset + cells) * field.components;
        assert_eq!(stored[range], expected, "{} of snapshot {step}", field.name);
    }
}

fn step_count(root: &Group) -> i64 {
    root.group("Steps").unwrap().attr("NSteps").unwrap().read_scalar().unwrap()
}

#[test]
fn snapshots_on_a_changing_mesh_are_read_back_by_the_rules_of_the_format() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("fluid.vtkhdf");
    let (coarse, fine) = (Squares::new(4, 4), Squares::new(8, 8));
    // Mesh 2 is the coarse one again, but under a new number it is a new mesh.
    let meshes = [(&coarse, 0), (&coarse, 0), (&fine, 1), (&fine, 1), (&coarse, 2)];
    for compression in [0, 4] {
        let mut writer =
            SeriesWriter::create(&path, &FIELDS, compression, &[("case_hash", "abc µ")]).unwrap();
        for (squares, mesh_id) in meshes {
            append(&mut writer, squares, mesh_id).unwrap();
        }
        let file = File::open(&path).unwrap();
        let root = file.group("VTKHDF").unwrap();
        assert_eq!(step_count(&root), 5);
        assert_eq!(integers(&root, "NumberOfCells"), [16, 64, 16], "a mesh is stored once");
        for (step, (squares, _)) in meshes.iter().enumerate() {
            check_step(&root, step, squares);
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
fn a_file_opened_again_goes_on_where_it_or_an_earlier_snapshot_ends() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("solid.vtkhdf");
    let (coarse, fine) = (Squares::new(2, 3), Squares::new(5, 4));
    let mut writer = SeriesWriter::create(&path, &FIELDS, 1, &[]).unwrap();
    for (squares, mesh_id) in [(&coarse, 0), (&fine, 1), (&fine, 1)] {
        append(&mut writer, squares, mesh_id).unwrap();
    }
    drop(writer);

    let mut writer = SeriesWriter::open(&path).unwrap();
    assert_eq!(writer.steps(), 3);
    append(&mut writer, &coarse, 1).unwrap();
    for (step, squares) in [&coarse, &fine, &fine, &coarse].into_iter().enumerate() {
        check_step(&File::open(&path).unwrap().group("VTKHDF").unwrap(), step, squares);
    }

    writer.truncate(1).unwrap();
    append(&mut writer, &fine, 7).unwrap();
    append(&mut writer, &fine, 7).unwrap();
    let root = File::open(&path).unwrap().group("VTKHDF").unwrap();
    assert_eq!(step_count(&root), 3);
    for (step, squares) in [&coarse, &fine, &fine].into_iter().enumerate() {
        check_step(&root, step, squares);
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
    let squares = Squares::new(2, 2);
    let mut writer = SeriesWriter::create(&path, &FIELDS, 1, &[]).unwrap();
    append(&mut writer, &squares, 0).unwrap();
    let before = std::fs::read(&path).unwrap();
    let short = writer.append(1.0, &squares.mesh(), 0, &[&[1.0; 4], &[1.0; 4], &[1.0; 4]]);
    let message = short.unwrap_err().to_string();
    assert!(message.contains("field velocity") && message.contains("12"), "{message}");
    assert!(writer.append(1.0, &squares.mesh(), 0, &[&[1.0; 4]]).is_err());
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
    let error = append(&mut writer, &Squares::new(2, 2), 0).unwrap_err();
    assert!(matches!(error, OutputError::Io { .. }) && error.to_string().contains("--out"), "{error}");
    assert!(SeriesWriter::open(&path).is_err());
}

#[test]
fn a_long_file_is_extended_in_place_unless_somebody_reads_it() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("fluid.vtkhdf");
    let inode = || std::os::unix::fs::MetadataExt::ino(&std::fs::metadata(&path).unwrap());
    let squares = Squares::new(3, 3);
    let mut writer = SeriesWriter::create(&path, &FIELDS, 1, &[]).unwrap().with_copy_limit(0);
    let first = inode();
    append(&mut writer, &squares, 0).unwrap();
    assert_eq!(inode(), first, "in place");

    let reader = File::open(&path).unwrap();
    append(&mut writer, &squares, 0).unwrap();
    assert_ne!(inode(), first, "in a copy");
    assert_eq!(step_count(&reader.group("VTKHDF").unwrap()), 1, "the reader is not disturbed");
    drop(reader);
    for step in 0..2 {
        check_step(&File::open(&path).unwrap().group("VTKHDF").unwrap(), step, &squares);
    }
}
