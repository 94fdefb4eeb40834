//! Whole chunks, made by as many threads as there are.
//!
//! The HDF5 library serves one thread at a time, also while it compresses. So whole chunks go past its filters: they are
//! shuffled and deflated here as those filters do it, and readers see no difference.

use std::io::Write;

use bytemuck::NoUninit;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use hdf5::filters::Filter;
use hdf5::{Dataset, H5Type};
use hdf5_sys::h5::hsize_t;
use hdf5_sys::h5d::H5Dwrite_chunk;
use hdf5_sys::h5i::hid_t;
use hdf5_sys::h5p::H5P_DEFAULT;
use rayon::prelude::*;

/// What the rows of datasets are made of.
pub(super) trait Number: H5Type + NoUninit + Sync {}
impl<T: H5Type + NoUninit + Sync> Number for T {}

/// How a dataset's chunks are made.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chunks {
    /// Rows of each.
    pub rows: usize,
    /// Numbers of each row.
    pub width: usize,
    level: u8,
}

impl Chunks {
    /// Those of a dataset that are shuffled and deflated, and nothing else.
    pub(super) fn of(dataset: &Dataset) -> Option<Self> {
        let [Filter::Shuffle, Filter::Deflate(level)] = dataset.filters()[..] else { return None };
        let chunk = dataset.chunk()?;
        Some(Self { rows: *chunk.first()?, width: chunk.get(1).copied().unwrap_or(1), level })
    }

    /// Writes whole chunks from row `row` on, which begins one.
    pub(super) fn write<T: Number>(&self, dataset: &Dataset, values: &[T], row: usize) -> hdf5::Result<()> {
        let made: Vec<_> = (values.par_chunks_exact(self.rows * self.width))
            .map(|chunk| self.deflated(chunk))
            .collect::<std::io::Result<_>>()
            .map_err(|error| error.to_string())?;
        for (number, chunk) in made.iter().enumerate() {
            write_deflated(dataset.id(), row + number * self.rows, chunk)?;
        }
        Ok(())
    }

    /// The bytes of a chunk as they are in the file.
    fn deflated<T: NoUninit>(&self, values: &[T]) -> std::io::Result<Vec<u8>> {
        let bytes: &[u8] = bytemuck::cast_slice(values);
        let mut encoder =
            ZlibEncoder::new(Vec::with_capacity(bytes.len() / 2), Compression::new(self.level.into()));
        let mut shuffled = Vec::with_capacity(values.len());
        // The first bytes of all numbers, then their second ones, and so on.
        for byte in 0..size_of::<T>() {
            shuffled.clear();
            shuffled.extend(bytes.iter().skip(byte).step_by(size_of::<T>()));
            encoder.write_all(&shuffled)?;
        }
        encoder.finish()
    }
}

/// Writes the bytes of the chunk that begins with row `row`, past the filters.
fn write_deflated(dataset: hid_t, row: usize, chunk: &[u8]) -> hdf5::Result<()> {
    // Of the two numbers one is read where rows are single numbers.
    let offset = [row as hsize_t, 0];
    #[expect(unsafe_code, reason = "the safe interface does not have it")]
    // SAFETY: `sync` lets one thread at a time into the library. It reads `chunk.len()` bytes and one number or two of the
    // offset, as many as the dataset has dimensions, and refuses what is no dataset, or no chunk of one.
    let write = || unsafe {
        H5Dwrite_chunk(dataset, H5P_DEFAULT, 0, offset.as_ptr(), chunk.len(), chunk.as_ptr().cast())
    };
    hdf5::sync::sync(|| if write() < 0 { Err(hdf5::Error::query()?) } else { Ok(()) })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::layout::append_rows;
    use super::*;
    use hdf5::File;

    /// A dataset with chunks of eight rows, to which rows are added in several goes, as the library reads it.
    fn read_back<T: Number>(width: usize, goes: &[Vec<T>]) -> Vec<T> {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("file.h5");
        let file = File::create(&path).unwrap();
        let builder = file.new_dataset::<T>().shuffle().deflate(2);
        let dataset = match width {
            1 => builder.chunk((8,)).shape((0..,)).create("numbers"),
            _ => builder.chunk((8, width)).shape((0.., width)).create("numbers"),
        };
        let dataset = dataset.unwrap();
        assert_eq!(Chunks::of(&dataset).map(|chunks| (chunks.rows, chunks.width)), Some((8, width)));
        let mut rows = 0;
        for values in goes {
            append_rows(&dataset, values, rows).unwrap();
            rows += values.len() / width;
        }
        drop(dataset);
        file.close().unwrap();
        File::open(&path).unwrap().dataset("numbers").unwrap().read_raw().unwrap()
    }

    #[test]
    fn what_is_added_in_goes_of_any_length_is_read_as_it_was() {
        for width in [1, 3] {
            let mut next = 0u64;
            // Chunks begun, filled, gone through and met at their ends; numbers that compress and such that do not.
            let goes: Vec<Vec<f64>> = [3, 5, 8, 0, 21, 2, 1, 40]
                .map(|rows| {
                    let numbers = (0..rows * width).map(|_| {
                        next += 1;
                        let mixed = next.wrapping_mul(0x9E37_79B9_7F4A_7C15);
                        if next % 40 < 20 { next as f64 } else { f64::from_bits(mixed >> 2) }
                    });
                    numbers.collect()
                })
                .into();
            assert_eq!(read_back(width, &goes), goes.concat(), "{width}");
            let bytes: Vec<Vec<u8>> =
                goes.iter().map(|go| go.iter().map(|value| value.to_bits() as u8).collect()).collect();
            assert_eq!(read_back(width, &bytes), bytes.concat(), "{width}");
        }
    }

    #[test]
    fn chunks_that_are_not_there_to_be_written_are_errors_of_the_library() {
        let place = tempfile::tempdir().unwrap();
        let file = File::create(place.path().join("file.h5")).unwrap();
        let dataset =
            file.new_dataset::<f64>().shuffle().deflate(2).chunk((8,)).shape((0..,)).create("n").unwrap();
        assert!(write_deflated(dataset.id(), 8, &[0]).unwrap_err().to_string().contains("H5D"));
        assert!(write_deflated(file.id(), 0, &[0]).is_err());
        let plain = file.new_dataset::<f64>().shape((8,)).create("plain").unwrap();
        assert!(Chunks::of(&plain).is_none());
    }
}
