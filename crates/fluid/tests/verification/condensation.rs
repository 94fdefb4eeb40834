//! Vapour that condenses: no slower than it should, though it has to come into cells of liquid.

use fluid::{
    Boundary, EvaporationLaw, FarField, FluidSetup, FluidSolver, InitialCondition, InitialPressure, Mixture,
    PhaseChange, Primitive, RiemannSolver, Shape,
};
use mesh::Domain;

use crate::helpers::*;
use crate::phase_change::{cavity, laws as water, saturation};
use crate::stefan::{BOILING, P, fill, laws, outlet, strip};
use crate::superheated::{conducting, erfc, growth_constant};

const RADIUS: f64 = 1e-3;
const FAR: f64 = 1e5;
const TEMPERATURE: f64 = 293.15;

/// The radii, over the first one, at which what is left of the vapour is looked at.
const RADII: [f64; 3] = [0.9, 0.7, 0.5];

/// What is left of the vapour in a bubble that collapses as Rayleigh and Plesset have it, R R″ + ³⁄₂ R′² = (p − p∞)/ρ. Its vapour has one pressure and
/// condenses on liquid of one temperature by Hertz's and Knudsen's j; what leaves takes its own enthalpy with it, and so what stays
/// remains on its adiabat: p = p₀ (m/m₀)^γ (R₀/R)^3γ.
fn left_of_vapour(accommodation: f64) -> [f64; 3] {
    let [liquid, gas] = water();
    let saturated = saturation().vapour_pressure(TEMPERATURE, FAR);
    let density = liquid.density_at(FAR, TEMPERATURE).unwrap();
    let gas_constant = (gas.gamma - 1.0) * gas.heat.unwrap().capacity;
    let vapour = gas.density_at(saturated, TEMPERATURE).unwrap();
    let per_pressure = accommodation / (std::f64::consts::TAU * gas_constant * TEMPERATURE).sqrt();
    // Of R, R′ and m/m₀.
    let rate = |[r, v, m]: [f64; 3]| {
        let p = saturated * m.powf(gas.gamma) * (RADIUS / r).powf(3.0 * gas.gamma);
        let condenses = per_pressure * (saturated - p) * 3.0 * r * r / (RADIUS.powi(3) * vapour);
        [v, ((p - FAR) / density - 1.5 * v * v) / r, condenses]
    };
    let mut y = [RADIUS, 0.0, 1.0];
    let dt = 1e-9;
    RADII.map(|wanted| {
        while y[0] > wanted * RADIUS {
            y = runge_kutta(y, dt, rate);
        }
        y[2]
    })
}

/// The same in half a bubble of so many cells per radius, with sides four radii away.
///
/// - returns: how far what is left is off what should be.
fn bubble_of_vapour(cells: usize, accommodation: f64) -> [f64; 3] {
    let [liquid, gas] = water();
    let saturated = saturation().vapour_pressure(TEMPERATURE, FAR);
    let ball = Shape::Sphere { centre: [0.0; 2], radius: RADIUS };
    let initial = InitialCondition {
        pressure: InitialPressure::Rayleigh,
        ..cavity(ball, [FAR, TEMPERATURE], [saturated, TEMPERATURE])
    };
    let domain = Domain { geometry: AXIAL, z: [0.0, 4.0 * RADIUS], r: [0.0, 4.0 * RADIUS] };
    let sides = [Boundary::Symmetry, Boundary::FarField, Boundary::Axis, Boundary::FarField];
    let law = EvaporationLaw::HertzKnudsen { accommodation };
    let setup = FluidSetup {
        liquid,
        gas,
        phase_change: Some(PhaseChange { law, vapour_fraction: 1.0, cavitation: None }),
        far_field: FarField::of(&initial, &Mixture::new(liquid, gas), &domain, sides, None, 1.0).ok(),
        riemann: RiemannSolver::HllcLowMach,
        ..setup_in(domain, [4 * cells; 2], sides)
    };
    let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
    let [radius, mass] = [fluid.bubble().equivalent_radius, fluid.totals().gas_mass];
    let wanted = left_of_vapour(accommodation);
    let mut off = [0.0; 3];
    for ((off, place), wanted) in off.iter_mut().zip(RADII).zip(wanted) {
        let mut before = [1.0, fluid.totals().gas_mass / mass];
        loop {
            fluid.step_at(CFL).unwrap();
            let now = [fluid.bubble().equivalent_radius / radius, fluid.totals().gas_mass / mass];
            if now[0] <= place {
                let part = (before[0] - place) / (before[0] - now[0]);
                *off = before[1] + part * (now[1] - before[1]) - wanted;
                break;
            }
            before = now;
            assert!(fluid.time() < 1e-4, "it collapses: {now:?}");
        }
    }
    eprintln!(
        "alpha {accommodation}, {cells} cells: left {wanted:.3?}, off by {off:+.3?}, {} steps, {:?}",
        fluid.steps(),
        fluid.fixups()
    );
    off
}

#[test]
fn a_bubble_of_vapour_condenses_at_the_rate_that_is_asked_for() {
    for accommodation in [0.04, 1.0] {
        let off = bubble_of_vapour(20, accommodation);
        assert!(off.iter().all(|off| off.abs() < 0.04), "{accommodation}: {off:?}");
    }
}

