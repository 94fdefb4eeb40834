//! Components that stay with the cell, beyond velocity and stress: plastic strain, temperature.
//!
//! One is a line in [`of`]: its numbers in snapshots (name and unit stand in [`crate::CELL_FIELDS`]), what it is at t = 0, and
//! what its details count in adaptation. Nothing carries them (strains are small, cells do not move), so there is no flux;
//! prolongation, subcycling and checkpoints take them from the field's count. What no step depends on is in [`following`].

pub(crate) mod admissible;
pub(crate) mod following;
pub(crate) mod untouched;

use crate::plasticity::Plasticity;
use crate::{Snapshot, WaveSpeeds};

/// The plastic strain ε_p, in fields of solids that can yield.
pub(crate) const PLASTIC_STRAIN: usize = 6;
/// The temperature, K, in fields of solids whose hardening law has heat.
pub(crate) const TEMPERATURE: usize = 7;

/// A component that stays with the cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Component {
    /// Adds its numbers in a block to a snapshot, where name and unit are: a line of [`crate::CELL_FIELDS`].
    pub put: fn(&mut Snapshot, &[f64]),
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
    let silent = |initial, put| Component { put, initial, as_stress: 0.0 };
    let strain = Component {
        as_stress: 3.0 * speeds.shear_modulus(),
        ..silent(0.0, |snapshot, cells| snapshot.plastic_strain.extend(cells))
    };
    let temperature = plasticity
        .hardening()
        .reference_temperature()
        .map(|initial| silent(initial, |snapshot, cells| snapshot.temperature.extend(cells)));
    std::iter::once(strain).chain(temperature).collect()
}
