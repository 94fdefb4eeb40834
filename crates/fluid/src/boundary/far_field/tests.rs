use std::f64::consts::PI;

use mesh::{Domain, Geometry, Side};

use super::condition::{Inner, Moment};
use super::history::SourceHistory;
use super::incident::{Incident, Wave};
use super::{FarField, FarFieldError};
use crate::{
    Boundary, Bubble, InitialCondition, InitialPressure, Mixture, Phase, PhaseState, PressureHistory, Pulse,
    PulseShape, Region, Shape, StiffenedGas,
};

const LIQUID: StiffenedGas = StiffenedGas { gamma: 7.15, pi: 3e8 };
const FAR: f64 = 1e5;
const RHO: f64 = 1000.0;
const FREE: [Boundary; 4] = [Boundary::FarField, Boundary::FarField, Boundary::Axis, Boundary::FarField];
const ABOVE_WALL: [Boundary; 4] = [Boundary::Wall, Boundary::FarField, Boundary::Axis, Boundary::FarField];
const DOMAIN: Domain = Domain { geometry: Geometry::Axisymmetric, z: [-4e-3, 6e-3], r: [0.0, 4e-3] };

fn mixture() -> Mixture {
    Mixture::new(LIQUID, StiffenedGas { gamma: 1.4, pi: 0.0 })
}

fn sound() -> f64 {
    LIQUID.sound_speed(RHO, FAR)
}

/// Bubbles of (z, radius) on the axis.
fn initial(bubbles: &[[f64; 2]], pressure: InitialPressure) -> InitialCondition {
    let state = |phase, density, pressure| PhaseState { phase, density, pressure, velocity: [0.0; 2] };
    let region = |&[z, radius]: &[f64; 2]| Region {
        shape: Shape::Sphere { centre: [z, 0.0], radius },
        state: state(Phase::Gas, 0.012, 1e3),
    };
    InitialCondition {
        ambient: state(Phase::Liquid, RHO, FAR),
        pressure,
        regions: bubbles.iter().map(region).collect(),
        pulses: vec![],
    }
}

fn far_field(initial: &InitialCondition, boundaries: [Boundary; 4]) -> Result<FarField, FarFieldError> {
    FarField::of(initial, &mixture(), &DOMAIN, boundaries, None, 1.0)
}

/// Outgoing spherical sound of a source f(t) at z: p'/ρ, ∫p'/ρ dt, and the velocity.
fn spherical(z: f64, [f, f_dot]: [f64; 2], [x, r]: [f64; 2]) -> (f64, f64, [f64; 2]) {
    let s = (x - z).hypot(r);
    let u = f_dot / (s * sound()) + f / (s * s);
    (f_dot / s, f / s, [u * (x - z) / s, u * r / s])
}

/// Faces on the sides of [`DOMAIN`].
const FACES: [(Side, [f64; 2]); 6] = [
    (Side::ZMin, [-4e-3, 1e-3]),
    (Side::ZMax, [6e-3, 0.1e-3]),
    (Side::ZMax, [6e-3, 3.9e-3]),
    (Side::RMax, [-3e-3, 4e-3]),
    (Side::RMax, [0.5e-3, 4e-3]),
    (Side::RMax, [5.9e-3, 4e-3]),
];

fn normal_component(side: Side, [z, r]: [f64; 2]) -> f64 {
    [-z, z, -r, r][side as usize]
}

/// Whatever the source does, and also when nothing is known of it.
#[test]
fn it_is_exact_for_sound_of_one_source() {
    let far_field = far_field(&initial(&[[0.3e-3, 1e-3]], InitialPressure::Uniform), FREE).unwrap();
    for (side, face) in FACES {
        for f in [[1e-5, 0.0], [0.0, 7.0], [-2e-5, 3.0]] {
            let (pressure, impulse, velocity) = spherical(0.3e-3, f, face);
            let found = far_field.admittance(face, side, 1e-6, &SourceHistory::default());
            let u_n = found.wave * pressure / sound() + found.flow * impulse + found.correction;
            let exact = normal_component(side, velocity);
            approx::assert_relative_eq!(u_n, exact, max_relative = 1e-12, epsilon = 1e-12);
        }
    }
}

