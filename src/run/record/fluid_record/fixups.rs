//! What the fluid's corrections are called where they are written.

use fluid::{Clips, Fixups};
use serde_json::{Map, Value, json};

use crate::output::Column;
use crate::run::record::column;

/// The columns of [`Clips::counts`].
pub const CLIP_COLUMNS: [Column<'static>; Clips::NAMES.len()] = [
    column("fixups/halved_slopes", "1", "cell-steps with half their slopes so far"),
    column("fixups/clipped_roots", "1", "faces at which HLLC found no sound speed on a side so far"),
    column(
        "fixups/bounded_densities",
        "1",
        "mixed cell-steps with a phase's density bounded on a face so far",
    ),
    column("fixups/bounded_pressures", "1", "mixed cell-steps with the pressure bounded on a face so far"),
    column(
        "fixups/bounded_fractions",
        "1",
        "mixed cell-steps with the gas fraction bounded on a face so far",
    ),
    column("fixups/emptied_faces", "1", "faces behind whose wave the linear rule leaves no gas so far"),
    column("fixups/clipped_fractions", "1", "cell-steps that ended with a bounded gas fraction so far"),
    column("fixups/removed_traces", "1", "gas fractions and masses below 1e-20 set to zero so far"),
    column("fixups/limited_predictions", "1", "coarse cells whose prediction was limited so far"),
    column("fixups/scaled_traces", "1", "faces whose trace for the solid was scaled so far"),
    column("fixups/lifted_phases", "1", "cell-steps in which a phase's mass was lifted to zero so far"),
    column("fixups/expanded_cells", "1", "mixed cell-steps left in tension whose gas expanded so far"),
    column("fixups/bounded_viscosities", "1", "cell-steps of gas too thin for the step's viscosity so far"),
    column(
        "fixups/bounded_conductivities",
        "1",
        "cell-steps of gas too thin for the step's conduction so far",
    ),
];

/// The corrections as the summary has them.
///
/// - `collapse_energy`: what [`Fixups::floor_energy`] is to be compared with, J/rad; 0 without gas.
pub fn summary(fixups: Fixups, collapse_energy: f64) -> Value {
    let share = |energy: f64| (collapse_energy > 0.0).then_some(energy / collapse_energy);
    let whole = json!({
        "first_order": fixups.first_order,
        "redone": fixups.redone,
        "redone_volume": fixups.redone_volume,
        "floored": fixups.floored,
        "floored_volume": fixups.floored_volume,
        "floor_energy": fixups.floor_energy,
        "floor_energy_share": share(fixups.floor_energy),
        "gas_mass_added": fixups.gas_mass_added,
        "liquid_mass_added": fixups.liquid_mass_added,
    });
    let clips = Clips::NAMES
        .iter()
        .zip(fixups.clips.counts())
        .map(|(name, count)| ((*name).to_owned(), count.into()));
    match whole {
        Value::Object(mut map) => {
            map.extend(clips.collect::<Map<String, Value>>());
            Value::Object(map)
        }
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_and_counts_have_the_same_names() {
        for (column, name) in CLIP_COLUMNS.iter().zip(Clips::NAMES) {
            assert_eq!(column.name, format!("fixups/{name}"));
        }
    }
}
