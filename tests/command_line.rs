//! The built binary: bad input ends with exit code 2, the key and the remedy; good input leaves all that is promised.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

mod fixture;
#[path = "command_line/left.rs"]
mod left;
#[path = "command_line/shown.rs"]
mod shown;

use fixture::{probe, small};
use left::summary;

/// A tiny coupled case that is right, 16 × 16 cells a side.
fn good() -> String {
    small("end = 2e-6\nsnapshots = [1e-6]\n", 2) + &probe("steel", [-0.002, 0.001], "solid")
}

/// A bad input must be refused before anything is computed; this is far above a process's start.
const AT_ONCE: Duration = Duration::from_secs(2);

struct Workshop {
    directory: tempfile::TempDir,
}

impl Workshop {
    fn new() -> Self {
        let workshop = Self { directory: tempfile::tempdir().expect("a temporary directory") };
        workshop.write("case.toml", good());
        workshop
    }

    fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).expect("the file is written");
    }

    /// `cav ARGUMENTS` in the workshop.
    fn cav(&self, arguments: &[&str]) -> Output {
        let mut cav = Command::new(env!("CARGO_BIN_EXE_cav"));
        cav.args(arguments).current_dir(self.directory.path()).stdin(Stdio::null());
        cav.output().expect("cav starts")
    }

    /// The names of all that lies in the workshop.
    fn content(&self) -> Vec<String> {
        let entries = fs::read_dir(self.directory.path()).expect("the workshop is listed").flatten();
        let mut names: Vec<_> =
            entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }
}

fn text(output: &Output) -> String {
    format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr))
}

fn good_run(workshop: &Workshop, arguments: &[&str]) -> Output {
    let output = workshop.cav(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", text(&output));
    output
}

/// What is done to the good case.
enum Edit {
    /// This text in place of this.
    Replace(&'static str, &'static str),
    /// This text behind it.
    Append(&'static str),
    /// These arguments behind `cav run case.toml`.
    With(&'static [&'static str]),
    /// These arguments instead of them.
    Instead(&'static [&'static str]),
}
use Edit::{Append, Instead, Replace, With};

/// More cells than any machine holds.
const LARGE: &[&str] =
    &["--set", "fluid.levels=0", "--set", "fluid.cells=[1048576, 1048576]", "--set", "fluid.adapt=false"];

