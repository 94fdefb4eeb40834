//! The solid as one side of the interface: the only place where it meets the coupler.

use std::sync::PoisonError;

use coupler::{CommonRefinement, FaceTrace, InterfaceStar, RegisterRow, TraceRow};
use mesh::{BLOCK, Geometry, GroupStep, Padded, Side};

use crate::SolidSolver;
use crate::boundary::Boundaries;
use crate::components::{PLASTIC_STRAIN, TEMPERATURE};
use crate::physics::SolidStep;
use crate::plasticity::{Plasticity, Returned, Stress};
use crate::state::component::{S_NORMAL, S_PHIPHI, S_ZR, V_R, V_Z};
use crate::step::rows::{Elasticity, rates};
use crate::step::{BlockScratch, reconstruct};

/// What the solid knows of its interface with the fluid in the weak scheme: faces, sub-faces, and the last step's states.
#[derive(Clone, Debug, Default)]
pub struct WeakExchange {
    edges: Vec<f64>,
    /// The mesh whose faces the edges are of.
    generation: Option<u64>,
    refinement: CommonRefinement,
    stars: Vec<InterfaceStar>,
    traces: Vec<SurfaceTrace>,
    /// Velocities of the cells under the surface, for the weak scheme.
    cells: Vec<f64>,
}

/// The solid's own state on one face of its surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceTrace {
    /// −σ_zz, Pa.
    pub pressure: f64,
    /// v_z, m/s.
    pub velocity: f64,
    /// v_r, m/s.
    pub tangential_velocity: f64,
    /// σ_zr, Pa.
    pub shear: f64,
    /// Of the wave that leaves the surface, Pa s/m: ρ̄c₁, where the cell below flows ρ̄ times the speed of the plastic wave.
    pub impedance: f64,
}

/// The traces on a block's faces.
pub(crate) type BlockTraces<const N: usize> = [FaceTrace; N];

impl SolidSolver<BLOCK> {
    /// [`SolidSolver::write_trace`], compiled here as [`mesh::CompiledSolver`] is.
    pub fn compiled_trace(
        &self,
        dt: f64,
        due: &dyn Fn(usize) -> bool,
        put: &mut dyn FnMut(TraceRow, usize, f64),
    ) {
        self.write_trace(dt, due, put);
    }
}

impl<const N: usize> SolidSolver<N> {
    /// Writes the traces on the surface at the present time and their rates of change.
    ///
    /// The trace at time t is the reconstructed state on the face plus (t − tⁿ) times the rate that the predictor uses; at
    /// mid-step it is what the face's Riemann problem would see.
    ///
    /// - `dt`: the step about to be made, s: what the trace gets besides depends on it, see [`mesh::dispersion_share`].
    /// - `due`: of the slot of a block, whether the traces on its faces are wanted.
    /// - `put`: gets the place and one [`TraceRow`] of a face.
    pub fn write_trace(
        &self,
        dt: f64,
        due: impl Fn(usize) -> bool,
        mut put: impl FnMut(TraceRow, usize, f64),
    ) {
        let context = self.context(dt);
        let of_block =
            |slot: usize| self.with_scratch(|scratch| self.traces_of_block(&context, slot, scratch));
        let mut made = self.1.lock().unwrap_or_else(PoisonError::into_inner);
        let firsts = self.map_interface(due, of_block, &mut made);
        for (first, traces) in firsts.into_iter().zip(&*made) {
            FaceTrace::put_all(traces, first, &mut put);
        }
    }

