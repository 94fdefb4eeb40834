//! The keys of a case file, declared once: the reader looks every key up here, and so do `cav keys` and the page on keys.

pub(super) mod adaptation;
pub(super) mod bubble;
mod conduction;
pub(super) mod coupling;
mod declared;
mod find;
pub(super) mod fluid;
pub(super) mod grid;
mod links;
mod page;
mod phase_change;
mod plasticity;
pub(super) mod records;
#[cfg(test)]
pub(super) mod seen;
mod sides;
mod solid;
mod start;
mod terminal;
mod terms;
#[cfg(test)]
mod tests;
pub(super) mod time;

pub(super) use declared::{Key, Preset, Section, Values};
pub use find::{UnknownKey, describe_keys, key_paths};
pub use page::keys_page;

/// All that is declared, in the order in which it is told.
fn sections() -> impl Iterator<Item = &'static Section> {
    let parts: [&[Section]; 16] = [
        &time::TIME,
        &fluid::FLUID,
        &terms::TERMS,
        &conduction::CONDUCTION,
        &phase_change::PHASE_CHANGE,
        &start::START,
        &bubble::BUBBLE,
        &sides::SIDES_OF_FLUID,
        &adaptation::ADAPTATION_OF_FLUID,
        &solid::SOLID,
        &plasticity::PLASTICITY,
        &sides::SIDES_OF_SOLID,
        &adaptation::ADAPTATION_OF_SOLID,
        &adaptation::REGION_OF_INTEREST,
        &coupling::COUPLING,
        &records::RECORDS,
    ];
    parts.into_iter().flatten()
}

/// The sections of one table; none where there is no such table.
fn table(path: &str) -> impl Iterator<Item = &'static Section> {
    sections().filter(move |section| section.path == path)
}

/// The key of a table, if it is declared.
///
/// - `path`: the table's, without the numbers of elements.
pub(super) fn key(path: &str, name: &str) -> Option<&'static Key> {
    table(path).flat_map(|section| section.keys).find(|key| key.name == name)
}

/// Whether a table is declared, or one within it.
pub(super) fn has_table(path: &str) -> bool {
    let within = format!("{path}.");
    sections().any(|section| section.path == path || section.path.starts_with(&within))
}

/// A path without the numbers of elements: `fluid.region` of `fluid.region.0`.
pub(super) fn without_numbers(path: &str) -> String {
    let names: Vec<&str> = path.split('.').filter(|part| part.parse::<usize>().is_err()).collect();
    names.join(".")
}
