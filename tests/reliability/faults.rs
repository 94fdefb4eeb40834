//! What happens to runs in two processes: killed, stopped, without room, without a directory.

use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use crate::cases::coupled;
use crate::compare::{assert_same, summary};
use crate::processes::{
    Workshop, alone, assert_tidy, checkpoints, process_of, processes_of, segments, signal, text,
    until_checkpoint, wait_until,
};

/// Work for half as long again, since a collapse costs more than what comes before it: six kills come within two and a half seconds.
const WORK: Duration = Duration::from_secs(2);

/// 128 × 128 cells a side, levels with steps of their own, for [`WORK`] on this machine as fast as it is now.
fn longer() -> Vec<&'static str> {
    static END: OnceLock<String> = OnceLock::new();
    const GRID: [&str; 6] =
        ["--set", "fluid.levels=5", "--set", "solid.levels=5", "--set", "time.local_steps=true"];
    const END_OF_TRIAL: f64 = 1e-5;
    let end = END.get_or_init(|| {
        let workshop = Workshop::with(&coupled());
        let trial = format!("time.end={END_OF_TRIAL:e}");
        let begin = Instant::now();
        workshop.done("trial", &[&GRID[..], &["--set", &trial, "-q"]].concat());
        let factor = WORK.as_secs_f64() / begin.elapsed().as_secs_f64();
        format!("time.end={:e}", END_OF_TRIAL * factor.clamp(2.0, 40.0))
    });
    [&GRID[..], &["--set", end]].concat()
}

/// Far longer than any test waits.
const ENDLESS: [&str; 4] = ["--set", "time.end=1e-2", "--set", "time.snapshot_every=1e-3"];

#[test]
#[ignore = "`apart` runs it in a process of its own"]
fn what_happens_to_runs() {
    let _turn = alone();
    let workshop = Workshop::with(&coupled());
    workshop.done("whole", &[&longer()[..], &["-q"]].concat());
    in_other_processes_under_other_numbers_of_threads(&workshop);
    killed_at_any_time(&workshop);
    sides_started_by_hand_go_on(&workshop);
    a_stopped_side_is_waited_for(&workshop);
    a_side_that_stays_stopped_is_given_up();
    no_room_on_the_disk(&workshop);
    a_small_disk_fills_up(&workshop);
    the_directory_is_removed();
    no_room_in_shared_memory();
    what_dead_runs_left_goes_and_what_living_ones_have_stays();
    assert_eq!(segments(), Vec::<String>::new(), "nothing stays in shared memory");
}

/// Two sides in two terminals, one of them killed or interrupted: what they left goes on as any other run.
fn sides_started_by_hand_go_on(workshop: &Workshop) {
    for (number, fault) in ["-KILL", "-INT"].into_iter().enumerate() {
        let name = format!("by-hand-{number}");
        let id = format!("{name}-{}", std::process::id());
        let more = [&longer()[..], &["-q", "--checkpoint-every", "0"]].concat();
        let mut fluid = workshop.side("fluid", &name, &id, &more).spawn().unwrap();
        let mut solid = workshop.side("solid", &name, &id, &more).spawn().unwrap();
        until_checkpoint(&workshop.file(&name), &mut solid);
        signal(fluid.id(), fault);
        let codes = [fluid.wait().unwrap().code(), solid.wait().unwrap().code()];
        assert!(codes.iter().all(|code| *code != Some(0)), "{fault}: {codes:?}");
        let output = workshop.resume(&name, &["-v"]).output().unwrap();
        assert!(output.status.success() && text(&output).contains("going on from"), "{}", text(&output));
        assert_same(&name, &workshop.file("whole"), &workshop.file(&name), true);
    }
}

