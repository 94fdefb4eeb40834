//! The sides of the domains: `[fluid.boundary]`, `[fluid.inflow]` and `[solid.boundary]`.

use super::declared::{Key, Preset, Section, Values};

const OF_FLUID: Values = Values::Names(&[
    ("wall", "rigid; a fluid with viscosity sticks to it, others slip along it"),
    ("symmetry", "a plane of symmetry, which all fluids slip along"),
    (
        "non-reflecting",
        "the incoming characteristic is held at the initial state: right for waves, and it holds the flow to a bubble up",
    ),
    ("far-field", "waves leave, and liquid flows to the bubbles and back as in unbounded liquid"),
    ("inflow", "the pressure of `[fluid.inflow]` enters as a plane wave, isentropic"),
    ("periodic", "the opposite side, which is periodic too"),
]);

const OF_SOLID: Values = Values::Names(&[
    (
        "absorbing",
        "waves leave, oblique ones and those along the surface too, and a load that stays is borne",
    ),
    (
        "non-reflecting",
        "incoming characteristics are held at the initial state: right for waves at a right angle, some per cent of others \
         come back",
    ),
    ("free", "no traction"),
    ("fixed", "no velocity"),
    ("symmetry", "no normal velocity, no shear"),
    ("periodic", "the opposite side, which is periodic too"),
]);

/// What an open side of the fluid is by itself.
const OPEN: Preset = Preset::Words("`\"far-field\"` where there is one, else `\"non-reflecting\"`");

pub(super) static SIDES_OF_FLUID: [Section; 2] = [
    Section {
        path: "fluid.boundary",
        repeated: false,
        title: "The sides of the fluid",
        about: "A side that cannot be chosen may be named as what it is: `\"axis\"`, `\"interface\"`, the rigid \
                `\"wall\"`.\n\nThere is a [far field][far-field] in axial symmetry about gas in ambient liquid, if `r_max` is \
                open and not both of `z_min` and `z_max` are walls. The gas is in spheres, or in boxes that begin at \
                r = 0. `cav check` names the sides, and warns where one is [too near][far-sides]: four radii are enough for \
                a far field. With gravity there is none.",
        keys: &[
            Key {
                name: "z_min",
                unit: "",
                values: OF_FLUID,
                default: OPEN,
                about: "Chosen only with `scheme = \"none\"`. Else it is the interface, or the wall of \
                        `scheme = \"rigid\"`.",
            },
            Key {
                name: "z_max",
                unit: "",
                values: OF_FLUID,
                default: OPEN,
                about: "The side opposite the wall.",
            },
            Key {
                name: "r_min",
                unit: "",
                values: OF_FLUID,
                default: Preset::Name("wall"),
                about: "Chosen only in planar geometry. Else it is the axis.",
            },
            Key {
                name: "r_max",
                unit: "",
                values: OF_FLUID,
                default: OPEN,
                about: "The side far from the axis.",
            },
        ],
    },
    Section {
        path: "fluid.inflow",
        repeated: false,
        title: "What comes in",
        about: "Required where a side is an `\"inflow\"`, and only there.",
        keys: &[Key {
            name: "pressure",
            unit: "s and Pa",
            values: Values::Words("`[[t, p], ...]`, times ascending"),
            default: Preset::Required,
            about: "The pressure over time: linear in between, constant before and after.",
        }],
    },
];

pub(super) static SIDES_OF_SOLID: [Section; 1] = [Section {
    path: "solid.boundary",
    repeated: false,
    title: "The sides of the solid",
    about: "A pre-stress stays under both kinds of open sides; [what absorbing ones do][absorbing]. A side that cannot be \
            chosen may be named as what it is.",
    keys: &[
        Key {
            name: "z_min",
            unit: "",
            values: OF_SOLID,
            default: Preset::Name("absorbing"),
            about: "The side deep in the solid.",
        },
        Key {
            name: "z_max",
            unit: "",
            values: OF_SOLID,
            default: Preset::Name("free"),
            about: "Chosen only with `scheme = \"none\"`. Else it is the interface, or the surface under the load.",
        },
        Key {
            name: "r_min",
            unit: "",
            values: OF_SOLID,
            default: Preset::Name("symmetry"),
            about: "Chosen only in planar geometry. Else it is the axis.",
        },
        Key {
            name: "r_max",
            unit: "",
            values: OF_SOLID,
            default: Preset::Name("absorbing"),
            about: "The side far from the axis.",
        },
    ],
}];
