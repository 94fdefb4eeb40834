//! Runs that are made longer: the same, bit by bit, as runs that were meant to be as long from the start.

use std::path::Path;
use std::time::Duration;

use cav::case::Case;
use cav::run::process::stop::Stop;
use cav::run::{Options, resume, run};

use crate::cases::{coupled, fluid_alone, growing, loaded, solid};
use crate::compare::{assert_same, datasets, summary};
use crate::processes::without_processes;

fn options(out: &Path) -> Options {
    Options {
        out: Some(out.to_path_buf()),
        in_process: true,
        quiet: true,
        checkpoint_every: Some(Duration::from_secs(300)),
        ..Options::default()
    }
}

fn begin(case: &Case, out: &Path) {
    run(case, &options(out), &Stop::default(), |_| {}).unwrap();
}

fn go_on(out: &Path, end: Option<f64>) -> Result<(), String> {
    let options = Options { end, ..options(out) };
    resume(out, &options, &Stop::default(), |_| {}).map(|_| ()).map_err(|error| error.to_string())
}

fn read(text: &str, sets: &[&str]) -> Case {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    Case::from_toml(text, "longer", &sets).unwrap()
}

/// Makes a run longer twice.
fn check(what: &str, text: &str, sets: &[&str], ends: [f64; 3]) {
    let workshop = tempfile::tempdir().unwrap();
    let [whole, longer] = ["whole", "longer"].map(|name| workshop.path().join(name));
    let first = format!("time.end={:?}", ends[0]);
    begin(&read(text, &[sets, &[&first]].concat()), &longer);
    for end in &ends[1..] {
        let steps = summary(&longer)["steps"].as_u64();
        go_on(&longer, Some(*end)).unwrap();
        let told = summary(&longer);
        assert!(told["completed"] == true && told["steps"].as_u64() > steps, "{what}: {told:#}");
        let kept: Vec<_> = std::fs::read_dir(longer.join("checkpoints")).unwrap().collect();
        assert!((1..=2).contains(&kept.len()), "{what}: {kept:?}");
    }
    let case = std::fs::read_to_string(longer.join("case.toml")).unwrap();
    let case = read(&case, &[]);
    assert!(case.time.end == ends[2] && ends.iter().all(|end| case.time.snapshots.contains(end)), "{what}");
    begin(&case, &whole);
    assert!(assert_same(what, &whole, &longer, true) > 20, "{what}");
    // Files say of which case they are.
    let hash = |directory: &Path| {
        let file =
            ["fluid.h5", "solid.h5"].map(|name| directory.join(name)).into_iter().find(|path| path.exists());
        cav::output::root_attribute(&file.unwrap(), "case_hash").unwrap()
    };
    assert_eq!(hash(&whole), hash(&longer), "{what}");
}

#[test]
fn both_sides() {
    let _turn = without_processes();
    check("local", &coupled(), &["time.local_steps=true"], [1.1e-5, 1.5e-5, 2.0e-5]);
    check("one step", &coupled(), &["coupling.step_ratio=1"], [1.1e-5, 1.15e-5, 1.6e-5]);
    check("weak", &coupled(), &["coupling.scheme=weak"], [0.9e-5, 1.0e-5, 1.2e-5]);
}

#[test]
fn either_side() {
    let _turn = without_processes();
    check("fluid", &fluid_alone(), &[], [1e-5, 2e-5, 3e-5]);
    check("cut", &growing(), &["time.local_steps=true"], [3e-5, 9e-5, 1.3e-4]);
    check("load", &loaded(), &[], [1.1e-6, 2e-6, 3.3e-6]);
    check("solid", &solid(), &["time.local_steps=true"], [2e-6, 4e-6, 5e-6]);
}

#[test]
fn what_cannot_be_made_longer_is_as_it_was() {
    let _turn = without_processes();
    let workshop = tempfile::tempdir().unwrap();
    let out = workshop.path().join("run");
    begin(&read(&solid(), &["time.end=2e-6"]), &out);
    let left = |name: &str| std::fs::read(out.join(name)).unwrap();
    let before = ["summary.json", "case.toml", "solid.h5"].map(left);
    let is_refused = |end: f64, words: &str| {
        let told = go_on(&out, Some(end)).unwrap_err();
        assert!(told.contains(words), "{told}");
        assert_eq!(["summary.json", "case.toml", "solid.h5"].map(left), before);
    };
    is_refused(2e-6, "is no later");
    is_refused(1e-6, "is no later");
    is_refused(1e9, "more than 1e6 rows until time.end = 1000000000.0 s");
    go_on(&out, None).unwrap();
    assert_eq!(left("summary.json"), before[0], "without a later end there is nothing to do");
    std::fs::remove_dir_all(out.join("checkpoints")).unwrap();
    is_refused(3e-6, "has no checkpoint to go on from");
    assert!(datasets(&out.join("solid.vtkhdf")).len() > 10);
}
