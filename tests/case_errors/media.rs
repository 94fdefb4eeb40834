//! Equations of state in case files.

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
