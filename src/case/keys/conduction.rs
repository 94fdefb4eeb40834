//! `[fluid.terms.conduction]`: conduction of heat, and what walls do with it.

use super::declared::{Key, Preset, Section, Values};

pub(super) static CONDUCTION: [Section; 1] = [Section {
    path: "fluid.terms.conduction",
    repeated: false,
    title: "Conduction",
    about: "As `conduction = { liquid = 0.6, gas = 0.026 }` in `[fluid.terms]`: [heat is conducted][conduction] in both phases and \
            between them. Both need a `heat_capacity`, as `fluid = \"water-nasg\"` and `fluid = \"air\"` have it. With a wall on \
            `z_min`, `/interface/wall_temperature` and `/interface/heat_flux` say what it gets, `wall_temperature_peak` how hot it \
            was.",
    keys: &[
        Key {
            name: "liquid",
            unit: "W/(m K)",
            values: Values::Words("≥ 0"),
            default: Preset::Required,
            about: "Conductivity λ of the liquid; 0.6 for water at 20 °C.",
        },
        Key {
            name: "gas",
            unit: "W/(m K)",
            values: Values::Words("≥ 0"),
            default: Preset::Required,
            about: "Conductivity λ of the gas; 0.026 for air at 20 °C.",
        },
        Key {
            name: "thin_gas",
            unit: "",
            values: Values::Names(&[
                ("bounded", "it conducts as much as the step is stable with, which is counted"),
                ("resolved", "it limits the step"),
                (
                    "super-time-stepping",
                    "it conducts all there is, in stages within the step; neither gas nor liquid limits that",
                ),
            ]),
            default: Preset::Name("bounded"),
            about: "What gas does whose heat spreads over more than a cell in a step.",
        },
        Key {
            name: "wall",
            unit: "",
            values: Values::Names(&[
                ("adiabatic", "nothing passes"),
                ("isothermal", "the solid and all sides that are walls have `wall_temperature`"),
                (
                    "conducting",
                    "the wall on `z_min` conducts heat itself, each face as a half-space; other sides let nothing through",
                ),
            ]),
            default: Preset::Words(
                "`\"isothermal\"` where `wall_temperature` is given, else `\"adiabatic\"`",
            ),
            about: "What walls do with heat.",
        },
        Key {
            name: "wall_temperature",
            unit: "K",
            values: Values::Positive,
            default: Preset::Words("required with `\"isothermal\"` and `\"conducting\"`"),
            about: "The temperature of walls; of one that conducts at first, and far within.",
        },
        Key {
            name: "wall_material",
            unit: "",
            values: Values::Words("a material of `cav materials`"),
            default: Preset::Words("that of `solid.material`"),
            about: "What a wall that conducts is made of.",
        },
        Key {
            name: "wall_effusivity",
            unit: "J/(m2 K s^0.5)",
            values: Values::Positive,
            default: Preset::Words("√(λρc) of the material"),
            about: "All that a wall that conducts shows of itself; for a material that is not in the library.",
        },
    ],
}];
