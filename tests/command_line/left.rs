//! What a run leaves in its directory.

use std::fs;
use std::path::Path;

use cav::case::Case;

use crate::{Workshop, good_run, text};

pub fn summary(directory: &Path) -> serde_json::Value {
    let text = fs::read_to_string(directory.join("summary.json")).expect("there is a summary");
    serde_json::from_str(&text).expect("it is JSON")
}

/// Datasets with their lengths; those of the first list are as long as the run has steps, the first state included.
const EVERY_STEP: [&str; 26] = [
    "/time",
    "/bubble/volume",
    "/bubble/equivalent_radius",
    "/bubble/centroid_z",
    "/bubble/gas_mass",
    "/bubble/jet_tip_z",
    "/bubble/jet_velocity",
    "/probes/wall/time",
    "/probes/wall/pressure",
    "/probes/wall/density",
    "/probes/wall/velocity_z",
    "/probes/wall/velocity_r",
    "/probes/wall/gas_fraction",
    "/probes/steel/time",
    "/probes/steel/velocity_z",
    "/probes/steel/velocity_r",
    "/probes/steel/stress_zz",
    "/probes/steel/stress_zr",
    "/probes/steel/stress_rr",
    "/probes/steel/stress_phiphi",
    "/solid/time",
    "/solid/von_mises_max",
    "/solid/von_mises_max_position",
    "/solid/yielded_volume",
    "/time_step",
    "/wall/pressure_axis",
];
const SOME_STEPS: [&str; 15] = [
    "/interface/time",
    "/interface/r",
    "/interface/pressure",
    "/interface/normal_velocity",
    "/interface/impulse",
    "/conservation/fluid/time",
    "/conservation/fluid/mass",
    "/conservation/fluid/energy",
    "/conservation/fluid/momentum_z",
    "/conservation/fluid/mass_in_z_min",
    "/conservation/fluid/interface_impulse",
    "/conservation/solid/time",
    "/conservation/solid/energy",
    "/conservation/solid/momentum_z",
    "/conservation/solid/momentum_in_z_max",
];

#[test]
fn a_run_leaves_all_that_is_promised() {
    let workshop = Workshop::new();
    for (out, flags) in [("one", &["--in-process"][..]), ("two", &[])] {
        let run = good_run(&workshop, &[&["run", "case.toml", "--out", out], flags].concat());
        assert!(run.stdout.is_empty(), "{}", text(&run));
        complete_directory(&workshop, out);
    }
    // The effective case runs as well as its source.
    let again = ["run", "one/case.toml", "--out", "again", "--in-process", "-q"];
    good_run(&workshop, &again);
    assert_eq!(
        fs::read(workshop.path("one/case.toml")).expect("a case"),
        fs::read(workshop.path("again/case.toml")).expect("a case")
    );
}

/// Of several bubbles each has its datasets, numbered from the wall; one alone has none.
#[test]
fn several_bubbles_are_told_apart() {
    let workshop = Workshop::new();
    let region = |z: f64, radius: f64| {
        format!(
            "{{ shape = \"sphere\", centre = [{z}, 0.0], radius = {radius}, phase = \"gas\", density = 1.2, \
             pressure = 1e5 }}"
        )
    };
    let regions = format!("fluid.region=[{}, {}]", region(0.008, 1e-3), region(0.004, 2e-3));
    for (out, set) in [("two", &regions[..]), ("one", "fluid.region.0.radius=2e-3")] {
        good_run(&workshop, &["run", "case.toml", "--out", out, "--in-process", "--set", set]);
    }
    let open = |out: &str| {
        hdf5::File::open(workshop.path(out).join("history.h5"))
            .unwrap_or_else(|error| panic!("{out}: {error}"))
    };
    assert!(!open("one").link_exists("bubbles"));
    let history = open("two");
    let read = |name: &str| {
        let values = history.dataset(name).and_then(|dataset| dataset.read_raw::<f64>());
        values.unwrap_or_else(|error| panic!("{name}: {error}"))
    };
    for (number, z, radius) in [(1, 0.004, 2e-3), (2, 0.008, 1e-3)] {
        let first = |what: &str| read(&format!("/bubbles/{number}/{what}"))[0];
        assert!((first("centroid_z") - z).abs() < 2e-4, "{number}");
        assert!((first("equivalent_radius") / radius - 1.0).abs() < 0.02, "{number}");
    }
    for what in ["volume", "gas_mass"] {
        let [whole, one, two] = ["bubble", "bubbles/1", "bubbles/2"].map(|of| read(&format!("/{of}/{what}")));
        assert_eq!(whole.len(), read("/time").len());
        for (row, whole) in whole.iter().enumerate() {
            assert!(((one[row] + two[row]) / whole - 1.0).abs() < 1e-12, "{what} in row {row}");
        }
    }
}

