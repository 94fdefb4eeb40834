//! Reading TOML tables key by key, so that every fault of a file is found in one go.
//!
//! A [`Table`] hands out the values of the keys it is asked for and remembers the keys; what is left over at the end
//! is an unknown key, and the keys asked for are the valid names. What a key is (its unit, range, names and default) is
//! declared in [`keys`]; one that is asked for and not declared there is a defect of the program, and no case with its table
//! can be read.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::suggest;
use super::keys::{self, Key, Preset, Values};
use super::values::whole;
pub(super) use super::values::{Faults, Given, LARGEST, SMALLEST, array, describe, number, pair, wrong_type};

/// A TOML table being read. `None` from a getter means "absent" or "present but faulty"; the fault is recorded then.
pub(super) struct Table<'a> {
    entries: &'a DeTable<'a>,
    pub path: String,
    pub span: Range<usize>,
    asked: Vec<&'static str>,
    /// Keys whose declaration does not fit what is read.
    defects: Vec<(&'static str, String)>,
}

impl<'a> Table<'a> {
    pub fn root(document: &'a Spanned<DeTable<'a>>) -> Self {
        Self::new(document.get_ref(), String::new(), 0..0)
    }

    fn new(entries: &'a DeTable<'a>, path: String, span: Range<usize>) -> Self {
        Self { entries, path, span, asked: Vec::new(), defects: Vec::new() }
    }

