//! Liquid that is superheated beside vapour: evaporation that the conduction of heat through the liquid limits.

use std::f64::consts::PI;

use fluid::{
    Boundary, Conduction, EvaporationLaw, FarField, FluidSetup, FluidSolver, InitialCondition,
    InitialPressure, Mixture, NobleAbelStiffenedGas, Phase, PhaseChange, PhaseState, Primitive, Region,
    RiemannSolver, Shape, SurfaceTension, ThinGas, WallHeat,
};
use mesh::Domain;

use crate::helpers::*;
use crate::stefan::{BOILING, P, fill, interface, laws, outlet, strip};

/// erfc, by Simpson's rule on what is left of the integral.
pub fn erfc(x: f64) -> f64 {
    1.0 - crate::conduction::erf(x)
}

/// β of a plane front at 2β√(Dt): Ja = √π β exp(ε²β²) erfc(εβ).
///
/// - `ratio`: ε, of the densities of vapour and liquid; below 0 where vapour condenses on liquid at rest.
pub fn growth_constant(jakob: f64, ratio: f64) -> f64 {
    let of = |beta: f64| PI.sqrt() * beta * (ratio * beta).powi(2).exp() * erfc(ratio * beta);
    let (mut low, mut high) = (0.0, 100.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if of(middle) < jakob { low = middle } else { high = middle }
    }
    high
}

/// Vapour of 0.025 W/(m K) beside a liquid that conducts, between walls that do not.
pub fn conducting(liquid: f64) -> Conduction {
    Conduction { liquid, gas: 0.025, thin_gas: ThinGas::Bounded, wall: WallHeat::Adiabatic }
}

/// A plane front from 10 to 20 µm: it is at 2β√(Dt), and the liquid is pushed away (Welch & Wilson 2000).
///
/// - returns: the error of its way.
fn plane(cells: usize, law: EvaporationLaw, jakob: f64) -> f64 {
    let (density, latent, conductivity) = (60.0, 2.18e6, 6.0);
    let [liquid, gas] = laws(density, latent);
    let vapour = gas.density_at(P, BOILING).unwrap();
    let capacity = liquid.gamma * liquid.heat.unwrap().capacity;
    let diffusivity = conductivity / (density * capacity);
    let superheat = jakob * vapour * latent / (density * capacity);
    let ratio = vapour / density;
    let beta = growth_constant(jakob, ratio);
    let temperature = |x: f64, t: f64| {
        let eta = x / (2.0 * (diffusivity * t).sqrt());
        if eta <= beta {
            BOILING
        } else {
            BOILING + superheat * (1.0 - erfc(eta - beta + ratio * beta) / erfc(ratio * beta))
        }
    };
    let [begin, end] = [10e-6, 20e-6].map(|x: f64| (x / (2.0 * beta)).powi(2) / diffusivity);
    let place = |t: f64| 2.0 * beta * (diffusivity * t).sqrt();
    let size = 80e-6;
    let h = size / cells as f64;
    let pushing = |t: f64| (1.0 - ratio) * beta * (diffusivity / t).sqrt();
    let pushed = pushing(begin);
    let setup = FluidSetup {
        inflow: outlet(liquid, density, [begin, end], pushing),
        ..strip(size, cells, [liquid, gas], conducting(conductivity), law)
    };
    let gas_state = Primitive { density: vapour, v_z: 0.0, v_r: 0.0, pressure: P, phi: 1.0 };
    let state = |z: f64| {
        if z > place(begin) {
            let rho = liquid.density_at(P, temperature(z, begin)).unwrap();
            Primitive { density: rho, v_z: pushed, v_r: 0.0, pressure: P, phi: 0.0 }
        } else {
            gas_state
        }
    };
    let mut fluid = FluidSolver::<8>::from_fn(&setup, |[z, _]| state(z)).unwrap();
    fill(&mut fluid, |[z, _], _| {
        let low = z - 0.5 * h;
        let phi = ((place(begin) - low) / h).clamp(0.0, 1.0);
        let mean = (0..64)
            .map(|k| low + (phi + (1.0 - phi) * (f64::from(k) + 0.5) / 64.0) * h)
            .map(|x| liquid.density_at(P, temperature(x, begin)).unwrap())
            .sum::<f64>()
            / 64.0;
        let mass = phi * vapour;
        let v_z = if phi < 1.0 { pushed } else { 0.0 };
        Some((Primitive { density: mass + (1.0 - phi) * mean, v_z, v_r: 0.0, pressure: P, phi }, mass))
    });
    let started = interface(&fluid);
    run_to(&mut fluid, end - begin);
    let grown = (interface(&fluid) - started) / (place(end) - place(begin)) - 1.0;
    eprintln!(
        "plane, Ja {jakob} (beta {beta:.3}, {superheat:.1} K), {law:?}, {cells} cells: grows {:+.2} %, {} steps",
        100.0 * grown,
        fluid.steps()
    );
    grown
}