/// Edit, then what standard error must have in it: the key or the path, and the remedy.
#[rustfmt::skip]
const BAD: &[(Edit, &[&str])] = &[
    // The file.
    (Instead(&["run", "absent.toml"]), &["absent.toml", "check the path", "cases/"]),
    (Instead(&["run", "folder"]), &["folder", "give the TOML file in it"]),
    (Instead(&["run", "latin.toml"]), &["latin.toml", "UTF-8"]),
    (Instead(&["check", "absent.toml"]), &["absent.toml", "check the path"]),
    (Instead(&["fluid", "absent.toml", "--run", "a"]), &["absent.toml", "check the path"]),
    (Replace("[time]", "[time"), &["not TOML", "https://toml.io"]),
    // What would never end, and what no machine holds; refused before anything is made, by each of the sides, too.
    (With(&["--end", "5us"]), &["'[CASE]' cannot be used with '--end <TIME>'"]),
    (With(&["--set", "output.interface_every=1e-30"]), &["output.interface_every", "1e6 rows", "s or more"]),
    (With(&["--set", "coupling.connect_timeout=1e20", "--set", "coupling.patience=1e-9"]), &["coupling.connect_timeout", "coupling.patience", "from 0.001 to 1e9"]),
    (With(&["--set", "time.end=1e30"]), &["time.end", "more than 1e9", "end earlier"]),
    (With(&["--set", "time.cfl=1e-30"]), &["time.end", "time.cfl", "more than 1e9", "larger time.cfl"]),
    (With(&["--set", "fluid.liquid.pi=1e60"]), &["time.end", "more than 1e9", "fluid.ambient", "look at"]),
    (With(LARGE), &["fluid.levels", "1048576 x 1048576 cells", "are available", "fluid.adapt", "cav check"]),
    (Instead(&["fluid", "case.toml", "--run", "a", "--set", LARGE[1], "--set", LARGE[3], "--set", LARGE[5]]), &["fluid.levels", "are available", "cav check"]),
    (With(&["--in-process", "--set", "solid.levels=0", "--set", "solid.cells=[1048576, 1048576]"]), &["solid.levels", "are available", "lower solid.levels"]),
    // Keys and types.
    (Replace("levels = 2", "level = 2"), &["fluid.level", "unknown key", "did you mean `levels`?"]),
    (Append("[outputs]\n"), &["unknown key `outputs`", "did you mean `output`?"]),
    (Replace("end = 2e-6", "end = \"2e-6\""), &["time.end", "must be a number", "without quotes"]),
    (Replace("levels = 2", "levels = 2.5"), &["fluid.levels", "whole number"]),
    (Replace("end = 2e-6", ""), &["time.end", "is missing", "in s"]),
    // Numbers that make no sense.
    (Replace("radius = 0.002", "radius = -0.002"), &["fluid.region.0.radius", "must be positive", "in m"]),
    (Replace("end = 2e-6\nsnapshots = [1e-6]", "end = 0"), &["time.end", "must be positive", "in s"]),
    (Replace("snapshots = [1e-6]", "snapshots = [3e-6]"), &["time.snapshots", "3e-6", "make `end` later"]),
    (Replace("snapshots = [1e-6]", "cfl = 1.5"), &["time.cfl", "(0, 0.9]", "0.45"]),
    (Replace("cells = [4, 4]", "cells = [0, 4]"), &["fluid.cells", "from 1 to"]),
    (Replace("cells = [4, 4]", "cells = [5, 4]"), &["fluid.cells", "no whole number of blocks", "nearest", "cells = [4, 4]"]),
    // Where things are.
    (Replace("centre = [0.004, 0.0]", "centre = [0.04, 0.0]"), &["fluid.region.0.centre", "outside the fluid", "z = 0.0 to 0.01 m"]),
    (Replace("z = [-0.01, 0.0]", "z = [-0.01, -0.001]"), &["solid.z", "do not meet", "end the solid where the fluid begins"]),
    (Append("[[fluid.region]]\nshape = \"box\"\nz = [0.02, 0.03]\nr = [0.0, 0.01]\nphase = \"gas\"\ndensity = 1\npressure = 1e5"), &["fluid.region.1.z", "outside the fluid", "z = 0.0 to 0.01 m"]),
    (Replace("position = [0.0, 0.0]", "position = [0.0, 0.02]"), &["probe.0.position", "outside the fluid", "r = 0.0 to 0.01 m"]),
    (Replace("name = \"steel\"", "name = \"wall\""), &["probe.1.name", "another probe is called `wall`"]),
    // Equations of state.
    (Replace("gamma = 7.15", "gamma = 1.0"), &["fluid.liquid.gamma", "greater than 1", "7.15 for water"]),
    (Replace("pi = 3e8", "pi = -1.0"), &["fluid.liquid.pi", "must not be negative", "3e8 Pa"]),
    (Replace("density = 1.2", "density = 0.0"), &["fluid.region.0.density", "must be positive", "kg/m3"]),
    (Replace("pressure = 1e6", "pressure = -3e8"), &["fluid.ambient.pressure", "p + pi > 0", "give a pressure above"]),
    // Materials.
    (Replace("\"structural-steel\"", "\"alumnium\""), &["solid.material", "unknown material", "did you mean `aluminium`?"]),
    (Append("[solid.material]\ndensity = 7800\nc1 = 5990\nc2 = 3458"), &["material"]),
    (Replace("\"structural-steel\"", "{ density = 7800, c1 = 5990, c2 = 3458, young = 2e11, poisson = 0.3 }"), &["solid.material", "exactly one pair"]),
    // Choices by name.
    (Replace("scheme = \"riemann\"", "scheme = \"monolithic\""), &["coupling.scheme", "`monolithic`", "`riemann`", "`strong`"]),
    (Replace("[fluid.liquid]", "riemann = \"roe\"\n[fluid.liquid]"), &["fluid.riemann", "`roe`", "`hllc`"]),
    (Replace("[fluid.liquid]", "model = \"baer-nunziato\"\n[fluid.liquid]"), &["fluid.model", "`baer-nunziato`", "`saurel-abgrall`"]),
    (Replace("[fluid.liquid]", "limiter = \"minmood\"\n[fluid.liquid]"), &["fluid.limiter", "did you mean `minmod`?"]),
    (Replace("scheme = \"riemann\"", "kappa = \"jump\""), &["coupling.kappa", "scheme = \"weak\""]),
    // Boundaries.
    (Append("[fluid.boundary]\nz_max = \"inflow\""), &["fluid.inflow", "pressure history is missing", "[fluid.inflow]"]),
    (Append("[fluid.boundary]\nz_max = \"periodic\""), &["fluid.boundary.z_max", "periodic", "both sides"]),
    // Changes.
    (With(&["--set", "time.end"]), &["--set time.end", "KEY=VALUE"]),
    (With(&["--set", "fluid.limitter=mc"]), &["fluid.limitter", "did you mean `limiter`?"]),
    (With(&["--set", "fluid.region.3.radius=1e-3"]), &["fluid.region.3.radius", "no element `3`", "number 0"]),
    (With(&["--set", "fluid.region.0.radius=-1"]), &["fluid.region.0.radius", "must be positive"]),
    // The run directory.
    (With(&["--out", "case.toml/run"]), &["case.toml/run", "choose another directory with --out"]),
    (With(&["--out", "case.toml"]), &["case.toml", "choose another directory with --out"]),
    (With(&["--out", "/proc/cav-run"]), &["/proc/cav-run", "choose another directory with --out"]),
    (With(&["--out", "folder"]), &["folder", "notes.txt", "choose an empty or new directory with --out"]),
    (Append("[output]\ndirectory = \"folder\""), &["folder", "choose an empty or new directory with --out"]),
    // The command line itself.
    (Instead(&["fluid", "case.toml", "--run", "a b/c"]), &["a b/c", "give 1 to 64 of the characters"]),
    (Instead(&["solid", "case.toml", "--run", ""]), &["run id", "give 1 to 64 of the characters"]),
    (Instead(&["fluid", "case.toml", "--run", "a", "--set", "coupling.scheme=rigid"]), &["coupling.scheme", "no peer", "use `cav run`"]),
    (Instead(&["fluid", "case.toml"]), &["--run"]),
    (With(&["--threads", "0"]), &["--threads", "0 is not in 1.."]),
    (With(&["--in-proces"]), &["--in-proces", "--in-process"]),
    (With(&["--quiet", "--verbose"]), &["--quiet", "--verbose"]),
    (Instead(&["rum", "case.toml"]), &["rum", "run"]),
    (Instead(&["run"]), &["<CASE>"]),
];

