//! The log of a run, and on the terminal where that is asked for.

use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use tracing::Level;
use tracing_subscriber::fmt::MakeWriter;
use tracing_subscriber::fmt::writer::MakeWriterExt;

use crate::output::run_directory::LOG;

/// Logs to the run directory, and with `-v` to the terminal unless the launcher does.
pub(super) fn log_to(directory: &Path, verbosity: u8, to_terminal: bool) {
    // A run does not fail for want of a log; what matters is in its other files and on the terminal.
    let Ok(file) = open(directory) else { return };
    begin(Mutex::new(file), verbosity, to_terminal);
}

fn open(directory: &Path) -> io::Result<File> {
    OpenOptions::new().create(true).append(true).open(directory.join(LOG))
}

fn begin<W>(file: W, verbosity: u8, to_terminal: bool)
where
    W: for<'a> MakeWriter<'a> + Send + Sync + 'static,
{
    let level = if verbosity > 1 { Level::DEBUG } else { Level::INFO };
    let on_terminal = match verbosity {
        0 => Level::ERROR,
        1 => Level::INFO,
        _ => Level::DEBUG,
    };
    let builder = tracing_subscriber::fmt().with_max_level(level).with_ansi(false);
    if to_terminal && verbosity > 0 {
        builder.with_writer(file.and(io::stderr.with_max_level(on_terminal))).init();
    } else {
        builder.with_writer(file).init();
    }
}

/// A log that goes from one run directory to the next.
#[derive(Clone, Default)]
pub(super) struct Follower(Arc<Mutex<Option<File>>>);

impl Follower {
    /// Begins to log, so far into no directory.
    pub(super) fn begin(verbosity: u8) -> Self {
        let follower = Self::default();
        begin(follower.clone(), verbosity, true);
        follower
    }

    /// Logs into this directory from now on.
    pub(super) fn follow(&self, directory: &Path) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = open(directory).ok();
    }
}

impl<'a> MakeWriter<'a> for Follower {
    type Writer = Self;

    fn make_writer(&'a self) -> Self {
        self.clone()
    }
}

impl Write for Follower {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut *self.0.lock().unwrap_or_else(PoisonError::into_inner) {
            Some(file) => file.write(bytes),
            None => Ok(bytes.len()),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
