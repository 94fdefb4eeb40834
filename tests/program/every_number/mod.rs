//! Every number that a case can hold, alone at values that nobody means: the program refuses it with key and remedy, or runs
//! and ends, or runs on and hears Ctrl-C. It never panics, hangs, dies, or takes more memory than it says.

use std::collections::BTreeSet;
use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use cav::case::Case;
use rustix::process::{Pid, Signal, kill_process};
use toml::Value;

mod cases;

/// What each number is set to. Whole numbers get the largest there is, too.
const VALUES: [&str; 8] = ["0", "-1", "1e-300", "1e-30", "1e30", "1e300", "nan", "inf"];
const LARGEST_WHOLE: &str = "9223372036854775807";
/// A run of that many may be at work at once.
const AT_ONCE: usize = 3;
/// Runs that take longer are asked to stop: many times what a case takes as it is given.
const LONG: Duration = Duration::from_secs(1);
/// By then a run that was asked to stop has ended; most of it is for machines that are busy.
const STOPPED: Duration = Duration::from_secs(5);
/// By then a run has begun, or is lost.
const BEGUN: Duration = Duration::from_secs(30);

/// The paths of the numbers in a document, and whether each is a whole one.
fn numbers(value: &Value, path: &str, found: &mut Vec<(String, bool)>) {
    let below = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
    match value {
        Value::Table(table) => table.iter().for_each(|(key, value)| numbers(value, &below(key), found)),
        Value::Array(array) => {
            array.iter().enumerate().for_each(|(k, value)| numbers(value, &below(&k.to_string()), found));
        }
        Value::Integer(_) => found.push((path.to_owned(), true)),
        Value::Float(_) => found.push((path.to_owned(), false)),
        Value::String(_) | Value::Boolean(_) | Value::Datetime(_) => {}
    }
}

fn numbers_of(text: &str) -> Vec<(String, bool)> {
    let mut found = Vec::new();
    numbers(&Value::Table(text.parse().unwrap()), "", &mut found);
    found
}

/// A path without the numbers of elements.
fn keys_alone(path: &str) -> Vec<&str> {
    path.split('.').filter(|key| key.parse::<usize>().is_err()).collect()
}

/// One number set to one value.
struct Trial {
    /// The case's text, as it is given or with all defaults filled in.
    text: String,
    name: &'static str,
    path: String,
    value: &'static str,
    /// In two processes.
    two: bool,
}

/// All of them: numbers that a case's author may have written in the author's text, those that have defaults in the text
/// with them.
fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    for (name, text) in cases::all() {
        let case = Case::from_toml(&text, name, &[]).unwrap_or_else(|errors| panic!("{errors}"));
        let whole = case.effective_toml();
        let own = numbers_of(&text);
        let is_own = |path: &str| own.iter().any(|(known, _)| known == path);
        let filled: Vec<_> = numbers_of(&whole).into_iter().filter(|(path, _)| !is_own(path)).collect();
        for (text, (path, is_whole)) in own
            .iter()
            .map(|number| (text.as_str(), number))
            .chain(filled.iter().map(|number| (whole.as_str(), number)))
        {
            let two = name == cases::IN_TWO && path.starts_with("coupling.");
            for value in VALUES.into_iter().chain(is_whole.then_some(LARGEST_WHOLE)) {
                let (text, path) = (text.to_owned(), path.clone());
                trials.push(Trial { text, name, path, value, two });
            }
        }
    }
    trials
}

/// What a run came to.
struct Outcome {
    code: Option<i32>,
    said: String,
    was_asked: bool,
    /// The largest memory seen, bytes.
    memory: u64,
}

/// The largest memory of a process so far, bytes.
fn peak_memory(pid: u32) -> u64 {
    let text = fs::read_to_string(format!("/proc/{pid}/status")).unwrap_or_default();
    let row = text.lines().find_map(|row| row.strip_prefix("VmHWM:"));
    row.and_then(|row| row.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()).map_or(0, |kib| kib << 10)
}

fn ask(child: &Child, signal: Signal) {
    if let Some(pid) = i32::try_from(child.id()).ok().and_then(Pid::from_raw) {
        let _ = kill_process(pid, signal);
    }
}

