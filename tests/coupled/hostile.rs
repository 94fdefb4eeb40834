//! Hostile input for some seconds: the corpus, and random changes of it. For hours: `fuzz/`, see docs/verification/faults.md.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

#[path = "../../fuzz/targets.rs"]
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
    let mut paths: Vec<_> = cases.map(|entry| entry.path()).filter(|path| path.is_file()).collect();
    paths.sort();
    run("case_file", targets::case_file, paths.iter().map(|path| fs::read(path).unwrap()).collect());
}

/// A change of a frame: what, at which number, to what; see `frames::change`.
fn changed(run: u8, whose: u8, number: u8, what: u8, at: u16, value: f64) -> Vec<u8> {
    let bytes = [&[run, whose, number, what][..], &at.to_le_bytes(), &value.to_le_bytes()].concat();
    assert_eq!(bytes.len(), 3 + targets::frames::CHANGE);
    bytes
}

#[test]
fn unchanged_frames_are_all_accepted() {
    for run in 0..targets::frames::RUNS.len() as u8 {
        let result = targets::frames::changed_run(&[run, 0, 0]);
        assert!(result.is_ok(), "run {run}: {}", result.unwrap_err());
    }
}

/// In run 0 the fluid's step is the longer one, so it sends the trace; in run 1 the solid's.
#[test]
fn frames_that_make_no_sense_are_refused_by_either_side() {
    const TO_FLUID: u8 = 0;
    const TO_SOLID: u8 = 1;
    let (first_word, trace) = ([[0, TO_FLUID, 0], [1, TO_FLUID, 0]], [[0, TO_SOLID, 0], [1, TO_FLUID, 1]]);
    let (register, yours) = ([[0, TO_FLUID, 1], [1, TO_SOLID, 1]], [[1, TO_SOLID, 0]; 2]);
    let traces_and_registers = [trace, register].concat();
    let all_steps = [trace, register, yours].concat();
    let all = [first_word, trace, register, yours].concat();
    let refused = |frames: &[[u8; 3]], what: u8, at: u16, value: f64, words: &str| {
        for [run, whose, number] in frames {
            let start = Instant::now();
            let result = targets::frames::changed_run(&changed(*run, *whose, *number, what, at, value));
            let context = format!("run {run}, frame {number} to {whose}, {what}: {value:e}");
            let error = result.expect_err(&context);
            assert_eq!(error.exit_code(), 4, "{context}: {error}");
            assert!(error.to_string().contains(words), "{context}: {error}");
            // Whose it was, but where only its shape was looked at.
            let sender = ["the solid's", "the fluid's"][usize::from(*whose)];
            assert!(words.is_empty() || error.to_string().contains(sender), "{context}: {error}");
            assert!(start.elapsed() < LONGEST, "{context}");
        }
    };
    let (value, row, time, dt, dt_max, faces) = (0, 5, 6, 7, 9, 12);
    for none in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        refused(&trace, value, 3, none, "for the outer radius of face 3");
        refused(&trace, row, 5, none, "for the density of face 0");
        refused(&register, value, 2, none, "for the mean pressure of face 2");
    }
    refused(&trace, value, 3, 1e-9, "face 3 goes from");
    refused(&trace, value, 0, -1e-9, "face 0 goes from");
    refused(&trace, value, 15, 1.0, "they end at");
    refused(&trace, faces, 5, 0.0, "they end at");
    refused(&trace, faces, 0, 0.0, "there are none");
    refused(&register, faces, 5, 0.0, "");
    refused(&register, faces, 0, 0.0, "");
    for bad in [f64::NAN, f64::INFINITY, 0.0, -1e-9, 1.0, 1e300] {
        refused(&all_steps, dt, 0, bad, "has the step");
    }
    for bad in [f64::NAN, f64::INFINITY, -1e-9, 1e-9, 1e300] {
        refused(&all, time, 0, bad, "has the time");
    }
    for bad in [f64::NAN, f64::NEG_INFINITY, -1e-9] {
        refused(
            &[first_word[0], register[0], trace[1], yours[0]],
            dt_max,
            0,
            bad,
            "has the largest next step",
        );
    }
    // Flags of the strong scheme in another one; another kind.
    refused(&trace[..1], 10, 4, 0.0, "is a trial in a scheme without");
    refused(&trace[..1], 10, 5, 0.0, "settles a step that was not tried");
    for (frames, kind) in [(&traces_and_registers, 1), (&all_steps, 77)] {
        for [run, whose, number] in frames {
            let result = targets::frames::changed_run(&changed(*run, *whose, *number, 11, kind, 0.0));
            assert_eq!(result.expect_err("another kind").exit_code(), 4);
        }
    }
}

#[test]
fn interface_frames() {
    let nonsense = [f64::NAN, f64::INFINITY, 0.0, -1.0, 1e-300, 1e300, 1e9, 1.001];
    let mut seeds = Vec::new();
    for run in 0..targets::frames::RUNS.len() as u8 {
        for whose in 0..2 {
            // Nothing changed; then each kind of change, in the first frames and in later ones.
            seeds.push(vec![run, whose, 0]);
            for what in 0..16_u8 {
                let value = nonsense[usize::from(what + whose + run) % nonsense.len()];
                seeds.push(changed(run, whose, what % 5, what, 37 * u16::from(what), value));
            }
        }
    }
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
