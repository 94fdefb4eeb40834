//! `cav watch`: what is read of runs in progress, ended, killed; and that the run does not notice.
//!
//! A program of its own: it starts processes, see `tests/output_kill.rs`.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use cav::output::run_directory::is_held;
use cav::output::{RunDirectory, RunState};
use cav::watch::draw::colours::Colours;
use cav::watch::draw::{View, draw};
use cav::watch::reader::Reader;
use cav::watch::seen::Seen;
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use rustix::process::{Pid, Signal, kill_process};
use tempfile::TempDir;

mod fixture;

/// Longer than any wait of a test should be.
const PATIENCE: Duration = Duration::from_secs(60);

/// A coupled case to this time, s: 2e-4 are some 2000 steps and two seconds.
fn case(place: &Path, end: f64) {
    let text = fixture::small(&format!("end = {end:e}\n"), 3);
    fs::write(place.join("case.toml"), text).expect("the case is written");
}

fn command(place: &Path, arguments: &[&str]) -> Command {
    let mut cav = Command::new(env!("CARGO_BIN_EXE_cav"));
    cav.args(arguments).current_dir(place).stdin(Stdio::null());
    cav
}

fn cav(place: &Path, arguments: &[&str]) -> Output {
    command(place, arguments).output().expect("cav starts")
}

/// A directory with the case, of which a run to this time has begun.
fn begun(end: f64, out: &str, checkpoints: &str) -> (TempDir, Child) {
    let place = tempfile::tempdir().expect("a directory");
    case(place.path(), end);
    let run = start(place.path(), out, checkpoints);
    (place, run)
}

fn start(place: &Path, out: &str, checkpoints: &str) -> Child {
    let arguments =
        ["run", "case.toml", "--out", out, "-q", "--threads", "1", "--checkpoint-every", checkpoints];
    command(place, &arguments).spawn().expect("cav starts")
}

