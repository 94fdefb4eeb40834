//! A run in two processes, and the command line.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::time::Duration;

use cav::run::checkpoints::DEFAULT_INTERVAL;
use cav::run::process::launch::run;
use cav::run::process::launch_options::Options;
use cav::run::process::stop::Stop;
use pyo3::prelude::*;

use crate::case::Case;
use crate::error::{Failure, guarded};
use crate::log::{self, Log};

/// How often Python gets a say.
const SAY: Duration = Duration::from_millis(50);

/// Runs a case in two processes and leaves a run directory; returns its path.
///
/// - `case_path`: a file with the case's text, for the processes; `program`: the command that starts one.
#[expect(clippy::too_many_arguments, reason = "those of the Python function")]
#[pyfunction]
#[pyo3(signature = (case, case_path, program, out=None, force=false, threads=None, progress=false))]
pub fn run_in_processes(
    py: Python<'_>,
    case: &Case,
    case_path: PathBuf,
    program: Vec<OsString>,
    out: Option<PathBuf>,
    force: bool,
    threads: Option<usize>,
    progress: bool,
) -> PyResult<PathBuf> {
    let options = Options {
        case_path,
        sets: case.sets().to_vec(),
        out,
        force,
        in_process: false,
        threads,
        checkpoint_every: Some(DEFAULT_INTERVAL),
        from: None,
        name: None,
        program,
        quiet: !progress,
        verbosity: 0,
    };
    let (stop, options, case) = (&Stop::default(), &options, case.case());
    let (done, ended) = mpsc::channel::<()>();
    py.detach(move || {
        std::thread::scope(|scope| {
            let worker = scope.spawn(move || {
                let mut guard = None;
                let on_directory = |path: &Path| guard = Some(Log::of(Some(path)).until_dropped());
                let result = guarded(|| {
                    let ended = run(case, options, stop, on_directory);
                    ended.inspect_err(log::failed).map_err(Failure::Run)
                });
                // Closing the channel says that it is done.
                drop(done);
                result
            });
            let mut asked = None;
            while let Err(mpsc::RecvTimeoutError::Timeout) = ended.recv_timeout(SAY) {
                if asked.is_none()
                    && let Err(error) = Python::attach(|py| py.check_signals())
                {
                    asked = Some(error);
                    stop.interrupt();
                }
            }
            let result = worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            match asked {
                Some(error) => Err(error),
                None => result.map_err(PyErr::from),
            }
        })
    })
}

/// Does what a command line of `cav` says; returns the exit code.
#[pyfunction]
pub fn main(py: Python<'_>, arguments: Vec<OsString>, program: Vec<OsString>) -> PyResult<u8> {
    Ok(py.detach(|| guarded(|| Ok(cav::command_line::main(arguments, &program))))?)
}
