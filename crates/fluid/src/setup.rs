//! What defines a fluid, and what fills it.

use mesh::{Adaptation, Domain, Limiter};

use crate::analysis::Scales;
use crate::boundary::history::PressureHistory;
use crate::state::Contents;
use crate::{
    Boundary, Conduction, FarField, FollowedBubble, Gravity, Mixture, Model, NearWall, NobleAbelStiffenedGas,
    PhaseChange, RiemannSolver, Shape, Sharpening, StiffenedGas, SurfaceTension, Viscosity,
};

/// Everything that defines a fluid.
#[derive(Clone, Debug)]
pub struct FluidSetup {
    /// Where it is.
    pub domain: Domain,
    /// Cells of the coarsest grid along z and r.
    pub coarsest: [usize; 2],
    /// Levels of refinement: the finest grid has `coarsest · 2^levels` cells.
    pub levels: u8,
    /// The liquid's equation of state.
    pub liquid: NobleAbelStiffenedGas,
    /// The gas's equation of state.
    pub gas: NobleAbelStiffenedGas,
    /// The two-phase model.
    pub model: Model,
    /// What keeps the interface sharp; without a say in the paper's mixture.
    pub sharpening: Sharpening,
    /// The Riemann solver at cell faces.
    pub riemann: RiemannSolver,
    /// The slope limiter.
    pub limiter: Limiter,
    /// What bounds it, in the order of [`mesh::Side::ALL`].
    pub boundaries: [Boundary; 4],
    /// What enters through sides of kind [`Boundary::Inflow`].
    pub inflow: Option<PressureHistory>,
    /// What sides of kind [`Boundary::FarField`] hold.
    pub far_field: Option<FarField>,
    /// How the grid adapts; all cells are on the finest level without.
    pub adaptation: Option<Adaptation>,
    /// How far it rises next to the wall; the adaptation's `above` says how many levels it has for that.
    pub near_wall: NearWall,
    /// What adaptation measures details by.
    pub scales: Scales,
    /// Gravity along z, if any.
    pub gravity: Option<Gravity>,
    /// Viscosity of both phases, if any; the fluid then sticks to walls.
    pub viscosity: Option<Viscosity>,
    /// Conduction of heat in both phases, if any; both need heat capacities.
    pub conduction: Option<Conduction>,
    /// The bubble that the grid follows, or whose gas is cut, if any.
    pub followed: Option<FollowedBubble>,
    /// The tension of the interface between gas and liquid, if any.
    pub surface_tension: Option<SurfaceTension>,
    /// How the phases change into each other, if they do; not in the paper's mixture.
    pub phase_change: Option<PhaseChange>,
    /// Where there is a passive tracer at t = 0, if any: its mass fraction is 1 within and 0 beyond.
    pub tracer: Option<Shape>,
}

impl FluidSetup {
    /// Water and air on one grid of `cells`, with the default of every choice; to be changed as a struct is: `FluidSetup { limiter,
    /// ..FluidSetup::new(domain, cells, sides) }`.
    pub fn new(domain: Domain, cells: [usize; 2], boundaries: [Boundary; 4]) -> Self {
        Self {
            domain,
            coarsest: cells,
            levels: 0,
            liquid: StiffenedGas { gamma: 7.15, pi: 3e8 }.into(),
            gas: StiffenedGas { gamma: 1.4, pi: 0.0 }.into(),
            model: Model::FiveEquation,
            sharpening: Sharpening::Thinc,
            riemann: RiemannSolver::Hllc,
            limiter: Limiter::Mc,
            boundaries,
            inflow: None,
            far_field: None,
            adaptation: None,
            near_wall: NearWall::default(),
            scales: Scales { pressure: 1e6, density: 1e3 },
            gravity: None,
            viscosity: None,
            conduction: None,
            followed: None,
            surface_tension: None,
            phase_change: None,
            tracer: None,
        }
    }

    /// Both phases. In the five-equation model traces of gas stay closed in liquid under tension; where phases change, vapour may grow from them.
    pub(crate) fn mixture(&self) -> Mixture {
        let mixture = Mixture::new(self.liquid, self.gas);
        let has_closed_traces = self.model == Model::FiveEquation && self.phase_change.is_none();
        if has_closed_traces { mixture.with_closed_traces() } else { mixture }
    }

    /// Components of the field: the model's, and those that the mass carries besides.
    pub(crate) fn field_components(&self) -> usize {
        self.model.components() + crate::components::of(self).len()
    }
}

/// What fills a cell (centre, widths) at t = 0.
pub(crate) type InitialState<'a> = dyn Fn([f64; 2], [f64; 2]) -> Contents + Sync + 'a;

/// Whether a block (low corner, high corner, widths of its cells) is too coarse for what is in it at t = 0.
pub(crate) type AsksForFiner<'a> = dyn Fn([f64; 2], [f64; 2], [f64; 2]) -> bool + Sync + 'a;
