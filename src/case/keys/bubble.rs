//! `[fluid.bubble]`: a bubble by what is in it, how the grid follows it, and how its gas is cut.

use super::declared::{Interval, Key, Preset, Section, Values};
use super::grid::centre;

/// Room temperature where a case does not say, K.
pub(in crate::case) const TEMPERATURE: f64 = 293.15;

/// Cells along the present radius that a case may ask for.
const CELLS: Interval = Interval::closed(2.0, 1e4);

const SHARE: Interval = Interval::open(0.0, 1.0);

pub(super) static BUBBLE: [Section; 2] = [
    Section {
        path: "fluid.bubble",
        repeated: false,
        title: "A bubble by what is in it",
        about: "Gas and vapour as laboratories describe them, see [what is in the bubble][bubble]: it makes the first region of gas, \
                painted before others. With `region` instead of `centre` and a radius it is about a region that is there.",
        keys: &[
            centre("The centre, on the axis and in the fluid."),
            Key {
                name: "radius_max",
                unit: "m",
                values: Values::Positive,
                default: Preset::Words("one of `radius_max` and `radius`"),
                about: "The largest radius, at which it starts from rest. Where the case allows it, \
                        `initial_pressure` is then `\"rayleigh\"` by default.",
            },
            Key {
                name: "radius",
                unit: "m",
                values: Values::Positive,
                default: Preset::Words("one of `radius_max` and `radius`"),
                about: "The radius at the start, of a bubble that may grow first.",
            },
            Key {
                name: "equilibrium_radius",
                unit: "m",
                values: Values::Positive,
                default: Preset::Words("one of `equilibrium_radius` and `gas_pressure`"),
                about: "R_n: where the gas would be in equilibrium. At another radius it is on the isentrope from there.",
            },
            Key {
                name: "gas_pressure",
                unit: "Pa",
                values: Values::Positive,
                default: Preset::Words("one of `equilibrium_radius` and `gas_pressure`"),
                about: "Partial pressure of the gas at the start.",
            },
            Key {
                name: "vapour_pressure",
                unit: "Pa",
                values: Values::Words("≥ 0"),
                default: Preset::Number(0.0),
                about: "Partial pressure of the vapour, which is added. In the run it is gas like the rest.",
            },
            Key {
                name: "vapour_gamma",
                unit: "1",
                values: Values::Words("> 1"),
                default: Preset::Words("that of the gas"),
                about: "The vapour's adiabatic exponent. `fluid.gas.gamma` becomes that of the mixture.",
            },
            Key {
                name: "gas_density",
                unit: "kg/m3",
                values: Values::Positive,
                default: Preset::Words("that in equilibrium at `temperature`, brought to the start"),
                about: "Density of the gas at the start, without the vapour. Without it the gas has its heat capacity, else air's.",
            },
            Key {
                name: "temperature",
                unit: "K",
                values: Values::Positive,
                default: Preset::Number(TEMPERATURE),
                about: "Of the gas in equilibrium (with `gas_pressure`: at the start), and of the vapour.",
            },
            Key {
                name: "surface_tension",
                unit: "N/m",
                values: Values::Words("≥ 0"),
                default: Preset::Words("that of `fluid.terms`, else 0"),
                about: "σ in the equilibrium pressure p∞ + 2σ/R_n − p_v.",
            },
            Key {
                name: "region",
                unit: "1",
                values: Values::Whole(0, 1000),
                default: Preset::None,
                about: "Number of the `[[fluid.region]]` that is the bubble: a sphere of gas. What is in it stands there.",
            },
            Key {
                name: "cells_per_radius",
                unit: "1",
                values: Values::Within(CELLS),
                default: Preset::Words("none: the finest level everywhere"),
                about: "The grid follows the bubble: details ask for no finer level than the first one with as many cells along its \
                        *present* radius.",
            },
        ],
    },
    Section {
        path: "fluid.bubble.reset",
        repeated: false,
        title: "The cut of its gas",
        about: "The gas's mass is [cut][reset] once, when the bubble has grown and its volume is at its first maximum. The ledgers \
                count it.",
        keys: &[
            Key {
                name: "equilibrium_radius",
                unit: "m",
                values: Values::Positive,
                default: Preset::Words("one of `equilibrium_radius` and `gas_share`"),
                about: "R_n of the gas that is left. Vapour at `vapour_pressure` is added to it.",
            },
            Key {
                name: "gas_share",
                unit: "1",
                values: Values::Within(SHARE),
                default: Preset::Words("one of `equilibrium_radius` and `gas_share`"),
                about: "The share of its mass that is left.",
            },
        ],
    },
];
