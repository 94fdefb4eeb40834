//! Bringing a file up to date so that a kill at any moment leaves either its old or its new content.
//!
//! The new content is made in a file beside it (`NAME.tmp`), which is then renamed over it: on one file system that is
//! one indivisible act. HDF5 itself gives no such promise, because an update in place passes through states in which
//! its indices and its data disagree. A rename also leaves a reader undisturbed that has the old file open.
//!
//! A kill of the process is covered; a loss of power is covered only where the text says "on the disk".

use std::ffi::OsString;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use super::OutputError;

/// Ending of a file in the making.
pub const TEMPORARY_SUFFIX: &str = ".tmp";

/// Makes `path` anew by `write`, which gets the path to write to; then renames the result over `path`.
pub fn replace<T>(
    path: &Path,
    write: impl FnOnce(&Path) -> Result<T, OutputError>,
) -> Result<T, OutputError> {
    let temporary = temporary_beside(path);
    let made = write(&temporary).and_then(|value| {
        fs::rename(&temporary, path).map_err(OutputError::io(path, "rename a new version to")).map(|()| value)
    });
    if made.is_err() {
        // Best effort: the error that is returned says more than a failure to tidy up would.
        let _ = fs::remove_file(&temporary);
    }
    made
}

/// Changes the existing file `path` by `change`, which gets the path of a copy to work on while the file is at most
/// `copy_limit` bytes long, and beyond that the file itself.
///
/// Copying costs about a second per gigabyte (nothing where the file system clones files), so a limit bounds it.
pub fn update<T>(
    path: &Path,
    copy_limit: u64,
    change: impl FnOnce(&Path) -> Result<T, OutputError>,
) -> Result<T, OutputError> {
    let length = fs::metadata(path).map_err(OutputError::io(path, "find"))?.len();
    if length > copy_limit {
        return change(path);
    }
    replace(path, |temporary| {
        fs::copy(path, temporary).map_err(OutputError::io(path, "copy"))?;
        change(temporary)
    })
}

/// Waits until a file or directory is on the disk as it is now.
pub fn sync(path: &Path) -> Result<(), OutputError> {
    let synced = fs::File::open(path).and_then(|file| file.sync_all());
    synced.map_err(OutputError::io(path, "bring to the disk"))
}

/// Writes `bytes` as the whole content of `path`, on the disk before the name points to it.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    replace(path, |temporary| {
        let write = || -> std::io::Result<()> {
            let mut file = fs::File::create(temporary)?;
            file.write_all(bytes)?;
            file.sync_all()
        };
        write().map_err(OutputError::io(path, "write"))
    })
}

/// Where a new version of `path` is made.
fn temporary_beside(path: &Path) -> PathBuf {
    let mut name: OsString = path.as_os_str().to_owned();
    name.push(TEMPORARY_SUFFIX);
    PathBuf::from(name)
}
