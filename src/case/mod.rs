//! Case files: TOML in SI units, read into a validated [`Case`]. [`keys_page`] lists every key.

mod bubble;
mod check;
mod contact;
mod cross;
mod effective;
mod error;
mod far_field;
#[cfg(test)]
mod fixture;
pub(crate) mod format;
mod identity;
mod implausible;
mod initial_pressure;
mod keys;
mod load;
mod loading;
mod local_steps;
mod materials;
mod memory;
pub mod new;
mod read;
mod read_adaptation;
mod read_bubble;
mod read_conduction;
mod read_coupling;
mod read_fluid;
mod read_grid;
mod read_interest;
mod read_medium;
mod read_near_wall;
mod read_phase_change;
mod read_plasticity;
mod read_pulse;
mod read_sensors;
mod read_shape;
mod read_solid;
mod read_terms;
mod reader;
mod recorded_load;
mod refined;
mod resolution;
mod run_time;
mod scales;
mod set;
mod shared;
pub mod sketch;
mod start_grid;
mod steps;
mod thresholds;
mod values;
mod warnings;

use std::path::PathBuf;

use coupler::{Kappa, Participant, Scheme, StarSolver};
use fluid::{
    Gravity, InitialCondition, Model, NearWall, NobleAbelStiffenedGas, PhaseState, RiemannSolver, Shape,
    Sharpening,
};
use mesh::{Adaptation, Geometry, Limiter, RegionOfInterest, Side};
use solid::{InitialStress, Material, PotentialPulse, Weight};

pub use bubble::{BubbleCase, ResetCase};
pub use check::report;
pub use error::{CaseError, CaseErrors};
pub use keys::adaptation::DEFAULT_ADAPT_EVERY;
pub use keys::{UnknownKey, describe_keys, key_paths, keys_page};
pub use load::{GaussianLoad, LoadCase};
pub use local_steps::LocalSteps;
pub use materials::materials_table;
pub use memory::{Memory, available_memory};
pub use read::MOST_SNAPSHOTS;
pub use read_adaptation::DEFAULT_ERROR;
pub use read_terms::TermsCase;
pub use recorded_load::{RecordedLoad, from_where};
pub use steps::SMALLEST_STEP;

/// A case: everything that says what a run computes, checked and with all defaults filled in.
#[derive(Clone, Debug)]
pub struct Case {
    /// What the case is called: the name of its file without `.toml`.
    pub name: String,
    /// Rotation about r = 0 or plane strain.
    pub geometry: Geometry,
    /// How long, in what steps, and when fields are written.
    pub time: Time,
    /// The fluid's side; at least one of the two sides is there.
    pub fluid: Option<FluidCase>,
    /// The solid's side; absent where the scheme has no solid, even if the file describes one.
    pub solid: Option<SolidCase>,
    /// How the two meet.
    pub coupling: CouplingCase,
    /// Points at which every step is recorded.
    pub probes: Vec<Probe>,
    /// `[[sensor]]`.
    pub sensors: Vec<Sensor>,
    /// What is written, and where.
    pub output: OutputCase,
    /// What was left aside in reading; see [`Case::warnings`].
    notes: Vec<String>,
}

/// Equal when they compute the same; what was left aside in reading does not count.
impl PartialEq for Case {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
            && self.geometry == other.geometry
            && self.time == other.time
            && self.fluid == other.fluid
            && self.solid == other.solid
            && self.coupling == other.coupling
            && self.probes == other.probes
            && self.sensors == other.sensors
            && self.output == other.output
    }
}

impl Case {
    /// Where the answer is, if the grids that adapt follow what reaches it.
    pub fn region_of_interest(&self) -> Option<RegionOfInterest> {
        let fluid = self.fluid.as_ref().and_then(|fluid| fluid.grid.adaptation.as_ref());
        let solid = self.solid.as_ref().and_then(|solid| solid.grid.adaptation.as_ref());
        fluid.or(solid)?.interest
    }
}

/// `[time]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Time {
    /// End of the run, s; at the latest, if it ends when the surface is still.
    pub end: f64,
    /// Whether it ends when the solid's surface is still after the last load.
    pub settles: bool,
    /// Δt over the smallest h/(|v| + c) of a cell; in (0, 0.9].
    pub cfl: f64,
    /// Whether coarse levels make longer steps than fine ones.
    pub local_steps: LocalSteps,
    /// When fields are written, s: ascending, from 0 to `end`, both included.
    pub snapshots: Vec<f64>,
}