/// A bubble of vapour that grows in superheated liquid, R = 2β√(Dt): Scriven (1959).
struct Scriven {
    beta: f64,
    /// ΔT, and ρ_v/ρ_l.
    superheat: f64,
    ratio: f64,
}

impl Scriven {
    /// - `jakob`: ρ_l c_l ΔT/(ρ_v (L + (c_l − c_v)ΔT)); `ratio`: ρ_v/ρ_l.
    fn of(jakob: f64, superheat: f64, ratio: f64) -> Self {
        let all = |beta: f64| 2.0 * beta * beta * Self::integral(beta, ratio, 0.0);
        let (mut low, mut high) = (1e-3, 1e3);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if all(middle) < jakob { low = middle } else { high = middle }
        }
        Self { beta: high, superheat, ratio }
    }

    /// ∫ exp(−β²((1 − ζ)⁻² − 2(1 − ρ_v/ρ_l)ζ − 1)) dζ from `from` to 1, by Simpson's rule.
    fn integral(beta: f64, ratio: f64, from: f64) -> f64 {
        let at = |zeta: f64| {
            let left = 1.0 - zeta;
            if left < 1e-9 {
                return 0.0;
            }
            (-beta * beta * (1.0 / (left * left) - 2.0 * (1.0 - ratio) * zeta - 1.0)).exp()
        };
        // The integrand falls off within 1/β.
        let to = (from + 12.0 / beta).min(1.0);
        let steps = 2000;
        let h = (to - from) / f64::from(steps);
        let weight = |k: i32| if k == 0 || k == steps { 1.0 } else { f64::from(2 + 2 * (k % 2)) };
        (0..=steps).map(|k| weight(k) * at(from + h * f64::from(k))).sum::<f64>() * h / 3.0
    }

    /// T at r/R.
    fn temperature(&self, r: f64) -> f64 {
        if r <= 1.0 {
            return BOILING;
        }
        let part =
            Self::integral(self.beta, self.ratio, 1.0 - 1.0 / r) / Self::integral(self.beta, self.ratio, 0.0);
        BOILING + self.superheat * (1.0 - part)
    }
}

/// Radius of the bubble in half a ball.
fn radius(fluid: &FluidSolver<8>) -> f64 {
    (3.0 * fluid.bubble().volume / (2.0 * PI)).cbrt()
}

