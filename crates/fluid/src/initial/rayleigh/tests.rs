use super::*;
use crate::{Phase, PhaseState, Region, Shape};

mod beneath;
mod cut;
mod sides;

const FAR: f64 = 1e5;
const BOX: Domain = Domain { geometry: Geometry::Axisymmetric, z: [0.0, 6.0], r: [0.0, 5.0] };

fn state(phase: Phase, pressure: f64) -> PhaseState {
    let density = if phase == Phase::Gas { 1.2 } else { 1000.0 };
    PhaseState { phase, density, pressure, velocity: [0.0; 2] }
}

/// Bubbles (centre, radius, pressure) in liquid at [`FAR`].
fn bubbles(spheres: &[[f64; 3]]) -> InitialCondition {
    let balls = spheres.iter().map(|&[z, radius, pressure]| ([z, radius], state(Phase::Gas, pressure)));
    InitialCondition::of_balls(state(Phase::Liquid, FAR), InitialPressure::Rayleigh, balls)
}

fn field(spheres: &[[f64; 3]], wall: Option<f64>) -> RayleighField {
    RayleighField::new(&bubbles(spheres), Geometry::Axisymmetric, wall).expect("a field")
}

/// Three unlike bubbles above a wall at z = 0.3, one of them at a higher pressure than the liquid.
const THREE: [[f64; 3]; 3] = [[1.6, 1.0, 2e3], [3.4, 0.5, 4e5], [5.5, 1.2, 5e4]];
const WALL: Option<f64> = Some(0.3);

/// Points in the liquid above the wall, off the bubbles.
const POINTS: [[f64; 2]; 5] = [[0.5, 0.3], [0.4, 2.0], [2.8, 0.4], [4.1, 0.8], [7.5, 3.0]];

/// Laplace's equation by differences of the step `h` in these points.
fn check_harmonic(field: &RayleighField, points: &[[f64; 2]], h: f64) {
    for &[z, r] in points {
        let p = |dz: f64, dr: f64| field.pressure([z + dz * h, r + dr * h]);
        let along_z = p(1.0, 0.0) - 2.0 * p(0.0, 0.0) + p(-1.0, 0.0);
        let along_r = p(0.0, 1.0) - 2.0 * p(0.0, 0.0) + p(0.0, -1.0);
        let about_axis = 0.5 * h * (p(0.0, 1.0) - p(0.0, -1.0)) / r;
        let size = along_z.abs() + along_r.abs() + about_axis.abs();
        let sum = along_z + along_r + about_axis;
        assert!(size > 1e-4 && sum.abs() < 1e-4 * size, "({z}, {r}): {sum:e} of {size:e}");
    }
}

#[test]
fn the_field_is_harmonic() {
    check_harmonic(&field(&THREE, WALL), &POINTS, 1e-3);
}

#[test]
fn every_surface_has_its_gas_pressure() {
    for (spheres, wall, most) in [
        (&THREE[..], WALL, 1e-8),
        (&[[2.0, 1.0, 2e3]], Some(0.0), 1e-9),
        // Nearly touching the wall, and each other at different pressures.
        (&[[1.05, 1.0, 2e3]], Some(0.0), 1e-9),
        (&[[1.005, 1.0, 2e3]], Some(0.0), 1e-4),
        (&[[2.0, 1.0, 2e3], [4.02, 1.0, 3e5]], Some(0.0), 1e-3),
    ] {
        let field = field(spheres, wall);
        assert!(field.error() < most, "{spheres:?}: {:e}", field.error());
        for &[centre, radius, pressure] in spheres {
            for k in 0..=97 {
                let angle = std::f64::consts::PI * f64::from(k) / 97.0;
                let s = radius * (1.0 + 1e-13);
                let got = field.pressure([centre + s * angle.cos(), s * angle.sin()]);
                assert!((got - pressure).abs() < 1.01 * most * 4e5 + 1e-6, "{got} {pressure} at {angle}");
            }
            assert_eq!(field.pressure([centre, 0.5 * radius]), pressure, "within");
        }
    }
}

#[test]
fn nothing_pushes_the_liquid_through_the_wall() {
    let field = field(&THREE, WALL);
    let h = 1e-4;
    for r in [0.0, 0.7, 3.0] {
        let p = |z: f64| field.pressure([0.3 + z, r]);
        let (normal, curvature) = ((p(h) - p(-h)) / (2.0 * h), (p(h) - 2.0 * p(0.0) + p(-h)) / (h * h));
        assert!(normal.abs() < 1e-5 && curvature.abs() > 10.0, "{normal:e} {curvature:e}");
    }
}

#[test]
fn far_from_the_wall_it_is_that_of_one_sphere() {
    let alone = field(&[[0.0, 1e-3, 2e3]], None);
    let high = field(&[[1e3, 1e-3, 2e3]], Some(0.0));
    for s in [1e-3, 1.7e-3, 0.05] {
        let want = FAR + (2e3 - FAR) * 1e-3 / s;
        for (field, z) in [(&alone, 0.0), (&high, 1e3)] {
            let got = field.pressure([z + 0.6 * s * (1.0 + 1e-9), 0.8 * s * (1.0 + 1e-9)]);
            assert!((got - want).abs() < 1e-6 * FAR, "{got} {want}");
        }
    }
}

