//! What is said of a run besides its case.

use std::ffi::OsString;
use std::path::PathBuf;
use std::time::{Duration, SystemTime};

use crate::run::process::drive::Keeping;

/// What the command line says besides the case.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The case file and its changes, for the children.
    pub case_path: PathBuf,
    /// `--set`.
    pub sets: Vec<String>,
    /// `--out`.
    pub out: Option<PathBuf>,
    /// `--force`.
    pub force: bool,
    /// `--in-process`.
    pub in_process: bool,
    /// `--threads`, per process.
    pub threads: Option<usize>,
    /// `--checkpoint-every`; `None` for no checkpoints.
    pub checkpoint_every: Option<Duration>,
    /// `--end`: when a run that is gone on with is to end, s; at least as late as its case says.
    pub end: Option<f64>,
    /// The step of the checkpoint to go on from.
    pub from: Option<u64>,
    /// What the case is called, if not as its file.
    pub name: Option<String>,
    /// The command that is this program, for the children; this process's own executable if empty.
    pub program: Vec<OsString>,
    /// `-q`.
    pub quiet: bool,
    /// `-v`, counted.
    pub verbosity: u8,
}

impl Options {
    /// What of them is about checkpoints.
    pub(super) fn keeping(&self) -> Keeping {
        Keeping { from: self.from, every: self.checkpoint_every }
    }
}

/// A run id that no other run on the machine has: process and time.
pub fn new_run_id() -> String {
    let nanoseconds = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).map_or(0, |t| t.as_nanos());
    format!("{}-{:x}", std::process::id(), nanoseconds)
}
