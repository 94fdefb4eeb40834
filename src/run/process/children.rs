//! The two processes of a run: started, watched, asked to stop, and what their ends mean together.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc;
use std::time::{Duration, Instant};

use coupler::{Participant, clean_up_dead};
use humantime::format_duration;
use rustix::process::{Pid, Signal, kill_process};

use crate::output::run_directory::{FLUID_HISTORY, LOG, SOLID_HISTORY};
use crate::output::{Join, Progress, ProgressLine, RunDirectory, join_histories};
use crate::run::RunError;
use crate::run::process::launch_options::{Options, new_run_id};
use crate::run::process::stop::Stop;

/// How long the other child may take to end after one has failed.
const GRACE: Duration = Duration::from_secs(5);
/// How often the children are looked at.
const LOOK_INTERVAL: Duration = Duration::from_millis(50);

/// A side's process.
struct Side {
    name: &'static str,
    child: Child,
    code: Option<u8>,
    signal: Option<i32>,
}

/// Both sides of a run in processes of their own, until both have ended.
pub(super) fn two_processes(
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
        options.checkpoint_every.map_or_else(|| "off".to_owned(), |every| format_duration(every).to_string());
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
