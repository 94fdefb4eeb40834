//! Terms of the equations besides the waves of two-phase flow: fluxes through faces, sources in cells, limits on the step.
//!
//! A term is a file with a type that is a [`Term`], and a line in [`Terms::of`]. It says what it adds to a block's step; prolongation,
//! flux registers, subcycling, the first-order fall-back, checkpoints and the coupling take part without knowing of it. Terms that a
//! case has not are not in the list, and a block's step with an empty list is bitwise that without terms.

pub(crate) mod gravity;
pub(crate) mod surface_tension;

use crate::FluidSetup;
use crate::capillarity::CapillaryRows;
use crate::reconstruction::Rows;
use crate::step::face_rows::FaceRows;
use crate::step::update::Metric;

/// A block in a step, as terms see it.
pub(crate) struct TermBlock<'a> {
    /// Cells along a side.
    pub cells: usize,
    pub metric: &'a Metric<'a>,
    /// The padded cells at mid-step: ρ, v_z, v_r, p, φ.
    pub half: Rows<'a>,
    /// The jumps of pressure across interfaces, where there is surface tension.
    pub capillary: &'a CapillaryRows,
}

/// What a term adds.
pub(crate) trait Term: Send + Sync {
    /// A uniform acceleration along z and r, m/s². It enters the states at mid-step of all cells, the slopes next to walls, and the
    /// traces that the solid gets.
    fn acceleration(&self) -> [f64; 2] {
        [0.0; 2]
    }

    /// The tension of interfaces, N/m. It enters the pressures' slopes and the Riemann problems of the faces.
    fn surface_tension(&self) -> Option<f64> {
        None
    }

    /// Whether interfaces must stay away from walls.
    fn forbids_contact(&self) -> bool {
        false
    }

    /// Adds to the fluxes through the faces of a block along z and r, before they are registered.
    fn add_fluxes(&self, _block: &TermBlock<'_>, _faces: [&mut FaceRows; 2]) {}

    /// Adds what comes into the cells of a block in the step, per volume.
    ///
    /// - `faces`: with the fluxes of all terms; `block_rows`: conserved components `[component][j][i]` without ghosts, of the field's
    ///   number of components.
    fn add_sources(&self, _block: &TermBlock<'_>, _faces: [&FaceRows; 2], _block_rows: &mut [f64]) {}

    /// The longest step that it is stable with in cells of these widths, s.
    fn step_limit(&self, _widths: [f64; 2]) -> f64 {
        f64::INFINITY
    }
}

/// The terms of a case, in the order in which they act.
pub(crate) struct Terms {
    list: Vec<Box<dyn Term>>,
    acceleration: [f64; 2],
    surface_tension: Option<f64>,
}

impl Terms {
    /// Those that a setup asks for.
    pub fn of(setup: &FluidSetup) -> Self {
        let all: [Option<Box<dyn Term>>; 2] = [
            setup.gravity.map(|gravity| Box::new(gravity) as _),
            setup.surface_tension.map(|tension| Box::new(tension) as _),
        ];
        let list: Vec<Box<dyn Term>> = all.into_iter().flatten().collect();
        let acceleration = list.iter().fold([0.0; 2], |[z, r], term| {
            let more = term.acceleration();
            [z + more[0], r + more[1]]
        });
        let surface_tension = list.iter().find_map(|term| term.surface_tension());
        Self { list, acceleration, surface_tension }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// That of all terms together, m/s².
    pub fn acceleration(&self) -> [f64; 2] {
        self.acceleration
    }

    /// The tension of interfaces, N/m; `None` without any.
    pub fn surface_tension(&self) -> Option<f64> {
        self.surface_tension
    }

    /// Whether interfaces must stay away from walls.
    pub fn forbids_contact(&self) -> bool {
        self.surface_tension.is_some() && self.list.iter().any(|term| term.forbids_contact())
    }

    /// The acceleration over a time, m/s; `None` without any.
    pub fn velocity_gain(&self, time: f64) -> Option<[f64; 2]> {
        (self.acceleration != [0.0; 2]).then(|| self.acceleration.map(|a| a * time))
    }

    /// Adds all terms to the fluxes and to the cells of a block.
    pub fn add(&self, block: &TermBlock<'_>, [z_faces, r_faces]: [&mut FaceRows; 2], block_rows: &mut [f64]) {
        for term in &self.list {
            term.add_fluxes(block, [&mut *z_faces, &mut *r_faces]);
        }
        for term in &self.list {
            term.add_sources(block, [z_faces, r_faces], block_rows);
        }
    }

    /// See [`Term::step_limit`].
    pub fn step_limit(&self, widths: [f64; 2]) -> f64 {
        self.list.iter().fold(f64::INFINITY, |limit, term| limit.min(term.step_limit(widths)))
    }
}
