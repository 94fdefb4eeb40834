//! The page on keys, `docs/reference/case-keys.md`.

use std::fmt::Write as _;

use super::declared::{Key, Section, Values};
use super::{links, sections};

const HEAD: &str = "\
# Keys of a case file

This page is written by `cav keys --markdown`, from the table that the program reads case files by. `cav keys` shows the same
on a terminal, `cav keys fluid.boundary` one table, `cav keys fluid.epsilon` one key. How a file is read, and what `--set` does,
is in [case files](cases.md).

\"Required\" means: if its table is there. Where the default says what a value follows from, `cav check` prints the value.
";

/// All keys of a case file as a page in Markdown.
#[must_use]
pub fn keys_page() -> String {
    let mut page = HEAD.to_owned();
    for section in sections() {
        let _ = write!(page, "\n{}\n", written(section));
    }
    page
}

/// One section; a string takes what is written to it, so errors cannot be.
fn written(section: &Section) -> String {
    let mut text = match section.head() {
        head if head.is_empty() => format!("## {}\n", section.title),
        head => format!("## `{head}`: {}\n", lower(section.title)),
    };
    if !section.about.is_empty() {
        for paragraph in section.about.split("\n\n") {
            let _ = write!(text, "\n{}\n", fenced(paragraph));
        }
    }
    text += "\n| key | unit | values | default | |\n|---|---|---|---|---|\n";
    for key in section.keys {
        let (values, default) = (key.allowed(), key.preset());
        let unit = if key.unit.is_empty() { String::new() } else { key.printed_unit() };
        let row = [format!("`{}`", key.name), unit, values, default, told(section, key)];
        let _ = writeln!(text, "| {} |", row.map(|cell| linked(&cell).replace('|', "\\|")).join(" | "));
    }
    text.truncate(text.trim_end().len());
    text
}

/// A paragraph; lines that are indented are code.
fn fenced(paragraph: &str) -> String {
    if !paragraph.starts_with("    ") {
        return linked(paragraph);
    }
    let lines: Vec<&str> = paragraph.lines().map(|line| line.strip_prefix("    ").unwrap_or(line)).collect();
    format!("```text\n{}\n```", lines.join("\n"))
}

/// What a key does, and what its names mean.
fn told(section: &Section, key: &Key) -> String {
    if let Some(first) = section.same_names(key) {
        return format!("{} The names mean what they mean for `{}`.", key.about, first.name);
    }
    match key.values {
        Values::Names(names) => {
            let meanings: Vec<String> =
                names.iter().map(|(name, meaning)| format!("`\"{name}\"`: {meaning}")).collect();
            format!("{} {}.", key.about, meanings.join("; "))
        }
        _ => key.about.to_owned(),
    }
}

/// A title within a heading.
fn lower(title: &str) -> String {
    let mut letters = title.chars();
    letters.next().map_or(String::new(), |first| first.to_lowercase().chain(letters).collect())
}

/// A text with its links as the page has them.
fn linked(text: &str) -> String {
    links::replaced(text, |words, page| format!("[{words}]({})", links::from_page(page)))
}
