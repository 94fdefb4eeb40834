//! The displacement of a solid's surface: under a load that stays, against the elastic half-space; when it has gone, back to nothing.

use cav::output::RunDirectory;
use cav::run::process::drive::{Keeping, in_process};
use cav::run::process::session::{Session, Solvers};
use cav::run::process::stop::Stop;
use cav::run::record::conclusion::conclude;
use cav::run::record::surface::pit::{Profile, far};
use cav::run::side::fluid_side::Turn;
use mesh::Geometry;
use serde_json::{Map, Value};

use crate::harness::{STEEL, case};

/// Pressure on the axis, Pa, and radius of the load, m, below.
const AMPLITUDE: f64 = 1e6;
const RADIUS: f64 = 1e-3;
/// Width and depth of the domain, in radii of the load.
const WIDTH: usize = 16;

/// A load that rises within 3 µs, stays until 22 µs and goes within 3 µs, on cells of an eighth of its radius.
fn loaded(time: &str, more: &str) -> String {
    let [density, c1, c2] = STEEL;
    let cells = 8 * WIDTH;
    let size = WIDTH as f64 * RADIUS;
    // Without corners, that waves are long.
    let ramp = |from: f64, sign: f64, at: f64| {
        (0..=20).map(move |k| {
            let s = f64::from(k) / 20.0;
            let rise = s * s * (3.0 - 2.0 * s);
            format!("[{:?}, {:?}]", from + 3e-6 * s, at + sign * rise)
        })
    };
    let history: Vec<String> = ramp(0.0, 1.0, 0.0).chain(ramp(2.2e-5, -1.0, 1.0)).collect();
    format!(
        "[time]\n{time}\n[solid]\nz = [-{size:?}, 0.0]\nr = [0.0, {size:?}]\ncells = [{cells}, {cells}]\nadapt = false\n\
         material = {{ density = {density:?}, c1 = {c1:?}, c2 = {c2:?} }}\n{more}\
         [coupling]\nscheme = \"load\"\n[coupling.load]\namplitude = {AMPLITUDE:?}\nradius = {RADIUS:?}\n\
         history = [{}]\n",
        history.join(", ")
    )
}

/// Runs a case of a solid alone; `look` sees time and u_z along the surface after every step.
fn run(text: &str, mut look: impl FnMut(f64, &[[f64; 2]])) -> (f64, Map<String, Value>) {
    let (case, stop) = (case(text), Stop::default());
    let mut session = Session::new(&case, None, Solvers::default()).expect("the solid");
    let result = loop {
        let turn = session.step(&stop).expect("a step");
        let solid = session.solid().expect("the solid");
        let surface = solid.record().and_then(|record| record.surface()).expect("a surface");
        look(solid.solver().time(), &surface.displacement().profile());
        if turn != Turn::Continues {
            break Ok(turn);
        }
    };
    (session.line().time, session.summary(&result))
}

/// Young's modulus and Poisson's ratio.
fn young_and_poisson() -> [f64; 2] {
    let [density, c1, c2] = STEEL;
    let mu = density * c2 * c2;
    let lambda = density * c1 * c1 - 2.0 * mu;
    [mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu), 0.5 * lambda / (lambda + mu)]
}

/// u_r(r) of the half-space under p₀ exp(−r²/a²): −(1 − 2ν)(1 + ν)/E p₀ a²/(2r) (1 − exp(−r²/a²)).
fn half_space_radially(r: f64) -> f64 {
    let [young, poisson] = young_and_poisson();
    let load = AMPLITUDE * RADIUS * RADIUS / (2.0 * r) * (1.0 - (-(r / RADIUS).powi(2)).exp());
    -(1.0 - 2.0 * poisson) * (1.0 + poisson) / young * load
}

/// exp(−x) I₀(x), by its integral.
fn scaled_bessel(x: f64) -> f64 {
    let count = 2000;
    let angle = |k: i32| (f64::from(k) + 0.5) * std::f64::consts::PI / f64::from(count);
    (0..count).map(|k| (x * (angle(k).cos() - 1.0)).exp()).sum::<f64>() / f64::from(count)
}

