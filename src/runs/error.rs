//! What can be wrong with what is asked of a listing.

use std::path::PathBuf;

/// A listing cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum ListError {
    /// The folder cannot be read.
    #[error("cannot list {}: {source}; give the folder that the runs are in", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// The cause.
        source: std::io::Error,
    },
    /// No run has the key.
    #[error("no run has the key `{key}`{nearest}; `--columns all --json` shows all keys")]
    UnknownKey {
        /// The key.
        key: String,
        /// Those that may be meant.
        nearest: String,
    },
    /// A condition is none.
    #[error("--where '{text}': {reason}; write KEY=VALUE, or !=, <, <=, >, >= or ~ (contains) in place of =")]
    Condition {
        /// What was given.
        text: String,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// A state is none.
    #[error("--state {0}: give one of running, finished, failed, interrupted")]
    State(String),
}
