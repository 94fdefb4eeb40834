//! `cav run`: one process, or two children of its own executable that are started and watched.

use std::ffi::OsString;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc;
use std::time::{Duration, Instant, SystemTime};

use coupler::{Participant, Scheme, clean_up_dead};
use rustix::process::{Pid, Signal, kill_process};
use serde_json::Map;

use super::checkpoints::Checkpoints;
use super::conclusion::{closing_words, conclude};
use super::drive::{Keeping, in_process};
use super::stop::Stop;
use super::{RunError, drive};
use crate::case::Case;
use crate::output::run_directory::{CASE, FLUID_HISTORY, LOG, SOLID_HISTORY};
use crate::output::{Join, Progress, ProgressLine, RunDirectory, join_histories};

/// What the command line says besides the case.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The case file and its changes, for the children.
    pub case_path: PathBuf,
    /// `--set`.
    pub sets: Vec<String>,
    /// `--out`.
    pub out: Option<PathBuf>,
    /// `--force`.
    pub force: bool,
    /// `--in-process`.
    pub in_process: bool,
    /// `--threads`, per process.
    pub threads: Option<usize>,
    /// `--checkpoint-every`; `None` for no checkpoints.
    pub checkpoint_every: Option<Duration>,
    /// The step of the checkpoint to go on from.
    pub from: Option<u64>,
    /// What the case is called, if not as its file.
    pub name: Option<String>,
    /// The command that is this program, for the children; this process's own executable if empty.
    pub program: Vec<OsString>,
    /// `-q`.
    pub quiet: bool,
    /// `-v`, counted.
    pub verbosity: u8,
}

impl Options {
    /// What of them is about checkpoints.
    fn keeping(&self) -> Keeping {
        Keeping { from: self.from, every: self.checkpoint_every }
    }
}

/// How long the other child may take to end after one has failed.
const GRACE: Duration = Duration::from_secs(5);
/// How often the children are looked at.
const LOOK_INTERVAL: Duration = Duration::from_millis(50);

/// The run directory: the command line's, the case's, or one by the case's name.
pub fn directory_of(case: &Case, out: Option<&Path>) -> PathBuf {
    out.map(Path::to_path_buf)
        .or_else(|| case.output.directory.clone())
        .unwrap_or_else(|| Path::new("runs").join(&case.name))
}

/// Runs a case and leaves a run directory.
///
/// - errors: see [`RunError`]; what was computed is written in any case.
/// - `on_directory`: told of the run directory as soon as it is there, for the log.
pub fn run(
    case: &Case,
    options: &Options,
    stop: &Stop,
    on_directory: impl FnOnce(&Path),
) -> Result<PathBuf, RunError> {
    if case.coupling.scheme == Scheme::External {
        let side = if case.fluid.is_some() { "fluid" } else { "solid" };
        return Err(RunError::PeerIsElsewhere { side });
    }
    let directory = prepare(case, options)?;
    on_directory(directory.path());
    carry_out(case, options, &directory, stop)
}

/// Runs a case in its directory, from the start or from a checkpoint.
pub(super) fn carry_out(
    case: &Case,
    options: &Options,
    directory: &RunDirectory,
    stop: &Stop,
) -> Result<PathBuf, RunError> {
    log_case(case);
    let coupled = case.fluid.is_some() && case.solid.is_some();
    let mut progress = Progress::new(case.time.end, options.quiet, options.verbosity);
    for warning in case.warnings() {
        tracing::warn!("{warning}");
        progress.message(&format!("warning: {warning}"));
    }
    let result = if coupled && !options.in_process {
        two_processes(options, directory, stop, &mut progress)
    } else {
        let threads = thread_pool(options.threads)?;
        let mut on_step = |line: &ProgressLine| progress.update(line);
        threads.install(|| in_process(case, directory, options.keeping(), stop, &mut on_step))
    };
    let whole = match (conclude(directory), &result) {
        (Ok(whole), _) => whole,
        (Err(error), Ok(())) => return Err(error),
        (Err(error), Err(_)) => {
            // What went wrong first says more.
            tracing::warn!("{error}");
            Map::new()
        }
    };
    match &result {
        Ok(()) => {
            let words = closing_words(&whole, directory.path());
            tracing::info!("{words}");
            progress.finish(&words);
        }
        Err(_) => {
            progress.clear();
            if Checkpoints::of(case, directory).are_there() {
                progress.message(&format!("go on with: cav run --resume {}", directory.path().display()));
            }
        }
    }
    result.map(|()| directory.path().to_path_buf())
}

/// Makes the run directory ready and puts the effective case there.
pub fn prepare(case: &Case, options: &Options) -> Result<RunDirectory, RunError> {
    let path = directory_of(case, options.out.as_deref());
    let directory = RunDirectory::prepare(&path, options.force).map_err(RunError::Directory)?;
    directory.write_atomic(CASE, case.effective_toml().as_bytes())?;
    Ok(directory)
}

