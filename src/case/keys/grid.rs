//! Keys that stand in several tables: the domain and its cells, centres and widths.

use super::declared::{Key, Preset, Values};

/// More cells than this along one direction are a mistake.
pub(in crate::case) const MOST_CELLS: usize = 1 << 20;
/// More levels than this are a mistake.
pub(in crate::case) const MOST_LEVELS: usize = 20;

pub(super) const Z: Key = Key {
    name: "z",
    unit: "m",
    values: Values::Range,
    default: Preset::Required,
    about: "The domain along z. The solid ends where the fluid begins.",
};

pub(super) const R: Key = Key {
    name: "r",
    unit: "m",
    values: Values::Range,
    default: Preset::Required,
    about: "The domain along r, the same of fluid and solid. In axisymmetric geometry it starts at 0.",
};

pub(super) const CELLS: Key = Key {
    name: "cells",
    unit: "1",
    values: Values::Cells(1, MOST_CELLS),
    default: Preset::Required,
    about: "Cells along z and r on the coarsest level.",
};

pub(super) const LEVELS: Key = Key {
    name: "levels",
    unit: "1",
    values: Values::Whole(0, MOST_LEVELS),
    default: Preset::Whole(0),
    about: "How often the coarsest cells are halved. The finest grid has `cells` · 2^`levels` cells, a multiple of 16.",
};

pub(super) const LIMITER: Key = Key {
    name: "limiter",
    unit: "",
    values: Values::Names(&[
        ("mc", "monotonised central, second order and TVD"),
        ("minmod", "the smaller difference; with THINC φ keeps MC's slopes"),
        ("eno", "the smaller difference whatever the signs, as printed in the paper; not TVD"),
        ("none", "the central difference, for smooth solutions"),
    ]),
    default: Preset::Name("mc"),
    about: "The limiter of the linear reconstruction.",
};

/// The centre of something that has to be somewhere.
pub(super) const fn centre(about: &'static str) -> Key {
    Key { name: "centre", unit: "m", values: Values::Point, default: Preset::Required, about }
}

/// Of a pulse exp(−d²/a²).
pub(super) const WIDTH: Key = Key {
    name: "width",
    unit: "m",
    values: Values::Positive,
    default: Preset::Required,
    about: "Its width a.",
};
