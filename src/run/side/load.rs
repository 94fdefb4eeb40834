//! A given pressure on the surface of a solid without a fluid, scheme `"load"`.

use coupler::{CommonRefinement, SolidTrace, solid_under_pressure};
use fluid::PressureHistory;
use mesh::{BLOCK, Geometry, GroupStep};
use solid::{SolidSolver, SurfaceTrace};

use crate::case::{LoadCase, RecordedLoad};
use crate::run::side::wall_faces::WallFaces;

/// The pressure on the surface, face by face.
pub struct Load {
    pressure: Pressure,
    faces: WallFaces,
    /// The outer end of the surface, m.
    end: f64,
    geometry: Geometry,
    /// Of the present faces at the present time, Pa.
    on_faces: Vec<f64>,
    traces: Vec<SurfaceTrace>,
}

/// Where it comes from.
enum Pressure {
    /// A exp(−r²/b²) f(t).
    Gaussian {
        amplitude: f64,
        radius: f64,
        factor: PressureHistory,
        /// Means of the profile over the faces.
        profile: Vec<f64>,
    },
    /// Another run.
    Recorded {
        load: RecordedLoad,
        /// From the record's cells, and one beyond them, to the faces.
        map: CommonRefinement,
        in_cells: Vec<f64>,
    },
}

impl Load {
    /// The load of a case on its solid; `None` for a history without points, which reading refuses.
    pub fn new(case: &LoadCase, solver: &SolidSolver<BLOCK>) -> Option<Self> {
        let mesh = solver.mesh();
        let pressure = match case {
            LoadCase::Gaussian(load) => Pressure::Gaussian {
                amplitude: load.amplitude,
                radius: load.radius,
                factor: PressureHistory::new(load.history.clone())?,
                profile: Vec::new(),
            },
            LoadCase::Recorded(load) => Pressure::Recorded {
                load: load.clone(),
                map: CommonRefinement::default(),
                in_cells: Vec::new(),
            },
        };
        let [begin, end] = mesh.domain().r;
        let mut load = Self {
            pressure,
            faces: WallFaces::new(mesh.generation(), begin, solver.interface_edges()),
            end,
            geometry: mesh.domain().geometry,
            on_faces: Vec::new(),
            traces: Vec::new(),
        };
        load.measure();
        Some(load)
    }

    /// Sets the surface's state for the next step of a level: the pressure at mid-step, of a recorded one the mean over the step, and
    /// the velocity that it gives to the solid's own trace.
    pub fn press(&mut self, solver: &mut SolidSolver<BLOCK>, step: GroupStep) {
        if self.faces.update(solver.mesh().generation(), || solver.interface_edges()) {
            self.measure();
        }
        solver.group_traces_at_mid_step(step, &mut self.traces);
        self.during(step.begin, step.dt);
        for (face, &SurfaceTrace { pressure, velocity, impedance, .. }) in self.traces.iter().enumerate() {
            if solver.group_of_face(face) == step.group {
                let trace = SolidTrace { pressure, velocity, impedance };
                let star = solid_under_pressure(&trace, self.on_faces[face]);
                let state = [star.pressure, star.velocity, star.pressure * star.velocity];
                solver.interface_mut().set(face, state.into());
            }
        }
    }

    /// The pressure on the faces in a step.
    fn during(&mut self, begin: f64, length: f64) {
        self.on_faces.clear();
        let on_faces = &mut self.on_faces;
        match &mut self.pressure {
            Pressure::Gaussian { amplitude, factor, profile, .. } => {
                let now = *amplitude * factor.at(begin + 0.5 * length);
                on_faces.extend(profile.iter().map(|share| now * share));
            }
            Pressure::Recorded { load, map, in_cells } => {
                load.mean(begin, length, in_cells);
                // Beyond what was recorded.
                in_cells.push(load.ambient());
                on_faces.resize(self.faces.edges().len(), load.ambient());
                map.means(true, |k| in_cells[map.sub_faces()[k].first], |face, mean| on_faces[face] = mean);
            }
        }
    }

    /// What hangs on the faces.
    fn measure(&mut self) {
        let (begin, edges) = (self.faces.begin(), self.faces.edges());
        let is_planar = self.geometry == Geometry::Planar;
        match &mut self.pressure {
            // Means of exp(−r²/b²) over the faces, weighted with r where that is the area's weight.
            Pressure::Gaussian { radius, profile, .. } => {
                let b2 = *radius * *radius;
                let lower = std::iter::once(begin).chain(edges.iter().copied());
                let of_face = |(low, &high): (f64, &f64)| {
                    let weighted = |r: f64| (-r * r / b2).exp() * if is_planar { 1.0 } else { r };
                    let area = if is_planar { 1.0 } else { 0.5 * (low + high) };
                    // Simpson's rule.
                    (weighted(low) + 4.0 * weighted(0.5 * (low + high)) + weighted(high)) / (6.0 * area)
                };
                *profile = lower.zip(edges).map(of_face).collect();
            }
            Pressure::Recorded { load, map, .. } => {
                let within = load.edges().iter().copied().filter(|edge| *edge < self.end * (1.0 - SAME));
                let cells: Vec<f64> = within.chain([self.end]).collect();
                map.update(begin, &cells, edges, !is_planar);
            }
        }
    }
}

/// Edges closer to the end of the surface than this are its end.
const SAME: f64 = 1e-9;
