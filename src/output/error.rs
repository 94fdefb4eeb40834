//! What can go wrong when output is written: where, doing what, why, and what helps.

use std::io;
use std::path::{Path, PathBuf};

/// A file or directory of the run could not be made, written or read.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The operating system refused.
    #[error("cannot {action} {}: {source}; {}", path.display(), remedy(source))]
    Io {
        /// The file or directory.
        path: PathBuf,
        /// What was being done, as it follows "cannot".
        action: &'static str,
        /// The cause.
        source: io::Error,
    },
    /// The HDF5 library refused.
    #[error("cannot {action} {}: {source}; {}", path.display(), remedy_of_file(path))]
    Hdf5 {
        /// The file.
        path: PathBuf,
        /// What was being done, as it follows "cannot".
        action: &'static str,
        /// The cause.
        source: hdf5::Error,
    },
    /// A file is not written any more, after an error that was told before.
    #[error("{} was given up after an earlier error", path.display())]
    Closed {
        /// The file.
        path: PathBuf,
    },
    /// A JSON file does not hold an object.
    #[error("cannot read {} as a summary: {source}; delete it or take the file of a finished run", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// The cause.
        source: serde_json::Error,
    },
    /// A file exists, but its datasets are not those asked for.
    #[error("{} does not fit: {what}; it was written by another version or case, so write to a new directory", path.display())]
    Mismatch {
        /// The file.
        path: PathBuf,
        /// What was found and what was expected.
        what: String,
    },
    /// The values handed over have the wrong number: a fault of the program, not of the user.
    #[error("{what} for {} has {found} values where {expected} are needed", path.display())]
    Length {
        /// The file they are meant for.
        path: PathBuf,
        /// Which values.
        what: String,
        /// How many came.
        found: usize,
        /// How many are needed.
        expected: usize,
    },
    /// The directory holds a finished run.
    #[error("{} holds a finished run; choose another directory with --out, or replace it with --force", path.display())]
    Finished {
        /// The directory.
        path: PathBuf,
    },
    /// Another process is writing to the directory.
    #[error("{} is in use by a run that is still going on; wait for it, or choose another directory with --out", path.display())]
    InUse {
        /// The directory.
        path: PathBuf,
    },
    /// There is no run in the directory.
    #[error("there is no run in {}{}; give the directory of a run: it holds summary.json and case.toml", path.display(), if path.is_dir() { "" } else { ", which is not there" })]
    NoRun {
        /// The directory.
        path: PathBuf,
    },
    /// The directory holds files that no run has written.
    #[error("{} holds files that are not a run's (such as {example}); choose an empty or new directory with --out", path.display())]
    Foreign {
        /// The directory.
        path: PathBuf,
        /// One of the files.
        example: String,
    },
}

impl OutputError {
    /// For `map_err`: the operating system refused `action` on `path`.
    pub fn io(path: &Path, action: &'static str) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::Io { path, action, source }
    }

    /// For `map_err`: the HDF5 library refused `action` on `path`.
    pub fn hdf5(path: &Path, action: &'static str) -> impl FnOnce(hdf5::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::Hdf5 { path, action, source }
    }
}

/// What the user can do about a file that the HDF5 library refuses.
fn remedy_of_file(path: &Path) -> &'static str {
    if path.exists() {
        "is the disk full, or the file not one of this program's?"
    } else {
        "it is not there: was it moved or deleted?"
    }
}

/// What the user can do about an error of the operating system.
fn remedy(error: &io::Error) -> &'static str {
    use io::ErrorKind::{
        FileTooLarge, NotADirectory, NotFound, PermissionDenied, QuotaExceeded, ReadOnlyFilesystem,
        StorageFull,
    };
    match error.kind() {
        PermissionDenied | ReadOnlyFilesystem => {
            "make the directory writable, or choose another one with --out"
        }
        StorageFull | QuotaExceeded => "free some space, or write fewer snapshots",
        FileTooLarge => {
            "files may not grow so long here (ulimit -f): raise the limit, or write fewer snapshots"
        }
        NotADirectory => "part of the path is a file: choose another directory with --out",
        NotFound => "was it moved or deleted? choose another directory with --out",
        _ => "check the path and the disk, or choose another directory with --out",
    }
}
