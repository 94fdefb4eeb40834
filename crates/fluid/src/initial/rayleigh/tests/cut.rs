//! Bubbles that the wall cuts, that touch it, that overlap.

use super::*;

/// d/R of a bubble at the wall, from a hemisphere to one that is clear of it.
const STAND_OFFS: [f64; 24] = [
    0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9,
    0.95, 0.99, 1.0, 1.01, 1.05,
];

/// The largest error on the surfaces that border on liquid, at angles that crowd together towards every edge.
fn error_on_surfaces(field: &RayleighField, spheres: &[[f64; 3]], wall: Option<f64>) -> f64 {
    let mut error = 0.0_f64;
    for (k, &[centre, radius, pressure]) in spheres.iter().enumerate() {
        let mut edges = vec![0.0, std::f64::consts::PI];
        let others =
            spheres.iter().map(|s| [s[0], s[1]]).chain(wall.map(|wall| [2.0 * wall - centre, radius]));
        for [z, other] in others {
            let d = z - centre;
            edges.push(
                ((d * d + radius * radius - other * other) / (2.0 * d * radius)).clamp(-1.0, 1.0).acos(),
            );
        }
        let angles = edges.iter().filter(|edge| edge.is_finite()).flat_map(|edge| {
            (0..260).flat_map(move |n| [1.0, -1.0].map(|side| edge + side * 3.0 * 0.9_f64.powi(n)))
        });
        for angle in angles.filter(|angle| (0.0..=std::f64::consts::PI).contains(angle)) {
            // A hair outside, so that it is not within.
            let s = radius * (1.0 + 1e-13);
            let point = [centre + s * angle.cos(), s * angle.sin()];
            let covered = (spheres.iter().enumerate())
                .any(|(j, other)| j != k && (point[0] - other[0]).hypot(point[1]) < other[1]);
            if !covered && wall.is_none_or(|wall| point[0] > wall) {
                error = error.max((field.pressure(point) - pressure).abs());
            }
        }
    }
    error
}

#[test]
fn every_stand_off_has_its_field() {
    let mut before = 0.5;
    for d in STAND_OFFS {
        let spheres = [[d, 1.0, 2e3]];
        let field = field(&spheres, Some(0.0));
        let error = error_on_surfaces(&field, &spheres, Some(0.0)) / (FAR - 2e3);
        // What it draws in of the liquid grows with the stand-off, from a hemisphere on.
        let charge = field.monopoles()[0] / (2e3 - FAR);
        eprintln!("d/R = {d}: error {error:.1e}, found {:.1e}; charge {charge:.12}", field.error());
        assert!(error < 1e-7 && field.error() < 1e-7, "d/R = {d}: {error:e} {:e}", field.error());
        assert!(charge > before - 1e-8 && charge < 0.75, "d/R = {d}: {charge}");
        before = charge;
    }
}

/// A hemisphere on the wall is half of a free bubble.
#[test]
fn a_hemisphere_has_the_field_of_the_sphere() {
    let field = field(&[[0.3, 0.5, 2e3]], Some(0.3));
    for s in [0.5_f64, 0.6, 1.7, 40.0] {
        for angle in [0.0_f64, 0.4, 1.0, 1.57] {
            let s = s * (1.0 + 1e-12);
            let got = field.pressure([0.3 + s * angle.cos(), s * angle.sin()]);
            let want = FAR + (2e3 - FAR) * 0.5 / s;
            assert!((got - want).abs() < 1e-7 * FAR, "s = {s}, angle {angle}: {got} {want}");
        }
    }
    assert!((field.monopoles()[0] - 0.25 * (2e3 - FAR)).abs() < 1e-7 * FAR);
}

/// Where the liquid's edge at the wall, with its image, is π/n, the images of the images end after n charges in the plane of the
/// wall (Maxwell 1873, arts. 165 f.); with n = 2 they are R and R in the centres and −R/√2 between them.
#[test]
fn edges_of_whole_parts_of_a_half_turn_have_as_many_image_charges() {
    for n in 2..13 {
        let d = (0.5 * std::f64::consts::PI / f64::from(n)).cos();
        let (mut charges, mut charge, mut depth) = (Vec::new(), 2e3 - FAR, 0.0);
        while d - depth > 1e-9 {
            charges.push((charge, depth));
            let distance = 2.0 * d - depth;
            (charge, depth) = (-charge / distance, 1.0 / distance);
        }
        // That on the wall is its own image.
        charges.push((0.5 * charge, d));
        assert_eq!(charges.len(), n as usize, "charges of n = {n}");
        let field = field(&[[d, 1.0, 2e3]], Some(0.0));
        let edge = (1.0 - d * d).sqrt();
        for [z, r] in
            [[0.0, edge + 1e-3], [0.0, edge + 0.1], [0.01, edge + 0.3], [d, 1.01], [d + 1.5, 0.1], [0.2, 1.9]]
        {
            let potential = |(charge, depth): &(f64, f64)| {
                charge * (1.0 / (z - d + depth).hypot(r) + 1.0 / (z + d - depth).hypot(r))
            };
            let inside = (z - d).hypot(r) < 1.0;
            let sum: f64 = charges.iter().map(potential).sum();
            let want = if inside { 2e3 } else { FAR + sum };
            let got = field.pressure([z, r]);
            assert!((got - want).abs() < 1e-7 * FAR, "n = {n}, ({z}, {r}): {got} {want}");
        }
        let sum: f64 = charges.iter().map(|(charge, _)| charge).sum();
        assert!((field.monopoles()[0] - sum).abs() < 1e-7 * FAR, "charge of n = {n}");
    }
}

