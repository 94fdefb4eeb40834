//! `cav run --refine`: the case on finer and finer grids, and what its numbers come to.

#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant, SystemTime};

use cav::case::Case;
use rustix::process::{Pid, Signal, kill_process};
use serde_json::Value;

mod fixture;

use fixture::{sensor, small};

struct Workshop {
    directory: tempfile::TempDir,
}

impl Workshop {
    fn with(case: &str) -> Self {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join("case.toml"), case).unwrap();
        Self { directory }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut cav = Command::new(env!("CARGO_BIN_EXE_cav"));
        cav.args(["run", "case.toml", "--threads", "1"]).args(arguments);
        cav.current_dir(self.directory.path())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        cav
    }

    fn cav(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().unwrap()
    }

    /// When each grid's run was finished.
    fn stamps(&self, out: &str, grids: usize) -> Vec<SystemTime> {
        let stamp = |grid| fs::metadata(self.path(out).join(format!("grid-{grid}/history.h5"))).unwrap();
        (0..grids).map(|grid| stamp(grid).modified().unwrap()).collect()
    }
}

fn json(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

fn said(output: &Output) -> String {
    format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr))
}

/// A bubble above steel on 16 × 16 cells a side, with a sensor.
fn case() -> String {
    small("end = 3e-6\n", 2) + &sensor("disc", 0.004, 1e-7)
}

const THREE: [&str; 5] = ["--refine", "3", "--in-process", "--out", "study"];