#[test]
#[ignore = "minutes"]
fn study_of_bubbles_of_vapour() {
    for &accommodation in rows(&[0.04, 0.2, 1.0]) {
        for &(cells, most) in rows(&[(12, 0.07), (24, 0.03), (48, 0.015)]) {
            let off = bubble_of_vapour(cells, accommodation);
            assert!(off.iter().all(|off| off.abs() < most), "{accommodation}: {off:?}");
        }
    }
}

const BOTH: [EvaporationLaw; 2] =
    [EvaporationLaw::Equilibrium, EvaporationLaw::HertzKnudsen { accommodation: 1.0 }];

/// Vapour at its boiling point that flows to liquid on a wall, which is colder by ΔT: it condenses as the liquid conducts heat away. In the liquid's frame
/// T = T_s − ΔT (1 − erfc(η)/erfc(−εβ)), η = y/(2√(Dt)), with its surface at η = −εβ, ε = ρ_v/ρ_l, and
/// j = ρ_v β√(D/t), √π β exp(ε²β²) erfc(−εβ) = ρ_l c ΔT/(ρ_v L).
///
/// The layer that is warm goes from 5 to 10 µm.
///
/// - `conductivity`: λ of the liquid, W/(m K).
/// - returns: the error of the mass that condenses.
fn on_cold_liquid(cells: usize, law: EvaporationLaw, conductivity: f64) -> f64 {
    let (density, latent, colder) = (60.0, 2.18e6, 50.0);
    let [liquid, gas] = laws(density, latent);
    let vapour = gas.density_at(P, BOILING).unwrap();
    let heat = density * liquid.gamma * liquid.heat.unwrap().capacity;
    let (diffusivity, ratio) = (conductivity / heat, vapour / density);
    let jakob = heat * colder / (vapour * latent);
    let beta = growth_constant(jakob, -ratio);
    let [begin, end] = [5e-6, 10e-6].map(|layer: f64| layer * layer / diffusivity);
    let (size, surface) = (100e-6, 80.3e-6);
    let h = size / cells as f64;
    let flux = |t: f64| vapour * beta * (diffusivity / t).sqrt();
    // Towards the liquid, which is at rest.
    let flowing = |t: f64| -flux(t) * (1.0 / vapour - 1.0 / density);
    let temperature = |z: f64| {
        let eta = (surface - z) / (2.0 * (diffusivity * begin).sqrt()) - ratio * beta;
        BOILING - colder * (1.0 - erfc(eta) / erfc(-ratio * beta))
    };
    let setup = FluidSetup {
        inflow: outlet(gas, vapour, [begin, end], flowing),
        ..strip(size, cells, [liquid, gas], conducting(conductivity), law)
    };
    let of_gas = Primitive { density: vapour, v_z: flowing(begin), v_r: 0.0, pressure: P, phi: 1.0 };
    let mut fluid = FluidSolver::<8>::from_fn(&setup, |[z, _]| {
        let rho = liquid.density_at(P, temperature(z)).unwrap();
        if z > surface { of_gas } else { Primitive { density: rho, v_z: 0.0, phi: 0.0, ..of_gas } }
    })
    .unwrap();
    fill(&mut fluid, |[z, _], _| {
        let low = z - 0.5 * h;
        let phi = 1.0 - ((surface - low) / h).clamp(0.0, 1.0);
        let mean = (0..64)
            .map(|k| low + (1.0 - phi) * (f64::from(k) + 0.5) / 64.0 * h)
            .map(|x| liquid.density_at(P, temperature(x)).unwrap())
            .sum::<f64>()
            / 64.0;
        let mass = phi * vapour;
        let whole = Primitive { density: mass + (1.0 - phi) * mean, v_z: 0.0, phi, ..of_gas };
        (phi < 1.0).then_some((whole, mass))
    });
    run_to(&mut fluid, end - begin);
    let phases = fluid.phase_ledger();
    let width = fluid.mesh().domain().r[1];
    let wanted = 2.0 * vapour * beta * ((diffusivity * end).sqrt() - (diffusivity * begin).sqrt());
    let off = (phases.condensed - phases.evaporated) / width / wanted - 1.0;
    eprintln!(
        "{law:?}, {cells} cells, vapour at {:.1} to {:.1} m/s: {:+.2} %, {} steps",
        flowing(begin),
        flowing(end),
        100.0 * off,
        fluid.steps()
    );
    off
}

/// The liquid of a cell is colder than its surface, by which the rate goes: first order.
#[test]
fn vapour_condenses_on_cold_liquid_as_stefan_says() {
    for law in BOTH {
        let off = on_cold_liquid(80, law, 2.0);
        assert!(off.abs() < 0.13, "{law:?}: {off}");
    }
}

/// At rates at which pressures of the vapour alone would hold it up in a mixed cell, and liquid that is up to 16 % denser than the solution has it.
#[test]
#[ignore = "minutes"]
fn study_of_vapour_on_cold_liquid() {
    for &law in rows(&BOTH) {
        for &(cells, most) in rows(&[(80, 0.13), (160, 0.065), (320, 0.035)]) {
            let off = on_cold_liquid(cells, law, 2.0);
            assert!(off.abs() < most, "{law:?}: {off}");
        }
    }
}
