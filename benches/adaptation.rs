//! What adaptive grids cost: `cargo bench --bench adaptation`.
//!
//! One thread. The fluid of the figures' case over a rigid wall, and the solid with the pulse of a load, on uniform
//! and on adaptive grids from 10⁴ to 10⁶ cells: time per cell and step in the step and in the adaptation. The last column
//! says what the mesh costs at most: on uniform grids the step in units of the smallest grid's, on adaptive ones the
//! share by which step and adaptation together exceed the step on the uniform grid of most nearly as many cells.
//! Last, what the memory alone costs: a loop that reads and writes as many bytes as the solid's step on a large grid.

#![allow(clippy::print_stdout, reason = "the table is what the program is for")]

use std::error::Error;
use std::hint::black_box;
use std::time::{Duration, Instant};

use cav::case::Case;
use cav::run::setup::{fluid_solver, solid_solver};

type Failure = Box<dyn Error + Send + Sync>;

/// The figures' case; a wave in the solid besides, since it is stepped alone here.
const CASE: &str = include_str!("../cases/dickopp2012-coarse.toml");
const PULSE: &str = "\n[[solid.pulse]]\ncentre = [-0.01, 0.0]\nwidth = 0.003\namplitude = 5e-10\n";

/// Steps before the clock starts, steps of a round, and how many rounds and how long, at least. The median round counts.
const WARM_UP: usize = 24;
const STEPS: usize = 16;
const ROUNDS: usize = 5;
const AT_LEAST: Duration = Duration::from_millis(2500);

/// Time spent, and cells advanced in it.
#[derive(Default)]
struct Spent {
    step: Duration,
    adapt: Duration,
    cell_steps: u64,
    steps: u64,
}

impl Spent {
    /// Nanoseconds per cell and step.
    fn cost(&self) -> f64 {
        (self.step + self.adapt).as_nanos() as f64 / self.cell_steps as f64
    }
}

fn main() -> Result<(), Failure> {
    println!(
        "| side | grid | cells | step, ns per cell | adaptation, ns per cell and step | its share | the mesh |"
    );
    println!("|---|---|---|---|---|---|---|");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    for side in ["fluid", "solid"] {
        // Cells and cost of the uniform grids.
        let mut uniform: Vec<(f64, f64)> = Vec::new();
        for (grid, sets) in grids(side) {
            let name = format!("{side} {grid}");
            if !std::env::args()
                .skip(1)
                .filter(|word| !word.starts_with('-'))
                .all(|word| name.contains(&word))
            {
                continue;
            }
            let spent = pool.install(|| measure(side, &sets))?;
            let per = |time: Duration| time.as_nanos() as f64 / spent.cell_steps as f64;
            let (step, adapt) = (per(spent.step), per(spent.adapt));
            let cells = spent.cell_steps as f64 / spent.steps as f64;
            let nearest = uniform.iter().min_by(|a, b| {
                let apart = |n: f64| (n / cells).ln().abs();
                apart(a.0).total_cmp(&apart(b.0))
            });
            let mesh = if grid.starts_with("uniform") {
                uniform.push((cells, step));
                format!("{:.2}", step / uniform[0].1)
            } else {
                nearest.map_or_else(
                    || "–".to_owned(),
                    |(_, bare)| format!("{:.0} %", 100.0 * (1.0 - bare / (step + adapt))),
                )
            };
            let share = 100.0 * adapt / (step + adapt);
            println!("| {side} | {grid} | {cells:.0} | {step:.1} | {adapt:.1} | {share:.0} % | {mesh} |");
        }
    }
    println!("\nmemory alone: {:.1} ns per cell of the solid", memory_alone());
    Ok(())
}

/// Nanoseconds in which one thread reads the six numbers of a cell and writes six others, on 2^20 cells; the first decile.
fn memory_alone() -> f64 {
    const CELLS: usize = 1 << 20;
    let (old, mut new) = (vec![1.0_f64; 6 * CELLS], vec![2.0_f64; 6 * CELLS]);
    let mut samples = [0.0; 40].map(|_: f64| {
        let before = Instant::now();
        for (new, old) in new.iter_mut().zip(black_box(&old)) {
            *new = 0.5 * *old;
        }
        black_box(&mut new);
        before.elapsed().as_nanos() as f64 / CELLS as f64
    });
    samples.sort_by(f64::total_cmp);
    samples[samples.len() / 10]
}

