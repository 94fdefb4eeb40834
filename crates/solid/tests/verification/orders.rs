//! Orders of convergence for smooth elastic waves.
//!
//! Second order is asked as at least 1.9 without a limiter and 1.7 with MC, which flattens extrema. A scheme
//! whose predictor lacks the hoop terms gives 1.0 in the axisymmetric rows.

use std::f64::consts::TAU;

use mesh::{Domain, Limiter};
use solid::{ElasticState, SolidSetup, SolidSolver};

use crate::helpers::*;

const GRIDS: [usize; 3] = [32, 64, 128];

/// Runs a start on three grids with each limiter and checks the orders of velocities and stresses.
fn check(
    what: &str,
    base: impl Fn(usize) -> SolidSetup,
    exact: impl Fn([f64; 2], f64) -> ElasticState + Sync,
    end: f64,
) {
    // First order at every extremum with minmod: reported, and still far from a first-order scheme.
    for (limiter, least) in [(Limiter::None, 1.9), (Limiter::Mc, 1.7), (Limiter::Minmod, 1.3)] {
        let mut errors = [vec![], vec![]];
        for n in GRIDS {
            let setup = SolidSetup { limiter, ..base(n) };
            let mut solid = SolidSolver::<8>::new(setup, |x| exact(x, 0.0)).unwrap();
            run_to(&mut solid, end);
            errors[0].push(l1(&solid, |x| exact(x, end), velocity));
            errors[1].push(l1(&solid, |x| exact(x, end), stress));
        }
        for (errors, name) in errors.iter().zip(["velocity", "stress"]) {
            let label = format!("{what}, {limiter:?}, {name}");
            let order = order(&label, errors);
            assert!(order >= least, "{label}: order {order}");
        }
    }
}

fn lambda() -> f64 {
    STEEL.lambda()
}

fn mu() -> f64 {
    STEEL.shear_modulus()
}

/// The state of a plane wave along (n_z, n_r) in which particles move along (d_z, d_r) with the speed v.
fn plane(n: [f64; 2], d: [f64; 2], speed: f64, v: f64) -> ElasticState {
    let strain = |a: usize, b: usize| -0.5 * (n[a] * d[b] + n[b] * d[a]) * v / speed;
    let trace = strain(0, 0) + strain(1, 1);
    ElasticState {
        v_z: d[0] * v,
        v_r: d[1] * v,
        stress_zz: lambda() * trace + 2.0 * mu() * strain(0, 0),
        stress_zr: 2.0 * mu() * strain(0, 1),
        stress_rr: lambda() * trace + 2.0 * mu() * strain(1, 1),
        stress_phiphi: lambda() * trace,
    }
}

#[test]
fn plane_waves_cross_the_grid_obliquely() {
    let wave = [TAU, TAU];
    let number = wave[0].hypot(wave[1]);
    let n = wave.map(|k| k / number);
    for (what, speed, d) in [("P", STEEL.c1, n), ("S", STEEL.c2, [-n[1], n[0]])] {
        let exact = |[z, r]: [f64; 2], t: f64| {
            plane(n, d, speed, (wave[0] * z + wave[1] * r - number * speed * t).sin())
        };
        let end = TAU / (number * speed);
        check(&format!("oblique {what} wave, planar"), |n| setup(PLANAR, [n, n], PERIODIC), exact, end);
    }
}

/// Standing modes of a cylinder with frictionless walls, radius and length 1, J1(k) = 0:
/// u = grad φ with φ = J0(kr) cos(mz) cos ωt, or u = rot(ψ e_φ) with ψ = J1(kr) sin(mz) cos ωt.
fn mode([z, r]: [f64; 2], t: f64, shear: bool) -> ElasticState {
    let (k, m) = (J1_ZEROS[0], TAU / 2.0);
    let omega = if shear { STEEL.c2 } else { STEEL.c1 } * f64::hypot(k, m);
    let (s, c) = ((m * z).sin(), (m * z).cos());
    let (j0, j1, ratio) = (j0(k * r), j1(k * r), j1_over(k * r));
    // Displacements and strains: u_z, u_r, e_zz, e_zr, e_rr, e_φφ.
    let [u_z, u_r, zz, zr, rr, pp] = if shear {
        let km = k * m;
        [
            k * j0 * s,
            -m * j1 * c,
            km * j0 * c,
            0.5 * (m * m - k * k) * j1 * s,
            -km * (j0 - ratio) * c,
            -km * ratio * c,
        ]
    } else {
        let kk = k * k;
        [-m * j0 * s, -k * j1 * c, -m * m * j0 * c, k * m * j1 * s, -kk * (j0 - ratio) * c, -kk * ratio * c]
    };
    let (elastic, moving) = ((omega * t).cos(), -omega * (omega * t).sin());
    let volumetric = lambda() * (zz + rr + pp);
    ElasticState {
        v_z: u_z * moving,
        v_r: u_r * moving,
        stress_zz: (volumetric + 2.0 * mu() * zz) * elastic,
        stress_zr: 2.0 * mu() * zr * elastic,
        stress_rr: (volumetric + 2.0 * mu() * rr) * elastic,
        stress_phiphi: (volumetric + 2.0 * mu() * pp) * elastic,
    }
}

