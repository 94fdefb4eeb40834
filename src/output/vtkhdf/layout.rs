//! The groups and datasets of the file, and rows appended to them.

use std::path::Path;

use hdf5::types::FixedAscii;
use hdf5::{Dataset, File, Group, H5Type};
use ndarray::ArrayView2;

use super::super::hdf5_attributes::{set_text, set_texts};
use super::{End, FieldSpec, QuadMesh, Storage};

/// Cells (or points) per chunk, 64 KiB of a scalar field.
const CHUNK_ROWS: usize = 8192;
/// Bytes of the largest chunk, of three components or of the points of the cells.
pub(super) const LARGEST_CHUNK: usize = 4 * CHUNK_ROWS * size_of::<f64>();
/// Rows written in one call of the HDF5 library, which serves one thread at a time: so many chunks that are compressed
/// before another thread has its turn.
const PIECE_ROWS: usize = 4 * CHUNK_ROWS;
/// Steps per chunk of the small datasets that have one entry per step or mesh.
const CHUNK_STEPS: usize = 64;
/// VTK's number of the quadrilateral cell type.
const VTK_QUAD: u8 = 9;

/// Makes the file with all its datasets, which are empty.
pub(super) fn create_datasets(
    path: &Path,
    fields: &[FieldSpec<'_>],
    compression: u8,
    attributes: &[(&str, &str)],
) -> hdf5::Result<()> {
    let file = File::create(path)?;
    set_texts(&file, attributes)?;
    let root = file.create_group("VTKHDF")?;
    root.new_attr_builder().with_data(&[2i64, 2]).create("Version")?;
    // Readers of VTK 9.2 and 9.3 want the type as a text of fixed length.
    let kind = FixedAscii::<16>::from_ascii("UnstructuredGrid").map_err(|e| e.to_string())?;
    root.new_attr::<FixedAscii<16>>().create("Type")?.write_scalar(&kind)?;
    let order: Vec<&str> = fields.iter().map(|field| field.name).collect();
    set_text(&root, "FieldOrder", &order.join(" "))?;

    for name in ["NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"] {
        create_dataset::<i64>(&root, name, 0, CHUNK_STEPS, 0)?;
    }
    create_dataset::<f64>(&root, "Points", 3, CHUNK_ROWS, compression)?;
    create_dataset::<i64>(&root, "Connectivity", 0, 4 * CHUNK_ROWS, compression)?;
    create_dataset::<i64>(&root, "Offsets", 0, CHUNK_ROWS, compression)?;
    create_dataset::<u8>(&root, "Types", 0, CHUNK_ROWS, compression)?;

    let data = root.create_group("CellData")?;
    for field in fields {
        let columns = if field.components == 1 { 0 } else { field.components };
        let dataset = match field.storage {
            Storage::F64 => create_dataset::<f64>(&data, field.name, columns, CHUNK_ROWS, compression)?,
            Storage::U8 => create_dataset::<u8>(&data, field.name, columns, CHUNK_ROWS, compression)?,
        };
        set_text(&dataset, "units", field.unit)?;
        set_text(&dataset, "description", field.description)?;
    }

    let steps = root.create_group("Steps")?;
    steps.new_attr::<i64>().create("NSteps")?.write_scalar(&0)?;
    create_dataset::<f64>(&steps, "Values", 0, CHUNK_STEPS, 0)?;
    for name in ["PartOffsets", "NumberOfParts", "PointOffsets"] {
        create_dataset::<i64>(&steps, name, 0, CHUNK_STEPS, 0)?;
    }
    // One column per kind of topology, and an unstructured grid has one.
    for name in ["CellOffsets", "ConnectivityIdOffsets"] {
        create_dataset::<i64>(&steps, name, 1, CHUNK_STEPS, 0)?;
    }
    let offsets = steps.create_group("CellDataOffsets")?;
    for field in fields {
        create_dataset::<i64>(&offsets, field.name, 0, CHUNK_STEPS, 0)?;
    }
    file.close()
}

/// Makes an empty dataset that grows in its rows: of shape (rows,) for `columns` = 0, else (rows, columns).
fn create_dataset<T: H5Type>(
    group: &Group,
    name: &str,
    columns: usize,
    chunk_rows: usize,
    compression: u8,
) -> hdf5::Result<Dataset> {
    let mut builder = group.new_dataset::<T>();
    if compression > 0 {
        builder = builder.shuffle().deflate(compression.min(9));
    }
    match columns {
        0 => builder.chunk((chunk_rows,)).shape((0..,)).create(name),
        _ => builder.chunk((chunk_rows, columns)).shape((0.., columns)).create(name),
    }
}

/// Writes `values` from row `row` on and ends the dataset with them.
pub(super) fn append_rows<T: H5Type>(dataset: &Dataset, values: &[T], row: usize) -> hdf5::Result<()> {
    let columns = dataset.shape().get(1).copied();
    let width = columns.unwrap_or(1).max(1);
    set_rows(dataset, row + values.len() / width)?;
    let mut start = row;
    for piece in values.chunks(PIECE_ROWS * width) {
        let end = start + piece.len() / width;
        match columns {
            None => dataset.write_slice(piece, start..end)?,
            Some(columns) => {
                let piece = ArrayView2::from_shape((end - start, columns), piece)?;
                dataset.write_slice(piece, ndarray::s![start..end, ..])?;
            }
        }
        start = end;
    }
    Ok(())
}

/// Cuts a dataset down to `rows` rows.
pub(super) fn set_rows(dataset: &Dataset, rows: usize) -> hdf5::Result<()> {
    match dataset.shape().get(1).copied() {
        None => dataset.resize(rows),
        Some(columns) => dataset.resize((rows, columns)),
    }
}

/// Writes a mesh at the place that `end` says is the last one's.
pub(super) fn write_mesh(root: &Group, mesh: &QuadMesh<'_>, end: &End) -> hdf5::Result<()> {
    let cells = mesh.quads.len();
    let start = end.last;
    append_rows(&root.dataset("NumberOfPoints")?, &[(mesh.points.len() / 3) as i64], start.meshes)?;
    append_rows(&root.dataset("NumberOfCells")?, &[cells as i64], start.meshes)?;
    append_rows(&root.dataset("NumberOfConnectivityIds")?, &[4 * cells as i64], start.meshes)?;
    append_rows(&root.dataset("Points")?, mesh.points, start.points)?;
    let connectivity: Vec<i64> = mesh.quads.iter().flatten().map(|&point| point as i64).collect();
    append_rows(&root.dataset("Connectivity")?, &connectivity, start.connectivity)?;
    // Each mesh has one offset more than cells, so those of the earlier meshes fill one row more apiece.
    let offsets: Vec<i64> = (0..=cells).map(|cell| 4 * cell as i64).collect();
    append_rows(&root.dataset("Offsets")?, &offsets, start.cells + start.meshes)?;
    append_rows(&root.dataset("Types")?, &vec![VTK_QUAD; cells], start.cells)
}

/// Says how many snapshots readers may look for.
pub(super) fn write_step_count(root: &Group, steps: usize) -> hdf5::Result<()> {
    root.group("Steps")?.attr("NSteps")?.write_scalar(&(steps as i64))
}
