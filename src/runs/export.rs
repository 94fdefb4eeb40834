//! A listing as CSV and as JSON.

use serde_json::{Map, Value};

use crate::runs::columns::as_json;
use crate::runs::listing::{Entry, Listing};

impl Listing {
    fn json_value(&self, entry: &Entry, key: &str) -> Value {
        if key == "answer" { self.answer(entry).into() } else { as_json(self.value(entry, key)) }
    }

    /// A list of tables, one for each run, with these keys.
    #[must_use]
    pub fn json(&self, columns: &[String]) -> String {
        let table = |entry: &Entry| -> Value {
            let pairs = columns.iter().map(|key| (key.clone(), self.json_value(entry, key)));
            Value::Object(Map::from_iter(pairs))
        };
        let lines: Vec<String> = self.entries.iter().map(|entry| table(entry).to_string()).collect();
        if lines.is_empty() { "[]\n".to_owned() } else { format!("[\n{}\n]\n", lines.join(",\n")) }
    }

    /// A line of keys, and a line for each run; what a run does not have is empty.
    #[must_use]
    pub fn csv(&self, columns: &[String]) -> String {
        let mut text = columns.iter().map(|key| field(key)).collect::<Vec<_>>().join(",") + "\n";
        for entry in &self.entries {
            let of = |key: &String| {
                if key == "answer" {
                    return field(&self.answer(entry).join(" "));
                }
                self.value(entry, key).map_or_else(String::new, |value| field(&value.to_string()))
            };
            text += &(columns.iter().map(of).collect::<Vec<_>>().join(",") + "\n");
        }
        text
    }
}

/// A field of a line (RFC 4180): in quotes where it has what separates fields or lines.
fn field(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_with_commas_and_quotes_are_one_field() {
        for (text, written) in [("a b", "a b"), ("a,b", "\"a,b\""), ("5\" pipe", "\"5\"\" pipe\""), ("", "")]
        {
            assert_eq!(field(text), written);
        }
    }
}