/// The cells of one side.
#[derive(Clone, Debug, PartialEq)]
pub struct GridCase {
    /// Range in z, m.
    pub z: [f64; 2],
    /// Range in r, m.
    pub r: [f64; 2],
    /// Cells along z and r on the coarsest level.
    pub cells: [usize; 2],
    /// How often the coarsest cells are halved.
    pub levels: usize,
    /// How the grid adapts; `None` where all cells are on the finest level.
    pub adaptation: Option<Adaptation>,
}

impl GridCase {
    /// Cells along z and r on a level.
    pub fn cells_on(&self, level: usize) -> [usize; 2] {
        self.cells.map(|cells| cells << level)
    }

    /// Cells along z and r on the finest level.
    pub fn finest(&self) -> [usize; 2] {
        self.cells_on(self.levels)
    }

    /// The level of the coarsest blocks: the first whose cells fill whole blocks in both directions.
    pub fn root_level(&self) -> usize {
        read_grid::root_level(self.cells, self.levels)
    }

    /// Blocks along z and r on the finest level.
    pub fn blocks(&self) -> [usize; 2] {
        self.finest().map(|cells| cells / mesh::BLOCK)
    }

    /// Widths of the finest cells along z and r, m.
    pub fn cell_size(&self) -> [f64; 2] {
        let [cells_z, cells_r] = self.finest();
        [(self.z[1] - self.z[0]) / cells_z as f64, (self.r[1] - self.r[0]) / cells_r as f64]
    }

    /// Number of cells where all are on the finest level.
    pub fn cell_count(&self) -> usize {
        let [cells_z, cells_r] = self.finest();
        cells_z * cells_r
    }

    /// Whether the closed rectangle has the point (z, r) in it.
    pub fn contains(&self, [z, r]: [f64; 2]) -> bool {
        (self.z[0]..=self.z[1]).contains(&z) && (self.r[0]..=self.r[1]).contains(&r)
    }
}

/// `[fluid]` and what is below it.
#[derive(Clone, Debug, PartialEq)]
pub struct FluidCase {
    /// Domain and cells.
    pub grid: GridCase,
    /// The liquid's equation of state.
    pub liquid: NobleAbelStiffenedGas,
    /// The gas's equation of state.
    pub gas: NobleAbelStiffenedGas,
    /// What fills the domain at t = 0.
    pub initial: InitialCondition,
    /// The four sides in the order of [`Side::ALL`].
    pub boundary: [fluid::Boundary; 4],
    /// The pressure history of the sides that are inflows; present if there is one.
    pub inflow: Option<Inflow>,
    /// The solver at cell faces.
    pub riemann: RiemannSolver,
    /// The two-phase model.
    pub model: Model,
    /// What keeps the interface sharp.
    pub sharpening: Sharpening,
    /// The limiter of the reconstruction.
    pub limiter: Limiter,
    /// How far the grid rises above its levels next to the wall.
    pub near_wall: NearWall,
    /// Reference value of the pressure in the thresholds of adaptation, Pa.
    pub scale_pressure: f64,
    /// The same of the density, kg/m³.
    pub scale_density: f64,
    /// Threshold of pressure and velocity on an adaptive grid; that of density and gas fraction is the grid's own.
    pub wave_epsilon: f64,
    /// Gravity along z, if any.
    pub gravity: Option<Gravity>,
    /// The bubble that is described by what is in it, if one is.
    pub bubble: Option<BubbleCase>,
    /// What acts besides.
    pub terms: TermsCase,
    /// Where the passive tracer is at t = 0, if there is one.
    pub tracer: Option<Shape>,
}

impl FluidCase {
    /// The temperature of the liquid far away, K, and the pressure of its saturated vapour, Pa; each `None` where the laws know none.
    pub(crate) fn warmth(&self) -> (Option<f64>, Option<f64>) {
        let ambient = &self.initial.ambient;
        let temperature = self.liquid.temperature(ambient.density, ambient.pressure);
        let saturation = fluid::Saturation::of(&fluid::Mixture::new(self.liquid, self.gas));
        let below = temperature.filter(|temperature| *temperature < fluid::Saturation::CRITICAL[0]);
        (temperature, saturation.zip(below).map(|(saturation, temperature)| saturation.pressure(temperature)))
    }

    /// The equation of state of the phase of a state.
    pub fn eos(&self, state: &PhaseState) -> NobleAbelStiffenedGas {
        match state.phase {
            fluid::Phase::Liquid => self.liquid,
            fluid::Phase::Gas => self.gas,
        }
    }
}

/// `[fluid.inflow]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Inflow {
    /// Times (s, ascending) and pressures (Pa), linear in between, constant before and after.
    pub pressure: Vec<[f64; 2]>,
}

