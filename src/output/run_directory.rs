//! The directory of a run: made, taken over, kept aside, replaced or refused, and never anything deleted that is not ours.

use std::ffi::OsString;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use rustix::io::{FdFlags, fcntl_setfd};
use serde_json::Value;

use super::safe_file::remove_if_there;
use super::{OutputError, safe_file, summary};

/// Snapshots of the fluid.
pub const FLUID_FIELDS: &str = "fluid.vtkhdf";
/// Snapshots of the solid.
pub const SOLID_FIELDS: &str = "solid.vtkhdf";
/// Histories of the fluid's side.
pub const FLUID_HISTORY: &str = "fluid.h5";
/// Histories of the solid's side.
pub const SOLID_HISTORY: &str = "solid.h5";
/// The histories of both sides.
pub const HISTORY: &str = "history.h5";
/// The fluid's part of the summary.
pub const FLUID_SUMMARY: &str = "fluid.json";
/// The solid's part of the summary.
pub const SOLID_SUMMARY: &str = "solid.json";
/// The summary; holds `"completed": false` from the start of a run to its end.
pub const SUMMARY: &str = "summary.json";
/// The effective case.
pub const CASE: &str = "case.toml";
/// What stays in a wall that can yield, for a run that goes on from it.
pub const WALL: &str = "wall.state";
/// The checkpoints of both sides.
pub const CHECKPOINTS: &str = "checkpoints";
/// What a study of grid convergence came to, in the study's directory.
pub const CONVERGENCE: &str = "convergence.json";
/// What the directory of a case's study is called behind the name of its run directory.
pub const CONVERGENCE_SUFFIX: &str = "-convergence";
/// How far the run is, for whoever looks at it; until it is finished.
pub const PROGRESS: &str = "progress.json";
/// The log.
pub const LOG: &str = "log";

/// All files that a run writes, so all that replacing one may delete.
pub const FILES: [&str; 12] = [
    FLUID_FIELDS,
    SOLID_FIELDS,
    FLUID_HISTORY,
    SOLID_HISTORY,
    HISTORY,
    FLUID_SUMMARY,
    SOLID_SUMMARY,
    SUMMARY,
    CASE,
    LOG,
    WALL,
    PROGRESS,
];

/// How often, and after what pause, a lock that somebody has is tried again: a fifth of a second in all.
const LOCK_TRIES: u32 = 20;
const LOCK_PAUSE: Duration = Duration::from_millis(10);

/// The directory of a run. The value that [`prepare`](Self::prepare) returns holds it against other runs until dropped.
#[derive(Debug)]
pub struct RunDirectory {
    path: PathBuf,
    /// Where another run went that was not finished.
    kept_aside: Option<PathBuf>,
    /// The directory itself, opened and locked; the lock ends with the process, however it ends.
    _lock: Option<File>,
}

impl RunDirectory {
    /// Makes the directory ready for a new run.
    ///
    /// - It does not exist: made, with its parents. It exists and is empty: used.
    /// - It holds a finished run: refused; with `force` the run's files are deleted (and no others).
    /// - It holds a run that was not finished: renamed to the first free of `DIR.1`, `DIR.2`, ...
    /// - Another process is writing to it, or it holds only files of other origin: refused.
    pub fn prepare(path: &Path, force: bool) -> Result<Self, OutputError> {
        let path = full_path(path)?;
        let mut kept_aside = None;
        if path.exists() {
            // Held meanwhile, so that of two runs started at once only one moves or deletes anything.
            let held = lock(&path)?;
            match content(&path)? {
                Content::Empty => {}
                Content::Finished if force => delete_run(&path)?,
                Content::Finished => return Err(OutputError::Finished { path }),
                Content::Unfinished => kept_aside = Some(keep_aside(&path)?),
                Content::Foreign(example) => return Err(OutputError::Foreign { path, example }),
            }
            drop(held);
        }
        fs::create_dir_all(&path).map_err(OutputError::io(&path, "make the run directory"))?;
        let held = lock(&path)?;
        let directory = Self { path, kept_aside, _lock: held };
        // Shows at once whether the directory can be written to.
        directory.mark_unfinished()?;
        Ok(directory)
    }

