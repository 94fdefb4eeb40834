//! What a step costs: ns per cell and step of both solvers, beside a calibration kernel timed in the same run.
//!
//! `cargo bench --bench step` prints Markdown tables; `docs/performance/index.md` says how to read them. No limit is
//! checked.
//! Words after `--` choose the rows: `cargo bench --bench step -- exact 512` times those that hold both.

#![allow(clippy::print_stdout, reason = "the tables are what the program is for")]

#[path = "step/calibration.rs"]
mod calibration;
#[path = "step/solids.rs"]
mod solids;

use std::time::Instant;

use calibration::Calibration;
use fluid::{
    FluidError, FluidSetup, FluidSolver, InitialCondition, Model, Phase, PhaseState, Primitive, Region,
    RiemannSolver, Shape,
};
use mesh::{Domain, Geometry, Limiter};
use solid::SolidError;
use solids::{Yielding, over_elastic, solid_with_a_pulse};

/// Samples per measurement; the median is reported.
const SAMPLES: usize = 5;
/// Steps before the first sample.
const WARM_UP: usize = 8;
/// Shortest time of one sample, s.
const SAMPLE_SECONDS: f64 = 0.15;
/// Courant number of the steps.
const CFL: f64 = 0.45;

/// Whatever stops a measurement; it passes between threads.
type Failure = Box<dyn std::error::Error + Send + Sync>;

fn main() -> Result<(), Failure> {
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    println!("## One thread\n");
    println!(
        "| solver | cells | block | ns per cell and step | calibration, ns per face | cells : calibration |"
    );
    println!("|---|---|---|---|---|---|");
    pool(1)?.install(all_solvers)?;
    println!("\n## Exact Riemann solver against HLLC, 512 x 512 cells, one thread\n");
    println!("| model, flow | block | hllc, ns per cell and step | exact | exact : hllc |");
    println!("|---|---|---|---|---|");
    for (model, flow) in MODELS
        .into_iter()
        .flat_map(|model| [Flow::Smooth, Flow::Bubble, Flow::Jumps].map(|flow| (model, flow)))
    {
        let name = format!("{}, {}", model.name(), flow.name());
        for (block, measure) in [(8, measure::<8> as Measure), (16, measure::<16>), (32, measure::<32>)] {
            if !wanted(&format!("exact against hllc, {name}, 512 {block}")) {
                continue;
            }
            let cost = |riemann| {
                let scheme = Scheme { model, riemann, limiter: Limiter::Minmod };
                pool(1)?.install(|| measure(Solver::Fluid(scheme, flow), 512))
            };
            let (hllc, exact) = (cost(RiemannSolver::Hllc)?, cost(RiemannSolver::Exact)?);
            let (a, b, ratio) = (hllc.nanoseconds, exact.nanoseconds, exact.ratio / hllc.ratio);
            println!("| {name} | {block} | {a:.1} | {b:.1} | {ratio:.2} |");
        }
    }
    println!(
        "\n## Solids that can yield against elastic ones, mc, 512 x 512 cells in blocks of 16, one thread\n"
    );
    println!(
        "| law | nothing yields, ns per cell and step | over elastic | everything yields | over elastic |"
    );
    println!("|---|---|---|---|---|");
    for law in ["perfect", "linear", "table", "johnson-cook"] {
        if !wanted(&format!("solids that can yield, {law}, mc, 512 16")) {
            continue;
        }
        let mut row = format!("| {law}");
        for flows in [false, true] {
            let [own, ratio] = pool(1)?.install(|| over_elastic(Yielding { law, flows }, 512))?;
            row += &format!(" | {own:.1} | {ratio:.2}");
        }
        println!("{row} |");
    }
    println!("\n## Two threads against one, 512 x 512 cells in blocks of 16\n");
    println!("| solver | one thread, ns per cell and step | two threads | speed-up |");
    println!("|---|---|---|---|");
    for solver in [
        fluid_with(Model::FiveEquation, RiemannSolver::Hllc, Limiter::Mc),
        fluid_with(Model::SaurelAbgrall, RiemannSolver::Hllc, Limiter::Minmod),
        fluid_with(Model::SaurelAbgrall, RiemannSolver::Exact, Limiter::Minmod),
        solid_with(Limiter::Minmod),
    ] {
        if !wanted(&format!("two threads {}", solver.name())) {
            continue;
        }
        let cost =
            |threads| -> Result<Cost, Failure> { pool(threads)?.install(|| measure::<16>(solver, 512)) };
        let (one, two) = (cost(1)?.nanoseconds, cost(2)?.nanoseconds);
        println!("| {} | {one:.1} | {two:.1} | {:.2} |", solver.name(), one / two);
    }
    Ok(())
}

/// Whether a row is asked for: it holds all the words of the command line.
fn wanted(row: &str) -> bool {
    std::env::args().skip(1).filter(|word| !word.starts_with('-')).all(|word| row.contains(&word))
}

