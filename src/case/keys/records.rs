//! What a run records and writes: `[[probe]]`, `[[sensor]]` and `[output]`.

use super::declared::{Key, Preset, Section, Values};
use super::grid::MOST_CELLS;

/// Level of compression: 4 takes half as long again for 0.3 % less, 9 twice as long for 3 %.
pub(in crate::case) const COMPRESSION: u8 = 2;

const NAME: Key = Key {
    name: "name",
    unit: "",
    values: Values::Words("letters, digits, `_` and `-`"),
    default: Preset::Required,
    about: "What its datasets are called; no two may have one name.",
};

/// The fields of snapshots, of the fluid and then those that only the solid has.
pub(in crate::case) fn fields() -> Vec<&'static str> {
    let mut names: Vec<&str> = fluid::CELL_FIELDS.iter().map(|field| field.name).collect();
    for field in solid::CELL_FIELDS {
        if !names.contains(&field.name) {
            names.push(field.name);
        }
    }
    names
}

pub(super) static RECORDS: [Section; 3] = [
    Section {
        path: "probe",
        repeated: true,
        title: "Probes",
        about: "Points at which every step is recorded, from the linear reconstruction in the cell. On the interface, also \
                under a load, pressure and v_z (solid: σ_zz and v_z) are those of the star state, and the shear is that of \
                the fluid's friction, zero without viscosity.",
        keys: &[
            NAME,
            Key {
                name: "position",
                unit: "m",
                values: Values::Point,
                default: Preset::Required,
                about: "Where it is, in the medium, its boundaries included.",
            },
            Key {
                name: "medium",
                unit: "",
                values: Values::Names(&[("fluid", "the fluid"), ("solid", "the solid")]),
                default: Preset::Required,
                about: "Whose fields it records.",
            },
        ],
    },
    Section {
        path: "sensor",
        repeated: true,
        title: "Sensors",
        about: "A disc on the wall about the axis, as a transducer has one; in planar geometry a strip from \
                −`radius` (or r_min) to `radius`. After every step it records the mean of the pressure beyond that at t = 0, its force and \
                its impulse: [`/sensors/NAME`][sensors].",
        keys: &[
            NAME,
            Key {
                name: "radius",
                unit: "m",
                values: Values::Positive,
                default: Preset::Required,
                about: "Its radius, within the wall.",
            },
            Key {
                name: "rise_time",
                unit: "s",
                values: Values::Positive,
                default: Preset::Words("none: each step by itself"),
                about: "Pressure and force are means over so long.",
            },
        ],
    },
    Section {
        path: "output",
        repeated: false,
        title: "Output",
        about: "",
        keys: &[
            Key {
                name: "directory",
                unit: "",
                values: Values::Words("a path"),
                default: Preset::Words("`runs/NAME`, by the case file's name"),
                about: "The run directory. `--out` goes before it.",
            },
            Key {
                name: "fields",
                unit: "",
                values: Values::AnyOf(fields),
                default: Preset::Words("all"),
                about: "The fields of snapshots.",
            },
            Key {
                name: "compression",
                unit: "1",
                values: Values::Whole(0, 9),
                default: Preset::Whole(COMPRESSION as usize),
                about: "How hard snapshots are compressed; 0 is not at all.",
            },
            Key {
                name: "interface_cells",
                unit: "1",
                values: Values::Whole(1, MOST_CELLS),
                default: Preset::Words("the finest fluid faces"),
                about: "Cells of the radial grid of the interface's history.",
            },
            Key {
                name: "interface_every",
                unit: "s",
                values: Values::Positive,
                default: Preset::Words("`time.end` / 1000"),
                about: "The interval of the histories of the interface and of the conserved quantities; at most 10⁶ rows.",
            },
            Key {
                name: "mean_time",
                unit: "s",
                values: Values::Positive,
                default: Preset::Words("R/(12 *c*); without a gas region or ambient liquid no mean"),
                about: "Over how long the wall pressure on the axis is averaged for `wall_pressure_mean_peak`; at most \
                        `time.end`. In the default *R* is the equivalent radius of the first gas region, *c* the sound \
                        speed of the ambient liquid.",
            },
        ],
    },
];
