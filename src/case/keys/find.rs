//! What of the keys a path means.

use super::declared::{Key, Section};
use super::{has_table, sections, terminal, without_numbers};

/// A path that no key and no table has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no key or table `{path}`{} (`cav keys` lists all)", suggested(.nearest))]
pub struct UnknownKey {
    /// The path.
    pub path: String,
    /// Paths that it may have been meant for, the nearest first.
    pub nearest: Vec<String>,
}

fn suggested(nearest: &[String]) -> String {
    let names: Vec<String> = nearest.iter().map(|path| format!("`{path}`")).collect();
    if names.is_empty() { String::new() } else { format!("; did you mean {}?", names.join(", ")) }
}

/// The most paths that are suggested.
const MOST_SUGGESTED: usize = 3;

/// What the program says of the keys of a case file.
///
/// - `path`: of a table (`fluid.boundary`), of a key (`fluid.epsilon`), or the last name of either alone (`epsilon`); numbers of
///   elements do no harm. Without it all keys, one line each.
///
/// # Errors
/// No key and no table has the path.
pub fn describe_keys(path: Option<&str>) -> Result<String, UnknownKey> {
    let Some(path) = path else {
        let all: Vec<String> = sections().map(terminal::brief).collect();
        return Ok(all.join("\n")
            + "\nkey, unit, values, default. More on one: cav keys PATH, as cav keys fluid.epsilon\n");
    };
    let asked = without_numbers(path.trim_matches(['[', ']']));
    let keys = matching(&asked);
    if has_table(&asked) && !asked.is_empty() {
        return Ok(of_table(&asked, &keys));
    }
    if keys.is_empty() {
        let called: Vec<String> = (sections()
            .filter(|section| last(section.path) == asked && !asked.is_empty()))
        .map(terminal::in_full)
        .collect();
        if !called.is_empty() {
            return Ok(called.join("\n"));
        }
        return Err(UnknownKey { path: path.to_owned(), nearest: nearest(&asked) });
    }
    Ok(keys.iter().map(|(section, key)| terminal::one(section, key)).collect::<Vec<_>>().join("\n"))
}

/// A table in full, and in one line a key those within it. A key of that name comes first: `solid.material` is both.
fn of_table(path: &str, keys: &[(&Section, &Key)]) -> String {
    let within = format!("{path}.");
    let one = keys.iter().map(|(section, key)| terminal::one(section, key));
    let own = sections().filter(|section| section.path == path).map(terminal::in_full);
    let below = sections().filter(|section| section.path.starts_with(&within)).map(terminal::brief);
    one.chain(own).chain(below).collect::<Vec<_>>().join("\n")
}

/// The keys of a path; of a name alone, those of all tables.
fn matching(asked: &str) -> Vec<(&'static Section, &'static Key)> {
    let all = || sections().flat_map(|section| section.keys.iter().map(move |key| (section, key)));
    let exact: Vec<_> = all().filter(|(section, key)| section.path_of(key) == asked).collect();
    if exact.is_empty() { all().filter(|(_, key)| key.name == asked).collect() } else { exact }
}

/// The last name of a path.
fn last(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or(path)
}

/// The paths that are nearest to one that is none; of a path with its last name right, those with that name.
fn nearest(asked: &str) -> Vec<String> {
    let wanted = last(asked);
    let mut paths: Vec<(usize, String)> = Vec::new();
    for section in sections() {
        let tables = std::iter::once((section.path.to_owned(), last(section.path)));
        let keys = section.keys.iter().map(|key| (section.path_of(key), key.name));
        for (path, name) in tables.chain(keys).filter(|(path, _)| !path.is_empty()) {
            let whole = strsim::damerau_levenshtein(asked, &path);
            let alone = strsim::damerau_levenshtein(asked, name);
            let distance = if name == wanted { 1 } else { whole.min(alone) };
            if distance <= (asked.chars().count() / 3).max(1) && paths.iter().all(|(_, known)| *known != path)
            {
                paths.push((distance, path));
            }
        }
    }
    paths.sort();
    paths.into_iter().take(MOST_SUGGESTED).map(|(_, path)| path).collect()
}

/// The paths of all tables and keys.
#[must_use]
pub fn key_paths() -> Vec<String> {
    let mut paths: Vec<String> = sections().map(|section| section.path.to_owned()).collect();
    paths.extend(sections().flat_map(|section| section.keys.iter().map(|key| section.path_of(key))));
    paths.retain(|path| !path.is_empty());
    paths.sort();
    paths.dedup();
    paths
}
