//! The pages of the reference that the program writes are what it says; `WRITE_REFERENCE=1 cargo test --test reference` writes them.

#![allow(missing_docs)]

use std::fs;
use std::path::Path;

/// A page as it is, and as the program has it.
fn check(page: &str, written: impl Fn(&str) -> String) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/reference").join(page);
    let before = fs::read_to_string(&path).unwrap_or_default();
    let after = written(&before);
    if std::env::var_os("WRITE_REFERENCE").is_some() {
        fs::write(&path, after).expect("the page is written");
        return;
    }
    let differ = before.lines().zip(after.lines()).find(|(is, should)| is != should);
    assert!(
        before == after,
        "docs/reference/{page} is not what the program says; `WRITE_REFERENCE=1 cargo test --test reference` writes it\n{differ:#?}"
    );
}

/// A page with the text between `<!-- generated: NAME -->` and `<!-- end -->` replaced.
fn with_part(page: &str, name: &str, text: &str) -> String {
    let begin = format!("<!-- generated: {name} -->\n");
    let (before, rest) = page.split_once(&begin).unwrap_or_else(|| panic!("no `{begin}`"));
    let (_, after) = rest.split_once("<!-- end -->").unwrap_or_else(|| panic!("no end of {name}"));
    format!("{before}{begin}\n{text}\n\n<!-- end -->{after}")
}

#[test]
fn the_page_on_keys_is_what_the_program_says() {
    check("case-keys.md", |_| cav::case::keys_page());
}

#[test]
fn the_page_on_the_command_line_is_what_the_program_says() {
    check("command-line.md", |page| {
        let parts = cav::command_line::reference();
        parts.iter().fold(page.to_owned(), |page, (name, text)| with_part(&page, name, text))
    });
}
