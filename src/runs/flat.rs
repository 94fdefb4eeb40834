//! Keys and values without tables: `fluid.region.0.radius` and its number.
//!
//! Ten thousand runs have the same few hundred keys, which are kept once; a run has their numbers.

use std::collections::HashMap;
use std::fmt;

use serde::de::{DeserializeSeed, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};

/// Longer lists of plain values are one value: a list of times is no set of parameters.
const LONGEST_LIST: usize = 3;

/// A value that has no parts.
#[derive(Debug, Clone, PartialEq)]
pub enum Scalar {
    /// There is none.
    Null,
    /// A truth value.
    Bool(bool),
    /// A whole number.
    Integer(i64),
    /// Any other number.
    Float(f64),
    /// A text, or what is written as one.
    Text(String),
}

/// Ten thousand runs have millions of them, so that nothing is tried that does not fit.
impl<'de> Deserialize<'de> for Scalar {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ScalarOf)
    }
}

struct ScalarOf;

impl Visitor<'_> for ScalarOf {
    type Value = Scalar;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value without parts")
    }

    fn visit_unit<E>(self) -> Result<Scalar, E> {
        Ok(Scalar::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Scalar, E> {
        Ok(Scalar::Bool(value))
    }

    fn visit_i64<E>(self, whole: i64) -> Result<Scalar, E> {
        Ok(Scalar::Integer(whole))
    }

    fn visit_u64<E>(self, whole: u64) -> Result<Scalar, E> {
        Ok(i64::try_from(whole).map_or(Scalar::Float(whole as f64), Scalar::Integer))
    }

    fn visit_f64<E>(self, number: f64) -> Result<Scalar, E> {
        Ok(Scalar::Float(number))
    }

    fn visit_str<E>(self, text: &str) -> Result<Scalar, E> {
        Ok(Scalar::Text(text.to_owned()))
    }
}

impl Scalar {
    /// As a number.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Integer(whole) => Some(*whole as f64),
            Self::Float(number) => Some(*number),
            Self::Null | Self::Bool(_) | Self::Text(_) => None,
        }
    }

    /// Whether there is no value.
    #[must_use]
    pub fn is_null(&self) -> bool {
        *self == Self::Null
    }
}

/// Numbers in the shortest form that gives the same number again.
impl fmt::Display for Scalar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Null => Ok(()),
            Self::Bool(value) => write!(f, "{value}"),
            Self::Integer(whole) => write!(f, "{whole}"),
            Self::Float(number) if *number != 0.0 && !(1e-3..1e6).contains(&number.abs()) => {
                write!(f, "{number:e}")
            }
            Self::Float(number) => write!(f, "{number}"),
            Self::Text(text) => f.write_str(text),
        }
    }
}

/// Takes tables apart: keys joined by dots, entries of lists by their number.
#[must_use]
pub fn flatten(tables: Map<String, Value>) -> Map<String, Value> {
    let mut flat = Map::new();
    for (key, value) in tables {
        add(&mut flat, key, value);
    }
    flat
}

fn add(flat: &mut Map<String, Value>, key: String, value: Value) {
    match value {
        Value::Object(table) => {
            for (name, value) in table {
                add(flat, format!("{key}.{name}"), value);
            }
        }
        Value::Array(list) if list.len() <= LONGEST_LIST || list.iter().any(Value::is_object) => {
            for (number, value) in list.into_iter().enumerate() {
                add(flat, format!("{key}.{number}"), value);
            }
        }
        Value::Array(list) => {
            flat.insert(key, Value::String(Value::Array(list).to_string()));
        }
        plain => {
            flat.insert(key, plain);
        }
    }
}

/// Keys by their numbers.
#[derive(Debug, Default)]
pub struct Keys {
    names: Vec<String>,
    numbers: HashMap<String, u32>,
}

/// Keys of a run, by their numbers, with its values.
pub type Flat = Vec<(u32, Scalar)>;

