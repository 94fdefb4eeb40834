//! Run directories: used, kept aside, replaced, refused.

use std::fs;
use std::path::Path;

use cav::output::run_directory::{FLUID_HISTORY, SUMMARY};
use cav::output::{OutputError, RunDirectory, summary};
use serde_json::{Map, Value};

fn finish(directory: &RunDirectory) {
    let done = Map::from_iter([("completed".to_owned(), Value::Bool(true))]);
    summary::write(directory, SUMMARY, &done).unwrap();
}

fn names(path: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(path).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_new_directory_is_made_with_its_parents_and_says_that_it_is_not_finished() {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("a/b/run");
    let directory = RunDirectory::prepare(&path, false).unwrap();
    assert_eq!(directory.path(), path);
    assert_eq!(summary::read(&path.join(SUMMARY)).unwrap()["completed"], Value::Bool(false));
    assert_eq!(names(&path), [SUMMARY], "no file in the making is left");
    let empty = place.path().join("empty");
    fs::create_dir(&empty).unwrap();
    assert!(RunDirectory::prepare(&empty, false).unwrap().kept_aside().is_none());
}

#[test]
fn a_finished_run_is_refused_and_with_force_replaced_but_for_other_files() {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("run");
    let directory = RunDirectory::prepare(&path, false).unwrap();
    directory.write_atomic(FLUID_HISTORY, b"old").unwrap();
    fs::write(path.join("notes.txt"), "mine").unwrap();
    finish(&directory);
    drop(directory);

    let error = RunDirectory::prepare(&path, false).unwrap_err();
    assert!(matches!(error, OutputError::Finished { .. }));
    assert!(error.to_string().contains("--force") && error.to_string().contains("run"), "{error}");
    assert_eq!(fs::read(path.join(FLUID_HISTORY)).unwrap(), b"old");

    let directory = RunDirectory::prepare(&path, true).unwrap();
    assert_eq!(names(&path), ["notes.txt", SUMMARY]);
    assert!(directory.kept_aside().is_none());
}

#[test]
fn unfinished_runs_are_kept_aside_one_after_the_other() {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("run");
    for number in 0..3_u8 {
        // With a slash at the end, as shells complete names.
        let directory = RunDirectory::prepare(&place.path().join("run/"), number == 2).unwrap();
        let aside = (number > 0).then(|| place.path().join(format!("run.{number}")));
        assert_eq!(directory.kept_aside(), aside.as_deref());
        directory.write_atomic(FLUID_HISTORY, &[number]).unwrap();
    }
    assert_eq!(names(place.path()), ["run", "run.1", "run.2"]);
    for (name, content) in [("run.1", 0), ("run.2", 1), ("run", 2)] {
        assert_eq!(fs::read(place.path().join(name).join(FLUID_HISTORY)).unwrap(), [content]);
    }
    // A run whose summary is lost is still a run.
    fs::remove_file(path.join(SUMMARY)).unwrap();
    assert!(RunDirectory::prepare(&path, false).unwrap().kept_aside().is_some());
}

#[test]
fn a_directory_of_other_files_is_refused_even_with_force() {
    let place = tempfile::tempdir().unwrap();
    for name in ["thesis.tex", "case.toml", "summary.json"] {
        let path = place.path().join(name.replace('.', "-"));
        fs::create_dir(&path).unwrap();
        fs::write(path.join(name), "{}").unwrap();
        for force in [false, true] {
            let error = RunDirectory::prepare(&path, force).unwrap_err();
            assert!(matches!(&error, OutputError::Foreign { example, .. } if example == name), "{error}");
        }
        assert_eq!(fs::read_to_string(path.join(name)).unwrap(), "{}");
    }
}

#[test]
fn a_directory_in_use_is_refused_until_its_run_ends() {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("run");
    let running = RunDirectory::prepare(&path, false).unwrap();
    for attempt in [RunDirectory::prepare(&path, true), RunDirectory::resume(&path)] {
        assert!(matches!(attempt, Err(OutputError::InUse { .. })));
    }
    RunDirectory::open(&path).expect("the sides of the run itself may");
    drop(running);
    RunDirectory::resume(&path).expect("free again");
}

#[test]
fn a_place_that_cannot_be_written_to_is_named() {
    let place = tempfile::tempdir().unwrap();
    fs::write(place.path().join("file"), "").unwrap();
    for path in [place.path().join("file"), place.path().join("file/run"), "/proc/run/of/cav".into()] {
        let error = RunDirectory::prepare(&path, false).unwrap_err();
        assert!(matches!(&error, OutputError::Io { path: named, .. } if *named == path), "{error}");
        assert!(error.to_string().contains("--out"), "{error}");
    }
    assert!(RunDirectory::open(&place.path().join("nowhere")).is_err());
}
