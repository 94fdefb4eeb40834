//! The run directories below a folder.

use std::collections::BTreeSet;
use std::fs::{self, Metadata};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};

use crate::output::run_directory::{CASE, CHECKPOINTS, FLUID_HISTORY, SOLID_HISTORY, SUMMARY};
use crate::runs::ListError;

/// A run directory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    /// Its path below the folder, with `/`; `.` for the folder itself.
    pub path: String,
    /// What its case and its summary were like when they were found: ages and lengths. It changes whenever they do.
    pub stamp: String,
    /// When it was begun, as its case file says; s since 1970.
    pub started: i64,
}

/// All of them, whatever is between, by path: numbers in it in their own order. Places that cannot be read are left out and counted.
///
/// Hidden folders and checkpoints are not looked into. A link to a folder elsewhere is followed once.
///
/// - errors: the folder itself cannot be read.
pub fn find(folder: &Path) -> Result<(Vec<Found>, usize), ListError> {
    let refused = |source| ListError::Folder { folder: folder.to_path_buf(), source };
    let root = folder.canonicalize().map_err(refused)?;
    fs::read_dir(&root).map_err(refused)?;
    let mut walk = Walk { root, found: Vec::new(), followed: BTreeSet::new(), unreadable: 0 };
    walk.look(&walk.root.clone(), "");
    walk.found.sort_by_cached_key(|found| natural(&found.path));
    Ok((walk.found, walk.unreadable))
}

struct Walk {
    root: PathBuf,
    found: Vec<Found>,
    followed: BTreeSet<PathBuf>,
    unreadable: usize,
}

impl Walk {
    fn look(&mut self, directory: &Path, path: &str) {
        let Ok(entries) = fs::read_dir(directory) else {
            self.unreadable += 1;
            return;
        };
        let (mut files, mut folders) = (0, Vec::new());
        for entry in entries.flatten() {
            let name = entry.file_name();
            let Some(text) = name.to_str().filter(|name| !name.starts_with('.')) else { continue };
            if [CASE, SUMMARY, FLUID_HISTORY, SOLID_HISTORY].contains(&text) {
                files |= if text == SUMMARY { 1 } else { 2 };
                continue;
            }
            let Ok(kind) = entry.file_type() else { continue };
            if kind.is_dir() || kind.is_symlink() && self.is_new_folder(&entry.path()) {
                folders.push(text.to_owned());
            }
        }
        let is_run = files == 3;
        if is_run {
            self.found.push(found(directory, path));
        }
        for name in folders.into_iter().filter(|name| !(is_run && name == CHECKPOINTS)) {
            let below = if path.is_empty() { name.clone() } else { format!("{path}/{name}") };
            self.look(&directory.join(&name), &below);
        }
    }

    /// Whether a link leads to a folder that is not found otherwise.
    fn is_new_folder(&mut self, link: &Path) -> bool {
        let Ok(target) = link.canonicalize() else { return false };
        target.is_dir()
            && !target.starts_with(&self.root)
            && !self.root.starts_with(&target)
            && self.followed.insert(target)
    }
}

fn found(directory: &Path, path: &str) -> Found {
    let file = |name: &str| fs::metadata(directory.join(name)).ok();
    let (case, summary) = (file(CASE), file(SUMMARY));
    let age = |file: &Option<Metadata>| {
        file.as_ref().map_or((0, 0, 0), |file| (file.mtime(), file.mtime_nsec(), file.len()))
    };
    let (of_case, of_summary) = (age(&case), age(&summary));
    Found {
        path: if path.is_empty() { ".".to_owned() } else { path.to_owned() },
        stamp: format!("{of_case:?} {of_summary:?}"),
        started: of_case.0,
    }
}

/// A text in parts that compare as people sort names: `grid-2` before `grid-10`, `0.12` before `0.5`.
fn natural(text: &str) -> Vec<(u128, String)> {
    let parts = text.as_bytes().chunk_by(|a, b| a.is_ascii_digit() == b.is_ascii_digit());
    let mut at = 0;
    parts
        .map(|part| {
            let (before, piece) = (&text[..at], &text[at..at + part.len()]);
            at += part.len();
            // Behind a point, and with zeros in front, digits sort like letters.
            let is_fraction = part[0].is_ascii_digit() && (before.ends_with('.') || part[0] == b'0');
            let number = if is_fraction { 0 } else { piece.parse().unwrap_or(u128::MAX) };
            (number, piece.to_owned())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn make(place: &Path, runs: &[&str]) {
        for run in runs {
            fs::create_dir_all(place.join(run)).expect("a directory");
            for name in [CASE, SUMMARY] {
                fs::write(place.join(run).join(name), "").expect("a file");
            }
        }
    }

    fn paths(folder: &Path) -> Vec<String> {
        find(folder).expect("it is there").0.into_iter().map(|found| found.path).collect()
    }

    #[test]
    fn runs_are_found_at_any_depth_and_nothing_else_is() {
        let place = tempfile::tempdir().expect("a directory");
        let at = |name: &str| place.path().join("runs").join(name);
        make(&at(""), &["b", "a/grid-10", "a/grid-2", "b/within", "b/checkpoints", ".hidden/c"]);
        make(&place.path().join("elsewhere"), &["d"]);
        fs::create_dir_all(at("notes")).expect("a directory");
        fs::write(at("notes/summary.json"), "{}").expect("a file");
        for (target, link) in
            [("elsewhere", "far"), ("elsewhere", "far-again"), ("runs/a", "near"), ("", "up")]
        {
            std::os::unix::fs::symlink(place.path().join(target), at(link)).expect("a link");
        }
        let found = paths(&at(""));
        let far: Vec<_> = found.iter().filter(|path| path.starts_with("far")).collect();
        assert_eq!(far.len(), 1, "{found:?}");
        let rest: Vec<_> = found.iter().filter(|path| !path.starts_with("far")).collect();
        assert_eq!(rest, ["a/grid-2", "a/grid-10", "b", "b/within"]);
        assert_eq!(paths(&at("b"))[0], ".");
        assert!(matches!(find(&at("none")), Err(ListError::Folder { .. })));
        assert!(matches!(find(&at("b/case.toml")), Err(ListError::Folder { .. })));
    }

    #[test]
    fn names_sort_by_their_numbers_and_fractions_as_fractions() {
        for (first, second) in [
            ("grid-2", "grid-10"),
            ("r0.008", "r0.01"),
            ("r0.12", "r0.5"),
            ("run-009", "run-010"),
            ("a", "b1"),
        ] {
            assert!(natural(first) < natural(second), "{first} {second}");
        }
    }

    #[test]
    fn a_changed_file_changes_the_stamp() {
        let place = tempfile::tempdir().expect("a directory");
        make(place.path(), &["a"]);
        let stamp = || find(place.path()).expect("it is there").0[0].stamp.clone();
        let before = stamp();
        assert_eq!(stamp(), before);
        fs::write(place.path().join("a").join(SUMMARY), "{}").expect("a file");
        assert_ne!(stamp(), before);
    }
}
