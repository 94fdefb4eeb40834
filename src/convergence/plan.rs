//! The grids of a study: the case on each, where its run is, and what is there of it already.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Map, Value, json};

use crate::case::{Case, CaseErrors};
use crate::output::run_directory::{CASE, CONVERGENCE_SUFFIX, SUMMARY};
use crate::output::{OutputError, summary};
use crate::run::process::launch::directory_of;
use crate::run::{RunError, wall};

/// How many grids a study may have.
pub const GRIDS: std::ops::RangeInclusive<usize> = 2..=5;

/// What a case is read from.
#[derive(Clone, Debug)]
pub struct Source {
    /// The text of the case file.
    pub text: String,
    /// What the case is called.
    pub name: String,
    /// What errors call the text.
    pub shown: String,
    /// Changes, as of `--set`.
    pub sets: Vec<String>,
}

impl Source {
    /// A case file with changes to it.
    ///
    /// # Errors
    /// There is no such file. What is in it is looked at later.
    pub fn of_file(path: &Path, sets: &[String]) -> Result<Self, CaseErrors> {
        let name = path.file_stem().map_or_else(|| "case".into(), |stem| stem.to_string_lossy());
        Ok(Self {
            text: Case::text_of(path)?,
            name: name.into_owned(),
            shown: path.display().to_string(),
            sets: sets.to_vec(),
        })
    }
}

/// A grid of a study.
#[derive(Clone, Debug)]
pub struct Grid {
    /// How often the cells of the case are halved.
    pub number: usize,
    /// The case on it.
    pub case: Case,
    /// The changes that make it of the case's text.
    pub sets: Vec<String>,
    /// Its run directory.
    pub directory: PathBuf,
}

/// What is there of a grid's run.
#[derive(Clone, Debug, PartialEq)]
pub enum Found {
    /// All of it, with this summary.
    Complete(Map<String, Value>),
    /// A part, to go on with.
    Unfinished,
    /// Nothing, or that of another case.
    Nothing,
}

/// What became of a grid's run.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// It has not been run.
    None,
    /// It reached its end, with this summary.
    Completed(Map<String, Value>),
    /// It failed, with this error.
    Failed(String),
}

impl Grid {
    /// Its levels as keys of the case: `fluid.levels = 5, solid.levels = 3`.
    pub fn levels(&self) -> String {
        let sides = [
            ("fluid", self.case.fluid.as_ref().map(|side| side.grid.levels)),
            ("solid", self.case.solid.as_ref().map(|side| side.grid.levels)),
        ];
        let of = |(side, levels): (&str, Option<usize>)| Some(format!("{side}.levels = {}", levels?));
        sides.into_iter().filter_map(of).collect::<Vec<_>>().join(", ")
    }

    /// Says that an error is this grid's.
    pub fn blame(&self, source: RunError) -> RunError {
        RunError::Grid { number: self.number, levels: self.levels(), source: Box::new(source) }
    }

    /// What is there of its run: what another effective case has left counts for nothing.
    pub fn found(&self) -> Found {
        let is_same = |text: String| text == self.case.effective_toml();
        if !fs::read_to_string(self.directory.join(CASE)).is_ok_and(is_same) {
            return Found::Nothing;
        }
        match summary::read(&self.directory.join(SUMMARY)) {
            Ok(summary) if is_completed(&summary) => Found::Complete(summary),
            _ => Found::Unfinished,
        }
    }

    /// Whether the run can be made on this machine and in its directory.
    fn check(&self, force: bool) -> Result<(), RunError> {
        RunError::unless_whole(&self.case)?;
        self.case.fits_memory([true; 2])?;
        wall::check(&self.case)?;
        let finished =
            |path: &Path| summary::read(&path.join(SUMMARY)).is_ok_and(|found| is_completed(&found));
        if !force && self.found() == Found::Nothing && finished(&self.directory) {
            return Err(RunError::Directory(OutputError::Finished { path: self.directory.clone() }));
        }
        Ok(())
    }
}

fn is_completed(summary: &Map<String, Value>) -> bool {
    summary.get("completed") == Some(&json!(true))
}

/// The grids of a study, the coarsest first, none of which has been begun.
///
/// - `count`: how many; grid k has cells 2^k times narrower than the case. `out`: the study's directory; else the case's own run directory
///   with `-convergence` behind. `force`: finished runs of other cases there may be replaced.
/// - errors: [`RunError::Refine`] for a count or a directory that will not do; what is wrong with a grid, the finest one first, as
///   [`RunError::Grid`]. Nothing has been made then.
pub fn plan(
    source: &Source,
    count: usize,
    out: Option<&Path>,
    force: bool,
) -> Result<(PathBuf, Vec<Grid>), RunError> {
    if !GRIDS.contains(&count) {
        let (least, most) = (GRIDS.start(), GRIDS.end());
        return Err(RunError::Refine(format!(
            "{count} grids are asked for; give a number from {least} to {most}"
        )));
    }
    let Source { text, name, shown, sets } = source;
    let case = Case::read(text, name, shown, sets)?;
    let root = out.map_or_else(
        || {
            let mut own = directory_of(&case, None).into_os_string();
            own.push(CONVERGENCE_SUFFIX);
            PathBuf::from(own)
        },
        Path::to_path_buf,
    );
    if root.join(SUMMARY).exists() {
        let shown = root.display();
        let reason = format!(
            "{shown} is the directory of a run; give another one with --out, for one run for each grid"
        );
        return Err(RunError::Refine(reason));
    }
    let mut grids = Vec::new();
    for number in 0..count {
        let (case, sets) =
            Case::refined(text, name, shown, sets, number).map_err(|errors| RunError::Grid {
                number,
                levels: format!("{number} levels more than the case has"),
                source: Box::new(errors.into()),
            })?;
        grids.push(Grid { number, case, sets, directory: root.join(format!("grid-{number}")) });
    }
    for grid in grids.iter().rev() {
        grid.check(force).map_err(|error| grid.blame(error))?;
    }
    Ok((root, grids))
}
