//! The grid under way in the directory of a study (`cav run --refine`).

use std::path::{Path, PathBuf};

use crate::output::run_directory::{CONVERGENCE, is_held};
use crate::output::run_state::{is_run, summary_of};
use crate::output::{OutputError, RunState, summary};

/// The run that is to be looked at: of a directory that is a run's itself, the run; of a study's the grid that is running, else the
/// first that has not reached its end, else the last.
///
/// - returns: its directory; of a study also its number and how many there are to be.
/// - errors: [`OutputError::NoRun`] if the directory is neither.
pub fn run_in(directory: &Path) -> Result<(PathBuf, Option<[usize; 2]>), OutputError> {
    if is_run(directory) {
        return Ok((directory.to_path_buf(), None));
    }
    let at = |number: usize| directory.join(format!("grid-{number}"));
    let grids: Vec<usize> = (0..).take_while(|number| is_run(&at(*number))).collect();
    let is_over = |number: &&usize| {
        summary_of(&at(**number))
            .is_ok_and(|summary| RunState::of(&at(**number), &summary) == RunState::Finished)
    };
    let running = grids.iter().find(|number| is_held(&at(**number)) == Some(true));
    let chosen = running.or_else(|| grids.iter().find(|number| !is_over(number))).or(grids.last());
    let planned = || summary::read(&directory.join(CONVERGENCE)).ok()?.get("grids")?.as_array().map(Vec::len);
    match chosen {
        Some(number) => Ok((at(*number), Some([*number, planned().unwrap_or(grids.len())]))),
        None => Err(OutputError::NoRun { path: directory.to_path_buf() }),
    }
}