fn complete_directory(workshop: &Workshop, out: &str) {
    let directory = workshop.path(out);
    for name in
        ["fluid.vtkhdf", "solid.vtkhdf", "fluid.h5", "solid.h5", "history.h5", "summary.json", "case.toml"]
    {
        assert!(directory.join(name).is_file(), "{out} has no {name}");
    }

    let summary = summary(&directory);
    assert_eq!(summary["completed"], true);
    assert_eq!(summary["t_end"].as_f64(), Some(2e-6));
    let steps = summary["steps"].as_u64().expect("steps") as usize;
    assert!(steps > 3, "{summary}");
    for side in ["fluid", "solid"] {
        let cells = &summary["cells"][side];
        assert_eq!((&cells["final"], &cells["largest"]), (&256.into(), &256.into()));
        // The solid makes several steps in one of the fluid's.
        let least = if side == "fluid" { 256 * steps } else { 3 * 256 * steps };
        let updates = summary["cell_updates"][side].as_u64().expect("updates") as usize;
        assert!(
            updates >= least && updates.is_multiple_of(256) && (side == "solid" || updates == least),
            "{summary}"
        );
        assert!(summary["compute_seconds"][side].as_f64().is_some_and(|seconds| seconds > 0.0), "{summary}");
        assert_eq!(summary["compute_seconds"][side], summary["coupling"][side]["seconds_computing"]);
    }
    for key in [
        "wall_seconds",
        "wall_pressure_peak",
        "wall_pressure_peak_time",
        "wall_pressure_peak_interface",
        "wall_pressure_peak_anywhere",
        "von_mises_peak",
        "von_mises_peak_time",
    ] {
        assert!(summary[key].is_number(), "{key}: {summary}");
    }
    assert_eq!(summary["von_mises_peak_position"].as_array().map(Vec::len), Some(2));
    // So short a run has no collapse; the keys are there all the same.
    for key in ["collapse_time", "min_equivalent_radius"] {
        assert!(summary.get(key).is_some_and(serde_json::Value::is_null), "{key}: {summary}");
    }
    let masses = ["gas_mass_added", "liquid_mass_added"];
    let fixups = ["first_order", "floored", "floor_energy", "floored_stars"];
    for key in fixups.iter().chain(&masses).chain(&fluid::Clips::NAMES) {
        assert!(summary["fixups"][key].is_number(), "{key}: {summary}");
    }
    assert!(
        summary["coupling"]["exchange_wait_share"].as_f64().is_some_and(|share| share >= 0.0),
        "{summary}"
    );
    assert!(summary["coupling"]["exchanges"].as_u64() >= Some(steps as u64), "{summary}");
    for side in ["fluid", "solid"] {
        for key in ["seconds_waited", "seconds_computing", "seconds_recording"] {
            assert!(summary["coupling"][side][key].is_number(), "{side}.{key}: {summary}");
        }
    }

    let history = hdf5::File::open(directory.join("history.h5")).expect("the history opens");
    for name in EVERY_STEP.iter().chain(&SOME_STEPS) {
        let dataset = history.dataset(name).unwrap_or_else(|error| panic!("{out}: {name}: {error}"));
        let units = dataset.attr("units").unwrap_or_else(|error| panic!("{out}: units of {name}: {error}"));
        let units = units.read_scalar::<hdf5::types::VarLenUnicode>().expect("a text");
        assert!(!units.is_empty(), "{name}");
        let rows = dataset.shape()[0];
        if EVERY_STEP.contains(name) {
            // The solid has steps of its own, several in one of the fluid's.
            let is_solids = name.starts_with("/solid/") || name.starts_with("/probes/steel/");
            let is_right = if is_solids { rows > 3 * steps } else { rows == steps + 1 };
            assert!(is_right, "{out}: {name} has {rows} rows in {steps} steps");
        } else {
            assert!(rows > 1, "{out}: {name} has {rows} rows");
        }
    }
    let times = history.dataset("/time").and_then(|times| times.read_raw::<f64>()).expect("times");
    assert_eq!(times.first().copied(), Some(0.0));
    assert!((times[steps] - 2e-6).abs() <= 1e-12 * 2e-6, "the run ends where it should, to round-off");

    let load = |name: &str| {
        let path = if name.is_empty() { workshop.path("case.toml") } else { directory.join(name) };
        Case::load(&path, &[]).unwrap_or_else(|errors| panic!("{errors}"))
    };
    assert_eq!(load("case.toml").hash(), load("").hash());
    let hash: String = load("").hash().iter().map(|byte| format!("{byte:02x}")).collect();
    let attribute = history.attr("case_hash").expect("the hash").read_scalar::<hdf5::types::VarLenUnicode>();
    assert_eq!(attribute.expect("a text").as_str(), hash);

    for (name, fields) in [
        ("fluid.vtkhdf", &["density", "pressure", "velocity", "gas_fraction", "schlieren"][..]),
        (
            "solid.vtkhdf",
            &[
                "velocity",
                "stress_zz",
                "stress_zr",
                "stress_rr",
                "stress_phiphi",
                "von_mises",
                "yield_function",
            ],
        ),
    ] {
        let file = hdf5::File::open(directory.join(name)).expect("it opens");
        let times = file.dataset("/VTKHDF/Steps/Values").and_then(|values| values.read_raw::<f64>());
        // At the start, where the case asks for it, at the end.
        assert_eq!(times.expect("times").len(), 3, "{name}");
        for field in fields {
            let data = file.dataset(&format!("/VTKHDF/CellData/{field}")).expect("the field is there");
            assert_eq!(data.shape()[0], 3 * 256, "{name}: {field}");
        }
    }
}