    /// The traces on a block's faces.
    fn traces_of_block(
        &self,
        context: &SolidStep<'_, N>,
        slot: usize,
        scratch: &mut BlockScratch<N>,
    ) -> BlockTraces<N> {
        let widths = self.mesh().widths(self.mesh().tree().leaves()[slot].level);
        let inverse_h = widths.map(|h| 1.0 / h);
        let dt = context.dt;
        let [share, _] = context.model.dispersion(widths, dt, 0);
        reconstruct(context, slot, scratch);
        let BlockScratch { cells, s_z, s_r, inverse_r, .. } = scratch;
        Boundaries::complete_shear_differences(self.setup().limiter, |c| cells.component(c), s_z);
        std::array::from_fn(|j| {
            let k = Padded::<N>::index(N as isize - 1, j as isize);
            let w: [f64; 6] = std::array::from_fn(|c| cells.component(c)[k]);
            // The hoop stress has no difference: no derivative of it enters.
            let of = |rows: &Padded<N>, c: usize| if c == S_PHIPHI { 0.0 } else { rows.component(c)[k] };
            let d_z: [f64; 6] = std::array::from_fn(|c| of(s_z, c) * inverse_h[0]);
            let d_r: [f64; 6] = std::array::from_fn(|c| of(s_r, c) * inverse_h[1]);
            let mut rate = rates(w, d_z, d_r, inverse_r[k], &self.model().elasticity);
            let mut impedance = self.model().elasticity.z1;
            if let Some(plasticity) = &self.model().plasticity {
                let count = cells.components();
                let own = |c: usize| if c < count { cells.component(c)[k] } else { 0.0 };
                let state = [own(PLASTIC_STRAIN), own(TEMPERATURE)];
                if let Some(end) = rate_with_flow(plasticity, w, state, 0.5 * dt, &mut rate) {
                    let Elasticity { p_modulus, inverse_density, .. } = self.model().elasticity;
                    let modulus = plasticity.tangent_modulus(p_modulus, &end, 0.5 * dt);
                    impedance = (modulus / inverse_density).sqrt();
                }
            }
            if let Some([gain_z, gain_r]) = self.model().terms.velocity_gain(1.0) {
                rate[V_Z] += gain_z;
                rate[V_R] += gain_r;
            }
            let trace = |c: usize| w[c] + 0.5 * of(s_z, c);
            // What face states within get besides, with the differences continued in a line beyond the surface.
            let more = |c: usize| share * (of(s_z, c) - s_z.component(c)[k - 1]);
            FaceTrace::of([
                (TraceRow::Pressure, -(trace(S_NORMAL[0]) + more(S_NORMAL[0]))),
                (TraceRow::NormalVelocity, trace(V_Z) + more(V_Z)),
                (TraceRow::TangentialVelocity, trace(V_R)),
                (TraceRow::Shear, trace(S_ZR)),
                (TraceRow::Density, self.setup().speeds.density),
                (TraceRow::PressureRate, -rate[S_NORMAL[0]]),
                (TraceRow::NormalVelocityRate, rate[V_Z]),
                (TraceRow::TangentialVelocityRate, rate[V_R]),
                (TraceRow::PressureSlope, -of(s_r, S_NORMAL[0]) * inverse_h[1]),
                (TraceRow::NormalVelocitySlope, d_r[V_Z]),
                (TraceRow::Impedance, impedance),
            ])
        })
    }

    /// The weak scheme's half of a step, paper eq. (37): the fluid's new pressure is the normal traction, while
    /// the surface moves as the solid's own trace says.
    ///
    /// - `payload`, `count`: a trace frame whose pressures are the fluid's cell means at the *new* time.
    /// - `pressure_of`: the traction's pressure from (received, own) pressures: κ̂ p as printed, or p_s + κ̂ (p − p_s).
    pub fn load_weakly(
        &mut self,
        exchange: &mut WeakExchange,
        payload: &[f64],
        count: usize,
        dt: f64,
        pressure_of: impl Fn(f64, f64) -> f64,
    ) {
        self.traces_at_mid_step(dt, &mut exchange.traces);
        self.refine(exchange, TraceRow::Edge.of(payload, count));
        let received = TraceRow::Pressure.of(payload, count);
        exchange.stars.clear();
        for sub in exchange.refinement.sub_faces() {
            let own = &exchange.traces[sub.second];
            exchange.stars.push(InterfaceStar {
                pressure: pressure_of(received[sub.first], own.pressure),
                velocity: own.velocity,
                iterations: 0,
                floored: false,
            });
        }
        self.set_surface_from(exchange);
    }

    /// Cell means of the velocity under the surface on the fluid's faces, for the paper's schemes.
    ///
    /// - `edges`: the fluid's outer radii, m.
    /// - `trial`: of the new state of a step that has been run and not finished, in which all levels step alike.
    pub fn write_cell_velocities(
        &self,
        exchange: &mut WeakExchange,
        edges: &[f64],
        trial: bool,
        mut put: impl FnMut(RegisterRow, usize, f64),
    ) {
        self.refine(exchange, edges);
        let WeakExchange { refinement, cells, .. } = exchange;
        cells.clear();
        for &slot in self.interface().blocks() {
            let state = if trial { self.trial_state() } else { self.state() };
            cells.extend((0..N).map(|j| state.component(slot, V_Z)[j * N + N - 1]));
        }
        let velocity = |k: usize| cells[refinement.sub_faces()[k].second];
        refinement.means(false, velocity, |f, v| put(RegisterRow::NormalVelocity, f, v));
    }