#[test]
fn standing_modes_of_a_cylinder() {
    for (what, speed, shear) in [("P", STEEL.c1, false), ("S", STEEL.c2, true)] {
        // Past a period, where neither velocity nor stress vanishes.
        let end = 1.15 * TAU / (speed * f64::hypot(J1_ZEROS[0], TAU / 2.0));
        let exact = |x: [f64; 2], t: f64| mode(x, t, shear);
        check(&format!("standing {what} mode in a cylinder"), |n| setup(AXIAL, [n, n], CYLINDER), exact, end);
    }
}

#[test]
fn a_spherical_p_wave() {
    // u = grad φ, φ = (g(R − ct) + g(R + ct))/2R, g = x Φ exp(−x²/a²): a displacement Φ exp(−R²/a²) let go.
    let (width, amplitude) = (1e-3, 1e-12);
    // g and its first three derivatives.
    let g = move |x: f64| {
        let (y, a) = (x / width, width);
        let bell = amplitude * (-y * y).exp();
        [
            x * bell,
            (1.0 - 2.0 * y * y) * bell,
            (4.0 * y * y - 6.0) * y / a * bell,
            (-8.0 * y.powi(4) + 24.0 * y * y - 6.0) / (a * a) * bell,
        ]
    };
    let exact = move |[z, r]: [f64; 2], t: f64| {
        let radius = z.hypot(r);
        let (near, far) = (g(radius - STEEL.c1 * t), g(radius + STEEL.c1 * t));
        let s: [f64; 4] = std::array::from_fn(|k| near[k] + far[k]);
        let rate = |k: usize| STEEL.c1 * (far[k + 1] - near[k + 1]);
        let first = 0.5 * (s[1] / radius - s[0] / radius.powi(2));
        let second = 0.5 * s[2] / radius - s[1] / radius.powi(2) + s[0] / radius.powi(3);
        let speed = 0.5 * (rate(1) / radius - rate(0) / radius.powi(2));
        let volumetric = lambda() * (second + 2.0 * first / radius);
        let radial = volumetric + 2.0 * mu() * second;
        let hoop = volumetric + 2.0 * mu() * first / radius;
        let (n_z, n_r) = (z / radius, r / radius);
        ElasticState {
            v_z: speed * n_z,
            v_r: speed * n_r,
            stress_zz: hoop + (radial - hoop) * n_z * n_z,
            stress_zr: (radial - hoop) * n_z * n_r,
            stress_rr: hoop + (radial - hoop) * n_r * n_r,
            stress_phiphi: hoop,
        }
    };
    // An independently computed point at t = 0.5 µs, on the axis at z = −8 mm.
    let far = exact([-8e-3, 1e-9], 5e-7);
    assert!((far.v_z / 2.362_064_315_11e-12 - 1.0).abs() < 1e-5, "{far:?}");
    assert!((far.stress_zz / 0.000_110_856_827_338 - 1.0).abs() < 1e-5, "{far:?}");
    // Half a space about the plane z = 0; at 0.5 µs the wave is a shell of 3 mm and has met no other side.
    let base = |n: usize| SolidSetup {
        domain: Domain { geometry: AXIAL, z: [-6e-3, 6e-3], r: [0.0, 6e-3] },
        ..setup(AXIAL, [2 * n, n], CYLINDER)
    };
    check("spherical P wave through the axis", base, exact, 5e-7);
}
