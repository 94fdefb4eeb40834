//! Bubbles beside walls other than that below them.

use super::*;
use Boundary::{Axis, Interface, NonReflecting as Open, Periodic, Wall};

/// z_min, z_max and r_max.
fn sides([z_min, z_max, r_max]: [Boundary; 3]) -> [Boundary; 4] {
    [z_min, z_max, Axis, r_max]
}

fn made(spheres: &[[f64; 3]], kinds: [Boundary; 3]) -> Result<RayleighField, RayleighError> {
    RayleighField::between(&bubbles(spheres), &BOX, sides(kinds))
}

/// The largest gradient along the normal of walls, times 1 m, and the largest excess on open sides, Pa.
fn errors_on_sides(field: &RayleighField, kinds: [Boundary; 3]) -> [f64; 2] {
    let h = 1e-5;
    let Domain { z: [low, high], r: [_, outer], .. } = BOX;
    let lines = [
        (kinds[0], [low, 0.0], [low, outer], [1.0, 0.0]),
        (kinds[1], [high, 0.0], [high, outer], [1.0, 0.0]),
        (kinds[2], [low, outer], [high, outer], [0.0, 1.0]),
    ];
    let mut errors = [0.0_f64; 2];
    for (kind, from, to, normal) in lines {
        for n in 0..=400 {
            let at = |share: f64, off: f64| -> [f64; 2] {
                std::array::from_fn(|axis| from[axis] + share * (to[axis] - from[axis]) + off * normal[axis])
            };
            let p = |off: f64| field.pressure(at(f64::from(n) / 400.0, off));
            if kind.is_open() {
                errors[1] = errors[1].max((p(0.0) - FAR).abs());
            } else {
                errors[0] = errors[0].max((p(h) - p(-h)).abs() / (2.0 * h));
            }
        }
    }
    errors
}

#[test]
fn walls_have_no_gradient_and_open_sides_beside_them_the_pressure_far_away() {
    let one = &[[2.0, 1.0, 2e3]][..];
    let two = &[[0.5, 1.0, 2e3], [3.5, 0.7, 3e5]][..];
    let wide = &[[1.0, 4.0, 2e3]][..];
    for (spheres, kinds) in [
        (one, [Wall, Open, Wall]),
        (one, [Open, Open, Wall]),
        (one, [Open, Wall, Wall]),
        (one, [Interface, Wall, Open]),
        (two, [Wall, Open, Wall]),
        (two, [Wall, Wall, Open]),
        (wide, [Wall, Open, Wall]),
    ] {
        let field = made(spheres, kinds).expect("a field");
        let [gradient, excess] = errors_on_sides(&field, kinds).map(|error| error / FAR);
        eprintln!("{kinds:?}: gradient {gradient:.1e}, excess {excess:.1e}, found {:.1e}", field.error());
        assert!(gradient < 1e-4 && excess < 1e-4, "{kinds:?}: {gradient:e} {excess:e}");
        for &[centre, radius, pressure] in spheres {
            for k in 1..100 {
                let (sin, cos) = (std::f64::consts::PI * f64::from(k) / 100.0).sin_cos();
                let point = [centre + radius * cos * (1.0 + 1e-12), radius * sin * (1.0 + 1e-12)];
                let off = (field.pressure(point) - pressure).abs() / FAR;
                assert!(point[0] < 0.0 || off < 1e-4, "{kinds:?} at {point:?}: {off:e}");
            }
        }
        let points = [[0.1, 4.5], [5.9, 4.8], [5.5, 0.3]];
        // There the pressure may be so even that differences are all round-off.
        check_harmonic(&field, if spheres == wide { &points[1..] } else { &points }, 3e-3);
    }
}

/// A wall above is one below, upside down.
#[test]
fn a_wall_at_z_max_has_images_as_one_at_z_min() {
    let below = made(&[[0.5, 1.0, 2e3], [3.0, 0.5, 2e3]], [Wall, Open, Open]).expect("a field");
    let above = made(&[[5.5, 1.0, 2e3], [3.0, 0.5, 2e3]], [Open, Wall, Open]).expect("a field");
    for [z, r] in [[0.0, 1.5], [2.0, 0.1], [5.0, 4.0]] {
        assert_eq!(below.pressure([z, r]), above.pressure([6.0 - z, r]));
    }
    assert_eq!(below.monopoles(), above.monopoles());
}

/// All that a bubble draws in comes along the tube: far from it ∂p/∂z = −4Q/W².
#[test]
fn a_tube_carries_what_its_bubble_draws_in() {
    let tall = Domain { z: [0.0, 30.0], ..BOX };
    let spheres = bubbles(&[[2.0, 1.0, 2e3]]);
    let field = RayleighField::between(&spheres, &tall, sides([Wall, Open, Wall])).expect("a field");
    let want = -4.0 * field.monopoles()[0] / 25.0;
    for (z, r) in [(24.0, 0.0), (26.0, 3.0), (29.0, 4.9)] {
        let slope = (field.pressure([z + 1e-3, r]) - field.pressure([z - 1e-3, r])) / 2e-3;
        assert!((slope / want - 1.0).abs() < 1e-5, "({z}, {r}): {slope} {want}");
    }
    // A small one between open ends: each gives by the distance to the other.
    let spheres = bubbles(&[[10.0, 0.2, 2e3]]);
    let field = RayleighField::between(&spheres, &tall, sides([Open, Open, Wall])).expect("a field");
    let slope = |z: f64| (field.pressure([z + 1e-3, 2.0]) - field.pressure([z - 1e-3, 2.0])) / 2e-3;
    let above = slope(27.0) / (-4.0 * field.monopoles()[0] / 25.0);
    assert!((above - 1.0 / 3.0).abs() < 2e-5, "{above}");
}

#[test]
fn sides_without_such_a_field_are_refused() {
    let one = &[[2.0, 1.0, 2e3]][..];
    for all in [[Wall; 3], [Interface, Wall, Wall]] {
        assert_eq!(made(one, all), Err(RayleighError::ClosedBox));
    }
    assert_eq!(made(one, [Periodic, Periodic, Open]), Err(RayleighError::Periodic));
    let meets = |side| Err(RayleighError::MeetsSide { region: 0, side });
    assert_eq!(made(&[[5.0, 1.0, 2e3]], [Wall, Open, Wall]), meets("z_max"));
    assert_eq!(made(&[[1.0, 1.0, 2e3]], [Open, Wall, Wall]), meets("z_min"));
    assert_eq!(made(&[[1.0, 1.0, 2e3]], [Open, Open, Wall]), meets("z_min"));
    assert_eq!(made(&[[0.0, 5.0, 2e3]], [Wall, Open, Wall]), meets("r_max"));
    // An open side beside one wall may cut a bubble.
    assert!(made(&[[0.0, 5.5, 2e3]], [Wall, Open, Open]).is_ok());
}
