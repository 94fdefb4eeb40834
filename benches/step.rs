//! What a step costs: ns per cell and step of both solvers, beside a calibration kernel timed in the same run.
//!
//! `cargo bench --bench step` prints Markdown tables; `docs/performance.md` says how to read them. No limit is checked.

#![allow(clippy::print_stdout, reason = "the tables are what the program is for")]

use std::hint::black_box;
use std::time::Instant;

use fluid::{
    FluidError, FluidSetup, FluidSolver, InitialCondition, Phase, PhaseState, Region, RiemannSolver, Shape,
    StiffenedGas,
};
use mesh::{Domain, Geometry, Limiter};
use solid::{ElasticState, SolidError, SolidSetup, SolidSolver, WaveSpeeds};

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
    println!("\n## Two threads against one, 512 x 512 cells in blocks of 16\n");
    println!("| solver | one thread, ns per cell and step | two threads | speed-up |");
    println!("|---|---|---|---|");
    for solver in [fluid_hllc(Limiter::Minmod), solid_with(Limiter::Minmod)] {
        let cost =
            |threads| -> Result<Cost, Failure> { pool(threads)?.install(|| measure::<16>(solver, 512)) };
        let (one, two) = (cost(1)?.nanoseconds, cost(2)?.nanoseconds);
        println!("| {} | {one:.1} | {two:.1} | {:.2} |", solver.name(), one / two);
    }
    Ok(())
}

/// What is timed.
#[derive(Clone, Copy)]
enum Solver {
    Fluid(RiemannSolver, Limiter),
    Solid(Limiter),
}

const fn fluid_hllc(limiter: Limiter) -> Solver {
    Solver::Fluid(RiemannSolver::Hllc, limiter)
}

const fn solid_with(limiter: Limiter) -> Solver {
    Solver::Solid(limiter)
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
            Self::Fluid(RiemannSolver::Hllc, l) => format!("fluid, hllc, {}", limiter(l)),
            Self::Fluid(RiemannSolver::Exact, l) => format!("fluid, exact, {}", limiter(l)),
            Self::Solid(l) => format!("solid, {}", limiter(l)),
        }
    }
}

fn all_solvers() -> Result<(), Failure> {
    for solver in [
        fluid_hllc(Limiter::Minmod),
        fluid_hllc(Limiter::Mc),
        Solver::Fluid(RiemannSolver::Exact, Limiter::Minmod),
        solid_with(Limiter::Minmod),
        solid_with(Limiter::Mc),
    ] {
        for cells in [256, 512] {
            print_row(solver, cells, 8, &measure::<8>(solver, cells)?);
            print_row(solver, cells, 16, &measure::<16>(solver, cells)?);
            print_row(solver, cells, 32, &measure::<32>(solver, cells)?);
        }
    }
    Ok(())
}