#[test]
fn bad_input_ends_with_code_2_the_key_and_the_remedy() {
    assert!(BAD.len() >= 30);
    let workshop = Workshop::new();
    fs::create_dir(workshop.path("folder")).expect("a folder");
    workshop.write("folder/notes.txt", "mine");
    workshop.write("latin.toml", b"# gr\xfc\xdfe\n");
    let before = workshop.content();
    let mut wrong = String::new();
    let good = good();
    for (number, (edit, fragments)) in BAD.iter().enumerate() {
        let case = match edit {
            Replace(from, to) => {
                assert!(good.contains(from), "the good case has no `{from}`");
                good.replacen(from, to, 1)
            }
            Append(more) => format!("{good}\n{more}\n"),
            With(_) | Instead(_) => good.clone(),
        };
        workshop.write("case.toml", case);
        let arguments = match edit {
            With(more) => [&["run", "case.toml"], *more].concat(),
            Instead(all) => all.to_vec(),
            Replace(..) | Append(_) => vec!["run", "case.toml"],
        };
        let begin = Instant::now();
        let output = workshop.cav(&arguments);
        let (took, said) = (begin.elapsed(), String::from_utf8_lossy(&output.stderr).into_owned());
        let mut complain = |what: String| wrong += &format!("row {number} {arguments:?}: {what}\n{said}\n");
        if output.status.code() != Some(2) {
            complain(format!("ended with {:?}", output.status));
        }
        for fragment in fragments.iter().filter(|fragment| !said.contains(**fragment)) {
            complain(format!("does not say `{fragment}`"));
        }
        if took > AT_ONCE {
            complain(format!("took {took:?}"));
        }
        if !output.stdout.is_empty() {
            complain("errors belong on standard error".to_owned());
        }
        if workshop.content() != before {
            complain(format!("left something behind: {:?}", workshop.content()));
            let _ = fs::remove_dir_all(workshop.path("runs"));
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    assert_eq!(fs::read_to_string(workshop.path("folder/notes.txt")).expect("still there"), "mine");
}

#[test]
fn a_finished_run_is_replaced_only_by_force() {
    let workshop = Workshop::new();
    let run = ["run", "case.toml", "--in-process", "--out", "out", "-q"];
    good_run(&workshop, &run);
    workshop.write("out/thoughts.txt", "mine");
    let history = fs::read(workshop.path("out/history.h5")).expect("a history");
    let output = workshop.cav(&run);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output));
    for fragment in ["out holds a finished run", "--out", "--force"] {
        assert!(text(&output).contains(fragment), "{}", text(&output));
    }
    assert!(fs::read(workshop.path("out/history.h5")).expect("still there") == history);
    good_run(&workshop, &[&run[..], &["--force", "--set", "time.end=1.5e-6"]].concat());
    assert_eq!(summary(&workshop.path("out"))["t_end"].as_f64(), Some(1.5e-6));
    assert_eq!(fs::read_to_string(workshop.path("out/thoughts.txt")).expect("kept"), "mine");
    assert_eq!(workshop.content(), ["case.toml", "out"]);
}

#[test]
fn without_arguments_it_says_what_to_type_next() {
    let workshop = Workshop::new();
    let said = text(&good_run(&workshop, &[]));
    for fragment in
        ["What to type next", "run cases/collapse.toml", "cav new", "check", "materials", "--help"]
    {
        assert!(said.contains(fragment), "{said}");
    }
    for flag in ["--help", "--version"] {
        assert!(text(&good_run(&workshop, &[flag])).contains("cav"));
    }
}

