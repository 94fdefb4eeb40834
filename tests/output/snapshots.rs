//! Snapshots to write, and how they must be found in the file.

use cav::output::{FieldSpec, OwnedQuadMesh, Storage};
use hdf5::Group;

/// A mesh of `nx` by `ny` unit squares that share their corners.
pub fn squares(nx: usize, ny: usize) -> OwnedQuadMesh {
    let points = (0..=ny).flat_map(|j| (0..=nx).flat_map(move |i| [i as f64, j as f64, 0.0])).collect();
    let corner = |i: usize, j: usize| j * (nx + 1) + i;
    let quads = (0..ny)
        .flat_map(|j| (0..nx).map(move |i| (i, j)))
        .map(|(i, j)| [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)])
        .collect();
    OwnedQuadMesh { points, quads }
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

pub fn integers(group: &Group, name: &str) -> Vec<i64> {
    group.dataset(name).unwrap().read_raw().unwrap()
}

/// Reads snapshot `step` by the rules of the format and compares it with [`values`] on `mesh`.
pub fn check_step(root: &Group, step: usize, mesh: &OwnedQuadMesh) {
    let steps = root.group("Steps").unwrap();
    let part = integers(&steps, "PartOffsets")[step] as usize;
    assert_eq!(integers(&steps, "NumberOfParts")[step], 1);
    let cells = integers(root, "NumberOfCells")[part] as usize;
    let points = integers(root, "NumberOfPoints")[part] as usize;
    assert_eq!((cells, points), (mesh.quads.len(), mesh.points.len() / 3), "size of mesh {part}");
    assert_eq!(integers(root, "NumberOfConnectivityIds")[part] as usize, 4 * cells);

    let point = integers(&steps, "PointOffsets")[step] as usize;
    let stored: Vec<f64> = root.dataset("Points").unwrap().read_raw().unwrap();
    assert_eq!(stored[3 * point..3 * (point + points)], mesh.points);
    let cell = integers(&steps, "CellOffsets")[step] as usize;
    let offsets = integers(root, "Offsets");
    let offsets = &offsets[cell + part..=cell + part + cells];
    let connectivity = integers(root, "Connectivity");
    let connectivity = &connectivity[integers(&steps, "ConnectivityIdOffsets")[step] as usize..];
    for (number, quad) in mesh.quads.iter().enumerate() {
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
