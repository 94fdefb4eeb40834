//! Terms of the equations besides waves and plastic flow: what passes faces, sources in cells, limits on the step.
//!
//! A term is a file with a type that is a [`Term`], and a line in [`Terms::of`]; as in the fluid. Terms that a solid has not are not in
//! the list, and a block's step with an empty list is bitwise that without terms.

pub(crate) mod weight;

use crate::SolidSetup;
use crate::step::rows::FaceRows;

/// What a term adds.
pub(crate) trait Term: Send + Sync {
    /// A uniform acceleration along z and r, m/s². It enters the states at mid-step and the traces that the fluid gets.
    fn acceleration(&self) -> [f64; 2] {
        [0.0; 2]
    }

    /// Adds to the velocities and tractions on the faces of a block along z and r, before they are registered; 1/h_z, 1/h_r.
    fn add_to_faces(&self, _inverse_h: [f64; 2], _faces: [&mut FaceRows; 2]) {}

    /// Adds what comes into the cells of a block in a step of length `dt`: `[component][j][i]` without ghosts, before they yield.
    fn add_sources(&self, _dt: f64, _cells: usize, _block: &mut [f64]) {}

    /// The longest step that it is stable with in cells of these widths, s.
    fn step_limit(&self, _widths: [f64; 2]) -> f64 {
        f64::INFINITY
    }
}

/// The terms of a solid, in the order in which they act.
pub(crate) struct Terms {
    list: Vec<Box<dyn Term>>,
    /// Of all together along z and r, m/s².
    acceleration: [f64; 2],
}

impl Terms {
    /// Those that a setup asks for.
    pub fn of(setup: &SolidSetup) -> Self {
        let all: [Option<Box<dyn Term>>; 1] = [setup.weight.map(|weight| Box::new(weight) as _)];
        let list: Vec<Box<dyn Term>> = all.into_iter().flatten().collect();
        let acceleration = list.iter().map(|term| term.acceleration());
        let acceleration = acceleration.fold([0.0; 2], |sum, more| [sum[0] + more[0], sum[1] + more[1]]);
        Self { list, acceleration }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// What the acceleration of all terms together makes over a time, m/s; `None` without any.
    pub fn velocity_gain(&self, time: f64) -> Option<[f64; 2]> {
        (self.acceleration != [0.0; 2]).then(|| self.acceleration.map(|a| a * time))
    }

    /// See [`Term::add_to_faces`].
    pub fn add_to_faces(&self, inverse_h: [f64; 2], [z_faces, r_faces]: [&mut FaceRows; 2]) {
        self.list.iter().for_each(|term| term.add_to_faces(inverse_h, [&mut *z_faces, &mut *r_faces]));
    }

    /// See [`Term::add_sources`].
    pub fn add_sources(&self, dt: f64, cells: usize, block: &mut [f64]) {
        self.list.iter().for_each(|term| term.add_sources(dt, cells, block));
    }

    /// See [`Term::step_limit`].
    pub fn step_limit(&self, widths: [f64; 2]) -> f64 {
        self.list.iter().fold(f64::INFINITY, |limit, term| limit.min(term.step_limit(widths)))
    }
}
