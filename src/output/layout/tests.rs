//! Layouts of types, told apart.

use super::*;
use serde::Deserialize;
use std::time::Duration;

/// The same type but for one thing each.
mod changed {
    use serde::Deserialize;

    macro_rules! state {
        ($module:ident: $inner:ident, $name:ident, $time:ident: $number:ty, $kind:ident, $other:ident $(, $more:ident)?) => {
            pub mod $module {
                use super::Deserialize;

                #[derive(Deserialize)]
                pub enum Phase {
                    $kind,
                    $other(f64),
                }

                #[derive(Deserialize)]
                pub struct $inner {
                    pub $time: $number,
                    pub phase: Phase,
                    $(pub $more: f64,)?
                }

                #[derive(Deserialize)]
                pub struct State {
                    pub $name: Option<Vec<$inner>>,
                    pub steps: u64,
                }
            }
        };
    }
    state!(original: Cell, cells, time: f64, Liquid, Gas);
    state!(again: Cell, cells, time: f64, Liquid, Gas);
    state!(type_of_field: Cell, cells, time: f32, Liquid, Gas);
    state!(signed: Cell, cells, time: i64, Liquid, Gas);
    state!(name_of_field: Cell, cells, pressure: f64, Liquid, Gas);
    state!(name_of_list: Cell, blocks, time: f64, Liquid, Gas);
    state!(name_of_type: Block, cells, time: f64, Liquid, Gas);
    state!(name_of_variant: Cell, cells, time: f64, Liquid, Vapour);
    state!(order_of_variants: Cell, cells, time: f64, Gas, Liquid);
    state!(one_more: Cell, cells, time: f64, Liquid, Gas, energy);
}

#[test]
fn the_layout_changes_with_any_name_or_type_within_and_with_nothing_else() {
    let original = layout::<changed::original::State>();
    assert_eq!(original, layout::<changed::again::State>());
    for (what, other) in [
        ("the type of a field", layout::<changed::type_of_field::State>()),
        ("the type of a field", layout::<changed::signed::State>()),
        ("the name of a field", layout::<changed::name_of_field::State>()),
        ("the name of a list", layout::<changed::name_of_list::State>()),
        ("the name of a type", layout::<changed::name_of_type::State>()),
        ("the name of a variant", layout::<changed::name_of_variant::State>()),
        ("the order of variants", layout::<changed::order_of_variants::State>()),
        ("one more field", layout::<changed::one_more::State>()),
    ] {
        assert_ne!(original, other, "{what}");
    }
}

#[test]
fn everything_within_is_asked_for() {
    #[derive(Deserialize)]
    enum Inner {
        Named { depth: [f32; 2] },
        Tuple(u8, Option<i16>),
    }
    #[derive(Deserialize)]
    enum Outer {
        Empty,
        Holds(Inner),
    }
    #[derive(Deserialize)]
    struct Unit;
    #[derive(Deserialize)]
    struct Wrapped(char, Unit);
    type All = (Outer, BTreeMap<String, Duration>, Wrapped, Vec<()>, bool, u128);
    let text = description::<All>();
    for part in [
        "Outer[Empty|Holds]( 0:",
        "1:Inner[Named|Tuple]( 0:depth:tuple( f32 f32 )",
        "1:u8 option( i16 )",
        "map( string Duration( secs:u64 nanos:u32 ) )",
        "Wrapped( char Unit )",
        "seq( unit )",
        "bool u128",
    ] {
        assert!(text.contains(part), "{part} in {text}");
    }
    assert!(!text.contains("refused"), "{text}");
}

#[test]
fn a_type_that_holds_itself_comes_to_an_end() {
    #[derive(Deserialize)]
    struct Endless {
        next: Option<Box<Endless>>,
    }
    assert!(description::<Endless>().contains("holds itself"));
}
