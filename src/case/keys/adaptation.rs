//! How the grids adapt: thresholds in `[fluid]` and `[solid]`, `[fluid.near_wall]` and the zones of `[[....refine]]`.

use super::declared::{Interval, Key, Preset, Section, Values};
use super::grid::{MOST_LEVELS, centre};

/// Steps between two adaptations where a case does not say.
pub const DEFAULT_ADAPT_EVERY: usize = 8;
/// More steps than this between two adaptations are a mistake.
const MOST_STEPS: usize = 1000;
/// Levels above `levels` at most: each halves the cells, and the steps with them.
pub(in crate::case) const MOST_ABOVE: usize = 6;
/// Cells that a film has across where a case does not say.
pub(in crate::case) const FILM_CELLS: usize = 8;

const ADAPT: Key = Key {
    name: "adapt",
    unit: "",
    values: Values::Flag,
    default: Preset::Flag(true),
    about: "Whether the grid adapts. With `false` all of it is on the finest level, and thresholds have no effect.",
};

const ERROR: Key = Key {
    name: "error",
    unit: "1",
    values: Values::Within(Interval::open(0.0, 1.0)),
    default: Preset::Words(
        "by the waves that the case prescribes: 0.0001 (20 *h*/*a*)², from 10⁻⁷ to 10⁻³; for all else 0.01",
    ),
    about: "What adaptation may add to the waves, relative to their amplitude. It sets the thresholds, see \
            [the rule][thresholds]. In the default *h* is the side's finest cell, and *a* the narrowest pulse's `width` \
            or the load's `radius`.",
};

const ADAPT_EVERY: Key = Key {
    name: "adapt_every",
    unit: "1",
    values: Values::Whole(1, MOST_STEPS),
    default: Preset::Whole(DEFAULT_ADAPT_EVERY),
    about: "Steps between two adaptations.",
};

/// What holds for the keys of adaptation of either side.
const ADAPTATION: &str = "The grid consists of blocks of 16 × 16 cells. The coarsest level that blocks can have is the first whose cells fill whole \
     blocks in both directions: with `cells = [16, 16]` level 0, with `cells = [4, 4]` level 2. `cav check` names it, \
     and the thresholds. Each side has its own keys.";

const ZONES: &str = "Bounds of the level within a zone; several of them hold together. A level below that of the coarsest blocks means theirs. \
     [`--refine`][refine] moves these levels with the finest one. All blocks along the interface on the finest level, \
     as the paper has it:\n\n    [[fluid.refine]]\n    shape = \"interface\"\n    at_least = 9\n\nAn outer region that \
     costs little:\n\n    [[fluid.refine]]\n    shape = \"outer\"\n    centre = [0.02, 0.0]\n    radius = 0.03";

static ZONE: [Key; 8] = [
    Key {
        name: "shape",
        unit: "",
        values: Values::Names(&[
            ("sphere", "blocks within or outside a sphere"),
            ("box", "blocks that meet a box"),
            ("interface", "blocks along the interface or the rigid wall"),
            (
                "outer",
                "beyond `radius` blocks are one level coarser than the finest at most, beyond twice the radius two, and so on",
            ),
        ]),
        default: Preset::Required,
        about: "What the zone is. `\"outer\"` takes neither `at_least` nor `at_most`; waves that are too short for its \
                cells fade there.",
    },
    centre("Sphere and outer: the centre."),
    Key {
        name: "radius",
        unit: "m",
        values: Values::Positive,
        default: Preset::Required,
        about: "Sphere and outer: the radius.",
    },
    Key {
        name: "where",
        unit: "",
        values: Values::Names(&[("inside", "all blocks that meet it"), ("outside", "blocks wholly outside")]),
        default: Preset::Name("inside"),
        about: "Sphere: on which side of it the zone lies.",
    },
    Key {
        name: "z",
        unit: "m",
        values: Values::Range,
        default: Preset::Required,
        about: "Box: its range along z.",
    },
    Key {
        name: "r",
        unit: "m",
        values: Values::Range,
        default: Preset::Required,
        about: "Box: its range along r.",
    },
    Key {
        name: "at_least",
        unit: "1",
        values: Values::Whole(0, MOST_LEVELS),
        default: Preset::Words("at least one of the two"),
        about: "No coarser than this level there; at most `levels`.",
    },
    Key {
        name: "at_most",
        unit: "1",
        values: Values::Whole(0, MOST_LEVELS),
        default: Preset::Words("at least one of the two"),
        about: "No finer than this level there, but for what a gradual change of level needs; from `at_least` to `levels`.",
    },
];

const fn threshold(default: Preset, about: &'static str) -> Key {
    Key { name: "epsilon", unit: "1", values: Values::Within(Interval::open(0.0, 1.0)), default, about }
}