#[test]
fn check_says_what_a_run_would_cost_and_leaves_nothing() {
    let workshop = Workshop::new();
    let said = text(&good_run(&workshop, &["check", "case.toml"]));
    for fragment in [
        "16 x 16 = 256 cells",
        "MiB",
        "time step",
        "Rayleigh collapse time",
        "impedance",
        "reflection coefficient",
        "run time",
        "hash",
    ] {
        assert!(said.contains(fragment), "no `{fragment}` in\n{said}");
    }
    let finer = ["check", "case.toml", "--set", "fluid.levels=4", "--set"];
    let uniform = text(&good_run(&workshop, &[finer.as_slice(), &["fluid.adapt=false"]].concat()));
    assert!(uniform.contains("64 x 64 = 4096 cells"), "{uniform}");
    let adaptive = text(&good_run(&workshop, &[finer.as_slice(), &["fluid.epsilon=0.01"]].concat()));
    for fragment in ["level 2 to 4: 16 x 16 to 64 x 64 cells", "thresholds", "if all cells were", "guess"] {
        assert!(adaptive.contains(fragment), "no `{fragment}` in\n{adaptive}");
    }
    assert_eq!(workshop.content(), ["case.toml"]);
}

#[test]
fn materials_are_listed_with_yield_strength_and_source() {
    let said = text(&good_run(&Workshop::new(), &["materials"]));
    for material in solid::Material::library() {
        let row = said.lines().find(|row| row.starts_with(&format!("{} ", material.name())));
        let row = row.unwrap_or_else(|| panic!("no {} in\n{said}", material.name()));
        let strength = material.yield_strength().map_or(" - ".to_owned(), |y| format!(" {:.0} ", y / 1e6));
        assert!(row.contains(&strength), "no `{strength}` in {row}");
        assert!(row.contains(material.source()), "no source in {row}");
    }
    for name in ["structural-steel", "stainless-steel", "aluminium", "copper", "pmma"] {
        assert!(said.contains(name), "{said}");
    }
}

#[test]
fn one_medium_runs_alone() {
    let workshop = Workshop::new();
    let good = good();
    let (fluid, solid) = good.split_once("[solid]").expect("both media");
    let coupling = solid.find("[coupling]").expect("the coupling follows");
    let (head, _) = fluid.split_once("[fluid]").expect("a head");
    let none = "[coupling]\nscheme = \"none\"\n";
    workshop.write("fluid.toml", format!("{fluid}{none}"));
    workshop.write("solid.toml", format!("{head}[solid]{}{none}", &solid[..coupling]));
    for (out, case, more, present) in [
        (
            "rigid",
            "case.toml",
            &["--set", "coupling.scheme=rigid"][..],
            ["wall_pressure_peak", "wall_pressure_peak"],
        ),
        ("fluid", "fluid.toml", &[], ["jet_velocity_peak", "final_equivalent_radius"]),
        ("solid", "solid.toml", &[], ["von_mises_peak", "von_mises_peak_time"]),
    ] {
        let output = good_run(&workshop, &[&["run", case, "--out", out], more].concat());
        let summary = summary(&workshop.path(out));
        assert_eq!(summary["completed"], true, "{out}: {}", text(&output));
        for key in present {
            assert!(summary[key].is_number(), "{out}: {key}: {summary}");
        }
        let sides = ["fluid.vtkhdf", "solid.vtkhdf"].map(|name| workshop.path(out).join(name).exists());
        assert_eq!(sides, [out != "solid", out == "solid"], "{out}");
        let history = hdf5::File::open(workshop.path(out).join("history.h5")).expect("the history opens");
        let times = history.dataset("/time").and_then(|times| times.read_raw::<f64>()).expect("times");
        assert_eq!(times.len() as u64, summary["steps"].as_u64().expect("steps") + 1, "{out}");
    }
}

#[test]
fn progress_is_plain_where_nobody_watches_and_absent_when_quiet() {
    let workshop = Workshop::new();
    let run = good_run(&workshop, &["run", "case.toml", "--out", "plain"]);
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(!said.contains(['\u{1b}', '\r']), "{said:?}");
    let progress = said.lines().find(|line| line.contains(" %  t = ")).unwrap_or_else(|| panic!("{said}"));
    for fragment in ["step", "Δt = ", "(fluid)", "512 cells", "left"] {
        assert!(progress.contains(fragment), "{progress}");
    }
    assert!(said.contains("done: "), "{said}");
    let quiet = good_run(&workshop, &["run", "case.toml", "--out", "quiet", "-q"]);
    assert_eq!(text(&quiet), "");
}
