//! Components that stay with the cell, beyond velocity and stress: plastic strain, temperature, displacement.
//!
//! One is a line in [`of`]: its numbers in snapshots (name and unit stand in [`crate::CELL_FIELDS`]), what it is at t = 0, and
//! what its details count in adaptation. Nothing carries them (strains are small, cells do not move), so there is no flux;
//! prolongation, subcycling and checkpoints take them from the field's count.
//!
//! Fields hold first those that a step depends on, then those that only follow it and have no ghosts.

pub(crate) mod admissible;

use std::ops::Range;

use crate::plasticity::Plasticity;
use crate::state::component::COUNT;
use crate::{Snapshot, WaveSpeeds};

/// The plastic strain ε_p, in fields of solids that can yield.
pub(crate) const PLASTIC_STRAIN: usize = 6;
/// The temperature, K, where the hardening law has heat; elsewhere one that follows has this place.
pub(crate) const TEMPERATURE: usize = 7;

/// Those that only follow: the rate of the plastic strain, and the displacement u_z, u_r.
const FOLLOWING: usize = 3;

/// What of a field of so many components a step depends on.
pub(crate) fn acting(components: usize) -> usize {
    if components > COUNT { components - FOLLOWING } else { components }
}

/// The place of dε_p/dt, 1/s, in a field of so many components that can yield.
pub(crate) fn rate(components: usize) -> usize {
    components - FOLLOWING
}

/// The places of the displacement (u_z, u_r), m, in a field of so many components; none where nothing can yield.
pub(crate) fn displacement(components: usize) -> Range<usize> {
    if components > COUNT { components - 2..components } else { 0..0 }
}

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
    let following: [Component; FOLLOWING] = [
        silent(0.0, |snapshot, cells| snapshot.plastic_strain_rate.extend(cells)),
        silent(0.0, |snapshot, cells| {
            snapshot.displacement.extend(cells.iter().flat_map(|u_z| [*u_z, 0.0, 0.0]))
        }),
        silent(0.0, |snapshot, cells| {
            let block = snapshot.displacement.len() - 3 * cells.len();
            let vectors = snapshot.displacement[block..].chunks_exact_mut(3);
            vectors.zip(cells).for_each(|(vector, u_r)| vector[1] = *u_r);
        }),
    ];
    std::iter::once(strain).chain(temperature).chain(following).collect()
}
