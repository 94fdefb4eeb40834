//! Lab, not kept.
#![allow(warnings)]
use fluid::*;
use mesh::{Adaptation, Domain, Geometry, Limiter};

fn env(name: &str, default: f64) -> f64 {
    std::env::var(name).ok().map_or(default, |v| v.parse().unwrap())
}
fn text(name: &str, default: &str) -> String { std::env::var(name).unwrap_or(default.into()) }

fn tension() -> f64 { env("SIGMA", 1000.0) }

fn each_cell(fluid: &FluidSolver<16>, mut visit: impl FnMut([f64; 2], Primitive, f64)) {
    let mesh = fluid.mesh();
    for (slot, id) in mesh.tree().leaves().iter().enumerate() {
        for j in 0..16 { for i in 0..16 {
            let w = mesh.widths(id.level);
            visit(mesh.centre(*id, i, j), fluid.cell(slot, i, j), w[0] * w[1]);
        } }
    }
}

fn moment(fluid: &FluidSolver<16>, centre: f64) -> f64 {
    let mut sum = 0.0;
    each_cell(fluid, |[z, r], w, a| { let z = z - centre; sum += w.phi * (z * z - 0.5 * r * r) * r * a });
    sum
}

fn main() {
    let mode = text("MODE", "osc");
    if mode == "wave" { return wave(); }
    if mode == "tilt" { return tilt(); }
    let sharp = text("KIND", "sharp") != "mixture";
    let gas_inside = text("IN", "drop") != "drop";
    let cells = env("CELLS", 20.0) as usize;
    let axial = env("PLANAR", 0.0) == 0.0;
    let geometry = if axial { Geometry::Axisymmetric } else { Geometry::Planar };
    let half = env("HALF", if mode == "rest" { 2.0 } else if gas_inside { 4.0 } else { 2.4 });
    let pi = env("PI", if mode == "rest" { 2e5 } else { 4e5 });
    let gas_density = env("RHOG", 10.0);
    let pg = env("PG", 1e4);
    let count = |l: f64| ((l * cells as f64) / 16.0).round() as usize * 16;
    let z = [-half, half];
    let r = if axial { [0.0, half] } else { z };
    let side = Boundary::Wall;
    let domain = Domain { geometry, z, r };
    let sides = [side, side, if axial { Boundary::Axis } else { side }, side];
    let n = [count(2.0 * half), count(r[1] - r[0])];
    let mu = env("MU", 0.0);
    let setup = FluidSetup {
        model: if text("KIND", "") == "allaire" { Model::Allaire } else if sharp { Model::FiveEquation } else { Model::SaurelAbgrall },
        sharpening: if sharp { Sharpening::Thinc } else { Sharpening::None },
        riemann: RiemannSolver::NAMES.iter().find(|(n, _)| *n == text("RIEMANN", "hllc")).unwrap().1,
        limiter: Limiter::NAMES.iter().find(|(n, _)| *n == text("LIMITER", "mc")).unwrap().1,
        liquid: StiffenedGas { gamma: 4.4, pi }.into(),
        surface_tension: Some(SurfaceTension { coefficient: tension(), density: 1000.0, may_touch_walls: false }),
        viscosity: (mu > 0.0).then(|| Viscosity { liquid: PhaseViscosity { shear: mu, bulk: 0.0 }, gas: PhaseViscosity { shear: mu * env("MUG", 0.01), bulk: 0.0 }, thin_gas: ThinGas::Bounded }),
        scales: Scales { pressure: 1e4, density: 1e3 },
        ..FluidSetup::new(domain, n, sides)
    };
    let jump = tension() * if axial { 2.0 } else { 1.0 };
    let state = |phase, density, pressure| PhaseState { phase, density, pressure, velocity: [0.0; 2] };
    let sign = if gas_inside { 1.0 } else { -1.0 };
    let gas = state(Phase::Gas, gas_density, pg);
    let liquid = state(Phase::Liquid, 1000.0, pg - sign * jump);
    let (inner, ambient) = if gas_inside { (gas, liquid) } else { (liquid, gas) };
    let h = 1.0 / cells as f64;
    let centre = if mode == "rest" { [0.3 * h, if axial { 0.0 } else { 0.4 * h }] } else { [env("OFF", 0.0) * h, 0.0] };
    let initial = InitialCondition {
        ambient, pressure: InitialPressure::Uniform,
        regions: vec![Region { shape: Shape::Sphere { centre, radius: 1.0 }, state: inner }],
        pulses: vec![],
    };
    let mut fluid = FluidSolver::<16>::new(&setup, &initial).unwrap();
    let cfl = env("CFL", 0.45);
    if mode == "rest" {
        let end = env("END", 1.0);
        let mut line = String::new();
        let mut next = 0.05;
        let mut times = vec![0.05, 0.2, 0.5, 1.0, 2.0, 4.0]; times.retain(|t| *t <= end);
        for t in times {
            while fluid.time() < t * (1.0 - 1e-12) {
                let dt = fluid.time_step_limit(cfl).min(t - fluid.time());
                fluid.step(dt).unwrap();
            }
            let (mut fastest, mut place, mut l1, mut vol) = (0.0_f64, [0.0; 2], 0.0, 0.0);
            let mut sums = [[0.0; 2]; 2];
            let mut worst = 0.0_f64;
            each_cell(&fluid, |x, w, a| {
                let v = w.v_z.hypot(w.v_r);
                if v > fastest { fastest = v; place = x; }
                let x1 = if axial { x[1] } else { 1.0 };
                l1 += v * a * x1; vol += a * x1;
                if w.phi < 1e-6 || w.phi > 1.0 - 1e-6 {
                    let s = &mut sums[usize::from(w.phi > 0.5)];
                    *s = [s[0] + 1.0, s[1] + w.pressure];
                }
            });
            let mean = |[c, s]: [f64; 2]| s / c;
            let off = 100.0 * ((mean(sums[1]) - mean(sums[0])).abs() / jump - 1.0);
            line += &format!(" [{t}: u {fastest:.2e} at {:.2} {:.2}, L1 {:.1e}, jump {off:+.3}%]", place[0], place[1], l1 / vol);
        }
        println!("{line}");
        if let Ok(path) = std::env::var("DUMP") {
            let mut rows = vec![];
            each_cell(&fluid, |x, w, _| rows.push(format!("{} {} {} {} {} {}", x[0], x[1], w.phi, w.v_z, w.v_r, w.pressure)));
            std::fs::write(path, rows.join("\n")).unwrap();
        }
        return;
    }
    // Oscillation
    let densities = if gas_inside { [gas_density, 1000.0] } else { [1000.0, gas_density] };
    let lamb = (24.0 * tension() / (3.0 * densities[0] + 2.0 * densities[1])).sqrt();
    let height = env("HEIGHT", 0.05);
    let rate = height * lamb;
    for slot in 0..fluid.mesh().blocks() {
        let id = fluid.mesh().tree().leaves()[slot];
        for cell in 0..256 {
            let [z, r] = fluid.mesh().centre(id, cell % 16, cell / 16);
            let widths = fluid.mesh().widths(id.level);
            let v = mean_velocity([z, r], widths, [gas_density, 1000.0], |z, r| {
                let z = z - centre[0];
                let s = z.hypot(r);
                let inside = s < 1.0;
                (inside != gas_inside, if inside { [rate * z, -0.5 * rate * r] } else {
                    let (p2, per) = ((3.0 * z * z - s * s) / (2.0 * s * s), -rate / 3.0 / s.powi(5));
                    [per * (3.0 * z - z - 5.0 * z * p2), per * (-r - 5.0 * r * p2)]
                })
            });
            let block = fluid.state_mut().block_mut(slot);
            let rho = block[cell];
            block[256 + cell] = rho * v[0];
            block[512 + cell] = rho * v[1];
            block[768 + cell] += 0.5 * rho * (v[0] * v[0] + v[1] * v[1]);
        }
    }
    let period = std::f64::consts::TAU / lamb;
    let end = env("PERIODS", 2.0) * period;
    let start = moment(&fluid, centre[0]);
    let mut series = vec![];
    let mut steps = 0;
    // Amplitude per height: volume integral of s^2 P2 over a thin shell: (R^5/5 ...)
    let scale = if gas_inside { 1.0 } else { -1.0 } * (2.0 / 5.0);
    while fluid.time() < end {
        fluid.step_at(cfl).unwrap();
        steps += 1;
        series.push([fluid.time(), (moment(&fluid, centre[0]) - start) / scale / height]);
    }
    if let Ok(path) = std::env::var("SERIES") {
        let rows: Vec<String> = series.iter().map(|[t, y]| format!("{t} {y}")).collect();
        std::fs::write(path, rows.join("\n")).unwrap();
    }
    for periods in [0.75, 1.0, 1.5, 2.0, 4.0] {
        if periods * period > end * 1.0001 { break; }
        let part: Vec<[f64; 2]> = series.iter().copied().filter(|[t, _]| *t <= periods * period * 1.0001).collect();
        let (omega, beta, resid) = fit(&part, lamb);
        print!("[{periods}T: w/lamb {:.4}, beta/w {:+.4}, resid {:.3}] ", omega / lamb, beta / omega, resid);
    }
    println!("steps {steps}");
}