impl Keys {
    /// The number of a key, a new one if need be.
    fn number_of(&mut self, name: &str) -> u32 {
        if let Some(number) = self.numbers.get(name) {
            return *number;
        }
        let number = self.names.len() as u32;
        self.names.push(name.to_owned());
        self.numbers.insert(name.to_owned(), number);
        number
    }

    /// The number of a key that there is.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<u32> {
        self.numbers.get(name).copied()
    }

    /// The key with a number.
    #[must_use]
    pub fn name(&self, number: u32) -> &str {
        self.names.get(number as usize).map_or("", String::as_str)
    }

    /// All of them, in the order in which they were first met.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Reads a flat table from JSON.
    ///
    /// # Errors
    /// It is none.
    pub fn read(&mut self, json: &str) -> serde_json::Result<Flat> {
        let mut read = serde_json::Deserializer::from_str(json);
        let flat = FlatOf(self).deserialize(&mut read)?;
        read.end()?;
        Ok(flat)
    }
}

/// Reads keys without keeping a text for each.
struct FlatOf<'a>(&'a mut Keys);

impl<'de> DeserializeSeed<'de> for FlatOf<'_> {
    type Value = Flat;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Flat, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for FlatOf<'_> {
    type Value = Flat;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table without tables in it")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Flat, A::Error> {
        let mut flat = Flat::new();
        while let Some(number) = map.next_key_seed(KeyOf(&mut *self.0))? {
            flat.push((number, map.next_value()?));
        }
        Ok(flat)
    }
}

struct KeyOf<'a>(&'a mut Keys);

impl<'de> DeserializeSeed<'de> for KeyOf<'_> {
    type Value = u32;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<u32, D::Error> {
        deserializer.deserialize_str(self)
    }
}

impl Visitor<'_> for KeyOf<'_> {
    type Value = u32;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a key")
    }

    fn visit_str<E>(self, name: &str) -> Result<u32, E> {
        Ok(self.0.number_of(name))
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn tables_and_short_lists_are_taken_apart_and_long_lists_are_one_value() {
        let tables = json!({
            "time": { "end": 4e-6, "snapshots": [0.0, 1e-6, 2e-6, 4e-6] },
            "fluid": { "adapt": true, "region": [{ "centre": [0.004, 0.0], "radius": 0.002 }] },
            "pit_radius": null, "steps": 42,
        });
        let flat = flatten(tables.as_object().expect("a table").clone());
        let mut keys = Keys::default();
        let read = keys.read(&Value::Object(flat).to_string()).expect("it is flat");
        let of = |name: &str| {
            let number = keys.get(name).unwrap_or_else(|| panic!("no {name} in {:?}", keys.names()));
            read.iter().find(|(key, _)| *key == number).map(|(_, value)| value.clone()).expect("a value")
        };
        assert_eq!(of("time.end"), Scalar::Float(4e-6));
        assert_eq!(of("time.snapshots"), Scalar::Text("[0.0,1e-6,2e-6,4e-6]".to_owned()));
        assert_eq!(of("fluid.adapt"), Scalar::Bool(true));
        assert_eq!(of("fluid.region.0.centre.0"), Scalar::Float(0.004));
        assert_eq!(of("pit_radius"), Scalar::Null);
        assert_eq!(of("steps"), Scalar::Integer(42));
        assert!(keys.read("{\"a\": {\"b\": 1}}").is_err());
        assert_eq!(
            keys.read("{\"steps\": 7}").expect("flat"),
            [(keys.get("steps").expect("known"), Scalar::Integer(7))]
        );
    }

    #[test]
    fn numbers_are_told_as_short_as_they_can_be() {
        for (number, text) in
            [(0.0, "0"), (0.01, "0.01"), (2.5e8, "2.5e8"), (-1e-6, "-1e-6"), (12.5, "12.5"), (1e6, "1e6")]
        {
            assert_eq!(Scalar::Float(number).to_string(), text);
        }
    }
}
