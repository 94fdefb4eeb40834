//! A participant with no physics: what a developer runs first, and what the tests of the transport run.
//!
//! In two terminals, in either order:
//!
//! ```text
//! cargo run --release -p coupler --bin participant -- --name fluid --run try --steps 1000 --faces 500
//! cargo run --release -p coupler --bin participant -- --name solid --run try --steps 1000 --faces 500
//! ```
//!
//! In each step the fluid sends a trace whose numbers are a simple function of step, field and face; the solid checks
//! every one of them and answers with a register of twice the numbers, which the fluid checks. Kill one and see what the
//! other says. Exit codes are those of the program: 0 done, 2 bad options, 4 the coupling failed.
#![expect(clippy::print_stdout, reason = "a command-line program")]

use std::process::ExitCode;
use std::str::FromStr;
use std::thread;
use std::time::{Duration, Instant};

use coupler::{
    CouplerError, Domain, Endpoint, Fault, Frame, FrameHeader, FrameKind, Link, Participant, ProcessLink,
};

const USAGE: &str = "participant --name fluid|solid --run ID [options]
  --steps N        steps to make (1000)
  --faces N        numbers per field (100)
  --grow           another number of faces in each step, up to tenfold
  --sleep-ms MS    pretend to compute for so long in each step (0)
  --hash BYTE      of the case, as if it were another one (0)
  --timeout-s S    wait so long for the peer to come (10)
  --patience-s S   wait so long for a peer that lives but is silent (600)
  --fail-at STEP   tell the peer of a numerical failure in this step
  --prefix P, --root DIR   keep shared objects apart from those of other runs";

/// Numbers per face, as in a real trace.
const FIELDS: u64 = 5;

struct Options {
    endpoint: Endpoint,
    steps: u64,
    faces: u64,
    grow: bool,
    sleep: Duration,
    fail_at: Option<u64>,
}

fn main() -> ExitCode {
    let options = match parse(std::env::args().skip(1)) {
        Ok(options) => options,
        Err(message) => {
            eprintln!("{message}\n\n{USAGE}");
            return ExitCode::from(2);
        }
    };
    match take_part(options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(4)
        }
    }
}

fn take_part(options: Options) -> Result<(), CouplerError> {
    let Options { endpoint, steps, faces, grow, sleep, fail_at } = options;
    let name = endpoint.name;
    let mut link = ProcessLink::connect(endpoint)?;
    println!("connected to the {} (process {})", name.peer(), link.peer_pid());
    let mut turns = Vec::with_capacity(steps.min(1_000_000) as usize);
    for step in 0..steps {
        if fail_at == Some(step) {
            return link.send_fault(Fault::Numerical, step);
        }
        let count = if grow { faces + step * 7919 % (9 * faces + 1) } else { faces };
        let header =
            |kind| FrameHeader { step, count, fields: FIELDS, time: step as f64, ..FrameHeader::new(kind) };
        thread::sleep(sleep);
        let start = Instant::now();
        match name {
            Participant::Fluid => {
                link.send(header(FrameKind::Trace), |payload| fill(payload, step, count, 1.0))?;
                link.receive(|frame| check(frame, FrameKind::Register, step, count, 2.0))??;
            }
            Participant::Solid => {
                link.receive(|frame| check(frame, FrameKind::Trace, step, count, 1.0))??;
                link.send(header(FrameKind::Register), |payload| fill(payload, step, count, 2.0))?;
            }
        }
        if turns.len() < turns.capacity() {
            turns.push(start.elapsed());
        }
    }
    turns.sort_unstable();
    let counters = link.counters();
    println!(
        "{steps} steps, {} bytes, waited {:.3} s; per step: median {:.1} us, longest {:.1} us",
        counters.bytes,
        counters.waited.as_secs_f64(),
        turns.get(turns.len() / 2).map_or(0.0, |t| t.as_secs_f64() * 1e6),
        turns.last().map_or(0.0, |t| t.as_secs_f64() * 1e6),
    );
    Ok(())
}

fn value(step: u64, k: u64, i: u64, factor: f64) -> f64 {
    factor * (step as f64 + 0.1 * k as f64 + 1e-6 * i as f64)
}

fn fill(payload: &mut [f64], step: u64, count: u64, factor: f64) {
    for (k, row) in (0..).zip(payload.chunks_exact_mut(count as usize)) {
        for (i, number) in (0..).zip(row) {
            *number = value(step, k, i, factor);
        }
    }
}

fn check(frame: &Frame<'_>, kind: FrameKind, step: u64, count: u64, factor: f64) -> Result<(), CouplerError> {
    frame.require(kind)?;
    assert_eq!((frame.header.step, frame.header.count), (step, count), "step and number of faces");
    for k in 0..FIELDS {
        for (i, number) in (0..).zip(frame.row(k as usize)) {
            assert_eq!(*number, value(step, k, i, factor), "step {step}, field {k}, face {i}");
        }
    }
    Ok(())
}

fn parse(mut words: impl Iterator<Item = String>) -> Result<Options, String> {
    let mut endpoint = Endpoint::new("", Participant::Fluid, [0; 32]);
    let mut name = None;
    let (mut steps, mut faces, mut grow, mut sleep_ms, mut fail_at) = (1000, 100, false, 0, None);
    while let Some(key) = words.next() {
        if key == "--grow" {
            grow = true;
            continue;
        }
        let word = words.next().ok_or_else(|| format!("{key} needs a value"))?;
        match key.as_str() {
            "--name" => {
                let parts = [Participant::Fluid, Participant::Solid];
                name = parts.into_iter().find(|part| part.name() == word);
            }
            "--run" => endpoint.run_id = word,
            "--steps" => steps = number(&key, &word)?,
            "--faces" => faces = number::<u64>(&key, &word)?.max(1),
            "--sleep-ms" => sleep_ms = number(&key, &word)?,
            "--hash" => endpoint.case_hash = [number(&key, &word)?; 32],
            "--timeout-s" => endpoint.connect_timeout = seconds(&key, &word)?,
            "--patience-s" => endpoint.patience = seconds(&key, &word)?,
            "--fail-at" => fail_at = Some(number(&key, &word)?),
            "--prefix" => endpoint.domain = Domain { prefix: word, ..endpoint.domain },
            "--root" => endpoint.domain = Domain { root: word.into(), ..endpoint.domain },
            _ => return Err(format!("unknown option {key}")),
        }
    }
    endpoint.name = name.ok_or("say --name fluid or --name solid")?;
    Ok(Options { endpoint, steps, faces, grow, sleep: Duration::from_millis(sleep_ms), fail_at })
}

fn seconds(key: &str, word: &str) -> Result<Duration, String> {
    Duration::try_from_secs_f64(number(key, word)?).map_err(|error| format!("{key} {word}: {error}"))
}

fn number<T: FromStr>(key: &str, word: &str) -> Result<T, String> {
    word.parse().map_err(|_| format!("{key} needs a number, not {word:?}"))
}
