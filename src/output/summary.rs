//! The summary of a run as a JSON object: written whole, read, and put together from the sides' parts.

use std::fs;
use std::path::Path;

use serde_json::{Map, Value};

use super::{OutputError, RunDirectory};

/// Writes `summary` as the file `name` of a run directory, in one act.
pub fn write(directory: &RunDirectory, name: &str, summary: &Map<String, Value>) -> Result<(), OutputError> {
    directory.write_atomic(name, text(&directory.file(name), summary)?.as_bytes())
}

/// A summary as it is written; `path` is where, for an error.
pub fn text(path: &Path, summary: &Map<String, Value>) -> Result<String, OutputError> {
    let text = serde_json::to_string_pretty(summary);
    let mut text = text.map_err(|source| OutputError::Json { path: path.to_path_buf(), source })?;
    text.push('\n');
    Ok(text)
}

/// Reads a summary, or a part of one.
pub fn read(path: &Path) -> Result<Map<String, Value>, OutputError> {
    let text = fs::read_to_string(path).map_err(OutputError::io(path, "read"))?;
    serde_json::from_str(&text).map_err(|source| OutputError::Json { path: path.to_path_buf(), source })
}

/// The program that a run is made by: `program`, `git_revision`.
pub fn origin() -> Map<String, Value> {
    let [program, revision] =
        [format!("cav {}", env!("CARGO_PKG_VERSION")), env!("CAV_GIT_REVISION").to_owned()];
    Map::from_iter([("program".to_owned(), program.into()), ("git_revision".to_owned(), revision.into())])
}

/// Puts parts together: the keys of all of them, objects under the same key merged likewise.
///
/// Where several parts give a plain value for one key, the last one's holds; so what differs between the sides has to
/// be nested (`cells.fluid`, `cells.solid`), and what the launcher knows better comes last.
pub fn merge(parts: &[Map<String, Value>]) -> Map<String, Value> {
    let mut whole = Map::new();
    for part in parts {
        merge_into(&mut whole, part);
    }
    whole
}

fn merge_into(whole: &mut Map<String, Value>, part: &Map<String, Value>) {
    for (key, value) in part {
        match (whole.get_mut(key), value) {
            (Some(Value::Object(inner)), Value::Object(more)) => merge_into(inner, more),
            _ => {
                whole.insert(key.clone(), value.clone());
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use serde_json::json;

    use super::*;

    fn object(value: Value) -> Map<String, Value> {
        match value {
            Value::Object(map) => map,
            _ => panic!("an object"),
        }
    }

    #[test]
    fn merging_keeps_both_sides_of_a_nested_key_and_the_last_plain_value() {
        let fluid = object(json!({"steps": 7, "coupling": {"fluid": {"waited": 1.5}, "exchanges": 7}}));
        let solid =
            object(json!({"steps": 7, "coupling": {"solid": {"waited": 0.5}}, "von_mises_peak": 1.0e8}));
        let launcher = object(json!({"completed": true, "wall_seconds": 3.0, "steps": 8}));
        let whole = merge(&[fluid, solid, launcher]);
        let expected = json!({
            "steps": 8, "completed": true, "wall_seconds": 3.0, "von_mises_peak": 1.0e8,
            "coupling": {"exchanges": 7, "fluid": {"waited": 1.5}, "solid": {"waited": 0.5}}
        });
        assert_eq!(Value::Object(whole), expected);
    }
}