fn print_row(solver: Solver, cells: usize, block: usize, cost: &Cost) {
    println!(
        "| {} | {cells} x {cells} | {block} | {:.1} | {:.1} | {:.2} |",
        solver.name(),
        cost.nanoseconds,
        cost.calibration,
        cost.ratio,
    );
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

fn measure<const N: usize>(solver: Solver, cells: usize) -> Result<Cost, Failure> {
    match solver {
        Solver::Fluid(riemann, limiter) => {
            let mut fluid = fluid_near_a_wall::<N>(cells, riemann, limiter)?;
            sample(cells * cells, || {
                let dt = fluid.time_step_limit(CFL);
                Ok(fluid.step(dt)?)
            })
        }
        Solver::Solid(limiter) => {
            let mut solid = solid_with_a_pulse::<N>(cells, limiter)?;
            sample(cells * cells, || {
                let dt = solid.time_step_limit(CFL);
                Ok(solid.step(dt)?)
            })
        }
    }
}

/// Times `step`, and the calibration kernel before each sample.
fn sample(cells: usize, mut step: impl FnMut() -> Result<(), Failure>) -> Result<Cost, Failure> {
    let start = Instant::now();
    for _ in 0..WARM_UP {
        step()?;
    }
    let one = start.elapsed().as_secs_f64() / WARM_UP as f64;
    let steps = ((SAMPLE_SECONDS / one).ceil() as usize).max(3);
    let mut calibration = Calibration::new();
    calibration.nanoseconds_per_face();
    let mut samples = [[0.0; 3]; SAMPLES];
    for [own, kernel, ratio] in &mut samples {
        *kernel = calibration.nanoseconds_per_face();
        let start = Instant::now();
        for _ in 0..steps {
            step()?;
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
fn fluid_near_a_wall<const N: usize>(
    cells: usize,
    riemann: RiemannSolver,
    limiter: Limiter,
) -> Result<FluidSolver<N>, FluidError> {
    use fluid::Boundary::{Axis, NonReflecting, Wall};
    let at_rest = |phase, density, pressure| PhaseState { phase, density, pressure, velocity: [0.0; 2] };
    let initial = InitialCondition {
        ambient: at_rest(Phase::Liquid, 1000.0, 5e7),
        regions: vec![Region {
            shape: Shape::Sphere { centre: [0.03, 0.0], radius: 0.01 },
            state: at_rest(Phase::Gas, 0.0266, 2118.0),
        }],
        pulses: vec![],
    };
    let setup = FluidSetup {
        domain: Domain { geometry: Geometry::Axisymmetric, z: [0.01, 0.06], r: [0.0, 0.05] },
        coarsest: [cells, cells],
        levels: 0,
        liquid: StiffenedGas { gamma: 7.15, pi: 3e8 },
        gas: StiffenedGas { gamma: 1.4, pi: 0.0 },
        model: fluid::Model::SaurelAbgrall,
        riemann,
        limiter,
        boundaries: [Wall, NonReflecting, Axis, NonReflecting],
        inflow: None,
        adaptation: None,
        scales: fluid::Scales { pressure: 1e6, density: 1e3 },
    };
    FluidSolver::new(&setup, &initial)
}

/// Steel with a smooth axial stress at rest, free above.
fn solid_with_a_pulse<const N: usize>(cells: usize, limiter: Limiter) -> Result<SolidSolver<N>, SolidError> {
    use solid::Boundary::{Axis, Free, NonReflecting};
    let setup = SolidSetup {
        domain: Domain { geometry: Geometry::Axisymmetric, z: [-0.04, 0.01], r: [0.0, 0.05] },
        coarsest: [cells, cells],
        levels: 0,
        speeds: WaveSpeeds { density: 7800.0, c1: 5990.0, c2: 3458.0 },
        yield_strength: 250e6,
        limiter,
        boundaries: [NonReflecting, Free, Axis, NonReflecting],
        adaptation: None,
        stress_scale: 1e6,
    };
    SolidSolver::new(setup, |[z, r]| ElasticState {
        stress_zz: 1e5 * (-((z + 0.01) * (z + 0.01) + r * r) / 1e-5).exp(),
        ..ElasticState::default()
    })
}

/// The unit that machines are compared in: HLLC for an ideal gas as textbooks print it, over one row of faces,
/// one face after the other, with branches, for whatever instruction set the build is for.
///
/// Toro (2009) sect. 10.4, wave speeds of Davis (1988). It must not be improved, or old numbers lose their unit.
struct Calibration {
    density: Vec<f64>,
    normal: Vec<f64>,
    tangential: Vec<f64>,
    pressure: Vec<f64>,
    flux: Vec<[f64; 4]>,
}

impl Calibration {
    const FACES: usize = 4096;
    const GAMMA: f64 = 1.4;
    /// Rows per timing.
    const REPEATS: usize = 400;

    fn new() -> Self {
        // Subsonic and supersonic faces, both directions, in runs of some ten.
        let wave = |rate: f64, mean: f64, size: f64| -> Vec<f64> {
            (0..=Self::FACES).map(|k| mean + size * (rate * k as f64).sin()).collect()
        };
        Self {
            density: wave(0.11, 1.0, 0.3),
            normal: wave(0.071, 0.0, 1.6),
            tangential: wave(0.053, 0.2, 0.1),
            pressure: wave(0.097, 1.0, 0.4),
            flux: vec![[0.0; 4]; Self::FACES],
        }
    }

    fn nanoseconds_per_face(&mut self) -> f64 {
        let start = Instant::now();
        for _ in 0..Self::REPEATS {
            black_box(&mut *self).row();
        }
        black_box(&self.flux);
        start.elapsed().as_secs_f64() * 1e9 / (Self::REPEATS * Self::FACES) as f64
    }

    #[inline(never)]
    fn row(&mut self) {
        for k in 0..Self::FACES {
            let state = |k: usize| [self.density[k], self.normal[k], self.tangential[k], self.pressure[k]];
            self.flux[k] = Self::flux(state(k), state(k + 1));
        }
    }

    fn flux(left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        let sound = |[rho, _, _, p]: [f64; 4]| (Self::GAMMA * p / rho).sqrt();
        let energy = |[rho, u, v, p]: [f64; 4]| p / (Self::GAMMA - 1.0) + 0.5 * rho * (u * u + v * v);
        let physical = |w: [f64; 4]| {
            let [rho, u, v, p] = w;
            [rho * u, rho * u * u + p, rho * u * v, u * (energy(w) + p)]
        };
        let ([rho_l, u_l, _, p_l], [rho_r, u_r, _, p_r]) = (left, right);
        let (c_l, c_r) = (sound(left), sound(right));
        let s_l = (u_l - c_l).min(u_r - c_r);
        let s_r = (u_l + c_l).max(u_r + c_r);
        if s_l >= 0.0 {
            return physical(left);
        }
        if s_r <= 0.0 {
            return physical(right);
        }
        let s_m = (p_r - p_l + rho_l * u_l * (s_l - u_l) - rho_r * u_r * (s_r - u_r))
            / (rho_l * (s_l - u_l) - rho_r * (s_r - u_r));
        let (w, s) = if s_m >= 0.0 { (left, s_l) } else { (right, s_r) };
        let [rho, u, v, p] = w;
        let factor = rho * (s - u) / (s - s_m);
        let total = energy(w);
        let star = [
            factor,
            factor * s_m,
            factor * v,
            factor * (total / rho + (s_m - u) * (s_m + p / (rho * (s - u)))),
        ];
        let own = [rho, rho * u, rho * v, total];
        let mut flux = physical(w);
        for (f, (star, own)) in flux.iter_mut().zip(star.into_iter().zip(own)) {
            *f += s * (star - own);
        }
        flux
    }
}