/// The grids of a side: a name, and what the case must say.
fn grids(side: &str) -> Vec<(String, Vec<String>)> {
    let first = if side == "fluid" { [4, 4] } else { [16, 16] };
    let uniform = [96, 192, 320, 448, 768, 1024].map(|n| {
        let sets = vec![
            format!("{side}.cells=[{n}, {n}]"),
            format!("{side}.levels=0"),
            format!("{side}.adapt=false"),
        ];
        (format!("uniform {n} x {n}"), sets)
    });
    let adaptive =
        [(256, 1e-3), (1024, 1e-3), (2048, 1e-3), (2048, 1e-4), (4096, 1e-4)].map(|(n, epsilon)| {
            let levels = (n / first[0] as u32).ilog2();
            let sets = vec![
                format!("{side}.levels={levels}"),
                format!("{side}.adapt=true"),
                format!("{side}.epsilon={epsilon:e}"),
            ];
            (format!("adaptive, finest {n} x {n}, epsilon {epsilon:e}"), sets)
        });
    uniform.into_iter().chain(adaptive).collect()
}

fn measure(side: &str, sets: &[String]) -> Result<Spent, Failure> {
    let scheme = "coupling.scheme=rigid".to_owned();
    let text = if side == "fluid" { CASE.to_owned() } else { format!("{CASE}{PULSE}") };
    if side == "fluid" {
        let sets: Vec<String> = sets.iter().cloned().chain([scheme]).collect();
        let case = Case::from_toml(&text, "adaptation", &sets).map_err(|errors| errors.to_string())?;
        let mut solver = fluid_solver(&case, case.fluid.as_ref().ok_or("no fluid")?)?;
        run(
            &mut solver,
            |s| Ok(s.step_at(0.45)?),
            |s| {
                let dt = s.time_step_limit(0.45);
                s.adapt_if_due(dt, 1);
            },
            |s| s.mesh().cells(),
        )
    } else {
        let case = Case::from_toml(&text, "adaptation", sets).map_err(|errors| errors.to_string())?;
        let mut solver = solid_solver(&case, case.solid.as_ref().ok_or("no solid")?)?;
        // Its surface bears what it bore before.
        let load = mesh::FaceState { pressure: 5e7, velocity: 0.0, power: 0.0, ..mesh::FaceState::default() };
        run(
            &mut solver,
            move |s| {
                s.interface_mut().set_all(|_| load);
                Ok(s.step_at(0.45)?)
            },
            |s| {
                let dt = s.time_step_limit(0.45);
                if s.adaptation_follows(dt, 1) {
                    s.adapt(dt, 1);
                }
            },
            |s| s.mesh().cells(),
        )
    }
}

fn run<S>(
    solver: &mut S,
    step: impl Fn(&mut S) -> Result<(), Failure>,
    adapt: impl Fn(&mut S),
    cells: impl Fn(&S) -> usize,
) -> Result<Spent, Failure> {
    for _ in 0..WARM_UP {
        step(solver)?;
        adapt(solver);
    }
    let (mut rounds, begin) = (Vec::new(), Instant::now());
    while rounds.len() < ROUNDS || begin.elapsed() < AT_LEAST {
        let mut spent = Spent::default();
        for _ in 0..STEPS {
            let before = Instant::now();
            step(solver)?;
            let between = Instant::now();
            spent.cell_steps += cells(solver) as u64;
            adapt(solver);
            spent.step += between - before;
            spent.adapt += between.elapsed();
            spent.steps += 1;
        }
        rounds.push(spent);
    }
    rounds.sort_by(|a, b| a.cost().total_cmp(&b.cost()));
    Ok(rounds.swap_remove(rounds.len() / 2))
}
