//! Terms of the equations besides the waves of two-phase flow: fluxes through faces, sources in cells, limits on the step.
//!
//! A term is a file with a type that is a [`Term`], and a line in [`Terms::of`]. It says what it adds to a block's step; prolongation,
//! flux registers, subcycling, the first-order fall-back, checkpoints and the coupling take part without knowing of it. Terms that a
//! case has not are not in the list, and a block's step with an empty list is bitwise that without terms.

pub(crate) mod gravity;
pub(crate) mod surface_tension;
pub(crate) mod viscosity;

use mesh::FaceState;

use crate::capillarity::CapillaryRows;
use crate::reconstruction::Rows;
use crate::step::face_rows::FaceRows;
use crate::step::update::Metric;
use crate::{Boundary, FluidSetup};

/// A block in a step, as terms see it.
pub(crate) struct TermBlock<'a> {
    /// Cells along a side.
    pub cells: usize,
    pub metric: &'a Metric<'a>,
    /// 1/r of the padded cells, or 0 in planar geometry.
    pub inverse_r: &'a [f64],
    /// The padded cells at mid-step: ρ, v_z, v_r, p, φ; for [`Term::predict`] those at the beginning of the step.
    pub state: Rows<'a>,
    /// The padded cells at the beginning of the step.
    pub before: Rows<'a>,
    /// What bounds the domain on the sides of the block; `None` where other blocks are.
    pub sides: [Option<Boundary>; 4],
    /// The faces of the wall to another medium, in the order of r, where the block has any.
    pub wall: Option<&'a [FaceState]>,
    /// The jumps of pressure across interfaces, where there is surface tension.
    pub capillary: &'a CapillaryRows,
}

/// A cell on the wall to another medium, as terms see it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WallCell {
    /// kg/m³.
    pub density: f64,
    /// Gas fraction.
    pub phi: f64,
    /// Its velocity along the wall relative to the wall's own, at mid-step, m/s.
    pub slip: f64,
    /// The step, s.
    pub dt: f64,
    /// 1/h_z, 1/h_r.
    pub inverse_h: [f64; 2],
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

    /// Adds what the velocities v_z and v_r of a block and its first ghosts gain until mid-step.
    ///
    /// - `work`: rows to work in, whatever they hold; likewise below.
    fn predict(&self, _block: &TermBlock<'_>, _half: [&mut [f64]; 2], _work: &mut Vec<f64>) {}

    /// Adds to the fluxes through the faces of a block along z and r, before they are registered; they hold those of waves.
    ///
    /// - returns: in how many cells of the block it was bounded.
    fn add_fluxes(&self, _block: &TermBlock<'_>, _faces: [&mut FaceRows; 2], _work: &mut Vec<f64>) -> u64 {
        0
    }

    /// Adds what comes into the cells of a block in the step, per volume.
    ///
    /// - `faces`: with the fluxes of all terms; `work`: as its own [`Term::add_fluxes`] has left it; `block_rows`: conserved components
    ///   `[component][j][i]` without ghosts, of the field's number of components.
    fn add_sources(
        &self,
        _block: &TermBlock<'_>,
        _faces: [&FaceRows; 2],
        _work: &[f64],
        _block_rows: &mut [f64],
    ) {
    }

    /// The largest diffusivity in cells of these densities and gas fractions, m²/s.
    fn diffusivity(&self, _density: &[f64], _phi: &[f64]) -> f64 {
        0.0
    }

    /// The longest step that it is stable with in cells of these widths, s.
    ///
    /// - `diffusivity`: the largest of all terms in them, see [`Term::diffusivity`].
    fn step_limit(&self, _widths: [f64; 2], _diffusivity: f64) -> f64 {
        f64::INFINITY
    }

    /// The shear stress σ_zr with which it acts on the wall below a cell, Pa.
    fn wall_shear(&self, _cell: WallCell) -> f64 {
        0.0
    }
}

/// The terms of a case, in the order in which they act.
pub(crate) struct Terms {
    list: Vec<Box<dyn Term>>,
    acceleration: [f64; 2],
    /// Whether there is friction.
    pub is_viscous: bool,
    surface_tension: Option<f64>,
}

impl Terms {
    /// Those that a setup asks for.
    pub fn of(setup: &FluidSetup) -> Self {
        let all: [Option<Box<dyn Term>>; 3] = [
            setup.gravity.map(|gravity| Box::new(gravity) as _),
            setup.viscosity.map(|viscosity| Box::new(viscosity) as _),
            setup.surface_tension.map(|tension| Box::new(tension) as _),
        ];
        let list: Vec<Box<dyn Term>> = all.into_iter().flatten().collect();
        let acceleration = list.iter().fold([0.0; 2], |[z, r], term| {
            let more = term.acceleration();
            [z + more[0], r + more[1]]
        });
        let surface_tension = list.iter().find_map(|term| term.surface_tension());
        Self { list, acceleration, is_viscous: setup.viscosity.is_some(), surface_tension }
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

    /// Adds what the velocities gain until mid-step, see [`Term::predict`].
    pub fn predict(&self, block: &TermBlock<'_>, [v_z, v_r]: [&mut [f64]; 2], works: &mut Vec<Vec<f64>>) {
        works.resize_with(self.list.len(), Vec::new);
        for (term, work) in self.list.iter().zip(works) {
            term.predict(block, [&mut *v_z, &mut *v_r], work);
        }
    }

    /// Adds all terms to the fluxes and to the cells of a block.
    ///
    /// - `works`: rows to work in, of each term.
    /// - returns: in how many cells terms were bounded.
    pub fn add(
        &self,
        block: &TermBlock<'_>,
        [z_faces, r_faces]: [&mut FaceRows; 2],
        works: &mut Vec<Vec<f64>>,
        block_rows: &mut [f64],
    ) -> u64 {
        works.resize_with(self.list.len(), Vec::new);
        let mut bounded = 0;
        for (term, work) in self.list.iter().zip(&mut *works) {
            bounded += term.add_fluxes(block, [&mut *z_faces, &mut *r_faces], work);
        }
        for (term, work) in self.list.iter().zip(works) {
            term.add_sources(block, [z_faces, r_faces], work, block_rows);
        }
        bounded
    }

    /// The largest diffusivity in cells of these densities and gas fractions, m²/s.
    pub fn diffusivity(&self, density: &[f64], phi: &[f64]) -> f64 {
        self.list.iter().fold(0.0, |largest, term| largest.max(term.diffusivity(density, phi)))
    }

    /// See [`Term::step_limit`].
    pub fn step_limit(&self, widths: [f64; 2], diffusivity: f64) -> f64 {
        self.list.iter().fold(f64::INFINITY, |limit, term| limit.min(term.step_limit(widths, diffusivity)))
    }

    /// See [`Term::wall_shear`].
    pub fn wall_shear(&self, cell: WallCell) -> f64 {
        self.list.iter().map(|term| term.wall_shear(cell)).sum()
    }
}
