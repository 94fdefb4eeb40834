//! Stefan's problem and bubbles that grow by heat: evaporation that conduction limits.

use std::f64::consts::PI;

use fluid::{
    Boundary, Conduction, EvaporationLaw, FarField, FluidSetup, FluidSolver, Heat, InitialCondition,
    InitialPressure, Mixture, NamedFluid, NobleAbelStiffenedGas, Phase, PhaseChange, PhaseState,
    PressureHistory, Primitive, Region, RiemannSolver, Saturation, Shape, ThinGas, WallHeat,
};
use mesh::Domain;

use crate::helpers::*;

const P: f64 = 1e5;
/// Where both phases are in equilibrium at [`P`], K.
const BOILING: f64 = 373.0;

/// Water's vapour, and a liquid of another density (kg/m³) that has water's heat and boils where water does.
fn laws(density: f64, latent: f64) -> [NobleAbelStiffenedGas; 2] {
    let mut gas = NamedFluid::of("water-vapour").unwrap().law;
    let heat = gas.heat.unwrap();
    let (gamma, capacity) = (1.19, 3600.0);
    let above = (gamma - 1.0) * capacity * density * BOILING;
    let energy = gas.gamma * heat.capacity * BOILING + heat.energy - latent - gamma * capacity * BOILING;
    let liquid = NobleAbelStiffenedGas {
        gamma,
        pi: above - P,
        covolume: 0.0,
        heat: Some(Heat { capacity, energy, entropy: 0.0 }),
    };
    let boils_at = Saturation::of(&Mixture::new(liquid, gas)).unwrap().vapour_pressure(BOILING, P);
    let gas_constant = (gas.gamma - 1.0) * heat.capacity;
    gas.heat = Some(Heat { entropy: heat.entropy + gas_constant * (P / boils_at).ln(), ..heat });
    [liquid, gas]
}

/// Vapour between a hot wall and liquid that boils, in the coordinate ξ = m/√t of the vapour's mass per area m from the wall:
/// −½ξ c_p T′ = (λρT′)′ with T(0) that of the wall, T(ξ_I) = T_s, and ½ξ_I h = −λρT′ at ξ_I.
struct Stefan {
    /// ξ, T and x/√t from the wall to the interface.
    profile: Vec<[f64; 3]>,
}

impl Stefan {
    fn of(gas: NobleAbelStiffenedGas, conductivity: f64, wall: f64, latent: f64) -> Self {
        let heat = gas.heat.unwrap();
        let (capacity, gas_constant) = (gas.gamma * heat.capacity, (gas.gamma - 1.0) * heat.capacity);
        let density = |t: f64| P / (gas_constant * t);
        // From the interface back to the wall, for a guess of ξ_I; q = −λρT′.
        let back = |end: f64, steps: usize| {
            let rate = |xi: f64, [t, q]: [f64; 2]| {
                let slope = -q / (conductivity * density(t));
                // q′ = ½ξ c_p T′.
                [slope, 0.5 * xi * capacity * slope]
            };
            let h = -end / steps as f64;
            let mut y = [BOILING, 0.5 * end * latent];
            let mut profile = vec![[end, y[0], 0.0]];
            for k in 0..steps {
                let xi = end + h * k as f64;
                let add = |y: [f64; 2], k: [f64; 2], w: f64| [y[0] + w * k[0], y[1] + w * k[1]];
                let k1 = rate(xi, y);
                let k2 = rate(xi + 0.5 * h, add(y, k1, 0.5 * h));
                let k3 = rate(xi + 0.5 * h, add(y, k2, 0.5 * h));
                let k4 = rate(xi + h, add(y, k3, h));
                let middle = add(y, k2, 0.5 * h)[0];
                let before = y[0];
                for c in 0..2 {
                    y[c] += h / 6.0 * (k1[c] + 2.0 * k2[c] + 2.0 * k3[c] + k4[c]);
                }
                let way = h / 6.0 * (1.0 / density(before) + 4.0 / density(middle) + 1.0 / density(y[0]));
                let x = profile[profile.len() - 1][2] + way;
                profile.push([xi + h, y[0], x]);
            }
            profile
        };
        let at_wall = |end: f64| back(end, 400).last().unwrap()[1];
        let (mut low, mut high) = (0.0, 1.0);
        while at_wall(high) < wall {
            high *= 2.0;
        }
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if at_wall(middle) < wall { low = middle } else { high = middle }
        }
        let mut profile = back(high, 4000);
        let all = profile[profile.len() - 1][2];
        profile.iter_mut().for_each(|point| point[2] -= all);
        profile.reverse();
        Self { profile }
    }

    /// x_I/√t.
    fn growth(&self) -> f64 {
        self.profile[self.profile.len() - 1][2]
    }

    /// T at x/√t.
    fn temperature(&self, x: f64) -> f64 {
        let above = self.profile.partition_point(|point| point[2] < x).clamp(1, self.profile.len() - 1);
        let ([_, t0, x0], [_, t1, x1]) = (self.profile[above - 1], self.profile[above]);
        t0 + (t1 - t0) * ((x - x0) / (x1 - x0)).clamp(0.0, 1.0)
    }
}

