//! What a run cannot go on from: checkpoints that are damaged or of another case, directories that hold no run.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;
use std::time::Duration;

use cav::case::Case;
use cav::run::process::launch::prepare;
use cav::run::process::launch_options::Options;
use cav::run::process::session::{Session, Solvers};
use cav::run::process::stop::Stop;
use sha2::{Digest, Sha256};

use crate::cases::coupled;
use crate::compare::{assert_same, summary};
use crate::processes::{Workshop, alone, checkpoints, text};

/// Short enough to be run several times.
const SHORT: [&str; 2] = ["--set", "time.end=4e-6"];
const ALONE: [&str; 2] = ["--in-process", "-v"];

/// Leaves the run NAME cut off after some steps, with a checkpoint of each of the last two.
fn cut_off(workshop: &Workshop, name: &str, steps: usize) -> PathBuf {
    let case = Case::load(&workshop.file("case.toml"), &["time.end=4e-6".to_owned()]).unwrap();
    let options = Options { out: Some(workshop.file(name)), ..Options::default() };
    let directory = prepare(&case, &options).unwrap();
    let mut session = Session::new(&case, Some(&directory), Solvers::default()).unwrap();
    session.keep_checkpoints(&case, &directory, Duration::ZERO);
    for _ in 0..steps {
        session.step(&Stop::default()).unwrap();
    }
    workshop.file(name)
}

fn go_on(workshop: &Workshop, name: &str) -> Output {
    workshop.resume(name, &ALONE).output().unwrap()
}

/// Runs on to the end and compares with a run that was never cut off.
fn goes_on_right(workshop: &Workshop, name: &str, words: &[&str]) {
    let output = go_on(workshop, name);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output));
    words.iter().for_each(|word| assert!(text(&output).contains(word), "{word}: {}", text(&output)));
    if !workshop.file("whole").exists() {
        workshop.done("whole", &[&SHORT[..], &["--in-process"]].concat());
    }
    assert_same(name, &workshop.file("whole"), &workshop.file(name), true);
}

fn is_refused(workshop: &Workshop, name: &str, words: &[&str]) {
    let output = go_on(workshop, name);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output));
    words.iter().for_each(|word| assert!(text(&output).contains(word), "{word}: {}", text(&output)));
    assert!(!text(&output).contains("panicked"), "{}", text(&output));
}

fn damage(directory: &Path, name: &str, how: impl FnOnce(&mut Vec<u8>)) {
    let path = directory.join("checkpoints").join(name);
    let mut bytes = fs::read(&path).unwrap();
    how(&mut bytes);
    fs::write(&path, bytes).unwrap();
}

#[test]
fn the_last_two_checkpoints_are_kept_and_a_damaged_one_is_passed_over() {
    let _turn = alone();
    let workshop = Workshop::with(&coupled());
    type Change = fn(&mut Vec<u8>);
    let cut: [(&str, Change); 4] = [
        ("a flipped bit", |bytes| bytes[5000] ^= 1),
        ("half of it", |bytes| bytes.truncate(bytes.len() / 2)),
        ("nothing", Vec::clear),
        ("garbage", |bytes| bytes.fill(0x5a)),
    ];
    for (number, (what, how)) in cut.into_iter().enumerate() {
        let name = format!("damaged-{number}");
        let directory = cut_off(&workshop, &name, 9);
        let all = checkpoints(&directory);
        assert_eq!(all.len(), 4, "two of each side: {all:?}");
        // The newest, of one side or of the other.
        damage(&directory, &all[1 + 2 * (number % 2)], how);
        goes_on_right(&workshop, &name, &["warning", "cannot be used", "going on from"]);
        assert_eq!(checkpoints(&directory).len(), 2, "{what}: a finished run keeps its last one");
    }
}

#[test]
fn half_a_checkpoint_does_not_count() {
    let _turn = alone();
    let workshop = Workshop::with(&coupled());
    let directory = cut_off(&workshop, "half", 9);
    let all = checkpoints(&directory);
    fs::remove_file(directory.join("checkpoints").join(&all[3])).unwrap();
    fs::write(directory.join("checkpoints/solid-000000000099.ckpt.tmp"), b"in the making").unwrap();
    fs::write(directory.join("fluid.vtkhdf.tmp"), b"in the making").unwrap();
    goes_on_right(&workshop, "half", &["going on from"]);
    assert!(!directory.join("fluid.vtkhdf.tmp").exists());
}

/// The same change in all checkpoints of a run.
fn is_refused_with_all_damaged(change: impl Fn(&mut Vec<u8>), words: &[&str]) {
    let _turn = alone();
    let workshop = Workshop::with(&coupled());
    let directory = cut_off(&workshop, "lost", 9);
    for name in checkpoints(&directory) {
        damage(&directory, &name, &change);
    }
    is_refused(&workshop, "lost", words);
}

