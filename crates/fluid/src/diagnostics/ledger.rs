//! What is added up over a run: corrections, and what crossed the sides.

use serde::{Deserialize, Serialize};

use crate::phase_change::BlockExchange;
use crate::step::clips::Clips;

/// Corrections that were made where the scheme left the admissible states.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
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
    /// Mass that the gas got from the liquid in cells where it had less than none, kg (likewise).
    pub gas_mass_added: f64,
    /// Mass that the liquid got from the gas, likewise.
    pub liquid_mass_added: f64,
    /// How often other bounds acted.
    pub clips: Clips,
}

/// What has changed phase since the start.
///
/// Per radian in axial symmetry, per metre of depth in planar geometry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PhaseLedger {
    /// Mass that evaporated, kg.
    pub evaporated: f64,
    /// Mass that condensed, kg.
    pub condensed: f64,
    /// What the energy, which is counted without reference energies, has gained by it, J: (q_l − q_v) of what evaporated.
    pub energy: f64,
    /// Cell-steps in which liquid opened under tension.
    pub opened: u64,
    /// Mass that evaporated in them, kg.
    pub opened_mass: f64,
}

impl PhaseLedger {
    /// Adds what changed phase in a block's step.
    pub(crate) fn add(&mut self, more: &BlockExchange) {
        self.evaporated += more.evaporated;
        self.condensed += more.condensed;
        self.energy += more.energy;
        self.opened += u64::from(more.opened);
        self.opened_mass += more.opened_mass;
    }
}

/// What crossed the sides of the domain since the start, inwards, in the order of [`mesh::Side::ALL`], and what surface tension did.
///
/// Per radian in axial symmetry, per metre of depth in planar geometry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BoundaryLedger {
    /// Mass, kg.
    pub mass: [f64; 4],
    /// Axial momentum, N s: what flows in and the impulse of the pressure.
    pub momentum: [f64; 4],
    /// Energy, J.
    pub energy: [f64; 4],
    /// Mass of the gas, kg; zeros where phases have no masses of their own. Where gas lies on a wall that moves, its motion carries it
    /// through the fixed face.
    pub gas_mass: [f64; 4],
    /// Impulse of p* on the wall to the solid, N s: what the solid got. The momentum through z_min has the ρ*v*² of the
    /// wall's motion besides.
    pub wall_impulse: f64,
    /// Work of p* on the wall to the solid, J: what the fluid got.
    pub wall_work: f64,
    /// Heat that the wall on z_min got by conduction, J; the energy through z_min has it, too.
    pub wall_heat: f64,
    /// Axial impulse of surface tension on the fluid within, N s: nothing but for what the curvatures of the grid's cells leave.
    pub tension_impulse: f64,
    /// Work of surface tension on the fluid within, J: σ times the area that interfaces have lost.
    pub tension_work: f64,
}