/// Where the interface is: the volume of the vapour, or its mass over its exact mean density.
fn interface(fluid: &FluidSolver<8>) -> f64 {
    let mut volume = 0.0;
    for (slot, id) in fluid.mesh().tree().leaves().iter().enumerate() {
        for (j, i) in (0..8).flat_map(|j| (0..8).map(move |i| (j, i))) {
            volume += fluid.mesh().volume(*id, j) * fluid.cell(slot, i, j).phi;
        }
    }
    let Domain { r, .. } = *fluid.mesh().domain();
    volume / (r[1] - r[0])
}

/// Stefan's problem from x_I = 10 to 20 µm in a strip of 40 µm.
fn stefan(cells: usize, law: EvaporationLaw, wall: f64, density: f64) -> [f64; 2] {
    let latent = 2.18e6;
    let conductivity = 0.025;
    let [liquid, gas] = laws(density, latent);
    let exact = Stefan::of(gas, conductivity, wall, latent);
    let [begin, end] = [10e-6, 20e-6].map(|x: f64| (x / exact.growth()).powi(2));
    let h = 40e-6 / cells as f64;
    let vapour = gas.density_at(P, BOILING).unwrap();
    let pushing = |t: f64| (1.0 - vapour / density) * 0.5 * exact.growth() / t.sqrt();
    let pushed = pushing(begin);
    // What has to come in for the pressure to stay as it is beyond the liquid that slows down.
    let impedance = density * liquid.sound_speed(density, P);
    let outlet = (0..=200)
        .map(|k| begin + (end - begin) * f64::from(k) / 200.0)
        .map(|t| [t - begin, P + 0.5 * impedance * (pushed - pushing(t))])
        .collect();
    let domain = Domain { geometry: PLANAR, z: [0.0, 40e-6], r: [0.0, 8.0 * h] };
    let setup = FluidSetup {
        liquid,
        gas,
        conduction: Some(Conduction {
            liquid: 0.6,
            gas: conductivity,
            thin_gas: ThinGas::SuperTimeStepping,
            wall: WallHeat::Isothermal(wall),
        }),
        phase_change: Some(PhaseChange { law, vapour_fraction: 1.0, cavitation: None }),
        inflow: PressureHistory::new(outlet),
        ..FluidSetup::new(
            domain,
            [cells, 8],
            [Boundary::Wall, Boundary::Inflow, Boundary::Symmetry, Boundary::Symmetry],
        )
    };
    let place = |t: f64| exact.growth() * t.sqrt();
    let state = |z: f64| {
        if z > place(begin) {
            Primitive { density, v_z: pushed, v_r: 0.0, pressure: P, phi: 0.0 }
        } else {
            let t = exact.temperature(z / begin.sqrt());
            Primitive { density: gas.density_at(P, t).unwrap(), v_z: 0.0, v_r: 0.0, pressure: P, phi: 1.0 }
        }
    };
    let mut fluid = FluidSolver::<8>::from_fn(&setup, |[z, _]| state(z)).unwrap();
    // The cell that the interface is in.
    let mixture = *fluid.mixture();
    for slot in 0..fluid.mesh().blocks() {
        let id = fluid.mesh().tree().leaves()[slot];
        for (j, i) in (0..8).flat_map(|j| (0..8).map(move |i| (j, i))) {
            let z = fluid.mesh().centre(id, i, j)[0];
            let phi = ((place(begin) - (z - 0.5 * h)) / h).clamp(0.0, 1.0);
            if phi > 0.0 && phi < 1.0 {
                let mass = phi * vapour;
                let whole = Primitive {
                    density: mass + (1.0 - phi) * density,
                    v_z: pushed,
                    v_r: 0.0,
                    pressure: P,
                    phi,
                };
                let u = whole.to_conserved(mass, &mixture);
                let block = fluid.state_mut().block_mut(slot);
                for (c, value) in u.into_iter().chain([mass, mass]).enumerate() {
                    block[c * 64 + j * 8 + i] = value;
                }
            }
        }
    }
    let blocks = fluid.mesh().blocks();
    fluid.state_changed(0..blocks);
    let started = interface(&fluid);
    run_to(&mut fluid, end - begin);
    let got = interface(&fluid);
    let grown = (got - started) / (place(end) - place(begin)) - 1.0;
    let mut error = 0.0;
    let temperatures = fluid.snapshot().temperature;
    let mut k = 0;
    each_cell(&fluid, |[z, _], _, _| {
        if z < place(end) - 1.5 * h {
            error += (temperatures[k] - exact.temperature(z / end.sqrt())).abs();
        }
        k += 1;
    });
    error /= (wall - BOILING) * place(end) / h * 8.0;
    eprintln!(
        "{cells} cells, {law:?}, density {density}: grows {:+.2} %, temperature {error:.2e}, {} steps, {:?}",
        100.0 * grown,
        fluid.steps(),
        fluid.phase_ledger()
    );
    [grown, error]
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
fn scriven(cells: usize, law: EvaporationLaw, jakob: f64) -> f64 {
    let (density, latent, conductivity) = (60.0, 2.18e6, 0.7);
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
    let size = 80e-6;
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
        ..FluidSetup::new(domain, [4 * cells; 2], sides)
    };
    let mut fluid = FluidSolver::<8>::new(&setup, &initial).unwrap();
    let speed = 2.0 * exact.beta * exact.beta * diffusivity / begin;
    let blocks = fluid.mesh().blocks();
    for slot in 0..blocks {
        let id = fluid.mesh().tree().leaves()[slot];
        for (j, i) in (0..8).flat_map(|j| (0..8).map(move |i| (j, i))) {
            let [z, r] = fluid.mesh().centre(id, i, j);
            let far = z.hypot(r);
            let phi = fluid.cell(slot, i, j).phi.clamp(0.0, 1.0);
            let temperature = exact.temperature(far / begin);
            let mass = phi * vapour;
            let rho = mass + (1.0 - phi) * liquid.density_at(P, temperature).unwrap();
            // Liquid is pushed out; the vapour does not move.
            let v = if far < begin { 0.0 } else { (1.0 - vapour / density) * speed * (begin / far).powi(2) };
            let whole = Primitive { density: rho, v_z: v * z / far, v_r: v * r / far, pressure: P, phi };
            let u = whole.to_conserved(mass, &mixture);
            let block = fluid.state_mut().block_mut(slot);
            for (c, value) in u.into_iter().chain([mass, mass]).enumerate() {
                block[c * 64 + j * 8 + i] = value;
            }
        }
    }
    fluid.state_changed(0..blocks);
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
#[ignore = "a study"]
fn stefan_study() {
    for density in [6.0, 30.0] {
        for law in [
            EvaporationLaw::Equilibrium,
            EvaporationLaw::HertzKnudsen { accommodation: 1.0 },
            EvaporationLaw::HertzKnudsen { accommodation: 0.1 },
        ] {
            for cells in [32, 64] {
                stefan(cells, law, 873.0, density);
            }
        }
    }
    let _ = PI;
}

#[test]
#[ignore = "a study"]
fn scriven_study() {
    for jakob in [1.0, 3.0] {
        for law in [EvaporationLaw::Equilibrium, EvaporationLaw::HertzKnudsen { accommodation: 1.0 }] {
            for cells in [16, 32] {
                scriven(cells, law, jakob);
            }
        }
    }
}
