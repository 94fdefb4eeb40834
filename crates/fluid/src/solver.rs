//! `FluidSolver`: owns the mesh and the fields, and advances them.

use mesh::{
    Adaptation, Domain, Field, Horizon, LevelSteps, Limiter, Mesh, Patch, ScratchPool, Side, SideStates,
    maximum,
};

use serde::{Deserialize, Serialize};

use crate::analysis::{Analysis, Scales};
use crate::block::{BlockScratch, Marks};
use crate::boundary::{Boundaries, PressureHistory, WallState};
use crate::clips::{Clips, SharedCount};
use crate::far_field::{SideImpulses, SourceHistory};
use crate::options::TwoPhaseOptions;
use crate::reflux::{QUANTITIES, Register};
use crate::report::BlockReport;
use crate::state::Contents;
use crate::state::conserved::{COUNT, GAS, PHI};
use crate::steps::check;
use crate::update::Extremes;
use crate::{
    Boundary, FarField, FluidError, InitialCondition, Mixture, Model, Primitive, RayleighField,
    RiemannSolver, Sharpening, StiffenedGas,
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
    pub liquid: StiffenedGas,
    /// The gas's equation of state.
    pub gas: StiffenedGas,
    /// The two-phase model.
    pub model: Model,
    /// What keeps the interface sharp; without a say in the paper's mixture.
    pub sharpening: Sharpening,
    /// The Riemann solver at cell faces.
    pub riemann: RiemannSolver,
    /// The slope limiter.
    pub limiter: Limiter,
    /// What bounds it, in the order of [`Side::ALL`].
    pub boundaries: [Boundary; 4],
    /// What enters through sides of kind [`Boundary::Inflow`].
    pub inflow: Option<PressureHistory>,
    /// What sides of kind [`Boundary::FarField`] hold.
    pub far_field: Option<FarField>,
    /// How the grid adapts; all cells are on the finest level without.
    pub adaptation: Option<Adaptation>,
    /// What adaptation measures details by.
    pub scales: Scales,
}

/// What fills a cell (centre, widths) at t = 0.
pub(crate) type InitialState<'a> = dyn Fn([f64; 2], [f64; 2]) -> Contents + Sync + 'a;

/// Whether a block (low corner, high corner, widths of its cells) is too coarse for what is in it at t = 0.
pub(crate) type AsksForFiner<'a> = dyn Fn([f64; 2], [f64; 2], [f64; 2]) -> bool + Sync + 'a;

/// Corrections that were made where the scheme left the admissible states.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Fixups {
    /// Cell-steps at first order, because a reconstructed face state was not admissible.
    pub first_order: u64,
    /// Cell-steps of mixed cells done again at first order, because a phase would have been drained.
    pub redone: u64,
    /// Volume of those cells, summed over the steps, m³ (per radian in axial symmetry, m² in planar geometry).
    pub redone_volume: f64,
    /// Cell-steps lifted to the pressure floor.
    pub floored: u64,
    /// Volume of those cells, likewise.
    pub floored_volume: f64,
    /// Energy that the floor added, J (per radian in axial symmetry, per metre of depth in planar geometry).
    pub floor_energy: f64,
    /// Mass that the gas got from the liquid in cells where it had less than none, kg (likewise).
    pub gas_mass_added: f64,
    /// Mass that the liquid got from the gas, likewise.
    pub liquid_mass_added: f64,
    /// How often other bounds acted.
    pub clips: Clips,
}

/// What crossed the sides of the domain since the start, inwards, in the order of [`Side::ALL`].
///
/// Per radian in axial symmetry, per metre of depth in planar geometry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BoundaryLedger {
    /// Mass, kg.
    pub mass: [f64; 4],
    /// Axial momentum, N s: what flows in and the impulse of the pressure.
    pub momentum: [f64; 4],
    /// Energy, J.
    pub energy: [f64; 4],
    /// Impulse of p* on the wall to the solid, N s: what the solid got. The momentum through z_min has the ρ*v*² of the
    /// wall's motion besides.
    pub wall_impulse: f64,
    /// Work of p* on the wall to the solid, J: what the fluid got.
    pub wall_work: f64,
}