/// −u_z(r) of the half-space under p₀ exp(−r²/a²): (1 − ν²)/E p₀ a √π exp(−x) I₀(x), x = r²/(2a²).
fn half_space(r: f64) -> f64 {
    let [young, poisson] = young_and_poisson();
    let x = 0.5 * (r / RADIUS).powi(2);
    (1.0 - poisson * poisson) / young * AMPLITUDE * RADIUS * std::f64::consts::PI.sqrt() * scaled_bessel(x)
}

#[test]
fn a_load_that_stays_indents_the_half_space_and_leaves_nothing_when_it_has_gone() {
    let mut under_load: Option<Vec<[f64; 2]>> = None;
    let mut early: Option<Vec<[f64; 2]>> = None;
    let mut left: Option<Vec<f64>> = None;
    let (end, summary) = run(&loaded("end = \"settled\"\nlongest = 1e-4", ""), |time, profile| {
        if time < 8e-6 {
            early = Some(profile.to_vec());
        }
        if time < 2.2e-5 {
            under_load = Some(profile.to_vec());
        } else {
            left = Some(profile.iter().map(|u| u[0]).collect());
        }
    });
    let under_load = under_load.expect("it was loaded");
    let displacement: Vec<f64> = under_load.iter().map(|u| u[0]).collect();
    let count = displacement.len();
    let width = WIDTH as f64 * RADIUS / count as f64;
    let centre = |k: usize| (k as f64 + 0.5) * width;
    let profile =
        Profile { begin: 0.0, width, geometry: Geometry::Axisymmetric, displacement: &displacement };
    let exact: Vec<f64> = (0..count).map(|k| -half_space(centre(k))).collect();
    let expected = Profile { displacement: &exact, ..profile };
    let (far, far_expected) = (far(&displacement), far(&exact));
    let scale = half_space(0.0);
    let mut worst = 0.0_f64;
    for k in (0..count).filter(|k| centre(*k) < 4.0 * RADIUS) {
        worst = worst.max(((displacement[k] - far) - (exact[k] - far_expected)).abs());
    }
    let (pit, known) = (profile.pit(), expected.pit());
    eprintln!(
        "under load: off by {:.4} of the depth; on the axis {:.4e} m, expected {:.4e} m; far {far:.3e} m, {far_expected:.3e} m",
        worst / scale,
        pit.depth_axis,
        known.depth_axis
    );
    assert!(worst < 0.025 * scale, "{worst:e} of {scale:e}");

    // What the surface's cells creep under a load that stays is small only early on; velocities of cells instead of star states would
    // be off by a multiple of it.
    let early = early.expect("it has begun");
    let radial = |k: usize| (early[k][1], half_space_radially(centre(k)));
    let near = || (0..count).filter(|k| centre(*k) < 2.0 * RADIUS).map(radial);
    let largest = near().fold(0.0_f64, |most, (_, exact)| most.max(exact.abs()));
    let worst = near().fold(0.0_f64, |most, (found, exact)| most.max((found - exact).abs()));
    eprintln!("radially: off by {:.4} of {largest:.3e} m", worst / largest);
    assert!(worst < 0.5 * largest, "{worst:e} of {largest:e}");

    let number = |key: &str| summary[key].as_f64().expect("a number");
    let left = left.expect("the run has ended");
    let left = Profile { displacement: &left, ..profile }.pit();
    eprintln!("still at {end:e} s: {:.4} of the depth is left", left.depth / scale);
    assert!(end < 9e-5 && summary["settled"] == true, "{end:e} s");
    assert!(number("surface_still") <= 0.01);
    // An elastic solid keeps no pit: neither drift nor waves make one.
    assert!(left.depth < 0.02 * scale, "{:e} m", left.depth);
    assert_eq!([number("pit_depth"), number("pit_volume")], [0.0; 2]);
    assert!((number("indentation_peak") / known.depth_axis - 1.0).abs() < 0.06);
}

#[test]
fn a_run_that_may_not_wait_for_the_surface_says_how_far_from_still_it_is() {
    let (end, summary) = run(&loaded("end = \"settled\"\nlongest = 2.4e-5", ""), |_, _| ());
    assert!((end / 2.4e-5 - 1.0).abs() < 1e-12);
    assert_eq!(summary["settled"], false);
    assert!(summary["surface_still"].as_f64().expect("a number") > 0.5);
}