fn tilt() {
    let sharp = text("KIND", "sharp") != "mixture";
    let cells = env("CELLS", 32.0) as usize;
    let pi = env("PI", 4e5);
    let (rg, pg) = (env("RHOG", 10.0), env("PG", 1e4));
    let h = 1.0 / cells as f64;
    let off = env("OFF", 0.0) * h;
    let slope = env("SLOPE", 1.0); // liquid where z*slope + r mod 1 in [0.25, 0.75)
    let domain = Domain { geometry: Geometry::Planar, z: [0.0, 1.0], r: [0.0, 1.0] };
    let setup = FluidSetup {
        model: if text("KIND", "") == "allaire" { Model::Allaire } else if sharp { Model::FiveEquation } else { Model::SaurelAbgrall },
        sharpening: if sharp { Sharpening::Thinc } else { Sharpening::None },
        riemann: RiemannSolver::NAMES.iter().find(|(n, _)| *n == text("RIEMANN", "hllc")).unwrap().1,
        limiter: Limiter::NAMES.iter().find(|(n, _)| *n == text("LIMITER", "mc")).unwrap().1,
        liquid: StiffenedGas { gamma: 4.4, pi }.into(),
        surface_tension: Some(SurfaceTension { coefficient: tension(), density: 1000.0, may_touch_walls: false }),
        scales: Scales { pressure: 1e4, density: 1e3 },
        ..FluidSetup::new(domain, [cells, cells], [Boundary::Periodic; 4])
    };
    let state = |phase, density, pressure| PhaseState { phase, density, pressure, velocity: [0.0; 2] };
    let gas = state(Phase::Gas, rg, pg);
    let initial = InitialCondition { ambient: gas, pressure: InitialPressure::Uniform,
        regions: vec![Region { shape: Shape::Box { z: [0.3, 0.5], r: [0.3, 0.5] }, state: state(Phase::Liquid, 1000.0, pg) }], pulses: vec![] };
    let mut fluid = FluidSolver::<16>::new(&setup, &initial).unwrap();
    let noise = env("NOISE", 1e-6);
    let mut seed = 12345_u64;
    for slot in 0..fluid.mesh().blocks() {
        let id = fluid.mesh().tree().leaves()[slot];
        for cell in 0..256 {
            let [z, r] = fluid.mesh().centre(id, cell % 16, cell / 16);
            let m = 64;
            let mut inside = 0;
            for a in 0..m { for b in 0..m {
                let x = z + ((a as f64 + 0.5) / m as f64 - 0.5) * h;
                let y = r + ((b as f64 + 0.5) / m as f64 - 0.5) * h;
                let s = (x * slope + y * env("B", 1.0) + off - env("DISP", 0.0) * (std::f64::consts::TAU * (x - slope * y)).cos()).rem_euclid(1.0);
                if s >= 0.25 && s < 0.75 { inside += 1; }
            } }
            let phi = 1.0 - inside as f64 / (m * m) as f64;
            let block = fluid.state_mut().block_mut(slot);
            let rho = phi * rg + (1.0 - phi) * 1000.0;
            let mut rand = || { seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407); (seed >> 33) as f64 / 2f64.powi(31) - 0.5 };
            block[cell] = rho;
            block[256 + cell] = rho * noise * rand();
            block[512 + cell] = rho * noise * rand();
            block[768 + cell] = phi * pg / 0.4 + (1.0 - phi) * (pg + 4.4 * pi) / 3.4;
            block[1024 + cell] = phi;
            if sharp { block[1280 + cell] = phi * rg; }
        }
    }
    let cfl = env("CFL", 0.45);
    if env("HEIGHT", 0.0) > 0.0 {
        let size = (1.0 + slope * slope).sqrt();
        let k = std::f64::consts::TAU * size;
        let omega = (tension() * k.powi(3) / ((1000.0 + rg) * (std::f64::consts::FRAC_PI_2).tanh())).sqrt();
        let height = env("HEIGHT", 0.0) * std::f64::consts::TAU / k; // share of the wavelength
        let flow = env("FLOW", 1.0);
        let a = flow * height * omega / (std::f64::consts::FRAC_PI_2).cosh();
        for slot in 0..fluid.mesh().blocks() {
            let id = fluid.mesh().tree().leaves()[slot];
            for cell in 0..256 {
                let [z, r] = fluid.mesh().centre(id, cell % 16, cell / 16);
                let v = mean_velocity([z, r], [h, h], [rg, 1000.0], |z, r| {
                    let s = (z * slope + r + off).rem_euclid(1.0);
                    let y = (if s >= 0.25 && s < 0.75 { s - 0.5 } else if s >= 0.75 { s - 1.0 } else { s }) / size;
                    let phase = std::f64::consts::TAU * (z - slope * r);
                    let (n, t) = (a * (k * y).cosh() * phase.cos(), -a * (k * y).sinh() * phase.sin());
                    (s >= 0.25 && s < 0.75, [(n * slope + t) / size, (n - t * slope) / size])
                });
                let block = fluid.state_mut().block_mut(slot);
                let rho = block[cell];
                block[256 + cell] = rho * v[0];
                block[512 + cell] = rho * v[1];
                block[768 + cell] += 0.5 * rho * (v[0] * v[0] + v[1] * v[1]);
            }
        }
        let amplitude = |fluid: &FluidSolver<16>| { let mut sum = 0.0; each_cell(fluid, |[z, r], w, a| {
            let s = (z * slope + r + off).rem_euclid(1.0);
            sum += w.phi * (std::f64::consts::TAU * (z - slope * r)).cos() * a * if s < 0.5 { 1.0 } else { -1.0 };
        }); sum };
        let flow_of = |fluid: &FluidSolver<16>| { let (mut sum, mut norm) = (0.0, 0.0); each_cell(fluid, |[z, r], w, _| {
            let s = (z * slope + r + off).rem_euclid(1.0);
            if (s - 0.5).abs() < 0.12 {
                let f = (k * (s - 0.5) / size).cosh() * (std::f64::consts::TAU * (z - slope * r)).cos();
                sum += f * (w.v_z * slope + w.v_r) / size; norm += f * f;
            }
        }); sum / norm };
        let period = std::f64::consts::TAU / omega;
        let end = env("PERIODS", 2.0) * period;
        let mut series = vec![];
        let mut flows = vec![];
        let mut steps = 0;
        while fluid.time() < end { fluid.step_at(cfl).unwrap(); steps += 1; series.push([fluid.time(), amplitude(&fluid) / height]); flows.push(flow_of(&fluid)); }
        if let Ok(path) = std::env::var("DUMP") {
            let mut rows = vec![];
            each_cell(&fluid, |x, w, _| rows.push(format!("{} {} {} {} {} {}", x[0], x[1], w.phi, w.v_z, w.v_r, w.pressure)));
            std::fs::write(path, rows.join("\n")).unwrap();
            println!("a {a} k {k} omega {omega} height {height}");
        }
        if let Ok(path) = std::env::var("SERIES") {
            let rows: Vec<String> = series.iter().zip(&flows).map(|([t, y], f)| format!("{} {} {}", t * omega, y * height / size, f * std::f64::consts::FRAC_PI_2.cosh() / omega)).collect();
            std::fs::write(path, rows.join("\n")).unwrap();
        }
        for periods in [1.0, 2.0, 4.0] {
            if periods * period > end * 1.0001 { break; }
            let part: Vec<[f64; 2]> = series.iter().copied().filter(|[t, _]| *t <= periods * period * 1.0001).collect();
            let (w, beta, resid) = fit(&part, omega);
            print!("[{periods}T: w {:.4}, beta/w {:+.4}, resid {:.3}] ", w / omega, beta / w, resid);
        }
        println!("cells/wavelength {:.1} steps {steps}", cells as f64 / size);
        return;
    }
    let mut line = String::new();
    for t in [0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0] {
        if t > env("END", 1.0) { break; }
        while fluid.time() < t * (1.0 - 1e-12) { let dt = fluid.time_step_limit(cfl).min(t - fluid.time()); fluid.step(dt).unwrap(); }
        let (mut f, mut l1) = (0.0_f64, 0.0);
        each_cell(&fluid, |_, w, a| { let v = w.v_z.hypot(w.v_r); f = f.max(v); l1 += v * a; });
        line += &format!("[{t}: {f:.1e} {l1:.1e}] ");
    }
    println!("{line}");
    if let Ok(path) = std::env::var("DUMP") {
        let mut rows = vec![];
        each_cell(&fluid, |x, w, _| rows.push(format!("{} {} {} {} {} {}", x[0], x[1], w.phi, w.v_z, w.v_r, w.pressure)));
        std::fs::write(path, rows.join("\n")).unwrap();
    }
}

