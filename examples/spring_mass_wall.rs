//! A wall of our own against cav's fluid: a rigid mass on a spring, hit by a plane pulse in water.
//!
//! In one process:
//!     cargo run --release --example spring_mass_wall
//! In two, each in a terminal of its own; the wall may be any program that speaks through `coupler`:
//!     cargo run --release -- fluid cases/spring-mass-wall.toml --run demo
//!     cargo run --release --example spring_mass_wall -- demo

use std::error::Error;
use std::path::Path;

use cav::case::Case;
use cav::run::process::stop::Stop;
use cav::run::side::RunSide;
use cav::run::side::fluid_side::{FluidSide, Turn};
use coupler::{
    Endpoint, FluidStep, Participant, ProcessLink, WallMeans, WallParticipant, direct_pair,
    fluid_at_moving_wall,
};

/// Per area of the wall: mass, kg/m², and stiffness of the spring, Pa/m.
const MASS: f64 = 20.0;
const STIFFNESS: f64 = 4e12;
/// The pressure behind the wall, which is the liquid's at rest, Pa.
const BEHIND: f64 = 1e5;

/// The wall: displacement and velocity along +z, into the liquid, and where it was when.
#[derive(Default)]
struct SpringMass {
    displacement: f64,
    velocity: f64,
    history: Vec<[f64; 2]>,
}

impl SpringMass {
    /// Moves through a step of the fluid, and says what the interface did meanwhile.
    ///
    /// m v' = −k x − (p − p₀) by the implicit midpoint rule: the liquid's answer to a moving wall, p = p_f + Z (v − v_f), is
    /// linear enough to be part of the equation, so a wall may be as light as it likes.
    fn respond(&mut self, step: &FluidStep<'_>, means: &mut WallMeans<'_>) {
        let (half, middle) = (0.5 * step.dt, step.begin + 0.5 * step.dt);
        let faces = step.edges().len();
        let (mut pressure, mut impedance) = (0.0, 0.0);
        for face in 0..faces {
            let fluid = step.trace_at(face, middle);
            pressure += (fluid.pressure - fluid.impedance() * fluid.velocity) / faces as f64;
            impedance += fluid.impedance() / faces as f64;
        }
        let force = -STIFFNESS * self.displacement - (pressure - BEHIND);
        let velocity = (MASS * self.velocity + half * force) / (MASS + half * (impedance + half * STIFFNESS));
        for face in 0..faces {
            means.add(face, 1.0, &fluid_at_moving_wall(&step.trace_at(face, middle), velocity));
        }
        self.displacement += step.dt * velocity;
        self.velocity = 2.0 * velocity - self.velocity;
        self.history.push([step.begin + step.dt, self.displacement]);
    }
}

/// The exact displacement at the times of a history, by small steps of the same equation under twice the incident pulse.
fn exact(times: impl Iterator<Item = f64>) -> Vec<f64> {
    let sound = (7.15 * (BEHIND + 3e8) / 1000.0_f64).sqrt();
    let pulse = |t: f64| 1e4 * (-((0.012 - sound * t) / 0.003).powi(2)).exp();
    let (h, mut t, mut x, mut v) = (1e-10, 0.0, 0.0, 0.0);
    let mut at = Vec::new();
    for time in times {
        while t < time {
            let force = -STIFFNESS * x - 2.0 * pulse(t + 0.5 * h);
            let middle =
                (MASS * v + 0.5 * h * force) / (MASS + 0.5 * h * (1e3 * sound + 0.5 * h * STIFFNESS));
            (x, v, t) = (x + h * middle, 2.0 * middle - v, t + h);
        }
        at.push(x + (time - t) * v);
    }
    at
}

/// Runs the case and returns the largest displacement, m, and the largest difference to the exact one over it.
///
/// - `run`: joins the fluid's process of that name; without one, the fluid runs here, turn by turn.
pub fn run(case: &Path, run: Option<&str>) -> Result<[f64; 2], Box<dyn Error>> {
    let case = Case::load(case, &[])?;
    let (mut wall, mut mass) = (WallParticipant::default(), SpringMass::default());
    if let Some(name) = run {
        let mut link = ProcessLink::connect(Endpoint::new(name, Participant::Solid, case.hash()))?;
        wall.open(&mut link)?;
        while wall.turn(&mut link, |step, means| mass.respond(step, means))? {}
    } else {
        let fluid = case.fluid.as_ref().ok_or("the case has no fluid")?;
        let mut fluid = FluidSide::new(&case, fluid, None)?;
        let (mut to_wall, mut to_fluid) = direct_pair(case.hash());
        wall.open(&mut to_fluid)?;
        while fluid.turn(&mut to_wall, &Stop::default())? == Turn::Continues {
            wall.turn(&mut to_fluid, |step, means| mass.respond(step, means))?;
        }
    }
    let exact = exact(mass.history.iter().map(|row| row[0]));
    let largest = exact.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let off = mass.history.iter().zip(&exact).fold(0.0_f64, |most, (row, x)| most.max((row[1] - x).abs()));
    Ok([largest, off / largest])
}

// A program that tells its result.
#[allow(clippy::print_stdout)]
fn main() -> Result<(), Box<dyn Error>> {
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/spring-mass-wall.toml");
    let [largest, off] = run(&case, std::env::args().nth(1).as_deref())?;
    println!("largest displacement {:.3} nm, off the exact one by {:.3} % of it", largest * 1e9, off * 100.0);
    Ok(())
}
