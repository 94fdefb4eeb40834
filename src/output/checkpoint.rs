//! The file of a checkpoint: a head that says what it belongs to, the state, and a checksum over both.
//!
//! | bytes | are |
//! |---|---|
//! | 8 | `cav\0ckpt` |
//! | 4 | [`VERSION`], little-endian |
//! | 32 | [`layout`](super::layout) of what follows |
//! | … | [`Head`], then the state, as [`postcard`] writes them |
//! | 32 | SHA-256 of all before |
//!
//! The file is made beside its place, brought to the disk and renamed, so a name always stands for a whole checkpoint,
//! also after a loss of power.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::layout::layout;
use super::{OutputError, safe_file};

/// Format of the file and meaning of what states hold; a change of either counts it up. Names and types of what they hold need
/// nobody's care, see [`layout_of`].
pub const VERSION: u32 = 10;

const MAGIC: [u8; 8] = *b"cav\0ckpt";
const CHECKSUM: usize = 32;
const LAYOUT: usize = 32;
const SHORTEST: usize = MAGIC.len() + 4 + LAYOUT + CHECKSUM;

/// What a checkpoint belongs to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Head {
    /// Version and revision of the program.
    pub program: String,
    /// SHA-256 of the effective case.
    pub case: [u8; 32],
    /// Which side's.
    pub side: String,
    /// Number of the step before which it was taken.
    pub step: u64,
}

impl Head {
    /// Of this program.
    pub fn of(case: [u8; 32], side: &str, step: u64) -> Self {
        let program = format!("{} {}", env!("CARGO_PKG_VERSION"), env!("CAV_GIT_REVISION"));
        Self { program, case, side: side.to_owned(), step }
    }
}

/// Why a file is no checkpoint that can be used.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointFault {
    /// It cannot be read.
    #[error("it cannot be read: {0}")]
    Unreadable(#[from] io::Error),
    /// It cannot be written.
    #[error("it cannot be written: {0}")]
    Unwritable(#[from] OutputError),
    /// It is something else.
    #[error("it is no checkpoint")]
    Foreign,
    /// It was written by another version.
    #[error("its format is {found}, this program's is {VERSION}")]
    Version {
        /// Its format.
        found: u32,
    },
    /// It was written by a program in which the state has other fields.
    #[error(
        "what it holds has other names or types than in this program, so another version has written it: go on with that one"
    )]
    Layout,
    /// It is not what was written.
    #[error("it is damaged: its checksum does not fit")]
    Damaged,
    /// Its content makes no sense to this program.
    #[error("it holds something else than this program writes")]
    Undecodable,
}

/// The layout of a checkpoint with a state of this type.
#[must_use]
pub fn layout_of<T: DeserializeOwned>() -> [u8; LAYOUT] {
    layout::<(Head, T)>()
}

/// Writes a checkpoint.
pub fn write<T: Serialize + DeserializeOwned>(
    path: &Path,
    head: &Head,
    state: &T,
) -> Result<(), OutputError> {
    safe_file::replace(path, |temporary| {
        let file = File::create(temporary).map_err(OutputError::io(path, "make the checkpoint"))?;
        put(file, head, state).map_err(OutputError::io(path, "write the checkpoint"))
    })?;
    // The new name, too.
    path.parent().map_or(Ok(()), safe_file::sync)
}

/// Bytes that wait to be written. So few that they fit between what is in use: a buffer of a megabyte made the memory of a
/// process larger with some checkpoint or other, by as much of it as was filled.
const WAITING: usize = 1 << 15;

/// Fills a file and waits until it is on the disk.
fn put<T: Serialize + DeserializeOwned>(file: File, head: &Head, state: &T) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(WAITING, Checked { file, sum: Sha256::new(), error: None });
    out.write_all(&MAGIC)?;
    out.write_all(&VERSION.to_le_bytes())?;
    out.write_all(&layout_of::<T>())?;
    let encoded = postcard::to_io(head, &mut out).and_then(|out| postcard::to_io(state, out)).map(|_| ());
    if let Err(encoding) = encoded {
        return Err(out.get_mut().error.take().unwrap_or_else(|| io::Error::other(encoding)));
    }
    let Checked { mut file, sum, .. } = out.into_inner().map_err(io::IntoInnerError::into_error)?;
    file.write_all(&sum.finalize())?;
    file.sync_all()
}

