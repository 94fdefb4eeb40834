//! The rules on who may depend on whom, and on what no file may hold.
//!
//! A rule that is broken for a good reason is changed here, in the same commit, with the reason.

#![allow(clippy::unwrap_used)]

#[path = "architecture/circles.rs"]
mod circles;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// Packages of this workspace, and those of them that each may depend on.
const EDGES: [(&str, &[&str]); 6] = [
    ("mesh", &[]),
    ("coupler", &[]),
    ("fluid", &["mesh", "coupler"]),
    ("solid", &["mesh", "coupler"]),
    ("cav", &["mesh", "coupler", "fluid", "solid"]),
    ("pycav", &["cav", "mesh", "coupler", "fluid", "solid"]),
];

/// External packages that only one of ours may name.
const RESERVED: [(&str, &str); 8] = [
    ("iceoryx2", "coupler"),
    ("hdf5-metno", "cav"),
    ("hdf5", "cav"),
    ("clap", "cav"),
    ("ratatui", "cav"),
    ("rusqlite", "cav"),
    ("pyo3", "pycav"),
    ("numpy", "pycav"),
];

/// The only files of the solvers that know of the coupler.
const MEET_COUPLER: [&str; 3] =
    ["boundary/participant.rs", "boundary/mod.rs", "thermodynamics/wave_curve.rs"];

/// More lines than this and a file is several files.
const LONGEST_FILE: usize = 400;

