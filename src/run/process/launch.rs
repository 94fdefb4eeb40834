//! `cav run`: one process, or two children of its own executable.

use std::path::{Path, PathBuf};
use std::time::Duration;

use coupler::{Participant, Scheme};
use serde_json::Map;

use crate::case::Case;
use crate::output::run_directory::CASE;
use crate::output::{Progress, ProgressLine, RunDirectory};
use crate::run::RunError;
use crate::run::checkpoints::Checkpoints;
use crate::run::process::children::two_processes;
use crate::run::process::drive;
use crate::run::process::drive::in_process;
use crate::run::process::launch_options::Options;
use crate::run::process::stop::Stop;
use crate::run::record::conclusion::{closing_words, conclude};
use crate::run::wall;

/// The run directory: the command line's, the case's, or one by the case's name.
pub fn directory_of(case: &Case, out: Option<&Path>) -> PathBuf {
    out.map(Path::to_path_buf).or_else(|| case.output.directory.clone()).unwrap_or_else(|| {
        // A name may be `..`, or have a `/` in it.
        let name = Path::new(&case.name).file_name().unwrap_or("case".as_ref());
        Path::new("runs").join(name)
    })
}

/// Runs a case and leaves a run directory.
///
/// - errors: see [`RunError`]; what was computed is written in any case.
/// - `on_directory`: told of the run directory as soon as it is there, for the log.
pub fn run(
    case: &Case,
    options: &Options,
    stop: &Stop,
    on_directory: impl FnOnce(&Path),
) -> Result<PathBuf, RunError> {
    RunError::unless_whole(case)?;
    case.fits_memory([true; 2])?;
    wall::check(case)?;
    let directory = prepare(case, options)?;
    on_directory(directory.path());
    carry_out(case, options, &directory, stop)
}

/// Runs a case in its directory, from the start or from a checkpoint.
pub(super) fn carry_out(
    case: &Case,
    options: &Options,
    directory: &RunDirectory,
    stop: &Stop,
) -> Result<PathBuf, RunError> {
    log_case(case);
    let coupled = case.fluid.is_some() && case.solid.is_some();
    let mut progress = Progress::new(case.time.end, options.quiet, options.verbosity).told_in(directory);
    for warning in case.warnings() {
        tracing::warn!("{warning}");
        progress.message(&format!("warning: {warning}"));
    }
    let result = if coupled && !options.in_process {
        two_processes(options, directory, stop, &mut progress)
    } else {
        let threads = thread_pool(options.threads)?;
        let mut on_step = |line: &ProgressLine| progress.update(line);
        threads.install(|| in_process(case, directory, options.keeping(), stop, &mut on_step))
    };
    let whole = match (conclude(directory, case, result.as_ref().err()), &result) {
        (Ok(whole), _) => whole,
        (Err(error), Ok(())) => return Err(error),
        (Err(error), Err(_)) => {
            // What went wrong first says more.
            tracing::warn!("{error}");
            Map::new()
        }
    };
    match &result {
        Ok(()) => {
            let words = closing_words(&whole, case, directory.path());
            tracing::info!("{words}");
            progress.finish(&words);
        }
        Err(_) => {
            progress.clear();
            if Checkpoints::of(case, directory).are_there() {
                progress.message(&format!("go on with: cav run --resume {}", directory.path().display()));
            }
        }
    }
    result.map(|()| directory.path().to_path_buf())
}

/// Makes the run directory ready and puts the effective case there.
pub fn prepare(case: &Case, options: &Options) -> Result<RunDirectory, RunError> {
    let path = directory_of(case, options.out.as_deref());
    wall::keep_apart(case, &path)?;
    let directory = RunDirectory::prepare(&path, options.force).map_err(RunError::Directory)?;
    directory.write_atomic(CASE, case.effective_toml().as_bytes())?;
    Ok(directory)
}

/// What the log begins with.
pub fn log_case(case: &Case) {
    let hash: String = case.hash().iter().map(|byte| format!("{byte:02x}")).collect();
    tracing::info!(version = env!("CARGO_PKG_VERSION"), case = case.name, hash, "run");
}

/// A pool of worker threads; all processors unless told otherwise.
pub fn thread_pool(threads: Option<usize>) -> Result<rayon::ThreadPool, RunError> {
    rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build().map_err(|error| {
        RunError::Start { what: "the worker threads".to_owned(), source: std::io::Error::other(error) }
    })
}

/// Whether a case has this side, and a peer to meet.
fn is_side(case: &Case, participant: Participant) -> bool {
    let here = match participant {
        Participant::Fluid => case.fluid.is_some(),
        Participant::Solid => case.solid.is_some(),
    };
    here && case.coupling.scheme.is_coupled()
}

/// One side by hand or as a child of the launcher.
pub fn run_side(
    case: &Case,
    options: &Options,
    joining: drive::Joining,
    child: bool,
    stop: &Stop,
    on_directory: impl FnOnce(&Path) + Send,
) -> Result<(), RunError> {
    // Before anything is made.
    coupler::check_run_id(&joining.run_id)?;
    if !is_side(case, joining.participant) {
        RunError::unless_whole(case)?;
        return Err(RunError::NoPeer { side: joining.participant.name() });
    }
    if !child {
        wall::check(case)?;
    }
    case.fits_memory([Participant::Fluid, Participant::Solid].map(|side| side == joining.participant))?;
    let path = directory_of(case, options.out.as_deref());
    let alone = case.coupling.scheme == Scheme::External;
    let leads = (joining.participant == Participant::Fluid || alone) && !child;
    // By hand the fluid makes the directory before the solid can find it, and both leave the summary.
    let prepared = if leads { Some(prepare(case, options)?) } else { None };
    let mut progress = Progress::new(case.time.end, options.quiet || child || !leads, options.verbosity);
    if let Some(directory) = &prepared {
        progress = progress.told_in(directory);
    }
    let directory = || {
        let directory = match prepared {
            Some(directory) => directory,
            None => RunDirectory::open(&path).map_err(RunError::Directory)?,
        };
        on_directory(directory.path());
        log_case(case);
        Ok(directory)
    };
    let mut throttle = crate::output::throttle::Throttle::new(Duration::from_millis(100));
    let participant = joining.participant;
    let mut on_step = |line: &ProgressLine| {
        if child && participant == Participant::Fluid && throttle.is_due() {
            announce(line);
        }
        progress.update(line);
    };
    let threads = thread_pool(options.threads)?;
    let result = threads.install(|| {
        let quiet = options.quiet;
        let notice: coupler::Notice = Box::new(move |words| {
            tracing::warn!("{words}");
            if !quiet {
                eprintln!("{words}");
            }
        });
        let joining = drive::Joining { notice: Some(notice), ..joining };
        drive::joined(case, joining, directory, options.keeping(), stop, &mut on_step)
    });
    if !child && path.exists() {
        let directory = RunDirectory::open(&path).map_err(RunError::Directory)?;
        // Both sides do this, one after the other: the last one finds both parts.
        let _turn = directory.wait_for_lock()?;
        conclude(&directory, case, result.as_ref().err())?;
    }
    result
}

/// A line for the launcher on standard output; it does not matter if nobody listens any more.
fn announce(line: &ProgressLine) {
    use std::io::Write;
    let mut out = std::io::stdout().lock();
    let _ = writeln!(out, "{}", line.to_json()).and_then(|()| out.flush());
}
