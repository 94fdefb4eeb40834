//! What the fluid's corrections are called where they are written.

use fluid::{Clips, Fixups};
use serde_json::{Value, json};

use crate::output::Column;
use crate::run::record::{column, entries};

/// A correction: its name, its unit, what it is, and its sum so far.
type Sum = (&'static str, &'static str, &'static str, fn(&Fixups) -> f64);

/// Those of [`Fixups`] itself.
const SUMS: [Sum; 8] = [
    ("first_order", "1", "cell-steps at first order so far", |fixups| fixups.first_order as f64),
    ("redone", "1", "cell-steps done again at first order so far", |fixups| fixups.redone as f64),
    ("redone_volume", "m3/rad", "volume of those cells, summed over the steps (planar: m2)", |fixups| {
        fixups.redone_volume
    }),
    ("floored", "1", "cell-steps lifted to the pressure floor so far", |fixups| fixups.floored as f64),
    ("floored_volume", "m3/rad", "volume of those cells, summed over the steps (planar: m2)", |fixups| {
        fixups.floored_volume
    }),
    ("floor_energy", "J/rad", "energy that the floor added so far (planar: J/m)", |fixups| {
        fixups.floor_energy
    }),
    (
        "gas_mass_added",
        "kg/rad",
        "mass that the gas got from the liquid where it had less than none",
        |fixups| fixups.gas_mass_added,
    ),
    ("liquid_mass_added", "kg/rad", "mass that the liquid got from the gas, likewise", |fixups| {
        fixups.liquid_mass_added
    }),
];

/// What is counted in [`Clips::counts`], in their order: name and what it is.
const COUNTS: [(&str, &str); Clips::NAMES.len()] = [
    ("halved_slopes", "cell-steps with half their slopes so far"),
    ("clipped_roots", "faces at which HLLC found no sound speed on a side so far"),
    ("bounded_densities", "mixed cell-steps with a phase's density bounded on a face so far"),
    ("bounded_pressures", "mixed cell-steps with the pressure bounded on a face so far"),
    ("bounded_fractions", "mixed cell-steps with the gas fraction bounded on a face so far"),
    ("emptied_faces", "faces behind whose wave the linear rule leaves no gas so far"),
    ("clipped_fractions", "cell-steps that ended with a bounded gas fraction so far"),
    ("removed_traces", "gas fractions and masses below 1e-20 set to zero so far"),
    ("limited_predictions", "coarse cells whose prediction was limited so far"),
    ("scaled_traces", "faces whose trace for the solid was scaled so far"),
    ("lifted_phases", "cell-steps in which a phase's mass was lifted to zero so far"),
    ("expanded_cells", "mixed cell-steps left in tension whose gas expanded so far"),
    ("bounded_viscosities", "cell-steps of gas too thin for the step's viscosity so far"),
    ("bounded_conductivities", "cell-steps of gas too thin for the step's conduction so far"),
];

/// The columns of `/fixups`.
pub fn columns() -> Vec<Column<'static>> {
    let sums = SUMS.map(|(name, unit, description, _)| column(name, unit, description));
    let counts = COUNTS.map(|(name, description)| column(name, "1", description));
    sums.into_iter().chain(counts).collect()
}

/// A row of it.
pub fn row(fixups: &Fixups) -> Vec<f64> {
    let counts = fixups.clips.counts().map(|count| count as f64);
    SUMS.iter().map(|(.., sum)| sum(fixups)).chain(counts).collect()
}

/// The corrections as the summary has them.
///
/// - `collapse_energy`: what [`Fixups::floor_energy`] is to be compared with, J/rad; 0 without gas.
pub fn summary(fixups: Fixups, collapse_energy: f64) -> Value {
    let share = |energy: f64| (collapse_energy > 0.0).then_some(energy / collapse_energy);
    let mut map = entries(json!({
        "first_order": fixups.first_order,
        "redone": fixups.redone,
        "redone_volume": fixups.redone_volume,
        "floored": fixups.floored,
        "floored_volume": fixups.floored_volume,
        "floor_energy": fixups.floor_energy,
        "floor_energy_share": share(fixups.floor_energy),
        "gas_mass_added": fixups.gas_mass_added,
        "liquid_mass_added": fixups.liquid_mass_added,
    }));
    let clips = Clips::NAMES.iter().zip(fixups.clips.counts());
    map.extend(clips.map(|(name, count)| ((*name).to_owned(), count.into())));
    Value::Object(map)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_and_counts_have_the_same_names() {
        assert_eq!(COUNTS.map(|(name, _)| name), Clips::NAMES);
    }
}
