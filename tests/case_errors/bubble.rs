//! Bubbles by what is in them: what is refused, and what comes of the good ones.

use cav::case::{Case, ResetCase};
use fluid::{InitialPressure, Phase, Shape};

use crate::Edit::{self, Append};
use crate::fixture::SMALL;
use crate::good_cases::round_trip;

/// Edit, then what the message must have in it: the key, the value or cause, the remedy.
#[rustfmt::skip]
pub const BAD: &[(Edit, &[&str])] = &[
    (Append("[fluid.bubble]\n"), &["fluid.bubble.centre: `centre` is missing", "fluid.bubble.radius_max: `radius_max` is missing", "`radius` (it may grow first)", "fluid.bubble.equilibrium_radius: `equilibrium_radius` is missing", "or `gas_pressure` in Pa"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.001]\nradius_max = 1e-3\ngas_pressure = 1e3"), &["fluid.bubble.centre: a sphere in axisymmetric geometry must be on the axis", "[0.004, 0.0]"]),
    (Append("[fluid.bubble]\ncentre = [0.04, 0.0]\nradius_max = 1e-3\ngas_pressure = 1e3"), &["fluid.bubble.centre: the centre (0.04, 0.0) m is outside the fluid", "z = 0.0 to 0.01 m"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius_max = 1e-3\nradius = 1e-4\ngas_pressure = 1e3"), &["fluid.bubble.radius: `radius_max` and `radius` exclude each other", "remove one"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius_max = 1e-3\ngas_pressure = 1e3\nequilibrium_radius = 1e-4"), &["fluid.bubble.gas_pressure: `equilibrium_radius` and `gas_pressure` exclude each other", "remove one"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius_max = 1e-3\nequilibrium_radius = 2e-3"), &["fluid.bubble.equilibrium_radius: R_n = 0.002 m is not below radius_max = 0.001 m", "give a smaller R_n"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius_max = 1e-3\ngas_pressure = 2e6"), &["fluid.bubble.gas_pressure: the bubble holds 2000000.0 Pa at radius_max = 0.001 m, not less than the liquid's 1000000.0 Pa", "`radius` instead"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius_max = 1e-3\ngas_pressure = 1e3\nvapour_pressure = 1e6"), &["fluid.bubble.vapour_pressure: the vapour's 1000000.0 Pa are not below fluid.ambient.pressure", "2339 Pa"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius_max = 1e-3\ngas_pressure = 1e3\nvapour_pressure = -1"), &["fluid.bubble.vapour_pressure: must not be negative, got -1.0 Pa", "in Pa"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius_max = 1e-3\ngas_pressure = 1e3\nsurface_tension = -1"), &["fluid.bubble.surface_tension: must not be negative, got -1.0 N/m"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius_max = 1e-3\ngas_pressure = 1e3\nvapour_gamma = 1"), &["fluid.bubble.vapour_gamma: must be greater than 1, got 1.0", "1.33"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius_max = 1e-3\ngas_pressure = 0"), &["fluid.bubble.gas_pressure: must be positive, got 0.0"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius_max = 1e-3\nequilibrium_radius = 1e-4\nreset = { gas_share = 0.1 }"), &["fluid.bubble.reset: cuts the gas at the first maximum, and radius_max = 0.001 m is where the bubble starts", "give the smaller equilibrium_radius at once"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius = 1e-4\nequilibrium_radius = 1e-3\nreset = { gas_share = 1.0 }"), &["fluid.bubble.reset.gas_share: must lie in (0, 1), got 1.0"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius = 1e-4\nequilibrium_radius = 1e-3\nreset = {}"), &["fluid.bubble.reset.equilibrium_radius: `equilibrium_radius` is missing", "`gas_share`"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius = 1e-4\nequilibrium_radius = 1e-3\nreset = { gas_share = 0.1, equilibrium_radius = 1e-4 }"), &["fluid.bubble.reset.gas_share: `equilibrium_radius` and `gas_share` exclude each other"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius = 1e-4\nequilibrium_radius = 1e-3\nreset = { equilibrium_radius = 1e-3 }"), &["fluid.bubble.equilibrium_radius: reset.equilibrium_radius = 0.001 m is no cut", "smaller radius under reset"]),
    (Append("[fluid.bubble]\nregion = 1\ncells_per_radius = 20"), &["fluid.bubble.region: there are 1 regions, got 1", "from 0"]),
    (Append("[fluid.bubble]\nregion = 0\nradius = 1e-3"), &["fluid.bubble.radius: the content of region 0 stands in [[fluid.region]]", "remove `radius`, or `region`"]),
    (Append("[fluid.bubble]\nregion = 0\ncells_per_radius = 1"), &["fluid.bubble.cells_per_radius: must lie in [2, 10000], got 1.0", "40 is a good begin"]),
    (Edit::Replace("[fluid.liquid]", "adapt = false\nbubble = { region = 0, cells_per_radius = 20 }\n[fluid.liquid]"), &["fluid.bubble.cells_per_radius: 20.0 cells along the present radius need a grid that adapts", "fluid.adapt = true"]),
    (Append("[fluid.gas]\ngamma = 1.4\npi = 1e5\n[fluid.bubble]\ncentre = [0.004, 0.0]\nradius = 1e-4\nequilibrium_radius = 1e-3"), &["fluid.bubble: describes an ideal gas, and fluid.gas.pi is 100000.0 Pa", "fluid.gas.pi = 0"]),
    (Append("[fluid.gas]\ngamma = 1.4\ncovolume = 1e-3\n[fluid.bubble]\ncentre = [0.004, 0.0]\nradius = 1e-5\nequilibrium_radius = 1e-3"), &["fluid.bubble.equilibrium_radius: the gas would have", "a density below 1/covolume"]),
    (Edit::Sets(&["geometry=planar", "fluid.bubble={ region = 0 }"]), &["fluid.bubble: describes a sphere, and the geometry is planar", "take geometry = \"axisymmetric\""]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius_max = -1e-3\ngas_pressure = 1e3"), &["fluid.bubble.radius_max: must be positive, got -0.001", "in m"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius = 0.0\ngas_pressure = 1e3"), &["fluid.bubble.radius: must be positive, got 0.0", "in m"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius_max = 1e-3\nequilibrium_radius = -1e-4"), &["fluid.bubble.equilibrium_radius: must be positive, got -0.0001"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius_max = 1e-3\ngas_pressure = 1e3\ngas_density = 0"), &["fluid.bubble.gas_density: must be positive, got 0.0", "in kg/m3"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius_max = 1e-3\ngas_pressure = 1e3\ntemperature = -20"), &["fluid.bubble.temperature: must be positive, got -20.0", "in K"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius_max = 1e-3\ngas_pressure = 1e3\nvapour_pressure = 2339\ntemperature = 700"), &["fluid.bubble.temperature: 700.0 K are not below water's critical 647.096 K", "293.15 K by default"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius = 1e-4\nequilibrium_radius = 1e-3\nreset = { equilibrium_radius = 0 }"), &["fluid.bubble.reset.equilibrium_radius: must be positive, got 0.0"]),
    (Append("[fluid.bubble]\ncentre = [0.004, 0.0]\nradius = 1e-4\nequilibrium_radius = 1e-3\nreset = { gas_share = -0.1 }"), &["fluid.bubble.reset.gas_share: must lie in (0, 1), got -0.1"]),
    (Edit::Sets(&["fluid.ambient={density=1010.0, pressure=5e7}", "fluid.bubble={centre=[0.004, 0.0], radius_max=1e-3, gas_pressure=1e3, vapour_pressure=3e7}"]), &["fluid.bubble.vapour_pressure: the vapour's 30000000.0 Pa are not below water's critical", "2339 Pa at 20"]),
    (Append("[fluid.bubble]\nregion = -1"), &["fluid.bubble.region", "got -1", "whole number from 0"]),
    (Append("[fluid.bubble]\nregoin = 0"), &["fluid.bubble.regoin: unknown key", "did you mean `region`?"]),
];

/// The good case with this bubble instead of its own.
fn with(bubble: &str) -> Case {
    let start = SMALL.find("[[fluid.region]]").expect("a region");
    let end = SMALL.find("[solid]").expect("a solid");
    let text = format!("{}{bubble}\n{}", &SMALL[..start], &SMALL[end..]);
    Case::from_toml(&text, "bubble", &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

#[test]
fn a_bubble_is_a_region_with_the_pressure_and_density_of_its_content() {
    let case = with(
        "[fluid.bubble]\ncentre = [0.004, 0.0]\nradius_max = 2e-3\nequilibrium_radius = 5e-4\nvapour_pressure = 2339",
    );
    round_trip(&case);
    let fluid = case.fluid.as_ref().expect("a fluid");
    let region = fluid.initial.regions[0];
    assert_eq!(region.shape, Shape::Sphere { centre: [0.004, 0.0], radius: 2e-3 });
    assert_eq!(region.state.phase, Phase::Gas);
    // p_n = 1e6 - 2339, (R_n/R)^4.2 of it, and the vapour.
    let expected = (1e6 - 2339.0) * 0.25_f64.powf(4.2) + 2339.0;
    assert!((region.state.pressure / expected - 1.0).abs() < 1e-12, "{region:?}");
    let density = (1e6 - 2339.0) / (287.05 * 293.15) / 64.0 + 2339.0 / (461.52 * 293.15);
    assert!((region.state.density / density - 1.0).abs() < 1e-12, "{region:?}");
    // It starts from rest, where it can.
    assert_eq!(fluid.initial.pressure, InitialPressure::Rayleigh);
    assert!(fluid.followed_bubble().is_none(), "there is nothing to follow");
    let told = cav::case::report(&case);
    assert!(
        told.contains("bubble        region 0: 5.292 kPa, 2.339 kPa of it vapour, 5.292e-3 of the liquid's"),
        "{told}"
    );
}

#[test]
fn a_bubble_that_grows_is_followed_and_begins_with_a_wave() {
    let case = with(
        "[fluid.bubble]\ncentre = [0.004, 0.0]\nradius = 4e-4\nequilibrium_radius = 1e-3\nsurface_tension = 0.07\n\
         cells_per_radius = 4\nreset = { equilibrium_radius = 3e-4 }\n\
         [[fluid.region]]\nshape = \"sphere\"\ncentre = [0.008, 0.0]\nradius = 1e-3\nphase = \"gas\"\ndensity = 1.2\npressure = 1e6",
    );
    round_trip(&case);
    let fluid = case.fluid.as_ref().expect("a fluid");
    assert_eq!((fluid.initial.regions.len(), fluid.initial.pressure), (2, InitialPressure::Uniform));
    let expected = (1e6 + 140.0) * 2.5_f64.powf(4.2);
    assert!((fluid.initial.regions[0].state.pressure / expected - 1.0).abs() < 1e-12);
    let bubble = fluid.bubble.expect("a bubble");
    assert_eq!(bubble.reset, Some(ResetCase::EquilibriumRadius(3e-4)));
    let followed = fluid.followed_bubble().expect("it is followed");
    assert_eq!((followed.number, followed.radius, followed.cuts.bubbles()), (0, 4e-4, 2));
    // Level 3 has 3.2 cells over 0.4 mm, so there is none that is enough; the first level of half as many is level 2.
    assert_eq!(fluid.first_level(), 3);
    let finer = with(
        "[fluid.bubble]\ncentre = [0.004, 0.0]\nradius = 2e-3\nequilibrium_radius = 3e-3\ncells_per_radius = 3",
    );
    assert_eq!(
        finer.fluid.as_ref().map(|fluid| fluid.first_level()),
        Some(2),
        "the coarsest blocks are there"
    );
    assert_eq!(finer.cells_per_radius().map(f64::round), Some(3.0));
    let told = cav::case::report(&case);
    assert!(told.contains("at least 4 cells along the present radius, as far as level 3 has them"), "{told}");
    assert!(told.contains("cut at the first maximum of the volume to that of R_n = 300 µm"), "{told}");
}

#[test]
fn the_gas_has_its_own_density_heat_and_exponent() {
    let base = "centre = [0.004, 0.0]\nradius_max = 2e-3\ngas_pressure = 2e3\n";
    let state = |more: &str| {
        let case = with(&format!("{more}[fluid.bubble]\n{base}"));
        round_trip(&case);
        let fluid = case.fluid.expect("a fluid");
        (fluid.initial.regions[0].state, fluid.gas.gamma)
    };
    let (air, _) = state("");
    assert!((air.density / (2e3 / (287.05 * 293.15)) - 1.0).abs() < 1e-12, "{air:?}");
    let (argon, _) = state("[fluid.gas]\ngamma = 1.6666667\nheat_capacity = 312.2\n");
    assert!((argon.density / (2e3 / (0.6666667 * 312.2 * 293.15)) - 1.0).abs() < 1e-12, "{argon:?}");
    let half = with(&format!(
        "[fluid.bubble]\n{base}vapour_pressure = 2e3\nvapour_gamma = 1.3333333333333333\ngas_density = 0.5"
    ));
    round_trip(&half);
    let fluid = half.fluid.expect("a fluid");
    assert!((fluid.gas.gamma - (1.0 + 1.0 / 2.75)).abs() < 1e-12, "{}", fluid.gas.gamma);
    let vapour = 2e3 / (461.52 * 293.15);
    assert!((fluid.initial.regions[0].state.density - 0.5 - vapour).abs() < 1e-12);
}
