//! `[fluid.terms]`: viscosity, surface tension.

use super::declared::{Key, Preset, Section, Values};

pub(super) static TERMS: [Section; 2] = [
    Section {
        path: "fluid.terms",
        repeated: false,
        title: "Terms",
        about: "What acts on the fluid besides the waves of two-phase flow; each is off where it is absent.",
        keys: &[
            Key {
                name: "surface_tension",
                unit: "N/m",
                values: Values::Words("≥ 0"),
                default: Preset::Number(0.0),
                about: "[Surface tension][surface-tension] σ between liquid and gas; 0.0728 for water and air at 20 °C. The gas's \
                        pressure in a region is what it is: Laplace's jump is part of it.",
            },
            Key {
                name: "contact_angle",
                unit: "degrees",
                values: Values::Words("90"),
                default: Preset::Words("none: no interface may meet a wall"),
                about: "The angle at which interfaces with tension meet walls. Without it a run whose interface comes to a wall is \
                        refused, or ends there.",
            },
        ],
    },
    Section {
        path: "fluid.terms.viscosity",
        repeated: false,
        title: "Viscosity",
        about: "As `viscosity = { liquid = 1.0e-3, gas = 1.8e-5 }` in `[fluid.terms]`.",
        keys: &[
            Key {
                name: "liquid",
                unit: "Pa s",
                values: Values::Words("≥ 0"),
                default: Preset::Required,
                about: "Dynamic viscosity of the liquid; 1.0e-3 for water at 20 °C.",
            },
            Key {
                name: "gas",
                unit: "Pa s",
                values: Values::Words("≥ 0"),
                default: Preset::Required,
                about: "Dynamic viscosity of the gas; 1.8e-5 for air. 0.0 saves the steps that thin gas asks for.",
            },
            Key {
                name: "bulk_liquid",
                unit: "Pa s",
                values: Values::Words("≥ 0"),
                default: Preset::Number(0.0),
                about: "Bulk viscosity of the liquid; 2.5e-3 for water at 20 °C.",
            },
            Key {
                name: "bulk_gas",
                unit: "Pa s",
                values: Values::Words("≥ 0"),
                default: Preset::Number(0.0),
                about: "Bulk viscosity of the gas.",
            },
            Key {
                name: "thin_gas",
                unit: "",
                values: Values::Names(&[
                    ("bounded", "it has the viscosity that the step is stable with, which is counted"),
                    ("resolved", "it limits the step"),
                    (
                        "super-time-stepping",
                        "it has all of its viscosity, in stages within the step; neither gas nor liquid limits that",
                    ),
                ]),
                default: Preset::Name("bounded"),
                about: "What gas does whose momentum spreads over more than a cell in a step.",
            },
        ],
    },
];
