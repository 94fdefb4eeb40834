//! What the cells of a fluid obey, and what bounds them.

use std::ops::Range;

use mesh::{Limiter, Step};

use crate::analysis::Analysis;
use crate::boundary::Boundaries;
use crate::boundary::far_field::{FarFieldMemory, Moment};
use crate::boundary::inflow::IncomingWave;
use crate::bubble::follow::Follower;
use crate::components::Component;
use crate::near_wall::expected::Expected;
use crate::phase_change::Exchange;
use crate::reconstruction::dispersion::Dispersion;
use crate::step::clips::SharedCount;
use crate::terms::Terms;
use crate::two_phase::PhaseModel;
use crate::wall_heat::WallMemory;
use crate::{BoundaryLedger, Fixups, Mixture, NearWall, PhaseLedger, RiemannSolver, WallHeat};

/// A fluid of two phases: what its cells obey, and what bounds them.
pub struct Fluid {
    pub(crate) mixture: Mixture,
    pub(crate) scheme: Scheme,
    pub(crate) boundaries: Boundaries,
    pub(crate) terms: Terms,
    /// What walls do with heat, and what the wall on z_min remembers of it, if it conducts.
    pub(crate) wall_heat: WallHeat,
    /// See `wall_heat`.
    pub(crate) wall_memory: Option<WallMemory>,
    /// How the phases change into each other, if they do.
    pub(crate) exchange: Option<Exchange>,
    /// What the mass carries besides, in the order of the field's components after the model's own.
    pub(crate) carried: Vec<Component>,
    /// What the far field remembers.
    pub(crate) far: FarFieldMemory,
    pub(crate) analysis: Analysis,
    pub(crate) near_wall: NearWall,
    /// What adaptation must expect through open sides, if anything.
    pub(crate) incoming: Option<IncomingWave>,
    /// And through the wall: said before each adaptation.
    pub(crate) expected: Expected,
    /// Whether four blocks are stepped as one where they may; what comes of it is the same to the last bit.
    pub(crate) has_tiles: bool,
    /// The bubble that is followed, if one is.
    pub(crate) follower: Option<Follower>,
    /// Whether there is gas in each block, or will be at the end of the step it is in, as the reports have it.
    pub(crate) has_gas: Vec<bool>,
    /// Slots of the blocks along r_min, in order.
    pub(crate) axis_blocks: Vec<usize>,
    pub(crate) tally: Tally,
}

/// How face states and fluxes are made.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scheme {
    pub limiter: Limiter,
    pub riemann: RiemannSolver,
    pub phases: PhaseModel,
}

impl Scheme {
    /// The limiter of the gas fraction's slopes.
    pub fn fraction_limiter(&self) -> Limiter {
        self.phases.fraction_limiter(self.limiter)
    }
}

/// What is added up over a run.
#[derive(Debug, Default)]
pub(crate) struct Tally {
    pub fixups: Fixups,
    /// Traces of the wall that were scaled since the fluid was made or taken up again; they are shown, not made, in a step.
    pub scaled_traces: SharedCount,
    pub ledger: BoundaryLedger,
    pub phases: PhaseLedger,
}

impl Tally {
    /// Corrections made so far.
    pub fn all_fixups(&self) -> Fixups {
        let mut fixups = self.fixups;
        fixups.clips.scaled_traces += self.scaled_traces.get();
        fixups
    }
}

/// A step of the fluid.
pub(crate) type FluidStep<'a, const N: usize> = Step<'a, Fluid, N>;

impl Fluid {
    /// The components of the field that hold what the mass carries.
    pub(crate) fn carried_components(&self) -> Range<usize> {
        self.analysis.carried.clone()
    }

    /// A step as the far field sees it.
    pub(crate) fn moment<const N: usize>(&self, step: &FluidStep<'_, N>) -> Moment<'_> {
        Moment { middle: step.middle(), dt: step.dt, history: &self.far.sources }
    }
}

impl Fluid {
    /// For the faces normal to an axis (0: z, 1: r) of cells of these widths, in a step of length `dt`.
    pub(crate) fn dispersion(&self, widths: [f64; 2], dt: f64, axis: usize) -> Dispersion {
        Dispersion {
            per_speed: dt / widths[axis],
            aspect: widths[axis] / widths[1 - axis],
            liquid_pi: self.mixture.at(0.0).pi,
        }
    }
}
