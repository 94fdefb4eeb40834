//! What is kept of a run: its case and its summary, flat.

use std::fs;
use std::path::Path;

use serde_json::{Map, Value};

use crate::output::history;
use crate::output::run_directory::{CASE, FLUID_HISTORY, SOLID_HISTORY, SUMMARY};
use crate::output::summary;
use crate::runs::find::Found;
use crate::runs::flat::flatten;

/// Key of the program that made a run, in its summary.
pub const PROGRAM: &str = "program";

/// Tables of a summary that say how the time went, and are long.
const LEFT_OUT: [&str; 2] = ["stage_seconds", "coupling"];

/// A run as its files have it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Record {
    /// Its path and the ages of its files.
    pub found: Found,
    /// The effective case, flat, as JSON.
    pub case: String,
    /// The summary likewise.
    pub summary: String,
}

impl Record {
    /// Reads the files of a run; of one that cannot be read nothing is known.
    #[must_use]
    pub fn read(folder: &Path, found: &Found) -> Self {
        let directory = folder.join(&found.path);
        let mut numbers = summary::read(&directory.join(SUMMARY)).unwrap_or_default();
        LEFT_OUT.into_iter().for_each(|table| drop(numbers.remove(table)));
        if !numbers.contains_key(PROGRAM) {
            // A run of an earlier version, which says it in its histories alone.
            let files = [FLUID_HISTORY, SOLID_HISTORY].map(|name| directory.join(name));
            if let Some(program) = files.iter().find_map(|file| history::program(file)) {
                numbers.insert(PROGRAM.to_owned(), Value::String(program));
            }
        }
        Self { found: found.clone(), case: flat(case(&directory)), summary: flat(numbers) }
    }
}

fn case(directory: &Path) -> Map<String, Value> {
    let text = fs::read_to_string(directory.join(CASE)).unwrap_or_default();
    toml::from_str(&text).unwrap_or_default()
}

fn flat(tables: Map<String, Value>) -> String {
    Value::Object(flatten(tables)).to_string()
}
