//! Liquid that is superheated beside vapour: evaporation that the conduction of heat through the liquid limits.

use std::f64::consts::PI;

use fluid::{
    Boundary, Conduction, EvaporationLaw, FarField, FluidSetup, FluidSolver, InitialCondition,
    InitialPressure, Mixture, NobleAbelStiffenedGas, Phase, PhaseChange, PhaseState, Primitive, Region,
    RiemannSolver, Saturation, Shape, SurfaceTension, ThinGas, WallHeat,
};
use mesh::Domain;

use crate::helpers::*;
use crate::stefan::{BOILING, P, fill, interface, laws, outlet, strip};

/// erfc, by Simpson's rule on what is left of the integral.
fn erfc(x: f64) -> f64 {
    1.0 - crate::conduction::erf(x)
}

/// A front that evaporates at the rate of Hertz and Knudsen into vapour at [`P`]: its own temperature is above the boiling point.
///
/// ∂T/∂t + (u − Ṙ) T′ = D (T″ + n T′/r), u = (1 − ρ_v/ρ_l) Ṙ (R/r)ⁿ; λT′ = jL and ρ_v Ṙ = j(T) on the front. Implicit
/// differences over the distance from it.
struct Kinetics {
    /// n: 0 for a plane front, 2 for a bubble.
    bend: i32,
    liquid: NobleAbelStiffenedGas,
    gas: NobleAbelStiffenedGas,
    density: f64,
    latent: f64,
    conductivity: f64,
    accommodation: f64,
}

/// A front on its way from 10 to 20 µm.
struct Course {
    /// Of the liquid at first, K, over the distance from the front.
    temperature: Box<dyn Fn(f64) -> f64 + Sync>,
    /// Time since then (s), place (m), speed (m/s).
    path: Vec<[f64; 3]>,
}

impl Course {
    /// Place and speed after some time.
    fn at(&self, time: f64) -> [f64; 2] {
        let above = self.path.partition_point(|point| point[0] < time).clamp(1, self.path.len() - 1);
        let (low, high) = (self.path[above - 1], self.path[above]);
        let part = (time - low[0]) / (high[0] - low[0]);
        [1, 2].map(|c| low[c] + part * (high[c] - low[c]))
    }

    /// How long it takes.
    fn span(&self) -> f64 {
        self.path[self.path.len() - 1][0]
    }
}

