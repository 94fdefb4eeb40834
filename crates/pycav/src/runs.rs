//! The runs in a folder.

use std::path::PathBuf;

use cav::output::run_directory::SUMMARY;
use cav::output::{RunState, summary};
use cav::runs::{Asked, ListError, Listing};
use pyo3::exceptions::{PyFileNotFoundError, PyValueError};
use pyo3::prelude::*;

/// Lists the runs in a folder, as `cav list --json` does.
///
/// Returns the runs as JSON, the keys of their columns, units by key, and what could not be done.
#[pyfunction]
#[pyo3(signature = (folder, conditions, states, sort=None, columns=None))]
#[expect(clippy::type_complexity, reason = "a tuple of Python's")]
pub fn runs(
    py: Python<'_>,
    folder: PathBuf,
    conditions: Vec<String>,
    states: Vec<String>,
    sort: Option<String>,
    columns: Option<Vec<String>>,
) -> PyResult<(String, Vec<String>, Vec<(String, &'static str)>, Vec<String>)> {
    let asked = Asked { conditions, states, sort, reverse: false };
    let listed = py.detach(|| {
        let listing = Listing::of(&folder, &asked)?;
        let columns = listing.columns(columns.as_deref())?;
        let units: Vec<_> = (columns.iter())
            .map(|key| (key.clone(), listing.unit(key)))
            .filter(|(_, unit)| !unit.is_empty())
            .collect();
        Ok((listing.json(&columns), columns, units, listing.notes))
    });
    listed.map_err(|error: ListError| match error {
        ListError::Folder { .. } => PyFileNotFoundError::new_err(error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    })
}

/// The state of the run in a directory now, by the names that `runs` has.
#[pyfunction]
pub fn run_state(directory: PathBuf) -> &'static str {
    let summary = summary::read(&directory.join(SUMMARY)).unwrap_or_default();
    RunState::of(&directory, &summary).name()
}
