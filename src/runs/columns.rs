//! Which keys are shown, with their units.

use serde_json::Value;

use crate::convergence::numbers::KEY_NUMBERS;
use crate::output::per_depth;
use crate::runs::ListError;
use crate::runs::flat::{Flat, Scalar};
use crate::runs::listing::{Entry, Listing};
use crate::runs::record::PROGRAM;
use crate::runs::varied::varied;

/// Keys that are of no file: where a run is, what has become of it, the share of its time that is done, when it was begun, by which
/// version.
pub const OWN: [&str; 5] = ["path", "state", "progress", "started", "version"];

/// Keys of the summaries of runs that failed. That none has is a good answer to who asks for them.
const OF_FAILURES: [&str; 2] = ["error", "exit_code"];

/// Without these no number of a run means much.
const RESOLUTION: &str = "cells_per_radius";

/// Numbers that a narrow table has room for, the most wanted first.
const IN_TABLE: [&str; 8] = [
    "wall_pressure_peak",
    "load_impulse",
    "von_mises_peak",
    "plastic_strain_peak",
    "pit_depth",
    "min_equivalent_radius",
    "collapse_time",
    "jet_velocity_peak",
];

/// Asks for all keys.
pub const ALL: &str = "all";

/// Keys that are named when one is not known.
const MOST_NAMED: usize = 4;

/// A key as it stands in files, of one that people write: a material is known by its name.
fn aliases(key: &str) -> [String; 2] {
    [key.to_owned(), format!("{key}.name")]
}

impl Listing {
    /// The value of a key: of the run itself, of its summary, of its case.
    #[must_use]
    pub fn value(&self, entry: &Entry, key: &str) -> Option<Scalar> {
        match key {
            "path" => return Some(Scalar::Text(entry.path.clone())),
            "state" => return Some(Scalar::Text(entry.state.name().to_owned())),
            "progress" => return entry.progress.map(Scalar::Float),
            "started" => return Some(Scalar::Text(when(entry.started))),
            "version" => {
                let program = self.of_files(entry, PROGRAM)?.to_string();
                return Some(Scalar::Text(program.trim_start_matches("cav ").to_owned()));
            }
            _ => {}
        }
        self.of_files(entry, key).cloned()
    }