/// Interrupted again and again; each time it goes on otherwise.
fn in_other_processes_under_other_numbers_of_threads(workshop: &Workshop) {
    let out = workshop.file("often");
    let mut interruptions = 0;
    for number in 0.. {
        let ways: [&[&str]; 4] = [
            &["--threads", "1"],
            &["--in-process", "--threads", "2"],
            &["--threads", "2"],
            &["--in-process"],
        ];
        let way = ways[number % 4];
        let mut run = if !out.join("case.toml").exists() {
            workshop.cav("often", &[&longer()[..], &["-q"], way].concat()).spawn().unwrap()
        } else {
            workshop.resume("often", &[&["-q"], way].concat()).spawn().unwrap()
        };
        std::thread::sleep(Duration::from_millis(350));
        signal(run.id(), if number % 2 == 0 { "-INT" } else { "-TERM" });
        let code = run.wait().unwrap().code();
        assert!(processes_of(&out).is_empty());
        if code == Some(0) {
            break;
        }
        // On a busy machine the signal may come before the program listens to it.
        if code.is_none() && number < 20 {
            continue;
        }
        // Before the first step there is nothing to keep.
        assert_eq!(code, Some(if number % 2 == 0 { 130 } else { 143 }), "run {number}, {way:?}");
        interruptions += 1;
        assert!(checkpoints(&out).len() >= 2 || interruptions < 3, "{:?}", checkpoints(&out));
    }
    assert!(interruptions >= 3, "only {interruptions} interruptions");
    assert_same("often", &workshop.file("whole"), &out, false);
    assert_tidy(&out);
}

/// SIGKILL to either side and to the launcher.
fn killed_at_any_time(workshop: &Workshop) {
    let out = workshop.file("killed");
    let every = ["-q", "--checkpoint-every", "40ms"];
    let mut run = workshop.cav("killed", &[&longer()[..], &every].concat()).spawn().unwrap();
    for (number, milliseconds) in [420_u64, 310, 500, 270, 390, 350].into_iter().enumerate() {
        std::thread::sleep(Duration::from_millis(milliseconds));
        let victim = ["fluid", "solid", "run"][number % 3];
        let pid = victim_of(&mut run, &out, victim);
        let pid = pid.unwrap_or_else(|| panic!("the run was over before it was killed {} times", number + 1));
        signal(pid, "-KILL");
        let code = run.wait().unwrap().code();
        assert!(matches!(code, None | Some(4)), "{code:?}");
        run = workshop.resume("killed", &every).spawn().unwrap();
    }
    let output = run.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", text(&output));
    let log = fs::read_to_string(out.join("log")).unwrap();
    let times = log.matches("going on from the checkpoint").count();
    assert!(times >= 4, "of 6 kills {times} were gone on from; the others came before a checkpoint");
    assert_same("killed", &workshop.file("whole"), &out, true);
    assert_tidy(&out);
}

/// The number of a side's process or of the launcher's; `None` if the run is over.
pub fn victim_of(run: &mut Child, out: &Path, name: &str) -> Option<u32> {
    let mut found = None;
    wait_until("a process to kill", Duration::from_secs(60), || {
        let is_over = run.try_wait().unwrap().is_some();
        found = if is_over {
            None
        } else if name == "run" {
            Some(run.id())
        } else {
            process_of(out, name)
        };
        is_over || found.is_some()
    });
    found
}

fn a_stopped_side_is_waited_for(workshop: &Workshop) {
    for victim in ["fluid", "solid"] {
        let out = workshop.file(victim);
        let mut run = workshop
            .cav(victim, &[&longer()[..], &["--checkpoint-every", "200ms"]].concat())
            .spawn()
            .unwrap();
        until_checkpoint(&out, &mut run);
        let pid = process_of(&out, victim).unwrap();
        signal(pid, "-STOP");
        std::thread::sleep(Duration::from_millis(2500));
        assert!(run.try_wait().unwrap().is_none(), "it waits");
        signal(pid, "-CONT");
        let output = run.wait_with_output().unwrap();
        assert!(output.status.success(), "{}", text(&output));
        for words in ["is stopped; waiting for it", "goes on"] {
            let whole = format!("the {victim} (process {pid}) {words}");
            assert!(text(&output).contains(&whole), "{whole}: {}", text(&output));
        }
        assert_same(victim, &workshop.file("whole"), &out, true);
    }
}

