use fluid::*;
use mesh::*;
fn main() {
    let st = |phase, density, pressure| PhaseState { phase, density, pressure, velocity: [0.0; 2] };
    let initial = InitialCondition {
        ambient: st(Phase::Liquid, 1000.0, 5e7),
        regions: vec![Region {
            shape: Shape::Sphere { centre: [0.03, 0.0], radius: 0.01 },
            state: st(Phase::Gas, 0.0266, 2118.0),
        }],
        pulses: vec![],
    };
    fn run<const N: usize>(initial: &InitialCondition, cells: usize, limiter: Limiter) {
        let setup = FluidSetup {
            domain: Domain { geometry: Geometry::Axisymmetric, z: [0.01, 0.06], r: [0.0, 0.05] },
            coarsest: [cells, cells],
            levels: 0,
            liquid: StiffenedGas { gamma: 7.15, pi: 3e8 },
            gas: StiffenedGas { gamma: 1.4, pi: 0.0 },
            model: Model::SaurelAbgrall,
            riemann: RiemannSolver::Hllc,
            limiter,
            boundaries: [Boundary::Wall, Boundary::NonReflecting, Boundary::Axis, Boundary::NonReflecting],
            inflow: None,
        };
        let mut s = FluidSolver::<N>::new(&setup, &initial).unwrap();
        for _ in 0..20 {
            let dt = s.time_step_limit(0.45);
            s.step(dt).unwrap();
        }
        let n = 20;
        let t = std::time::Instant::now();
        for _ in 0..n {
            let dt = s.time_step_limit(0.45);
            s.step(dt).unwrap();
        }
        let e = t.elapsed().as_secs_f64();
        println!("N={N} {limiter:?} {:.1} ns/cell/step", e / n as f64 / s.mesh().cells() as f64 * 1e9);
    }
    let threads: usize = std::env::args().nth(1).map(|a| a.parse().unwrap()).unwrap_or(1);
    let cells: usize = std::env::args().nth(2).map(|a| a.parse().unwrap()).unwrap_or(512);
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| {
        run::<16>(&initial, cells, Limiter::Minmod);
        run::<32>(&initial, cells, Limiter::Minmod);
        run::<8>(&initial, cells, Limiter::Minmod);
        run::<16>(&initial, cells, Limiter::Mc);
        run::<16>(&initial, cells, Limiter::Minmod);
    });
}
