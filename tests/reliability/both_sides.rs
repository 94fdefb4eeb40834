//! Runs in two processes: the same numbers as in one, and what happens when something goes wrong.

use std::path::Path;
use std::process::{Child, Command};
use std::time::{Duration, Instant};

use crate::cases;
use crate::compare::{datasets, summary};
use crate::processes::{Workshop, alone, processes_of, segments, signal, text, wait_until};

/// A bubble over steel, adaptive on three levels, with one snapshot before the end.
fn workshop() -> Workshop {
    Workshop::with(&cases::coupled().replace("snapshot_every = 1.3e-6", "snapshots = [1e-5]"))
}

fn running(workshop: &Workshop, out: &str, child: &mut Child, sides: usize) -> Vec<(u32, String)> {
    let path = workshop.file(out);
    wait_until("both sides step", Duration::from_secs(30), || {
        assert!(child.try_wait().expect("a look").is_none(), "the run ended early");
        path.join("history.h5").exists()
    });
    let processes: Vec<_> = processes_of(&path).into_iter().filter(|(_, command)| command != "run").collect();
    assert_eq!(processes.len(), sides, "{processes:?}");
    processes
}

/// A run long enough to be disturbed.
const LONG: [&str; 2] = ["--set", "time.end=1e-2"];

#[test]
#[ignore = "`apart` runs it in a process of its own"]
fn two_processes() {
    let _turn = alone();
    same_numbers_in_one_process_and_in_two();
    runs_side_by_side_do_not_meet();
    by_hand_in_two_terminals();
    another_case_is_refused();
    an_absent_peer_is_named();
    a_killed_side_ends_the_other("fluid");
    a_killed_side_ends_the_other("solid");
    a_killed_launcher_ends_both();
    an_interrupt_stops_both_sides("-INT", 130);
    an_interrupt_stops_both_sides("-TERM", 143);
    a_numerical_failure_is_told();
    another_program_takes_the_wall();
    nothing_is_left_in_shared_memory();
}

#[path = "../../examples/spring_mass_wall.rs"]
#[allow(dead_code, reason = "its main is not called here")]
mod spring_mass_wall;

/// The example's wall in this process, the fluid in one of its own.
fn another_program_takes_the_wall() {
    let workshop = workshop();
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/spring-mass-wall.toml");
    let name = format!("wall-{}", std::process::id());
    let cav = |command: &str| {
        let mut cav = Command::new(env!("CARGO_BIN_EXE_cav"));
        cav.arg(command).arg(&case).arg("-q").arg("--out").arg(workshop.file("fluid"));
        cav
    };
    let refused = cav("run").output().expect("starts");
    assert_eq!(refused.status.code(), Some(2), "{}", text(&refused));
    assert!(text(&refused).contains("cav fluid CASE --run ID"), "{}", text(&refused));
    let mut fluid = cav("fluid").args(["--run", &name]).spawn().expect("starts");
    let there = spring_mass_wall::run(&case, Some(&name)).expect("the wall");
    assert!(fluid.wait().expect("ends").success());
    let here = spring_mass_wall::run(&case, None).expect("in one process");
    assert_eq!(there.map(f64::to_bits), here.map(f64::to_bits));
    let summary = summary(&workshop.file("fluid"));
    assert!(summary["completed"] == true && summary["wall_pressure_peak"].as_f64().unwrap() > 1.1e5);
}

