//! The runs of a folder with their states.

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::output::RunState;
use crate::output::progress_file::Standing;
use crate::output::run_directory::is_held;
use crate::runs::ListError;
use crate::runs::condition::Condition;
use crate::runs::find::{Found, find};
use crate::runs::flat::{Flat, Keys, Scalar};
use crate::runs::index::Index;
use crate::runs::record::Record;

/// What is asked of a listing.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Asked {
    /// Conditions that all must hold, as of `--where`.
    pub conditions: Vec<String>,
    /// Names of states of which one must hold; of none any does.
    pub states: Vec<String>,
    /// The key that the runs are sorted by; by path without.
    pub sort: Option<String>,
    /// The other way round.
    pub reverse: bool,
}

/// A run of a listing.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Its path below the folder.
    pub path: String,
    /// What has become of it.
    pub state: RunState,
    /// How much of its simulated time is done, if it says so.
    pub progress: Option<f64>,
    /// When it was begun, s since 1970.
    pub started: i64,
    /// Its effective case.
    pub case: Flat,
    /// Its summary.
    pub summary: Flat,
}

/// The runs of a folder.
#[derive(Debug)]
pub struct Listing {
    /// The folder.
    pub folder: PathBuf,
    /// The keys of all cases and summaries.
    pub keys: Keys,
    /// Those that were asked for.
    pub entries: Vec<Entry>,
    /// How many there are in all.
    pub count: usize,
    /// What could not be done, in sentences.
    pub notes: Vec<String>,
}

impl Listing {
    /// All runs below a folder that answer to what is asked.
    ///
    /// - errors: the folder cannot be read; what is asked makes no sense.
    pub fn of(folder: &Path, asked: &Asked) -> Result<Self, ListError> {
        let conditions = asked.conditions.iter().map(|text| Condition::parse(text));
        let conditions = conditions.collect::<Result<Vec<_>, _>>()?;
        let states = asked.states.iter().map(|name| {
            let of_name = RunState::NAMES.iter().find(|(known, _)| known == name);
            of_name.map(|(_, state)| *state).ok_or_else(|| ListError::State(name.clone()))
        });
        let states = states.collect::<Result<Vec<_>, _>>()?;
        let mut listing = Self::whole(folder)?;
        for condition in &conditions {
            listing.check(&condition.key)?;
        }
        let is_wanted = |entry: &Entry| {
            (states.is_empty() || states.contains(&entry.state))
                && conditions
                    .iter()
                    .all(|condition| condition.holds(listing.value(entry, &condition.key).as_ref()))
        };
        let wanted: Vec<bool> = listing.entries.iter().map(is_wanted).collect();
        let mut number = 0;
        listing.entries.retain(|_| {
            number += 1;
            wanted[number - 1]
        });
        if let Some(key) = &asked.sort {
            listing.check(key)?;
            listing.sort(key, asked.reverse);
        } else if asked.reverse {
            listing.entries.reverse();
        }
        Ok(listing)
    }

    /// All runs below a folder.
    fn whole(folder: &Path) -> Result<Self, ListError> {
        let (found, unreadable) = find(folder)?;
        let mut notes = Vec::new();
        if unreadable > 0 {
            notes.push(format!("{unreadable} folders in {} may not be read", folder.display()));
        }
        let records = records(folder, &found, &mut notes);
        let mut keys = Keys::default();
        let mut entries = Vec::with_capacity(records.len());
        for record in records {
            let [case, summary] =
                [&record.case, &record.summary].map(|json| keys.read(json).unwrap_or_default());
            entries.push(Entry {
                path: record.found.path,
                state: RunState::Finished,
                progress: Some(1.0),
                started: record.found.started,
                case,
                summary,
            });
        }
        let count = entries.len();
        let mut listing = Self { folder: folder.to_path_buf(), keys, entries, count, notes };
        listing.look_at_those_not_finished();
        Ok(listing)
    }

    /// States change without any file: a process ends.
    fn look_at_those_not_finished(&mut self) {
        let key = |name: &str| self.keys.get(name);
        let (completed, error) = (key("completed"), key("error"));
        let value = |flat: &Flat, key: Option<u32>| {
            flat.iter().find(|(of, _)| Some(*of) == key).map(|(_, value)| value.clone())
        };
        for entry in &mut self.entries {
            if value(&entry.summary, completed) == Some(Scalar::Bool(true)) {
                continue;
            }
            let directory = self.folder.join(&entry.path);
            entry.state = match value(&entry.summary, error) {
                _ if is_held(&directory) == Some(true) => RunState::Running,
                Some(_) => RunState::Failed,
                None => RunState::Interrupted,
            };
            let standing = Standing::read(&directory).filter(|standing| standing.end > 0.0);
            entry.progress = standing.map(|standing| (standing.line.time / standing.end).clamp(0.0, 1.0));
        }
    }

    /// By the value of a key; runs without one come last.
    fn sort(&mut self, key: &str, reverse: bool) {
        let mut keyed: Vec<_> = std::mem::take(&mut self.entries)
            .into_iter()
            .map(|entry| (self.value(&entry, key).filter(|value| !value.is_null()), entry))
            .collect();
        keyed.sort_by(|(a, _), (b, _)| {
            let (Some(one), Some(other)) = (a, b) else { return a.is_none().cmp(&b.is_none()) };
            let order = match (one.number(), other.number()) {
                (Some(one), Some(other)) => one.total_cmp(&other),
                _ => one.to_string().cmp(&other.to_string()),
            };
            if reverse { order.reverse() } else { order }
        });
        self.entries = keyed.into_iter().map(|(_, entry)| entry).collect();
    }
}

/// The records of all runs: from the index where that is up to date, else from the runs' files, and then into it.
fn records(folder: &Path, found: &[Found], notes: &mut Vec<String>) -> Vec<Record> {
    let mut told = |error: &dyn std::fmt::Display| {
        notes.push(format!(
            "there is no index that is up to date, every listing reads all runs: {} cannot be used: {error}",
            folder.join(super::index::FILE).display()
        ));
    };
    // A run's own directory gets no files of others.
    let is_folder = found.iter().any(|found| found.path != ".");
    let mut index = if is_folder { Index::open(folder).inspect_err(|error| told(error)).ok() } else { None };
    let known = index.as_ref().map(|index| index.known(found));
    let mut known = match known {
        Some(Ok(known)) => known,
        Some(Err(error)) => {
            told(&error);
            index = None;
            Default::default()
        }
        None => Default::default(),
    };
    let old: Vec<Option<Record>> = found.iter().map(|found| known.remove(found.path.as_str())).collect();
    let is_new: Vec<bool> = old.iter().map(Option::is_none).collect();
    let records: Vec<Record> = old
        .into_par_iter()
        .zip(found)
        .map(|(old, found)| old.unwrap_or_else(|| Record::read(folder, found)))
        .collect();
    let new: Vec<&Record> =
        records.iter().zip(&is_new).filter(|(_, new)| **new).map(|(record, _)| record).collect();
    if let Some(index) = &mut index
        && let Err(error) = index.update(&new, found)
        && !new.is_empty()
    {
        told(&error);
    }
    records
}