/// The default model, with its sharp interface, and the paper's mixture.
const MODELS: [Model; 2] = [Model::FiveEquation, Model::SaurelAbgrall];

/// How the fluid is computed.
#[derive(Clone, Copy)]
struct Scheme {
    model: Model,
    riemann: RiemannSolver,
    limiter: Limiter,
}

/// What is timed.
#[derive(Clone, Copy)]
enum Solver {
    Fluid(Scheme, Flow),
    Solid(Limiter, Option<Yielding>),
}

/// What the fluid does.
#[derive(Clone, Copy, PartialEq)]
enum Flow {
    /// Weak sound in the liquid: no two cells are alike, no jump is strong.
    Smooth,
    /// The collapse of a bubble near a wall.
    Bubble,
    /// Patches of four by four cells of gas or liquid whose pressures differ up to a thousandfold.
    Jumps,
}

impl Flow {
    fn name(self) -> &'static str {
        match self {
            Self::Smooth => "smooth",
            Self::Bubble => "bubble",
            Self::Jumps => "strong jumps",
        }
    }
}

const fn fluid_with(model: Model, riemann: RiemannSolver, limiter: Limiter) -> Solver {
    Solver::Fluid(Scheme { model, riemann, limiter }, Flow::Bubble)
}

const fn solid_with(limiter: Limiter) -> Solver {
    Solver::Solid(limiter, None)
}

impl Solver {
    fn name(self) -> String {
        let limiter = |limiter| match limiter {
            Limiter::Mc => "mc",
            Limiter::Minmod => "minmod",
            Limiter::Eno => "eno",
            Limiter::None => "none",
        };
        match self {
            Self::Fluid(Scheme { model, riemann, limiter: l }, _) => {
                let riemann = match riemann {
                    RiemannSolver::Hllc => "hllc",
                    RiemannSolver::HllcLowMach => "hllc-lm",
                    RiemannSolver::Exact => "exact",
                };
                format!("fluid, {}, {riemann}, {}", model.name(), limiter(l))
            }
            Self::Solid(l, _) => format!("solid, {}", limiter(l)),
        }
    }
}

fn all_solvers() -> Result<(), Failure> {
    for solver in [
        fluid_with(Model::FiveEquation, RiemannSolver::Hllc, Limiter::Mc),
        fluid_with(Model::FiveEquation, RiemannSolver::Hllc, Limiter::Minmod),
        fluid_with(Model::FiveEquation, RiemannSolver::Exact, Limiter::Mc),
        fluid_with(Model::SaurelAbgrall, RiemannSolver::Hllc, Limiter::Minmod),
        fluid_with(Model::SaurelAbgrall, RiemannSolver::Hllc, Limiter::Mc),
        fluid_with(Model::SaurelAbgrall, RiemannSolver::Exact, Limiter::Minmod),
        solid_with(Limiter::Minmod),
        solid_with(Limiter::Mc),
    ] {
        for cells in [256, 512] {
            for (block, measure) in [(8, measure::<8> as Measure), (16, measure::<16>), (32, measure::<32>)] {
                let row = format!("{} | {cells} x {cells} | {block}", solver.name());
                if wanted(&format!("one thread {row}")) {
                    let Cost { nanoseconds, calibration, ratio } = measure(solver, cells)?;
                    println!("| {row} | {nanoseconds:.1} | {calibration:.1} | {ratio:.2} |");
                }
            }
        }
    }
    Ok(())
}

/// Medians over the samples.
struct Cost {
    /// Per cell and step.
    nanoseconds: f64,
    /// Of the calibration kernel per face.
    calibration: f64,
    /// Of the two, taken sample by sample.
    ratio: f64,
}

/// [`measure`] for one size of blocks.
type Measure = fn(Solver, usize) -> Result<Cost, Failure>;

fn measure<const N: usize>(solver: Solver, cells: usize) -> Result<Cost, Failure> {
    match solver {
        Solver::Fluid(scheme, flow) => {
            let make = || match flow {
                Flow::Bubble => fluid_near_a_wall::<N>(cells, scheme),
                Flow::Smooth => fluid_from::<N>(cells, scheme, sound),
                Flow::Jumps => fluid_from::<N>(cells, scheme, move |at| patches(at, cells)),
            };
            let mut fluid = make()?;
            let restart = (flow == Flow::Jumps).then_some(make);
            sample(cells * cells, &mut fluid, restart, |fluid| {
                let dt = fluid.time_step_limit(CFL);
                Ok(fluid.step(dt)?)
            })
        }
        Solver::Solid(limiter, yielding) => {
            let mut solid = solid_with_a_pulse::<N>(cells, limiter, yielding)?;
            let restart: Option<fn() -> Result<_, SolidError>> = None;
            sample(cells * cells, &mut solid, restart, |solid| {
                let dt = solid.time_step_limit(CFL);
                Ok(solid.step(dt)?)
            })
        }
    }
}

