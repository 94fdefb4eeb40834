//! The solid as one side of the interface: the only place where it meets the coupler.

use coupler::{
    CommonRefinement, FluidTrace, InterfaceStar, RegisterRow, SolidTrace, StarSolver, TraceRow,
    acoustic_star, exact_star,
};
use mesh::{Geometry, Padded};

use crate::block::{BlockScratch, reconstruct};
use crate::rows::rates;
use crate::state::component::{S_NORMAL, S_PHIPHI, S_ZR, V_R, V_Z};
use crate::{SolidSolver, SurfaceState};

/// What the solid knows of its interface with the fluid: faces, sub-faces, and the last step's star states.
#[derive(Clone, Debug, Default)]
pub struct Interface {
    edges: Vec<f64>,
    /// The mesh whose faces the edges are of.
    generation: Option<u64>,
    refinement: CommonRefinement,
    stars: Vec<InterfaceStar>,
    traces: Vec<SurfaceTrace>,
    /// Velocities of the cells under the surface, for the weak scheme.
    cells: Vec<f64>,
    floored: u64,
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
    /// ∂(−σ_zz)/∂r along the surface, Pa/m.
    pub pressure_slope: f64,
    /// ∂v_z/∂r along the surface, 1/s.
    pub velocity_slope: f64,
}

impl Interface {
    /// Star states that had to be lifted to the lowest admissible pressure so far.
    pub fn floored(&self) -> u64 {
        self.floored
    }

    /// Whether there is a last step to tell of.
    pub fn has_met(&self) -> bool {
        !self.stars.is_empty()
    }

    /// Writes the means of the last step over the faces of the fluid, row by row of a [`RegisterRow`].
    pub fn write_register(&self, mut put: impl FnMut(RegisterRow, usize, f64)) {
        let star = |k: usize| &self.stars[k];
        let solid = |k: usize| &self.traces[self.refinement.sub_faces()[k].second];
        self.refinement.means(false, |k| star(k).pressure, |f, v| put(RegisterRow::Pressure, f, v));
        self.refinement.means(false, |k| star(k).velocity, |f, v| put(RegisterRow::NormalVelocity, f, v));
        let power = |k: usize| star(k).pressure * star(k).velocity;
        self.refinement.means(false, power, |f, v| put(RegisterRow::Power, f, v));
        let tangential = |k: usize| solid(k).tangential_velocity;
        self.refinement.means(false, tangential, |f, v| put(RegisterRow::TangentialVelocity, f, v));
    }
}

impl<const N: usize> SolidSolver<N> {
    /// Number of faces on the surface under the fluid; 0 without one.
    pub fn surface_faces(&self) -> usize {
        self.surface.len()
    }

    /// The outer radius of each face of the surface, ascending, m; the first one begins at the domain's r_min.
    pub fn surface_edges(&self) -> Vec<f64> {
        let mut edges = Vec::with_capacity(self.surface.len());
        for &slot in &self.surface_blocks {
            let id = self.mesh.tree().leaves()[slot];
            let h_r = self.mesh.widths(id.level)[1];
            edges.extend((0..N).map(|j| self.mesh.centre(id, 0, j)[1] + 0.5 * h_r));
        }
        edges
    }

    /// Meets the fluid: solves the Riemann problem between the two media on every sub-face, with both sides'
    /// traces at mid-step, and sets the surface's state for the step of length `dt`.
    ///
    /// - `payload`, `count`: a trace frame of the fluid, see [`TraceRow`].
    pub fn meet_fluid(
        &mut self,
        interface: &mut Interface,
        payload: &[f64],
        count: usize,
        dt: f64,
        solver: StarSolver,
    ) {
        self.traces_at_mid_step(dt, &mut interface.traces);
        self.refine(interface, TraceRow::Edge.of(payload, count));
        let row = |row: TraceRow| row.of(payload, count);
        let half_dt = 0.5 * dt;
        let (p, p_rate) = (row(TraceRow::Pressure), row(TraceRow::PressureRate));
        let (v, v_rate) = (row(TraceRow::NormalVelocity), row(TraceRow::NormalVelocityRate));
        let (rho, rho_rate) = (row(TraceRow::Density), row(TraceRow::DensityRate));
        let (gamma, pi) = (row(TraceRow::Gamma), row(TraceRow::Pi));
        let (p_slope, v_slope) = (row(TraceRow::PressureSlope), row(TraceRow::NormalVelocitySlope));
        let rho_slope = row(TraceRow::DensitySlope);
        interface.stars.clear();
        for sub in interface.refinement.sub_faces() {
            // Traces are linear along a face: a face that meets several of the other side shows each its own part.
            let (f, x) = (sub.first, sub.offset_in_first);
            let fluid = FluidTrace {
                pressure: p[f] + half_dt * p_rate[f] + x * p_slope[f],
                velocity: v[f] + half_dt * v_rate[f] + x * v_slope[f],
                density: rho[f] + half_dt * rho_rate[f] + x * rho_slope[f],
                gamma: gamma[f],
                pi: pi[f],
            };
            let own = &interface.traces[sub.second];
            let y = sub.offset_in_second;
            let solid = SolidTrace {
                pressure: own.pressure + y * own.pressure_slope,
                velocity: own.velocity + y * own.velocity_slope,
                impedance: self.elasticity.z1,
            };
            let star = match solver {
                StarSolver::Exact => exact_star(&fluid, &solid),
                StarSolver::Acoustic => acoustic_star(&fluid, &solid),
            };
            interface.floored += u64::from(star.floored);
            interface.stars.push(star);
        }
        self.set_surface_from(interface);
    }

