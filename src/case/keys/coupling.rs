//! `[coupling]` and `[coupling.load]`.

use super::declared::{Interval, Key, Preset, Section, Values};

/// The most steps that one side makes within one of the other.
pub(in crate::case) const MOST_STEPS_IN_ONE: usize = 16;
/// When the strong scheme's iteration ends.
pub(in crate::case) const TOLERANCE: f64 = 1e-6;
/// Its most iterations a step.
pub(in crate::case) const ITERATIONS: usize = 100;
/// How long a side waits for the other to appear, s.
pub(in crate::case) const CONNECT_TIMEOUT: f64 = 30.0;
/// How long a side waits for the other within a step, s.
pub(in crate::case) const PATIENCE: f64 = 600.0;
/// How long a side may be told to wait for the other, s: from a millisecond to thirty years.
const WAITING: Interval = Interval::closed(1e-3, 1e9);

pub(super) static COUPLING: [Section; 2] = [
    Section {
        path: "coupling",
        repeated: false,
        title: "How fluid and solid meet",
        about: "",
        keys: &[
            Key {
                name: "scheme",
                unit: "",
                values: Values::Names(&[
                    ("riemann", "the Riemann problem between the media"),
                    ("explicit", "[the paper's][paper-schemes]: cell values of the old time cross both ways"),
                    ("weak", "the paper's: the sides take turns"),
                    ("strong", "the paper's: turns are repeated until the values agree"),
                    ("external", "the other side is [another program's][participants]"),
                    ("rigid", "a fluid above a rigid wall; a `[solid]` is ignored"),
                    ("load", "a given pressure on a solid alone"),
                    ("none", "one medium alone"),
                ]),
                default: Preset::Name("riemann"),
                about: "What happens between the two.",
            },
            Key {
                name: "star",
                unit: "",
                values: Values::Names(&[
                    ("exact", "shock or isentrope of the liquid"),
                    ("acoustic", "its tangent"),
                ]),
                default: Preset::Name("exact"),
                about: "How the fluid answers in the Riemann problem between the media.",
            },
            Key {
                name: "kappa",
                unit: "",
                values: Values::Names(&[
                    ("off", "κ = 1"),
                    ("printed", "on the received value, as printed"),
                    ("jump", "on the jump across the interface"),
                ]),
                default: Preset::Name("off"),
                about: "The paper's factors κ; only with `scheme = \"weak\"`.",
            },
            Key {
                name: "step_ratio",
                unit: "1",
                values: Values::Whole(1, MOST_STEPS_IN_ONE),
                default: Preset::Words("16; with the paper's schemes 1"),
                about: "The most steps that one side makes [within one of the other][steps].",
            },
            Key {
                name: "first",
                unit: "",
                values: Values::Names(&[("fluid", "the fluid"), ("solid", "the solid")]),
                default: Preset::Name("fluid"),
                about: "Who makes the step first; only with `scheme = \"weak\"` or `\"strong\"`.",
            },
            Key {
                name: "tolerance",
                unit: "1",
                values: Values::Within(Interval::open(0.0, 1.0)),
                default: Preset::Number(TOLERANCE),
                about: "When the iteration of `scheme = \"strong\"` [ends][paper-schemes]; only there.",
            },
            Key {
                name: "max_iterations",
                unit: "1",
                values: Values::Whole(1, 10_000),
                default: Preset::Whole(ITERATIONS),
                about: "The most iterations a step; only with `scheme = \"strong\"`.",
            },
            Key {
                name: "connect_timeout",
                unit: "s",
                values: Values::Within(WAITING),
                default: Preset::Number(CONNECT_TIMEOUT),
                about: "How long a side waits for the other to appear.",
            },
            Key {
                name: "patience",
                unit: "s",
                values: Values::Within(WAITING),
                default: Preset::Number(PATIENCE),
                about: "How long a side waits for the other within a step.",
            },
        ],
    },
    Section {
        path: "coupling.load",
        repeated: false,
        title: "A load on a solid alone",
        about: "Required with `scheme = \"load\"`, and only there. Either the pressure A exp(−r²/b²) f(t) on the solid's \
                `z_max`, σ_zz = −pressure, without shear; the solid begins without stress. Or what the wall of another run \
                got.",
        keys: &[
            Key {
                name: "amplitude",
                unit: "Pa",
                values: Values::Number,
                default: Preset::Words("required without `run`"),
                about: "A, of either sign.",
            },
            Key {
                name: "radius",
                unit: "m",
                values: Values::Positive,
                default: Preset::Words("required without `run`"),
                about: "b.",
            },
            Key {
                name: "history",
                unit: "s and 1",
                values: Values::Words("`[[t, factor], ...]`, times ascending"),
                default: Preset::Words("required without `run`"),
                about: "f: linear in between, constant before and after.",
            },
            Key {
                name: "run",
                unit: "",
                values: Values::Words("directory of a finished run with `/interface`"),
                default: Preset::None,
                about: "Its pressure over r and t acts; beyond its radius the ambient pressure, after its end the last one. \
                        The solid begins with that run's pressure at t = 0. Between two rows it is a parabola with the \
                        impulse that was recorded: none is lost if `output.interface_every` was long. Short peaks need short \
                        intervals. A relative path counts from the working directory.",
            },
        ],
    },
];