/// A bubble and its image, whose sound arrives at different times, or two bubbles that do not do alike: the history of their
/// volumes makes it exact, to what its samples resolve.
#[test]
fn it_is_exact_for_sources_that_differ() {
    let volumes = [|t: f64| 4e-9 - 1e-9 * (3e5 * t).sin(), |t: f64| 1e-9 + 0.4e-9 * (5e5 * t).cos()];
    for (places, boundaries, walls) in
        [(vec![-1e-3, 1.7e-3], FREE, 1), (vec![-1.5e-3, 1.7e-3], ABOVE_WALL, 2)]
    {
        let bubbles: Vec<[f64; 2]> = places.iter().map(|z| [*z, 0.5e-3]).collect();
        let start = initial(&bubbles, InitialPressure::Uniform);
        let far_field = far_field(&start, boundaries).unwrap();
        let mut history = SourceHistory::new(&far_field, &DOMAIN, boundaries);
        for k in 0..2000 {
            let time = f64::from(k) * 1e-8;
            if history.is_due(time) {
                let at = |n: usize| Bubble {
                    volume: volumes[n](time),
                    centroid_z: places[n],
                    ..Bubble::default()
                };
                history.sample(time, &[at(0), at(1)]);
            }
        }
        let now = 1.9e-5;
        for (side, face) in
            FACES.into_iter().filter(|(side, _)| boundaries[*side as usize] == Boundary::FarField)
        {
            let (mut pressure, mut impulse, mut velocity) = (0.0, 0.0, [0.0; 2]);
            for (n, place) in places.iter().enumerate() {
                for z in [*place, 2.0 * DOMAIN.z[0] - place].into_iter().take(walls) {
                    let then = now - (face[0] - z).hypot(face[1]) / sound();
                    let step = 1e-9;
                    let rate = |t: f64| (volumes[n](t + step) - volumes[n](t - step)) / (2.0 * step);
                    let f = [rate(then), (rate(then + step) - rate(then - step)) / (2.0 * step)];
                    let one = spherical(z, f.map(|of_volume| of_volume / (4.0 * std::f64::consts::PI)), face);
                    pressure += one.0;
                    impulse += one.1;
                    velocity = [velocity[0] + one.2[0], velocity[1] + one.2[1]];
                }
            }
            let found = far_field.admittance(face, side, now, &history);
            let without = found.wave * pressure / sound() + found.flow * impulse;
            let exact = normal_component(side, velocity);
            let size = velocity[0].hypot(velocity[1]);
            assert!((without + found.correction - exact).abs() < 0.01 * size, "{side:?} {face:?}");
        }
    }
}

/// With Rayleigh's pressure p' is not zero on a side, and nothing moves yet: the impulse begins so that the face is at rest, too.
#[test]
fn a_face_begins_with_its_initial_state() {
    for (pressure, boundaries, places) in [
        (InitialPressure::Uniform, FREE, vec![[0.3e-3, 1e-3]]),
        (InitialPressure::Rayleigh, FREE, vec![[0.3e-3, 1e-3], [3e-3, 0.6e-3]]),
        (InitialPressure::Rayleigh, ABOVE_WALL, vec![[-1e-3, 1e-3]]),
    ] {
        let start = initial(&places, pressure);
        let far_field = far_field(&start, boundaries).unwrap();
        let field = crate::RayleighField::of(&start, None, &DOMAIN, boundaries).unwrap();
        for (side, face) in
            FACES.into_iter().filter(|(side, _)| boundaries[*side as usize] == Boundary::FarField)
        {
            let p = field.as_ref().map_or(far_field.pressure, |field| field.pressure(face));
            let inner = Inner([RHO, 0.0, 0.0, p]);
            let impulse = far_field.initial_impulse(side, face, inner, &mixture());
            let history = SourceHistory::default();
            let moment = Moment { middle: 0.0, dt: 0.0, history: &history };
            let outer = far_field.outer(side, face, inner, &mixture(), moment, impulse);
            approx::assert_relative_eq!(outer.pressure, p, max_relative = 1e-12);
            assert!(outer.velocity.abs() < 1e-9, "{outer:?}");
            if pressure == InitialPressure::Uniform {
                assert_eq!((outer.velocity, outer.pressure, impulse), (0.0, p, 0.0));
            }
        }
    }
}

/// Far away p' = ρ Σ f'/s of the sources and their images is that of the start, of bubbles that a wall cuts, too, wherever it is.
#[test]
fn cut_bubbles_draw_in_what_their_field_says() {
    let below_wall = [Boundary::FarField, Boundary::Wall, Boundary::Axis, Boundary::FarField];
    for (boundaries, wall, places) in [
        (ABOVE_WALL, -4e-3, vec![[-3.5e-3, 1e-3]]),
        (ABOVE_WALL, -4e-3, vec![[-3.5e-3, 1e-3], [-2.2e-3, 0.5e-3], [1e-3, 1e-3]]),
        (below_wall, 6e-3, vec![[5e-3, 1e-3], [2e-3, 1e-3]]),
    ] {
        let start = initial(&places, InitialPressure::Rayleigh);
        let far_field = far_field(&start, boundaries).unwrap();
        let field = crate::RayleighField::of(&start, None, &DOMAIN, boundaries).unwrap().unwrap();
        let s = 100.0;
        let of_sources: f64 =
            far_field.bubbles.iter().map(|bubble| 2.0 * RHO * bubble.acceleration / (4.0 * PI * s)).sum();
        approx::assert_relative_eq!(of_sources, field.pressure([wall, s]) - FAR, max_relative = 1e-4);
        // A uniform pressure starts nothing at once, and draws in the same.
        let uniform =
            super::bubbles(&initial(&places, InitialPressure::Uniform), &DOMAIN, boundaries).unwrap();
        for (bubble, still) in far_field.bubbles.iter().zip(&uniform) {
            assert_eq!((bubble.z, bubble.strength, 0.0), (still.z, still.strength, still.acceleration));
            approx::assert_relative_eq!(
                bubble.acceleration,
                -4.0 * PI * bubble.strength / RHO,
                max_relative = 1e-12
            );
        }
    }
}

