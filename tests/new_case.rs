//! `cav new`, and what `cav check` and `cav run` do with what it writes.

use std::path::Path;
use std::process::{Command, Output};

use cav::case::Case;
use cav::case::new::{Collapse, FreeBubble, LaserBubble, ShockedBubble, Wall, WallLoad};

fn cav(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_cav")).args(arguments).output().expect("cav starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Reads a case that must come without a warning.
fn read(written: &str) -> Case {
    let case = Case::from_toml(written, "new", &[]).unwrap_or_else(|errors| panic!("{errors}\n{written}"));
    assert!(case.warnings().is_empty(), "{:?}\n{written}", case.warnings());
    case
}

fn steel() -> solid::Material {
    solid::Material::by_name("structural-steel").expect("in the library")
}

#[test]
fn the_first_case_is_what_is_written_for_nothing_in_particular() {
    let shipped = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/collapse.toml"));
    let written = cav(&["new", "collapse"]);
    assert!(written.status.success());
    let shipped = shipped.expect("the first case");
    // Above it stands what the run is expected to give.
    assert!(shipped.ends_with(&text(&written.stdout)), "{shipped}");
    assert_eq!(Collapse::default().text().expect("a case"), text(&written.stdout));
}

/// What the bubble does to it at its smallest is a matter of fine cells.
#[test]
fn the_solid_below_a_laser_bubble_is_eight_times_as_coarse_as_the_fluid_at_its_finest() {
    for cells_per_radius in [8.0, 16.0, 40.0] {
        let wall = Wall::named("al-1100-o").expect("in the library");
        let bubble = LaserBubble { stand_off: Some(0.8), wall, cells_per_radius, ..LaserBubble::default() };
        let case = read(&bubble.text().expect("a case"));
        let [fluid, solid] =
            [case.fluid.as_ref().map(|side| &side.grid), case.solid.as_ref().map(|side| &side.grid)]
                .map(|grid| grid.expect("a side").cell_size()[0]);
        // The file has six digits.
        approx::assert_relative_eq!(solid, 8.0 * fluid, max_relative = 1e-5);
    }
}

#[test]
fn what_is_asked_is_in_the_case() {
    let written = cav(&[
        "new",
        "collapse",
        "--radius",
        "0.5mm",
        "--pressure",
        "10bar",
        "--stand-off",
        "1.2",
        "--wall",
        "steel",
        "--cells-per-radius",
        "25",
        "--gas-pressure",
        "5kPa",
    ]);
    let case = read(&text(&written.stdout));
    let (fluid, solid) = (case.fluid.as_ref().expect("a fluid"), case.solid.as_ref().expect("a solid"));
    assert_eq!(fluid.initial.ambient.pressure, 1e6);
    let region = fluid.initial.regions[0];
    assert_eq!(region.shape, fluid::Shape::Sphere { centre: [6e-4, 0.0], radius: 5e-4 });
    assert_eq!(region.state.pressure, 5e3);
    assert!((case.cells_per_radius().expect("a bubble") - 25.0).abs() < 1e-9);
    assert_eq!(solid.material.name(), "structural-steel");
    assert!(solid.plasticity.is_some());
    // Four radii of liquid beside the bubble, and time for the collapse at about 1.15 of Rayleigh's.
    assert!(fluid.grid.z[1] >= (1.2 + 4.0) * 5e-4 && fluid.grid.r[1] >= 5.0 * 5e-4);
    let rayleigh = 0.915 * 5e-4 * (1000.0_f64 / (1e6 - 5e3)).sqrt();
    assert!((1.3 * rayleigh..3.0 * rayleigh).contains(&case.time.end), "{}", case.time.end);
    // The command in its comment writes it again.
    let asked = text(&written.stdout);
    let command: String = asked
        .lines()
        .filter(|line| line.starts_with("#   "))
        .map(|line| line.trim_start_matches('#').trim_end_matches('\\'))
        .collect();
    let words: Vec<&str> = command.split_whitespace().skip(1).collect();
    assert_eq!(text(&cav(&words).stdout), asked, "{words:?}");
}

#[test]
fn every_kind_writes_cases_without_a_warning() {
    for stand_off in [0.0, 0.3, 1.0, 1.05, 1.5, 4.0, 30.0] {
        for wall in ["rigid", "steel", "pmma", "gelatine", "tungsten-carbide"] {
            for (radius, pressure, cells_per_radius) in
                [(1e-3, 1e5, 4.0), (1e-5, 5e7, 25.6), (0.2, 3e6, 100.0)]
            {
                let wall = Wall::named(wall).expect("a wall");
                let elastic = radius == 0.2;
                let asked = Collapse {
                    radius,
                    pressure,
                    stand_off,
                    wall: wall.clone(),
                    cells_per_radius,
                    elastic,
                    ..Collapse::default()
                };
                let case = read(&asked.text().expect("a case"));
                assert!((case.cells_per_radius().expect("a bubble") / cells_per_radius - 1.0).abs() < 1e-4);
                let shock = ShockedBubble {
                    radius,
                    pressure: 1e5,
                    amplitude: pressure,
                    stand_off,
                    wall,
                    cells_per_radius,
                };
                read(&shock.text().expect("a case"));
            }
        }
    }
    for (radius, equilibrium_radius, pressure, stand_off) in
        [(20e-6, 184.1e-6, 1e5, None), (50e-6, 0.3e-3, 1e6, Some(1.2)), (1e-5, 1e-4, 1e5, Some(0.3))]
    {
        for wall in ["rigid", "steel"].map(|wall| Wall::named(wall).expect("a wall")) {
            let asked = LaserBubble {
                radius,
                equilibrium_radius,
                left_radius: stand_off.map(|_| 0.4 * equilibrium_radius),
                pressure,
                stand_off,
                wall,
                ..LaserBubble::default()
            };
            let case = read(&asked.text().expect("a case"));
            let cells = case.cells_per_radius().expect("a bubble");
            assert!((16.0..32.1).contains(&cells), "{cells}");
            assert!(case.fluid.as_ref().is_some_and(|fluid| fluid.bubble.is_some()));
        }
    }
    for cells_per_radius in [4.0, 33.3, 200.0] {
        read(&FreeBubble { cells_per_radius, ..FreeBubble::default() }.text().expect("a case"));
        let load =
            WallLoad { amplitude: 1e9, radius: 5e-4, duration: 2e-7, material: steel(), cells_per_radius };
        let case = read(&load.text().expect("a case"));
        assert!(case.time.settles && case.time.snapshots.len() == 4, "{:?}", case.time);
    }
}

/// Church's pulse is in the case whatever the bubble's size, behind the front that its cells can bear.
#[test]
fn the_pulse_of_a_shock_has_its_impulse() {
    for radius in [50e-6, 300e-6, 1e-3, 5e-3] {
        let shock = ShockedBubble {
            radius,
            pressure: 1e5,
            amplitude: 35e6,
            stand_off: 2.0,
            wall: Wall::Rigid,
            cells_per_radius: 20.0,
        };
        let case: toml::Table = toml::from_str(&shock.text().expect("a case")).expect("TOML");
        let rows = case["fluid"]["inflow"]["pressure"].as_array().expect("rows");
        let number = |row: &toml::Value, k: usize| row[k].as_float().expect("a number");
        let rows: Vec<[f64; 2]> = rows.iter().map(|row| [number(row, 0), number(row, 1) - 1e5]).collect();
        let impulse = |rows: &[[f64; 2]]| -> f64 {
            rows.windows(2).map(|pair| 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0])).sum()
        };
        let (alpha, omega, third) = (9.1e5, 2.0 * std::f64::consts::PI * 83.3e3, std::f64::consts::FRAC_PI_3);
        let exact = |t: f64| {
            let part = |t: f64| {
                let phase = omega * t + third;
                2.0 * (-alpha * t).exp() * (omega * phase.sin() - alpha * phase.cos())
                    / (alpha * alpha + omega * omega)
            };
            35e6 * (part(t) - part(0.0))
        };
        let (got, wanted) = (impulse(&rows[1..]), exact(rows[rows.len() - 1][0] - rows[1][0]));
        // Of what it has before it turns to tension.
        assert!((got - wanted).abs() < 5e-3 * 35e6 * 0.385e-6, "{radius}: {got} for {wanted}");
        assert!((rows[1][1] - 35e6).abs() < 1e3, "it begins with the amplitude");
    }
}

