//! Runs as processes: started, signalled, looked for, one after the other.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::{PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};
use std::time::{Duration, Instant};

/// A process that is started while another test has a file open in this process gets that file, too, and with it the HDF5
/// library's lock on it.
static TURN: RwLock<()> = RwLock::new(());

/// Held by tests that start processes: one after the other, and beside no other.
pub fn alone() -> RwLockWriteGuard<'static, ()> {
    TURN.write().unwrap_or_else(PoisonError::into_inner)
}

/// Held by tests that run all in this process: they may run beside each other.
pub fn without_processes() -> RwLockReadGuard<'static, ()> {
    TURN.read().unwrap_or_else(PoisonError::into_inner)
}

/// A directory with a case and its runs.
pub struct Workshop {
    directory: tempfile::TempDir,
}

impl Workshop {
    /// With `text` as `case.toml`.
    pub fn with(text: &str) -> Self {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join("case.toml"), text).unwrap();
        Self { directory }
    }

    pub fn file(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    /// `cav run case.toml --out NAME ...`.
    pub fn cav(&self, out: &str, more: &[&str]) -> Command {
        let mut cav = self.of_case(&["--out"]);
        cav.arg(self.file(out)).args(more);
        cav
    }

    /// `cav run case.toml ...`.
    pub fn of_case(&self, more: &[&str]) -> Command {
        self.of_case_file("case.toml", more)
    }

    /// `cav run NAME ...`.
    pub fn of_case_file(&self, name: &str, more: &[&str]) -> Command {
        let mut cav = cav(&["run"]);
        cav.arg(self.file(name)).args(more);
        cav
    }

    /// `cav fluid case.toml --out NAME --run ID ...`, or the solid's side.
    pub fn side(&self, side: &str, out: &str, id: &str, more: &[&str]) -> Command {
        let mut cav = cav(&[side]);
        cav.arg(self.file("case.toml")).arg("--out").arg(self.file(out)).args(["--run", id]).args(more);
        cav
    }

    /// `cav run --resume NAME ...`.
    pub fn resume(&self, out: &str, more: &[&str]) -> Command {
        let mut cav = cav(&["run", "--resume"]);
        cav.arg(self.file(out)).args(more);
        cav
    }

    pub fn done(&self, out: &str, more: &[&str]) {
        let output = self.cav(out, more).output().unwrap();
        assert!(output.status.success(), "{}", text(&output));
    }
}

fn cav(arguments: &[&str]) -> Command {
    let mut cav = Command::new(env!("CARGO_BIN_EXE_cav"));
    cav.args(arguments).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    cav
}

pub fn text(output: &Output) -> String {
    format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr))
}

/// The living processes of this program whose command line names this directory: number and subcommand.
pub fn processes_of(out: &Path) -> Vec<(u32, String)> {
    let wanted = out.to_string_lossy().into_owned();
    let mut found = Vec::new();
    for entry in fs::read_dir("/proc").unwrap().flatten() {
        let Ok(pid) = entry.file_name().to_string_lossy().parse::<u32>() else { continue };
        let line = fs::read(entry.path().join("cmdline")).unwrap_or_default();
        let words: Vec<String> =
            line.split(|b| *b == 0).map(|w| String::from_utf8_lossy(w).into_owned()).collect();
        let is_zombie = fs::read_to_string(entry.path().join("stat")).is_ok_and(|s| s.contains(") Z "));
        if words.first().is_some_and(|w| w.ends_with("cav")) && words.contains(&wanted) && !is_zombie {
            found.push((pid, words[1].clone()));
        }
    }
    found
}

/// The number of the process of a run that is "fluid", "solid" or "run"; `None` if there is none (any more).
pub fn process_of(out: &Path, name: &str) -> Option<u32> {
    processes_of(out).into_iter().find(|(_, command)| command == name).map(|(pid, _)| pid)
}

pub fn wait_until(what: &str, limit: Duration, mut done: impl FnMut() -> bool) {
    let begin = Instant::now();
    while !done() {
        assert!(begin.elapsed() < limit, "waited {limit:?} for: {what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Signals one process by its number, and says whether it was there; it may be gone by then.
pub fn signal(pid: u32, signal: &str) -> bool {
    Command::new("kill").args([signal, &pid.to_string()]).stderr(Stdio::null()).status().unwrap().success()
}

/// Waits until a run has kept a checkpoint that has both parts.
pub fn until_checkpoint(out: &Path, run: &mut Child) {
    wait_until("a checkpoint", Duration::from_secs(60), || {
        assert!(run.try_wait().unwrap().is_none(), "the run ended early");
        checkpoints(out).iter().any(|name| name.starts_with("solid"))
    });
}

/// Names of the files of checkpoints.
pub fn checkpoints(out: &Path) -> Vec<String> {
    let entries = fs::read_dir(out.join("checkpoints")).into_iter().flatten().flatten();
    let mut names: Vec<String> =
        entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// Shared objects of this program. Their names do not say whose they are: to be asked where no other run is under way.
pub fn segments() -> Vec<String> {
    let names = fs::read_dir("/dev/shm").unwrap().flatten();
    let names = names.map(|entry| entry.file_name().to_string_lossy().into_owned());
    names.filter(|name| name.starts_with("cav_")).collect()
}

/// Asserts that nothing but the files of a finished run is in its directory, with one checkpoint at the most.
pub fn assert_tidy(out: &Path) {
    let known = [
        "case.toml",
        "checkpoints",
        "fluid.h5",
        "fluid.json",
        "fluid.vtkhdf",
        "history.h5",
        "log",
        "solid.h5",
        "solid.json",
        "solid.vtkhdf",
        "summary.json",
    ];
    for entry in fs::read_dir(out).unwrap().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        assert!(known.contains(&name.as_str()), "{name} is left in {}", out.display());
    }
    let parts = checkpoints(out);
    let is_one = parts.len() == 2 && parts[0].replace("fluid", "solid") == parts[1];
    assert!(parts.is_empty() || is_one, "{parts:?} are left in {}", out.display());
}
