//! A wall that is hit again: by the load that a run has recorded, and from where the run before has left it.

use std::path::Path;

use cav::case::Case;
use cav::output::RunDirectory;
use cav::run::process::drive::{Keeping, in_process};
use cav::run::process::stop::Stop;
use cav::run::record::conclusion::conclude;
use cav::run::wall::{check, keep_apart};
use cav::run::{Options, resume};
use ndarray::Array2;
use serde_json::{Map, Value};

use crate::harness::case;

/// Steel that yields at 400 MPa and hardens by 3 GPa, 20 cells to the load's radius of 1 mm.
fn steel(coupling: &str, more: &str) -> String {
    format!(
        "[time]\nend = 5e-6\n[solid]\nz = [-0.008, 0.0]\nr = [0.0, 0.008]\ncells = [16, 16]\nlevels = 3\n{more}\
         material = {{ density = 7800.0, c1 = 5990.0, c2 = 3458.0 }}\n\
         [solid.plasticity]\nlaw = \"linear\"\nyield_strength = 4e8\nhardening_modulus = 3e9\n\
         [[sensor]]\nname = \"all\"\nradius = 0.008\nrise_time = 2e-7\n\
         [coupling]\nscheme = \"load\"\n[coupling.load]\n{coupling}"
    )
}

/// Up to 1.2 GPa and back within 1 µs.
const PULSE: &str = "amplitude = 1.2e9\nradius = 1e-3\nhistory = [[0.0, 0.0], [0.5e-6, 1.0], [1e-6, 0.0]]\n";

fn repeating(run: &Path) -> String {
    format!("run = {:?}\n", run.display().to_string())
}

fn from(run: &Path) -> String {
    format!("initial = {:?}\n", run.display().to_string())
}

pub fn run(case: &Case, at: &Path) -> Map<String, Value> {
    let directory = RunDirectory::prepare(at, false).expect("a directory");
    directory.write_atomic("case.toml", case.effective_toml().as_bytes()).expect("its case");
    in_process(case, &directory, Keeping::default(), &Stop::default(), &mut |_| {}).expect("a run");
    conclude(&directory, case, None).expect("its end")
}

pub fn number(summary: &Map<String, Value>, key: &str) -> f64 {
    summary[key].as_f64().unwrap_or_else(|| panic!("{key}: {}", summary[key]))
}

