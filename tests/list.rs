//! `cav list`: runs found, told apart, filtered, kept in an index.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, SystemTime};

use cav::output::RunDirectory;
use serde_json::{Value, json};

mod fixture;

fn cav(place: &Path, arguments: &[&str]) -> Output {
    let mut cav = Command::new(env!("CARGO_BIN_EXE_cav"));
    cav.args(arguments).current_dir(place).stdin(Stdio::null());
    cav.output().expect("cav starts")
}

/// What a listing prints; it must succeed, and say nothing else.
fn listed(place: &Path, arguments: &[&str]) -> String {
    let output = cav(place, &[&["list"], arguments].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.is_empty(), "{arguments:?}: {said}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn json_of(place: &Path, arguments: &[&str]) -> Vec<Value> {
    serde_json::from_str(&listed(place, &[arguments, &["--json"]].concat())).expect("JSON")
}

fn paths(place: &Path, arguments: &[&str]) -> Vec<String> {
    let path = |run: &Value| run["path"].as_str().expect("a path").to_owned();
    json_of(place, arguments).iter().map(path).collect()
}

/// What the files of a run say at least.
fn make(place: &Path, path: &str, radius: f64, material: &str, summary: Value) {
    let directory = place.join("runs").join(path);
    fs::create_dir_all(&directory).expect("a directory");
    let density = if material == "copper" { 8960.0 } else { 7800.0 };
    let case = format!(
        "geometry = \"axisymmetric\"\n[time]\nend = 1e-6\n[[fluid.region]]\nradius = {radius:?}\ncentre = [0.03, 0.0]\n\
         [solid.material]\nname = \"{material}\"\ndensity = {density:?}\n[output]\ncompression = 4\ndirectory = \"{path}\"\n"
    );
    fs::write(directory.join("case.toml"), case).expect("a case");
    fs::write(directory.join("summary.json"), summary.to_string()).expect("a summary");
}

/// Four runs: two of steel, one of copper, one that failed, one that was interrupted.
fn workshop() -> tempfile::TempDir {
    let place = tempfile::tempdir().expect("a directory");
    let of = |peak: f64| {
        json!({ "completed": true, "program": "cav 0.1.0", "cells_per_radius": 6.4, "wall_pressure_peak": peak,
                                 "pit_radius": null, "answer": ["It hits, at 5 µs.", "Nothing yields."] })
    };
    make(place.path(), "a-2", 0.01, "steel", of(2.5e8));
    make(place.path(), "a-10", 0.02, "steel", of(3e8));
    make(place.path(), "deep/er/b", 0.01, "copper", of(0.5e8));
    make(place.path(), "failed", 0.01, "steel", json!({ "completed": false, "error": "it collapsed" }));
    make(place.path(), "stopped", 0.01, "steel", json!({ "completed": false }));
    place
}

#[test]
fn runs_are_listed_with_what_was_varied_their_numbers_and_states() {
    let workshop = workshop();
    let place = workshop.path();
    let runs = json_of(place, &[]);
    assert_eq!(paths(place, &[]), ["a-2", "a-10", "deep/er/b", "failed", "stopped"]);
    let states: Vec<_> = runs.iter().map(|run| run["state"].as_str().expect("a state")).collect();
    assert_eq!(states, ["finished", "finished", "finished", "failed", "interrupted"]);
    assert_eq!(runs[1]["fluid.region.0.radius"], json!(0.02));
    assert_eq!(runs[2]["solid.material.name"], json!("copper"));
    assert_eq!(
        (&runs[0]["wall_pressure_peak"], &runs[3]["wall_pressure_peak"]),
        (&json!(2.5e8), &Value::Null)
    );
    assert_eq!((&runs[0]["version"], &runs[0]["cells_per_radius"]), (&json!("0.1.0"), &json!(6.4)));
    let has = |key: &str| runs[0].as_object().expect("a table").contains_key(key);
    assert!(!has("time.end") && !has("output.directory") && !has("solid.material.density"), "{}", runs[0]);
    let table = listed(place, &[]);
    for fragment in [
        "path ",
        "material.",
        "radius",
        "250.0 MPa",
        "5 runs: 3 finished, 1 failed, 1 interrupted.",
        "--resume",
    ] {
        assert!(table.contains(fragment), "no {fragment} in\n{table}");
    }
    // Of runs that have one material the material is not told.
    assert!(!listed(place, &["--where", "solid.material=steel"]).contains("material"));
    let csv = listed(place, &["--csv", "--columns", "state,answer,wall_pressure_peak"]);
    let lines: Vec<_> = csv.lines().collect();
    assert_eq!(lines[0], "path,state,answer,wall_pressure_peak");
    assert_eq!(lines[1], "a-2,finished,\"It hits, at 5 µs. Nothing yields.\",2.5e8");
    assert_eq!(lines[4], "failed,failed,,");
    assert_eq!(json_of(place, &["--columns", "all"])[0]["time.end"], json!(1e-6));
    // Also where no run has one.
    let failed = &json_of(place, &["--columns", "error,exit_code"])[3];
    assert_eq!((&failed["error"], &failed["exit_code"]), (&json!("it collapsed"), &Value::Null));
    assert_eq!(
        json_of(place, &["--columns", "answer"])[0]["answer"],
        json!(["It hits, at 5 µs.", "Nothing yields."])
    );
}

#[test]
fn filters_and_orders_do_what_they_say() {
    let workshop = workshop();
    let place = workshop.path();
    let by = |arguments: &[&str]| paths(place, arguments);
    assert_eq!(by(&["--where", "solid.material=steel", "--where", "wall_pressure_peak>2.6e8"]), ["a-10"]);
    assert_eq!(by(&["--where", "wall_pressure_peak<=2.5e8"]), ["a-2", "deep/er/b"]);
    assert_eq!(by(&["--where", "path~deep"]), ["deep/er/b"]);
    assert_eq!(by(&["--where", "fluid.region.0.radius != 0.01"]), ["a-10"]);
    assert_eq!(by(&["--state", "failed,interrupted"]), ["failed", "stopped"]);
    assert_eq!(by(&["--state", "running"]), Vec::<String>::new());
    assert_eq!(by(&["--sort", "wall_pressure_peak"]), ["deep/er/b", "a-2", "a-10", "failed", "stopped"]);
    assert_eq!(by(&["--sort", "wall_pressure_peak", "--reverse"])[..3], ["a-10", "a-2", "deep/er/b"]);
    assert!(listed(place, &["--state", "running"]).contains("None of the 5 runs in runs is like that."));
}

#[test]
fn what_makes_no_sense_is_refused_with_code_2_and_what_may_be_meant() {
    let workshop = workshop();
    for (arguments, fragments) in [
        (&["elsewhere"][..], &["cannot list elsewhere", "give the folder"][..]),
        (&["runs/a-2/case.toml"], &["cannot list", "give the folder"]),
        (&["--where", "radius=1"], &["no run has the key `radius`", "`fluid.region.0.radius`"]),
        (&["--where", "wall_presure_peak>1"], &["`wall_pressure_peak`"]),
        (&["--sort", "peak"], &["no run has the key `peak`"]),
        (&["--columns", "stat"], &["`state`"]),
        (&["--where", "wall_pressure_peak"], &["compares nothing", "KEY=VALUE"]),
        (&["--state", "done"], &["--state done", "running, finished, failed, interrupted"]),
        (&["--json", "--csv"], &["--csv"]),
    ] {
        let output = cav(workshop.path(), &[&["list"], arguments].concat());
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        for fragment in fragments {
            assert!(said.contains(fragment), "{arguments:?}: no {fragment} in {said}");
        }
    }
    fs::create_dir(workshop.path().join("empty")).expect("a folder");
    assert_eq!(listed(workshop.path(), &["empty"]), "There are no runs in empty.\n");
    assert!(!workshop.path().join("empty/.cav-index.sqlite").exists());
}

#[test]
fn the_index_follows_every_change_and_its_loss_and_damage_are_none() {
    let workshop = workshop();
    let place = workshop.path();
    let index = place.join("runs/.cav-index.sqlite");
    let first = listed(place, &["--json"]);
    assert!(index.is_file());
    assert_eq!(listed(place, &["--json"]), first);
    // What is in the index is what is told, as long as the files are as they were: their ages say so, not their content.
    let summary = place.join("runs/a-2/summary.json");
    let text = fs::read_to_string(&summary).expect("a summary");
    let age = |path: &Path| fs::metadata(path).and_then(|file| file.modified()).expect("an age");
    let set_age = |path: &Path, age: SystemTime| {
        fs::File::options().write(true).open(path).and_then(|file| file.set_modified(age)).expect("an age")
    };
    let before = age(&summary);
    let changed = text.replace("250000000.0", "260000000.0");
    assert_ne!(changed, text);
    fs::write(&summary, &changed).expect("it is written");
    set_age(&summary, before);
    assert_eq!(listed(place, &["--json"]), first, "the index was not used");
    set_age(&summary, before + Duration::from_millis(10));
    assert_eq!(json_of(place, &[])[0]["wall_pressure_peak"], json!(2.6e8));
    fs::rename(place.join("runs/failed"), place.join("runs/moved")).expect("it is moved");
    assert_eq!(paths(place, &[]), ["a-2", "a-10", "deep/er/b", "moved", "stopped"]);
    fs::write(&index, "damaged".repeat(1000)).expect("it is written");
    assert_eq!(json_of(place, &[]).len(), 5);
    fs::remove_file(&index).expect("it was made anew");
    assert_eq!(json_of(place, &[]).len(), 5);
    // Where there is something in its place that is no file.
    fs::remove_file(&index).expect("it was made anew");
    fs::create_dir(&index).expect("a folder");
    let output = cav(place, &["list", "--json"]);
    let note = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.success() && note.starts_with("note: ") && note.contains("reads all runs"),
        "{note}"
    );
    assert_eq!(serde_json::from_slice::<Vec<Value>>(&output.stdout).expect("JSON").len(), 5);
}