#[test]
fn what_makes_no_case_is_named_with_what_is_allowed() {
    for (arguments, expected) in [
        (["collapse", "--stand-off", "-1"], "stand_off: must be from 0 to 1000, got -1.0"),
        (["collapse", "--radius", "0"], "radius: must be positive, got 0.0"),
        (["collapse", "--pressure", "20Pa"], "pressure: must be above the gas's 2340.0 Pa, got 20.0"),
        (["collapse", "--cells-per-radius", "3"], "cells_per_radius: must be from 4 to 2000, got 3.0"),
        (["collapse", "--wall", "stel"], "did you mean `steel`?"),
        (["collapse", "--radius", "1psi"], "give a number with m, cm, mm"),
        (["load", "--wall", "rigid"], "a rigid wall takes no load"),
        (["load", "--duration", "1mm"], "give a number with s, ms"),
        (
            ["laser", "--equilibrium-radius", "30um"],
            "equilibrium_radius: must be above twice the radius at the start, 20 µm, got 3e-5",
        ),
        (["laser", "--largest-radius", "-1mm"], "largest_radius: must be positive, got -0.001"),
        (["laser", "--left-radius", "1mm"], "left_radius: must be less than R_n, 184.1 µm, got 0.001"),
        (["free", "--cells-per-radius", "nan"], "cells_per_radius: must be from 4 to 2000"),
        (["shock", "--amplitude", "-1MPa"], "amplitude: must be positive"),
        // Not by an option of its own, but by what it leads to.
        (["laser", "--equilibrium-radius", "10cm"], "fluid.cells: the finest grid has"),
    ] {
        let joined = [arguments[1], arguments[2]].join("=");
        let refused = cav(&["new", arguments[0], &joined]);
        let said = text(&refused.stderr);
        assert_eq!(refused.status.code(), Some(2), "{said}");
        assert!(said.contains(expected), "{arguments:?}: {said}");
        assert!(refused.stdout.is_empty());
    }
}

