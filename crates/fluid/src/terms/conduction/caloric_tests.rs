use super::*;
use crate::{NamedFluid, NobleAbelStiffenedGas};

fn laws() -> [NobleAbelStiffenedGas; 2] {
    ["water-nasg", "air"].map(|name| NamedFluid::of(name).expect("it is in the library").law)
}

fn mixture() -> Mixture {
    let [liquid, gas] = laws();
    Mixture::new(liquid, gas)
}

fn caloric() -> Caloric {
    Caloric::of(&mixture()).expect("both have heat capacities")
}

/// ρ, p, φ and m_g of a cell with these temperatures of gas and liquid.
fn cell(p: f64, phi: f64, [gas, liquid]: [f64; 2]) -> ([f64; 3], f64) {
    let [of_liquid, of_gas] = laws();
    let mass = phi * of_gas.density_at(p, gas).expect("it has c_v");
    let rho = mass + (1.0 - phi) * of_liquid.density_at(p, liquid).expect("likewise");
    ([rho, p, phi], mass)
}

fn phases_of(state: [f64; 3], gas: f64, mixture: &Mixture) -> PhaseHeats {
    caloric().phases(PhaseEnergies::of(mixture, state, gas), [gas, state[0] - gas])
}

#[test]
fn cells_of_one_temperature_have_it() {
    for phi in [0.0, 1e-9, 1e-3, 0.5, 1.0 - 1e-9, 1.0] {
        let (state, gas) = cell(3e5, phi, [320.0; 2]);
        let heat = caloric().of_phases(state, gas);
        approx::assert_relative_eq!(heat.temperature, 320.0, max_relative = 1e-13);
    }
    let of = |name| NamedFluid::of(name).expect("it is in the library").law;
    let (liquid, gas): (NobleAbelStiffenedGas, NobleAbelStiffenedGas) = (of("water-2.35"), of("air"));
    let caloric = Caloric::of(&Mixture::new(liquid, gas)).expect("both have heat capacities");
    let density = |law: NobleAbelStiffenedGas| law.density_at(1e5, 290.0).expect("it has c_v");
    for phi in [0.0, 0.3, 1.0] {
        let rho = phi * density(gas) + (1.0 - phi) * density(liquid);
        approx::assert_relative_eq!(
            caloric.of_mixture([rho, 1e5, phi]).temperature,
            290.0,
            max_relative = 1e-13
        );
    }
}

/// The energies of the phases after heat and work are those of their laws, and nothing comes from nothing.
#[test]
fn phases_come_to_one_pressure_with_the_heat_that_they_got() {
    let mixture = mixture();
    for (phi, temperatures, heat) in [
        (0.5, [300.0, 300.0], [2e4, -1e4]),
        (0.9, [2000.0, 300.0], [-2.1e5, 1e5]),
        (1e-4, [300.0, 350.0], [15.0, 0.0]),
        (0.999, [300.0, 400.0], [1e5, 1e6]),
    ] {
        let ([rho, p, phi], gas) = cell(1e5, phi, temperatures);
        let phases = phases_of([rho, p, phi], gas, &mixture);
        assert_eq!(phases.energies.growth([0.0; 2]), Some(0.0));
        let growth = phases.energies.growth(heat).expect("there is heat enough");
        let energy = |law: NobleAbelStiffenedGas, volume: f64, mass: f64, p: f64| {
            volume * law.internal_energy(mass / volume, p)
        };
        let internal = |phi: f64, p: f64| {
            let [beta1, beta2] = mixture.free_betas::<true>(phi, rho, gas);
            (beta1 * p + beta2, beta1)
        };
        let (before, _) = internal(phi, p);
        let (at_old, beta1) = internal(phi + growth, p);
        let after = p + (before + heat[0] + heat[1] - at_old) / beta1;
        let work = after * growth;
        let gained = energy(laws()[1], phi + growth, gas, after) - energy(laws()[1], phi, gas, p);
        approx::assert_relative_eq!(gained, heat[0] - work, max_relative = 1e-6);
        assert!(after > 0.0, "{after}");
    }
}

#[test]
fn gas_beside_stiff_liquid_is_heated_at_constant_volume() {
    let (state, gas) = cell(1e5, 0.3, [300.0; 2]);
    let phases = phases_of(state, gas, &mixture());
    let heat = 0.01 * phases.heats[0];
    let growth = phases.energies.growth([heat, 0.0]).expect("there is heat enough");
    // The pressure rises by a hundredth: the liquid gives way by that over its stiffness.
    assert!(growth > 0.0 && growth < 1e-6, "{growth}");
    // And liquid that is heated expands, and compresses the gas.
    assert!(phases.energies.growth([0.0, 1e6]).expect("likewise") < -1e-5);
}

#[test]
fn the_phases_of_a_cell_come_to_what_many_small_steps_bring_them_to() {
    for (phi, through, conductance) in
        [(0.3, [3e3, -5e3], 200.0), (0.9, [-1e4, 2e4], 1e3), (0.5, [10.0, 0.0], 0.0)]
    {
        let (state, gas) = cell(1e5, phi, [900.0, 300.0]);
        let whole = phases_of(state, gas, &mixture());
        let [c_g, c_l] = whole.capacities;
        let [mut h_g, mut h_l] = whole.heats;
        let steps = 200_000;
        for _ in 0..steps {
            let part = 1.0 / f64::from(steps);
            let passed = part * conductance * (h_g / c_g - h_l / c_l);
            h_g += part * through[0] - passed;
            h_l += part * through[1] + passed;
        }
        let [gas_heat, liquid_heat] = whole.shares(through, conductance);
        approx::assert_relative_eq!(gas_heat, h_g - whole.heats[0], max_relative = 1e-4, epsilon = 1e-3);
        approx::assert_relative_eq!(gas_heat + liquid_heat, through[0] + through[1], max_relative = 1e-12);
        assert!((liquid_heat - (h_l - whole.heats[1])).abs() < 1e-4 * h_g, "{liquid_heat}");
    }
}

/// A trace takes the temperature of what it is in, and no more heat than that takes.
#[test]
fn thin_phases_follow() {
    let (state, gas) = cell(1e5, 1e-6, [3000.0, 300.0]);
    let phases = phases_of(state, gas, &mixture());
    let [gas_heat, _] = phases.shares([0.0; 2], 1e9);
    approx::assert_relative_eq!(gas_heat, -0.9 * phases.heats[0], max_relative = 1e-6);
}