fn a_side_that_stays_stopped_is_given_up() {
    let workshop = Workshop::with(&coupled());
    let out = workshop.file("stopped");
    let more = ["--checkpoint-every", "0", "--set", "coupling.patience=1.5"];
    let mut run = workshop.cav("stopped", &[&ENDLESS[..], &more].concat()).spawn().unwrap();
    until_checkpoint(&out, &mut run);
    let pid = process_of(&out, "solid").unwrap();
    signal(pid, "-STOP");
    let stopped = Instant::now();
    wait_until("the fluid gives up", Duration::from_secs(10), || process_of(&out, "fluid").is_none());
    assert!(stopped.elapsed() > Duration::from_millis(1400), "after {:?}", stopped.elapsed());
    let output = run.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(4), "{}", text(&output));
    assert!(text(&output).contains("is it stopped?"), "{}", text(&output));
    assert!(processes_of(&out).is_empty(), "the stopped side has been ended, too");
    assert!(!checkpoints(&out).is_empty());
}

/// A limit on the length of files stands for a full disk: the system refuses to write more in the same way.
fn no_room_on_the_disk(workshop: &Workshop) {
    let out = workshop.file("full");
    let mut run = workshop
        .cav("full", &[&longer()[..], &["-q", "--checkpoint-every", "40ms"]].concat())
        .spawn()
        .unwrap();
    until_checkpoint(&out, &mut run);
    signal(run.id(), "-INT");
    assert_eq!(run.wait().unwrap().code(), Some(130));
    let before = checkpoints(&out);
    assert!(before.len() >= 2);
    // Blocks of 512 or 1024 bytes, as the shell has it: less than a checkpoint takes in any case.
    let script = "trap '' XFSZ; ulimit -f 60; exec \"$@\"";
    let output = Command::new("sh")
        .args(["-c", script, "sh", env!("CARGO_BIN_EXE_cav"), "run", "--resume"])
        .arg(&out)
        .args(["--in-process", "--checkpoint-every", "0"])
        .stdin(Stdio::null())
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(5), "{}", text(&output));
    assert!(
        text(&output).contains("cannot") && text(&output).contains(&*out.to_string_lossy()),
        "{}",
        text(&output)
    );
    assert_eq!(checkpoints(&out), before, "the checkpoints are as they were, and none is left in the making");
    let output = workshop.resume("full", &["-q"]).output().unwrap();
    assert!(output.status.success(), "{}", text(&output));
    assert_same("full", &workshop.file("whole"), &out, true);
}

/// A file system of 64 MiB, of which something else takes the rest when the run has its first checkpoints.
fn a_small_disk_fills_up(workshop: &Workshop) {
    const SCRIPT: &str = r#"
        mount -t tmpfs -o size=64m tmpfs "$1" || exit 99
        "$3" run "$4" --out "$1/run" $5 &
        until ls "$1"/run/checkpoints/solid-*.ckpt > "$1/listed" 2>&1; do kill -0 $! || exit 98; sleep 0.05; done
        dd if=/dev/zero of="$1/filler" bs=64k 2> /dev/null
        wait $!
        code=$?
        rm "$1/filler"
        cp -a "$1/run" "$2"
        exit $code"#;
    if !may_mount() {
        return not_tested("a file system that fills up");
    }
    let (disk, out) = (workshop.file("disk"), workshop.file("filled"));
    fs::create_dir(&disk).unwrap();
    let options = [&longer()[..], &["-q", "--checkpoint-every", "200ms"]].concat().join(" ");
    let mut command = Command::new("unshare");
    command.args(["-m", "sh", "-c", SCRIPT, "sh"]).args([&disk, &out]).arg(env!("CARGO_BIN_EXE_cav"));
    let output = command.arg(workshop.file("case.toml")).arg(options).stdin(Stdio::null()).output().unwrap();
    assert_eq!(output.status.code(), Some(5), "{}", text(&output));
    assert!(text(&output).contains("No space left on device"), "{}", text(&output));
    let left = checkpoints(&out);
    assert!(left.len() >= 2 && left.iter().all(|name| name.ends_with(".ckpt")), "{left:?}");
    let output = workshop.resume("filled", &["-q"]).output().unwrap();
    assert!(output.status.success(), "{}", text(&output));
    assert_same("filled", &workshop.file("whole"), &out, true);
}

