//! The fluid as one side of the interface: the only place where it meets the coupler.

use std::sync::PoisonError;

use coupler::{FaceTrace, FluidTrace, TraceRow};
use mesh::{BLOCK, Padded, TileRows};

use crate::boundary::wall_trace::Trace;
use crate::physics::FluidStep;
use crate::reconstruction::at;
use crate::state::COUNT;
use crate::state::PrimitiveCell;
use crate::state::primitive::{PHI, PRESSURE, RHO, V_R, V_Z};
use crate::step::block_sides;
use crate::step::rows::{Prediction, rates};
use crate::step::update::Metric;
use crate::step::{BlockScratch, reconstruct, take_wall};
use crate::terms::{GasMass, HeatBeyond, TermBlock, WallCell};
use crate::two_phase::{Cells, FaceStates, Window, face_states};
use crate::{FluidSolver, Mixture, TRACE_GAS};

/// The traces on a block's faces, and how many of them were no states on the whole of the step.
pub(crate) type BlockTraces<const N: usize> = ([FaceTrace; N], u64);

impl FluidSolver<BLOCK> {
    /// [`FluidSolver::write_trace`], compiled here as [`mesh::CompiledSolver`] is.
    pub fn compiled_trace(
        &self,
        dt: f64,
        due: &dyn Fn(usize) -> bool,
        put: &mut dyn FnMut(TraceRow, usize, f64),
    ) {
        self.write_trace(dt, due, put);
    }
}

