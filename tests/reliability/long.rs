//! What takes too long for the test command; `tests/long/` has the commands, docs/verification/faults.md their last results.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant, SystemTime};

use crate::cases::coupled;
use crate::compare::{assert_same, summary};
use crate::faults::victim_of;
use crate::processes::{Workshop, alone, assert_tidy, processes_of, segments, signal, text};

/// A number from the environment, for the scripts.
fn number(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// Numbers that look random, from a seed that is told (xorshift64*, Vigna 2016).
struct Dice(u64);

impl Dice {
    fn new() -> Self {
        let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap();
        let seed = number("CAV_SEED", now.as_nanos() as u64 | 1);
        println!("CAV_SEED={seed}");
        Self(seed | 1)
    }

    fn below(&mut self, bound: u64) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) % bound
    }
}

/// SIGKILL at random times to either side and to the launcher, and then going on: the result is the undisturbed run's.
#[test]
#[ignore = "minutes"]
fn killed_over_and_over() {
    let _turn = alone();
    let case =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/dickopp2012-coarse.toml"))
            .unwrap();
    let (kills, mut dice) = (number("CAV_KILLS", 50), Dice::new());
    let workshop = Workshop::with(&case);
    let begin = Instant::now();
    workshop.done("whole", &["-q", "--checkpoint-every", "off"]);
    println!("undisturbed: {:.1} s", begin.elapsed().as_secs_f64());
    // As many kills as asked for before the run is over: each within its share of nine tenths of it, ms.
    let share = 9 * u64::try_from(begin.elapsed().as_millis()).unwrap() / (10 * kills.max(1)) + 1;
    let mut at = 0;
    let out = workshop.file("killed");
    let every = ["-q", "--checkpoint-every", "100ms"];
    let (mut done, mut in_vain, mut waited) = (0, 0, Duration::ZERO);
    let begin = Instant::now();
    let mut run = workshop.cav("killed", &every).spawn().unwrap();
    let mut victims = [0_u32; 3];
    while done < kills {
        let next = done * share + dice.below(share);
        std::thread::sleep(Duration::from_millis(50 + next - at));
        at = next;
        let which = dice.below(3) as usize;
        let Some(pid) = victim_of(&mut run, &out, ["fluid", "solid", "run"][which]) else { break };
        signal(pid, "-KILL");
        let killed = Instant::now();
        let code = run.wait().unwrap().code();
        waited += killed.elapsed();
        assert!(matches!(code, None | Some(4) | Some(0)), "{code:?}");
        victims[which] += 1;
        done += 1;
        in_vain += u64::from(!out.join("checkpoints").exists());
        run = workshop.resume("killed", &every).spawn().unwrap();
    }
    let output = run.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", text(&output));
    let datasets = assert_same("killed", &workshop.file("whole"), &out, true);
    println!(
        "{done} kills (fluid {}, solid {}, launcher {}), {in_vain} before the first checkpoint, {:.1} s in all, {:.2} s from a \
         kill to the end of all processes on average; all {datasets} datasets of the result are equal to the last bit",
        victims[0],
        victims[1],
        victims[2],
        begin.elapsed().as_secs_f64(),
        waited.as_secs_f64() / done as f64
    );
    assert_eq!(done, kills, "the run was over too early");
    assert_tidy(&out);
    assert!(processes_of(&out).is_empty());
    assert_eq!(segments(), Vec::<String>::new());
}

/// What a run holds: memory of both sides (KiB), open files of both, bytes of shared memory of this program.
#[derive(Clone, Copy, Debug)]
struct Held {
    memory: [u64; 2],
    files: [usize; 2],
    shared: u64,
}

fn held(pids: [u32; 2]) -> Option<Held> {
    let mut held = Held { memory: [0; 2], files: [0; 2], shared: 0 };
    for (k, pid) in pids.into_iter().enumerate() {
        let status = fs::read_to_string(format!("/proc/{pid}/status")).ok()?;
        let line = status.lines().find(|line| line.starts_with("VmRSS"))?;
        held.memory[k] = line.split_whitespace().nth(1)?.parse().ok()?;
        held.files[k] = fs::read_dir(format!("/proc/{pid}/fd")).ok()?.count();
    }
    for entry in fs::read_dir("/dev/shm").ok()?.flatten() {
        if entry.file_name().to_string_lossy().starts_with("cav_") {
            held.shared += entry.metadata().map_or(0, |file| file.len());
        }
    }
    Some(held)
}

