//! What takes too long for the test command; `tests/long/` has the commands, docs/reliability.md their last results.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant, SystemTime};

use crate::compare::assert_same;
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
    // As many kills as asked for within about twice the run's own time.
    let longest = 4 * u64::try_from(begin.elapsed().as_millis()).unwrap() / kills.max(1) + 200;
    let out = workshop.file("killed");
    let every = ["-q", "--checkpoint-every", "100ms"];
    let (mut done, mut in_vain, mut waited) = (0, 0, Duration::ZERO);
    let begin = Instant::now();
    let mut run = workshop.cav("killed", &every).spawn().unwrap();
    let mut victims = [0_u32; 3];
    while done < kills {
        std::thread::sleep(Duration::from_millis(50 + dice.below(longest)));
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