#[test]
fn kinds_are_listed_and_cases_drawn() {
    let listed = text(&cav(&["new"]).stdout);
    for kind in ["cav new collapse", "cav new free", "cav new laser", "cav new shock", "cav new load"] {
        assert!(listed.contains(kind), "{listed}");
    }
    let directory = tempfile::tempdir().expect("a directory");
    let (case, picture) = (directory.path().join("mine.toml"), directory.path().join("mine.png"));
    std::fs::write(&case, cav(&["new", "free", "--cells-per-radius", "8"]).stdout).expect("a case");
    let checked = cav(&["check", &case.to_string_lossy(), "--png", &picture.to_string_lossy()]);
    assert!(text(&checked.stdout).contains("oooo") && text(&checked.stdout).contains("cells per radius"));
    assert!(std::fs::read(&picture).expect("a picture").starts_with(b"\x89PNG"));
    let nowhere = directory.path().join("no/mine.png");
    let refused = cav(&["check", &case.to_string_lossy(), "--png", &nowhere.to_string_lossy()]);
    assert_eq!(refused.status.code(), Some(5), "{}", text(&refused.stderr));
    let other = directory.path().join("mine.jpg");
    let refused = cav(&["check", &case.to_string_lossy(), "--png", &other.to_string_lossy()]);
    let told = text(&refused.stderr);
    assert!(refused.status.code() == Some(2) && told.contains("ends in .png") && !other.exists(), "{told}");
}

/// A small run with `--report`, where the path leads to no pycav, to one that works, and to one that fails.
#[test]
fn a_report_is_asked_of_pycav_where_it_is() {
    let directory = tempfile::tempdir().expect("a directory");
    let case = directory.path().join("mine.toml");
    std::fs::write(&case, cav(&["new", "free", "--cells-per-radius", "4"]).stdout).expect("a case");
    let run = |name: &str, script: Option<&str>| {
        let programs = directory.path().join(name);
        std::fs::create_dir(&programs).expect("a directory");
        if let Some(script) = script {
            use std::os::unix::fs::PermissionsExt;
            let pycav = programs.join("pycav");
            std::fs::write(&pycav, format!("#!/bin/sh\n{script}\n")).expect("a script");
            std::fs::set_permissions(&pycav, std::fs::Permissions::from_mode(0o755)).expect("permissions");
        }
        let out = programs.join("run");
        let ended = Command::new(env!("CARGO_BIN_EXE_cav"))
            .args(["run", "--report", "--set", "time.end=1e-6", "--set", "time.snapshots=[]", "--out"])
            .args([&out, &case])
            .env("PATH", &programs)
            .output()
            .expect("cav starts");
        assert!(out.join("summary.json").exists(), "{}", text(&ended.stderr));
        (ended.status.code(), text(&ended.stdout), text(&ended.stderr))
    };
    let (code, _, said) = run("none", None);
    assert_eq!(code, Some(0));
    assert!(said.contains("pycav is not there") && said.contains("pip install"), "{said}");
    let (code, printed, _) = run("works", Some("echo \"page of $1 $2\""));
    assert_eq!(code, Some(0));
    assert!(printed.contains("page of report") && printed.contains("works/run"), "{printed}");
    let (code, _, said) = run("fails", Some("exit 3"));
    assert_eq!(code, Some(5));
    assert!(said.contains("the run is complete, but not its report"), "{said}");
}