    /// What a key is declared to be.
    fn declared(&self, key: &str) -> Option<&'static Key> {
        keys::key(&keys::without_numbers(&self.path), key)
    }

    /// The unit that a key is declared to have; of a point with its coordinates.
    pub fn unit(&self, key: &str) -> String {
        match self.declared(key) {
            Some(Key { unit, values: Values::Point, .. }) => format!("{unit}, as [z, r]"),
            Some(key) => key.unit.to_owned(),
            None => String::new(),
        }
    }

    /// Keeps in mind that a key was asked for, and whether it is declared.
    fn ask(&mut self, key: &'static str) {
        self.asked.push(key);
        let path = keys::without_numbers(&self.path_of(key));
        if self.declared(key).is_none() && !keys::has_table(&path) {
            self.defect(key, "it is not declared".to_owned());
        }
        #[cfg(test)]
        keys::seen::note(path);
    }

    fn defect(&mut self, key: &'static str, what: String) {
        self.defects.push((key, what));
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
        self.ask(key);
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
            Some(Self::new(entries, given.path, given.span))
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
    pub fn number(&mut self, key: &'static str, faults: &mut Faults) -> Option<Given<f64>> {
        let given = self.raw(key)?;
        let value = number(&given, &self.unit(key), faults)?;
        Some(Given { value, path: given.path, span: given.span })
    }

    /// A finite number that must be there.
    pub fn required(&mut self, key: &'static str, faults: &mut Faults) -> Option<Given<f64>> {
        if !self.has(key) {
            self.missing(key, format!("give `{key} = ...` in {}", self.unit(key)), faults);
        }
        self.number(key, faults)
    }

    /// A positive number; a default makes it optional.
    pub fn positive(&mut self, key: &'static str, faults: &mut Faults) -> Option<f64> {
        let given = self.number(key, faults)?;
        let got = given.value;
        if got >= SMALLEST {
            return Some(got);
        }
        let message = if got > 0.0 {
            format!("must be {SMALLEST:e} at least, got {got:?}")
        } else {
            format!("must be positive, got {got:?}")
        };
        faults.of(&given, message, format!("give a number > 0 in {}", self.unit(key)));
        None
    }

    /// A number of the interval that is declared.
    pub fn within(&mut self, key: &'static str, help: &str, faults: &mut Faults) -> Option<Given<f64>> {
        let given = self.number(key, faults)?;
        let Some(Key { values: Values::Within(interval), .. }) = self.declared(key) else {
            self.defect(key, "its interval is not declared".to_owned());
            return None;
        };
        if !interval.contains(given.value) {
            faults.of(&given, format!("must lie in {interval}, got {:?}", given.value), help);
        }
        Some(given)
    }

    /// A time to wait, s, of the interval that is declared: one that clocks can count.
    pub fn waiting(&mut self, key: &'static str, faults: &mut Faults) -> Option<f64> {
        let given = self.number(key, faults)?;
        let Some(Key { values: Values::Within(interval), .. }) = self.declared(key) else {
            self.defect(key, "its interval is not declared".to_owned());
            return None;
        };
        if interval.contains(given.value) {
            return Some(given.value);
        }
        let (least, most) = interval.ends();
        let message = if given.value <= 0.0 {
            format!("must be positive, got {:?}", given.value)
        } else {
            format!("must be from {least:?} to {most:e} s, got {:?}", given.value)
        };
        faults.of(&given, message, format!("give seconds from {least:?} to {most:e}"));
        None
    }

    /// A positive number that must be there.
    pub fn required_positive(&mut self, key: &'static str, faults: &mut Faults) -> Option<f64> {
        if !self.has(key) {
            self.missing(key, format!("give `{key} = ...` in {}", self.unit(key)), faults);
        }
        self.positive(key, faults)
    }

    /// A list of finite numbers.
    pub fn numbers(&mut self, key: &'static str, faults: &mut Faults) -> Option<Given<Vec<f64>>> {
        let given = self.raw(key)?;
        let unit = self.unit(key);
        let elements = array(&given, "a list of numbers", &unit, faults)?;
        let values: Vec<Option<f64>> = elements.iter().map(|e| number(e, &unit, faults)).collect();
        let value = values.into_iter().collect::<Option<Vec<f64>>>()?;
        Some(Given { value, path: given.path, span: given.span })
    }

    /// Two finite numbers, `[a, b]`.
    pub fn pair(&mut self, key: &'static str, faults: &mut Faults) -> Option<Given<[f64; 2]>> {
        let given = self.raw(key)?;
        let value = pair(&given, &self.unit(key), faults)?;
        Some(Given { value, path: given.path, span: given.span })
    }

    /// Two finite numbers that must be there.
    pub fn required_pair(&mut self, key: &'static str, faults: &mut Faults) -> Option<Given<[f64; 2]>> {
        if !self.has(key) {
            self.missing(key, format!("give `{key} = [..., ...]` in {}", self.unit(key)), faults);
        }
        self.pair(key, faults)
    }

    /// A range `[a, b]` with a < b, in metres.
    pub fn range(&mut self, key: &'static str, faults: &mut Faults) -> Option<Given<[f64; 2]>> {
        let given = self.required_pair(key, faults)?;
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

    /// A whole number of the range that is declared.
    pub fn whole(&mut self, key: &'static str, faults: &mut Faults) -> Option<Given<usize>> {
        let given = self.raw(key)?;
        let Some(Key { values: Values::Whole(low, high), .. }) = self.declared(key) else {
            self.defect(key, "its range is not declared".to_owned());
            return None;
        };
        let value = whole(&given, &(*low..=*high), faults)?;
        Some(Given { value, path: given.path, span: given.span })
    }

    /// Two whole numbers of the range that is declared, that must be there.
    pub fn whole_pair(&mut self, key: &'static str, faults: &mut Faults) -> Option<Given<[usize; 2]>> {
        let Some(given) = self.raw(key) else {
            self.missing(key, format!("give `{key} = [along z, along r]`, whole numbers"), faults);
            return None;
        };
        let Some(Key { values: Values::Cells(low, high), .. }) = self.declared(key) else {
            self.defect(key, "its range is not declared".to_owned());
            return None;
        };
        let allowed = *low..=*high;
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

    /// `true` or `false`; the default that is declared where the case does not say.
    pub fn flag(&mut self, key: &'static str, faults: &mut Faults) -> bool {
        match self.declared(key) {
            Some(Key { default: Preset::Flag(default), .. }) => {
                self.boolean(key, faults).map_or(*default, |given| given.value)
            }
            _ => {
                self.defect(key, "its default is not declared".to_owned());
                false
            }
        }
    }

    /// `true` or `false`.
    fn boolean(&mut self, key: &'static str, faults: &mut Faults) -> Option<Given<bool>> {
        let given = self.raw(key)?;
        if let DeValue::Boolean(value) = given.value {
            Some(Given { value: *value, path: given.path, span: given.span })
        } else {
            wrong_type(&given, "true or false", "write true or false, without quotes".to_owned(), faults);
            None
        }
    }

    /// One of a closed set of names; the default that is declared where the case does not say.
    pub fn name<T: Copy>(
        &mut self,
        key: &'static str,
        names: &[(&'static str, T)],
        faults: &mut Faults,
    ) -> T {
        let chosen = self.choice(key, names, faults).map(|given| given.value);
        let default = match self.declared(key) {
            Some(Key { default: Preset::Name(default), .. }) => {
                names.iter().find(|(name, _)| name == default).map(|(_, value)| *value)
            }
            _ => None,
        };
        if default.is_none() {
            self.defect(key, "its default is not declared".to_owned());
        }
        chosen.or(default).unwrap_or(names[0].1)
    }

    /// One of a closed set of names, which are those that are declared.
    pub fn choice<T: Copy>(
        &mut self,
        key: &'static str,
        names: &[(&'static str, T)],
        faults: &mut Faults,
    ) -> Option<Given<T>> {
        let is_declared = match self.declared(key) {
            Some(Key { values: Values::Names(declared), .. }) => {
                declared.iter().map(|(name, _)| name).eq(names.iter().map(|(name, _)| name))
            }
            _ => false,
        };
        if !is_declared {
            self.defect(key, "its names are not those that are declared".to_owned());
        }
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
        for (key, what) in &self.defects {
            let message = format!("a defect of this program, not of the case: {what} in src/case/keys");
            faults.at(&self.path_of(key), &self.span, message, "please report it");
        }
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
