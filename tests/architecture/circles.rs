//! No file of a crate takes names from one that takes names from it, by whatever way round.
//!
//! What a parent module has of its children, and they of it, does not count; nor what comes by way of a crate's root.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::{files, root};

type Module = Vec<String>;

/// The module that a file is, from its path below `src`.
fn module(path: &Path) -> Module {
    let mut parts: Module =
        path.with_extension("").iter().map(|part| part.to_string_lossy().into_owned()).collect();
    if parts.last().is_some_and(|last| matches!(&**last, "mod" | "lib" | "main")) {
        parts.pop();
    }
    parts
}

/// The paths that a file's own `use` lines begin with: those of modules within it are indented.
fn used(own: &[String], text: &str) -> Vec<Module> {
    let mut found = Vec::new();
    for line in text.lines() {
        let line = line.strip_prefix("pub(crate) ").or(line.strip_prefix("pub(super) ")).unwrap_or(line);
        let Some(path) = line.strip_prefix("pub ").unwrap_or(line).strip_prefix("use ") else { continue };
        let (mut from, rest) = if let Some(rest) = path.strip_prefix("crate::") {
            (Vec::new(), rest)
        } else if let Some(rest) = path.strip_prefix("super::") {
            (own[..own.len().saturating_sub(1)].to_vec(), rest)
        } else {
            continue;
        };
        let names = |text: &str| -> Module {
            text.split("::").map(|name| name.trim_matches([' ', ';', ',', '}'])).map(str::to_owned).collect()
        };
        let (stem, list) = rest.split_once('{').unwrap_or((rest, ""));
        from.extend(names(stem.trim_end_matches("::")));
        from.retain(|name| !name.is_empty());
        if list.is_empty() {
            found.push(from);
        } else {
            found.extend(list.split(", ").map(|item| [from.clone(), names(item)].concat()));
        }
    }
    found
}

/// Who takes names from whom.
fn arrows(texts: &BTreeMap<Module, String>) -> BTreeMap<&Module, BTreeSet<&Module>> {
    let is_family = |a: &Module, b: &Module| a.starts_with(b) || b.starts_with(a);
    let mut arrows = BTreeMap::new();
    for (own, text) in texts {
        let targets = used(own, text).into_iter().filter_map(|path| {
            (1..=path.len()).rev().find_map(|n| texts.get_key_value(&path[..n])).map(|(module, _)| module)
        });
        arrows.insert(own, targets.filter(|target| !is_family(own, target)).collect());
    }
    arrows
}

/// A way from a file back to itself.
fn circle(texts: &BTreeMap<Module, String>) -> Option<String> {
    fn walk<'a>(
        at: &'a Module,
        arrows: &BTreeMap<&'a Module, BTreeSet<&'a Module>>,
        way: &mut Vec<&'a Module>,
        done: &mut BTreeSet<&'a Module>,
    ) -> bool {
        let is_back = way.contains(&at);
        way.push(at);
        if is_back {
            return true;
        }
        if !done.contains(at) && arrows[at].iter().any(|next| walk(next, arrows, way, done)) {
            return true;
        }
        way.pop();
        done.insert(at);
        false
    }
    let arrows = arrows(texts);
    let mut done = BTreeSet::new();
    for start in texts.keys().filter(|module| !module.is_empty()) {
        let mut way = Vec::new();
        if walk(start, &arrows, &mut way, &mut done) {
            return Some(way.iter().map(|module| module.join("::")).collect::<Vec<_>>().join(" -> "));
        }
    }
    None
}

#[test]
fn no_files_are_in_a_circle() {
    for crate_name in ["", "crates/mesh", "crates/coupler", "crates/fluid", "crates/solid", "crates/pycav"] {
        let source = root().join(crate_name).join("src");
        let read = |path: &Path| {
            let below = path.strip_prefix(&source).expect("a file of the crate").to_owned();
            (module(&below), fs::read_to_string(path).expect("a source file"))
        };
        let is_source =
            |path: &Path| path.extension().is_some_and(|e| e == "rs") && !path.ends_with("tests.rs");
        let texts = files(&source).iter().filter(|path| is_source(path)).map(|path| read(path)).collect();
        assert_eq!(circle(&texts), None, "{crate_name}");
    }
}

#[test]
fn a_circle_would_be_seen() {
    let texts = |files: &[(&str, &str)]| -> BTreeMap<Module, String> {
        files.iter().map(|(name, text)| (module(Path::new(name)), (*text).to_owned())).collect()
    };
    let straight = [("a.rs", "use crate::b::B;\n"), ("b.rs", "use crate::c::d::{C, D};\n"), ("c/d.rs", "")];
    assert_eq!(circle(&texts(&straight)), None);
    let bent = [straight[0], straight[1], ("c/d.rs", "use crate::{Root, a};\n")];
    assert!(circle(&texts(&bent)).is_some_and(|way| way.contains("c::d")));
    let family = [("c/mod.rs", "pub use d::D;\n"), ("c/d.rs", "use super::C;\nuse crate::c::E;\n")];
    assert_eq!(circle(&texts(&family)), None);
    let siblings = [("c/d.rs", "pub(crate) use super::e::E;\n"), ("c/e.rs", "use super::d::D;\n")];
    assert!(circle(&texts(&siblings)).is_some());
}
