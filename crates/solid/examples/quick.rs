use mesh::*;
use solid::*;
fn run<const N: usize>(cells: usize, limiter: Limiter) {
    let setup = SolidSetup {
        domain: Domain { geometry: Geometry::Axisymmetric, z: [-0.04, 0.01], r: [0.0, 0.05] },
        coarsest: [cells, cells],
        levels: 0,
        speeds: WaveSpeeds { density: 7800.0, c1: 5990.0, c2: 3458.0 },
        yield_strength: 250e6,
        limiter,
        boundaries: [Boundary::NonReflecting, Boundary::Free, Boundary::Axis, Boundary::NonReflecting],
    };
    let mut s = SolidSolver::<N>::new(setup, |[z, r]| ElasticState {
        stress_zz: 1e5 * (-((z + 0.01).powi(2) + r * r) / 1e-5).exp(),
        ..Default::default()
    })
    .unwrap();
    for _ in 0..20 {
        let dt = s.time_step_limit(0.45);
        s.step(dt).unwrap();
    }
    let n = 40;
    let t = std::time::Instant::now();
    for _ in 0..n {
        let dt = s.time_step_limit(0.45);
        s.step(dt).unwrap();
    }
    let e = t.elapsed().as_secs_f64();
    println!("N={N} {limiter:?} {:.1} ns/cell/step", e / n as f64 / s.mesh().cells() as f64 * 1e9);
}
fn main() {
    let threads: usize = std::env::args().nth(1).map(|a| a.parse().unwrap()).unwrap_or(1);
    let cells: usize = std::env::args().nth(2).map(|a| a.parse().unwrap()).unwrap_or(512);
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| {
        run::<16>(cells, Limiter::Minmod);
        run::<32>(cells, Limiter::Minmod);
        run::<16>(cells, Limiter::Mc);
        run::<16>(cells, Limiter::Minmod);
    });
}
