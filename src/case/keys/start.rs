//! What fills the fluid at t = 0: `[fluid.ambient]`, regions, pulses and the tracer.

use super::declared::{Key, Preset, Section, Values};
use super::grid::WIDTH;

const PHASES: Values = Values::Names(&[("liquid", "as `[fluid.liquid]`"), ("gas", "as `[fluid.gas]`")]);

const DENSITY: Key = Key {
    name: "density",
    unit: "kg/m3",
    values: Values::Positive,
    default: Preset::Required,
    about: "Its density.",
};

const PRESSURE: Key = Key {
    name: "pressure",
    unit: "Pa",
    values: Values::Words("> −π of the phase"),
    default: Preset::Required,
    about: "Its pressure.",
};

const VELOCITY: Key = Key {
    name: "velocity",
    unit: "m/s",
    values: Values::Point,
    default: Preset::Words("`[0, 0]`"),
    about: "Its velocity.",
};

const SHAPE: Key = Key {
    name: "shape",
    unit: "",
    values: Values::Names(&[("sphere", "`centre` and `radius`"), ("box", "`z` and `r`")]),
    default: Preset::Required,
    about: "What it is.",
};

const CENTRE: Key = Key {
    name: "centre",
    unit: "m",
    values: Values::Point,
    default: Preset::Required,
    about: "Sphere: the centre, in the fluid; in axisymmetric geometry on the axis.",
};

const RADIUS: Key = Key {
    name: "radius",
    unit: "m",
    values: Values::Positive,
    default: Preset::Required,
    about: "Sphere: the radius. A boundary or the wall may cut the sphere.",
};

const BOX_Z: Key = Key {
    name: "z",
    unit: "m",
    values: Values::Range,
    default: Preset::Required,
    about: "Box: its range along z, overlapping the fluid.",
};

const BOX_R: Key = Key {
    name: "r",
    unit: "m",
    values: Values::Range,
    default: Preset::Required,
    about: "Box: its range along r, overlapping the fluid.",
};

pub(super) static START: [Section; 4] = [
    Section {
        path: "fluid.ambient",
        repeated: false,
        title: "What fills the fluid",
        about: "Required.",
        keys: &[
            Key {
                name: "phase",
                unit: "",
                values: PHASES,
                default: Preset::Name("liquid"),
                about: "Which of the two it is.",
            },
            DENSITY,
            PRESSURE,
            VELOCITY,
        ],
    },
    Section {
        path: "fluid.region",
        repeated: true,
        title: "Bubbles and other regions",
        about: "Painted over the ambient state, in order.",
        keys: &[
            SHAPE,
            CENTRE,
            RADIUS,
            BOX_Z,
            BOX_R,
            Key {
                name: "phase",
                unit: "",
                values: PHASES,
                default: Preset::Required,
                about: "Which of the two it is.",
            },
            DENSITY,
            PRESSURE,
            VELOCITY,
        ],
    },
    Section {
        path: "fluid.pulse",
        repeated: true,
        title: "Pressure pulses in the liquid",
        about: "Added last, to the liquid alone: p' = A exp(−d²/a²), with the density along the isentrope.",
        keys: &[
            Key {
                name: "shape",
                unit: "",
                values: Values::Names(&[
                    ("sphere", "d is the distance to the centre"),
                    ("plane", "d is that along z, or along `direction`"),
                ]),
                default: Preset::Required,
                about: "What it is.",
            },
            Key {
                name: "centre",
                unit: "m",
                values: Values::Words("`[z, r]`; for a plane also z alone"),
                default: Preset::Required,
                about: "The middle of the pulse. In axisymmetric geometry a sphere is on the axis.",
            },
            WIDTH,
            Key {
                name: "amplitude",
                unit: "Pa",
                values: Values::Number,
                default: Preset::Required,
                about: "Its amplitude A, of either sign; p + π > 0 at the centre.",
            },
            Key {
                name: "direction",
                unit: "1",
                values: Values::Point,
                default: Preset::Words("none: it begins at rest"),
                about: "Plane: where the pulse travels to, with v = p'/(ρc). It is taken at length one; in axisymmetric \
                        geometry it is along z.",
            },
        ],
    },
    Section {
        path: "fluid.tracer",
        repeated: false,
        title: "A passive tracer",
        about: "Where its mass fraction is 1 at t = 0; elsewhere it is 0. It is carried by the mass, gas or liquid, and \
                does nothing to the flow. What comes in through an open side has the fraction of the cell inside. It is the \
                field `tracer` of snapshots; `summary.json` has `tracer_mass`.",
        keys: &[SHAPE, CENTRE, RADIUS, BOX_Z, BOX_R],
    },
];
