//! The runs of a study, one after the other, and what comes of them.

use std::path::{Path, PathBuf};

use serde_json::{Map, Value};

use crate::convergence::plan::{End, Found, Grid, Source, plan};
use crate::convergence::record;
use crate::output::run_directory::{CONVERGENCE, SUMMARY};
use crate::output::{OutputError, Progress, safe_file, summary};
use crate::run::process::launch_options::Options;
use crate::run::process::stop::Stop;
use crate::run::record::conclusion;
use crate::run::{RunError, resume, run};

/// What a study came to.
#[derive(Debug)]
pub struct Study {
    /// Its directory.
    pub directory: PathBuf,
    /// Its grids, the coarsest first.
    pub grids: Vec<Grid>,
    /// What became of each of them.
    pub ends: Vec<End>,
    /// The first error of a grid, if any failed.
    pub failure: Option<RunError>,
}

/// Runs a case on finer and finer grids, the coarsest first, each in its run directory within the study's, and writes what its numbers
/// come to after each of them.
///
/// What is complete there, of the same effective case, is not run again; what is not finished goes on from its newest checkpoint. A grid
/// that fails does not keep the finer ones from being run.
///
/// - `count`: how many grids; `options`: `out` is the study's directory, `sets` and `case_path` are what the processes of a
///   run read; `on_directory`: told of every run directory as soon as it is there, for the log.
/// - errors: as [`plan`], before anything is run; [`RunError::Interrupted`] and [`RunError::Terminated`]; the record cannot be written.
pub fn study(
    source: &Source,
    count: usize,
    options: &Options,
    stop: &Stop,
    mut on_directory: impl FnMut(&Path),
) -> Result<Study, RunError> {
    let (directory, grids) = plan(source, count, options.out.as_deref(), options.force)?;
    std::fs::create_dir_all(&directory).map_err(|error| {
        RunError::Directory(OutputError::io(&directory, "make the study's directory")(error))
    })?;
    let found: Vec<Found> = grids.iter().map(Grid::found).collect();
    let ends = found.iter().map(|found| match found {
        Found::Complete(summary) => End::Completed(summary.clone()),
        Found::Unfinished | Found::Nothing => End::None,
    });
    let mut study = Study { directory, ends: ends.collect(), grids, failure: None };
    let progress = Progress::new(0.0, options.quiet, options.verbosity);
    study.write()?;
    for (number, found) in found.into_iter().enumerate() {
        let grid = &study.grids[number];
        let told = format!("grid {number} of 0 to {}, {}", count - 1, grid.levels());
        if matches!(found, Found::Complete(_)) {
            progress.message(&format!("{told}: complete, in {}", grid.directory.display()));
            continue;
        }
        progress.message(&told);
        if let Some(stopped) = Stop::error(stop.flags()) {
            return Err(stopped);
        }
        let result = make(grid, &found, options, stop, &mut on_directory);
        study.ends[number] = match result {
            Ok(summary) => End::Completed(summary),
            Err(stopped @ (RunError::Interrupted | RunError::Terminated)) => return Err(stopped),
            Err(error) => {
                if let Some(stopped) = Stop::error(stop.flags()) {
                    return Err(stopped);
                }
                let end = End::Failed(cause(grid, &error));
                let error = grid.blame(error);
                // Into the log of its own run.
                tracing::error!("{error}");
                study.failure.get_or_insert(error);
                end
            }
        };
        study.write()?;
    }
    study.tell()?;
    Ok(study)
}

/// Why a grid's run failed. Of two processes the error only names the one that ended, and the summary says why.
fn cause(grid: &Grid, error: &RunError) -> String {
    if !matches!(error, RunError::Child { .. }) {
        return error.to_string();
    }
    let summary = summary::read(&grid.directory.join(SUMMARY)).ok();
    let told = summary.as_ref().and_then(|summary| summary.get("error")?.as_str());
    told.map_or_else(|| error.to_string(), str::to_owned)
}

/// Makes the run of a grid, or goes on with it; returns its summary.
fn make(
    grid: &Grid,
    found: &Found,
    options: &Options,
    stop: &Stop,
    on_directory: &mut impl FnMut(&Path),
) -> Result<Map<String, Value>, RunError> {
    let own = Options { out: Some(grid.directory.clone()), ..options.clone() };
    let gone_on = match found {
        Found::Unfinished => {
            // The case is in the directory, with all changes.
            let own = Options { sets: Vec::new(), ..own.clone() };
            match resume(&grid.directory, &own, stop, &mut *on_directory) {
                // Checkpoints of another version, or damaged ones: the run is kept aside and made anew.
                Err(RunError::Resume { .. } | RunError::Misfit(_)) => false,
                other => other.map(|_| true)?,
            }
        }
        Found::Complete(_) | Found::Nothing => false,
    };
    if !gone_on {
        run(&grid.case, &Options { sets: grid.sets.clone(), ..own }, stop, on_directory)?;
    }
    Ok(summary::read(&grid.directory.join(SUMMARY))?)
}

impl Study {
    /// Writes the record.
    fn write(&self) -> Result<(), RunError> {
        let path = self.directory.join(CONVERGENCE);
        Ok(safe_file::write(&path, self.text().as_bytes())?)
    }

    /// Lets the answers of all its runs say how sure they are.
    fn tell(&self) -> Result<(), RunError> {
        for (grid, end) in self.grids.iter().zip(&self.ends) {
            if matches!(end, End::Completed(_)) {
                conclusion::answer_anew(&grid.directory)?;
            }
        }
        Ok(())
    }

    /// The record as text.
    pub fn text(&self) -> String {
        let mut text = format!("{:#}", Value::Object(record::of(&self.grids, &self.ends)));
        text.push('\n');
        text
    }
}