#[test]
fn a_run_is_running_while_somebody_holds_it_whatever_its_files_say() {
    let workshop = workshop();
    let place = workshop.path();
    let held = RunDirectory::resume(&place.join("runs/stopped")).expect("it is free");
    let old = SystemTime::now() - Duration::from_secs(1_000_000);
    let summary = fs::File::options().write(true).open(place.join("runs/stopped/summary.json"));
    summary.and_then(|file| file.set_modified(old)).expect("an age");
    let progress = json!({ "time": 2.5e-7, "step": 3, "dt": 1e-9, "limited_by": "fluid", "cells": 8, "solid_cells": 4,
                           "wall": 1.0, "end": 1e-6, "left": 3.0 });
    fs::write(place.join("runs/stopped/progress.json"), progress.to_string()).expect("a progress");
    assert_eq!(paths(place, &["--state", "running"]), ["stopped"]);
    assert!(listed(place, &[]).contains("running 25 %"), "{}", listed(place, &[]));
    drop(held);
    assert_eq!(paths(place, &["--state", "running"]), Vec::<String>::new());
    assert!(listed(place, &[]).contains("interrupted 25 %"), "{}", listed(place, &[]));
}

#[test]
fn wholes_of_planar_runs_are_per_metre_of_depth() {
    let place = tempfile::tempdir().expect("a directory");
    let place = place.path();
    for run in ["round", "plane"] {
        make(place, run, 0.01, "steel", json!({ "completed": true, "plastic_work": 2.5, "pit_depth": 1e-6 }));
    }
    let path = place.join("runs/plane/case.toml");
    let text = fs::read_to_string(&path).expect("a case").replace("axisymmetric", "planar");
    fs::write(&path, text).expect("a case");
    let table = listed(place, &["--columns", "plastic_work,pit_depth"]);
    let row = |run: &str| table.lines().find(|line| line.starts_with(run)).unwrap_or_default().to_owned();
    assert!(row("plane").contains("2.50 J/m") && row("plane").contains("1.00 µm"), "{table}");
    assert!(row("round").contains("2.50 J ") && !row("round").contains("J/m"), "{table}");
}

