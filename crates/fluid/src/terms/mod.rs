//! Terms of the equations besides the waves of two-phase flow: fluxes through faces, sources in cells, limits on the step.
//!
//! A term is a file with a type that is a [`Term`], and a line in [`Terms::of`]. It says what it adds to a block's step; prolongation,
//! flux registers, subcycling, the first-order fall-back, checkpoints and the coupling take part without knowing of it. Terms that a
//! case has not are not in the list, and a block's step with an empty list is bitwise that without terms.

pub(crate) mod conduction;
pub(crate) mod diffusion;
mod finished_cells;
pub(crate) mod gas_slip;
pub(crate) mod gravity;
pub(crate) mod heating;
pub(crate) mod super_stepping;
pub(crate) mod surface_tension;
pub(crate) mod viscosity;

use mesh::{FaceState, Side, cell_below};

use crate::capillarity::CapillaryRows;
use crate::reconstruction::Rows;
use crate::state::primitive::PHI;
use crate::step::clips::Clips;
use crate::step::face_rows::FaceRows;
use crate::step::update::Metric;
use crate::{Boundary, EvaporationLaw, FluidSetup, Mixture};
pub(crate) use finished_cells::FinishedCells;

use conduction::ConductionTerm;
use gas_slip::GasSlip;
use super_stepping::{Spreading, View};

/// Cells of which so much is of one phase are not mixed.
const ONE_PHASE: f64 = 1e-6;

/// The gas's part of the mass in the padded cells, as terms see it.
#[derive(Clone, Copy)]
pub(crate) enum GasMass<'a> {
    /// There is no gas.
    Absent,
    /// There may be, and the phases have no masses of their own.
    Unknown,
    /// m_g/ρ.
    Shares(&'a [f64]),
}

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
    /// The faces of the wall to another medium, in the order of r, where the block has any, and as many more at both ends as there are
    /// ghosts: those of the blocks beside it.
    pub wall: Option<&'a [FaceState]>,
    /// The jumps of pressure across interfaces, where there is surface tension.
    pub capillary: &'a CapillaryRows,
    /// How much of the mass is gas at the beginning of the step.
    pub gas: GasMass<'a>,
    /// The vapour's part of the mass at the beginning of the step, where masses change phase.
    pub vapour: Option<&'a [f64]>,
    /// The laws of phases that give way each by its own, as in the five-equation model.
    pub closure: Option<&'a Mixture>,
    /// What walls do with heat.
    pub heat_beyond: HeatBeyond<'a>,
    /// What blocks have found together in stages, if any.
    pub spread: Option<View<'a>>,
}

impl TermBlock<'_> {
    /// The sides of the domain that the block touches.
    pub fn bounding_sides(&self) -> impl Iterator<Item = (Side, Boundary)> + use<> {
        let sides = self.sides;
        Side::ALL.into_iter().filter_map(move |side| Some((side, sides[side as usize]?)))
    }
}

/// The padded places of the cell next to a side, `along` cells from its beginning, and of the ghost beyond.
pub(crate) fn beside_padded(side: Side, cells: usize, metric: &Metric<'_>, along: isize) -> [usize; 2] {
    let [origin, stride] = [metric.origin, metric.stride].map(|place| place as isize);
    [0, -1].map(|depth| {
        let (i, j) = cell_below(cells, side, depth, along);
        (origin + j * stride + i) as usize
    })
}

/// What walls do with heat, in a step of a block.
#[derive(Clone, Copy, Debug)]
pub(crate) enum HeatBeyond<'a> {
    /// They let nothing through.
    Nothing,
    /// All have this temperature, K.
    Kept(f64),
    /// The wall on z_min has these temperatures without heat coming in, K, on the faces of the block and one more at both ends; and it is
    /// warmer by this much per flux, m² K/W.
    Wall { temperatures: &'a [f64], resistance: f64 },
}

impl HeatBeyond<'_> {
    /// The temperature beyond a face of a side, K, and the resistance in front of it, m² K/W; `None` where nothing passes.
    ///
    /// - `along`: of the face, from −1 to the number of cells.
    pub fn at(&self, side: Side, kind: Boundary, along: isize) -> Option<[f64; 2]> {
        match *self {
            Self::Kept(temperature) if kind.is_wall() => Some([temperature, 0.0]),
            Self::Wall { temperatures, resistance } if kind.is_wall() && side == Side::ZMin => {
                Some([temperatures[(along + 1) as usize], resistance])
            }
            _ => None,
        }
    }
}

/// Calls `visit` for the padded cells without their ends that have no state at mid-step but on their faces: mixed ones of the five-equation
/// model. Whether a cell is one does not depend on the block that sees it.
pub(crate) fn for_cells_without_mid_step(block: &TermBlock<'_>, mut visit: impl FnMut(usize)) {
    let phi = block.before[PHI];
    if phi.iter().all(|phi| *phi == 0.0) {
        return;
    }
    let stride = block.metric.stride;
    let is_beside_another =
        |k: usize| [k - 1, k + 1, k - stride, k + stride].iter().any(|n| (phi[*n] - phi[k]).abs() > 0.5);
    for k in stride + 1..phi.len() - stride - 1 {
        if (phi[k] > ONE_PHASE && phi[k] < 1.0 - ONE_PHASE) || is_beside_another(k) {
            visit(k);
        }
    }
}

