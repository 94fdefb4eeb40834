//! Hostile input for some seconds: the corpus, and random changes of it. For hours: `fuzz/`, see docs/reliability.md.

// How many inputs were tried is told.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

#[path = "../fuzz/targets.rs"]
mod targets;

/// Time for each target.
fn budget() -> Duration {
    let seconds = std::env::var("CAV_FUZZ_SECONDS").ok().and_then(|text| text.parse().ok()).unwrap_or(4.0);
    Duration::from_secs_f64(seconds)
}

/// No input may take longer.
const LONGEST: Duration = Duration::from_secs(2);

/// Numbers that look random (xorshift64*, Vigna 2016).
struct Dice(u64);

impl Dice {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as usize % bound.max(1)
    }

    /// Some changes such as a fuzzer makes.
    fn change(&mut self, bytes: &mut Vec<u8>, others: &[Vec<u8>]) {
        for _ in 0..=self.below(6) {
            let (at, len) = (self.below(bytes.len()), 1 + self.below(16));
            match self.below(8) {
                0 if !bytes.is_empty() => bytes[at] ^= 1 << self.below(8),
                1 if !bytes.is_empty() => {
                    bytes[at] = [0, 1, 0x7f, 0x80, 0xff, b'-', b'9', b'e'][self.below(8)]
                }
                2 => bytes.truncate(at),
                3 => drop(bytes.drain(at.min(bytes.len())..(at + len).min(bytes.len()))),
                4 => {
                    let other = &others[self.below(others.len())];
                    let from = self.below(other.len());
                    let piece = &other[from..(from + len).min(other.len())];
                    bytes.splice(at..at, piece.iter().copied());
                }
                5 => {
                    let word =
                        [&b"1e308"[..], b"nan", b"inf", b"-0", b"[", b"\"", b"= [[", b"9223372036854775807"];
                    bytes.splice(at..at, word[self.below(word.len())].iter().copied());
                }
                6 => {
                    let end = (at + len).min(bytes.len());
                    let piece: Vec<u8> = bytes[at.min(end)..end].to_vec();
                    bytes.splice(at..at, piece);
                }
                _ => bytes.extend((0..len).map(|_| self.below(256) as u8)),
            }
        }
    }
}

fn run(name: &str, target: fn(&[u8]), seeds: Vec<Vec<u8>>) {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(name);
    let mut files: Vec<_> = fs::read_dir(&corpus).unwrap().flatten().map(|entry| entry.path()).collect();
    files.sort();
    let mut inputs: Vec<Vec<u8>> = files.iter().map(|path| fs::read(path).unwrap()).collect();
    inputs.extend(seeds);
    assert!(!inputs.is_empty());
    inputs.iter().for_each(|input| target(input));
    let (begin, mut dice, mut tried) = (Instant::now(), Dice(0x9e37_79b9_7f4a_7c15), 0);
    while begin.elapsed() < budget() {
        let mut bytes = inputs[dice.below(inputs.len())].clone();
        dice.change(&mut bytes, &inputs);
        let start = Instant::now();
        if let Err(panic) = std::panic::catch_unwind(|| target(&bytes)) {
            let kept = std::env::temp_dir().join(format!("cav-{name}-{}", std::process::id()));
            fs::write(&kept, &bytes).unwrap();
            eprintln!("the input is in {}", kept.display());
            std::panic::resume_unwind(panic);
        }
        assert!(start.elapsed() < LONGEST, "{:?} for {bytes:?}", start.elapsed());
        tried += 1;
    }
    println!("{name}: {tried} inputs");
    assert!(tried > 100, "only {tried}");
}

#[test]
fn case_files() {
    let cases = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("cases")).unwrap().flatten();
    let mut paths: Vec<_> = cases.map(|entry| entry.path()).collect();
    paths.sort();
    run("case_file", targets::case_file, paths.iter().map(|path| fs::read(path).unwrap()).collect());
}

#[test]
fn interface_frames() {
    use coupler::{FrameHeader, FrameKind};
    let frame = |kind, fields: u64, count: u64| {
        let header = FrameHeader { fields, count, sequence: 1, ..FrameHeader::new(kind) };
        let payload = (0..fields * count).flat_map(|k| (k as f64).to_le_bytes());
        [postcard::to_stdvec(&header).unwrap(), payload.collect()].concat()
    };
    let seeds =
        vec![frame(FrameKind::Trace, 16, 3), frame(FrameKind::Register, 5, 4), frame(FrameKind::Yours, 0, 0)];
    run("interface_frame", targets::interface_frame, seeds);
}

#[test]
fn checkpoints() {
    use cav::case::Case;
    use cav::run::setup::{fluid_solver, solid_solver};
    let case = Case::from_toml(targets::SMALL, "small", &[]).unwrap();
    let fluid = fluid_solver(&case, case.fluid.as_ref().unwrap()).unwrap();
    let solid = solid_solver(&case, case.solid.as_ref().unwrap()).unwrap();
    let seeds =
        vec![postcard::to_stdvec(&fluid.saved()).unwrap(), postcard::to_stdvec(&solid.saved()).unwrap()];
    run("checkpoint", targets::checkpoint, seeds);
}

#[test]
fn run_directories() {
    run(
        "run_directory",
        targets::run_directory,
        vec![b"{\"completed\": false}".to_vec(), b"cav\0ckpt\x01\0\0\0".to_vec()],
    );
}