#[test]
fn on_a_grid_that_adapts_and_steps_level_by_level_the_surface_goes_the_same_way() {
    let at_the_end = |time: &str, edit: &dyn Fn(String) -> String| {
        let mut last = Vec::new();
        run(&edit(loaded(time, "")), |_, profile| last = profile.to_vec());
        last
    };
    let uniform = at_the_end("end = 5e-6", &|text| text);
    let adapting = |text: String| {
        let coarse = text.replace(&format!("cells = [{0}, {0}]", 8 * WIDTH), "cells = [16, 16]\nlevels = 3");
        coarse.replace("adapt = false", "adapt = true\nepsilon = 1e-4")
    };
    let adaptive = at_the_end("end = 5e-6\nlocal_steps = true", &adapting);
    assert_eq!(uniform.len(), adaptive.len());
    for c in 0..2 {
        let largest = uniform.iter().fold(0.0_f64, |most, u| most.max(u[c].abs()));
        let apart = |k: &usize| (uniform[*k][c] - adaptive[*k][c]).abs();
        let worst = (0..uniform.len()).max_by(|a, b| apart(a).total_cmp(&apart(b))).expect("faces");
        let off = apart(&worst);
        eprintln!("component {c}: {:.4} of {largest:.3e} m apart, worst on face {worst}", off / largest);
        assert!(off < [0.02, 0.12][c] * largest, "component {c}: {off:e} of {largest:e}");
    }
}

#[test]
fn a_pulse_that_is_given_is_the_equivalent_load() {
    let (directory, [time, duration]) = (tempfile::tempdir().expect("a place"), [1.5e-6, 4e-7]);
    let history: Vec<String> = (0..=600)
        .map(|k| {
            let t = f64::from(k) * 5e-9;
            format!("[{t:?}, {:?}]", (-((t - time) / duration).powi(2)).exp())
        })
        .collect();
    let text = loaded("end = 3e-6", "");
    let text =
        format!("{}history = [{}]\n", text.split("history").next().expect("a head"), history.join(", "));
    let case = case(&text);
    let directory = RunDirectory::prepare(&directory.path().join("run"), false).expect("a directory");
    in_process(&case, &directory, Keeping::default(), &Stop::default(), &mut |_| {}).expect("a run");
    let whole = conclude(&directory, &case, None).expect("a summary");
    for (key, expected) in [
        ("load_amplitude", AMPLITUDE),
        ("load_radius", RADIUS),
        ("load_duration", duration),
        ("load_time", time),
    ] {
        let found = whole[key].as_f64().expect("a number");
        eprintln!("{key}: {found:.6e}, {expected:.6e}");
        assert!((found / expected - 1.0).abs() < 0.01, "{key}: {found:e}, {expected:e}");
    }
    assert!(whole["load_misfit"].as_f64().is_some_and(|misfit| misfit < 0.02));
}

#[test]
fn a_wall_at_rest_under_pressure_drifts_by_round_off_only() {
    let case = case(
        "[time]\nend = 1e-3\n[fluid]\nz = [0.0, 0.01]\nr = [0.0, 0.01]\ncells = [32, 32]\n\
         [fluid.liquid]\ngamma = 7.15\npi = 3e8\n[fluid.ambient]\ndensity = 1000.0\npressure = 5e7\n\
         [solid]\nz = [-0.01, 0.0]\nr = [0.0, 0.01]\ncells = [32, 48]\nmaterial = \"structural-steel\"\n",
    );
    let mut session = Session::new(&case, None, Solvers::default()).expect("both media");
    (0..2000).for_each(|_| assert_eq!(session.step(&Stop::default()).expect("a step"), Turn::Continues));
    let solid = session.solid().expect("the solid");
    let surface = solid.record().and_then(|record| record.surface()).expect("a surface");
    let farthest =
        surface.displacement().profile().iter().flatten().fold(0.0_f64, |most, u| most.max(u.abs()));
    let (time, steps) = (solid.solver().time(), solid.solver().steps());
    // Speeds of round-off, 1e-13 m/s: below 1e-13 m after a million steps of up to a microsecond.
    eprintln!("at rest: {farthest:.2e} m after {steps} steps, {time:.2e} s");
    assert!(farthest <= 1e-13 * time, "{farthest:e} m");
}
