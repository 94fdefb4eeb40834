//! Runs in two processes, on finer and finer grids, and the command line.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::time::Duration;

use cav::convergence::study::study;
use cav::run::RunError;
use cav::run::checkpoints::DEFAULT_INTERVAL;
use cav::run::process::launch::run;
use cav::run::process::launch_options::Options;
use cav::run::process::resume::resume as go_on;
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
        threads,
        program,
        quiet: !progress,
        ..options()
    };
    let (options, case) = (&options, case.case());
    interruptible(py, |stop| {
        let mut guard = None;
        let on_directory = |path: &Path| guard = Some(Log::of(Some(path)).until_dropped());
        run(case, options, stop, on_directory).inspect_err(log::failed)
    })
}

/// Goes on with the run in a directory, to a later end if one is given (s); returns the directory.
///
/// - `program`, `processes`: as of [`convergence`].
#[pyfunction]
#[pyo3(signature = (directory, program, end=None, processes=false, threads=None, progress=false))]
pub fn resume(
    py: Python<'_>,
    directory: PathBuf,
    program: Vec<OsString>,
    end: Option<f64>,
    processes: bool,
    threads: Option<usize>,
    progress: bool,
) -> PyResult<PathBuf> {
    let options = &Options { in_process: !processes, end, threads, program, quiet: !progress, ..options() };
    interruptible(py, |stop| {
        let mut guard = None;
        let on_directory = |path: &Path| guard = Some(Log::of(Some(path)).until_dropped());
        go_on(&directory, options, stop, on_directory).inspect_err(log::failed)
    })
}

/// Runs a case on finer and finer grids; returns the directory and the text of its `convergence.json`.
///
/// - `case_path`, `program`: as of [`run_in_processes`]; `processes`: two for each run of two media.
#[expect(clippy::too_many_arguments, reason = "those of the Python function")]
#[pyfunction]
#[pyo3(signature = (case, case_path, program, grids, out=None, processes=false, force=false, threads=None, progress=false))]
pub fn convergence(
    py: Python<'_>,
    case: &Case,
    case_path: PathBuf,
    program: Vec<OsString>,
    grids: usize,
    out: Option<PathBuf>,
    processes: bool,
    force: bool,
    threads: Option<usize>,
    progress: bool,
) -> PyResult<(PathBuf, String)> {
    let options = Options {
        case_path,
        out,
        in_process: !processes,
        force,
        threads,
        program,
        quiet: !progress,
        ..options()
    };
    let (source, options) = (&case.source(), &options);
    let study = interruptible(py, |stop| {
        let mut guard = None;
        let on_directory = |path: &Path| {
            // One at a time.
            drop(guard.take());
            guard = Some(Log::of(Some(path)).until_dropped());
        };
        study(source, grids, options, stop, on_directory)
    })?;
    let text = study.text();
    Ok((study.directory, text))
}

/// What runs have in common.
fn options() -> Options {
    Options { checkpoint_every: Some(DEFAULT_INTERVAL), ..Options::default() }
}

/// Does what takes long without the interpreter, which is asked now and then whether it should stop.
fn interruptible<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&Stop) -> Result<T, RunError> + Send,
) -> PyResult<T> {
    let stop = &Stop::default();
    let (done, ended) = mpsc::channel::<()>();
    py.detach(move || {
        std::thread::scope(|scope| {
            let worker = scope.spawn(move || {
                let result = guarded(|| work(stop).map_err(Failure::Run));
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
///
/// - `others`: commands that Python does itself, with what they do, for the helps.
#[pyfunction]
#[pyo3(signature = (arguments, program, others=Vec::new()))]
pub fn main(
    py: Python<'_>,
    arguments: Vec<OsString>,
    program: Vec<OsString>,
    others: Vec<(String, String)>,
) -> PyResult<u8> {
    Ok(py.detach(|| guarded(|| Ok(cav::command_line::main(arguments, &program, &others))))?)
}
