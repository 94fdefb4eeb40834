//! `[fluid.terms]`: evaporation, condensation, cavitation.

use super::declared::{Interval, Key, Preset, Section, Values};

pub(super) static PHASE_CHANGE: [Section; 2] = [
    Section {
        path: "fluid.terms.phase_change",
        repeated: false,
        title: "Evaporation and condensation",
        about: "As `phase_change = { law = \"ptg\" }` in `[fluid.terms]`: liquid and its vapour change into each other where they \
                meet. See [its theory and limits][phase-change]. Both phases need heat capacities and reference energies, as \
                `fluid = \"water-nasg\"` and `fluid = \"water-vapour\"` have them; not with `model = \"saurel-abgrall\"`. The vapour is \
                the field `vapour` of snapshots; `summary.json` has `vapour_mass`, `evaporated_mass` and `condensed_mass`.",
        keys: &[
            Key {
                name: "law",
                unit: "",
                values: Values::Names(&[
                    ("hertz-knudsen", "at the rate of the kinetic theory of gases"),
                    ("ptg", "at once, to one pressure, temperature and Gibbs energy"),
                ]),
                default: Preset::Required,
                about: "How fast cells that hold both phases come to equilibrium.",
            },
            Key {
                name: "accommodation",
                unit: "",
                values: Values::Within(Interval::above(0.0, 1.0)),
                default: Preset::Words("required with `\"hertz-knudsen\"`"),
                about: "The part of the molecules that stick to the liquid; for water 0.04 to 1.",
            },
            Key {
                name: "vapour_fraction",
                unit: "",
                values: Values::Within(Interval::closed(0.0, 1.0)),
                default: Preset::Words("that of `[fluid.bubble]`, 1 without"),
                about: "The part of the gas's mass that is vapour at t = 0; the rest never condenses. A bubble that is described by its content has \
                        `vapour_pressure` over all of its pressure.",
            },
        ],
    },
    Section {
        path: "fluid.terms.cavitation",
        repeated: false,
        title: "Cavitation",
        about: "As `cavitation = { threshold = -1e6 }` in `[fluid.terms]`, beside a `phase_change`: liquid below the threshold opens. \
                Without it liquid bears any tension. `summary.json` has `cavitated_mass` and `cavitated_cell_steps`.",
        keys: &[Key {
            name: "threshold",
            unit: "Pa",
            values: Values::Words("< 0"),
            default: Preset::Required,
            about: "The pressure below which a cell of liquid comes to equilibrium with vapour of its own.",
        }],
    },
];