impl Kinetics {
    /// The front that was at 5 µm as one without kinetics is.
    ///
    /// - `temperature`: of the liquid then, K, over the distance from the front; `speed`: m/s.
    fn course(&self, temperature: impl Fn(f64) -> f64, speed: f64) -> Course {
        const NODES: usize = 1500;
        let Self { liquid, gas, density, latent, conductivity, .. } = *self;
        let saturation = Saturation::of(&Mixture::new(liquid, gas)).unwrap();
        let gas_constant = (gas.gamma - 1.0) * gas.heat.unwrap().capacity;
        let flux = |t: f64| {
            self.accommodation * (saturation.vapour_pressure(t, P) - P) / (2.0 * PI * gas_constant * t).sqrt()
        };
        let diffusivity = conductivity / (density * liquid.gamma * liquid.heat.unwrap().capacity);
        let (h, dt) = (60e-6 / NODES as f64, 2e-9 / speed);
        let mut t: Vec<f64> = (0..NODES).map(|k| temperature(k as f64 * h)).collect();
        let (mut place, mut time, mut path, mut first) = (5e-6, 0.0, vec![], vec![]);
        while place < 20e-6 {
            let (j, rise) = (flux(t[0]), (flux(t[0] + 1e-3) - flux(t[0])) * 1e3);
            let vapour = gas.density_at(P, t[0]).unwrap();
            let speed = j / vapour;
            // Thomas's algorithm: T_k = a_k T_{k+1} + b_k; on the front λ(T_1 − T_0)/h = L (j + j′ΔT_0) with half a cell's heat.
            let half = 0.5 * h * conductivity / (diffusivity * dt);
            let diagonal = conductivity / h + latent * rise + half;
            let loss = latent * (j - rise * t[0]);
            let mut upward = vec![[conductivity / h / diagonal, (half * t[0] - loss) / diagonal]];
            for k in 1..NODES - 1 {
                let r = place + k as f64 * h;
                let u = (1.0 - vapour / density) * speed * (place / r).powi(self.bend);
                let drift = (diffusivity * f64::from(self.bend) / r - (u - speed)) * dt / (2.0 * h);
                let spread = diffusivity * dt / (h * h);
                let [a, b] = upward[k - 1];
                let diagonal = 1.0 + 2.0 * spread - (spread - drift) * a;
                upward.push([(spread + drift) / diagonal, (t[k] + (spread - drift) * b) / diagonal]);
            }
            for k in (0..NODES - 1).rev() {
                t[k] = upward[k][0] * t[k + 1] + upward[k][1];
            }
            let speed = flux(t[0]) / gas.density_at(P, t[0]).unwrap();
            place += dt * speed;
            if place >= 10e-6 {
                if path.is_empty() {
                    (time, first) = (0.0, t.clone());
                }
                path.push([time, place, speed]);
            }
            time += dt;
        }
        let temperature = move |x: f64| {
            let k = ((x / h) as usize).min(NODES - 2);
            first[k] + (first[k + 1] - first[k]) * (x / h - k as f64).min(1.0)
        };
        Course { temperature: Box::new(temperature), path }
    }
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
    // Ja = √π β exp(ε²β²) erfc(εβ).
    let of = |beta: f64| PI.sqrt() * beta * (ratio * beta).powi(2).exp() * erfc(ratio * beta);
    let (mut low, mut high) = (0.0, 100.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if of(middle) < jakob { low = middle } else { high = middle }
    }
    let beta = high;
    let temperature = move |x: f64, t: f64| {
        let eta = x / (2.0 * (diffusivity * t).sqrt());
        if eta <= beta {
            BOILING
        } else {
            BOILING + superheat * (1.0 - erfc(eta - beta + ratio * beta) / erfc(ratio * beta))
        }
    };
    let time = |x: f64| (x / (2.0 * beta)).powi(2) / diffusivity;
    let speed = move |t: f64| beta * (diffusivity / t).sqrt();
    let course = match law {
        EvaporationLaw::Equilibrium => {
            let (begin, span) = (time(10e-6), time(20e-6) - time(10e-6));
            let at = |t: f64| [t, 2.0 * beta * (diffusivity * (begin + t)).sqrt(), speed(begin + t)];
            Course {
                temperature: Box::new(move |x| temperature(10e-6 + x, begin)),
                path: (0..=1000).map(|k| at(span * f64::from(k) / 1000.0)).collect(),
            }
        }
        EvaporationLaw::HertzKnudsen { accommodation } => {
            let kinetics = Kinetics { bend: 0, liquid, gas, density, latent, conductivity, accommodation };
            kinetics.course(|x| temperature(5e-6 + x, time(5e-6)), speed(time(5e-6)))
        }
    };
    let place = course.at(0.0)[0];
    let size = 80e-6;
    let h = size / cells as f64;
    let pushing = |t: f64| (1.0 - ratio) * course.at(t)[1];
    let pushed = pushing(0.0);
    let conduction = Conduction {
        liquid: conductivity,
        gas: 0.025,
        thin_gas: ThinGas::Bounded,
        wall: WallHeat::Adiabatic,
    };
    let setup = FluidSetup {
        inflow: outlet(liquid, density, [0.0, course.span()], pushing),
        ..strip(size, cells, [liquid, gas], conduction, law)
    };
    let gas_state = Primitive { density: vapour, v_z: 0.0, v_r: 0.0, pressure: P, phi: 1.0 };
    let state = |z: f64| {
        if z > place {
            let rho = liquid.density_at(P, (course.temperature)(z - place)).unwrap();
            Primitive { density: rho, v_z: pushed, v_r: 0.0, pressure: P, phi: 0.0 }
        } else {
            gas_state
        }
    };
    let mut fluid = FluidSolver::<8>::from_fn(&setup, |[z, _]| state(z)).unwrap();
    fill(&mut fluid, |[z, _], _| {
        let low = z - 0.5 * h;
        let phi = ((place - low) / h).clamp(0.0, 1.0);
        let mean = (0..64)
            .map(|k| low + (phi + (1.0 - phi) * (f64::from(k) + 0.5) / 64.0) * h)
            .map(|x| liquid.density_at(P, (course.temperature)(x - place)).unwrap())
            .sum::<f64>()
            / 64.0;
        let mass = phi * vapour;
        let v_z = if phi < 1.0 { pushed } else { 0.0 };
        Some((Primitive { density: mass + (1.0 - phi) * mean, v_z, v_r: 0.0, pressure: P, phi }, mass))
    });
    let started = interface(&fluid);
    run_to(&mut fluid, course.span());
    let grown = (interface(&fluid) - started) / (course.at(course.span())[0] - place) - 1.0;
    eprintln!(
        "plane, Ja {jakob} (beta {beta:.3}, {superheat:.1} K), {law:?}, {cells} cells: grows {:+.2} %, {} steps, {:?}",
        100.0 * grown,
        fluid.steps(),
        fluid.phase_ledger()
    );
    grown
}

