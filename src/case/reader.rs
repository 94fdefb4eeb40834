//! Reading TOML tables key by key, so that every fault of a file is found in one go.
//!
//! A [`Table`] hands out the values of the keys it is asked for and remembers the keys; what is left over at the end
//! is an unknown key, and the keys asked for are the valid names.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::suggest;
use super::values::whole;
pub(super) use super::values::{Faults, Given, LARGEST, SMALLEST, array, describe, number, pair, wrong_type};

/// How long a side may be told to wait for the other, s: from a millisecond to thirty years.
const WAITING: std::ops::RangeInclusive<f64> = 1e-3..=1e9;

/// A TOML table being read. `None` from a getter means "absent" or "present but faulty"; the fault is recorded then.
pub(super) struct Table<'a> {
    entries: &'a DeTable<'a>,
    pub path: String,
    pub span: Range<usize>,
    asked: Vec<&'static str>,
}

impl<'a> Table<'a> {
    pub fn root(document: &'a Spanned<DeTable<'a>>) -> Self {
        Self { entries: document.get_ref(), path: String::new(), span: 0..0, asked: Vec::new() }
    }

    /// The path of one of its keys.
    pub fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    /// Whether the key is there, whatever its value.
    pub fn has(&self, key: &str) -> bool {
        self.entries.contains_key(key)
    }

    /// Where a key stands, if it is there, whatever its value.
    pub fn place(&self, key: &str) -> Option<Given<()>> {
        let value = self.entries.get(key)?;
        Some(Given { value: (), path: self.path_of(key), span: value.span() })
    }