/// Runs `cav run` with one number changed; `None` if it had to be killed.
fn run(trial: &Trial, directory: &Path, most_memory: u64) -> Option<Outcome> {
    let (case, out) = (directory.join("case.toml"), directory.join("out"));
    fs::write(&case, &trial.text).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_cav"));
    command.arg("run").arg(&case).arg("--out").arg(&out);
    command.args(["-q", "--threads", "1", "--checkpoint-every", "off", "--set"]);
    command.arg(format!("{}={}", trial.path, trial.value));
    if !trial.two {
        command.arg("--in-process");
    }
    let mut child =
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let mut errors = child.stderr.take().unwrap();
    let reader = std::thread::spawn(move || {
        let mut said = Vec::new();
        let _ = errors.read_to_end(&mut said);
        String::from_utf8_lossy(&said).into_owned()
    });
    let (begin, mut asked, mut memory) = (Instant::now(), None::<Instant>, 0);
    loop {
        memory = memory.max(peak_memory(child.id()));
        if let Some(status) = child.try_wait().unwrap() {
            let said = reader.join().unwrap();
            return Some(Outcome { code: status.code(), said, was_asked: asked.is_some(), memory });
        }
        let has_begun = out.join("case.toml").exists();
        if asked.is_none() && begin.elapsed() > LONG && has_begun {
            ask(&child, Signal::INT);
            asked = Some(Instant::now());
        }
        let is_lost = asked.map_or(begin.elapsed() > BEGUN, |asked| asked.elapsed() > STOPPED);
        if is_lost || memory > most_memory {
            ask(&child, Signal::TERM);
            std::thread::sleep(Duration::from_millis(200));
            ask(&child, Signal::KILL);
            let _ = child.wait();
            return None;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// What is wrong with how a run ended; nothing if all is well.
fn fault(trial: &Trial, outcome: Option<&Outcome>, most_memory: u64) -> Option<String> {
    let Some(outcome) = outcome else {
        return Some("had to be killed: it hung, or took too much memory".to_owned());
    };
    let said = &outcome.said;
    if said.contains("panicked") {
        return Some(format!("panics: {said}"));
    }
    if outcome.memory > most_memory {
        return Some(format!("takes {} bytes where {most_memory} are announced", outcome.memory));
    }
    match outcome.code {
        Some(0) => None,
        Some(130) if outcome.was_asked => None,
        // A state that is not physical, a step that collapses: the remedy is part of the message.
        Some(3) => (!said.contains("try a smaller time.cfl")).then(|| format!("no remedy: {said}")),
        Some(2) => {
            let keys = keys_alone(&trial.path);
            let (last, tables) = keys.split_last().unwrap();
            // The key, or the table that it is in, if it is not one of the largest.
            let names_it = said.contains(&format!("{last}:"))
                || said.contains(&format!(".{last}"))
                || said.contains(&format!("`{last}`"))
                || said.contains(&format!(" {last} = "))
                || tables.len() > 1 && said.contains(&tables.join("."));
            let has_remedy = said.contains("help:");
            (!(names_it && has_remedy)).then(|| format!("does not name the key, or no remedy: {said}"))
        }
        other => Some(format!("ends with {other:?}: {said}")),
    }
}

/// The memory that a case is said to take at the most, bytes; that of a bare process if it is refused.
fn announced(trial: &Trial) -> u64 {
    const BARE: f64 = 64e6;
    let set = format!("{}={}", trial.path, trial.value);
    let bytes = Case::from_toml(&trial.text, "case", &[set]).map_or(BARE, |case| {
        [case.fluid_memory(), case.solid_memory()].iter().flatten().map(|memory| memory.most).sum()
    });
    bytes as u64
}

#[test]
fn no_number_of_a_case_panics_hangs_or_takes_more_memory_than_announced() {
    let (trials, next) = (trials(), AtomicUsize::new(0));
    let wrong = Mutex::new(Vec::new());
    let work = || {
        let directory = tempfile::tempdir().unwrap();
        while let Some(trial) = trials.get(next.fetch_add(1, Ordering::Relaxed)) {
            let _ = fs::remove_dir_all(directory.path().join("out"));
            let most = announced(trial);
            if let Some(fault) = fault(trial, run(trial, directory.path(), most).as_ref(), most) {
                wrong
                    .lock()
                    .unwrap()
                    .push(format!("{}: {}={}: {fault}", trial.name, trial.path, trial.value));
            }
        }
    };
    std::thread::scope(|scope| {
        (0..AT_ONCE).for_each(|_| {
            scope.spawn(work);
        });
    });
    let wrong = wrong.into_inner().unwrap();
    assert!(trials.len() > 1000, "{}", trials.len());
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), trials.len(), wrong.join("\n"));
}

#[test]
fn the_cases_hold_every_number_that_is_read() {
    let walked: BTreeSet<String> = trials()
        .iter()
        .filter_map(|trial| keys_alone(&trial.path).last().map(|key| (*key).to_owned()))
        .collect();
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/case");
    let mut read = BTreeSet::new();
    // Keys are read by the files beside each other; folders below declare, draw and write them.
    let files =
        fs::read_dir(sources).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_file());
    for path in files {
        let mut text = fs::read_to_string(path).unwrap();
        text.retain(|c| !c.is_whitespace());
        let getters = [
            "number",
            "numbers",
            "positive",
            "required",
            "required_positive",
            "pair",
            "required_pair",
            "range",
            "whole",
            "whole_pair",
            "waiting",
        ];
        for call in getters
            .map(|getter| format!(".{getter}(\""))
            .into_iter()
            .chain(["history(&muttable,\"".to_owned()])
        {
            read.extend(
                text.split(&call).skip(1).filter_map(|rest| Some(rest.split_once('"')?.0.to_owned())),
            );
        }
    }
    assert!(read.len() > 30, "{read:?}");
    let forgotten: Vec<&String> = read.difference(&walked).collect();
    assert!(forgotten.is_empty(), "no case in tests/program/every_number/cases.rs has {forgotten:?}");
}