/// Linear acoustics: ρ ∂t v = −∇p and ∂t p = −ρc² div v, what it begins with, and no velocity through a rigid wall.
#[test]
fn incident_waves_are_those_of_the_pulses() {
    let plane = |direction| Pulse {
        shape: PulseShape::Plane { direction },
        centre: [1e-3, 0.0],
        width: 0.7e-3,
        amplitude: 1e4,
    };
    let sphere = Pulse { shape: PulseShape::Sphere, ..plane(None) };
    let inflow = PressureHistory::new(vec![[0.0, FAR], [1e-6, 3e5], [3e-6, 2e5]]).unwrap();
    let entering = [Boundary::Wall, Boundary::Inflow, Boundary::Axis, Boundary::FarField];
    for (pulses, inflow, boundaries) in [
        (vec![plane(None)], None, ABOVE_WALL),
        (vec![plane(Some([-1.0, 0.0])), sphere], None, ABOVE_WALL),
        (vec![], Some(&inflow), entering),
    ] {
        let mut start = initial(&[[0.0, 1e-3]], InitialPressure::Uniform);
        start.pulses = pulses;
        let wall = Some((DOMAIN.z[0], 1.0));
        let incident = Incident::of(&start, LIQUID.into(), &DOMAIN, boundaries, inflow, wall);
        let at = |z: f64, r: f64, t: f64| incident.at([z, r], t);
        for (z, r, t) in [(0.4e-3, 0.8e-3, 0.3e-6), (2.1e-3, 2e-3, 1.1e-6), (-3e-3, 0.3e-3, 3.4e-6)] {
            let (d, dt) = (1e-7, 1e-7 / sound());
            let slope = |ahead: Wave, behind: Wave, width: f64| {
                let [dz, dr] = [0, 1].map(|k| (ahead.velocity[k] - behind.velocity[k]) / (2.0 * width));
                ((ahead.pressure - behind.pressure) / (2.0 * width), dz, dr)
            };
            let (p_t, vz_t, vr_t) = slope(at(z, r, t + dt), at(z, r, t - dt), dt);
            let (p_z, vz_z, _) = slope(at(z + d, r, t), at(z - d, r, t), d);
            let (p_r, _, vr_r) = slope(at(z, r + d, t), at(z, r - d, t), d);
            let divergence = vz_z + vr_r + at(z, r, t).velocity[1] / r;
            let size = 1e4 / 0.7e-3;
            assert!((RHO * vz_t + p_z).abs() < 1e-3 * size, "{z} {r} {t}");
            assert!((RHO * vr_t + p_r).abs() < 1e-3 * size, "{z} {r} {t}");
            assert!((p_t / sound() + RHO * sound() * divergence).abs() < 1e-3 * size, "{z} {r} {t}");
        }
        for t in [0.0, 2e-6, 5e-6] {
            assert!(at(DOMAIN.z[0], 1e-3, t).velocity[0].abs() < 1e-12, "{t}");
        }
        let begin: f64 = start.pulses.iter().map(|_| 1e4).sum();
        approx::assert_relative_eq!(at(1e-3, 1e-9, 0.0).pressure, begin, max_relative = 1e-6, epsilon = 1e-9);
    }
}

#[test]
fn what_has_none_is_told_why() {
    let one = initial(&[[0.0, 1e-3]], InitialPressure::Uniform);
    let with = |change: &dyn Fn(&mut InitialCondition, &mut Domain, &mut [Boundary; 4])| {
        let (mut start, mut domain, mut boundaries) = (one.clone(), DOMAIN, FREE);
        change(&mut start, &mut domain, &mut boundaries);
        FarField::of(&start, &mixture(), &domain, boundaries, None, 1.0).map(|_| ())
    };
    assert_eq!(with(&|_, _, _| {}), Ok(()));
    assert_eq!(with(&|_, domain, _| domain.geometry = Geometry::Planar), Err(FarFieldError::Planar));
    assert_eq!(with(&|start, _, _| start.regions.clear()), Err(FarFieldError::NoGas));
    assert_eq!(with(&|start, _, _| start.ambient.phase = Phase::Gas), Err(FarFieldError::GasAmbient));
    let ring = Shape::Box { z: [0.0, 1e-3], r: [1e-3, 2e-3] };
    let off_axis = |start: &mut InitialCondition, _: &mut Domain, _: &mut [Boundary; 4]| {
        start.regions[0].shape = ring;
    };
    assert_eq!(with(&off_axis), Err(FarFieldError::OffAxis { region: 0 }));
    assert_eq!(with(&|_, _, sides| sides[3] = Boundary::Wall), Err(FarFieldError::Tube));
    assert_eq!(
        with(&|_, _, sides| (sides[0], sides[1]) = (Boundary::Wall, Boundary::Interface)),
        Err(FarFieldError::Layer)
    );
    assert_eq!(
        with(&|_, _, sides| (sides[0], sides[1]) = (Boundary::Periodic, Boundary::Periodic)),
        Err(FarFieldError::Layer)
    );
}
