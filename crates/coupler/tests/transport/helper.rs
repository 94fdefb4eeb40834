//! Starting the participant with no physics and looking at what it leaves behind.

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdout, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use coupler::{Domain, Endpoint, Participant};

/// Nothing here takes that long; a hang shall fail, not block.
const LIMIT: Duration = Duration::from_secs(9);

/// A domain of one test; its traces are removed at the end.
pub struct Scene {
    pub domain: Domain,
    pub run_id: String,
}

impl Scene {
    pub fn new() -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let n = COUNT.fetch_add(1, Ordering::Relaxed);
        let pid = std::process::id();
        let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap().as_nanos();
        let domain =
            Domain { prefix: format!("cavt{pid}-{n}_"), root: PathBuf::from(format!("/tmp/cavt-{pid}-{n}")) };
        Self { domain, run_id: format!("{pid}-{now}-{n}") }
    }

    /// This process as a participant.
    pub fn endpoint(&self, name: Participant) -> Endpoint {
        Endpoint { domain: self.domain.clone(), ..Endpoint::new(self.run_id.clone(), name, [0; 32]) }
    }

    /// Another process as a participant, with the helper's options separated by spaces.
    pub fn start(&self, name: &str, options: &str) -> Actor {
        let mut child = Command::new(env!("CARGO_BIN_EXE_participant"))
            .args(["--name", name, "--run", &self.run_id, "--prefix", &self.domain.prefix])
            .arg("--root")
            .arg(&self.domain.root)
            .args(options.split_whitespace())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let stdout = BufReader::new(child.stdout.take().unwrap());
        Actor { child, stdout }
    }

    /// A fluid that waits for its solid.
    pub fn waiting_fluid(&self, options: &str) -> Actor {
        let fluid = self.start("fluid", options);
        std::thread::sleep(Duration::from_millis(150));
        fluid
    }

    /// Both at once with the same options.
    pub fn start_pair(&self, options: &str) -> (Actor, Actor) {
        (self.start("fluid", options), self.start("solid", options))
    }

    /// Both end well, and leave nothing.
    pub fn ends_well(&self, (fluid, solid): (Actor, Actor)) {
        fluid.end().assert_done();
        solid.end().assert_done();
        self.assert_clean();
    }

    /// A run in which one leaves, each with its options; what the other says of it has all of `words`.
    pub fn one_leaves(&self, leaver: [&str; 2], other: [&str; 2], words: &[&str]) {
        let [leaver, other] = [leaver, other].map(|[name, options]| self.start(name, options));
        leaver.end().assert_done();
        other.end().assert_refused(words);
        self.assert_clean();
    }

    /// Both, once they have met.
    pub fn connected_pair(&self, options: &str) -> (Actor, Actor) {
        let (mut fluid, mut solid) = self.start_pair(options);
        fluid.connected();
        solid.connected();
        (fluid, solid)
    }

    /// Both to their end.
    pub fn run_pair(&self, options: &str) {
        let (fluid, solid) = self.start_pair(options);
        fluid.end().assert_done();
        solid.end().assert_done();
    }

    /// What lies in shared memory.
    pub fn shared_objects(&self) -> Vec<String> {
        names(Path::new("/dev/shm")).filter(|name| name.starts_with(&self.domain.prefix)).collect()
    }

    /// Files and sockets, not directories, below the root.
    pub fn files(&self) -> Vec<String> {
        let mut found = Vec::new();
        let mut dirs = vec![self.domain.root.clone()];
        while let Some(dir) = dirs.pop() {
            for entry in fs::read_dir(dir).into_iter().flatten().flatten() {
                match entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                    true => dirs.push(entry.path()),
                    false => found.push(entry.path().display().to_string()),
                }
            }
        }
        found
    }

    /// The state after a run: nothing is left.
    pub fn assert_clean(&self) {
        assert_eq!(self.shared_objects(), Vec::<String>::new(), "left in /dev/shm");
        assert_eq!(self.files(), Vec::<String>::new(), "left below the root");
    }
}

impl Drop for Scene {
    fn drop(&mut self) {
        for name in self.shared_objects() {
            let _ = fs::remove_file(format!("/dev/shm/{name}"));
        }
        let _ = fs::remove_dir_all(&self.domain.root);
    }
}

fn names(dir: &Path) -> impl Iterator<Item = String> {
    fs::read_dir(dir).into_iter().flatten().flatten().filter_map(|entry| entry.file_name().into_string().ok())
}

/// A running helper; killed if the test ends before it does.
pub struct Actor {
    child: Child,
    stdout: BufReader<ChildStdout>,
}

/// How a helper ended.
#[derive(Debug)]
pub struct End {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Actor {
    pub fn pid(&self) -> u32 {
        self.child.id()
    }

    /// Blocks until it says that it is connected.
    pub fn connected(&mut self) -> &mut Self {
        let mut line = String::new();
        self.stdout.read_line(&mut line).unwrap();
        assert!(line.starts_with("connected to the"), "{line:?}");
        self
    }

    pub fn kill(mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }

    pub fn signal(&self, signal: rustix::process::Signal) {
        let pid = rustix::process::Pid::from_child(&self.child);
        rustix::process::kill_process(pid, signal).unwrap();
    }

    /// Processor time so far, to a hundredth of a second.
    pub fn cpu_seconds(&self) -> f64 {
        let stat = fs::read_to_string(format!("/proc/{}/stat", self.pid())).unwrap();
        let after_name = stat.rsplit_once(") ").unwrap().1;
        let ticks: Vec<f64> =
            after_name.split(' ').skip(11).take(2).map(|word| word.parse().unwrap()).collect();
        (ticks[0] + ticks[1]) / 100.0
    }

    pub fn end(mut self) -> End {
        let start = Instant::now();
        let status = loop {
            if let Some(status) = self.child.try_wait().unwrap() {
                break status;
            }
            assert!(start.elapsed() < LIMIT, "still running after {LIMIT:?}");
            thread::sleep(Duration::from_millis(2));
        };
        let (mut stdout, mut stderr) = (String::new(), String::new());
        self.stdout.read_to_string(&mut stdout).unwrap();
        self.child.stderr.take().unwrap().read_to_string(&mut stderr).unwrap();
        End { code: status.code(), stdout, stderr }
    }
}

impl Drop for Actor {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl End {
    pub fn assert_done(&self) {
        assert_eq!((self.code, self.stderr.as_str()), (Some(0), ""));
    }

    /// Ended with the exit code of a coupling error that says all of this.
    pub fn assert_refused(&self, words: &[&str]) {
        assert_eq!(self.code, Some(4), "{self:?}");
        for word in words {
            assert!(self.stderr.contains(word), "{word:?} is not in {:?}", self.stderr);
        }
    }
}