fn the_directory_is_removed() {
    let workshop = Workshop::with(&coupled());
    let out = workshop.file("removed");
    let mut run =
        workshop.cav("removed", &[&ENDLESS[..], &["--checkpoint-every", "0"]].concat()).spawn().unwrap();
    until_checkpoint(&out, &mut run);
    fs::rename(&out, workshop.file("elsewhere")).unwrap();
    let output = run.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(5), "{}", text(&output));
    assert!(text(&output).contains("moved or deleted"), "{}", text(&output));
    assert!(!out.exists(), "it is not made again");
    assert!(processes_of(&out).is_empty());
}

/// Says so for all to see: what `eprintln` says in a test that passes is never shown.
fn not_tested(what: &str) {
    let text = format!("\nNOT TESTED, for want of permission to mount (unshare -m): {what}\n");
    let _ = std::io::stderr().write_all(text.as_bytes());
}

/// Whether this machine lets us have a file system of our own.
fn may_mount() -> bool {
    Command::new("unshare").args(["-m", "true"]).stderr(Stdio::null()).status().is_ok_and(|s| s.success())
}

fn no_room_in_shared_memory() {
    let workshop = Workshop::with(&coupled());
    if !may_mount() {
        return not_tested("shared memory of another size");
    }
    let run = |mount: &str| {
        let script = format!("mount -t tmpfs -o {mount} tmpfs /dev/shm && exec \"$@\"");
        let mut command = Command::new("unshare");
        command.args(["-m", "sh", "-c", &script, "sh", env!("CARGO_BIN_EXE_cav"), "run"]);
        command.arg(workshop.file("case.toml")).arg("--out").arg(workshop.file("shm")).stdin(Stdio::null());
        command.output().unwrap()
    };
    for (mount, words) in [("size=256k", ["enlarge it", "--shm-size"]), ("ro", ["/dev/shm", "mount it"])] {
        let output = run(mount);
        assert_eq!(output.status.code(), Some(4), "{mount}: {}", text(&output));
        words.iter().for_each(|word| assert!(text(&output).contains(word), "{word}: {}", text(&output)));
    }
}

fn what_dead_runs_left_goes_and_what_living_ones_have_stays() {
    let workshop = Workshop::with(&coupled());
    let mut living = workshop.cav("living", &[&longer()[..], &["-q"]].concat()).spawn().unwrap();
    let mut dead =
        workshop.cav("dead", &[&ENDLESS[..], &["-q", "--checkpoint-every", "0"]].concat()).spawn().unwrap();
    until_checkpoint(&workshop.file("dead"), &mut dead);
    let both = segments().len();
    // All at once, so that nobody can clear up.
    let pids: Vec<u32> = processes_of(&workshop.file("dead")).into_iter().map(|(pid, _)| pid).collect();
    assert_eq!(pids.len(), 3);
    let pids: Vec<String> = pids.iter().map(u32::to_string).collect();
    Command::new("kill").arg("-KILL").args(&pids).status().unwrap();
    dead.wait().unwrap();
    wait_until("they end", Duration::from_secs(5), || processes_of(&workshop.file("dead")).is_empty());
    workshop.done("next", &["-q", "--set", "time.end=4e-6"]);
    if living.try_wait().unwrap().is_none() {
        let left = segments().len();
        assert!(left < both, "{left} of {both} are left beside the living run's");
    }
    let output = living.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", text(&output));
    assert_eq!(summary(&workshop.file("living"))["completed"], true);
    assert!(is_clean(&workshop.file("living")));
}

fn is_clean(out: &Path) -> bool {
    assert_tidy(out);
    processes_of(out).is_empty()
}
