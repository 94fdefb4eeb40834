//! `[solid]`: the domain, the material, and waves that are there at t = 0.

use super::declared::{Key, Preset, Section, Values};
use super::grid::{CELLS, LEVELS, LIMITER, R, WIDTH, Z, centre};

/// What stands at the moduli and speeds of a material.
const ONE_PAIR: Preset = Preset::Words("exactly one of the three pairs");

pub(super) static SOLID: [Section; 3] = [
    Section {
        path: "solid",
        repeated: false,
        title: "The solid",
        about: "",
        keys: &[
            Z,
            R,
            CELLS,
            LEVELS,
            Key {
                name: "material",
                unit: "",
                values: Values::Words("a name of `cav materials`, or a table"),
                default: Preset::Required,
                about: "What it is made of; as a table see `[solid.material]`.",
            },
            Key {
                name: "initial_stress",
                unit: "",
                values: Values::Names(&[
                    ("uniaxial", "σ_zz = −p, as in the paper: von Mises stress p at the start"),
                    ("hydrostatic", "σ = −p I"),
                ]),
                default: Preset::Name("uniaxial"),
                about: "The stress at t = 0. p is the fluid's ambient pressure, zero for a solid alone.",
            },
            Key {
                name: "initial",
                unit: "",
                values: Values::Words("directory of a finished run whose wall could yield"),
                default: Preset::Words("a fresh wall"),
                about: "The wall begins with the stress, plastic strain, temperature and displacement that stayed in that \
                        run, at rest: [many hits][hits]. `z`, `r`, `cells`, `gravity`, density and wave speeds are the \
                        same, `levels` at least as many; the laws may differ. It is not the run's own directory. A relative path counts \
                        from the working directory.",
            },
            LIMITER,
            Key {
                name: "gravity",
                unit: "m/s2",
                values: Values::Number,
                default: Preset::Number(0.0),
                about: "Its own weight along z; it may strain it by 1 % at most. The stress of the start is that on the \
                        surface, σ_zz = −p − ρg(z − z_max).",
            },
        ],
    },
    Section {
        path: "solid.material",
        repeated: false,
        title: "A material of your own",
        about: "Instead of a name. Of the three pairs of numbers exactly one is given.",
        keys: &[
            Key {
                name: "name",
                unit: "",
                values: Values::Words("any text"),
                default: Preset::Name("custom"),
                about: "What it is called.",
            },
            Key {
                name: "density",
                unit: "kg/m3",
                values: Values::Positive,
                default: Preset::Required,
                about: "Its density.",
            },
            Key {
                name: "c1",
                unit: "m/s",
                values: Values::Words("> √(4/3) c₂"),
                default: ONE_PAIR,
                about: "The speed of longitudinal waves, with `c2`.",
            },
            Key {
                name: "c2",
                unit: "m/s",
                values: Values::Positive,
                default: ONE_PAIR,
                about: "The speed of shear waves, with `c1`.",
            },
            Key {
                name: "young",
                unit: "Pa",
                values: Values::Positive,
                default: ONE_PAIR,
                about: "Young's modulus E, with `poisson`.",
            },
            Key {
                name: "poisson",
                unit: "1",
                values: Values::Words("(−1, 0.5)"),
                default: ONE_PAIR,
                about: "Poisson's ratio ν, with `young`.",
            },
            Key {
                name: "lambda",
                unit: "Pa",
                values: Values::Words("> −2/3 μ"),
                default: ONE_PAIR,
                about: "Lamé's first parameter λ, with `mu`.",
            },
            Key {
                name: "mu",
                unit: "Pa",
                values: Values::Positive,
                default: ONE_PAIR,
                about: "The shear modulus μ, with `lambda`.",
            },
            Key {
                name: "yield_strength",
                unit: "Pa",
                values: Values::Positive,
                default: Preset::Words("none: the material never yields"),
                about: "Where it begins to yield. By itself it only marks where that would be; to flow it needs \
                        `[solid.plasticity]`.",
            },
        ],
    },
    Section {
        path: "solid.pulse",
        repeated: true,
        title: "Waves in the solid",
        about: "A spherical P wave at rest: u = ∇(Φ exp(−R²/a²)), v = 0.",
        keys: &[
            centre("Its centre; in axisymmetric geometry on the axis."),
            WIDTH,
            Key {
                name: "amplitude",
                unit: "m2",
                values: Values::Number,
                default: Preset::Required,
                about: "The amplitude Φ of the displacement's potential.",
            },
        ],
    },
];
