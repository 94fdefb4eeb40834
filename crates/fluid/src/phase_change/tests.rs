//! Equilibria against an independent solution, and in random states.

use super::*;
use crate::{Mixture, NamedFluid, NobleAbelStiffenedGas};

fn water() -> (Saturation, [NobleAbelStiffenedGas; 2]) {
    let of = |name| NamedFluid::of(name).expect("it is in the library").law;
    let laws = [of("water-nasg"), of("water-vapour")];
    (Saturation::of(&Mixture::new(laws[0], laws[1])).expect("both have heat"), laws)
}

/// A cell of phases at one pressure with temperatures of their own.
fn cell(phi: f64, p: f64, [liquid, gas]: [f64; 2], part: f64) -> Holding {
    let (_, laws) = water();
    let at = |law: &NobleAbelStiffenedGas, t: f64| law.density_at(p, t).expect("it has c_v");
    let (gas_mass, liquid_mass) = (phi * at(&laws[1], gas), (1.0 - phi) * at(&laws[0], liquid));
    let energy = |law: &NobleAbelStiffenedGas, t: f64| law.internal_energy(at(law, t), p);
    Holding {
        density: gas_mass + liquid_mass,
        gas: gas_mass,
        vapour: part * gas_mass,
        internal: phi * energy(&laws[1], gas) + (1.0 - phi) * energy(&laws[0], liquid),
        phi,
    }
}

/// The equilibrium of pure vapour and liquid by the temperature alone: at p_sat(T) the mass gives the volumes, and T that has the energy is
/// found by halving. None of it is in what is tested.
fn by_temperature(cell: &Holding) -> [f64; 3] {
    let (water, laws) = water();
    let energy = cell.internal + cell.gas * 2_077_616.0 + cell.liquid() * -1_177_788.0;
    let at = |t: f64| {
        let p = water.pressure(t);
        let [liquid, vapour] = [laws[0], laws[1]].map(|law| law.density_at(p, t).expect("it has c_v"));
        let phi = (cell.density - liquid) / (vapour - liquid);
        let own = |law: &NobleAbelStiffenedGas, rho: f64, q: f64| law.internal_energy(rho, p) + rho * q;
        let whole =
            phi * own(&laws[1], vapour, 2_077_616.0) + (1.0 - phi) * own(&laws[0], liquid, -1_177_788.0);
        (whole, [p, t, phi * vapour])
    };
    let [mut low, mut high] = [250.0, 600.0];
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if at(middle).0 < energy { low = middle } else { high = middle }
    }
    at(low).1
}

#[test]
fn equilibria_are_those_of_the_saturation_curve() {
    let (water, _) = water();
    for (phi, p, temperatures) in [
        (0.5, 1e5, [372.0, 380.0]),
        (0.3, 2e5, [300.0, 420.0]),
        (0.9, 1e4, [330.0, 290.0]),
        (0.05, 1e6, [450.0, 470.0]),
        (0.99, 5e3, [310.0, 300.0]),
    ] {
        let cell = cell(phi, p, temperatures, 1.0);
        let changed = to_equilibrium(&cell, &water).expect("there is an equilibrium");
        let after = cell.with(changed, &water);
        let pressure = after.pressure(&water);
        let [wanted, temperature, mass] = by_temperature(&cell);
        eprintln!(
            "{phi} {p}: {pressure:.6e} {wanted:.6e} Pa, {temperature:.3} K, {:.6e} {mass:.6e}",
            after.gas
        );
        // The pressure is a small difference of energies of 10⁹ J/m³ where there is little gas.
        approx::assert_relative_eq!(pressure, wanted, max_relative = 1e-8, epsilon = 1e-3);
        approx::assert_relative_eq!(after.gas, mass, max_relative = 1e-8);
        approx::assert_relative_eq!(
            after.liquid_temperature(pressure, &water),
            temperature,
            max_relative = 1e-8
        );
        approx::assert_relative_eq!(
            after.gas_temperature(pressure, &water),
            temperature,
            max_relative = 1e-7
        );
        // It stays where it is.
        let again = to_equilibrium(&after, &water).expect("likewise");
        assert!(again.evaporated.abs() < 1e-8 * after.gas, "{again:?}");
    }
}

#[test]
fn gas_that_does_not_condense_keeps_its_mass_and_its_part_of_the_pressure() {
    let (water, _) = water();
    for (part, temperatures) in [(0.0, [320.0, 300.0]), (0.5, [300.0, 350.0]), (0.01, [360.0, 360.0])] {
        let cell = cell(0.4, 1e5, temperatures, part);
        let after = cell.with(to_equilibrium(&cell, &water).expect("there is an equilibrium"), &water);
        let rest = |cell: &Holding| cell.gas - cell.vapour;
        approx::assert_relative_eq!(rest(&after), rest(&cell), max_relative = 1e-12);
        let p = after.pressure(&water);
        let temperature = after.liquid_temperature(p, &water);
        let partial = p * after.vapour / after.gas;
        approx::assert_relative_eq!(partial, water.vapour_pressure(temperature, p), max_relative = 1e-7);
        approx::assert_relative_eq!(after.gas_temperature(p, &water), temperature, max_relative = 1e-7);
    }
}

#[test]
fn liquid_in_tension_opens_to_its_saturation() {
    let (water, _) = water();
    for (tension, temperature) in [(1e6, 300.0), (2e7, 300.0), (1e5, 350.0)] {
        let cell = cell(0.0, -tension, [temperature, 300.0], 1.0);
        let after = cell.with(to_equilibrium(&cell, &water).expect("it opens"), &water);
        let (p, [wanted, ..]) = (after.pressure(&water), by_temperature(&cell));
        eprintln!("{tension:e} Pa: phi {:.3e}, {p:.1} Pa", after.phi);
        assert!(after.phi > 0.0 && (p - wanted).abs() < 1e-3 * wanted, "{p} {wanted}");
    }
}

/// Any state ends in one that is finite, with both phases' masses not below zero, and no mass beyond what was there.
#[test]
fn no_state_breaks_it() {
    let (water, _) = water();
    let mut random = 1_u64;
    let mut within = |low: f64, high: f64| {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (low.ln() + (high / low).ln() * (random >> 11) as f64 / (1_u64 << 53) as f64).exp()
    };
    let mut changes = 0;
    for _ in 0..20_000 {
        let phi = within(1e-6, 2.0).min(1.0 - within(1e-6, 1.0)).max(1e-6);
        let temperatures = [within(150.0, 1e3), within(10.0, 2e4)];
        let part = within(1e-9, 2.0).min(1.0);
        let cell = cell(phi, within(1.0, 1e9), temperatures, part);
        let Some(changed) = to_equilibrium(&cell, &water) else { continue };
        let after = cell.with(changed, &water);
        changes += 1;
        assert!(after.vapour > 0.0 && after.liquid() > 0.0 && after.phi.is_finite(), "{cell:?} {after:?}");
    }
    assert!(changes > 5_000, "{changes}");
}