/// A bubble of vapour that grows in superheated liquid, R = 2β√(Dt): Scriven (1959).
#[derive(Clone, Copy)]
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
    let speed = |radius: f64| 2.0 * exact.beta * exact.beta * diffusivity / radius;
    let course = match law {
        EvaporationLaw::Equilibrium => {
            let span = time(20e-6) - time(10e-6);
            let at = |t: f64| {
                let radius = 2.0 * exact.beta * (diffusivity * (time(10e-6) + t)).sqrt();
                [t, radius, speed(radius)]
            };
            Course {
                temperature: Box::new(move |x| exact.temperature(1.0 + x / 10e-6)),
                path: (0..=1000).map(|k| at(span * f64::from(k) / 1000.0)).collect(),
            }
        }
        EvaporationLaw::HertzKnudsen { accommodation } => {
            let kinetics = Kinetics { bend: 2, liquid, gas, density, latent, conductivity, accommodation };
            kinetics.course(|x| exact.temperature(1.0 + x / 5e-6), speed(5e-6))
        }
    };
    let [begin, speed] = course.at(0.0);
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
        ..FluidSetup::new(domain, [3 * cells; 2], sides)
    };
    let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
    let h = size / (3 * cells) as f64;
    // Of the liquid in a cell.
    let mean_density = |[z, r]: [f64; 2]| {
        let at = |k: i32| (f64::from(k) + 0.5) / 8.0 - 0.5;
        let far = (0..64).map(|k| (z + at(k % 8) * h).hypot(r + at(k / 8) * h)).filter(|far| *far > begin);
        let of = |far: f64| liquid.density_at(P, (course.temperature)(far - begin)).unwrap();
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
    let mut line = String::new();
    for part in [0.25, 0.5, 1.0] {
        run_to(&mut fluid, part * course.span());
        let way = course.at(part * course.span())[0] - begin;
        line += &format!(" {:+.2} %", 100.0 * ((radius(&fluid) - started) / way - 1.0));
    }
    let wrong = radius(&fluid) / course.at(course.span())[0] - 1.0;
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
    for law in [EvaporationLaw::Equilibrium, EvaporationLaw::HertzKnudsen { accommodation: 1.0 }] {
        let grown = plane(32, law, 1.0);
        assert!(grown.abs() < 0.03, "{law:?} {grown}");
    }
}

#[test]
#[ignore = "minutes"]
fn study_of_superheated_fronts() {
    let at_rate = |accommodation: f64| EvaporationLaw::HertzKnudsen { accommodation };
    for law in [EvaporationLaw::Equilibrium, at_rate(1.0), at_rate(0.1)] {
        for cells in [32, 64, 128] {
            plane(cells, law, 1.0);
        }
    }
}

#[test]
#[ignore = "minutes"]
fn study_of_scrivens_bubbles() {
    for law in [EvaporationLaw::Equilibrium, EvaporationLaw::HertzKnudsen { accommodation: 1.0 }] {
        for (cells, most) in [(16, 0.04), (32, 0.02)] {
            let wrong = scriven(cells, law, 1.0);
            assert!(wrong.abs() < most, "{wrong}");
        }
    }
}