/// Whether a file is a whole checkpoint with a state of this type, and what it belongs to.
///
/// # Errors
/// It is none.
pub fn verify<T: DeserializeOwned>(path: &Path) -> Result<Head, CheckpointFault> {
    let bytes = read_whole(path)?;
    let body = body(&bytes, &layout_of::<T>())?;
    let (head, _) = postcard::take_from_bytes(body).map_err(|_| CheckpointFault::Undecodable)?;
    Ok(head)
}

/// Reads a checkpoint.
///
/// # Errors
/// It is none, or one of a state of another kind.
pub fn read<T: DeserializeOwned>(path: &Path) -> Result<(Head, T), CheckpointFault> {
    decode(&read_whole(path)?)
}

/// [`read`] from the content of a file.
///
/// # Errors
/// As [`read`].
pub fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Result<(Head, T), CheckpointFault> {
    let undecodable = |_| CheckpointFault::Undecodable;
    let body = body(bytes, &layout_of::<T>())?;
    let (head, rest) = postcard::take_from_bytes(body).map_err(undecodable)?;
    let (state, rest) = postcard::take_from_bytes(rest).map_err(undecodable)?;
    if rest.is_empty() { Ok((head, state)) } else { Err(CheckpointFault::Undecodable) }
}

/// Makes a checkpoint one of another case.
///
/// # Errors
/// It is none, or cannot be written.
pub fn change_case(path: &Path, case: [u8; 32]) -> Result<(), CheckpointFault> {
    let bytes = read_whole(path)?;
    let (layout, body) = content(&bytes)?;
    let (head, state) = postcard::take_from_bytes::<Head>(body).map_err(|_| CheckpointFault::Undecodable)?;
    let head = postcard::to_stdvec(&Head { case, ..head }).map_err(|_| CheckpointFault::Undecodable)?;
    let mut changed = [&MAGIC[..], &VERSION.to_le_bytes(), layout, &head, state].concat();
    let sum = Sha256::digest(&changed);
    changed.extend(sum);
    Ok(safe_file::write(path, &changed)?)
}

fn read_whole(path: &Path) -> io::Result<Vec<u8>> {
    // Something else than a file could go on for ever.
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::other("not a file"));
    }
    fs::read(path)
}

/// What is between the layout and the checksum.
fn body<'a>(bytes: &'a [u8], layout: &[u8; LAYOUT]) -> Result<&'a [u8], CheckpointFault> {
    let (found, body) = content(bytes)?;
    if found == layout { Ok(body) } else { Err(CheckpointFault::Layout) }
}

/// The layout, and what is between it and the checksum.
fn content(bytes: &[u8]) -> Result<(&[u8], &[u8]), CheckpointFault> {
    if bytes.len() < SHORTEST || !bytes.starts_with(&MAGIC) {
        return Err(CheckpointFault::Foreign);
    }
    let (content, sum) = bytes.split_at(bytes.len() - CHECKSUM);
    let (head, rest) = content.split_at(MAGIC.len() + 4);
    let found = head[MAGIC.len()..].iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte));
    if found != VERSION {
        return Err(CheckpointFault::Version { found });
    }
    if Sha256::digest(content).as_slice() != sum {
        return Err(CheckpointFault::Damaged);
    }
    Ok(rest.split_at(LAYOUT))
}

/// A file that is summed up as it is written, and keeps the error that an encoder hides.
struct Checked {
    file: File,
    sum: Sha256,
    error: Option<io::Error>,
}

impl Write for Checked {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.file.write(bytes) {
            Ok(count) => {
                self.sum.update(&bytes[..count]);
                Ok(count)
            }
            Err(error) => {
                let seen =
                    error.raw_os_error().map_or_else(|| error.kind().into(), io::Error::from_raw_os_error);
                self.error = Some(error);
                Err(seen)
            }
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn head() -> Head {
        Head { program: "cav 1".to_owned(), case: [7; 32], side: "fluid".to_owned(), step: 12 }
    }

