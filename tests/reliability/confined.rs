//! A case file writes nowhere but in its output directory, whatever names it gives.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::cases::coupled;
use crate::processes::{Workshop, alone, text};

/// All files and directories below a place but those below `except`, and what is in them.
fn below(place: &Path, except: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut ahead = vec![place.to_path_buf()];
    while let Some(directory) = ahead.pop() {
        for entry in fs::read_dir(&directory).unwrap().flatten() {
            let path = entry.path();
            if path == except {
                continue;
            }
            if path.is_dir() {
                ahead.push(path.clone());
                found.insert(path, vec![]);
            } else {
                let bytes = fs::read(&path).unwrap();
                found.insert(path, bytes);
            }
        }
    }
    found
}

/// A workshop, and in it a directory with somebody else's file.
fn beside_a_file(name: &str) -> (Workshop, PathBuf) {
    let workshop = Workshop::with("");
    let elsewhere = workshop.file("elsewhere");
    fs::create_dir(&elsewhere).unwrap();
    fs::write(elsewhere.join(name), "mine").unwrap();
    (workshop, elsewhere)
}

/// Names that lead elsewhere where they are taken for paths: of probes, of the material.
#[test]
fn names_lead_nowhere() {
    let _turn = alone();
    let (workshop, elsewhere) = beside_a_file("fluid.h5");
    let absolute = elsewhere.join("fluid.h5").to_string_lossy().into_owned();
    let mut accepted = 0;
    for name in
        ["../elsewhere/new", "../../elsewhere/fluid.h5", &absolute, "..", "/", "a/../../b", "new\\u0000.h5"]
    {
        let probe = coupled().replace("name = \"wall\"", &format!("name = \"{name}\""));
        let material = coupled().replace("structural-steel", name);
        for case in [probe, material] {
            assert!(case.contains(name));
            fs::write(workshop.file("case.toml"), case).unwrap();
            let before = below(&workshop.file(""), &workshop.file("out"));
            let output = workshop
                .cav("out", &["--in-process", "--force", "-q", "--set", "time.end=1e-6"])
                .current_dir(&elsewhere)
                .output()
                .unwrap();
            let code = output.status.code();
            assert!(matches!(code, Some(0 | 2)), "{name}: {code:?} {}", text(&output));
            accepted += i32::from(code == Some(0));
            assert!(before == below(&workshop.file(""), &workshop.file("out")), "{name} wrote elsewhere");
        }
    }
    println!("{accepted} such cases ran");
}

/// The run directory is called after the case file where nothing else names it, and the file may be called anything.
#[test]
fn a_case_files_own_name_leads_nowhere() {
    let _turn = alone();
    let workshop = Workshop::with(&coupled());
    let (elsewhere, runs) = (workshop.file("elsewhere"), workshop.file("elsewhere/runs"));
    fs::create_dir(&elsewhere).unwrap();
    for (number, name) in ["..toml", "...toml", "....toml"].into_iter().enumerate() {
        fs::copy(workshop.file("case.toml"), workshop.file(name)).unwrap();
        let before = below(&workshop.file(""), &runs);
        let mut cav =
            workshop.of_case_file(name, &["--in-process", "--force", "-q", "--set", "time.end=1e-6"]);
        let output = cav.current_dir(&elsewhere).output().unwrap();
        assert!(output.status.success(), "{name}: {}", text(&output));
        assert!(before == below(&workshop.file(""), &runs), "{name} wrote elsewhere");
        let made = fs::read_dir(&runs).unwrap().flatten().filter(|entry| entry.path().is_dir()).count();
        assert_eq!(made, 1 + number / 2, "{name}: `case` twice, then `...`");
    }
}

/// The directory that a case names is taken if it is empty or a run's; anybody else's files are left alone.
#[test]
fn an_output_directory_with_other_files_is_refused() {
    let _turn = alone();
    let (workshop, elsewhere) = beside_a_file("letter.txt");
    let case = format!("{}[output]\ndirectory = {:?}\n", coupled(), elsewhere.to_string_lossy());
    fs::write(workshop.file("case.toml"), case).unwrap();
    let before = below(&workshop.file(""), &workshop.file("out"));
    // As any other input that is no good.
    for force in [&["--force"][..], &[]] {
        let output = workshop.of_case(&[&["--in-process", "-q"], force].concat()).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{}", text(&output));
        assert!(text(&output).contains("letter.txt"), "{}", text(&output));
        assert!(before == below(&workshop.file(""), &workshop.file("out")));
    }
}
