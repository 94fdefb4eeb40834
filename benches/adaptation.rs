//! What adaptive grids cost: `cargo bench --bench adaptation`.
//!
//! One thread. The fluid of the figures' case over a rigid wall, and the solid with the pulse of a load, on uniform
//! and on adaptive grids from 10⁴ to 10⁶ cells: time per cell and step in the step and in the mesh's own work.

#![allow(clippy::print_stdout, reason = "the table is what the program is for")]

use std::error::Error;
use std::time::{Duration, Instant};

use cav::case::Case;
use cav::run::setup::{fluid_solver, solid_solver};

type Failure = Box<dyn Error + Send + Sync>;

/// The figures' case; a wave in the solid besides, since it is stepped alone here.
const CASE: &str = include_str!("../cases/dickopp2012-coarse.toml");
const PULSE: &str = "\n[[solid.pulse]]\ncentre = [-0.01, 0.0]\nwidth = 0.003\namplitude = 5e-10\n";

/// Steps before the clock starts, and steps that are timed, at least.
const WARM_UP: usize = 24;
const TIMED: usize = 48;
const AT_LEAST: Duration = Duration::from_millis(1500);

/// Time spent, and cells advanced in it.
#[derive(Default)]
struct Spent {
    step: Duration,
    adapt: Duration,
    cell_steps: u64,
    steps: u64,
}

fn main() -> Result<(), Failure> {
    println!("| side | grid | cells | step, ns per cell | adaptation, ns per cell and step | its share |");
    println!("|---|---|---|---|---|---|");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    for side in ["fluid", "solid"] {
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
            println!(
                "| {side} | {grid} | {} | {step:.1} | {adapt:.1} | {:.0} % |",
                spent.cell_steps / spent.steps,
                100.0 * adapt / (step + adapt)
            );
        }
    }
    Ok(())
}

/// The grids of a side: a name, and what the case must say.
fn grids(side: &str) -> Vec<(String, Vec<String>)> {
    let first = if side == "fluid" { [4, 4] } else { [16, 16] };
    let uniform = [96, 192, 384, 768, 1024].map(|n| {
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
            |s| Ok(s.step(s.time_step_limit(0.45))?),
            |s| {
                let dt = s.time_step_limit(0.45);
                s.adapt_if_due(dt);
            },
            |s| s.mesh().cells(),
        )
    } else {
        let case = Case::from_toml(&text, "adaptation", sets).map_err(|errors| errors.to_string())?;
        let mut solver = solid_solver(&case, case.solid.as_ref().ok_or("no solid")?)?;
        // Its surface bears what it bore before.
        let load = solid::SurfaceState { pressure: 5e7, velocity: 0.0, power: 0.0 };
        run(
            &mut solver,
            move |s| {
                s.set_surface(|_| load);
                Ok(s.step(s.time_step_limit(0.45))?)
            },
            |s| {
                let dt = s.time_step_limit(0.45);
                if s.adaptation_follows(dt) {
                    s.adapt(dt);
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
    let (mut spent, begin) = (Spent::default(), Instant::now());
    while spent.steps < TIMED as u64 || begin.elapsed() < AT_LEAST {
        let before = Instant::now();
        step(solver)?;
        let between = Instant::now();
        spent.cell_steps += cells(solver) as u64;
        adapt(solver);
        spent.step += between - before;
        spent.adapt += between.elapsed();
        spent.steps += 1;
    }
    Ok(spent)
}