    fn written() -> Vec<u8> {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.ckpt");
        let state = (vec![0.1_f64, f64::NAN, -0.0], Some(3_u64));
        write(&path, &head(), &state).unwrap();
        assert_eq!(verify::<(Vec<f64>, Option<u64>)>(&path).unwrap(), head());
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1, "nothing else is left");
        fs::read(&path).unwrap()
    }

    #[test]
    fn what_is_written_is_read_bit_by_bit() {
        let (found, (numbers, number)) = decode::<(Vec<f64>, Option<u64>)>(&written()).unwrap();
        assert_eq!((found, number), (head(), Some(3)));
        let bits: Vec<u64> = numbers.iter().map(|x| x.to_bits()).collect();
        assert_eq!(bits, [0.1_f64, f64::NAN, -0.0].map(f64::to_bits));
    }

    #[test]
    fn only_the_case_changes() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.ckpt");
        fs::write(&path, written()).unwrap();
        change_case(&path, [8; 32]).unwrap();
        let (found, state) = read::<(Vec<f64>, Option<u64>)>(&path).unwrap();
        assert_eq!(found, Head { case: [8; 32], ..head() });
        assert_eq!((state.0[0], state.1), (0.1, Some(3)));
        change_case(&path, [7; 32]).unwrap();
        assert_eq!(fs::read(&path).unwrap(), written());
    }

    #[test]
    fn any_changed_or_missing_byte_is_noticed() {
        let good = written();
        type State = (Vec<f64>, Option<u64>);
        for at in 0..good.len() {
            let mut bad = good.clone();
            bad[at] ^= 0x10;
            assert!(decode::<State>(&bad).is_err(), "byte {at} changed");
            assert!(decode::<State>(&good[..at]).is_err(), "only {at} bytes");
        }
        assert!(matches!(decode::<State>(&[&good[..], &[0]].concat()), Err(CheckpointFault::Damaged)));
        assert!(matches!(decode::<State>(b"something else"), Err(CheckpointFault::Foreign)));
        let mut newer = good;
        newer[8] = 99;
        assert!(matches!(decode::<State>(&newer), Err(CheckpointFault::Version { found: 99 })));
    }

    /// The same bytes would be read as either type: an index is as long as a number of steps.
    #[test]
    fn a_state_with_another_layout_is_refused_whatever_its_bytes() {
        mod before {
            #[derive(serde::Serialize, serde::Deserialize)]
            pub struct State {
                pub steps: u64,
                pub cells: Vec<f64>,
            }
        }
        #[derive(Debug, Deserialize)]
        #[allow(dead_code)]
        struct State {
            updates: u64,
            cells: Vec<f64>,
        }
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.ckpt");
        write(&path, &head(), &before::State { steps: 7, cells: vec![0.5] }).unwrap();
        let (_, state) = read::<before::State>(&path).unwrap();
        assert_eq!((state.steps, state.cells), (7, vec![0.5]));
        assert!(matches!(read::<State>(&path), Err(CheckpointFault::Layout)));
        assert!(matches!(verify::<State>(&path), Err(CheckpointFault::Layout)));
        let message = CheckpointFault::Layout.to_string();
        assert!(message.contains("another version has written it"), "{message}");
    }

    #[test]
    fn a_length_that_is_not_there_takes_no_memory() {
        // A right checksum over a list that says it has 2⁶⁰ numbers.
        let mut bytes = [&MAGIC[..], &VERSION.to_le_bytes(), &layout_of::<Vec<f64>>()].concat();
        bytes.extend(postcard::to_stdvec(&head()).unwrap());
        bytes.extend(postcard::to_stdvec(&(1_u64 << 60)).unwrap());
        let sum = Sha256::digest(&bytes);
        bytes.extend(sum);
        assert!(matches!(decode::<Vec<f64>>(&bytes), Err(CheckpointFault::Undecodable)));
    }
}