fn wave() {
    let sharp = text("KIND", "sharp") != "mixture";
    let cells = env("CELLS", 32.0) as usize; // per wavelength
    let tilt = env("TILT", 0.0) != 0.0;
    let pi = env("PI", 4e5);
    let gas_density = env("RHOG", 10.0);
    let pg = env("PG", 1e4);
    let h = 1.0 / cells as f64;
    let off = env("OFF", 0.0) * h;
    let (domain, n) = if tilt { unimplemented!() } else {
        (Domain { geometry: Geometry::Planar, z: [0.0, 1.0], r: [-1.0, 1.0] }, [cells, 2 * cells])
    };
    let sides = [Boundary::Periodic, Boundary::Periodic, Boundary::Wall, Boundary::Wall];
    let setup = FluidSetup {
        model: if text("KIND", "") == "allaire" { Model::Allaire } else if sharp { Model::FiveEquation } else { Model::SaurelAbgrall },
        sharpening: if sharp { Sharpening::Thinc } else { Sharpening::None },
        riemann: RiemannSolver::NAMES.iter().find(|(n, _)| *n == text("RIEMANN", "hllc")).unwrap().1,
        limiter: Limiter::NAMES.iter().find(|(n, _)| *n == text("LIMITER", "mc")).unwrap().1,
        liquid: StiffenedGas { gamma: 4.4, pi }.into(),
        surface_tension: Some(SurfaceTension { coefficient: tension(), density: 1000.0, may_touch_walls: false }),
        scales: Scales { pressure: 1e4, density: 1e3 },
        ..FluidSetup::new(domain, n, sides)
    };
    let state = |phase, density, pressure| PhaseState { phase, density, pressure, velocity: [0.0; 2] };
    let gas = state(Phase::Gas, gas_density, pg);
    let liquid = state(Phase::Liquid, 1000.0, pg);
    let initial = InitialCondition {
        ambient: gas, pressure: InitialPressure::Uniform,
        regions: vec![Region { shape: Shape::Box { z: [-1.0, 2.0], r: [-2.0, off] }, state: liquid }],
        pulses: vec![],
    };
    let mut fluid = FluidSolver::<16>::new(&setup, &initial).unwrap();
    let k = std::f64::consts::TAU;
    let omega = (tension() * k.powi(3) / (1000.0 + gas_density)).sqrt();
    let height = env("HEIGHT", 0.02);
    let a = height * omega;
    for slot in 0..fluid.mesh().blocks() {
        let id = fluid.mesh().tree().leaves()[slot];
        for cell in 0..256 {
            let [z, r] = fluid.mesh().centre(id, cell % 16, cell / 16);
            let v = mean_velocity([z, r], [h, h], [gas_density, 1000.0], |z, r| {
                let y = r - off;
                let e = (-k * y.abs()).exp();
                (y < 0.0, if y < 0.0 { [-a * e * (k * z).sin(), a * e * (k * z).cos()] } else { [a * e * (k * z).sin(), a * e * (k * z).cos()] })
            });
            let block = fluid.state_mut().block_mut(slot);
            let rho = block[cell];
            block[256 + cell] = rho * v[0];
            block[512 + cell] = rho * v[1];
            block[768 + cell] += 0.5 * rho * (v[0] * v[0] + v[1] * v[1]);
        }
    }
    let amplitude = |fluid: &FluidSolver<16>| { let mut s = 0.0; each_cell(fluid, |[z, r], w, a| s -= 2.0 * w.phi * (k * z).cos() * a); s };
    let period = k / omega;
    let end = env("PERIODS", 2.0) * period;
    let cfl = env("CFL", 0.45);
    let mut series = vec![];
    let mut steps = 0;
    while fluid.time() < end { fluid.step_at(cfl).unwrap(); steps += 1; series.push([fluid.time(), amplitude(&fluid) / height]); }
    if let Ok(path) = std::env::var("SERIES") {
        let rows: Vec<String> = series.iter().map(|[t, y]| format!("{t} {y}")).collect();
        std::fs::write(path, rows.join("\n")).unwrap();
    }
    for periods in [0.75, 1.0, 1.5, 2.0, 4.0] {
        if periods * period > end * 1.0001 { break; }
        let part: Vec<[f64; 2]> = series.iter().copied().filter(|[t, _]| *t <= periods * period * 1.0001).collect();
        let (w, beta, resid) = fit(&part, omega);
        print!("[{periods}T: w {:.4}, beta/w {:+.4}, resid {:.3}] ", w / omega, beta / w, resid);
    }
    println!("steps {steps}");
}