/// What the log begins with.
pub fn log_case(case: &Case) {
    let hash: String = case.hash().iter().map(|byte| format!("{byte:02x}")).collect();
    tracing::info!(version = env!("CARGO_PKG_VERSION"), case = case.name, hash, "run");
}

/// A pool of worker threads; all processors unless told otherwise.
pub fn thread_pool(threads: Option<usize>) -> Result<rayon::ThreadPool, RunError> {
    rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build().map_err(|error| {
        RunError::Start { what: "the worker threads".to_owned(), source: std::io::Error::other(error) }
    })
}

/// A side's process.
struct Side {
    name: &'static str,
    child: Child,
    code: Option<u8>,
    signal: Option<i32>,
}

/// A run id that no other run on the machine has: process and time.
pub fn new_run_id() -> String {
    let nanoseconds = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).map_or(0, |t| t.as_nanos());
    format!("{}-{:x}", std::process::id(), nanoseconds)
}

fn two_processes(
    options: &Options,
    directory: &RunDirectory,
    stop: &Stop,
    progress: &mut Progress,
) -> Result<(), RunError> {
    let run_id = new_run_id();
    let (lines, received) = mpsc::channel::<ProgressLine>();
    let mut sides = Vec::new();
    // If the launcher is killed, they hold the directory until they have ended.
    directory.share_lock(true)?;
    for participant in [Participant::Fluid, Participant::Solid] {
        match start(participant.name(), &run_id, options, directory, lines.clone()) {
            Ok(side) => sides.push(side),
            Err(error) => {
                sides.iter_mut().for_each(|side| forward(side, Signal::TERM));
                return Err(error);
            }
        }
    }
    drop(lines);
    directory.share_lock(false)?;
    let mut asked = 0;
    let mut first_end: Option<Instant> = None;
    let mut joined = false;
    while sides.iter().any(|side| side.code.is_none() && side.signal.is_none()) {
        match received.recv_timeout(LOOK_INTERVAL) {
            Ok(line) => {
                progress.update(&line);
                if !joined && line.step > 0 {
                    // So that a run whose launcher is killed can be read, too.
                    join_histories(directory.path(), &[FLUID_HISTORY, SOLID_HISTORY], Join::Links)?;
                    joined = true;
                }
            }
            Err(mpsc::RecvTimeoutError::Timeout) => {}
            Err(mpsc::RecvTimeoutError::Disconnected) => std::thread::sleep(LOOK_INTERVAL),
        }
        let wanted = stop.flags();
        if wanted != asked {
            asked = wanted;
            let signal =
                if wanted == coupler::FrameHeader::STOP_TERMINATE { Signal::TERM } else { Signal::INT };
            sides.iter_mut().for_each(|side| forward(side, signal));
        }
        for side in &mut sides {
            look(side)?;
        }
        if sides.iter().any(|side| side.signal.is_some() || side.code.is_some_and(|code| code != 0)) {
            let since = *first_end.get_or_insert_with(Instant::now);
            if since.elapsed() > GRACE {
                for side in sides.iter_mut().filter(|side| side.code.is_none() && side.signal.is_none()) {
                    forward(side, Signal::KILL);
                }
            }
        }
    }
    if sides.iter().any(|side| side.signal.is_some()) {
        // A killed process leaves its shared memory to whoever comes next: to us.
        clean_up_dead(&coupler::Domain::default())?;
    }
    verdict(&sides)
}

fn start(
    name: &'static str,
    run_id: &str,
    options: &Options,
    directory: &RunDirectory,
    lines: mpsc::Sender<ProgressLine>,
) -> Result<Side, RunError> {
    let fail = |source| RunError::Start { what: format!("the {name}'s process"), source };
    let mut command = match options.program.split_first() {
        Some((program, arguments)) => {
            let mut command = Command::new(program);
            command.args(arguments);
            command
        }
        None => Command::new(std::env::current_exe().map_err(fail)?),
    };
    command
        .arg(name)
        .arg(&options.case_path)
        .args(["--run", run_id, "--child", "--out"])
        .arg(directory.path());
    for set in &options.sets {
        command.args(["--set", set]);
    }
    if let Some(threads) = options.threads {
        command.args(["--threads", &threads.to_string()]);
    }
    let every =
        options.checkpoint_every.map_or_else(|| "off".to_owned(), |every| every.as_secs_f64().to_string());
    command.args(["--checkpoint-every", &every]);
    if let Some(step) = options.from {
        command.args(["--from", &step.to_string()]);
    }
    if let Some(name) = &options.name {
        command.args(["--name", name]);
    }
    if options.quiet {
        command.arg("-q");
    }
    command.args((0..options.verbosity).map(|_| "-v"));
    // A group of its own: Ctrl-C reaches the launcher alone, which passes it on.
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    let mut child = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::inherit())
        .spawn()
        .map_err(fail)?;
    if let Some(stdout) = child.stdout.take() {
        std::thread::spawn(move || {
            for line in BufReader::new(stdout).lines().map_while(Result::ok) {
                if let Some(line) = ProgressLine::from_json(&line) {
                    // The launcher may have ended already.
                    let _ = lines.send(line);
                }
            }
        });
    }
    tracing::debug!(name, pid = child.id(), "started");
    Ok(Side { name, child, code: None, signal: None })
}