    /// Marks it as that of a run that is not finished.
    pub fn mark_unfinished(&self) -> Result<(), OutputError> {
        let mut begun = summary::origin();
        begun.insert("completed".to_owned(), Value::Bool(false));
        summary::write(self, SUMMARY, &begun)?;
        // The parts of what it came to before would say something else.
        [FLUID_SUMMARY, SOLID_SUMMARY].iter().try_for_each(|name| remove_if_there(&self.file(name), "remove"))
    }

    /// The directory of a run that somebody else has prepared: for the sides' processes and for reading.
    pub fn open(path: &Path) -> Result<Self, OutputError> {
        fs::read_dir(path).map_err(OutputError::io(path, "open the run directory"))?;
        Ok(Self { path: path.to_path_buf(), kept_aside: None, _lock: None })
    }

    /// Takes up a run that was not finished, to go on with it: nothing is moved or deleted, and other runs are kept out.
    pub fn resume(path: &Path) -> Result<Self, OutputError> {
        let mut directory = Self::open(path)?;
        directory._lock = lock(path)?;
        Ok(directory)
    }

    /// Lets processes that are started now hold the directory, too, until they end; or no more.
    pub fn share_lock(&self, is_shared: bool) -> Result<(), OutputError> {
        let flags = if is_shared { FdFlags::empty() } else { FdFlags::CLOEXEC };
        let Some(lock) = &self._lock else { return Ok(()) };
        fcntl_setfd(lock, flags)
            .map_err(|error| OutputError::io(&self.path, "pass on the lock of")(error.into()))
    }

    /// Holds the directory no longer: the run has ended.
    pub fn release(&mut self) {
        self._lock = None;
    }

    /// Removes what a killed run has left in the making.
    pub fn tidy(&self) -> Result<(), OutputError> {
        for name in FILES {
            remove_if_there(&self.file(&format!("{name}{}", safe_file::TEMPORARY_SUFFIX)), "remove")?;
        }
        Ok(())
    }

    /// Removes what says how far the run is: the run is finished.
    pub fn remove_progress(&self) -> Result<(), OutputError> {
        remove_if_there(&self.file(PROGRESS), "remove")
    }

    /// Waits until nobody else holds the directory, and holds it until the returned value is dropped.
    pub fn wait_for_lock(&self) -> Result<File, OutputError> {
        let directory =
            File::open(&self.path).map_err(OutputError::io(&self.path, "open the run directory"))?;
        directory.lock().map_err(OutputError::io(&self.path, "lock the run directory"))?;
        Ok(directory)
    }

    /// The directory's path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The path of a file in it.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Where [`prepare`](Self::prepare) has put an earlier run that was not finished.
    pub fn kept_aside(&self) -> Option<&Path> {
        self.kept_aside.as_deref()
    }

    /// Writes a file of the directory whole: a reader finds the old content or the new, never a part.
    pub fn write_atomic(&self, name: &str, bytes: &[u8]) -> Result<(), OutputError> {
        safe_file::write(&self.file(name), bytes)
    }
}

enum Content {
    Empty,
    Finished,
    Unfinished,
    Foreign(String),
}

/// Whether a run that goes on holds a directory; `None` where that cannot be told: the file system knows no locks, or the directory
/// may not be read.
///
/// The directory is held for a moment if nobody else does, shared with others who ask. A run that begins in that moment waits for it
/// to pass.
#[must_use]
pub fn is_held(path: &Path) -> Option<bool> {
    match File::open(path).ok()?.try_lock_shared() {
        Ok(()) => Some(false),
        Err(TryLockError::WouldBlock) => Some(true),
        Err(TryLockError::Error(_)) => None,
    }
}