/// Density-weighted; the flow tells whether it is liquid.
fn mean_velocity([z, r]: [f64; 2], [hz, hr]: [f64; 2], [rg, rl]: [f64; 2], of: impl Fn(f64, f64) -> (bool, [f64; 2])) -> [f64; 2] {
    let m = 16;
    let (mut sum, mut mass) = ([0.0; 2], 0.0);
    for a in 0..m { for b in 0..m {
        let y = r + ((b as f64 + 0.5) / m as f64 - 0.5) * hr;
        let (is_liquid, v) = of(z + ((a as f64 + 0.5) / m as f64 - 0.5) * hz, y);
        let rho = if is_liquid { rl } else { rg };
        mass += rho; sum[0] += rho * v[0]; sum[1] += rho * v[1];
    } }
    sum.map(|s| s / mass)
}

/// Least squares y = c + d t + e^{-bt}(A cos wt + B sin wt).
fn fit(series: &[[f64; 2]], guess: f64) -> (f64, f64, f64) {
    let misfit = |w: f64, b: f64| -> f64 {
        let basis = |t: f64| { let e = (-b * t).exp(); [1.0, t, e * (w * t).cos(), e * (w * t).sin()] };
        let mut m = [[0.0; 5]; 4];
        for [t, y] in series { let f = basis(*t); for i in 0..4 { for j in 0..4 { m[i][j] += f[i] * f[j]; } m[i][4] += f[i] * y; } }
        for i in 0..4 { let p = m[i][i]; for j in i..5 { m[i][j] /= p; } for k in 0..4 { if k != i { let q = m[k][i]; for j in i..5 { m[k][j] -= q * m[i][j]; } } } }
        let x = [m[0][4], m[1][4], m[2][4], m[3][4]];
        series.iter().map(|[t, y]| { let f = basis(*t); let r = y - (0..4).map(|i| x[i] * f[i]).sum::<f64>(); r * r }).sum::<f64>()
    };
    // Pattern search.
    let (mut w, mut b, mut step) = (guess, 0.0, 0.05 * guess);
    let mut best = misfit(w, b);
    while step > 1e-6 * guess {
        let mut moved = false;
        for [dw, db] in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0]] {
            let m = misfit(w + dw * step, b + db * step);
            if m < best { best = m; w += dw * step; b += db * step; moved = true; break; }
        }
        if !moved { step *= 0.5; }
    }
    (w, b, (best / series.len() as f64).sqrt())
}
