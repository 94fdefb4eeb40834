//! `FluidSolver`: owns the mesh and the fields, and advances them.

use mesh::{
    Adaptation, Domain, Field, Horizon, Limiter, Mesh, Patch, ScratchPool, Side, SideStates, for_each_block,
    for_some_blocks, maximum,
};

use crate::analysis::{Analysis, Scales};
use crate::block::{BlockReport, BlockScratch, Marks, StepContext, step_block};
use crate::boundary::{Boundaries, PressureHistory, WallState};
use crate::five_equation::marked_blocks;
use crate::options::TwoPhaseOptions;
use crate::reflux::{self, Register};
use crate::state::Contents;
use crate::state::conserved::{COUNT, GAS, PHI};
use crate::update::Extremes;
use crate::{
    Boundary, FluidError, InitialCondition, Mixture, Model, Primitive, RayleighField, RiemannSolver,
    Sharpening, StiffenedGas,
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
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
}

/// What crossed the sides of the domain since the start, inwards, in the order of [`Side::ALL`].
///
/// Per radian in axial symmetry, per metre of depth in planar geometry.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
    pub(crate) state: Field,
    pub(crate) next: Field,
    pub(crate) register: Register<N>,
    pub(crate) reports: Vec<BlockReport<N>>,
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
    steps: u64,
    cell_updates: u64,
    fixups: Fixups,
    ledger: BoundaryLedger,
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
        let mut solver = Self {
            reports: vec![BlockReport::default(); mesh.blocks()],
            has_gas: Vec::new(),
            marks: Marks::new(),
            next: state.clone(),
            register: Register::new(mesh.blocks()),
            state,
            limiter: setup.limiter,
            riemann: setup.riemann,
            two_phase: TwoPhaseOptions::of(setup.model, setup.sharpening),
            boundaries: Boundaries::new(kinds, sides, setup.inflow.clone()),
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
            fixups: Fixups::default(),
            ledger: BoundaryLedger::default(),
            mixture,
            mesh,
        };
        solver.index_sides();
        for slot in 0..solver.mesh.blocks() {
            solver.measure_speeds(slot);
        }
        solver.note_gas();
        solver.check(0.0)?;
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

    /// Steps made.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Cells advanced so far, step by step.
    pub fn cell_updates(&self) -> u64 {
        self.cell_updates
    }

    /// Corrections made so far.
    pub fn fixups(&self) -> Fixups {
        self.fixups
    }

    /// What crossed the domain's sides so far.
    pub fn ledger(&self) -> &BoundaryLedger {
        &self.ledger
    }

    /// Conserved variables ρ, ρv_z, ρv_r, ρE, φ of all blocks.
    pub fn state(&self) -> &Field {
        &self.state
    }

    /// The largest |v| + c along z and r, m/s.
    pub fn largest_speeds(&self) -> [f64; 2] {
        self.reports.iter().fold([0.0_f64; 2], |[z, r], report| {
            [z.max(report.extremes.speed_z), r.max(report.extremes.speed_r)]
        })
    }

    /// The largest step that the Courant number allows, s:
    /// cfl · min over cells of min(h_z/(|v_z| + c), h_r/(|v_r| + c)).
    pub fn time_step_limit(&self, cfl: f64) -> f64 {
        (self.mesh.tree().leaves().iter().zip(&self.reports)).fold(f64::INFINITY, |limit, (id, report)| {
            let [h_z, h_r] = self.mesh.widths(id.level);
            limit.min(cfl * h_z / report.extremes.speed_z).min(cfl * h_r / report.extremes.speed_r)
        })
    }

    /// Advances by `dt`. With a solid behind z_min the wall's state must have been set, see
    /// [`FluidSolver::set_wall`].
    ///
    /// - errors: [`FluidError::NonPhysical`]; the state before the step is then kept.
    pub fn step(&mut self, dt: f64) -> Result<(), FluidError> {
        let fastest = self.largest_speeds();
        let mut next = std::mem::replace(&mut self.next, Field::zeros(0, 0, 0));
        let mut reports = std::mem::take(&mut self.reports);
        let mut register = std::mem::replace(&mut self.register, Register::new(0));
        let context = StepContext { fastest, ..self.context(dt) };
        for_each_block(&mut next, register.values_mut(), &mut reports, |slot, new, fluxes, report| {
            *report = self.scratch.with(|scratch| step_block(&context, slot, new, fluxes, scratch));
        });
        if reports.iter().any(|report| report.marked > 0) {
            self.redo_marked(&context, &mut next, &mut register, &mut reports);
        }
        let is_due = |slot: usize| Register::is_due(&self.mesh, slot);
        for_some_blocks(&mut next, &mut reports, is_due, |slot, new, report| {
            reflux::correct(&context, &register, slot, new, report);
        });
        (self.next, self.reports, self.register) = (next, reports, register);
        std::mem::swap(&mut self.state, &mut self.next);
        if let Err(error) = self.check(self.time + dt) {
            std::mem::swap(&mut self.state, &mut self.next);
            return Err(error);
        }
        self.note_gas();
        self.account();
        self.account_wall(dt);
        self.time += dt;
        self.steps += 1;
        self.cell_updates += self.mesh.cells() as u64;
        Ok(())
    }

    /// Does the blocks around marked cells again, with those cells at first order.
    fn redo_marked(
        &self,
        context: &StepContext<'_, N>,
        next: &mut Field,
        register: &mut Register<N>,
        reports: &mut [BlockReport<N>],
    ) {
        let marked: Vec<usize> = reports
            .iter()
            .enumerate()
            .filter(|(_, report)| report.marked > 0)
            .map(|(slot, _)| slot)
            .collect();
        let mut step = |context: &StepContext<'_, N>, slot: usize| {
            self.scratch.with(|scratch| {
                let fluxes = register.values_mut().block_mut(slot);
                reports[slot] = step_block(context, slot, next.block_mut(slot), fluxes, scratch);
                scratch.marked_cells().to_vec()
            })
        };
        // Which cells they are is still in the scratch of a block's step, and only there.
        let marks: Marks = marked.into_iter().map(|slot| (slot, step(context, slot))).collect();
        let context = StepContext { marks: &marks, ..*context };
        for slot in marked_blocks(&self.mesh, &marks) {
            step(&context, slot);
        }
        for (slot, cells) in &marks {
            let id = self.mesh.tree().leaves()[*slot];
            reports[*slot].redone = cells.len() as u32;
            reports[*slot].redone_volume = cells.iter().map(|cell| self.mesh.volume(id, cell / N)).sum();
        }
    }

    /// Impulse and work of the wall's states in a step of length `dt`.
    fn account_wall(&mut self, dt: f64) {
        if self.wall.is_empty() {
            return;
        }
        for (first, &slot) in self.wall_blocks.iter().enumerate() {
            let id = self.mesh.tree().leaves()[slot];
            let h_r = self.mesh.widths(id.level)[1];
            for j in 0..N {
                let area = self.mesh.weight(self.mesh.centre(id, 0, j)[1]) * h_r;
                let state = self.wall[first * N + j];
                self.ledger.wall_impulse += dt * area * state.pressure;
                self.ledger.wall_work += dt * area * state.power;
            }
        }
    }

    /// Adds up the blocks' reports in the order of their slots, so that sums do not depend on threads.
    fn account(&mut self) {
        for report in &self.reports {
            self.fixups.first_order += u64::from(report.fallbacks);
            self.fixups.redone += u64::from(report.redone);
            self.fixups.redone_volume += report.redone_volume;
            self.fixups.floored_volume += report.floored_volume;
            self.fixups.floored += u64::from(report.floored);
            self.fixups.floor_energy += report.floor_energy;
            for (side, [mass, momentum, energy]) in report.inflow.into_iter().enumerate() {
                self.ledger.mass[side] += mass;
                self.ledger.momentum[side] += momentum;
                self.ledger.energy[side] += energy;
            }
        }
    }

    /// Fails if a cell is not physical; its speed is then infinite.
    fn check(&self, time: f64) -> Result<(), FluidError> {
        if self.largest_speeds().iter().all(|speed| speed.is_finite()) {
            return Ok(());
        }
        for (slot, id) in self.mesh.tree().leaves().iter().enumerate() {
            for j in 0..N {
                for i in 0..N {
                    let u: [f64; COUNT] = std::array::from_fn(|c| self.state.component(slot, c)[j * N + i]);
                    let w = Primitive::from_conserved(u, &self.mixture);
                    let stiffness = self.mixture.stiffness(w.pressure, w.phi);
                    if w.density > 0.0 && stiffness >= 0.0 && (stiffness / w.density).is_finite() {
                        continue;
                    }
                    let [z, r] = self.mesh.centre(*id, i, j);
                    let [density, _, _, energy, phi] = u;
                    let step = self.steps + 1;
                    return Err(FluidError::NonPhysical { z, r, time, step, density, energy, phi });
                }
            }
        }
        Ok(())
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

    /// Takes from the reports which blocks have gas.
    pub(crate) fn note_gas(&mut self) {
        self.has_gas.clear();
        self.has_gas.extend(self.reports.iter().map(|report| report.has_gas));
    }

    /// Mean pressure of the last step on each face of z_min, in the order of r, Pa.
    pub fn wall_face_pressures(&self, pressures: &mut Vec<f64>) {
        pressures.clear();
        for slot in &self.wall_blocks {
            pressures.extend_from_slice(&self.reports[*slot].wall_pressure);
        }
    }

    /// The largest gas fraction in a block, for diagnostics that skip pure liquid.
    pub(crate) fn largest_phi(&self, slot: usize) -> f64 {
        self.reports[slot].extremes.phi
    }
}