/// The fluid: state, time, and how to advance it.
///
/// `N` is the number of cells along a block's side.
pub struct FluidSolver<const N: usize> {
    pub(crate) mesh: Mesh<N>,
    pub(crate) mixture: Mixture,
    pub(crate) limiter: Limiter,
    pub(crate) riemann: RiemannSolver,
    pub(crate) two_phase: Option<TwoPhaseOptions>,
    pub(crate) boundaries: Boundaries,
    pub(crate) impulses: SideImpulses,
    pub(crate) sources: SourceHistory,
    pub(crate) state: Field,
    pub(crate) next: Field,
    pub(crate) register: Register<N>,
    pub(crate) levels: LevelSteps<N, QUANTITIES>,
    /// Of each block's last finished step, and of the one it is in.
    pub(crate) reports: Vec<BlockReport<N>>,
    pub(crate) pending: Vec<BlockReport<N>>,
    /// Whether there is gas in each block, as the reports have it.
    pub(crate) has_gas: Vec<bool>,
    pub(crate) marks: Marks,
    pub(crate) analysis: Analysis,
    pub(crate) adaptation: Option<Adaptation>,
    pub(crate) horizon: Horizon,
    pub(crate) patches: ScratchPool<Patch<N>>,
    pub(crate) scratch: ScratchPool<BlockScratch<N>>,
    pub(crate) wall: Vec<WallState>,
    pub(crate) wall_first: Vec<usize>,
    /// Slots of the blocks along z_min and along r_min, in order.
    pub(crate) wall_blocks: Vec<usize>,
    pub(crate) axis_blocks: Vec<usize>,
    pub(crate) time: f64,
    pub(crate) steps: u64,
    pub(crate) cell_updates: u64,
    pub(crate) common_updates: u64,
    pub(crate) fixups: Fixups,
    /// Traces of the wall that were scaled since the fluid was made or taken up again; they are shown, not made, in a step.
    pub(crate) scaled_traces: SharedCount,
    pub(crate) ledger: BoundaryLedger,
}

impl<const N: usize> FluidSolver<N> {
    /// A fluid filled with an initial condition. Scratch is made for the current rayon pool's threads.
    ///
    /// - errors: [`FluidError::Mesh`], [`FluidError::NoInflow`], [`FluidError::Rayleigh`],
    ///   [`FluidError::NonPhysical`].
    pub fn new(setup: &FluidSetup, initial: &InitialCondition) -> Result<Self, FluidError> {
        let mixture = Mixture::new(setup.liquid, setup.gas);
        let Domain { geometry, z: [z_min, _], .. } = setup.domain;
        let field = RayleighField::of(initial, geometry, z_min, setup.boundaries[Side::ZMin as usize])?;
        Self::with(
            setup,
            &|centre, widths| {
                crate::fill::average(initial, field.as_ref(), geometry, &mixture, centre, widths)
            },
            &|low, high, widths| crate::fill::asks_for_finer(initial, low, high, widths),
        )
    }

    /// A fluid filled point by point: `state` gives the primitive variables at a cell's centre (z, r), of one phase
    /// where phases have densities of their own.
    ///
    /// - errors: as [`FluidSolver::new`].
    pub fn from_fn(
        setup: &FluidSetup,
        state: impl Fn([f64; 2]) -> Primitive + Sync,
    ) -> Result<Self, FluidError> {
        Self::with(setup, &|centre, _| state(centre).into(), &|_, _, _| false)
    }

    fn with(
        setup: &FluidSetup,
        initial: &InitialState<'_>,
        asks_for_finer: &AsksForFiner<'_>,
    ) -> Result<Self, FluidError> {
        let kinds = setup.boundaries;
        if kinds.contains(&Boundary::Inflow) && setup.inflow.is_none() {
            return Err(FluidError::NoInflow);
        }
        if kinds.contains(&Boundary::FarField) && setup.far_field.is_none() {
            return Err(FluidError::NoFarField);
        }
        let periodic = [Side::ZMin, Side::RMin].map(|side| kinds[side as usize] == Boundary::Periodic);
        let mixture = Mixture::new(setup.liquid, setup.gas);
        let components = setup.model.components();
        let has_phases = components > COUNT;
        let analysis = Analysis { mixture, boundaries: kinds, scales: setup.scales, has_phases };
        let scratch = ScratchPool::new(|| BlockScratch::new(components));
        let (mesh, state) = crate::adapt::initial_mesh(setup, periodic, &analysis, initial, asks_for_finer)?;
        // By way of the conserved variables, as the cells have it: rest then stays at rest to the last bit.
        let sides = SideStates::new(&mesh, |centre, widths| {
            let Contents { state, gas } = initial(centre, widths);
            (Primitive::from_conserved(state.to_conserved(&mixture), &mixture), gas / state.density)
        });
        let boundaries = Boundaries::new(kinds, sides, setup.inflow.clone(), setup.far_field.clone());
        let mut solver = Self {
            impulses: boundaries.initial_impulses(&mesh, &mixture),
            sources: boundaries.source_history(&setup.domain),
            reports: vec![BlockReport::default(); mesh.blocks()],
            pending: Vec::new(),
            levels: LevelSteps::new(components),
            has_gas: Vec::new(),
            marks: Marks::new(),
            next: state.clone(),
            register: Register::new(mesh.blocks()),
            state,
            limiter: setup.limiter,
            riemann: setup.riemann,
            two_phase: TwoPhaseOptions::of(setup.model, setup.sharpening),
            boundaries,
            analysis,
            adaptation: setup.adaptation.clone(),
            horizon: Horizon::default(),
            patches: ScratchPool::new(|| Patch::zeros(components)),
            scratch,
            wall: Vec::new(),
            wall_first: Vec::new(),
            wall_blocks: Vec::new(),
            axis_blocks: Vec::new(),
            time: 0.0,
            steps: 0,
            cell_updates: 0,
            common_updates: 0,
            fixups: Fixups::default(),
            scaled_traces: SharedCount::default(),
            ledger: BoundaryLedger::default(),
            mixture,
            mesh,
        };
        solver.index_sides();
        for slot in 0..solver.mesh.blocks() {
            solver.measure_speeds(slot);
        }
        solver.pending.clone_from(&solver.reports);
        solver.note_gas();
        solver.follow_sources();
        check(&solver.mesh, &solver.mixture, &solver.state, &solver.reports, 0.0, 1)?;
        Ok(solver)
    }