fn same_numbers_in_one_process_and_in_two() {
    let workshop = workshop();
    let runs: [(&str, &[&str]); 4] = [
        ("two", &[]),
        ("two-one-thread", &["--threads", "1"]),
        ("one", &["--in-process"]),
        ("one-one-thread", &["--in-process", "--threads", "1"]),
    ];
    let weak = ["--set", "coupling.scheme=weak", "--set", "coupling.kappa=jump"];
    let common = ["--set", "coupling.step_ratio=1"];
    let local = ["--set", "time.local_steps=true"];
    // A solid in which waves are no faster than in the liquid: the longer steps are its own.
    let soft = [
        &["--set", "solid.material={ density = 1100.0, c1 = 1550.0, c2 = 20.0 }", "--set", "time.end=2e-5"],
        &local[..],
    ]
    .concat();
    let explicit = ["--set", "coupling.scheme=explicit"];
    let strong = ["--set", "coupling.scheme=strong"];
    let strong_solid = ["--set", "coupling.scheme=strong", "--set", "coupling.first=solid"];
    let thick = ["--set", "fluid.terms.viscosity={ liquid = 1e2, gas = 1.0 }"];
    let soft_thick = [&soft[..], &thick].concat();
    let schemes =
        [&[][..], &weak, &explicit, &strong, &strong_solid, &common, &local, &soft, &thick, &soft_thick];
    for scheme in schemes {
        for (name, flags) in runs {
            let output = workshop.cav(name, &[flags, scheme, &["--force", "-q"]].concat()).output().unwrap();
            assert!(output.status.success(), "{name}: {}", text(&output));
        }
        let reference = datasets(&workshop.file("two/history.h5"));
        assert!(reference.len() > 40, "{} datasets", reference.len());
        assert!(reference["/bubble/volume"].1.len() > 20);
        for (name, _) in &runs[1..] {
            let other = datasets(&workshop.file(name).join("history.h5"));
            assert_eq!(reference.len(), other.len(), "{name}");
            for (a, b) in reference.iter().zip(&other) {
                assert!(a == b, "{name}: {} differs from {}", b.0, a.0);
            }
        }
    }
}

fn runs_side_by_side_do_not_meet() {
    let workshop = workshop();
    let mut first = workshop.cav("first", &["-q"]).spawn().expect("starts");
    let second = workshop.cav("second", &["-q", "--set", "fluid.ambient.pressure=2e7"]).output().unwrap();
    assert!(second.status.success(), "{}", text(&second));
    assert!(first.wait().expect("ends").success());
    let peaks =
        ["first", "second"].map(|name| summary(&workshop.file(name))["wall_pressure_peak"].as_f64().unwrap());
    assert!(peaks[0] > 1.5 * peaks[1], "{peaks:?}");
}

fn by_hand_in_two_terminals() {
    let workshop = workshop();
    let id = format!("by-hand-{}", std::process::id());
    let solid = workshop.side("solid", "hand", &id, &[]).spawn().expect("starts");
    std::thread::sleep(Duration::from_millis(300));
    let fluid = workshop.side("fluid", "hand", &id, &[]).output().expect("starts");
    let solid = solid.wait_with_output().expect("ends");
    assert!(fluid.status.success(), "{}", text(&fluid));
    assert!(solid.status.success(), "{}", text(&solid));
    let summary = summary(&workshop.file("hand"));
    assert_eq!(summary["completed"], true);
    assert!(summary["von_mises_peak"].is_number() && summary["wall_pressure_peak"].is_number());
    assert!(workshop.cav("reference", &["-q"]).output().unwrap().status.success());
    let (hand, launched) = (workshop.file("hand/history.h5"), workshop.file("reference/history.h5"));
    assert!(datasets(&hand) == datasets(&launched), "by hand and launched differ");
}

fn another_case_is_refused() {
    let workshop = workshop();
    let id = format!("refused-{}", std::process::id());
    let more = ["--set", "fluid.liquid.gamma=7.0"];
    let solid = workshop.side("solid", "refused", &id, &more).spawn().expect("starts");
    let fluid = workshop.side("fluid", "refused", &id, &[]).output().expect("starts");
    let solid = solid.wait_with_output().expect("ends");
    for output in [&fluid, &solid] {
        assert_eq!(output.status.code(), Some(4), "{}", text(output));
    }
    assert!(
        text(&fluid).contains("case") && text(&solid).contains("case"),
        "{}{}",
        text(&fluid),
        text(&solid)
    );
}

fn an_absent_peer_is_named() {
    let workshop = workshop();
    let id = format!("absent-{}", std::process::id());
    let more = ["--set", "coupling.connect_timeout=0.5"];
    let output = workshop.side("fluid", "absent", &id, &more).output().expect("starts");
    assert_eq!(output.status.code(), Some(4));
    assert!(text(&output).contains("solid"), "{}", text(&output));
    let summary = summary(&workshop.file("absent"));
    assert!(summary["error"].as_str().unwrap().contains("no solid joined"), "{summary}");
}

