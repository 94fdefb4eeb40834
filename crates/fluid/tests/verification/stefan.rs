//! Stefan's problem: evaporation that the conduction of heat through vapour limits.

use fluid::{
    Boundary, Conduction, EvaporationLaw, FluidSetup, FluidSolver, Heat, Mixture, NamedFluid,
    NobleAbelStiffenedGas, PhaseChange, PressureHistory, Primitive, Saturation, ThinGas, WallHeat,
};
use mesh::Domain;

use crate::helpers::*;

pub const P: f64 = 1e5;
/// Where both phases are in equilibrium at [`P`], K.
pub const BOILING: f64 = 373.0;

/// Water's vapour, and a liquid of another density (kg/m³) that has water's heat and boils where water does.
pub fn laws(density: f64, latent: f64) -> [NobleAbelStiffenedGas; 2] {
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

/// Where the interface is in a strip: the volume of the vapour by the width.
pub fn interface(fluid: &FluidSolver<8>) -> f64 {
    let mut volume = 0.0;
    for (slot, id) in fluid.mesh().tree().leaves().iter().enumerate() {
        for (j, i) in (0..8).flat_map(|j| (0..8).map(move |i| (j, i))) {
            volume += fluid.mesh().volume(*id, j) * fluid.cell(slot, i, j).phi;
        }
    }
    let Domain { r, .. } = *fluid.mesh().domain();
    volume / (r[1] - r[0])
}

/// What comes in through the far end of a strip between two times, so that the pressure stays [`P`] in liquid that is pushed more slowly as
/// time goes on.
///
/// - `pushing`: how fast it is pushed, m/s, at a time.
pub fn outlet(
    liquid: NobleAbelStiffenedGas,
    density: f64,
    [begin, end]: [f64; 2],
    pushing: impl Fn(f64) -> f64,
) -> Option<PressureHistory> {
    let impedance = density * liquid.sound_speed(density, P);
    let pushed = pushing(begin);
    let points = (0..=200)
        .map(|k| begin + (end - begin) * f64::from(k) / 200.0)
        .map(|t| [t - begin, P + 0.5 * impedance * (pushed - pushing(t))])
        .collect();
    PressureHistory::new(points)
}

/// A strip of a length with a wall at its beginning, in which vapour and liquid change into each other.
pub fn strip(
    length: f64,
    cells: usize,
    [liquid, gas]: [NobleAbelStiffenedGas; 2],
    conduction: Conduction,
    law: EvaporationLaw,
) -> FluidSetup {
    let domain = Domain { geometry: PLANAR, z: [0.0, length], r: [0.0, 8.0 * length / cells as f64] };
    let sides = [Boundary::Wall, Boundary::Inflow, Boundary::Symmetry, Boundary::Symmetry];
    FluidSetup {
        liquid,
        gas,
        conduction: Some(conduction),
        phase_change: Some(PhaseChange { law, vapour_fraction: 1.0, cavitation: None }),
        ..setup_in(domain, [cells, 8], sides)
    }
}

/// Puts states into cells, with the mass of the vapour in them.
///
/// - `of`: of a centre and the gas fraction there; cells of `None` stay as they are.
pub fn fill(fluid: &mut FluidSolver<8>, of: impl Fn([f64; 2], f64) -> Option<(Primitive, f64)>) {
    let (mixture, blocks) = (*fluid.mixture(), fluid.mesh().blocks());
    for slot in 0..blocks {
        let id = fluid.mesh().tree().leaves()[slot];
        for (j, i) in (0..8).flat_map(|j| (0..8).map(move |i| (j, i))) {
            let phi = fluid.cell(slot, i, j).phi;
            let Some((state, vapour)) = of(fluid.mesh().centre(id, i, j), phi) else { continue };
            let u = state.to_conserved(vapour, &mixture);
            let block = fluid.state_mut().block_mut(slot);
            for (c, value) in u.into_iter().chain([vapour, vapour]).enumerate() {
                block[c * 64 + j * 8 + i] = value;
            }
        }
    }
    fluid.state_changed(0..blocks);
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
    let conduction = Conduction {
        liquid: 0.6,
        gas: conductivity,
        thin_gas: ThinGas::SuperTimeStepping,
        wall: WallHeat::Isothermal(wall),
    };
    let setup = FluidSetup {
        inflow: outlet(liquid, density, [begin, end], pushing),
        ..strip(40e-6, cells, [liquid, gas], conduction, law)
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
    fill(&mut fluid, |[z, _], _| {
        let phi = ((place(begin) - (z - 0.5 * h)) / h).clamp(0.0, 1.0);
        let mass = phi * vapour;
        let density = mass + (1.0 - phi) * density;
        let whole = Primitive { density, v_z: pushed, v_r: 0.0, pressure: P, phi };
        (phi > 0.0 && phi < 1.0).then_some((whole, mass))
    });
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

/// In equilibrium, and at the finite rate that hardly differs from it.
#[test]
fn vapour_beside_a_hot_wall_grows_as_stefan_says() {
    for law in [EvaporationLaw::Equilibrium, EvaporationLaw::HertzKnudsen { accommodation: 1.0 }] {
        let [grown, temperature] = stefan(32, law, 873.0, 30.0);
        assert!(grown.abs() < 0.02 && temperature < 0.04, "{grown} {temperature}");
    }
}

#[test]
#[ignore = "minutes"]
fn study_of_stefans_problem() {
    for &density in rows(&[6.0, 30.0]) {
        for &law in rows(&[
            EvaporationLaw::Equilibrium,
            EvaporationLaw::HertzKnudsen { accommodation: 1.0 },
            EvaporationLaw::HertzKnudsen { accommodation: 0.1 },
        ]) {
            for &(cells, bound) in rows(&[(32, 0.03_f64), (64, 0.01)]) {
                let [grown, _] = stefan(cells, law, 873.0, density);
                // Since gas slips a front with α = 0.1 is 0.2 % slower: −1.17 % in the last row.
                let is_slow = law == EvaporationLaw::HertzKnudsen { accommodation: 0.1 };
                let bound = if is_slow { bound.max(0.013) } else { bound };
                assert!(grown.abs() < bound, "{grown}");
            }
        }
    }
}