/// One bubble with its image are two equal conducting spheres at one potential: a charge in the centre, and in each
/// the images of all charges of the other (Maxwell 1873, art. 173).
#[test]
fn one_bubble_has_the_field_of_its_image_charges() {
    for d in [1.05_f64, 1.3, 2.0, 5.0] {
        let (mut charges, mut charge, mut depth) = (Vec::new(), 2e3 - FAR, 0.0);
        while f64::abs(charge) > 1e-12 * FAR {
            charges.push((charge, depth));
            let distance = 2.0 * d - depth;
            (charge, depth) = (-charge / distance, 1.0 / distance);
        }
        let field = field(&[[d, 1.0, 2e3]], Some(0.0));
        for [z, r] in [[0.0, 0.0], [0.0, 1.0], [d, 1.01], [d + 1.5, 0.1], [0.2, 0.9]] {
            let potential = |(charge, depth): &(f64, f64)| {
                charge * (1.0 / (z - d + depth).hypot(r) + 1.0 / (z + d - depth).hypot(r))
            };
            let want = FAR + charges.iter().map(potential).sum::<f64>();
            let got = field.pressure([z, r]);
            assert!((got - want).abs() < 1e-8 * FAR, "d = {d}, ({z}, {r}): {got} {want}");
        }
    }
}

#[test]
fn what_has_no_such_field_is_refused() {
    use RayleighError::{BeyondWall, GasAmbient, NoGas, NotASphere, Overlap, Planar, TooNear};
    let made = |initial: &InitialCondition, wall| {
        RayleighField::new(initial, Geometry::Axisymmetric, wall).map(|_| ()).expect_err("no field")
    };
    let one = bubbles(&[[2.0, 1.0, 2e3]]);
    assert_eq!(RayleighField::new(&one, Geometry::Planar, None), Err(Planar));
    assert_eq!(made(&bubbles(&[]), None), NoGas);
    assert_eq!(made(&one, Some(2.25)), BeyondWall { region: 0, depth: 0.25 });
    for touching in [3.5, 3.4] {
        let two = bubbles(&[[2.0, 1.0, 2e3], [touching, 0.5, 3e3]]);
        assert_eq!(made(&two, None), Overlap { first: 0, second: 1 });
    }
    let off_axis = Shape::Sphere { centre: [2.0, 0.1], radius: 1.0 };
    for shape in [off_axis, Shape::Box { z: [0.0, 1.0], r: [0.0, 1.0] }] {
        let mut initial = one.clone();
        initial.regions.push(Region { shape, ..initial.regions[0] });
        assert_eq!(made(&initial, None), NotASphere { region: 1 });
    }
    let mut gas = one.clone();
    gas.ambient.phase = Phase::Gas;
    assert_eq!(made(&gas, None), GasAmbient);
    // A pressure that jumps across a few units of the last digit is no field to be had.

    let near = bubbles(&[[2.0, 1.0, 2e3], [4.0 + 2e-15, 1.0, 3e5]]);
    assert!(matches!(made(&near, None), TooNear { .. }));
    // So many bubbles that meet would take minutes.
    let chain: Vec<_> = (0..60).map(|k| [2.0 + 1.5 * f64::from(k), 1.0, 2e3]).collect();
    assert!(matches!(made(&bubbles(&chain), None), RayleighError::TooMany { .. }));
    // A uniform pressure asks for no field, whatever there is.
    let uniform = InitialCondition { pressure: InitialPressure::Uniform, ..near };
    let none =
        RayleighField::of(&uniform, None, &Domain { geometry: Geometry::Planar, ..BOX }, [Boundary::Wall; 4]);
    assert_eq!(none, Ok(None));
    // At the liquid's own pressure there is nothing to start.
    assert_eq!(field(&[[2.0, 1.0, FAR]], Some(0.0)).pressure([0.0, 0.5]), FAR);
}

/// The caller adds the hydrostatic pressure: 1e5 Pa/m downwards here.
#[test]
fn under_gravity_the_field_is_that_of_what_the_gas_lacks_at_its_height() {
    let gravity = Some(Gravity { acceleration: -100.0, level: 0.0 });
    let sides = [Boundary::Wall, Boundary::NonReflecting, Boundary::Axis, Boundary::NonReflecting];
    let of = |gas: f64| {
        let field = RayleighField::of(&bubbles(&[[0.6, 0.1, gas]]), gravity, &BOX, sides);
        field.expect("a field").expect("asked for")
    };
    let balanced = of(FAR - 6e4);
    assert!(
        [[0.0, 0.0], [0.48, 0.0], [2.0, 1.0]]
            .iter()
            .all(|point| (balanced.pressure(*point) - FAR).abs() < 1e-9)
    );
    let collapses = of(1e4);
    assert!(
        (collapses.pressure([0.71, 0.0]) - (FAR - 3e4)).abs() < 4e3,
        "{}",
        collapses.pressure([0.71, 0.0])
    );
}

#[test]
fn walls_and_solids_have_images_and_open_sides_none() {
    let initial = bubbles(&[[2.0, 1.0, 2e3]]);
    let on_axis = |side| {
        let open = Boundary::NonReflecting;
        let field =
            RayleighField::of(&initial, None, &BOX, [side, open, Boundary::Axis, open]).expect("a field");
        field.expect("asked for").pressure([0.0, 0.0])
    };
    let free = FAR + (2e3 - FAR) / 2.0;
    assert!((on_axis(Boundary::NonReflecting) - free).abs() < 1e-6 * FAR);
    assert_eq!(on_axis(Boundary::Wall), on_axis(Boundary::Interface));
    assert!(on_axis(Boundary::Wall) < free - 0.2 * FAR);
}