    /// The weak scheme's half of a step, paper eq. (37): the fluid's new pressure is the normal traction, while
    /// the surface moves as the solid's own trace says.
    ///
    /// - `payload`, `count`: a trace frame whose pressures are the fluid's cell means at the *new* time.
    /// - `pressure_of`: the traction's pressure from (received, own) pressures: κ̂ p as printed, or p_s + κ̂ (p − p_s).
    pub fn load_weakly(
        &mut self,
        interface: &mut Interface,
        payload: &[f64],
        count: usize,
        dt: f64,
        pressure_of: impl Fn(f64, f64) -> f64,
    ) {
        self.traces_at_mid_step(dt, &mut interface.traces);
        self.refine(interface, TraceRow::Edge.of(payload, count));
        let received = TraceRow::Pressure.of(payload, count);
        interface.stars.clear();
        for sub in interface.refinement.sub_faces() {
            let own = &interface.traces[sub.second];
            interface.stars.push(InterfaceStar {
                pressure: pressure_of(received[sub.first], own.pressure),
                velocity: own.velocity,
                iterations: 0,
                floored: false,
            });
        }
        self.set_surface_from(interface);
    }

    /// Cell means of the velocity under the surface on the fluid's faces, for the weak scheme; `edges` are the
    /// fluid's outer radii.
    pub fn write_cell_velocities(
        &self,
        interface: &mut Interface,
        edges: &[f64],
        mut put: impl FnMut(RegisterRow, usize, f64),
    ) {
        self.refine(interface, edges);
        let Interface { refinement, cells, .. } = interface;
        cells.clear();
        for &slot in &self.surface_blocks {
            cells.extend((0..N).map(|j| self.state.component(slot, V_Z)[j * N + N - 1]));
        }
        let velocity = |k: usize| cells[refinement.sub_faces()[k].second];
        refinement.means(false, velocity, |f, v| put(RegisterRow::NormalVelocity, f, v));
    }

    /// The surface's state during the last step.
    pub fn surface(&self) -> &[SurfaceState] {
        &self.surface
    }

    /// Sets the surface's state for the next step, face by face: a load without a fluid.
    pub fn set_surface(&mut self, state: impl Fn(usize) -> SurfaceState) {
        for (face, surface) in self.surface.iter_mut().enumerate() {
            *surface = state(face);
        }
    }

    /// The own traces on the surface at the middle of a step of length `dt`, face by face.
    pub fn traces_at_mid_step(&self, dt: f64, traces: &mut Vec<SurfaceTrace>) {
        traces.clear();
        for &slot in &self.surface_blocks {
            let id = self.mesh.tree().leaves()[slot];
            let inverse_h = self.mesh.widths(id.level).map(|h| 1.0 / h);
            self.scratch.with(|scratch| {
                let context = self.context(dt);
                let [share, _] = context.curvature(id.level, 0);
                reconstruct(&context, slot, scratch);
                let BlockScratch { cells, s_z, s_r, inverse_r, .. } = scratch;
                for j in 0..N {
                    let k = Padded::<N>::index(N as isize - 1, j as isize);
                    let w: [f64; 6] = std::array::from_fn(|c| cells.component(c)[k]);
                    // The hoop stress has no difference: no derivative of it enters.
                    let of =
                        |rows: &Padded<N>, c: usize| if c == S_PHIPHI { 0.0 } else { rows.component(c)[k] };
                    let d_z: [f64; 6] = std::array::from_fn(|c| of(s_z, c) * inverse_h[0]);
                    let d_r: [f64; 6] = std::array::from_fn(|c| of(s_r, c) * inverse_h[1]);
                    let rate = rates(w, d_z, d_r, inverse_r[k], &self.elasticity);
                    let trace = |c: usize| w[c] + 0.5 * of(s_z, c) + 0.5 * dt * rate[c];
                    // What face states within get besides, with the differences continued in a line beyond the surface.
                    let more = |c: usize| share * (of(s_z, c) - s_z.component(c)[k - 1]);
                    traces.push(SurfaceTrace {
                        pressure: -(trace(S_NORMAL[0]) + more(S_NORMAL[0])),
                        velocity: trace(V_Z) + more(V_Z),
                        tangential_velocity: trace(V_R),
                        shear: trace(S_ZR),
                        pressure_slope: -of(s_r, S_NORMAL[0]) * inverse_h[1],
                        velocity_slope: d_r[V_Z],
                    });
                }
            });
        }
    }

    fn refine(&self, interface: &mut Interface, fluid_edges: &[f64]) {
        if interface.generation != Some(self.mesh.generation()) {
            interface.edges = self.surface_edges();
            interface.generation = Some(self.mesh.generation());
        }
        let domain = self.mesh.domain();
        let axisymmetric = domain.geometry == Geometry::Axisymmetric;
        interface.refinement.update(domain.r[0], fluid_edges, &interface.edges, axisymmetric);
    }

    fn set_surface_from(&mut self, interface: &Interface) {
        let Interface { refinement, stars, .. } = interface;
        let surface = &mut self.surface;
        refinement.means(true, |k| stars[k].pressure, |face, mean| surface[face].pressure = mean);
        refinement.means(true, |k| stars[k].velocity, |face, mean| surface[face].velocity = mean);
        let power = |k: usize| stars[k].pressure * stars[k].velocity;
        refinement.means(true, power, |face, mean| surface[face].power = mean);
    }
}