pub(super) static ADAPTATION_OF_FLUID: [Section; 3] = [
    Section {
        path: "fluid",
        repeated: false,
        title: "Adaptation of the fluid's grid",
        about: ADAPTATION,
        keys: &[
            ADAPT,
            ERROR,
            threshold(
                Preset::Words("3/100 of `error`"),
                "The threshold of details on the finest level, relative to the scales below; half of it on the \
                        next coarser one, and so on. Instead of `error`.",
            ),
            Key {
                name: "epsilon_waves",
                unit: "1",
                values: Values::Within(Interval::open(0.0, 1.0)),
                default: Preset::Words(
                    "`epsilon` where that is given; else 1/100 of `error`, times the weakest prescribed wave's share of \
                     the scale (at least 1/100)",
                ),
                about: "The same threshold for pressure and velocity alone. Instead of `error`.",
            },
            ADAPT_EVERY,
            Key {
                name: "scale_pressure",
                unit: "Pa",
                values: Values::Positive,
                default: Preset::Words(
                    "the largest of |p − p ambient| over regions, pulses and inflow, and of ρc|v − v ambient| over \
                     regions; if all are 0 the ambient pressure",
                ),
                about: "What differences of pressure are measured by. In the default ρ and c are the ambient's.",
            },
            Key {
                name: "scale_density",
                unit: "kg/m3",
                values: Values::Positive,
                default: Preset::Words(
                    "the largest difference of a region's density to the ambient's; if there is none \
                     `scale_pressure`/c²",
                ),
                about: "What differences of density are measured by.",
            },
        ],
    },
    Section {
        path: "fluid.near_wall",
        repeated: false,
        title: "More levels next to the wall",
        about: "What they do, what they cost and what they are worth: [next to the wall][film]. With \
                `time.local_steps = false` all cells make the steps of the finest while there are such. Two levels then \
                cost four times as many steps as long as shocks run along the wall.",
        keys: &[
            Key {
                name: "shock_levels",
                unit: "1",
                values: Values::Whole(0, MOST_ABOVE),
                default: Preset::Words("2 with `time.local_steps = true`, else 0"),
                about: "How many levels above `levels` blocks on the wall rise where a shock is about to hit it.",
            },
            Key {
                name: "film_levels",
                unit: "1",
                values: Values::Whole(0, MOST_ABOVE),
                default: Preset::Whole(0),
                about: "The same where the film of liquid between gas and wall has fewer than `film_cells` cells across.",
            },
            Key {
                name: "film_cells",
                unit: "1",
                values: Values::Whole(2, mesh::BLOCK),
                default: Preset::Whole(FILM_CELLS),
                about: "Cells that a film is to have across.",
            },
        ],
    },
    Section {
        path: "fluid.refine",
        repeated: true,
        title: "Levels of zones of the fluid",
        about: ZONES,
        keys: &ZONE,
    },
];

pub(super) static ADAPTATION_OF_SOLID: [Section; 2] = [
    Section {
        path: "solid",
        repeated: false,
        title: "Adaptation of the solid's grid",
        about: ADAPTATION,
        keys: &[
            ADAPT,
            ERROR,
            threshold(
                Preset::Words("that of waves, from `error`"),
                "The threshold of details on the finest level, relative to the scale below; half of it on the next \
                        coarser one, and so on. Instead of `error`.",
            ),
            ADAPT_EVERY,
            Key {
                name: "scale_stress",
                unit: "Pa",
                values: Values::Positive,
                default: Preset::Words(
                    "under a fluid its `scale_pressure`; else the largest pressure of a load and 2 (λ + 2μ) |Φ|/a² of the \
                     pulses; else 10⁶",
                ),
                about: "What differences of stress are measured by.",
            },
        ],
    },
    Section {
        path: "solid.refine",
        repeated: true,
        title: "Levels of zones of the solid",
        about: "As `[[fluid.refine]]`.",
        keys: &ZONE,
    },
];

pub(super) static REGION_OF_INTEREST: [Section; 1] = [Section {
    path: "region_of_interest",
    repeated: false,
    title: "The region of interest",
    about: "A circle around what the run is made for. Within it the grids adapt as ever; outside of it waves keep fine cells \
            only if they [run towards it][interest]. Load, stresses and pit stay; a sixth to a half of the cell updates goes. Pictures \
            of waves that run away lose their details, and so do probes and sensors outside. Absent: all waves count \
            everywhere.",
    keys: &[
        Key {
            name: "radius",
            unit: "m",
            values: Values::Positive,
            default: Preset::Required,
            about: "Its radius: as far as anything is to be believed.",
        },
        Key {
            name: "centre",
            unit: "m",
            values: Values::Point,
            default: Preset::Words("where the wall meets the axis"),
            about: "Its centre, (z, r).",
        },
    ],
}];