/// Times `step`, and the calibration kernel before each sample. A flow that does not stay what it is begins
/// anew by `restart` for each sample.
fn sample<S, E: std::error::Error + Send + Sync + 'static>(
    cells: usize,
    solver: &mut S,
    restart: Option<impl Fn() -> Result<S, E>>,
    mut step: impl FnMut(&mut S) -> Result<(), Failure>,
) -> Result<Cost, Failure> {
    let start = Instant::now();
    for _ in 0..WARM_UP {
        step(solver)?;
    }
    let one = start.elapsed().as_secs_f64() / WARM_UP as f64;
    let enough = ((SAMPLE_SECONDS / one).ceil() as usize).max(3);
    let steps = if restart.is_some() { WARM_UP } else { enough };
    let mut calibration = Calibration::new();
    calibration.nanoseconds_per_face();
    let mut samples = [[0.0; 3]; SAMPLES];
    for [own, kernel, ratio] in &mut samples {
        if let Some(make) = &restart {
            *solver = make()?;
            // The first step also brings the new fields into the cache.
            step(solver)?;
        }
        *kernel = calibration.nanoseconds_per_face();
        let start = Instant::now();
        for _ in 0..steps {
            step(solver)?;
        }
        *own = start.elapsed().as_secs_f64() * 1e9 / (steps * cells) as f64;
        *ratio = *own / *kernel;
    }
    let median = |column: usize| {
        let mut values = samples.map(|sample| sample[column]);
        values.sort_by(f64::total_cmp);
        values[SAMPLES / 2]
    };
    Ok(Cost { nanoseconds: median(0), calibration: median(1), ratio: median(2) })
}

/// A bubble of 10 mm, 20 mm above a rigid wall: the fluid of `cases/dickopp2012-coarse.toml`.
fn fluid_near_a_wall<const N: usize>(cells: usize, scheme: Scheme) -> Result<FluidSolver<N>, FluidError> {
    use fluid::Boundary::{Axis, NonReflecting, Wall};
    let at_rest = |phase, density, pressure| PhaseState { phase, density, pressure, velocity: [0.0; 2] };
    let initial = InitialCondition {
        ambient: at_rest(Phase::Liquid, 1000.0, 5e7),
        pressure: fluid::InitialPressure::Uniform,
        regions: vec![Region {
            shape: Shape::Sphere { centre: [0.03, 0.0], radius: 0.01 },
            state: at_rest(Phase::Gas, 0.0266, 2118.0),
        }],
        pulses: vec![],
    };
    let setup = fluid_setup(cells, scheme, [Wall, NonReflecting, Axis, NonReflecting]);
    FluidSolver::new(&setup, &initial)
}

fn fluid_setup(cells: usize, scheme: Scheme, boundaries: [fluid::Boundary; 4]) -> FluidSetup {
    let Scheme { model, riemann, limiter } = scheme;
    let domain = Domain { geometry: Geometry::Axisymmetric, z: [0.01, 0.06], r: [0.0, 0.05] };
    // Sharpening has no say in the paper's mixture.
    FluidSetup { model, riemann, limiter, ..FluidSetup::new(domain, [cells, cells], boundaries) }
}

/// The same fluids between walls in any state.
fn fluid_from<const N: usize>(
    cells: usize,
    scheme: Scheme,
    state: impl Fn([f64; 2]) -> Primitive + Sync,
) -> Result<FluidSolver<N>, FluidError> {
    use fluid::Boundary::{Axis, Wall};
    FluidSolver::from_fn(&fluid_setup(cells, scheme, [Wall, Wall, Axis, Wall]), state)
}

/// Standing sound of some ten wave lengths in the liquid.
fn sound([z, r]: [f64; 2]) -> Primitive {
    let pressure = 5e7 + 1e6 * (1300.0 * z).sin() * (1100.0 * r).cos();
    Primitive { density: 1000.0, v_z: 0.0, v_r: 0.0, pressure, phi: 0.0 }
}

/// Patches of gas or liquid of four by four cells with pressures between 0.1 and 100 MPa, in motion at random.
fn patches([z, r]: [f64; 2], cells: usize) -> Primitive {
    let patch = |x: f64| (x / 0.05 * cells as f64 / 4.0) as u64;
    let mut bits = patch(z - 0.01) << 32 | patch(r);
    let mut random = || {
        // SplitMix64 (Steele, Lea & Flood 2014).
        bits = bits.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    };
    let gas = random() < 0.3;
    let pressure = 1e5 * 1000_f64.powf(random());
    Primitive {
        density: if gas { 1.2 * (pressure / 1e5).powf(1.0 / 1.4) } else { 1000.0 },
        v_z: 100.0 * (random() - 0.5),
        v_r: 100.0 * (random() - 0.5),
        pressure,
        phi: if gas { 1.0 } else { 0.0 },
    }
}