fn dataset(run: &Path, name: &str) -> hdf5::Dataset {
    let file = hdf5::File::open(run.join("history.h5")).expect("the histories");
    file.dataset(name).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn rows(run: &Path, name: &str) -> Array2<f64> {
    dataset(run, name).read_2d().expect("rows")
}

fn series(run: &Path, name: &str) -> Vec<f64> {
    dataset(run, name).read_raw().expect("numbers")
}

#[test]
fn a_recorded_load_does_what_it_did_and_a_wall_goes_on_from_where_it_was_left() {
    let place = tempfile::tempdir().unwrap();
    let at = |name: &str| place.path().join(name);
    let first = run(&case(&steel(PULSE, "")), &at("first"));
    assert!(
        number(&first, "pit_depth") > 1e-6
            && number(&first, "work_on_solid") > number(&first, "plastic_work")
    );

    // A sensor as wide as the wall has all of its impulse.
    let sensor = &first["sensors"]["all"];
    let momentum = series(&at("first"), "conservation/solid/momentum_in_z_max");
    let whole = -std::f64::consts::TAU * momentum[momentum.len() - 1];
    let impulse = sensor["impulse"].as_f64().unwrap();
    assert!((impulse / whole - 1.0).abs() < 1e-12, "{impulse} of {whole}");
    // π b² of a Gaussian at its height, less what the rise time cuts off the top: 0.1 of the 0.5 µs that it rises in.
    let peak = 0.9 * 1.2e9 * std::f64::consts::PI * 1e-6;
    let force = sensor["force_peak"].as_f64().unwrap();
    assert!((force / peak - 1.0).abs() < 0.01, "{force} of {peak}");

    // What the surface got, over again on a fresh wall. Of a run that was broken off that is not all.
    let again = case(&steel(&repeating(&at("first")), ""));
    let summary = std::fs::read_to_string(at("first").join("summary.json")).unwrap();
    let whole = "\"completed\": true";
    assert!(summary.contains(whole) && again.warnings().is_empty(), "{:?}", again.warnings());
    std::fs::write(at("first").join("summary.json"), summary.replace(whole, "\"completed\": false")).unwrap();
    let warnings = case(&steel(&repeating(&at("first")), "")).warnings();
    assert!(warnings.len() == 1 && warnings[0].contains("has not reached its end"), "{warnings:?}");
    std::fs::write(at("first").join("summary.json"), summary).unwrap();
    let alone = run(&again, &at("alone"));
    for (key, tolerance) in
        [("pit_depth", 2e-3), ("plastic_work", 2e-3), ("plastic_strain_peak", 5e-3), ("work_on_solid", 2e-3)]
    {
        let ratio = number(&alone, key) / number(&first, key);
        eprintln!("{key}: repeated over first {ratio:.5}");
        assert!((ratio - 1.0).abs() < tolerance, "{key}: {ratio}");
    }
    let impulse = |name: &str| {
        let impulse = rows(&at(name), "interface/impulse");
        impulse.row(impulse.nrows() - 1).to_vec()
    };
    let largest = impulse("first")[0];
    for (again, first) in impulse("alone").into_iter().zip(impulse("first")) {
        assert!((again - first).abs() < 2e-3 * largest, "no impulse is lost: {again} of {first}");
    }

    // On the wall that has been hit.
    let more = from(&at("first"));
    let next = case(&steel(&repeating(&at("first")), &more));
    let second = run(&next, &at("second"));
    let displaced = |name: &str| rows(&at(name), "interface/displacement_z");
    let (before, after) = (displaced("first"), displaced("second"));
    assert_eq!(after.row(0), before.row(before.nrows() - 1), "the surface lies as it was left");
    let [left, strains] = ["first", "second"].map(|name| series(&at(name), "solid/plastic_strain_max"));
    assert_eq!(strains[0], left[left.len() - 1], "so does what is below it");
    assert!(number(&second, "plastic_strain_peak") > strains[0]);
    let (deeper, work) = (number(&second, "pit_depth") / number(&first, "pit_depth"), "plastic_work");
    assert!(deeper > 1.2 && deeper < 2.0, "{deeper}");
    assert!(number(&second, work) < 0.9 * number(&first, work), "it has hardened");

    // The same whatever the threads.
    let three = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    let once_more = three.install(|| run(&next, &at("second-again")));
    for key in ["pit_depth", "plastic_strain_peak", work] {
        assert_eq!(once_more[key], second[key], "{key}");
    }
}

#[test]
fn a_wall_carries_its_weight_once() {
    let place = tempfile::tempdir().unwrap();
    let at = |name: &str| place.path().join(name);
    let heavy = |more: &str| {
        let text = steel(PULSE, &format!("gravity = -1e5\nadapt = false\n{more}"));
        case(&text.replace("end = 5e-6", "end = 1e-7").replace("amplitude = 1.2e9", "amplitude = 1e-3"))
    };
    let first = run(&heavy(""), &at("first"));
    let second = run(&heavy(&from(&at("first"))), &at("second"));
    // ρ g over the depth of the domain, in the lowest cell's centre.
    let weight = 7800.0 * 1e5 * 0.008 * (1.0 - 0.5 / 128.0);
    for run in [&first, &second] {
        let stress = number(run, "von_mises_peak");
        assert!((stress / weight - 1.0).abs() < 0.03, "{stress} of {weight}");
    }
    let ratio = number(&second, "von_mises_peak") / number(&first, "von_mises_peak");
    assert!((ratio - 1.0).abs() < 1e-9, "{ratio}");
}

#[test]
fn a_wall_of_another_kind_is_refused() {
    let place = tempfile::tempdir().unwrap();
    let left = place.path().join("left");
    let short = |text: String| text.replace("end = 5e-6", "end = 1e-7");
    run(&case(&short(steel(PULSE, "adapt = false\n"))), &left);
    let begun = steel(PULSE, &(from(&left) + "adapt = false\n"));
    let with = |old: &str, new: &str| case(&begun.replace(old, new));
    let refusal = |case: &Case| check(case).expect_err("it is another wall");
    for (old, new, message) in [
        ("c1 = 5990.0", "c1 = 6000.0", "solid.material (density, c1, c2) is"),
        ("z = [-0.008, 0.0]", "z = [-0.016, 0.0]", "solid.z is [-0.008, 0.0] there and [-0.016, 0.0] here"),
        ("cells = [16, 16]", "cells = [32, 32]", "solid.cells is"),
        ("levels = 3", "levels = 2", "solid.levels is 3 there and 2 here"),
        ("levels = 3", "levels = 3\ngravity = -9.81", "solid.gravity is [0.0] there and [-9.81] here"),
        ("left", "nowhere", "there is no wall.state in it"),
        (&left.display().to_string(), "nowhere", "(the path counts from the working directory, "),
    ] {
        let error = refusal(&with(old, new));
        assert!(
            error.to_string().contains(message) && error.to_string().contains("solid.initial"),
            "{error}"
        );
        assert_eq!(error.exit_code(), 2);
    }
    assert!(check(&with("", "")).is_ok());
    // To go on takes that wall, too.
    let gone = place.path().join("gone");
    let own = RunDirectory::prepare(&gone, false).unwrap();
    let text = with(&left.display().to_string(), "nowhere").effective_toml();
    own.write_atomic("case.toml", text.as_bytes()).unwrap();
    drop(own);
    let error = resume(&gone, &Options::default(), &Stop::default(), |_| ()).expect_err("no wall");
    assert!(error.to_string().contains("the path counts from the working directory"), "{error}");
    // A file that is damaged.
    let file = left.join("wall.state");
    let mut bytes = std::fs::read(&file).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&file, bytes).unwrap();
    let error = refusal(&with("", ""));
    assert!(error.to_string().contains("damaged"), "{error}");
    // A run must not replace the wall that it begins with.
    let error = keep_apart(&with("", ""), &left.join("../left")).expect_err("its own directory");
    assert!(error.to_string().contains("the run's own directory"), "{error}");
    assert!(keep_apart(&with("", ""), &place.path().join("elsewhere")).is_ok());
    // Runs that repeat each other's loads.
    for (name, other) in [("here", "there"), ("there", "here")] {
        let own = place.path().join(name);
        std::fs::create_dir(&own).unwrap();
        std::fs::write(own.join("history.h5"), "").unwrap();
        let text = format!("[coupling.load]\n{}", repeating(&place.path().join(other)));
        std::fs::write(own.join("case.toml"), text).unwrap();
    }
    let text = steel(&repeating(&place.path().join("here")), "");
    let error = Case::from_toml(&text, "hits", &[]).expect_err("a circle");
    assert!(error.to_string().contains("repeat each other's loads"), "{error}");
    // A load of no run.
    let text = steel(&repeating(&place.path().join("nowhere")), "");
    let error = Case::from_toml(&text, "hits", &[]).expect_err("there is no such run");
    assert!(error.to_string().contains("coupling.load.run"), "{error}");
}

#[test]
fn a_case_is_another_one_when_what_it_begins_from_was_run_anew() {
    let place = tempfile::tempdir().unwrap();
    let left = place.path().join("left");
    let made = |amplitude: &str| {
        let text = steel(&PULSE.replace("1.2e9", amplitude), "adapt = false\n");
        if left.exists() {
            std::fs::remove_dir_all(&left).unwrap();
        }
        run(&case(&text.replace("end = 5e-6", "end = 1e-7")), &left);
        [(repeating(&left), String::new()), (PULSE.to_owned(), from(&left))].map(|(load, begun)| {
            let case = case(&steel(&load, &(begun + "adapt = false\n")));
            [case.hash(), case.fingerprint()]
        })
    };
    let [first, again, other] = ["1.2e9", "1.2e9", "1.3e9"].map(made);
    assert_eq!(first, again, "the same run made once more");
    for (first, other) in first.iter().flatten().zip(other.iter().flatten()) {
        assert_ne!(first, other);
    }
}