fn a_killed_side_ends_the_other(victim: &str) {
    let workshop = workshop();
    let mut run = workshop.cav("killed", &LONG).spawn().expect("starts");
    let sides = running(&workshop, "killed", &mut run, 2);
    let (pid, _) = sides.iter().find(|(_, name)| name == victim).expect("it runs");
    assert!(signal(*pid, "-KILL"));
    let killed = Instant::now();
    let output = run.wait_with_output().expect("ends");
    assert!(killed.elapsed() < Duration::from_secs(5), "took {:?}", killed.elapsed());
    assert_eq!(output.status.code(), Some(4), "{}", text(&output));
    assert!(text(&output).contains(&format!("the {victim} (process {pid}) was killed")), "{}", text(&output));
    assert!(processes_of(&workshop.file("killed")).is_empty());
    // Readable up to then, and not called complete.
    let history = datasets(&workshop.file("killed/history.h5"));
    assert!(!history["/time"].1.is_empty());
    hdf5::File::open(workshop.file("killed/fluid.vtkhdf")).expect("the snapshots open");
    let summary = summary(&workshop.file("killed"));
    assert_eq!(summary["completed"], false);
    assert!(summary["error"].as_str().unwrap().contains(&format!("the {victim} (process")), "{summary}");
    // The same command runs again at once; the unfinished run is kept aside.
    let again = workshop.cav("killed", &["-q"]).output().unwrap();
    assert!(again.status.success(), "{}", text(&again));
    assert!(workshop.file("killed.1").exists());
}

fn a_killed_launcher_ends_both() {
    let workshop = workshop();
    let mut run = workshop.cav("orphans", &LONG).spawn().expect("starts");
    running(&workshop, "orphans", &mut run, 2);
    run.kill().expect("killed");
    run.wait().expect("ends");
    wait_until("the sides end", Duration::from_secs(5), || {
        processes_of(&workshop.file("orphans")).is_empty()
    });
    // The joint history consists of links then.
    let history = hdf5::File::open(workshop.file("orphans/history.h5")).expect("the history opens");
    for name in ["/time", "/solid/time", "/bubble/volume"] {
        assert!(history.dataset(name).expect("it is there").size() > 0, "{name}");
    }
}

fn an_interrupt_stops_both_sides(kind: &str, code: i32) {
    let workshop = workshop();
    let mut run = workshop.cav("stopped", &LONG).spawn().expect("starts");
    running(&workshop, "stopped", &mut run, 2);
    assert!(signal(run.id(), kind));
    let output = run.wait_with_output().expect("ends");
    assert_eq!(output.status.code(), Some(code), "{}", text(&output));
    // Said once, not by each side.
    assert_eq!(text(&output).matches("error: ").count(), 1, "{}", text(&output));
    assert!(processes_of(&workshop.file("stopped")).is_empty());
    let summary = summary(&workshop.file("stopped"));
    assert_eq!(summary["completed"], false);
    // Both sides stopped at the same time, the solid after more steps.
    let history = datasets(&workshop.file("stopped/history.h5"));
    let times = |name: &str| &history[name].1;
    assert_eq!(times("/time").last(), times("/solid/time").last());
    assert!(times("/time").len() < times("/solid/time").len());
    assert_eq!(Some(times("/time").len() as u64), summary["steps"].as_u64().map(|steps| steps + 1));
}

fn a_numerical_failure_is_told() {
    let workshop = workshop();
    // Liquid at a hundred times its speed of sound against the wall.
    let more = ["--set", "fluid.ambient.velocity=[-1e5, 0.0]"];
    let output = workshop.cav("failed", &[&more[..], &LONG].concat()).output().unwrap();
    assert_eq!(output.status.code(), Some(3), "{}", text(&output));
    assert!(
        ["not physical", "not finite", "is no state", "collapsed"]
            .iter()
            .any(|words| text(&output).contains(words)),
        "{}",
        text(&output)
    );
    let summary = summary(&workshop.file("failed"));
    assert_eq!((&summary["completed"], &summary["exit_code"]), (&false.into(), &3.into()));
    assert!(!summary["error"].as_str().unwrap().contains("gave up"), "the cause: {}", summary["error"]);
}

fn nothing_is_left_in_shared_memory() {
    assert_eq!(segments(), Vec::<String>::new());
}