/// Two equal spheres in contact have the capacitance 2R ln 2, and so each has half of it.
#[test]
fn a_bubble_that_touches_the_wall_has_the_charge_of_spheres_in_contact() {
    let want = std::f64::consts::LN_2 * (2e3 - FAR);
    for spheres in [&[[1.0, 1.0, 2e3]][..], &[[1.0, 1.0, 2e3], [3.0, 1.0, 2e3]]] {
        // Above the wall, or in contact with another one in free space.
        let field = field(spheres, (spheres.len() == 1).then_some(0.0));
        for charge in field.monopoles() {
            assert!((charge - want).abs() < 1e-7 * FAR, "{charge} {want}");
        }
    }
}

/// Cut by the wall, overlapping, one in another, in contact, free at another pressure.
#[test]
fn bubbles_meet_each_other_and_the_wall() {
    let many = [[0.4, 1.0, 2e3], [1.5, 0.6, 2e3], [0.6, 0.3, 2e3], [2.3, 0.2, 2e3], [4.1, 1.0, 3e5]];
    let spheres = many.map(|[z, radius, pressure]| [z + 0.3, radius, pressure]);
    let field = field(&spheres, WALL);
    let error = error_on_surfaces(&field, &spheres, WALL) / 2e5;
    eprintln!("error {error:e}, found {:e}", field.error());
    assert!(error < 1e-6 && field.error() < 1e-6, "{error:e}");
    check_harmonic(&field, &[[0.5, 1.2], [1.2, 1.0], [2.0, 0.7], [2.9, 0.5], [6.5, 2.0]], 1e-3);
    let charges = field.monopoles();
    assert!(charges[2] == 0.0 && charges[4] > 0.0, "{charges:?}");
    // Far away p − p∞ is the charges' and their images'.
    let far = field.pressure([0.3, 1e6]) - FAR;
    assert!((far * 0.5e6 / charges.iter().sum::<f64>() - 1.0).abs() < 1e-4, "{far:e} {charges:?}");
    // The wall is one.
    for r in [1.0, 1.5, 4.0] {
        let p = |z: f64| field.pressure([0.3 + z, r]);
        let normal = (p(1e-4) - p(-1e-4)) / 2e-4;
        assert!(normal.abs() < 1e-5, "{normal:e}");
    }
}

/// Where the spheres come apart the two ways to find the field meet.
#[test]
fn bubbles_that_just_touch_the_wall_have_the_field_of_those_that_just_do_not() {
    let [touching, clear] = [1.0, 1.0 + 1e-5].map(|d| {
        let (bubbles, space) = (bubbles(&[[d, 1.0, 2e3]]), Space::above(Some(0.0)));
        let of = super::super::bubbles(&bubbles, Geometry::Axisymmetric, &space).expect("bubbles");
        Fit::about(&of, &space).expect("few bubbles")
    });
    let series = field(&[[1.05, 1.0, 2e3]], Some(0.0));
    let (fit, _) = {
        let space = Space::above(Some(0.0));
        let of = super::super::bubbles(&bubbles(&[[1.05, 1.0, 2e3]]), Geometry::Axisymmetric, &space);
        Fit::about(&of.expect("bubbles"), &space).expect("few bubbles")
    };
    for point in [[0.0, 0.4], [0.0, 2.0], [2.2, 0.3], [1.0, 1.2]] {
        let (a, b) = (touching.0.excess(point), clear.0.excess(point));
        assert!((a - b).abs() < 1e-4 * FAR && a != b, "{point:?}: {a} {b}");
        let (a, b) = (fit.excess(point), series.pressure(point) - FAR);
        assert!((a - b).abs() < 1e-6 * FAR, "{point:?}: {a} {b}");
    }
    assert!(touching.1.max(clear.1) < 1e-6, "{:e} {:e}", touching.1, clear.1);
}