    /// The own traces on the surface at the middle of a step of length `dt`, face by face.
    pub fn traces_at_mid_step(&self, dt: f64, traces: &mut Vec<SurfaceTrace>) {
        self.mid_step_of(dt, mesh::every_slot, traces);
    }

    /// [`SolidSolver::traces_at_mid_step`] for the faces of the levels that are about to make a step; of others, nothing.
    pub fn group_traces_at_mid_step(&self, step: GroupStep, traces: &mut Vec<SurfaceTrace>) {
        self.mid_step_of(step.dt, |slot| self.makes(step, slot), traces);
    }

    fn mid_step_of(&self, dt: f64, is_due: impl Fn(usize) -> bool, traces: &mut Vec<SurfaceTrace>) {
        traces.clear();
        traces.resize(self.interface().faces(), SurfaceTrace::default());
        if traces.is_empty() {
            return;
        }
        self.write_trace(dt, is_due, |row, face, value| {
            let (trace, value) = (&mut traces[face], row.weight_after(0.5 * dt) * value);
            match row {
                TraceRow::Pressure | TraceRow::PressureRate => trace.pressure += value,
                TraceRow::NormalVelocity | TraceRow::NormalVelocityRate => trace.velocity += value,
                TraceRow::TangentialVelocity | TraceRow::TangentialVelocityRate => {
                    trace.tangential_velocity += value;
                }
                TraceRow::Shear => trace.shear = value,
                TraceRow::Impedance => trace.impedance = value,
                _ => {}
            }
        });
    }

    /// The velocity (v_z, v_r) of the surface in the last step, face by face: the star states that made it, so that what the surface has
    /// gone is what the cells below have been strained. (What is in the cells themselves differs from it by what the scheme dissipates, also
    /// where nothing moves any more.) To be called after a step, before the grid adapts.
    ///
    /// - `put`: gets the number of a face and its velocity, m/s.
    pub fn surface_velocity(&self, mut put: impl FnMut(usize, [f64; 2])) {
        for &slot in self.interface().blocks() {
            let Some(first) = self.interface().first_face(slot) else { continue };
            let along = |quantity| self.passed(slot, Side::ZMax, quantity);
            let (normal, tangential) = (along(0), along(1));
            (0..N).for_each(|j| put(first + j, [normal[j], tangential[j]]));
        }
    }

    fn refine(&self, exchange: &mut WeakExchange, fluid_edges: &[f64]) {
        if exchange.generation != Some(self.mesh().generation()) {
            exchange.edges = self.interface_edges();
            exchange.generation = Some(self.mesh().generation());
        }
        let domain = self.mesh().domain();
        let axisymmetric = domain.geometry == Geometry::Axisymmetric;
        exchange.refinement.update(domain.r[0], fluid_edges, &exchange.edges, axisymmetric);
    }

    fn set_surface_from(&mut self, exchange: &WeakExchange) {
        let WeakExchange { refinement, stars, .. } = exchange;
        let surface = self.interface_mut().states_mut();
        refinement.means(true, |k| stars[k].pressure, |face, mean| surface[face].pressure = mean);
        refinement.means(true, |k| stars[k].velocity, |face, mean| surface[face].velocity = mean);
        let power = |k: usize| stars[k].pressure * stars[k].velocity;
        refinement.means(true, power, |face, mean| surface[face].power = mean);
    }
}

/// Where a cell flows by mid-step, the rates of its stresses that lead to where it is then, as the step itself has it, and that state.
///
/// - `half`: half the step, s; none where it is 0.
fn rate_with_flow(
    plasticity: &Plasticity,
    w: [f64; 6],
    [strain, temperature]: [f64; 2],
    half: f64,
    rate: &mut [f64; 6],
) -> Option<Returned> {
    if !(half > 0.0) {
        return None;
    }
    let [_, _, zz, zr, rr, phiphi]: [f64; 6] = std::array::from_fn(|c| w[c] + half * rate[c]);
    let returned = plasticity.return_map(Stress { zz, zr, rr, phiphi }, strain, temperature, half)?;
    let Stress { zz, zr, rr, phiphi } = returned.stress;
    for (c, stress) in [zz, zr, rr, phiphi].into_iter().enumerate() {
        rate[2 + c] = (stress - w[2 + c]) / half;
    }
    Some(returned)
}
