//! The top of a case file, and `[time]`.

use super::declared::{Interval, Key, Preset, Section, Values};
use crate::case::LocalSteps;

/// The time step's share of what stability allows.
pub(in crate::case) const CFL: f64 = 0.45;

pub(super) static TIME: [Section; 2] = [
    Section {
        path: "",
        repeated: false,
        title: "Top level",
        about: "",
        keys: &[Key {
            name: "geometry",
            unit: "",
            values: Values::Names(&[
                ("axisymmetric", "rotation about r = 0"),
                ("planar", "plane strain, per metre of depth"),
            ]),
            default: Preset::Name("axisymmetric"),
            about: "What the plane of z and r stands for.",
        }],
    },
    Section {
        path: "time",
        repeated: false,
        title: "Time",
        about: "Required. Fields are always written at t = 0 and at the end.",
        keys: &[
            Key {
                name: "end",
                unit: "s",
                values: Values::Words("> 0, or `\"settled\"`"),
                default: Preset::Required,
                about: "When the run ends, after at most 10⁹ steps of the length of the first. `\"settled\"` is for \
                        `scheme = \"load\"`: the run ends when the load has changed for the last time and the \
                        [surface is still][surface].",
            },
            Key {
                name: "longest",
                unit: "s",
                values: Values::Positive,
                default: Preset::Words("required with `end = \"settled\"`"),
                about: "Only with `end = \"settled\"`: when the run ends at the latest. Intervals and snapshots are \
                        measured by it then.",
            },
            Key {
                name: "cfl",
                unit: "1",
                values: Values::Within(Interval::above(0.0, 0.9)),
                default: Preset::Number(CFL),
                about: "The Courant number. The step is `cfl` times the smallest of h_z/(|v_z| + c) and \
                        h_r/(|v_r| + c) in the fluid, and of h/c₁ in the solid. The two directions' numbers never add \
                        up to more than one, so with square cells 0.5 at most comes of it. Where one step is divided \
                        into several, of a finer level or of the other side, these may be 5 % longer.",
            },
            Key {
                name: "local_steps",
                unit: "",
                values: Values::Words("`\"auto\"`, `true`, `false`"),
                default: Preset::Name(LocalSteps::AUTO),
                about: "Whether coarse levels make [longer steps than fine ones][levels]. `\"auto\"`: where that saves \
                        work, decided before each step. `true`: always, with [two more levels next to the wall][film].",
            },
            Key {
                name: "snapshots",
                unit: "s",
                values: Values::Words("`[t, ...]`, within 0 and `end`"),
                default: Preset::None,
                about: "When fields are written.",
            },
            Key {
                name: "snapshot_every",
                unit: "s",
                values: Values::Positive,
                default: Preset::None,
                about: "The interval between snapshots, instead of `snapshots`; at most 10⁵ of them.",
            },
        ],
    },
];