/// A cell on the wall to another medium, as terms see it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WallCell {
    /// kg/m³.
    pub density: f64,
    /// Gas fraction, and that of the cell behind it.
    pub phi: [f64; 2],
    /// The velocities of both along the wall relative to the wall's own, at mid-step as waves alone make them, m/s.
    pub by_waves: [f64; 2],
    /// The first one with terms.
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

    /// Adds what the pressure of a block and its first ghosts gains until mid-step.
    fn predict_pressure(&self, _block: &TermBlock<'_>, _pressure: &mut [f64], _work: &mut Vec<f64>) {}

    /// Adds to the fluxes through the faces of a block along z and r, before they are registered; they hold those of waves.
    ///
    /// - returns: in how many cells of the block it was bounded.
    fn add_fluxes(&self, _block: &TermBlock<'_>, _faces: [&mut FaceRows; 2], _work: &mut Vec<f64>) -> Clips {
        Clips::default()
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

    /// What it does to cells of both phases at the end of a step, where phases have masses of their own.
    ///
    /// - `work`: as its own [`Term::add_fluxes`] has left it.
    fn finish(&self, _cells: &mut FinishedCells<'_>, _work: &[f64]) {}

    /// The heat that the wall on z_min gets on the faces of a block, W/m², and its temperatures, K.
    ///
    /// - `work`: as its own [`Term::add_fluxes`] has left it; `padded`: the length of padded rows.
    fn wall_heat<'w>(&self, _work: &'w [f64], _padded: usize) -> Option<[&'w [f64]; 2]> {
        None
    }

    /// What vapour passes through the faces along z and r beyond its part of the gas, kg/(m² s).
    ///
    /// - `work`: as its own [`Term::add_fluxes`] has left it; `padded`: the length of padded rows.
    fn selected_vapour<'w>(&self, _work: &'w [f64], _padded: usize) -> Option<[&'w [f64]; 2]> {
        None
    }

    /// What of it spreads in stages within a step, if it does.
    fn spreading(&self) -> Option<&dyn Spreading> {
        None
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
    /// Whether heat is conducted.
    pub conducts: bool,
    /// Whether there is friction or conduction.
    pub is_diffusive: bool,
    /// Whether something spreads in stages within a step.
    pub spreads: bool,
    surface_tension: Option<f64>,
}

impl Terms {
    /// Those that a setup asks for.
    pub fn of(setup: &FluidSetup) -> Self {
        let mixture = setup.mixture();
        let boils = setup.phase_change.is_some_and(|asked| asked.law == EvaporationLaw::Equilibrium);
        let conduction = setup.conduction.and_then(|asked| ConductionTerm::of(asked, &mixture, boils));
        let (is_viscous, conducts) = (setup.viscosity.is_some(), conduction.is_some());
        let all: [Option<Box<dyn Term>>; 5] = [
            setup
                .phase_change
                .and_then(|asked| GasSlip::of(&asked, &mixture))
                .map(|slip| Box::new(slip) as _),
            setup.gravity.map(|gravity| Box::new(gravity) as _),
            setup.viscosity.map(|viscosity| Box::new(viscosity) as _),
            conduction.map(|conduction| Box::new(conduction) as _),
            setup.surface_tension.map(|tension| Box::new(tension) as _),
        ];
        let list: Vec<Box<dyn Term>> = all.into_iter().flatten().collect();
        let acceleration = list.iter().fold([0.0; 2], |[z, r], term| {
            let more = term.acceleration();
            [z + more[0], r + more[1]]
        });
        let surface_tension = list.iter().find_map(|term| term.surface_tension());
        let spreads = list.iter().any(|term| term.spreading().is_some());
        let is_diffusive = is_viscous || conducts;
        Self { list, acceleration, is_viscous, conducts, is_diffusive, spreads, surface_tension }
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

    /// Adds what the pressure gains until mid-step, see [`Term::predict_pressure`].
    pub fn predict_pressure(&self, block: &TermBlock<'_>, pressure: &mut [f64], works: &mut Vec<Vec<f64>>) {
        works.resize_with(self.list.len(), Vec::new);
        for (term, work) in self.list.iter().zip(works) {
            term.predict_pressure(block, pressure, work);
        }
    }

    /// See [`Term::wall_heat`].
    pub fn wall_heat<'w>(&self, works: &'w [Vec<f64>], padded: usize) -> Option<[&'w [f64]; 2]> {
        self.list.iter().zip(works).find_map(|(term, work)| term.wall_heat(work, padded))
    }

    /// See [`Term::selected_vapour`].
    pub fn selected_vapour<'w>(&self, works: &'w [Vec<f64>], padded: usize) -> Option<[&'w [f64]; 2]> {
        self.list.iter().zip(works).find_map(|(term, work)| term.selected_vapour(work, padded))
    }

    /// What spreads in stages within a step.
    pub fn spreading(&self) -> impl Iterator<Item = &dyn Spreading> {
        self.list.iter().filter_map(|term| term.spreading())
    }

    /// See [`Term::finish`].
    pub fn finish(&self, cells: &mut FinishedCells<'_>, works: &[Vec<f64>]) {
        for (term, work) in self.list.iter().zip(works) {
            term.finish(cells, work);
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
    ) -> Clips {
        works.resize_with(self.list.len(), Vec::new);
        let mut bounded = Clips::default();
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
