//! `cav run --resume`: a run directory taken up again.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use coupler::Participant;
use serde_json::json;

use crate::case::{Case, CaseErrors, available_memory};
use crate::output::run_directory::{CASE, FLUID_HISTORY, SOLID_HISTORY, SUMMARY};
use crate::output::{Join, OutputError, Progress, RunDirectory, history, join_histories, summary};
use crate::run::checkpoints::Checkpoints;
use crate::run::process::launch::carry_out;
use crate::run::process::launch_options::Options;
use crate::run::process::longer;
use crate::run::process::stop::Stop;
use crate::run::{RunError, wall};

/// How long to wait for what is left of a killed run to end: its sides finish the step under way.
const PATIENCE: Duration = Duration::from_secs(60);
const LOOK_INTERVAL: Duration = Duration::from_millis(50);

/// Goes on with the run in a directory, from its newest checkpoint that is whole; without any it begins again. One that is finished
/// goes on only to a later end, [`Options::end`].
///
/// - errors: it is no run's directory, its case was changed, none of its checkpoints can be used; it is finished and cannot go on to
///   that end; else as [`crate::run::run`].
pub fn resume(
    path: &Path,
    options: &Options,
    stop: &Stop,
    on_directory: impl FnOnce(&Path),
) -> Result<PathBuf, RunError> {
    let refuse = |reason: &str| RunError::Resume { path: path.to_path_buf(), reason: reason.to_owned() };
    if !path.join(CASE).is_file() {
        return Err(refuse("it holds no case.toml; give the directory of a run"));
    }
    let mut progress = Progress::new(0.0, options.quiet, options.verbosity);
    let directory = take_up(path, stop, &mut progress)?;
    on_directory(directory.path());
    let summary = summary::read(&directory.file(SUMMARY)).unwrap_or_default();
    let is_finished = summary.get("completed") == Some(&json!(true));
    if is_finished && options.end.is_none() {
        let words = format!(
            "the run in {} is finished; there is nothing to do (--end TIME lets it end later)",
            path.display()
        );
        tracing::info!("{words}");
        progress.message(&words);
        return Ok(directory.path().to_path_buf());
    }
    let before = case_of(&directory)?;
    let case = match options.end {
        Some(_) if summary.get("settled") == Some(&json!(true)) => {
            return Err(refuse("its surface is still, which it waited for; there is nothing to go on for"));
        }
        Some(end) if end < before.time.end || is_finished && end == before.time.end => {
            let reason = format!("it ends at {:?} s; --end {end:?} is no later", before.time.end);
            return Err(refuse(&reason));
        }
        Some(end) => longer::with_end(&before, end, &directory.file(CASE).display().to_string())?,
        None => before.clone(),
    };
    // What it begins from is needed again, and has a say in which case it is.
    wall::check(&case)?;
    case.fits_memory([true; 2])?;
    directory.tidy()?;
    let checkpoints = Checkpoints::of(&case, &directory).or_of(&before);
    let from = checkpoints.newest(|warning| {
        tracing::warn!("{warning}");
        progress.message(&format!("warning: {warning}"));
    })?;
    if let Some(step) = from {
        room_for(&case, &checkpoints, step)?;
    } else if is_finished {
        return Err(refuse(
            "it is finished and has no checkpoint to go on from (it had one step, or was made with --checkpoint-every off, or its \
             directory checkpoints/ was removed); run its case.toml with a later time.end in another directory",
        ));
    }
    if options.end.is_some() {
        longer::take_over(&directory, &case, &checkpoints, from)?;
    }
    let words = match from {
        Some(step) => format!("going on from the checkpoint of step {step}"),
        None => "there is no checkpoint yet: the run begins again from the start".to_owned(),
    };
    tracing::info!("{words}");
    progress.message(&words);
    drop(progress);
    if from.is_some() {
        // So that the run can be read at once, and if it is killed.
        join_histories(directory.path(), &[FLUID_HISTORY, SOLID_HISTORY], Join::Links)?;
    }
    let options = Options {
        case_path: directory.file(CASE),
        out: Some(directory.path().to_path_buf()),
        name: Some(case.name.clone()),
        from,
        ..options.clone()
    };
    carry_out(&case, &options, &directory, stop)
}

/// A checkpoint's memory while it is taken up, as a multiple of its length: its bytes, what they mean, and the solver.
const TAKING_UP: f64 = 4.0;

/// Whether there is memory to take up the checkpoint of a step.
fn room_for(case: &Case, checkpoints: &Checkpoints, step: u64) -> Result<(), RunError> {
    let sides = [(Participant::Fluid, case.fluid.is_some()), (Participant::Solid, case.solid.is_some())];
    let paths = sides.iter().filter(|(_, is_there)| *is_there).map(|(side, _)| checkpoints.path(*side, step));
    let bytes: u64 = paths.filter_map(|path| std::fs::metadata(path).ok()).map(|file| file.len()).sum();
    match available_memory().filter(|available| TAKING_UP * bytes as f64 > *available) {
        None => Ok(()),
        Some(available) => {
            let needed = TAKING_UP * bytes as f64;
            let reason = format!(
                "its checkpoint of step {step} takes about {:.0} MiB of memory to go on from, but {:.0} MiB are available; free \
                 some, or go on on a larger machine",
                needed / f64::from(1 << 20),
                available / f64::from(1 << 20)
            );
            Err(RunError::Resume { path: checkpoints.path(Participant::Fluid, step), reason })
        }
    }
}

/// Locks the directory; processes that a killed launcher left behind hold it until they have ended.
fn take_up(path: &Path, stop: &Stop, progress: &mut Progress) -> Result<RunDirectory, RunError> {
    let start = Instant::now();
    let mut is_told = false;
    loop {
        match RunDirectory::resume(path) {
            Err(OutputError::InUse { .. }) if start.elapsed() < PATIENCE => {
                if !is_told && start.elapsed() > Duration::from_secs(1) {
                    progress.message("waiting for the processes that still hold the directory");
                    is_told = true;
                }
                if let Some(stopped) = Stop::error(stop.flags()) {
                    return Err(stopped);
                }
                std::thread::sleep(LOOK_INTERVAL);
            }
            other => return other.map_err(RunError::Directory),
        }
    }
}

/// The case that the run was started with, under the name it had.
fn case_of(directory: &RunDirectory) -> Result<Case, RunError> {
    let path = directory.file(CASE);
    let text = std::fs::read_to_string(&path)
        .map_err(|source| RunError::Directory(OutputError::io(&path, "read")(source)))?;
    let written =
        [FLUID_HISTORY, SOLID_HISTORY].iter().find_map(|name| history::case_name(&directory.file(name)));
    let from_directory = || directory.path().file_name().map(|name| name.to_string_lossy().into_owned());
    let name = written.or_else(from_directory).unwrap_or_else(|| "case".to_owned());
    Case::read(&text, &name, &path.display().to_string(), &[]).map_err(|errors: CaseErrors| errors.into())
}
