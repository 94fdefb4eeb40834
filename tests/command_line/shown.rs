//! What the program shows of itself: keys, completions, manual, helps.

use std::fs;
use std::process::Command;

use crate::{Workshop, good_run, text};

/// The program ends with this exit code, and says what helps.
fn is_refused(workshop: &Workshop, arguments: &[&str], code: i32, remedy: &str) {
    let wrong = workshop.cav(arguments);
    assert_eq!(wrong.status.code(), Some(code));
    assert!(text(&wrong).contains(remedy), "{}", text(&wrong));
}

#[test]
fn keys_are_shown_and_wrong_paths_named_with_the_nearest() {
    let workshop = Workshop::new();
    let all = text(&good_run(&workshop, &["keys"]));
    for part in ["[[fluid.region]]", "[output]", "epsilon_waves", "connect_timeout"] {
        assert!(all.contains(part), "no `{part}` in {all}");
    }
    let one = text(&good_run(&workshop, &["keys", "time.cfl"]));
    assert!(one.contains("(0, 0.9]") && one.contains("0.45"), "{one}");
    assert!(text(&good_run(&workshop, &["keys", "--markdown"])).starts_with("# Keys of a case file\n"));
    let wrong = workshop.cav(&["keys", "fluid.boundry"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(
        wrong.stdout.is_empty() && text(&wrong).contains("did you mean `fluid.boundary`"),
        "{}",
        text(&wrong)
    );
}

#[test]
fn bash_completes_commands_options_and_keys() {
    let workshop = Workshop::new();
    good_run(&workshop, &["completions", "bash", "scripts"]);
    let script = workshop.path("scripts/cav.bash");
    let completed = |words: &[&str]| {
        let typed = words.last().expect("words");
        let before = words[words.len() - 2];
        let line = format!(
            "source {}; COMP_WORDS=({}); COMP_CWORD={}; _cav cav '{typed}' '{before}'; echo \"${{COMPREPLY[@]}}\"",
            script.display(),
            words.join(" "),
            words.len() - 1
        );
        let output = Command::new("bash").args(["--norc", "-c", &line]).output().expect("bash starts");
        assert!(output.status.success() && output.stderr.is_empty(), "{line}: {}", text(&output));
        text(&output).trim().to_owned()
    };
    assert_eq!(completed(&["cav", "mat"]), "materials");
    assert_eq!(completed(&["cav", "run", "--res"]), "--resume");
    assert_eq!(completed(&["cav", "keys", "fluid.boundary.z_mi"]), "fluid.boundary.z_min");
    for shell in ["zsh", "fish", "elvish", "powershell"] {
        assert!(text(&good_run(&workshop, &["completions", shell])).contains("materials"), "{shell}");
    }
    is_refused(&workshop, &["completions", "bsh"], 2, "bash");
}

#[test]
fn the_manual_has_a_page_for_every_command() {
    let workshop = Workshop::new();
    let main = text(&good_run(&workshop, &["man"]));
    assert!(main.contains(".TH cav 1") && main.contains("143"), "{main}");
    good_run(&workshop, &["man", "pages/man1"]);
    for (page, part) in
        [("cav.1", "cav\\-run(1)"), ("cav-run.1", "checkpoint"), ("cav-new-collapse.1", "stand")]
    {
        let text = fs::read_to_string(workshop.path("pages/man1").join(page)).expect(page);
        assert!(text.contains(part), "no `{part}` in {page}: {text}");
    }
    is_refused(&workshop, &["man", "case.toml/pages"], 5, "choose another directory");
}

#[test]
fn exit_codes_are_told_once() {
    let workshop = Workshop::new();
    assert!(text(&good_run(&workshop, &["--help"])).contains("130  interrupted"));
    assert!(!text(&good_run(&workshop, &["run", "--help"])).contains("interrupted"));
}