/// Looks until something is seen.
fn until(place: &Path, run: &str, what: &str, is_seen: impl Fn(&Seen) -> bool) -> Seen {
    let (begin, mut reader) = (Instant::now(), Reader::new(&place.join(run)));
    loop {
        match reader.look() {
            Ok(seen) if is_seen(&seen) => return seen,
            other => assert!(begin.elapsed() < PATIENCE, "{what} is not seen, but {other:?}"),
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// What a terminal of 80 × 24 shows.
fn picture(seen: &Seen) -> String {
    let mut terminal = Terminal::new(TestBackend::new(80, 24)).expect("memory");
    let mut view = View::default();
    terminal.draw(|frame| draw(frame, seen, &Colours::none(), &mut view)).expect("it takes it");
    terminal.backend().to_string()
}

#[test]
fn a_run_is_seen_to_begin_to_go_on_and_to_be_interrupted_and_taken_up_again() {
    // Longer than anybody waits: it is ended here.
    let (place, mut run) = begun(1e-2, "run", "100ms");
    let place = place.path();
    let early = until(place, "run", "a running run with a curve", |seen| {
        seen.state == RunState::Running
            && seen.curves.len() == 3
            && seen.standing.as_ref().is_some_and(|s| s.line.step > 0 && s.line.solid_cells > 0)
    });
    let line = early.standing.clone().expect("it stands somewhere").line;
    let has_numbers = line.step > 0 && line.time > 0.0 && line.dt > 0.0 && line.cells > line.solid_cells;
    assert!(has_numbers, "{line:?}");
    assert_eq!(early.end, Some(1e-2));
    let text = picture(&early);
    for fragment in
        ["running", "equivalent radius R(t)", "wall pressure on the axis", "von Mises", "cells: fluid"]
    {
        assert!(text.contains(fragment), "no {fragment} in\n{text}");
    }
    until(place, "run", "progress", |seen| seen.standing.as_ref().is_some_and(|s| s.line.step > line.step));
    let plain = cav(place, &["watch", "run"]);
    assert_eq!(plain.status.code(), Some(0));
    assert!(
        stdout(&plain).contains("run: running") && stdout(&plain).contains(" left"),
        "{}",
        stdout(&plain)
    );
    until(place, "run", "a checkpoint", |_| cav::output::run_state::has_checkpoints(&place.join("run")));
    run.kill().expect("it is killed");
    run.wait().expect("it has ended");
    // Its sides see it and end; meanwhile they are the run.
    let ended = until(place, "run", "the end", |seen| seen.state != RunState::Running);
    assert_eq!(ended.state, RunState::Interrupted);
    assert!(picture(&ended).contains("cav run --resume"), "{}", picture(&ended));
    // A reader that has followed it from the start sees what one sees that comes later, also beyond what a resumption forgets.
    let mut follower = Reader::new(&place.join("run"));
    let before = follower.look().expect("it is there").curves[0].curve.last().expect("a curve")[0];
    let mut resumed =
        command(place, &["run", "--resume", "run", "-q", "--threads", "1"]).spawn().expect("cav starts");
    let begin = Instant::now();
    while follower.look().expect("it is there").curves[0].curve.last().is_none_or(|[time, _]| time <= before)
    {
        assert!(begin.elapsed() < PATIENCE, "it does not go on");
        std::thread::sleep(Duration::from_millis(10));
    }
    let pid = i32::try_from(resumed.id()).ok().and_then(Pid::from_raw).expect("a process");
    kill_process(pid, Signal::INT).expect("it is there");
    assert_eq!(resumed.wait().expect("it ends").code(), Some(130));
    let (followed, fresh) = (follower.look(), Reader::new(&place.join("run")).look());
    let (followed, fresh) = (followed.expect("it is there"), fresh.expect("it is there"));
    assert_eq!(fresh.state, RunState::Interrupted);
    assert_eq!(followed, fresh);
}

/// Ten looks a second, and as many askings for its lock, from the first moment to the last.
#[test]
fn a_run_that_is_watched_ends_with_the_same_numbers_bit_for_bit() {
    let (place, mut watched) = begun(2e-4, "watched", "off");
    let place = place.path();
    let (mut looks, mut seen_running, mut reader) = (0, 0, Reader::new(&place.join("watched")));
    let status = loop {
        if let Some(status) = watched.try_wait().expect("it is asked") {
            break status;
        }
        if let Ok(seen) = reader.look() {
            looks += 1;
            seen_running += usize::from(seen.state == RunState::Running);
            assert_eq!(seen.trouble, None);
        }
        std::thread::sleep(Duration::from_millis(10));
    };
    assert!(status.success(), "{status}");
    assert!(!place.join("watched/progress.json").exists());
    assert!(looks > 10 && seen_running > 10, "{looks} looks, running in {seen_running}");
    assert!(start(place, "alone", "off").wait().expect("it ends").success());
    for name in ["fluid.h5", "solid.h5"] {
        let columns = |run: &str| {
            let file = hdf5::File::open(place.join(run).join(name)).expect("it opens");
            let mut names = Vec::new();
            datasets(&file, "", &mut names);
            let bits = |name: &String| {
                let values: Vec<f64> = file.dataset(name).and_then(|data| data.read_raw()).expect("numbers");
                (name.clone(), values.into_iter().map(f64::to_bits).collect::<Vec<_>>())
            };
            names.iter().map(bits).collect::<Vec<_>>()
        };
        let (watched, alone) = (columns("watched"), columns("alone"));
        assert!(watched.len() > 10 && watched[0].1.len() > 10);
        assert_eq!(watched, alone, "{name}");
    }
}

fn datasets(group: &hdf5::Group, path: &str, found: &mut Vec<String>) {
    for name in group.member_names().expect("members") {
        match group.group(&name) {
            Ok(inner) => datasets(&inner, &format!("{path}/{name}"), found),
            Err(_) => found.push(format!("{path}/{name}")),
        }
    }
}

#[test]
fn what_is_no_run_is_refused_with_code_2_and_what_there_is_is_told() {
    let place = tempfile::tempdir().expect("a directory");
    fs::create_dir(place.path().join("folder")).expect("a folder");
    for (arguments, fragment) in [
        (&["watch", "absent"][..], "absent, which is not there"),
        (&["watch", "folder"], "there is no run in folder; give the directory of a run"),
        (&["watch", "folder", "--every", "1ms"], "give a time from 0.1 s"),
        (&["watch"], "<RUN>"),
    ] {
        let output = cav(place.path(), arguments);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(said.contains(fragment), "{arguments:?}: {said}");
    }
}

#[test]
fn of_a_run_without_gas_no_radius_is_drawn() {
    let place = tempfile::tempdir().expect("a directory");
    let domain = fixture::grid([0.0, 0.01], 0.01, [16, 16]);
    let text = format!("[time]\nend = 1e-6\n{}{}", fixture::water(&domain, 1e5), fixture::pulse(3e-3));
    let text = text + "[coupling]\nscheme = \"rigid\"\n";
    fs::write(place.path().join("case.toml"), text).expect("the case is written");
    assert!(cav(place.path(), &["run", "case.toml", "--out", "run", "-q"]).status.success());
    let seen = Reader::new(&place.path().join("run")).look().expect("a run");
    let titles: Vec<&str> = seen.curves.iter().map(|titled| titled.title).collect();
    assert_eq!((seen.state, titles), (RunState::Finished, vec!["wall pressure on the axis"]));
}

#[test]
fn of_a_study_the_grid_under_way_is_seen_and_a_failed_run_says_why() {
    let place = tempfile::tempdir().expect("a directory");
    let place = place.path();
    fs::write(place.join("case.toml"), fixture::small("end = 1e-6\n", 2)).expect("the case is written");
    let made = cav(place, &["run", "case.toml", "--refine", "2", "--out", "study", "-q", "--in-process"]);
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let seen = Reader::new(&place.join("study")).look().expect("a study");
    assert_eq!((seen.grid, seen.state), (Some([1, 2]), RunState::Finished));
    // Before the second one has begun.
    fs::rename(place.join("study/grid-1"), place.join("later")).expect("it is there");
    let seen = Reader::new(&place.join("study")).look().expect("a study");
    assert_eq!((seen.grid, seen.state), (Some([0, 2]), RunState::Finished));
    fs::rename(place.join("later"), place.join("study/grid-1")).expect("it is there");
    // As a failed run leaves it.
    let summary = place.join("study/grid-0/summary.json");
    fs::write(&summary, "{\"completed\": false, \"error\": \"the time step collapsed\"}").expect("a summary");
    let seen = Reader::new(&place.join("study")).look().expect("a study");
    assert_eq!((seen.grid, seen.state), (Some([0, 2]), RunState::Failed));
    let output = cav(place, &["watch", "study"]);
    assert_eq!(output.status.code(), Some(0));
    let said = stdout(&output);
    assert!(said.contains("grid 0 of 0 to 1") && said.contains("error: the time step collapsed"), "{said}");
    // As one leaves it that was killed before its first batch.
    for name in ["fluid.h5", "solid.h5", "history.h5"] {
        fs::remove_file(place.join("study/grid-0").join(name)).expect("it was there");
    }
    let said = stdout(&cav(place, &["watch", "study/grid-0"]));
    assert!(said.contains("no step is in the files yet"), "{said}");
    fs::write(place.join("study/grid-0/fluid.h5"), "no HDF5").expect("a file");
    let said = stdout(&cav(place, &["watch", "study/grid-0"]));
    assert!(said.contains("cannot read") && said.contains("fluid.h5"), "{said}");
}

/// Whoever asks holds the directory for some microseconds, and must not look like another run.
#[test]
fn asking_whether_a_directory_is_held_keeps_no_run_from_beginning_there() {
    let place = tempfile::tempdir().expect("a directory");
    let path = place.path().join("run");
    let is_over = AtomicBool::new(false);
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                while !is_over.load(Ordering::Relaxed) {
                    let _ = is_held(&path);
                }
            });
        }
        let begun: Vec<_> = (0..200).map(|_| RunDirectory::prepare(&path, false).map(drop)).collect();
        is_over.store(true, Ordering::Relaxed);
        let refused: Vec<_> = begun.into_iter().filter_map(Result::err).collect();
        assert!(refused.is_empty(), "{} of 200: {}", refused.len(), refused[0]);
    });
}