/// 2·10⁵ steps: memory, files and shared memory stay what they are, and what an exchange takes.
#[test]
#[ignore = "minutes"]
fn a_long_coupled_run_holds_no_more_and_more() {
    let _turn = alone();
    let workshop = Workshop::with(&coupled());
    let out = workshop.file("soak");
    let steps = number("CAV_STEPS", 200_000);
    // A fluid at rest: steps of one length, cells of one number.
    let sets = [
        "fluid.levels=4",
        "solid.levels=4",
        "fluid.adapt=false",
        "solid.adapt=false",
        "fluid.region=[]",
        "coupling.step_ratio=1",
    ];
    let end = format!("time.end={:e}", steps as f64 * 6.25e-8);
    let every = format!("time.snapshot_every={:e}", steps as f64 * 6.25e-10);
    let all: Vec<&str> = sets.into_iter().chain([&*end, &*every]).flat_map(|set| ["--set", set]).collect();
    let begin = Instant::now();
    let run =
        workshop.cav("soak", &[&all[..], &["-q", "--threads", "1", "--checkpoint-every", "10s"]].concat());
    let mut run = { run }.spawn().unwrap();
    let pids = ["fluid", "solid"].map(|side| victim_of(&mut run, &out, side).unwrap());
    let mut seen = Vec::new();
    while run.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis((steps / 400).clamp(20, 500)));
        seen.extend(held(pids).map(|held| (begin.elapsed().as_secs_f64(), held)));
    }
    let output = run.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", text(&output));
    let summary = summary(&out);
    println!("{} steps in {:.0} s", summary["steps"], begin.elapsed().as_secs_f64());
    for side in ["fluid", "solid"] {
        println!("the {side}'s exchanges: {}", summary["coupling"][side]["exchange_seconds"]);
    }
    // The last samples may be of a process that is ending.
    seen.truncate(seen.len().saturating_sub(4));
    seen.iter()
        .step_by(seen.len().div_ceil(12).max(1))
        .for_each(|(time, held)| println!("{time:6.1} s  {held:?}"));
    // What a run holds it holds from the second batch of its histories on, which comes after two seconds.
    let batches = seen.iter().filter(|(time, _)| *time < 3.0).count();
    let settled = batches.max(seen.len() / 10);
    assert!(seen.len() >= settled + 20, "{} samples are too few: more CAV_STEPS", seen.len() - settled);
    let largest = |from: usize, to: usize, of: &dyn Fn(&Held) -> f64| {
        seen[from..to].iter().map(|(_, held)| of(held)).fold(0.0, f64::max)
    };
    type Of<'a> = &'a dyn Fn(&Held) -> f64;
    // Files are open now and then.
    let quantities: [(&str, f64, Of<'_>); 5] = [
        ("memory of the fluid, KiB", 0.0, &|held| held.memory[0] as f64),
        ("memory of the solid, KiB", 0.0, &|held| held.memory[1] as f64),
        ("files of the fluid", 4.0, &|held| held.files[0] as f64),
        ("files of the solid", 4.0, &|held| held.files[1] as f64),
        ("shared memory, bytes", 0.0, &|held| held.shared as f64),
    ];
    let mut grown = Vec::new();
    for (what, spare, of) in quantities {
        let middle = settled.midpoint(seen.len());
        let [early, late] = [largest(settled, middle, of), largest(middle, seen.len(), of)];
        let percent = 100.0 * (late / early - 1.0);
        println!(
            "{what}: at most {early} in the first half once it has settled, {late} in the second ({percent:+.1} %)"
        );
        if late > 1.01 * early + spare {
            grown.push(what);
        }
    }
    assert!(grown.is_empty(), "{grown:?} grew");
    assert_eq!(segments(), Vec::<String>::new());
}
