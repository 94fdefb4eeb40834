//! `[solid.plasticity]`.

use super::declared::{Interval, Key, Preset, Section, Values};

pub(super) static PLASTICITY: [Section; 1] = [Section {
    path: "solid.plasticity",
    repeated: false,
    title: "How the solid yields",
    about: "Without it the solid is elastic. J2 flow of small strains with isotropic hardening, see \
            [plastic flow][plasticity]. A material of the library that has constants of the Johnson–Cook law \
            (`cav materials`) brings those that are not given. For such a material `law = \"johnson-cook\"` alone will do. \
            Constants without a say in the law are refused.",
    keys: &[
        Key {
            name: "law",
            unit: "",
            values: Values::Names(&[
                ("perfect", "Y = A"),
                ("linear", "A + H ε_p"),
                ("johnson-cook", "(A + B ε_pⁿ)(1 + C ln max(1, ε̇/ε̇₀))(1 − T*ᵐ)"),
                ("table", "`table`, with C and ε̇₀ a rate's factor"),
            ]),
            default: Preset::Required,
            about: "The yield stress Y over plastic strain ε_p, rate ε̇ and temperature.",
        },
        Key {
            name: "yield_strength",
            unit: "Pa",
            values: Values::Positive,
            default: Preset::Words("the library's A for `\"johnson-cook\"`, else the material's"),
            about: "A.",
        },
        Key {
            name: "hardening_modulus",
            unit: "Pa",
            values: Values::Words("≥ 0"),
            default: Preset::Words("required; B the library's"),
            about: "H, or B of Johnson–Cook.",
        },
        Key {
            name: "hardening_exponent",
            unit: "1",
            values: Values::Within(Interval::above(0.0, 1.0)),
            default: Preset::Words("required; the library's"),
            about: "n.",
        },
        Key {
            name: "rate_coefficient",
            unit: "1",
            values: Values::Words("≥ 0"),
            default: Preset::Words("the library's; else no rate"),
            about: "C.",
        },
        Key {
            name: "reference_rate",
            unit: "1/s",
            values: Values::Positive,
            default: Preset::Words("required with C; the library's"),
            about: "The rate ε̇₀ at which A was measured.",
        },
        Key {
            name: "softening_exponent",
            unit: "1",
            values: Values::Positive,
            default: Preset::Words("the library's; else no softening, and no temperature"),
            about: "m.",
        },
        Key {
            name: "melting_temperature",
            unit: "K",
            values: Values::Words("above `reference_temperature`"),
            default: Preset::Words("required with m; the library's"),
            about: "Where the strength has gone.",
        },
        Key {
            name: "reference_temperature",
            unit: "K",
            values: Values::Words("≥ 0"),
            default: Preset::Words("required with m; the library's"),
            about: "The temperature at which A was measured; the run begins at it.",
        },
        Key {
            name: "heat_capacity",
            unit: "J/(kg K)",
            values: Values::Positive,
            default: Preset::Words("required with m; the library's"),
            about: "c_p.",
        },
        Key {
            name: "taylor_quinney",
            unit: "1",
            values: Values::Within(Interval::closed(0.0, 1.0)),
            default: Preset::Words("required with m; the library's, 0.9"),
            about: "χ: the share of the plastic work that heats.",
        },
        Key {
            name: "table",
            unit: "1 and Pa",
            values: Values::Words("`[[ε_p, Y], ...]`"),
            default: Preset::Words("required with `law = \"table\"`"),
            about: "ε_p ≥ 0 increasing, Y > 0 not falling; straight between points, constant beyond.",
        },
    ],
}];
