//! The solid alone, against exact solutions: a load on its surface (Lamb's problem), a spherical wave about the axis.
//! Numbers of the exact solutions: Hankel–Laplace integrals, d'Alembert; the whole tables are scripts/reference_tables.py's.

use cav::run::process::session::{Session, Solvers};
use cav::run::process::stop::Stop;
use cav::run::side::fluid_side::Turn;
use solid::ElasticState;

use crate::fixture::{grid, solid};
use crate::harness::{STEEL, at, case};

/// Steel from −`depth` to 0 and to `width`, in square cells; `rest` are further tables.
fn steel(end: f64, depth: f64, width: f64, cells: [usize; 2], rest: &str) -> String {
    let body = solid(&grid([-depth, 0.0], width, cells), STEEL);
    format!("[time]\nend = {end:?}\n{body}adapt = false\n{rest}")
}

/// Runs a case of a solid alone; `look` sees it after every step.
fn run(text: &str, mut look: impl FnMut(f64, &dyn Fn([f64; 2]) -> ElasticState)) {
    let (case, stop) = (case(text), Stop::default());
    let mut session = Session::new(&case, None, Solvers::default()).expect("the solid");
    while session.step(&stop).expect("a step") == Turn::Continues {
        let solver = session.solid().expect("the solid").solver();
        look(solver.time(), &|point| solver.sample(point).expect("within the solid"));
    }
}

#[test]
fn a_load_makes_the_waves_of_lambs_problem() {
    // −P₀ exp(−(r/b)²) exp(−((t − t₀)/τ)²) with P₀ = 1 MPa, b = 1 mm, t₀ = 1.65 µs, τ = 0.3 µs.
    let history: Vec<String> = (0..=400)
        .map(|k| {
            let t = f64::from(k) * 1e-8;
            format!("[{t:?}, {:?}]", (-((t - 1.65e-6) / 3e-7).powi(2)).exp())
        })
        .collect();
    let load = format!(
        "[coupling]\nscheme = \"load\"\n[coupling.load]\namplitude = 1e6\nradius = 1e-3\nhistory = [{}]\n",
        history.join(", ")
    );
    // 10 cells per radius of the load.
    let text = steel(3.65e-6, 0.0128, 0.0128, [128, 128], &load);
    let (surface, below) = ([0.0, 3e-3], [-3e-3, 4e-3]);
    let (mut v_surface, mut rr_surface, mut v_below, mut zz_below) = (vec![], vec![], vec![], vec![]);
    run(&text, |time, sample| {
        let (above, inside) = (sample(surface), sample(below));
        v_surface.push([time, above.v_z]);
        rr_surface.push([time, above.stress_rr]);
        v_below.push([time, inside.v_z]);
        zz_below.push([time, inside.stress_zz]);
    });
    // Every 0.2 µs from 2 µs on; the Rayleigh wave passes at 2.9 µs.
    let exact: [(_, [f64; 7]); 4] = [
        (
            &v_surface,
            [-5.060087e-4, -1.534778e-3, -2.141837e-3, -9.030532e-4, 1.277905e-3, 2.042569e-3, 1.276858e-3],
        ),
        (
            &rr_surface,
            [7.945915e4, 1.266417e5, 4.890044e4, -9.678697e4, -1.319397e5, -5.394879e4, 1.175274e4],
        ),
        (
            &v_below,
            [-1.443874e-4, -3.228248e-4, -2.078070e-4, -2.139187e-4, -9.765168e-4, -1.124887e-3, 1.088142e-4],
        ),
        (
            &zz_below,
            [-5.598651e3, -1.026219e4, 2.149575e3, 1.076284e4, -2.039287e4, -4.292453e4, -1.852970e4],
        ),
    ];
    for (series, exact) in exact {
        let largest = exact.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        let worst = exact.iter().enumerate().fold(0.0_f64, |worst, (k, exact)| {
            worst.max((at(series, 2e-6 + 2e-7 * k as f64, 1) - exact).abs())
        });
        eprintln!("Lamb's problem, 10 cells per radius: off by {:.4} of the largest value", worst / largest);
        assert!(worst < 0.05 * largest, "{worst:e} of {largest:e}");
    }
}

#[test]
fn a_wave_that_has_passed_the_axis_leaves_no_stress_behind() {
    // 10 cells per width of u = ∇(Φ exp(−R²/a²)): the wave has left the axis after 3 a/c₁, its stress there with it.
    let wave = "[[solid.pulse]]\ncentre = [-8e-3, 0.0]\nwidth = 1e-3\namplitude = 1e-12\n[coupling]\nscheme = \"none\"\n";
    let text = steel(9e-7, 0.016, 0.008, [160, 80], wave);
    let (mut largest, mut last) = (0.0_f64, f64::NAN);
    run(&text, |_, sample| {
        let state = sample([-8e-3, 0.0]);
        last = state.stress_rr.abs().max((state.stress_rr - state.stress_phiphi).abs());
        largest = largest.max(state.stress_rr.abs());
    });
    eprintln!("left at the centre: {:.2e} of the largest stress", last / largest);
    // Where the terms with 1/r are means of different kinds, a stress of first order stays.
    assert!(last < 1e-3 * largest, "{last:e} of {largest:e}");
}
