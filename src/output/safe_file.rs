//! Bringing a file up to date so that a kill at any moment leaves either its old or its new content.
//!
//! The new content is made in a file beside it (`NAME.tmp`), which is then renamed over it: on one file system that is
//! one indivisible act. HDF5 itself gives no such promise, because an update in place passes through states in which
//! its indices and its data disagree. A rename also leaves a reader undisturbed that has the old file open.
//!
//! A file too long to be copied each time is changed in place. Then a mark lies beside it meanwhile, and a version of before is
//! kept: one at least as new as the last checkpoint, which knows how much of it counts.
//!
//! A kill of the process is covered; a loss of power is covered only where the text says "on the disk".

use std::ffi::OsString;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use rustix::fs::{FallocateFlags, fallocate, statvfs};
use rustix::io::Errno;

use super::OutputError;

type Result<T> = std::result::Result<T, OutputError>;

/// Ending of a file in the making.
pub const TEMPORARY_SUFFIX: &str = ".tmp";
/// Ending of the version of a file from before it was changed in place, and of the mark that it is being changed.
pub const BEFORE_SUFFIX: &str = ".before";
/// See [`BEFORE_SUFFIX`].
pub const CHANGING_SUFFIX: &str = ".changing";
/// All endings of what may lie beside a file.
pub const SUFFIXES: [&str; 3] = [TEMPORARY_SUFFIX, BEFORE_SUFFIX, CHANGING_SUFFIX];

/// What an HDF5 file takes besides its numbers, bytes: its indices and attributes, generously.
pub const HDF5_OVERHEAD: u64 = 1 << 20;

/// [`replace`] for an HDF5 file that may take up to `room` bytes. They are made sure of first: the library does not survive a full
/// disk.
pub fn replace_hdf5<T>(path: &Path, room: u64, write: impl FnOnce(&Path) -> Result<T>) -> Result<T> {
    replace(path, |temporary| {
        let reserved = fs::File::create(temporary).and_then(|file| reserve(&file, temporary, room));
        reserved.map_err(OutputError::io(path, "make room for"))?;
        write(temporary)
    })
}

/// Makes a file at least `length` bytes long, with room for all of them on the disk. The HDF5 library cuts off what it does not
/// use.
fn reserve(file: &fs::File, path: &Path, length: u64) -> io::Result<()> {
    match fallocate(file, FallocateFlags::empty(), 0, length) {
        Err(Errno::OPNOTSUPP | Errno::NOSYS | Errno::INVAL) => {
            // The file system cannot promise anything; then at least there is room now.
            let room = statvfs(path)?;
            let free = room.f_bavail.saturating_mul(room.f_frsize);
            if free < length { Err(Errno::NOSPC.into()) } else { Ok(()) }
        }
        other => Ok(other?),
    }
}

/// Makes `path` anew by `write`, which gets the path to write to; then renames the result over `path`.
pub fn replace<T>(path: &Path, write: impl FnOnce(&Path) -> Result<T>) -> Result<T> {
    let temporary = beside(path, TEMPORARY_SUFFIX);
    let made = write(&temporary).and_then(|value| {
        fs::rename(&temporary, path).map_err(OutputError::io(path, "rename a new version to")).map(|()| value)
    });
    if made.is_err() {
        // Best effort: the error that is returned says more than a failure to tidy up would.
        let _ = fs::remove_file(&temporary);
    }
    made
}

/// Changes the existing HDF5 file `path`, by up to `more` bytes, in place; the mark beside it meanwhile tells [`recover`] of a kill.
pub fn change_hdf5<T>(path: &Path, more: u64, change: impl FnOnce(&Path) -> Result<T>) -> Result<T> {
    let mark = beside(path, CHANGING_SUFFIX);
    fs::File::create(&mark).map_err(OutputError::io(&mark, "make"))?;
    extend(path, more)?;
    let changed = change(path)?;
    fs::remove_file(&mark).map_err(OutputError::io(&mark, "remove"))?;
    Ok(changed)
}

/// Keeps the present version of a file, which is not to be changed in place before a new one takes its name.
pub fn keep_before(path: &Path) -> Result<()> {
    let kept = beside(path, BEFORE_SUFFIX);
    replace(&kept, |temporary| {
        // Left by a kill.
        let _ = fs::remove_file(temporary);
        // A second name costs nothing; not every file system gives one.
        let linked = fs::hard_link(path, temporary).or_else(|_| fs::copy(path, temporary).map(|_| ()));
        linked.map_err(OutputError::io(path, "keep the present version of"))
    })
}

/// Makes a file whole again that a kill has left half changed, from the version of before. Else forgets that version.
///
/// - returns: whether it was half changed.
/// - errors: there is no such version.
pub fn recover(path: &Path) -> Result<bool> {
    let [mark, kept] = [CHANGING_SUFFIX, BEFORE_SUFFIX].map(|suffix| beside(path, suffix));
    let is_half_changed = mark.exists();
    if is_half_changed {
        fs::rename(&kept, path).map_err(OutputError::io(path, "find a whole version of"))?;
        fs::remove_file(&mark).map_err(OutputError::io(&mark, "remove"))?;
    } else {
        forget_before(path)?;
    }
    Ok(is_half_changed)
}

/// Removes what [`keep_before`] has kept.
pub fn forget_before(path: &Path) -> Result<()> {
    remove_if_there(&beside(path, BEFORE_SUFFIX), "remove")
}

/// Removes a file that need not be there.
///
/// - `action`: what an error calls it.
pub fn remove_if_there(file: &Path, action: &'static str) -> Result<()> {
    match fs::remove_file(file) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(OutputError::io(file, action)(error)),
        _ => Ok(()),
    }
}

/// Makes sure of room for `more` bytes in an HDF5 file.
fn extend(path: &Path, more: u64) -> Result<()> {
    let extended = fs::OpenOptions::new().write(true).open(path).and_then(|file| {
        let length = file.metadata()?.len().saturating_add(more);
        reserve(&file, path, length)
    });
    extended.map_err(OutputError::io(path, "make room in"))
}

/// Changes the existing HDF5 file `path` by `change`, which gets the path of a copy to work on and may add up to `more` bytes.
///
/// Copying costs about a second per gigabyte, nothing where the file system clones files.
pub fn update_hdf5<T>(path: &Path, more: u64, change: impl FnOnce(&Path) -> Result<T>) -> Result<T> {
    replace(path, |temporary| {
        fs::copy(path, temporary).map_err(OutputError::io(path, "copy"))?;
        extend(temporary, more)?;
        change(temporary)
    })
}

/// Waits until a file or directory is on the disk as it is now.
pub fn sync(path: &Path) -> Result<()> {
    let synced = fs::File::open(path).and_then(|file| file.sync_all());
    synced.map_err(OutputError::io(path, "bring to the disk"))
}

/// Writes `bytes` as the whole content of `path`, on the disk before the name points to it.
pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    replace(path, |temporary| {
        let write = || -> std::io::Result<()> {
            let mut file = fs::File::create(temporary)?;
            file.write_all(bytes)?;
            file.sync_all()
        };
        write().map_err(OutputError::io(path, "write"))
    })
}

/// The file beside `path` with that ending.
fn beside(path: &Path, suffix: &str) -> PathBuf {
    let mut name: OsString = path.as_os_str().to_owned();
    name.push(suffix);
    PathBuf::from(name)
}
