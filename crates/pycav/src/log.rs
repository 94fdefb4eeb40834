//! The log of a run directory. A process may make several runs at a time, so a log is that of the work done for its run.

use std::fs::OpenOptions;
use std::path::Path;
use std::sync::Mutex;

use cav::case::Case;
use cav::output::run_directory::LOG;
use cav::run::RunError;
use cav::run::process::launch::log_case;
use tracing::Level;
use tracing::dispatcher::{self, DefaultGuard, Dispatch};

/// Who says what this package says.
const TARGET: &str = "pycav";

/// Where a run's messages go; nowhere for a run without a directory.
pub struct Log(Dispatch);

impl Log {
    /// The file `log` of a run directory, as `cav run` has it.
    pub fn of(directory: Option<&Path>) -> Self {
        let file = directory.map(|path| OpenOptions::new().create(true).append(true).open(path.join(LOG)));
        // A run does not fail for want of a log.
        let Some(Ok(file)) = file else { return Self(Dispatch::none()) };
        let builder = tracing_subscriber::fmt().with_max_level(Level::INFO).with_ansi(false);
        Self(Dispatch::new(builder.with_writer(Mutex::new(file)).finish()))
    }

    /// Does work whose messages on this thread are the run's.
    pub fn during<T>(&self, work: impl FnOnce() -> T) -> T {
        dispatcher::with_default(&self.0, work)
    }

    /// Takes this thread's messages until the guard is dropped.
    pub fn until_dropped(&self) -> DefaultGuard {
        dispatcher::set_default(&self.0)
    }

    /// What a log begins with.
    pub fn begun(&self, case: &Case) {
        self.during(|| {
            log_case(case);
            for warning in case.warnings() {
                tracing::warn!(target: TARGET, "{warning}");
            }
        });
    }

    /// What it ends with, after all has gone well.
    pub fn done(&self, words: &str) {
        self.during(|| tracing::info!(target: TARGET, "{words}"));
    }

    /// What it ends with otherwise.
    pub fn failed(&self, error: &RunError) {
        self.during(|| failed(error));
    }
}

/// Says what went wrong to whoever takes this thread's messages.
pub fn failed(error: &RunError) {
    tracing::error!(target: TARGET, "{error}");
}
