//! What has become of a run, told from its directory.

use std::path::Path;

use serde_json::{Map, Value};

use super::run_directory::{CASE, CHECKPOINTS, FLUID_HISTORY, SOLID_HISTORY, SUMMARY, is_held};
use super::{OutputError, summary};

mesh::named! {
    /// What has become of a run.
    pub enum RunState {
        /// A process is at it: it holds the directory.
        Running = "running",
        /// It has reached its end.
        Finished = "finished",
        /// It ended with an error.
        Failed = "failed",
        /// It was stopped or killed before its end, and can be gone on with.
        Interrupted = "interrupted",
    }
}

impl RunState {
    /// The state of the run in a directory, of which the summary says so much.
    ///
    /// Whether it is running its lock says, whatever the files say and however old they are.
    #[must_use]
    pub fn of(directory: &Path, summary: &Map<String, Value>) -> Self {
        let is_completed =
            |summary: &Map<String, Value>| summary.get("completed") == Some(&Value::Bool(true));
        let ended = |summary: &Map<String, Value>| match summary.get("error") {
            _ if is_completed(summary) => Self::Finished,
            Some(_) => Self::Failed,
            None => Self::Interrupted,
        };
        if is_completed(summary) {
            return Self::Finished;
        }
        if is_held(directory) == Some(true) {
            return Self::Running;
        }
        // It may have ended since the summary was read.
        summary::read(&directory.join(SUMMARY)).map_or_else(|_| ended(summary), |latest| ended(&latest))
    }
}

/// Whether a directory is a run's.
#[must_use]
pub fn is_run(directory: &Path) -> bool {
    let has = |name: &str| directory.join(name).is_file();
    has(SUMMARY) && [CASE, FLUID_HISTORY, SOLID_HISTORY].into_iter().any(has)
}

/// Whether a run that has not ended well can be gone on with from where it was.
#[must_use]
pub fn has_checkpoints(directory: &Path) -> bool {
    std::fs::read_dir(directory.join(CHECKPOINTS)).is_ok_and(|mut entries| entries.next().is_some())
}

/// The summary of the run in a directory.
///
/// - errors: [`OutputError::NoRun`] if it is none's.
pub fn summary_of(directory: &Path) -> Result<Map<String, Value>, OutputError> {
    if !is_run(directory) {
        return Err(OutputError::NoRun { path: directory.to_path_buf() });
    }
    summary::read(&directory.join(SUMMARY))
}