impl<const N: usize> FluidSolver<N> {
    /// Writes the traces on the wall at the present time and their rates of change.
    ///
    /// The trace at time t is the reconstructed state on the face plus (t − tⁿ) times the rate that the
    /// predictor uses; at mid-step it is what the face's Riemann problem would see. It is a state on the whole of the step and
    /// the face: density and p + π stay clear of zero.
    ///
    /// - `dt`: the step about to be made: a cell that falls back to first order in it has no slope and no rate.
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
        let mut scaled = 0;
        let mut made = self.1.lock().unwrap_or_else(PoisonError::into_inner);
        let firsts = self.map_interface(due, of_block, &mut made);
        for (first, (traces, of_block)) in firsts.into_iter().zip(&*made) {
            scaled += of_block;
            FaceTrace::put_all(traces, first, &mut put);
        }
        self.model().tally.scaled_traces.add(scaled);
    }

    /// The traces on a block's faces, and how many of them were no states on the whole of the step.
    fn traces_of_block(
        &self,
        context: &FluidStep<'_, N>,
        slot: usize,
        scratch: &mut BlockScratch<N>,
    ) -> BlockTraces<N> {
        let dt = context.dt;
        let widths = self.mesh().widths(self.mesh().tree().leaves()[slot].level);
        let inverse_h = widths.map(|h| 1.0 / h);
        reconstruct(context, slot, scratch);
        let shear = self.shear_on_wall(context, slot, scratch);
        let BlockScratch { cells, s_z, s_r, inverse_r, .. } = &*scratch;
        let mut scaled = 0;
        let traces = std::array::from_fn(|j| {
            let k = Padded::<N>::index(0, j as isize);
            if let Some((state, share)) = self.interface_trace(cells, inverse_r, inverse_h, k, dt) {
                return face_trace((Trace::steady(state), shear[j]), share, self.mixture());
            }
            let share = self.gas_share(cells, k);
            let bound = self.mixture().bound_beta1::<true>(share);
            let [w, d_z, d_r] = [cells, s_z, s_r].map(|rows| at(&rows.split(), k));
            let (_, keep) = Prediction::<true>::new(
                w,
                d_z,
                d_r,
                inverse_h,
                inverse_r[k],
                0.5 * dt,
                bound,
                self.mixture(),
            )
            .half_step();
            let slope = d_r.map(|d| keep * d * inverse_h[1]);
            let mut rate = rates(
                w,
                d_z.map(|d| d * inverse_h[0]),
                d_r.map(|d| d * inverse_h[1]),
                inverse_r[k],
                share,
                self.mixture(),
            )
            .map(|rate| keep * rate);
            if let Some([gain_z, gain_r]) = self.model().terms.velocity_gain(1.0) {
                rate[V_Z] += gain_z;
                rate[V_R] += gain_r;
            }
            let mut state: PrimitiveCell = std::array::from_fn(|c| w[c] - 0.5 * keep * d_z[c]);
            let dispersion = context.model.dispersion(widths, dt, 0);
            let more = |c: usize, component: usize| {
                let [z, r] = [&s_z, &s_r].map(|s| s.component(component));
                let stride = Padded::<N>::STRIDE;
                let (across, along) = (z[k + 1] - z[k], 0.5 * (r[k + stride] - r[k - stride]));
                let modulus = self.mixture().bulk_modulus(w[RHO], w[PRESSURE], w[PHI], share);
                let sound = (modulus / w[RHO]).sqrt();
                let speed = w[V_Z].abs() + sound;
                let cell = [w[PRESSURE], w[PHI], d_z[PRESSURE]];
                keep * dispersion.on_wall(c, cell, speed, across, along)
            };
            state[V_Z] += more(0, V_Z);
            state[PRESSURE] += more(1, PRESSURE);
            // Next to the wall slopes are not limited from beyond it, so φ may leave [0, 1] on it; below 0 the
            // mixture's β₁ soon has the wrong sign, and γ with it.
            let phi = state[PHI];
            state[PHI] = phi.clamp(0.0, 1.0);
            let whole = Trace { state, rate, slope };
            let reach = [0.5 * dt, 0.5 / inverse_h[1]];
            let trace = whole.admissible(w, reach, self.mixture());
            let is_bounded = (phi - state[PHI]).abs() > TRACE_GAS;
            scaled += u64::from(is_bounded || trace != whole);
            face_trace((trace, shear[j]), share, self.mixture())
        });
        (traces, scaled)
    }

    /// The shear stresses σ_zr on the wall's faces of a block in the middle of a step, Pa: what the fluid sticks to moves as it did in
    /// the last one. 0 without friction.
    ///
    /// - `scratch`: the block at the beginning of the step, reconstructed.
    fn shear_on_wall(&self, ctx: &FluidStep<'_, N>, slot: usize, scratch: &mut BlockScratch<N>) -> [f64; N] {
        let terms = &self.model().terms;
        let (true, Some(wall)) = (terms.is_viscous, self.interface().states_of::<N>(slot)) else {
            return [0.0; N];
        };
        take_wall(ctx.mesh, ctx.interface, slot, &mut scratch.wall);
        let BlockScratch { cells, s_z, s_r, half, inverse_r, works, capillary, wall: around, .. } = scratch;
        let inverse_h = ctx.mesh.widths(ctx.mesh.tree().leaves()[slot].level).map(|h| 1.0 / h);
        let metric = Metric {
            stride: Padded::<N>::STRIDE,
            origin: Padded::<N>::index(0, 0),
            dt: ctx.dt,
            inverse_h,
            face_weight: &[],
            inverse_weight: &[],
        };
        let rows = cells.split();
        let sides = block_sides(ctx, slot);
        let block = TermBlock {
            cells: N,
            metric: &metric,
            inverse_r,
            state: rows,
            before: rows,
            sides,
            wall: Some(around),
            capillary,
            gas: GasMass::Absent,
            vapour: None,
            closure: None,
            heat_beyond: HeatBeyond::Nothing,
            spread: None,
        };
        let [_, v_z, v_r, ..] = half.split_mut::<COUNT>();
        v_r.fill(0.0);
        terms.predict(&block, [v_z, v_r], works);
        std::array::from_fn(|j| {
            let first = Padded::<N>::index(0, j as isize);
            let [(w, own), (behind, other)] = [first, first + 1].map(|k| {
                let [w, d_z, d_r] = [&*cells, s_z, s_r].map(|rows| at(&rows.split(), k));
                let bound = self.mixture().bound_beta1::<true>(self.gas_share(cells, k));
                let (state, _) = Prediction::<true>::new(
                    w,
                    d_z,
                    d_r,
                    inverse_h,
                    inverse_r[k],
                    0.5 * ctx.dt,
                    bound,
                    self.mixture(),
                )
                .half_step();
                (w, state[V_R] - wall[j].tangential_velocity)
            });
            terms.wall_shear(WallCell {
                density: w[RHO],
                phi: [w[PHI], behind[PHI]],
                by_waves: [own, other],
                slip: own + half.component(V_R)[first],
                dt: ctx.dt,
                inverse_h,
            })
        })
    }

    /// The fluid's own states on the wall in the middle of a step of length `dt`, face by face.
    ///
    /// - `traces`: overwritten.
    pub fn traces_at_mid_step(&self, dt: f64, traces: &mut Vec<FluidTrace>) {
        const NOTHING: FluidTrace =
            FluidTrace { pressure: 0.0, velocity: 0.0, density: 0.0, gamma: 0.0, pi: 0.0 };
        traces.clear();
        traces.resize(self.interface().faces(), NOTHING);
        if traces.is_empty() {
            return;
        }
        self.write_trace(dt, mesh::every_slot, |row, face, value| {
            let (trace, value) = (&mut traces[face], row.weight_after(0.5 * dt) * value);
            match row {
                TraceRow::Pressure | TraceRow::PressureRate => trace.pressure += value,
                TraceRow::NormalVelocity | TraceRow::NormalVelocityRate => trace.velocity += value,
                TraceRow::Density | TraceRow::DensityRate => trace.density += value,
                TraceRow::Gamma => trace.gamma = value,
                TraceRow::Pi => trace.pi = value,
                _ => {}
            }
        });
    }

    /// The gas's part of the mass in an assembled cell.
    fn gas_share(&self, cells: &TileRows<N>, k: usize) -> f64 {
        let gas = self.model().scheme.phases.gas_component();
        gas.map_or(0.0, |gas| cells.component(gas)[k] / cells.component(RHO)[k])
    }

    /// The state at mid-step on the wall's face of a cell that holds both phases, and the gas's part of the mass; `None` of other cells.
    fn interface_trace(
        &self,
        cells: &TileRows<N>,
        inverse_r: &[f64],
        inverse_h: [f64; 2],
        k: usize,
        dt: f64,
    ) -> Option<(PrimitiveCell, f64)> {
        let rule = self.model().mixed_cell_rule(inverse_h, inverse_r, dt)?;
        let cells = Cells { rows: cells.split(), stride: Padded::<N>::STRIDE };
        cells.is_at_interface(k, rule.mixture).then(|| {
            let mut states = FaceStates::default();
            face_states(&cells, &[Window { first: k, step: 1, listed: 1 }], &rule, &mut states);
            let state = states.of(0, 0);
            (state.w, state.gas_share)
        })
    }

    /// Cell means next to the wall: pressure and normal velocity, face by face; what the paper's schemes exchange.
    ///
    /// - `trial`: of the new state of a step that has been run and not finished, in which all levels step alike.
    pub fn wall_cells(&self, trial: bool, mut put: impl FnMut(usize, f64, f64)) {
        let state = if trial { self.trial_state() } else { self.state() };
        for (first, &slot) in self.interface().blocks().iter().enumerate().map(|(k, slot)| (k * N, slot)) {
            for j in 0..N {
                let cell = self.cell_of(state.block(slot), 0, j);
                put(first + j, cell.pressure, cell.v_z);
            }
        }
    }
}

