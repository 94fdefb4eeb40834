//! Equations of state in case files.

use fluid::{ConductingWall, WallHeat};

use crate::good_cases::round_trip;
use crate::{good, with};

#[test]
fn a_fluid_of_the_library_is_its_constants_and_what_the_case_says_besides() {
    let named = with(&["fluid.liquid={fluid = \"water-nasg\", gamma = 1.2}"]);
    round_trip(&named);
    let (liquid, library) =
        (named.fluid.expect("a fluid").liquid, fluid::NamedFluid::of("water-nasg").expect("it is there").law);
    assert_eq!(liquid, fluid::NobleAbelStiffenedGas { gamma: 1.2, ..library });
    // The default gas has no heat, and what has no covolume does not speak of it.
    assert_eq!(good().fluid.expect("a fluid").gas.heat, None);
    assert!(!good().effective_toml().contains("covolume"));
}

#[test]
fn phase_change_survives_being_written_out() {
    let media = ["fluid.liquid={fluid = \"water-nasg\"}", "fluid.gas={fluid = \"water-vapour\"}"];
    let terms = |law: &str| format!("fluid.terms={{phase_change={{{law}}}, cavitation={{threshold=-1e6}}}}");
    for law in ["law=\"ptg\"", "law=\"hertz-knudsen\", accommodation=0.04, vapour_fraction=0.3"] {
        let case = with(&[media[0], media[1], &terms(law)]);
        round_trip(&case);
        let change = case.fluid.and_then(|fluid| fluid.terms.phase_change).expect("it is asked for");
        assert_eq!(change.cavitation, Some(-1e6));
        assert_eq!(change.vapour_fraction, if law.contains("ptg") { 1.0 } else { 0.3 });
    }
}

#[test]
fn conduction_survives_being_written_out() {
    let media = ["fluid.liquid={fluid = \"water-nasg\"}", "fluid.gas={fluid = \"air\"}"];
    let read = |more: &str| {
        let terms = format!("fluid.terms={{conduction={{liquid=0.6, gas=0.026{more}}}}}");
        let case = with(&[media[0], media[1], &terms]);
        round_trip(&case);
        case.fluid.and_then(|fluid| fluid.terms.conduction)
    };
    let wall = |more: &str| read(more).expect("it is asked for").wall;
    assert_eq!(wall(""), WallHeat::Adiabatic);
    assert_eq!(wall(", wall_temperature=310.0"), WallHeat::Isothermal(310.0));
    // A wall is what the solid is made of where the case does not say.
    let of = |name: &str| solid::Material::by_name(name).and_then(|material| material.effusivity());
    for (more, effusivity) in [
        ("", good().solid.and_then(|solid| of(solid.material.name()))),
        (", wall_material=\"pmma\"", of("pmma")),
        (", wall_effusivity=8000.0", Some(8000.0)),
    ] {
        let got = wall(&format!(", wall=\"conducting\", wall_temperature=293.15{more}"));
        let effusivity = effusivity.expect("it is in the library");
        assert_eq!(got, WallHeat::Conducting(ConductingWall { temperature: 293.15, effusivity }));
    }
    // Nothing conducts nothing.
    let none = with(&[media[0], media[1], "fluid.terms={conduction={liquid=0.0, gas=0.0}}"]);
    assert_eq!(none.fluid.expect("a fluid").terms.conduction, None);
}