#[test]
fn with_nothing_but_damaged_checkpoints_a_run_says_so() {
    is_refused_with_all_damaged(
        |bytes| bytes[100] ^= 4,
        &["none of its checkpoints can be used", "checksum"],
    );
}

#[test]
fn a_checkpoint_of_another_format_is_named() {
    is_refused_with_all_damaged(|bytes| bytes[8] = 77, &["its format is 77"]);
}

/// A program whose state has other fields has written it, and nobody has counted up the format.
#[test]
fn a_checkpoint_of_another_layout_is_refused_and_not_decoded() {
    let _turn = alone();
    let workshop = Workshop::with(&coupled());
    let directory = cut_off(&workshop, "other", 9);
    for name in checkpoints(&directory) {
        damage(&directory, &name, |bytes| {
            let content = bytes.len() - 32;
            bytes[12] ^= 1;
            let sum = Sha256::digest(&bytes[..content]);
            bytes[content..].copy_from_slice(&sum);
        });
    }
    is_refused(
        &workshop,
        "other",
        &["none of its checkpoints can be used", "another version has written it"],
    );
    assert_eq!(checkpoints(&directory).len(), 4, "and kept");
}

#[test]
fn a_changed_case_is_refused_whatever_has_changed() {
    let _turn = alone();
    let workshop = Workshop::with(&coupled());
    let directory = cut_off(&workshop, "changed", 9);
    let case = fs::read_to_string(directory.join("case.toml")).unwrap();
    for (from, to) in [("cfl = ", "cfl = 0.1 # "), ("compression = ", "compression = 3 # ")] {
        assert!(case.contains(from), "{case}");
        fs::write(directory.join("case.toml"), case.replacen(from, to, 1)).unwrap();
        is_refused(&workshop, "changed", &["another case", "case.toml"]);
    }
    fs::write(directory.join("case.toml"), "end = ").unwrap();
    is_refused(&workshop, "changed", &["TOML"]);
    // Nothing was lost by that.
    fs::write(directory.join("case.toml"), case).unwrap();
    goes_on_right(&workshop, "changed", &["going on from"]);
}

#[test]
fn a_run_without_any_checkpoint_begins_again() {
    let _turn = alone();
    let workshop = Workshop::with(&coupled());
    cut_off(&workshop, "early", 1);
    assert!(checkpoints(&workshop.file("early")).is_empty());
    goes_on_right(&workshop, "early", &["no checkpoint yet", "begins again"]);
}

#[test]
fn a_finished_run_is_left_as_it_is() {
    let _turn = alone();
    let workshop = Workshop::with(&coupled());
    workshop.done("finished", &[&SHORT[..], &["--in-process"]].concat());
    let before = fs::metadata(workshop.file("finished/fluid.h5")).unwrap().modified().unwrap();
    let output = go_on(&workshop, "finished");
    assert_eq!(output.status.code(), Some(0), "{}", text(&output));
    assert!(text(&output).contains("is finished"), "{}", text(&output));
    assert_eq!(fs::metadata(workshop.file("finished/fluid.h5")).unwrap().modified().unwrap(), before);
}

#[test]
fn only_directories_of_runs_are_taken_up() {
    let _turn = alone();
    let workshop = Workshop::with(&coupled());
    is_refused(&workshop, "nowhere", &["holds no case.toml"]);
    fs::create_dir(workshop.file("empty")).unwrap();
    is_refused(&workshop, "empty", &["holds no case.toml"]);
    // What would change the case does not go with it.
    for more in [&["--set", "time.end=1"][..], &["--out", "x"], &["--force"]] {
        let output = workshop.resume("empty", more).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{more:?}: {}", text(&output));
        assert!(text(&output).contains("--resume"), "{}", text(&output));
    }
}

#[test]
fn without_checkpoints_none_are_kept() {
    let _turn = alone();
    let workshop = Workshop::with(&coupled());
    let case = Case::load(&workshop.file("case.toml"), &["time.end=4e-6".to_owned()]).unwrap();
    let options = Options { out: Some(workshop.file("off")), ..Options::default() };
    let directory = prepare(&case, &options).unwrap();
    let mut session = Session::new(&case, Some(&directory), Solvers::default()).unwrap();
    let stop = Stop::default();
    for _ in 0..5 {
        session.step(&stop).unwrap();
    }
    stop.interrupt();
    session.step(&stop).unwrap();
    assert!(checkpoints(&workshop.file("off")).is_empty());
    assert_eq!(summary(&workshop.file("off"))["completed"], false);
}