/// What a directory holds. Files that a user may have under the same names do not alone make it a run's.
fn content(path: &Path) -> Result<Content, OutputError> {
    let mut example = None;
    let mut is_run = false;
    for entry in fs::read_dir(path).map_err(OutputError::io(path, "list"))? {
        let name = entry.map_err(OutputError::io(path, "list"))?.file_name();
        let name = name.to_string_lossy();
        is_run |= FILES.contains(&&*name) && ![CASE, LOG, SUMMARY, PROGRESS].contains(&&*name);
        example.get_or_insert_with(|| name.into_owned());
    }
    let summary = summary::read(&path.join(SUMMARY)).ok();
    let completed = summary.as_ref().and_then(|summary| summary.get("completed")).and_then(Value::as_bool);
    Ok(match (completed, is_run, example) {
        (Some(true), _, _) => Content::Finished,
        (Some(false), _, _) | (None, true, _) => Content::Unfinished,
        (None, false, None) => Content::Empty,
        (None, false, Some(example)) => Content::Foreign(example),
    })
}

/// Deletes the files of a run, those in the making included, and leaves any others.
fn delete_run(path: &Path) -> Result<(), OutputError> {
    remove_checkpoints(path)?;
    // The summary last: if this is interrupted, what is left is still known as a run's.
    for name in FILES.iter().filter(|name| **name != SUMMARY).chain([&SUMMARY]) {
        for suffix in safe_file::SUFFIXES.into_iter().chain([""]) {
            remove_if_there(&path.join(format!("{name}{suffix}")), "delete the earlier run's file")?;
        }
    }
    Ok(())
}

fn remove_checkpoints(path: &Path) -> Result<(), OutputError> {
    let checkpoints = path.join(CHECKPOINTS);
    match fs::remove_dir_all(&checkpoints) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            Err(OutputError::io(&checkpoints, "remove the checkpoints in")(error))
        }
        _ => Ok(()),
    }
}

/// The path from the root, so that it stays right when the working directory itself is renamed.
fn full_path(path: &Path) -> Result<PathBuf, OutputError> {
    // A path such as `.` ends in no name that a number could be added to.
    let full = if path.file_name().is_some() { std::path::absolute(path) } else { path.canonicalize() };
    full.map_err(OutputError::io(path, "find"))
}

/// Renames the directory to the first free of `DIR.1`, `DIR.2`, ... and returns the name.
fn keep_aside(path: &Path) -> Result<PathBuf, OutputError> {
    let mut number = 1;
    loop {
        let mut name: OsString = path.components().as_path().as_os_str().to_owned();
        name.push(format!(".{number}"));
        let aside = PathBuf::from(name);
        if fs::symlink_metadata(&aside).is_err() {
            fs::rename(path, &aside).map_err(OutputError::io(path, "keep aside the unfinished run in"))?;
            return Ok(aside);
        }
        number += 1;
    }
}

/// Locks the directory against other runs; `None` on a file system that knows no locks.
fn lock(path: &Path) -> Result<Option<File>, OutputError> {
    if !path.is_dir() {
        return Err(OutputError::io(path, "make the run directory")(io::ErrorKind::NotADirectory.into()));
    }
    let directory = File::open(path).map_err(OutputError::io(path, "open the run directory"))?;
    let mut tries = 0;
    loop {
        match directory.try_lock() {
            Ok(()) => return Ok(Some(directory)),
            // Whoever only asks whether it is held has it for some microseconds.
            Err(TryLockError::WouldBlock) if tries < LOCK_TRIES => std::thread::sleep(LOCK_PAUSE),
            Err(TryLockError::WouldBlock) => return Err(OutputError::InUse { path: path.to_path_buf() }),
            Err(TryLockError::Error(_)) => return Ok(None),
        }
        tries += 1;
    }
}