/// `[solid]` and what is below it.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidCase {
    /// Domain and cells.
    pub grid: GridCase,
    /// What it is made of.
    pub material: Material,
    /// How it yields and hardens; elastic without.
    pub plasticity: Option<solid::plasticity::Hardening>,
    /// Its own weight, if it counts.
    pub weight: Option<Weight>,
    /// The stress at t = 0 that carries the fluid's ambient pressure.
    pub initial_stress: InitialStress,
    /// The four sides in the order of [`Side::ALL`].
    pub boundary: [solid::Boundary; 4],
    /// The run whose wall this one begins with, if it has been hit before.
    pub initial: Option<PathBuf>,
    /// The limiter of the reconstruction.
    pub limiter: Limiter,
    /// Waves that are there at t = 0.
    pub pulses: Vec<PotentialPulse>,
    /// Reference value of the stresses in the thresholds of adaptation, Pa.
    pub scale_stress: f64,
}

impl SolidCase {
    /// Where it begins to yield, Pa: its hardening law's, else the material's, if it has any.
    pub fn yield_strength(&self) -> Option<f64> {
        let of_law = |law: &solid::plasticity::Hardening| {
            law.yield_stress(0.0, 0.0, law.reference_temperature().unwrap_or(0.0))
        };
        self.plasticity.as_ref().map(of_law).or(self.material.yield_strength())
    }
}

/// `[coupling]`.
#[derive(Clone, Debug, PartialEq)]
pub struct CouplingCase {
    /// How the sides meet.
    pub scheme: Scheme,
    /// How the fluid answers in the interface problem.
    pub star: StarSolver,
    /// The paper's factors of the weak scheme.
    pub kappa: Kappa,
    /// The most steps that one side makes within one of the other; 1: both make the same.
    pub step_ratio: u32,
    /// Who makes the step first in the weak and the strong scheme.
    pub first: Participant,
    /// When the strong scheme's iteration ends: the largest change of what crosses the interface, as a share of it.
    pub tolerance: f64,
    /// Its most iterations a step.
    pub max_iterations: u32,
    /// What presses on a solid without a fluid; present if the scheme is [`Scheme::Load`].
    pub load: Option<LoadCase>,
    /// How long a side waits for the other to appear, s.
    pub connect_timeout: f64,
    /// How long a side waits for the other within a step, s.
    pub patience: f64,
}

mesh::named! {
    /// One of the two media.
    pub enum Medium {
        /// The fluid.
        Fluid = "fluid",
        /// The solid.
        Solid = "solid",
    }
}

/// `[[probe]]`: a point at which all fields of a medium are recorded every step.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Name, unique; letters, digits, `_` and `-`.
    pub name: String,
    /// The point (z, r), m, within the closed domain of the medium.
    pub position: [f64; 2],
    /// Whose fields.
    pub medium: Medium,
}

/// `[[sensor]]`: a disc on the wall about the axis (planar: the wall up to an r), on which pressure, force and impulse are recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// Name, unique; letters, digits, `_` and `-`.
    pub name: String,
    /// Its radius, m.
    pub radius: f64,
    /// Over how long it takes the mean, s; 0: over each step.
    pub rise_time: f64,
}

/// `[output]`.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputCase {
    /// The run directory; the command line's choice comes first, then this, then one by the case's name.
    pub directory: Option<PathBuf>,
    /// Cell fields to write; all of them if absent.
    pub fields: Option<Vec<String>>,
    /// Level of compression, 0 (none) to 9.
    pub compression: u8,
    /// Cells of the radial grid of the interface's history; the finest fluid faces if absent.
    pub interface_cells: Option<usize>,
    /// Interval of the histories of the interface and of the conserved quantities, s; a thousandth of the run if
    /// absent.
    pub interface_every: Option<f64>,
    /// Over how long the wall pressure's running mean is taken, s; by the bubble's size if absent.
    pub mean_time: Option<f64>,
}

impl Case {
    /// Time between two rows of the slower histories, s: `output.interface_every`, or a thousandth of the run.
    #[must_use]
    pub fn interface_every(&self) -> f64 {
        self.output.interface_every.unwrap_or(1e-3 * self.time.end)
    }

    /// The pressure that the solid's initial stress carries far from what is in the fluid, Pa; 0 where there is neither a fluid nor a
    /// record of one.
    #[must_use]
    pub fn ambient_pressure(&self) -> f64 {
        match (&self.fluid, &self.coupling.load) {
            (Some(fluid), _) => fluid.initial.ambient.pressure,
            (None, Some(LoadCase::Recorded(load))) => load.ambient(),
            (None, _) => 0.0,
        }
    }
}

/// The place of a side in arrays over sides.
const fn index(side: Side) -> usize {
    side as usize
}