    /// Numbers the faces of the wall to the solid and the blocks along it and along the axis.
    pub(crate) fn index_sides(&mut self) {
        self.wall_blocks = self.mesh.blocks_along(Side::ZMin);
        self.axis_blocks = self.mesh.blocks_along(Side::RMin);
        self.wall_first = vec![usize::MAX; self.mesh.blocks()];
        let mut faces = 0;
        if self.boundaries.kind(Side::ZMin) == Boundary::Interface {
            for slot in &self.wall_blocks {
                self.wall_first[*slot] = faces;
                faces += N;
            }
        }
        self.wall = vec![WallState::default(); faces];
    }

    /// Keeps the state at a point up to date within steps, too, in which its level makes a longer one.
    pub fn watch(&mut self, point: [f64; 2]) {
        self.levels.watch(point);
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh<N> {
        &self.mesh
    }

    /// The equations of state.
    pub fn mixture(&self) -> &Mixture {
        &self.mixture
    }

    /// Time, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Steps made, of the finest level.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Cells advanced so far, step by step.
    pub fn cell_updates(&self) -> u64 {
        self.cell_updates
    }

    /// Cells that would have been advanced if all levels made the steps of the finest.
    pub fn common_updates(&self) -> u64 {
        self.common_updates
    }

    /// Corrections made so far.
    pub fn fixups(&self) -> Fixups {
        let mut fixups = self.fixups;
        fixups.clips.scaled_traces += self.scaled_traces.get();
        fixups
    }

    /// What crossed the domain's sides so far.
    pub fn ledger(&self) -> &BoundaryLedger {
        &self.ledger
    }

    /// Conserved variables ρ, ρv_z, ρv_r, ρE, φ of all blocks.
    pub fn state(&self) -> &Field {
        &self.state
    }

    /// Speeds in a block of the initial state or one that is new; else they come with each step.
    pub(crate) fn measure_speeds(&mut self, slot: usize) {
        let mut extremes = Extremes::default();
        for k in 0..N * N {
            let u: [f64; COUNT] = std::array::from_fn(|c| self.state.component(slot, c)[k]);
            let w = Primitive::from_conserved(u, &self.mixture);
            let sound = (self.mixture.stiffness(w.pressure, w.phi) / w.density).sqrt();
            let sane = w.density > 0.0 && sound < f64::MAX;
            let speed = |v: f64| if sane { v.abs() + sound } else { f64::INFINITY };
            extremes.speed_z = extremes.speed_z.max(speed(w.v_z));
            extremes.speed_r = extremes.speed_r.max(speed(w.v_r));
        }
        extremes.phi = maximum(self.state.component(slot, PHI));
        self.reports[slot].extremes = extremes;
        let has_any =
            |component: usize| self.state.component(slot, component).iter().any(|value| *value != 0.0);
        self.reports[slot].has_gas = self.two_phase.is_some() && (has_any(PHI) || has_any(GAS));
    }

    /// Tells the far field what the bubbles do; between two steps of the whole.
    pub(crate) fn follow_sources(&mut self) {
        if !self.sources.is_due(self.time) {
            return;
        }
        let mut sources = std::mem::take(&mut self.sources);
        sources.cuts.follow(self);
        sources.sample(self.time, &self.bubbles(&sources.cuts));
        self.sources = sources;
    }

    /// Takes from the reports which blocks have gas, or will have at the end of the step they are in.
    pub(crate) fn note_gas(&mut self) {
        self.has_gas.clear();
        let both = self.reports.iter().zip(&self.pending);
        self.has_gas.extend(both.map(|(report, pending)| report.has_gas | pending.has_gas));
    }

    /// Mean pressure of its level's present or last step on each face of z_min, in the order of r, Pa.
    pub fn wall_face_pressures(&self, pressures: &mut Vec<f64>) {
        pressures.clear();
        for slot in &self.wall_blocks {
            pressures.extend_from_slice(&self.pending[*slot].wall_pressure);
        }
    }

    /// The largest gas fraction in a block, for diagnostics that skip pure liquid.
    pub(crate) fn largest_phi(&self, slot: usize) -> f64 {
        self.reports[slot].extremes.phi
    }
}
