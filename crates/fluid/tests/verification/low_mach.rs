//! Slow collapse: the bound on what jumps of the velocity add to the pressure on faces.

use fluid::{
    Boundary, FarField, FluidSetup, FluidSolver, InitialCondition, InitialPressure, Mixture,
    NobleAbelStiffenedGas, RiemannSolver, StiffenedGas,
};
use mesh::Domain;

use crate::helpers::*;

/// A bubble of radius 1 m at 1 bar, with 1 kPa of a gas with covolume, half of it in front of a plane of symmetry: 10 cells per
/// radius, 3.2 radii of water.
fn bubble(riemann: RiemannSolver) -> FluidSolver<16> {
    let gas = NobleAbelStiffenedGas { covolume: 1.5e-3, ..StiffenedGas { gamma: 1.4, pi: 0.0 }.into() };
    let initial = InitialCondition {
        pressure: InitialPressure::Rayleigh,
        ..ball_of_gas(([0.0, 0.0], 1.0), 1e5, [0.0447, 1e3], 0.0)
    };
    let domain = Domain { geometry: AXIAL, z: [0.0, 3.2], r: [0.0, 3.2] };
    let sides = [Boundary::Wall, Boundary::FarField, Boundary::Axis, Boundary::FarField];
    let far_field =
        FarField::of(&initial, &Mixture::new(LIQUID, gas), &domain, sides, None, 1.0).unwrap();
    let setup = FluidSetup {
        gas,
        riemann,
        far_field: Some(far_field),
        ..setup_of(SHARP, AXIAL, [32, 32], sides)
    };
    let setup = FluidSetup { domain, ..setup };
    FluidSolver::new(&setup, &initial).unwrap()
}

/// R/R₀ at 0.9 of Rayleigh's time, 0.915 R₀ √(ρ/Δp), where a Navier–Stokes solution has 0.51249 (Denner & Schenke 2023): Mach
/// numbers are 0.01 there. HLLC's is 2.6 % of R₀ late.
#[test]
fn a_collapse_at_one_bar_keeps_its_time() {
    let radius = |riemann| {
        let mut fluid = bubble(riemann);
        let start = fluid.bubble().equivalent_radius;
        run_to(&mut fluid, 0.9 * 0.915 * (1000.0_f64 / 99e3).sqrt());
        fluid.bubble().equivalent_radius / start
    };
    let (plain, bounded) = (radius(RiemannSolver::Hllc), radius(RiemannSolver::HllcLowMach));
    eprintln!("R/R0 is {plain:.4} and {bounded:.4}, 0.5125 wanted");
    assert!((bounded - 0.51249).abs() < 0.007, "{bounded}");
    assert!((bounded - 0.51249).abs() < 0.3 * (plain - 0.51249), "{plain} {bounded}");
}
