//! `[fluid]`: the domain, the model, and what the liquid and the gas are.

use super::declared::{Key, Preset, Section, Values};
use super::grid::{CELLS, LEVELS, LIMITER, R, Z};

/// The gas where a case does not say: γ, and π in Pa.
pub(in crate::case) const GAS: [f64; 2] = [1.4, 0.0];

/// Of both phases.
const FLUID_NAME: Key = Key {
    name: "fluid",
    unit: "",
    values: Values::Words("a fluid of `cav materials`, as `\"water\"` or `\"air\"`"),
    default: Preset::None,
    about: "A fluid known by name, of which all constants are taken that the table does not give.",
};

/// γ of a phase.
const fn exponent(default: Preset, about: &'static str) -> Key {
    Key { name: "gamma", unit: "1", values: Values::Words("> 1"), default, about }
}

/// π of a phase.
const fn stiffness(default: Preset, about: &'static str) -> Key {
    Key { name: "pi", unit: "Pa", values: Values::Words("≥ 0"), default, about }
}

const COVOLUME: Key = Key {
    name: "covolume",
    unit: "m3/kg",
    values: Values::Words("≥ 0, with bρ < 1 everywhere"),
    default: Preset::Words("that of `fluid`, else 0"),
    about: "The covolume b, which makes the law a [Noble–Abel stiffened gas][eos]; not with `model = \"saurel-abgrall\"`.",
};

const HEAT_CAPACITY: Key = Key {
    name: "heat_capacity",
    unit: "J/(kg K)",
    values: Values::Positive,
    default: Preset::Words("that of `fluid`, else none"),
    about: "The heat capacity c_v at constant volume; gives temperatures.",
};

const ENERGY: Key = Key {
    name: "energy",
    unit: "J/kg",
    values: Values::Number,
    default: Preset::Words("that of `fluid`, else 0"),
    about: "The reference energy q; with a heat capacity only.",
};

const ENTROPY: Key = Key {
    name: "entropy",
    unit: "J/(kg K)",
    values: Values::Number,
    default: Preset::Words("that of `fluid`, else 0"),
    about: "The reference entropy q′; with a heat capacity only.",
};

pub(super) static FLUID: [Section; 3] = [
    Section {
        path: "fluid",
        repeated: false,
        title: "The fluid",
        about: "",
        keys: &[
            Z,
            R,
            CELLS,
            LEVELS,
            Key {
                name: "model",
                unit: "",
                values: Values::Names(&[
                    ("five-equation", "partial densities, and a gas fraction that feels compression"),
                    ("allaire", "without the K term, for study"),
                    ("saurel-abgrall", "the paper's mixture"),
                ]),
                default: Preset::Name("five-equation"),
                about: "The [two-phase model][models].",
            },
            Key {
                name: "interface",
                unit: "",
                values: Values::Names(&[
                    ("thinc", "a step within mixed cells; refused with `\"saurel-abgrall\"`"),
                    ("none", "the limited linear reconstruction"),
                ]),
                default: Preset::Words("`\"thinc\"`; with `model = \"saurel-abgrall\"` `\"none\"`"),
                about: "What keeps the interface between gas and liquid sharp.",
            },
            Key {
                name: "riemann",
                unit: "",
                values: Values::Names(&[
                    ("hllc", "Harten, Lax and van Leer's with a contact"),
                    ("hllc-lm", "the same with less damping of flow that is slow against sound"),
                    ("exact", "the exact solver for two (Noble–Abel) stiffened gases"),
                ]),
                default: Preset::Name("hllc"),
                about: "The Riemann solver at cell faces.",
            },
            LIMITER,
            Key {
                name: "initial_pressure",
                unit: "",
                values: Values::Names(&[
                    ("uniform", "the ambient pressure up to the bubble's wall: a water hammer"),
                    (
                        "rayleigh",
                        "what an incompressible liquid at rest would have: no wave leaves the bubble",
                    ),
                ]),
                default: Preset::Name("uniform"),
                about: "The [pressure of the start][start] in the liquid.",
            },
            Key {
                name: "gravity",
                unit: "m/s2",
                values: Values::Number,
                default: Preset::Number(0.0),
                about: "Acceleration along z, negative towards the wall; for ambient liquid and sides without a far \
                        field. The ambient pressure is then that on `z_min`, and the liquid [begins at rest][gravity] \
                        with p + ρg(z − z_min). Gas begins with its own pressure everywhere. Open sides are \
                        `\"non-reflecting\"` by default.",
            },
        ],
    },
    Section {
        path: "fluid.liquid",
        repeated: false,
        title: "The liquid",
        about: "Required. A [stiffened gas][eos], p = (γ − 1) ρe − γπ, or with a covolume b a Noble–Abel one. Everywhere density > 0 and p + π > 0.",
        keys: &[
            FLUID_NAME,
            exponent(
                Preset::Words("that of `fluid`; else required"),
                "The adiabatic exponent γ; 7.15 for water.",
            ),
            stiffness(Preset::Words("that of `fluid`; else required"), "The stiffness π; 3e8 for water."),
            COVOLUME,
            HEAT_CAPACITY,
            ENERGY,
            ENTROPY,
        ],
    },
    Section {
        path: "fluid.gas",
        repeated: false,
        title: "The gas",
        about: "The same law as the liquid's.",
        keys: &[
            FLUID_NAME,
            exponent(Preset::Number(GAS[0]), "The adiabatic exponent γ; 1.4 for air."),
            stiffness(Preset::Number(GAS[1]), "The stiffness π; 0 for a gas."),
            COVOLUME,
            HEAT_CAPACITY,
            ENERGY,
            ENTROPY,
        ],
    },
];
