//! Keys as they are shown on a terminal.

use std::fmt::Write as _;

use super::declared::{Key, Section, Values};
use super::links;

/// Columns of a terminal that texts are broken for.
const WIDTH: usize = 100;

/// A table in one line a key, to find a key by.
pub(super) fn brief(section: &Section) -> String {
    let mut text = heading(section);
    for key in section.keys {
        let mut columns = format!("  {:<22}{:<10}", key.name, key.printed_unit());
        let values = plain(&key.allowed());
        let _ = write!(columns, "{}", shortened(&values, 40));
        let default = shortened(&plain(&key.preset()), 28);
        let _ = writeln!(text, "{columns:<72}  {default}");
    }
    text
}

/// A table with all that is told of it and its keys.
pub(super) fn in_full(section: &Section) -> String {
    let mut text = heading(section);
    let mut pages = Vec::new();
    for paragraph in section.about.split("\n\n").filter(|about| !about.is_empty()) {
        text += &paragraph_of(paragraph, 2, &mut pages);
        text.push('\n');
    }
    for key in section.keys {
        text += &of_key(key, key.name, section.same_names(key), &mut pages);
    }
    text + &see(&pages)
}

/// One key with all that is told of it, under its full path.
pub(super) fn one(section: &Section, key: &Key) -> String {
    let mut pages = Vec::new();
    of_key(key, &section.path_of(key), None, &mut pages) + &see(&pages)
}

/// - `same`: the key whose names these are, too, and where they have been told.
fn of_key(key: &Key, name: &str, same: Option<&Key>, pages: &mut Vec<&'static str>) -> String {
    let unit =
        if matches!(key.unit, "" | "1") { String::new() } else { format!("  [{}]", key.printed_unit()) };
    let mut text = format!("{name}{unit}\n");
    text += &paragraph_of(key.about, 4, pages);
    match (key.values, same) {
        (_, Some(same)) => text += &broken(&format!("values:  as of {}", same.name), 4, 13),
        (Values::Names(names), None) => {
            for (name, meaning) in names {
                let meaning = told(meaning, pages);
                text += &broken(&format!("{:<18} {meaning}", format!("\"{name}\"")), 4, 23);
            }
        }
        (_, None) => text += &broken(&format!("values:  {}", told(&key.allowed(), pages)), 4, 13),
    }
    text += &broken(&format!("default: {}", told(&key.preset(), pages)), 4, 13);
    text.push('\n');
    text
}

fn heading(section: &Section) -> String {
    match section.head() {
        head if head.is_empty() => format!("{}\n", section.title),
        head => format!("{head}  {}\n", section.title),
    }
}

/// The pages that were linked to.
fn see(pages: &[&str]) -> String {
    let mut lines = String::new();
    for page in pages {
        let _ = writeln!(lines, "see {page}");
    }
    lines
}

/// A text without Markdown; its links are kept for [`see`].
fn told(text: &str, pages: &mut Vec<&'static str>) -> String {
    let text = links::replaced(text, |words, page| {
        if !pages.contains(&page) {
            pages.push(page);
        }
        words.to_owned()
    });
    text.replace(['`', '*'], "")
}

fn plain(text: &str) -> String {
    told(text, &mut Vec::new())
}

/// A paragraph, or lines that are to stay as they are.
fn paragraph_of(text: &str, indent: usize, pages: &mut Vec<&'static str>) -> String {
    if text.starts_with("    ") {
        return text.lines().map(|line| format!("{:indent$}{line}\n", "")).collect();
    }
    broken(&told(text, pages), indent, indent)
}

/// A text in lines that begin with so many spaces.
fn broken(text: &str, first: usize, others: usize) -> String {
    let mut lines = String::new();
    let mut line = " ".repeat(first);
    let mut is_new = true;
    for word in text.split(' ') {
        if !is_new && line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines += line.trim_end();
            lines.push('\n');
            line = " ".repeat(others);
            is_new = true;
        }
        if !is_new {
            line.push(' ');
        }
        line += word;
        is_new = false;
    }
    lines + line.trim_end() + "\n"
}

/// The beginning of a text that does not fit.
fn shortened(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.to_owned();
    }
    let kept: String = text.chars().take(most - 3).collect();
    format!("{}...", kept.trim_end())
}
