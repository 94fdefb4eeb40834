//! The rate against its ordinary differential equation, and steps of any length.

use super::*;
use crate::{Mixture, NamedFluid};

fn water() -> Saturation {
    let of = |name| NamedFluid::of(name).expect("it is in the library").law;
    Saturation::of(&Mixture::new(of("water-nasg"), of("water-vapour"))).expect("both have heat")
}

fn cell(phi: f64, p: f64, [liquid, gas]: [f64; 2], part: f64) -> Holding {
    let Mixture { liquid: liquid_law, gas: gas_law, .. } = water().mixture;
    let rho_l = liquid_law.density_at(p, liquid).expect("it has c_v");
    let rho_g = gas_law.density_at(p, gas).expect("likewise");
    Holding {
        density: phi * rho_g + (1.0 - phi) * rho_l,
        gas: phi * rho_g,
        vapour: part * phi * rho_g,
        internal: phi * gas_law.internal_energy(rho_g, p)
            + (1.0 - phi) * liquid_law.internal_energy(rho_l, p),
        phi,
    }
}

/// Two phases in a closed cell, by their energies: of the gas p α/(γ − 1), of the liquid (p + γπ)(α − b m)/(γ − 1). With dm the vapour's enthalpy
/// passes, at the temperature of where it comes from, and dα p of work.
///
/// - returns: what evaporates and α and p change by per time, at these α, p and evaporated mass.
fn slopes(start: &Holding, [evaporated, alpha, p]: [f64; 3], rate: f64) -> [f64; 3] {
    let water = water();
    let (liquid, gas) = (water.mixture.liquid, water.mixture.gas);
    let mass_l = start.liquid() - evaporated;
    let (mass_g, vapour) = (start.gas + evaporated, start.vapour + evaporated);
    let free = 1.0 - alpha - liquid.covolume * mass_l;
    let t_l = (p + liquid.pi) * free / ((liquid.gamma - 1.0) * 3610.0 * mass_l);
    let t_g = p * alpha / ((gas.gamma - 1.0) * 955.0 * mass_g);
    let gas_constant = (gas.gamma - 1.0) * 955.0;
    let driving = water.vapour_pressure(t_l, p) - p * vapour / mass_g;
    let dm = rate * driving / (std::f64::consts::TAU * gas_constant * t_l).sqrt();
    let passing = gas.gamma * 955.0 * if dm > 0.0 { t_l } else { t_g };
    let taken = (passing + 2_077_616.0 + 1_177_788.0) * dm;
    // alpha/(g − 1) dp + g/(g − 1) p dα = passing dm
    // free/(l − 1) dp − [(p + lπ)/(l − 1) + p] dα = −taken − (p + lπ)/(l − 1) b dm
    let (g, l) = (gas.gamma, liquid.gamma);
    let stiff = (p + l * liquid.pi) / (l - 1.0);
    let [a, b, c] = [alpha / (g - 1.0), g / (g - 1.0) * p, passing * dm];
    let [d, e, f] = [free / (l - 1.0), -(stiff + p), -taken - stiff * liquid.covolume * dm];
    let determinant = a * e - b * d;
    [dm, (a * f - c * d) / determinant, (c * e - b * f) / determinant]
}

/// The equations by the classical method of fourth order.
fn integrated(start: &Holding, rate: f64, steps: u32) -> [f64; 3] {
    let water = water();
    let mut y = [0.0, start.phi, start.pressure(&water)];
    let dt = 1.0 / f64::from(steps);
    let add = |y: [f64; 3], k: [f64; 3], h: f64| std::array::from_fn(|c| y[c] + h * k[c]);
    for _ in 0..steps {
        let k1 = slopes(start, y, rate);
        let k2 = slopes(start, add(y, k1, 0.5 * dt), rate);
        let k3 = slopes(start, add(y, k2, 0.5 * dt), rate);
        let k4 = slopes(start, add(y, k3, dt), rate);
        y = std::array::from_fn(|c| y[c] + dt / 6.0 * (k1[c] + 2.0 * (k2[c] + k3[c]) + k4[c]));
    }
    y
}

#[test]
fn the_rate_is_that_of_its_equation() {
    let water = water();
    // Evaporation, condensation, and with gas that stays.
    for (start, rate) in [
        (cell(0.6, 2e3, [300.0, 300.0], 1.0), 1e-3),
        (cell(0.6, 6e3, [300.0, 340.0], 1.0), 5e-4),
        (cell(0.4, 1e5, [340.0, 340.0], 0.05), 2e-3),
    ] {
        let wanted = integrated(&start, rate, 20_000);
        let error = |steps: u32| {
            let mut now = start;
            for _ in 0..steps {
                let changed = at_finite_rate(&now, [rate / f64::from(steps); 2], &water).expect("it goes on");
                now = now.with(changed, &water);
            }
            let got = [now.gas - start.gas, now.phi - start.phi, now.pressure(&water)];
            eprintln!("{steps}: {got:?}, {wanted:?}");
            let expected = [wanted[0], wanted[1] - start.phi, wanted[2]];
            got.iter().zip(expected).map(|(got, wanted)| (got / wanted - 1.0).abs()).fold(0.0, f64::max)
        };
        let [coarse, fine] = [200, 400].map(error);
        assert!(wanted[0].abs() > 1e-2 * start.gas, "something happens: {wanted:?}");
        assert!(fine < 5e-3 && coarse / fine > 1.8, "{coarse:e} {fine:e}");
    }
}

#[test]
fn a_step_of_any_length_stays_within_equilibrium() {
    let water = water();
    for (start, is_evaporation) in [
        (cell(0.6, 2e3, [300.0, 300.0], 1.0), true),
        (cell(0.6, 6e3, [300.0, 340.0], 1.0), false),
        (cell(0.99, 1e3, [320.0, 300.0], 0.3), true),
    ] {
        for rate in [1e-6, 1e-2, 1.0, 1e4, 1e12] {
            let changed = at_finite_rate(&start, [rate; 2], &water).expect("it changes");
            let after = start.with(changed, &water);
            let (p, before) = (after.pressure(&water), start.pressure(&water));
            assert_eq!(changed.evaporated > 0.0, is_evaporation, "{changed:?}");
            let drive = |cell: &Holding, p: f64| driving(cell, p, cell.liquid_temperature(p, &water), &water);
            let left = drive(&after, p) / drive(&start, before);
            assert!((-1e-6..=1.0).contains(&left), "{rate:e}: {left}");
            assert!(after.liquid() > 0.0 && after.vapour > 0.0, "{after:?}");
        }
    }
}
