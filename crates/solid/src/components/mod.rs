//! Components that stay with the cell, beyond velocity and stress: plastic strain, temperature.
//!
//! One is a line in [`of`]: its numbers in snapshots (name and unit stand in [`crate::CELL_FIELDS`]), what it is at t = 0, and
//! what its details count in adaptation. Nothing carries them (strains are small, cells do not move), so there is no flux;
//! prolongation, subcycling and checkpoints take them from the field's count.

pub(crate) mod admissible;

use crate::plasticity::Plasticity;
use crate::{Snapshot, WaveSpeeds};

/// The plastic strain ε_p, in fields of solids that can yield.
pub(crate) const PLASTIC_STRAIN: usize = 6;
/// The temperature, K, where the hardening law has heat.
pub(crate) const TEMPERATURE: usize = 7;

/// A component that stays with the cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Component {
    /// Its numbers in a snapshot, with name and unit: a line of [`crate::CELL_FIELDS`].
    pub field: fn(&mut Snapshot) -> &mut Vec<f64>,
    /// At t = 0.
    pub initial: f64,
    /// What a detail of 1 counts as a stress in adaptation, Pa.
    pub as_stress: f64,
}

/// Those of a solid, in the order in which fields hold them after velocity and stress; none if it is elastic.
///
/// A step δε_p of plastic strain leaves a stress of up to about 3μ δε_p behind, and counts as that: the thresholds of adaptation stay
/// one, and where an unloaded zone's stress is resolved its plastic strain is, too. A temperature follows its plastic strain.
pub(crate) fn of(plasticity: Option<&Plasticity>, speeds: WaveSpeeds) -> Vec<Component> {
    let Some(plasticity) = plasticity else { return Vec::new() };
    let strain = Component {
        field: |snapshot| &mut snapshot.plastic_strain,
        initial: 0.0,
        as_stress: 3.0 * speeds.shear_modulus(),
    };
    let temperature = plasticity.hardening().reference_temperature().map(|initial| Component {
        field: |snapshot| &mut snapshot.temperature,
        initial,
        as_stress: 0.0,
    });
    std::iter::once(strain).chain(temperature).collect()
}