    fn of_files<'a>(&self, entry: &'a Entry, key: &str) -> Option<&'a Scalar> {
        aliases(key).iter().find_map(|key| {
            let number = self.keys.get(key)?;
            let of = |flat: &'a Flat| flat.iter().find(|(of, _)| *of == number).map(|(_, value)| value);
            of(&entry.summary).or_else(|| of(&entry.case))
        })
    }

    /// Whether some run of the folder may have the key.
    ///
    /// - errors: [`ListError::UnknownKey`], with those that may be meant.
    pub fn check(&self, key: &str) -> Result<(), ListError> {
        let is_known = OWN.contains(&key)
            || OF_FAILURES.contains(&key)
            || aliases(key).iter().any(|key| self.keys.get(key).is_some());
        if is_known || self.count == 0 {
            return Ok(());
        }
        let end = format!(".{key}");
        let ending = self.keys.names().iter().filter(|name| name.ends_with(&end)).map(String::as_str);
        let known = self.keys.names().iter().map(String::as_str).chain(OWN);
        let mut near: Vec<_> = known.map(|name| (strsim::damerau_levenshtein(key, name), name)).collect();
        near.sort();
        let similar =
            near.into_iter().filter(|(distance, _)| *distance <= 1 + key.len() / 5).map(|(_, name)| name);
        let mut named: Vec<&str> = ending.chain(similar).collect();
        named.dedup();
        named.truncate(MOST_NAMED);
        let quoted: Vec<String> = named.iter().map(|name| format!("`{name}`")).collect();
        let nearest = if quoted.is_empty() {
            String::new()
        } else {
            format!("; is one of these meant: {}?", quoted.join(", "))
        };
        Err(ListError::UnknownKey { key: key.to_owned(), nearest })
    }

    /// The keys of the cases that differ among the runs.
    #[must_use]
    pub fn varied(&self) -> Vec<String> {
        varied(&self.keys, &self.entries)
    }

    /// Keys of the columns of a file: those asked for, else the run's own, what was varied, and every key number that a run has.
    ///
    /// - errors: a key that is asked for is not known.
    pub fn columns(&self, asked: Option<&[String]>) -> Result<Vec<String>, ListError> {
        let own = || OWN.map(str::to_owned).into_iter();
        match asked {
            Some([all]) if all == ALL => {
                let files =
                    self.keys.names().iter().filter(|name| *name != "answer" && !name.starts_with("answer."));
                Ok(own().chain(["answer".to_owned()]).chain(files.cloned()).collect())
            }
            Some(asked) => {
                asked.iter().try_for_each(|key| if key == "answer" { Ok(()) } else { self.check(key) })?;
                let path = (!asked.iter().any(|key| key == "path")).then(|| "path".to_owned());
                Ok(path.into_iter().chain(asked.iter().cloned()).collect())
            }
            None => {
                let numbers = KEY_NUMBERS.iter().map(|(name, _)| *name);
                let numbers = [RESOLUTION].into_iter().chain(numbers).filter(|name| self.is_there(name));
                Ok(own().chain(self.varied()).chain(numbers.map(str::to_owned)).collect())
            }
        }
    }

    /// The same of a table for people, the most wanted first.
    ///
    /// - errors: a key that is asked for is not known.
    pub fn table_columns(&self, asked: Option<&[String]>) -> Result<Vec<String>, ListError> {
        if asked.is_some() {
            return self.columns(asked);
        }
        // Where nothing can yield there is no pit to speak of.
        let has_pits = self.is_there("plastic_strain_peak");
        let is_shown = |name: &&&str| self.is_there(name) && (has_pits || **name != "pit_depth");
        let numbers = IN_TABLE.iter().filter(is_shown).map(|name| (*name).to_owned());
        let first = ["path", "state"].map(str::to_owned).into_iter().chain(self.varied());
        let resolution = Some(RESOLUTION).filter(|name| self.is_there(name)).map(str::to_owned);
        let last = ["started", "version"].map(str::to_owned);
        Ok(first.chain(resolution).chain(numbers).chain(last).collect())
    }

    /// Whether a run of those listed has a value of a key.
    fn is_there(&self, key: &str) -> bool {
        let Some(number) = self.keys.get(key) else { return false };
        let has = |flat: &Flat| flat.iter().any(|(of, value)| *of == number && !value.is_null());
        self.entries.iter().any(|entry| has(&entry.summary) || has(&entry.case))
    }

    /// Unit of a key number of a run; empty for what has none or is not known to have one.
    #[must_use]
    pub fn unit_of(&self, entry: &Entry, key: &str) -> &'static str {
        let is_planar = self.value(entry, "geometry") == Some(Scalar::Text("planar".to_owned()));
        if is_planar { per_depth(unit(key)) } else { unit(key) }
    }

    /// The same of all runs listed; empty also where they differ in it.
    #[must_use]
    pub fn unit(&self, key: &str) -> &'static str {
        let mut units = self.entries.iter().map(|entry| self.unit_of(entry, key));
        let first = units.next().unwrap_or(unit(key));
        if units.all(|unit| unit == first) { first } else { "" }
    }

    /// What a run found, in sentences.
    #[must_use]
    pub fn answer(&self, entry: &Entry) -> Vec<String> {
        let of = |key: &str| {
            let number = self.keys.get(key)?;
            entry.summary.iter().find(|(of, _)| *of == number).map(|(_, value)| value.to_string())
        };
        match of("answer") {
            // Long lists are kept as they were written.
            Some(list) => serde_json::from_str::<Vec<String>>(&list).unwrap_or_else(|_| vec![list]),
            None => (0..).map_while(|number| of(&format!("answer.{number}"))).collect(),
        }
    }
}

/// Unit of a key number of an axisymmetric run; empty for what is none.
fn unit(key: &str) -> &'static str {
    KEY_NUMBERS.iter().find(|(name, _)| *name == key).map_or("", |(_, unit)| *unit)
}

/// A time as people and programs read it.
#[must_use]
pub fn when(seconds: i64) -> String {
    let after = std::time::Duration::from_secs(u64::try_from(seconds).unwrap_or(0).min(250_000_000_000));
    humantime::format_rfc3339_seconds(std::time::UNIX_EPOCH + after).to_string()
}

/// A value as JSON has it.
#[must_use]
pub fn as_json(value: Option<Scalar>) -> Value {
    match value {
        None | Some(Scalar::Null) => Value::Null,
        Some(Scalar::Bool(value)) => Value::Bool(value),
        Some(Scalar::Integer(whole)) => whole.into(),
        Some(Scalar::Float(number)) => number.into(),
        Some(Scalar::Text(text)) => text.into(),
    }
}