#[test]
fn three_grids_leave_their_runs_their_numbers_and_a_table() {
    let workshop = Workshop::with(&case());
    let output = workshop.cav(&THREE);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let record = json(&workshop.path("study/convergence.json"));
    let summaries = [0, 1, 2].map(|grid| json(&workshop.path(&format!("study/grid-{grid}/summary.json"))));
    // Each run's answer says how sure it is by the study.
    for (number, summary) in summaries.iter().enumerate() {
        let told = summary["answer"].as_array().unwrap().last().unwrap().as_str().unwrap();
        assert!(
            told.contains(&format!("By grid {number} of 0 to 2 of a study: the mean wall pressure")),
            "{told}"
        );
        assert!(summary["look_next"].as_str().unwrap().starts_with("Look next: "));
    }
    for (number, grid) in record["grids"].as_array().unwrap().iter().enumerate() {
        let cells = 3.2 * f64::from(1 << number);
        assert_eq!(grid["levels"], serde_json::json!({ "fluid": 2 + number, "solid": 2 + number }));
        assert!((grid["cells_per_radius"].as_f64().unwrap() - cells).abs() < 1e-12);
        assert_eq!(grid["cells_per_radius"], summaries[number]["cells_per_radius"]);
        let text = fs::read_to_string(workshop.path(&format!("study/grid-{number}/case.toml"))).unwrap();
        let case = Case::from_toml(&text, "case", &[]).unwrap();
        assert_eq!(case.fluid.unwrap().grid.finest(), [16 << number; 2]);
    }
    let names = [
        "wall_pressure_mean_peak",
        "wall_impulse",
        "jet_velocity_peak",
        "von_mises_peak",
        "sensors.disc.impulse",
    ];
    for name in names {
        let number = &record["numbers"][name];
        for (grid, summary) in summaries.iter().enumerate() {
            let found = name.split('.').fold(summary, |value, key| &value[key]);
            assert!(found.is_number() && number["values"][grid] == *found, "{name}: {number}");
        }
        assert_eq!(number["grids"], serde_json::json!([0, 1, 2]));
        let has_order = number["convergence"] == "monotone";
        assert_eq!(
            [number["order"].is_number(), number["gci"].is_number()],
            [has_order; 2],
            "{name}: {number}"
        );
    }
    // Some number of this case has an order, and its index is what the formula says.
    let mean = &record["numbers"]["wall_pressure_mean_peak"];
    let values: Vec<f64> = mean["values"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    let order = ((values[1] - values[0]) / (values[2] - values[1])).log2();
    assert!((mean["order"].as_f64().unwrap() / order - 1.0).abs() < 1e-12, "{mean}");
    let used = order.clamp(0.5, 2.0);
    let index = 1.25 * ((values[2] - values[1]) / values[2]).abs() / (2.0_f64.powf(used) - 1.0);
    assert!((mean["gci"].as_f64().unwrap() / index - 1.0).abs() < 1e-12, "{mean}");
    let table = String::from_utf8(output.stdout).unwrap();
    for part in ["R/h = 3.2", "R/h = 12.8", "wall_impulse", "Pa s", "order", "GCI", "safety factor 1.25"] {
        assert!(table.contains(part), "{table}");
    }

    what_is_complete_is_kept(&workshop);
}

/// The same study again, one with a grid that is missing, and one of another case.
fn what_is_complete_is_kept(workshop: &Workshop) {
    let stamps = workshop.stamps("study", 3);
    let record = fs::read(workshop.path("study/convergence.json")).unwrap();
    let again = workshop.cav(&THREE);
    assert_eq!(
        (again.status.code(), workshop.stamps("study", 3)),
        (Some(0), stamps.clone()),
        "{}",
        said(&again)
    );
    assert_eq!(fs::read(workshop.path("study/convergence.json")).unwrap(), record);
    fs::remove_dir_all(workshop.path("study/grid-1")).unwrap();
    let quiet = workshop.cav(&[&THREE[..], &["-q"]].concat());
    assert_eq!((quiet.status.code(), said(&quiet)), (Some(0), String::new()));
    let now = workshop.stamps("study", 3);
    assert_eq!([now[0] == stamps[0], now[1] == stamps[1], now[2] == stamps[2]], [true, false, true]);
    // What counts is all of the case, what is written of it included.
    for set in ["time.cfl=0.4", "output.mean_time=1e-7"] {
        let other = workshop.cav(&[&THREE[..], &["--set", set]].concat());
        assert_eq!(other.status.code(), Some(2));
        for part in
            ["study/grid-2 holds a finished run", "--force", "grid 2 (fluid.levels = 4, solid.levels = 4)"]
        {
            assert!(said(&other).contains(part), "no {part} in {}", said(&other));
        }
        assert_eq!(workshop.stamps("study", 3), now);
    }
    let forced = workshop.cav(&[
        "--refine",
        "2",
        "--in-process",
        "--out",
        "study",
        "--force",
        "--set",
        "time.cfl=0.4",
    ]);
    assert_eq!(forced.status.code(), Some(0), "{}", said(&forced));
    let two = json(&workshop.path("study/convergence.json"));
    let mean = &two["numbers"]["wall_pressure_mean_peak"];
    assert_eq!([&mean["convergence"], &mean["order"]], [&Value::from("two-grids"), &Value::Null]);
    assert_eq!([&mean["order_used"], &mean["safety_factor"]], [2.0, 3.0].map(Value::from).each_ref());
    assert!(said(&forced).contains("order 2 assumed"), "{}", said(&forced));
}

#[test]
fn what_cannot_be_done_is_refused_before_anything_is_made() {
    let workshop = Workshop::with(&case());
    let large = ["fluid.adapt=false", "fluid.levels=0", "fluid.cells=[2048, 2048]"];
    let large: Vec<&str> = large.iter().flat_map(|set| ["--set", set]).collect();
    for (arguments, parts) in [
        (vec!["--refine", "1"], vec!["--refine", "2..=5"]),
        (vec!["--refine", "6"], vec!["--refine", "2..=5"]),
        (vec!["--refine", "two"], vec!["--refine"]),
        (
            [&["--refine", "5"], &large[..]].concat(),
            vec!["grid 4 (fluid.levels = 4, ", "32768 x 32768 cells", "are available"],
        ),
        (
            vec!["--refine", "3", "--set", "solid.levels=18"],
            vec!["grid 1", "solid.cells", "take fewer cells or levels"],
        ),
        (vec!["--refine", "3", "--set", "fluid.levls=2"], vec!["fluid.levls", "did you mean `levels`?"]),
    ] {
        let output = workshop.cav(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", said(&output));
        for part in parts {
            assert!(said(&output).contains(part), "no {part} in {}", said(&output));
        }
        assert!(!workshop.path("runs").exists(), "{arguments:?}");
    }
    let both = Command::new(env!("CARGO_BIN_EXE_cav"))
        .args(["run", "--resume", "x", "--refine", "3"])
        .output()
        .unwrap();
    assert_eq!(both.status.code(), Some(2));
    assert!(said(&both).contains("cannot be used with"), "{}", said(&both));
    // A run's own directory is none of a study.
    fs::create_dir(workshop.path("own")).unwrap();
    fs::write(workshop.path("own/summary.json"), "{\"completed\": true}").unwrap();
    let own = workshop.cav(&["--refine", "2", "--out", "own"]);
    assert_eq!(own.status.code(), Some(2));
    assert!(said(&own).contains("own is the directory of a run"), "{}", said(&own));
}

#[test]
fn a_grid_that_fails_leaves_the_numbers_of_the_others() {
    let workshop = Workshop::with(&case());
    fs::create_dir_all(workshop.path("study/grid-1")).unwrap();
    fs::write(workshop.path("study/grid-1/notes.txt"), "mine").unwrap();
    let output = workshop.cav(&THREE);
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(said(&output).contains("grid 1 (fluid.levels = 3, solid.levels = 3)"), "{}", said(&output));
    let record = json(&workshop.path("study/convergence.json"));
    let ends: Vec<_> =
        record["grids"].as_array().unwrap().iter().map(|grid| grid["completed"] == true).collect();
    assert_eq!(ends, [true, false, true]);
    assert!(
        record["grids"][1]["error"].as_str().is_some_and(|error| error.contains("notes.txt")),
        "{record}"
    );
    let peak = &record["numbers"]["von_mises_peak"];
    let there: Vec<_> = peak["values"].as_array().unwrap().iter().map(Value::is_number).collect();
    assert_eq!((there, &peak["convergence"]), (vec![true, false, true], &Value::from("two-grids")));
}

#[test]
fn an_interrupted_study_keeps_what_is_complete_and_goes_on() {
    let text = small("end = 2e-5\n", 3);
    let workshop = Workshop::with(&text);
    let arguments = ["--refine", "2", "--in-process", "--out", "study", "--checkpoint-every", "0.2"];
    let child = workshop.command(&arguments).spawn().unwrap();
    let begin = Instant::now();
    // A checkpoint has a part of each side.
    let parts = |directory: PathBuf| {
        let names = fs::read_dir(directory).into_iter().flatten().flatten().map(|entry| entry.file_name());
        names.filter(|name| name.to_string_lossy().ends_with(".ckpt")).count()
    };
    while parts(workshop.path("study/grid-1/checkpoints")) < 2 {
        assert!(begin.elapsed() < Duration::from_secs(60), "the second grid is not begun");
        std::thread::sleep(Duration::from_millis(2));
    }
    kill_process(Pid::from_raw(child.id() as i32).unwrap(), Signal::INT).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", said(&output));
    let completed =
        |grid: usize| json(&workshop.path(&format!("study/grid-{grid}/summary.json")))["completed"] == true;
    assert_eq!([completed(0), completed(1)], [true, false]);
    assert_eq!(json(&workshop.path("study/convergence.json"))["grids"][0]["completed"], true);
    let first = workshop.stamps("study", 1);
    let log = workshop.path("study/grid-1/log");
    let again = workshop.cav(&arguments);
    assert_eq!(again.status.code(), Some(0), "{}", said(&again));
    assert_eq!(workshop.stamps("study", 1), first);
    assert!(completed(1) && fs::read_to_string(log).unwrap().contains("going on from the checkpoint"));
}

#[test]
fn the_mean_and_the_impulse_of_the_wall_pressure_need_no_history() {
    let workshop = Workshop::with(&small("end = 4e-6\n", 3));
    let run = |out: &str, sets: &[&str]| {
        let sets: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
        let output = workshop.cav(&[&["--in-process", "-q", "--out", out], &sets[..]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", said(&output));
        json(&workshop.path(out).join("summary.json"))
    };
    let [often, seldom] = [("often", "1e-8"), ("seldom", "4e-6")]
        .map(|(out, every)| run(out, &[&format!("output.interface_every={every}")]));
    let keys = [
        "wall_pressure_mean_time",
        "wall_pressure_mean_peak",
        "wall_pressure_mean_peak_time",
        "wall_impulse",
        "wall_impulse_time",
    ];
    for key in keys {
        assert!(often[key].is_number() && often[key] == seldom[key], "{key}: {} {}", often[key], seldom[key]);
    }
    // R/(12 c) of 2 mm in water of 1 MPa.
    let sound = (7.15 * (1e6 + 3e8) / 1000.0_f64).sqrt();
    assert!(
        (often["wall_pressure_mean_time"].as_f64().unwrap() / (0.002 / (12.0 * sound)) - 1.0).abs() < 1e-12
    );
    // What the history has at its rows is no more than the largest of all steps.
    let impulse = hdf5::File::open(workshop.path("often/history.h5")).unwrap();
    let impulse = impulse.dataset("interface/impulse").unwrap().read_2d::<f64>().unwrap();
    let largest = impulse.column(0).iter().copied().fold(0.0, f64::max);
    let whole = often["wall_impulse"].as_f64().unwrap();
    assert!(whole >= largest && whole <= 1.001 * largest && whole > 0.0, "{whole} {largest}");
    // The mean over less than a step is the peak of p*, as far as that is not of t = 0; the longer, the lower.
    let number = |summary: &Value, key: &str| summary[key].as_f64().unwrap();
    let short = run("short", &["output.mean_time=1e-15"]);
    assert_eq!(short["wall_pressure_mean_peak"], short["wall_pressure_peak_interface"]);
    let long = run("long", &["output.mean_time=2e-6"]);
    let [least, middle, most] =
        [&long, &often, &short].map(|summary| number(summary, "wall_pressure_mean_peak"));
    assert!(least < middle && middle <= most, "{least} {middle} {most}");
}