/// The rows of a trace. Its density is that in the free volume, with which alone the star state is that of a stiffened gas.
///
/// - `share`: the gas's part of the mass; without a say where there is no covolume.
fn face_trace((trace, shear): (Trace, f64), share: f64, mixture: &Mixture) -> FaceTrace {
    let Trace { state: [rho, v_z, v_r, p, phi], rate, slope } = trace;
    let at = mixture.law_at(rho, phi, share);
    let impedance = (rho * mixture.bulk_modulus(rho, p, phi, share)).max(0.0).sqrt();
    // d(ρ/(1 − bρ)) = dρ/(1 − bρ)².
    let per_free = at.free_share(rho).powi(-2);
    FaceTrace::of([
        (TraceRow::Density, at.free_density(rho)),
        (TraceRow::NormalVelocity, v_z),
        (TraceRow::TangentialVelocity, v_r),
        (TraceRow::Pressure, p),
        (TraceRow::Shear, shear),
        (TraceRow::DensityRate, per_free * rate[RHO]),
        (TraceRow::NormalVelocityRate, rate[V_Z]),
        (TraceRow::TangentialVelocityRate, rate[V_R]),
        (TraceRow::PressureRate, rate[PRESSURE]),
        (TraceRow::Gamma, at.gamma),
        (TraceRow::Pi, at.pi),
        (TraceRow::Impedance, impedance),
        (TraceRow::DensitySlope, per_free * slope[RHO]),
        (TraceRow::NormalVelocitySlope, slope[V_Z]),
        (TraceRow::PressureSlope, slope[PRESSURE]),
    ])
}