fn look(side: &mut Side) -> Result<(), RunError> {
    if side.code.is_some() || side.signal.is_some() {
        return Ok(());
    }
    let ended = side.child.try_wait();
    let status =
        ended.map_err(|source| RunError::Start { what: format!("a look at the {}", side.name), source })?;
    if let Some(status) = status {
        side.code = status.code().and_then(|code| u8::try_from(code).ok());
        if side.code.is_none() {
            side.signal = Some(std::os::unix::process::ExitStatusExt::signal(&status).unwrap_or(0));
        }
    }
    Ok(())
}

fn forward(side: &mut Side, signal: Signal) {
    let pid = i32::try_from(side.child.id()).ok().and_then(Pid::from_raw);
    if let (None, None, Some(pid)) = (side.code, side.signal, pid)
        && let Err(error) = kill_process(pid, signal)
    {
        tracing::debug!(%error, name = side.name, "already gone");
    }
}

/// What the ends of both processes mean together: the cause, not its consequence on the other side.
fn verdict(sides: &[Side]) -> Result<(), RunError> {
    if let Some(side) = sides.iter().find(|side| side.signal.is_some()) {
        let signal = side.signal.unwrap_or(0);
        let what = format!("was killed by signal {signal}; the other side ended, what it had is written");
        return Err(RunError::Child { side: side.name, pid: side.child.id(), what, log: LOG, code: 4 });
    }
    let failed = |code: &&Side| code.code.is_some_and(|code| code != 0);
    if sides.iter().any(|side| side.code == Some(143)) {
        return Err(RunError::Terminated);
    }
    if sides.iter().any(|side| side.code == Some(130)) {
        return Err(RunError::Interrupted);
    }
    // A peer failure (4) is most often the other side's failure seen from here.
    let cause = sides.iter().filter(failed).find(|side| side.code != Some(4)).or(sides.iter().find(failed));
    match cause {
        None => Ok(()),
        Some(side) => {
            let code = side.code.unwrap_or(4);
            let what = format!("ended with exit code {code}");
            Err(RunError::Child { side: side.name, pid: side.child.id(), what, log: LOG, code })
        }
    }
}

/// Whether a case has this side, and a peer to meet.
fn is_side(case: &Case, participant: Participant) -> bool {
    let here = match participant {
        Participant::Fluid => case.fluid.is_some(),
        Participant::Solid => case.solid.is_some(),
    };
    here && case.coupling.scheme.is_coupled()
}

/// One side by hand or as a child of the launcher.
pub fn run_side(
    case: &Case,
    options: &Options,
    joining: drive::Joining,
    child: bool,
    stop: &Stop,
    on_directory: impl FnOnce(&Path) + Send,
) -> Result<(), RunError> {
    // Before anything is made.
    coupler::check_run_id(&joining.run_id)?;
    if !is_side(case, joining.participant) {
        return Err(RunError::NoPeer { side: joining.participant.name() });
    }
    let path = directory_of(case, options.out.as_deref());
    let alone = case.coupling.scheme == Scheme::External;
    let leads = (joining.participant == Participant::Fluid || alone) && !child;
    // By hand the fluid makes the directory before the solid can find it, and both leave the summary.
    let prepared = if leads { Some(prepare(case, options)?) } else { None };
    let directory = || {
        let directory = match prepared {
            Some(directory) => directory,
            None => RunDirectory::open(&path).map_err(RunError::Directory)?,
        };
        on_directory(directory.path());
        log_case(case);
        Ok(directory)
    };
    let mut progress = Progress::new(case.time.end, options.quiet || child || !leads, options.verbosity);
    let mut throttle = crate::output::progress::Throttle::new(Duration::from_millis(100));
    let participant = joining.participant;
    let mut on_step = |line: &ProgressLine| {
        if child && participant == Participant::Fluid && throttle.is_due() {
            announce(line);
        }
        progress.update(line);
    };
    let threads = thread_pool(options.threads)?;
    let result = threads.install(|| {
        let quiet = options.quiet;
        let notice: coupler::Notice = Box::new(move |words| {
            tracing::warn!("{words}");
            if !quiet {
                eprintln!("{words}");
            }
        });
        let joining = drive::Joining { notice: Some(notice), ..joining };
        drive::joined(case, joining, directory, options.keeping(), stop, &mut on_step)
    });
    if !child && path.exists() {
        let directory = RunDirectory::open(&path).map_err(RunError::Directory)?;
        // Both sides do this, one after the other: the last one finds both parts.
        let _turn = directory.wait_for_lock()?;
        conclude(&directory)?;
    }
    result
}

/// A line for the launcher on standard output; it does not matter if nobody listens any more.
fn announce(line: &ProgressLine) {
    use std::io::Write;
    let mut out = std::io::stdout().lock();
    let _ = writeln!(out, "{}", line.to_json()).and_then(|()| out.flush());
}