/// Kinds of files that people write.
const WRITTEN: [&str; 7] = ["rs", "toml", "md", "py", "sh", "yml", "pyi"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn metadata() -> Value {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let output = Command::new(cargo)
        .args(["metadata", "--format-version", "1", "--no-deps", "--offline"])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// What is wrong with the dependencies of a workspace, one sentence each.
fn wrong_edges(metadata: &Value) -> Vec<String> {
    let mut wrong = Vec::new();
    for package in metadata["packages"].as_array().unwrap() {
        let name = package["name"].as_str().unwrap();
        let Some((_, allowed)) = EDGES.iter().find(|(ours, _)| *ours == name) else {
            wrong.push(format!("{name} is not in the list of crates"));
            continue;
        };
        for dependency in package["dependencies"].as_array().unwrap() {
            let needs = dependency["name"].as_str().unwrap();
            let kind = dependency["kind"].as_str().unwrap_or("normal");
            let is_ours = EDGES.iter().any(|(ours, _)| *ours == needs);
            if is_ours && !allowed.contains(&needs) {
                wrong.push(format!("{name} must not depend on {needs} ({kind})"));
            }
            if let Some((_, owner)) = RESERVED.iter().find(|(external, _)| *external == needs)
                && *owner != name
            {
                wrong.push(format!("{name} must not depend on {needs} ({kind}): only {owner} may"));
            }
        }
    }
    wrong
}

#[test]
fn dependencies_go_one_way() {
    let wrong = wrong_edges(&metadata());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_wrong_dependency_would_be_seen() {
    let package = |name: &str, needs: &str| {
        let dependencies = serde_json::json!([{ "name": needs, "kind": null }]);
        serde_json::json!({ "packages": [{ "name": name, "dependencies": dependencies }] })
    };
    for (name, needs) in [
        ("mesh", "coupler"),
        ("coupler", "mesh"),
        ("fluid", "solid"),
        ("solid", "fluid"),
        ("solid", "cav"),
        ("fluid", "iceoryx2"),
        ("cav", "iceoryx2"),
        ("solid", "hdf5-metno"),
        ("coupler", "clap"),
        ("mesh", "ratatui"),
        ("pycav", "rusqlite"),
        ("cav", "pyo3"),
        ("fluid", "numpy"),
        ("cav", "pycav"),
        ("pycav", "iceoryx2"),
        ("stranger", "mesh"),
    ] {
        assert_eq!(wrong_edges(&package(name, needs)).len(), 1, "{name} -> {needs}");
    }
    assert!(wrong_edges(&package("fluid", "mesh")).is_empty());
}

#[test]
fn one_command_tests_every_crate_but_the_python_one() {
    let metadata = metadata();
    let ids = |key: &str| -> Vec<String> {
        metadata[key].as_array().unwrap().iter().map(|id| id.as_str().unwrap().to_owned()).collect()
    };
    let default = ids("workspace_default_members");
    for package in metadata["packages"].as_array().unwrap() {
        let (id, name) = (package["id"].as_str().unwrap(), package["name"].as_str().unwrap());
        assert_eq!(default.iter().any(|d| d == id), name != "pycav", "{name} in default-members");
    }
}

#[test]
fn in_the_solvers_only_the_participant_and_its_boundary_know_the_coupler() {
    for crate_name in ["fluid", "solid"] {
        for path in files(&root().join("crates").join(crate_name).join("src")) {
            let mentions = fs::read_to_string(&path).unwrap().contains("coupler::");
            let may = MEET_COUPLER.iter().any(|name| path.ends_with(name));
            assert!(!mentions || may, "{} names the coupler", path.display());
        }
    }
}

#[test]
fn no_source_file_is_longer_than_a_reader_bears() {
    for path in files(root()).into_iter().filter(|path| path.extension().is_some_and(|e| e == "rs")) {
        let lines = fs::read_to_string(&path).unwrap().lines().count();
        assert!(lines <= LONGEST_FILE, "{} has {lines} lines; split it", path.display());
    }
}

/// The names of the tests in a text that `cargo test` leaves out.
fn ignored_tests(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut lines = text.lines().map(str::trim);
    while let Some(line) = lines.next() {
        if line.starts_with("#[ignore") {
            let name = lines.find_map(|line| line.strip_prefix("fn ")?.split('(').next());
            found.extend(name.map(str::to_owned));
        }
    }
    found
}

/// What is left out of the test command is forgotten unless it stands somewhere, with its command.
#[test]
fn every_test_that_is_left_out_is_named_with_its_command() {
    let text = fs::read_to_string(root().join("docs/verification/test-suite.md")).unwrap();
    // A command may go on in the next line.
    let text = text.replace("\\\n", "");
    let commands: Vec<&str> = text
        .lines()
        .map(str::trim)
        .filter(|line| line.starts_with("cargo test") && line.contains("--ignored"))
        .collect();
    let mut names = Vec::new();
    for path in files(root()).into_iter().filter(|path| path.extension().is_some_and(|e| e == "rs")) {
        names.extend(ignored_tests(&fs::read_to_string(&path).unwrap()));
    }
    for name in &names {
        let named = commands.iter().any(|command| command.split([' ', ':']).any(|word| word == name));
        assert!(named, "{name} is ignored and has no command in docs/verification/test-suite.md");
    }
    for command in commands {
        let known = names.iter().any(|name| command.split([' ', ':']).any(|word| word == name));
        assert!(known, "no test is meant by {command}");
    }
}

#[test]
fn tests_that_are_left_out_are_found() {
    let text = [
        "#[ignore = \"minutes\"]",
        "    fn long() {",
        "fn helper() {",
        "#[ignore]",
        "#[test]",
        "fn longer() {",
    ];
    assert_eq!(ignored_tests(&text.join("\n")), ["long", "longer"]);
}

#[test]
fn no_file_names_a_place_on_somebodys_machine() {
    // Put together here, so that this file is not the first to break the rule.
    let places = ["home", "root", "work", "Users", "mnt"].map(|name| format!("/{name}/"));
    for path in files(root()) {
        let Ok(text) = fs::read_to_string(&path) else { continue };
        for (number, line) in text.lines().enumerate() {
            for place in &places {
                // A place begins with its slash: `docs/work/` is none.
                let is_place = line.match_indices(place.as_str()).any(|(at, _)| {
                    !line[..at]
                        .chars()
                        .next_back()
                        .is_some_and(|c| c.is_alphanumeric() || "._-~}/".contains(c))
                });
                assert!(!is_place, "{}:{} names {place}", path.display(), number + 1);
            }
        }
    }
}

/// The files that people write, below a directory, without what is built or run.
fn files(directory: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut directories = vec![directory.to_owned()];
    while let Some(directory) = directories.pop() {
        for entry in fs::read_dir(&directory).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            if path.is_symlink() {
                continue;
            }
            if path.is_dir() {
                // A build directory says so itself, wherever it lies.
                let is_built = path.join("CACHEDIR.TAG").exists() || path.join("pyvenv.cfg").exists();
                let is_ours = !matches!(&*name, ".git" | "target" | "runs" | "__pycache__") && !is_built;
                if is_ours {
                    directories.push(path);
                }
            } else if path.extension().is_some_and(|e| WRITTEN.iter().any(|w| e == *w)) || name == "run" {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}