/// A table of an inflow is one value; nobody reads all of it in a cell.
#[test]
fn long_lists_are_cut_in_tables_and_whole_in_csv_and_json() {
    let workshop = workshop();
    let place = workshop.path();
    let times: Vec<f64> = (0..2000).map(f64::from).collect();
    for (run, last) in [("a-2", 1.0), ("a-10", 2.0)] {
        let path = place.join("runs").join(run).join("case.toml");
        let others = [vec![0.0; 50], vec![last]].concat();
        let lists = format!("end = 1e-6\nsnapshots = {times:?}\nothers = {others:?}\n");
        let text = fs::read_to_string(&path).expect("a case").replace("end = 1e-6\n", &lists);
        fs::write(&path, text).expect("a case");
    }
    for table in [listed(place, &[]), listed(place, &["--columns", "time.snapshots,time.others"])] {
        let is_narrow = table.lines().all(|line| line.chars().count() < 400);
        assert!(is_narrow && table.contains("[0.0,1.0,2.0,") && table.contains('…'), "{table}");
    }
    // What differs behind the cut is not told as what all have in common.
    let table = listed(place, &["--where", "path~a-"]);
    assert!(table.contains("others") && !table.contains("time.others ["), "{table}");
    assert!(listed(place, &["--csv"]).contains("1998.0,1999.0]"));
    let list = json_of(place, &[])[0]["time.snapshots"].clone();
    assert!(list.as_str().is_some_and(|list| list.ends_with("1999.0]")), "{list}");
}

/// A real run: what it writes is what a listing reads, and listing leaves it alone.
#[test]
fn a_real_run_is_listed_by_its_own_files() {
    let place = tempfile::tempdir().expect("a directory");
    fs::write(place.path().join("case.toml"), fixture::small("end = 1e-6\n", 2)).expect("a case");
    for (out, radius) in [("runs/one", "0.002"), ("runs/two", "0.0015")] {
        let set = format!("fluid.region.0.radius={radius}");
        let made =
            cav(place.path(), &["run", "case.toml", "--out", out, "-q", "--in-process", "--set", &set]);
        assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    }
    let runs = json_of(place.path(), &[]);
    assert_eq!(
        runs.iter().map(|run| run["fluid.region.0.radius"].clone()).collect::<Vec<_>>(),
        [json!(0.002), json!(0.0015)]
    );
    for run in &runs {
        assert_eq!(
            (&run["state"], &run["version"]),
            (&json!("finished"), &json!(env!("CARGO_PKG_VERSION"))),
            "{run}"
        );
        assert!(run["wall_pressure_peak"].is_f64() && run["von_mises_peak"].is_f64(), "{run}");
        assert!(run["started"].as_str().is_some_and(|when| when.starts_with("20")), "{run}");
    }
    // A single run, listed as a folder, gets no file of ours.
    assert_eq!(paths(place.path(), &["runs/one"]), ["."]);
    assert!(!place.path().join("runs/one/.cav-index.sqlite").exists());
}
