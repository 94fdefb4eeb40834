//! The groups and datasets of the file, and rows appended to them.

use std::ops::Range;
use std::path::Path;

use hdf5::types::FixedAscii;
use hdf5::{Dataset, File, Group, H5Type};
use ndarray::ArrayView2;

use super::super::hdf5_attributes::{set_text, set_texts};
use super::chunks::{Chunks, Number};
use super::{CellMesh, End, FieldSpec, Storage};

/// Cells (or points) per chunk, 64 KiB of a scalar field.
const CHUNK_ROWS: usize = 8192;
/// Bytes of the largest chunk, of three components or of the points of the cells.
pub(super) const LARGEST_CHUNK: usize = 4 * CHUNK_ROWS * size_of::<f64>();
/// Rows made and compressed at once: enough chunks for some threads, few enough to need little memory.
const PIECE_ROWS: usize = 8 * CHUNK_ROWS;
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
pub(super) fn append_rows<T: Number>(dataset: &Dataset, values: &[T], row: usize) -> hdf5::Result<()> {
    let columns = dataset.shape().get(1).copied();
    let width = columns.unwrap_or(1).max(1);
    set_rows(dataset, row + values.len() / width)?;
    let mut start = row;
    for piece in values.chunks(PIECE_ROWS * width) {
        write_piece(dataset, columns, piece, start)?;
        start += piece.len() / width;
    }
    Ok(())
}

/// [`append_rows`] of so many rows that are made piece by piece: `make` adds the numbers of some of them to a list.
pub(super) fn append_made<T: Number>(
    dataset: &Dataset,
    rows: usize,
    row: usize,
    mut make: impl FnMut(Range<usize>, &mut Vec<T>),
) -> hdf5::Result<()> {
    let columns = dataset.shape().get(1).copied();
    set_rows(dataset, row + rows)?;
    let mut piece = Vec::new();
    for start in (0..rows).step_by(PIECE_ROWS) {
        piece.clear();
        make(start..(start + PIECE_ROWS).min(rows), &mut piece);
        write_piece(dataset, columns, &piece, row + start)?;
    }
    Ok(())
}

/// Writes some rows into a dataset of so many columns that has room for them: whole chunks by all threads, what is before and
/// after them through the library's filters.
fn write_piece<T: Number>(
    dataset: &Dataset,
    columns: Option<usize>,
    piece: &[T],
    start: usize,
) -> hdf5::Result<()> {
    let Some(chunks) = Chunks::of(dataset) else { return write_plainly(dataset, columns, piece, start) };
    let rows = piece.len() / chunks.width;
    let before = (start.next_multiple_of(chunks.rows) - start).min(rows);
    let whole = (rows - before) / chunks.rows * chunks.rows;
    let (first, rest) = piece.split_at(before * chunks.width);
    let (middle, last) = rest.split_at(whole * chunks.width);
    write_plainly(dataset, columns, first, start)?;
    chunks.write(dataset, middle, start + before)?;
    write_plainly(dataset, columns, last, start + before + whole)
}

/// Writes some rows through the library's filters.
fn write_plainly<T: H5Type>(
    dataset: &Dataset,
    columns: Option<usize>,
    piece: &[T],
    start: usize,
) -> hdf5::Result<()> {
    if piece.is_empty() {
        return Ok(());
    }
    match columns {
        None => dataset.write_slice(piece, start..start + piece.len()),
        Some(columns) => {
            let end = start + piece.len() / columns.max(1);
            let piece = ArrayView2::from_shape((end - start, columns), piece)?;
            dataset.write_slice(piece, ndarray::s![start..end, ..])
        }
    }
}

/// Cuts a dataset down to `rows` rows.
pub(super) fn set_rows(dataset: &Dataset, rows: usize) -> hdf5::Result<()> {
    match dataset.shape().get(1).copied() {
        None => dataset.resize(rows),
        Some(columns) => dataset.resize((rows, columns)),
    }
}

/// Writes a mesh at the place that `end` says is the last one's.
pub(super) fn write_mesh(root: &Group, mesh: &dyn CellMesh, end: &End) -> hdf5::Result<()> {
    let (points, cells) = (mesh.points(), mesh.cells());
    let start = end.last;
    append_rows(&root.dataset("NumberOfPoints")?, &[points as i64], start.meshes)?;
    append_rows(&root.dataset("NumberOfCells")?, &[cells as i64], start.meshes)?;
    append_rows(&root.dataset("NumberOfConnectivityIds")?, &[4 * cells as i64], start.meshes)?;
    append_made(&root.dataset("Points")?, points, start.points, |points, piece| {
        points.for_each(|point| piece.extend(mesh.point(point)));
    })?;
    append_made(&root.dataset("Connectivity")?, 4 * cells, start.connectivity, |corners, piece| {
        piece.extend(corners.map(|corner| mesh.corners(corner / 4)[corner % 4] as i64));
    })?;
    // Each mesh has one offset more than cells, so those of the earlier meshes fill one row more apiece.
    append_made(&root.dataset("Offsets")?, cells + 1, start.cells + start.meshes, |offsets, piece| {
        piece.extend(offsets.map(|cell| 4 * cell as i64));
    })?;
    append_made(&root.dataset("Types")?, cells, start.cells, |cells, piece| {
        piece.extend(cells.map(|_| VTK_QUAD));
    })
}

/// Says how many snapshots readers may look for.
pub(super) fn write_step_count(root: &Group, steps: usize) -> hdf5::Result<()> {
    root.group("Steps")?.attr("NSteps")?.write_scalar(&(steps as i64))
}
