//! Bad cases are refused with the key, what is wrong and the remedy; good ones survive being written out.

#![allow(missing_docs)]

use std::path::Path;

use cav::case::{Case, CaseErrors};

#[path = "case_errors/bad.rs"]
mod bad;
#[path = "case_errors/bubble.rs"]
mod bubble;
mod fixture;
#[path = "case_errors/good.rs"]
mod good_cases;
#[path = "case_errors/interest.rs"]
mod interest;
#[path = "case_errors/media.rs"]
mod media;

use bad::BAD;
use fixture::SMALL;
use good_cases::round_trip;

/// A small coupled case that is right.
fn good_text() -> String {
    SMALL.to_owned()
}

/// What is done to the good case.
enum Edit {
    Whole(&'static str),
    Replace(&'static str, &'static str),
    Append(&'static str),
    Sets(&'static [&'static str]),
}
use Edit::{Append, Replace, Sets, Whole};

fn read(edit: &Edit) -> Result<Case, CaseErrors> {
    match edit {
        Whole(text) => Case::from_toml(text, "bad", &[]),
        Replace(from, to) => {
            let good = good_text();
            assert!(good.contains(from), "the good case has no `{from}`");
            Case::from_toml(&good.replacen(from, to, 1), "bad", &[])
        }
        Append(more) => Case::from_toml(&format!("{}\n{more}", good_text()), "bad", &[]),
        Sets(sets) => {
            let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
            Case::from_toml(&good_text(), "bad", &sets)
        }
    }
}

fn good() -> Case {
    Case::from_toml(&good_text(), "good", &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

fn with(sets: &[&str]) -> Case {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    Case::from_toml(&good_text(), "good", &sets).unwrap_or_else(|errors| panic!("{errors}"))
}

#[test]
fn every_bad_case_is_refused_with_key_and_remedy() {
    assert!(BAD.len() >= 35);
    good();
    let mut wrong = String::new();
    for (number, (edit, fragments)) in BAD.iter().chain(bubble::BAD).enumerate() {
        match read(edit) {
            Ok(_) => wrong += &format!("row {number} ({fragments:?}) was accepted\n"),
            Err(errors) => {
                let text = errors.to_string();
                assert!(errors.faults().iter().all(|fault| !fault.message.contains('\u{1b}')));
                for missing in fragments.iter().filter(|fragment| !text.contains(**fragment)) {
                    wrong += &format!("row {number}: no `{missing}` in:\n{text}\n\n");
                }
                for fault in errors.faults() {
                    assert!(fault.help.as_ref().is_some_and(|help| !help.is_empty()), "{fault}: no remedy");
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn all_faults_of_a_case_come_together_and_are_drawn() {
    let text = good_text().replace("gamma = 7.15", "gamma = 0.9").replace("radius = 0.002", "raduis = 0.002");
    let errors = Case::from_toml(&text, "bubble", &[]).expect_err("two mistakes");
    assert_eq!(errors.faults().len(), 3, "{errors}");
    let drawn = errors.render(false);
    assert!(!drawn.contains('\u{1b}'), "{drawn}");
    for part in ["gamma = 0.9", "raduis = 0.002", "bubble.toml:11:9", "did you mean `radius`?"] {
        assert!(drawn.contains(part), "no `{part}` in:\n{drawn}");
    }
    assert!(errors.render(true).contains('\u{1b}'));
}

proptest::proptest! {
    /// Whatever a line is replaced by, reading ends with a case or with faults, and a case can be written out.
    #[test]
    fn damaged_cases_do_not_panic(
        line in 1_usize..32,
        value in "[-+.eE0-9]{1,9}|[\\[\\]{}=\"'.a-z0-9, ]{0,12}|inf|nan|\\[1e308, -1e308\\]|1e308|9223372036854775807",
        set in "(time|fluid|solid|probe)(\\.(end|cells|levels|z|r|region|material|0|1|x)){0,3}=[\\[\\]{}0-9ae.,]{0,5}",
    ) {
        let good = good_text();
        let damaged: Vec<String> = good
            .lines()
            .enumerate()
            .map(|(number, text)| match text.split_once('=') {
                Some((key, _)) if number == line => format!("{key}= {value}"),
                None if number == line => value.clone(),
                _ => text.to_owned(),
            })
            .collect();
        for (text, sets) in [(damaged.join("\n"), vec![]), (good, vec![set])] {
            match Case::from_toml(&text, "damaged", &sets) {
                Ok(case) => {
                    round_trip(&case);
                    cav::case::report(&case);
                }
                Err(errors) => assert!(!errors.faults().is_empty() && !errors.render(false).is_empty()),
            }
        }
    }
}

#[test]
fn a_missing_file_and_a_directory_are_named() {
    for (path, part) in [("no/such/case.toml", "check the path"), ("cases", "give the TOML file")] {
        let errors = Case::load(Path::new(path), &[]).expect_err("no case there").to_string();
        assert!(errors.contains(path) && errors.contains(part), "{errors}");
    }
    let dir = tempfile::tempdir().expect("a temporary directory");
    let path = dir.path().join("binary.toml");
    std::fs::write(&path, [0xff, 0xfe, 0x00]).expect("written");
    let errors = Case::load(&path, &[]).expect_err("no text").to_string();
    assert!(errors.contains("UTF-8"), "{errors}");
}

#[test]
fn no_snapshots_but_the_first_and_the_last_may_be_asked_of_any_case() {
    let case = with(&["time.snapshot_every=3.1e-7", "time.snapshots=[]"]);
    assert_eq!(case.time.snapshots, [0.0, case.time.end]);
}