    /// The value of a key, if it is a string; whoever asks reads it, too.
    pub fn text(&self, key: &str) -> Option<&'a str> {
        match self.entries.get(key)?.get_ref() {
            DeValue::String(text) => Some(text),
            _ => None,
        }
    }

    /// The value of a key as it stands.
    pub fn raw(&mut self, key: &'static str) -> Option<Given<&'a DeValue<'a>>> {
        self.asked.push(key);
        let value = self.entries.get(key)?;
        Some(Given { value: value.get_ref(), path: self.path_of(key), span: value.span() })
    }

    /// Records that a key is missing.
    pub fn missing(&self, key: &str, help: impl Into<String>, faults: &mut Faults) {
        let what = if self.path.is_empty() { "the case" } else { "its table" };
        faults.at(&self.path_of(key), &self.span, format!("`{key}` is missing from {what}"), help);
    }

    /// A sub-table, `[path.key]`.
    pub fn table(&mut self, key: &'static str, faults: &mut Faults) -> Option<Self> {
        let given = self.raw(key)?;
        Self::from_value(given, faults)
    }

    fn from_value(given: Given<&'a DeValue<'a>>, faults: &mut Faults) -> Option<Self> {
        if let DeValue::Table(entries) = given.value {
            Some(Self { entries, path: given.path, span: given.span, asked: Vec::new() })
        } else {
            let help = format!("write it as a table: [{}] and its keys below", given.path);
            wrong_type(&given, "a table", help, faults);
            None
        }
    }

    /// The elements of an array of tables, `[[path.key]]`.
    pub fn tables(&mut self, key: &'static str, faults: &mut Faults) -> Vec<Self> {
        let Some(given) = self.raw(key) else { return Vec::new() };
        let DeValue::Array(array) = given.value else {
            let help = format!("write each as [[{}]] and its keys below", given.path);
            wrong_type(&given, "an array of tables", help, faults);
            return Vec::new();
        };
        array
            .iter()
            .enumerate()
            .filter_map(|(index, element)| {
                let path = format!("{}.{index}", given.path);
                Self::from_value(Given { value: element.get_ref(), path, span: element.span() }, faults)
            })
            .collect()
    }

    /// A finite number; integers count.
    pub fn number(&mut self, key: &'static str, unit: &str, faults: &mut Faults) -> Option<Given<f64>> {
        let given = self.raw(key)?;
        let value = number(&given, unit, faults)?;
        Some(Given { value, path: given.path, span: given.span })
    }

    /// A finite number that must be there.
    pub fn required(&mut self, key: &'static str, unit: &str, faults: &mut Faults) -> Option<Given<f64>> {
        if !self.has(key) {
            self.missing(key, format!("give `{key} = ...` in {unit}"), faults);
        }
        self.number(key, unit, faults)
    }

    /// A positive number; a default makes it optional.
    pub fn positive(&mut self, key: &'static str, unit: &str, faults: &mut Faults) -> Option<f64> {
        let given = self.number(key, unit, faults)?;
        let got = given.value;
        if got >= SMALLEST {
            return Some(got);
        }
        let message = if got > 0.0 {
            format!("must be {SMALLEST:e} at least, got {got:?}")
        } else {
            format!("must be positive, got {got:?}")
        };
        faults.of(&given, message, format!("give a number > 0 in {unit}"));
        None
    }

    /// A time to wait, s, within a range that clocks can count.
    pub fn waiting(&mut self, key: &'static str, faults: &mut Faults) -> Option<f64> {
        let given = self.number(key, "s", faults)?;
        if WAITING.contains(&given.value) {
            return Some(given.value);
        }
        let (least, most) = (WAITING.start(), WAITING.end());
        let message = if given.value <= 0.0 {
            format!("must be positive, got {:?}", given.value)
        } else {
            format!("must be from {least:?} to {most:e} s, got {:?}", given.value)
        };
        faults.of(&given, message, format!("give seconds from {least:?} to {most:e}"));
        None
    }

    /// A positive number that must be there.
    pub fn required_positive(&mut self, key: &'static str, unit: &str, faults: &mut Faults) -> Option<f64> {
        if !self.has(key) {
            self.missing(key, format!("give `{key} = ...` in {unit}"), faults);
        }
        self.positive(key, unit, faults)
    }

    /// A list of finite numbers.
    pub fn numbers(&mut self, key: &'static str, unit: &str, faults: &mut Faults) -> Option<Given<Vec<f64>>> {
        let given = self.raw(key)?;
        let elements = array(&given, "a list of numbers", unit, faults)?;
        let values: Vec<Option<f64>> = elements.iter().map(|e| number(e, unit, faults)).collect();
        let value = values.into_iter().collect::<Option<Vec<f64>>>()?;
        Some(Given { value, path: given.path, span: given.span })
    }

    /// Two finite numbers, `[a, b]`.
    pub fn pair(&mut self, key: &'static str, unit: &str, faults: &mut Faults) -> Option<Given<[f64; 2]>> {
        let given = self.raw(key)?;
        let value = pair(&given, unit, faults)?;
        Some(Given { value, path: given.path, span: given.span })
    }

    /// Two finite numbers that must be there.
    pub fn required_pair(
        &mut self,
        key: &'static str,
        unit: &str,
        faults: &mut Faults,
    ) -> Option<Given<[f64; 2]>> {
        if !self.has(key) {
            self.missing(key, format!("give `{key} = [..., ...]` in {unit}"), faults);
        }
        self.pair(key, unit, faults)
    }

    /// A range `[a, b]` with a < b, in metres.
    pub fn range(&mut self, key: &'static str, faults: &mut Faults) -> Option<Given<[f64; 2]>> {
        let given = self.required_pair(key, "m", faults)?;
        let [low, high] = given.value;
        if high - low >= SMALLEST {
            return Some(given);
        }
        if low < high {
            let message = format!("must be {SMALLEST:e} m wide at least, got [{low:?}, {high:?}] m");
            faults.of(&given, message, "give bounds that are further apart, in m");
            return None;
        }
        let help =
            format!("give the smaller bound first: {key} = [{:?}, {:?}]", high.min(low), high.max(low));
        faults.of(&given, format!("must increase, got [{low:?}, {high:?}] m"), help);
        None
    }

    /// A whole number within a range.
    pub fn whole(
        &mut self,
        key: &'static str,
        allowed: std::ops::RangeInclusive<usize>,
        faults: &mut Faults,
    ) -> Option<Given<usize>> {
        let given = self.raw(key)?;
        let value = whole(&given, &allowed, faults)?;
        Some(Given { value, path: given.path, span: given.span })
    }

    /// Two whole numbers within a range, that must be there.
    pub fn whole_pair(
        &mut self,
        key: &'static str,
        allowed: std::ops::RangeInclusive<usize>,
        faults: &mut Faults,
    ) -> Option<Given<[usize; 2]>> {
        let Some(given) = self.raw(key) else {
            self.missing(key, format!("give `{key} = [along z, along r]`, whole numbers"), faults);
            return None;
        };
        let elements = array(&given, "two whole numbers", "cells along z and r", faults)?;
        let [z, r] = elements.as_slice() else {
            let message = format!("must be two whole numbers, got {}", elements.len());
            faults.of(&given, message, format!("give `{key} = [along z, along r]`"));
            return None;
        };
        let (z, r) = (whole(z, &allowed, faults), whole(r, &allowed, faults));
        Some(Given { value: [z?, r?], path: given.path, span: given.span })
    }

    /// A string.
    pub fn string(&mut self, key: &'static str, faults: &mut Faults) -> Option<Given<&'a str>> {
        let given = self.raw(key)?;
        if let DeValue::String(value) = given.value {
            Some(Given { value, path: given.path, span: given.span })
        } else {
            wrong_type(&given, "a string", "put it in quotes".to_owned(), faults);
            None
        }
    }

    /// `true` or `false`.
    pub fn boolean(&mut self, key: &'static str, faults: &mut Faults) -> Option<Given<bool>> {
        let given = self.raw(key)?;
        if let DeValue::Boolean(value) = given.value {
            Some(Given { value: *value, path: given.path, span: given.span })
        } else {
            wrong_type(&given, "true or false", "write true or false, without quotes".to_owned(), faults);
            None
        }
    }

    /// One of a closed set of names.
    pub fn choice<T: Copy>(
        &mut self,
        key: &'static str,
        names: &[(&'static str, T)],
        faults: &mut Faults,
    ) -> Option<Given<T>> {
        let given = self.raw(key)?;
        let allowed = || names.iter().map(|(name, _)| *name);
        let DeValue::String(text) = given.value else {
            wrong_type(&given, "a name in quotes", suggest("", allowed()), faults);
            return None;
        };
        let Some((_, value)) = names.iter().find(|(name, _)| *name == text.as_ref()) else {
            faults.of(&given, format!("unknown name `{text}`"), suggest(text, allowed()));
            return None;
        };
        Some(Given { value: *value, path: given.path, span: given.span })
    }

    /// Refuses every key that nothing asked for.
    pub fn finish(self, faults: &mut Faults) {
        for key in self.entries.keys() {
            let name = key.get_ref().as_ref();
            if !self.asked.contains(&name) {
                let path = self.path_of(name);
                let allowed = self.asked.iter().copied();
                faults.at(&path, &key.span(), format!("unknown key `{name}`"), suggest(name, allowed));
            }
        }
    }
}
