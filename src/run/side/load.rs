//! A given pressure on the surface of a solid without a fluid, scheme `"load"`.

use coupler::{SolidTrace, solid_under_pressure};
use fluid::PressureHistory;
use mesh::{BLOCK, Geometry, GroupStep};
use solid::{SolidSolver, SurfaceTrace};

use crate::case::LoadCase;
use crate::run::side::wall_faces::WallFaces;

/// The pressure A exp(−r²/b²) f(t), face by face.
pub struct Load {
    amplitude: f64,
    radius: f64,
    factor: PressureHistory,
    faces: WallFaces,
    /// Means of the profile over the faces.
    profile: Vec<f64>,
    traces: Vec<SurfaceTrace>,
}

impl Load {
    /// The load of a case on its solid; `None` for a history without points, which reading refuses.
    pub fn new(case: &LoadCase, solver: &SolidSolver<BLOCK>) -> Option<Self> {
        let mesh = solver.mesh();
        let faces = WallFaces::new(mesh.generation(), mesh.domain().r[0], solver.interface_edges());
        let mut load = Self {
            amplitude: case.amplitude,
            radius: case.radius,
            factor: PressureHistory::new(case.history.clone())?,
            faces,
            profile: Vec::new(),
            traces: Vec::new(),
        };
        load.measure(mesh.domain().geometry);
        Some(load)
    }

    /// Sets the surface's state for the next step of a level: the pressure at mid-step, and the velocity that it gives to
    /// the solid's own trace.
    pub fn press(&mut self, solver: &mut SolidSolver<BLOCK>, step: GroupStep) {
        let (generation, geometry) = (solver.mesh().generation(), solver.mesh().domain().geometry);
        if self.faces.update(generation, || solver.interface_edges()) {
            self.measure(geometry);
        }
        solver.group_traces_at_mid_step(step, &mut self.traces);
        let now = self.amplitude * self.factor.at(step.begin + 0.5 * step.dt);
        for (face, &SurfaceTrace { pressure, velocity, impedance, .. }) in self.traces.iter().enumerate() {
            if solver.group_of_face(face) == step.group {
                let trace = SolidTrace { pressure, velocity, impedance };
                let star = solid_under_pressure(&trace, now * self.profile[face]);
                let state = [star.pressure, star.velocity, star.pressure * star.velocity];
                solver.interface_mut().set(face, state.into());
            }
        }
    }

    /// Means of exp(−r²/b²) over the faces, weighted with r where that is the area's weight.
    fn measure(&mut self, geometry: Geometry) {
        let (edges, b2) = (self.faces.edges(), self.radius * self.radius);
        let lower = std::iter::once(self.faces.begin()).chain(edges.iter().copied());
        let of_face = |(low, &high): (f64, &f64)| {
            let weighted = |r: f64| (-r * r / b2).exp() * if geometry == Geometry::Planar { 1.0 } else { r };
            let area = if geometry == Geometry::Planar { 1.0 } else { 0.5 * (low + high) };
            // Simpson's rule.
            (weighted(low) + 4.0 * weighted(0.5 * (low + high)) + weighted(high)) / (6.0 * area)
        };
        self.profile = lower.zip(edges).map(of_face).collect();
    }
}