/// Scriven's problem from R = 10 to 20 µm with so many cells in the last one's radius.
///
/// A little surface tension, 2σ/R of 1 % of the superheat at first, keeps the bubble round: a bump of it would reach hotter liquid and grow.
///
/// - returns: the error of R.
fn scriven(cells: usize, law: EvaporationLaw, jakob: f64) -> f64 {
    let (density, latent, conductivity) = (60.0, 2.18e6, 1.4);
    let [liquid, gas] = laws(density, latent);
    let vapour = gas.density_at(P, BOILING).unwrap();
    let of = |law: NobleAbelStiffenedGas| law.gamma * law.heat.unwrap().capacity;
    let (c_l, c_v) = (of(liquid), of(gas));
    // ρ_l c_l ΔT = Ja ρ_v (L + (c_l − c_v) ΔT).
    let superheat = jakob * vapour * latent / (density * c_l - jakob * vapour * (c_l - c_v));
    let exact = Scriven::of(jakob, superheat, vapour / density);
    let diffusivity = conductivity / (density * c_l);
    let time = |radius: f64| (radius / (2.0 * exact.beta)).powi(2) / diffusivity;
    let [begin, end] = [10e-6, 20e-6];
    let size = 60e-6;
    let domain = Domain { geometry: AXIAL, z: [0.0, size], r: [0.0, size] };
    let sides = [Boundary::Symmetry, Boundary::FarField, Boundary::Axis, Boundary::FarField];
    let state = |phase, density| PhaseState { phase, density, pressure: P, velocity: [0.0; 2] };
    let initial = InitialCondition {
        ambient: state(Phase::Liquid, density),
        pressure: InitialPressure::Uniform,
        regions: vec![Region {
            shape: Shape::Sphere { centre: [0.0, 0.0], radius: begin },
            state: state(Phase::Gas, vapour),
        }],
        pulses: vec![],
    };
    let mixture = Mixture::new(liquid, gas);
    let setup = FluidSetup {
        liquid,
        gas,
        conduction: Some(Conduction {
            liquid: conductivity,
            gas: 0.025,
            thin_gas: ThinGas::SuperTimeStepping,
            wall: WallHeat::Adiabatic,
        }),
        phase_change: Some(PhaseChange { law, vapour_fraction: 1.0, cavitation: None }),
        far_field: FarField::of(&initial, &mixture, &domain, sides, None, 1.0).ok(),
        riemann: RiemannSolver::HllcLowMach,
        surface_tension: Some(SurfaceTension { coefficient: 1e-3, density, may_touch_walls: false }),
        ..setup_in(domain, [3 * cells; 2], sides)
    };
    let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
    let speed = 2.0 * exact.beta * exact.beta * diffusivity / begin;
    let h = size / (3 * cells) as f64;
    // Of the liquid in a cell.
    let mean_density = |[z, r]: [f64; 2]| {
        let at = |k: i32| (f64::from(k) + 0.5) / 8.0 - 0.5;
        let far = (0..64).map(|k| (z + at(k % 8) * h).hypot(r + at(k / 8) * h)).filter(|far| *far > begin);
        let of = |far: f64| liquid.density_at(P, exact.temperature(far / begin)).unwrap();
        let (sum, count) = far.fold((0.0, 0.0), |(sum, count), far| (sum + of(far), count + 1.0));
        if count > 0.0 { sum / count } else { density }
    };
    fill(&mut fluid, |[z, r], phi| {
        let (far, phi) = (z.hypot(r), phi.clamp(0.0, 1.0));
        let mass = phi * vapour;
        let density_of_all = mass + (1.0 - phi) * mean_density([z, r]);
        // Liquid is pushed out; the vapour does not move.
        let v = if far < begin { 0.0 } else { (1.0 - vapour / density) * speed * (begin / far).powi(2) };
        let [v_z, v_r] = [v * z / far, v * r / far];
        Some((Primitive { density: density_of_all, v_z, v_r, pressure: P, phi }, mass))
    });
    let started = radius(&fluid);
    let span = time(end) - time(begin);
    let mut line = String::new();
    for part in [0.25, 0.5, 1.0] {
        run_to(&mut fluid, part * span);
        let wanted = 2.0 * exact.beta * (diffusivity * (time(begin) + part * span)).sqrt();
        line += &format!(" {:+.2} %", 100.0 * ((radius(&fluid) - started) / (wanted - begin) - 1.0));
    }
    let wrong = radius(&fluid) / end - 1.0;
    eprintln!(
        "Ja {jakob} (beta {:.2}, {superheat:.1} K), {cells} cells, {law:?}: grows{line}, R {:+.2} %, {} steps, {:?}",
        exact.beta,
        100.0 * wrong,
        fluid.steps(),
        fluid.phase_ledger()
    );
    wrong
}

#[test]
fn a_plane_front_of_superheated_liquid_boils_as_it_should() {
    let grown = plane(32, EvaporationLaw::Equilibrium, 1.0);
    assert!(grown.abs() < 0.03, "{grown}");
}

#[test]
#[ignore = "minutes"]
fn study_of_superheated_fronts() {
    for law in [EvaporationLaw::Equilibrium, EvaporationLaw::HertzKnudsen { accommodation: 1.0 }] {
        for &cells in rows(&[32, 64, 128]) {
            plane(cells, law, 1.0);
        }
    }
}

#[test]
#[ignore = "minutes"]
fn study_of_scrivens_bubbles() {
    for &(cells, most) in rows(&[(16, 0.04), (32, 0.02)]) {
        let wrong = scriven(cells, EvaporationLaw::Equilibrium, 1.0);
        assert!(wrong.abs() < most, "{wrong}");
    }
}
