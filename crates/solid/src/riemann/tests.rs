//! The elastic Riemann problem against its equations.

use super::*;
use crate::riemann::eigen::{Direction, Eigensystem, Vector6};

const STEEL: WaveSpeeds = WaveSpeeds { density: 7800.0, c1: 5990.0, c2: 3458.0 };
const PMMA: WaveSpeeds = WaveSpeeds { density: 1190.0, c1: 2690.0, c2: 1340.0 };
const STEPS: usize = 1000;

/// SplitMix64 (Steele, Lea & Flood 2014), uniform in [-1, 1).
fn uniform(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    2.0 * ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64 - 1.0
}

fn random_face(state: &mut u64) -> FaceState {
    FaceState {
        v_n: 10.0 * uniform(state),
        sigma_nn: 3e8 * uniform(state),
        v_t: 10.0 * uniform(state),
        sigma_nt: 3e8 * uniform(state),
    }
}

/// The four quantities of (v_z, v_r, sigma_zz, sigma_zr, sigma_rr, sigma_phiphi) that a face needs.
fn face(u: &Vector6, direction: Direction) -> FaceState {
    match direction {
        Direction::Z => FaceState { v_n: u[0], sigma_nn: u[2], v_t: u[1], sigma_nt: u[3] },
        Direction::R => FaceState { v_n: u[1], sigma_nn: u[4], v_t: u[0], sigma_nt: u[3] },
    }
}

fn assert_close(a: FaceState, b: FaceState, what: &str) {
    // Velocities of 10 m/s and stresses of 3e8 Pa, each worth the other by the impedance.
    assert!((a.v_n - b.v_n).abs() < 1e-12 && (a.v_t - b.v_t).abs() < 1e-12, "{what}: {a:?} {b:?}");
    let stress = (a.sigma_nn - b.sigma_nn).abs().max((a.sigma_nt - b.sigma_nt).abs());
    assert!(stress < 3e-6, "{what}: {a:?} {b:?}");
}

#[test]
fn star_is_the_roe_solution_from_the_eigenvectors() {
    let mut state = 11;
    for speeds in [STEEL, PMMA] {
        for direction in [Direction::Z, Direction::R] {
            let system = Eigensystem::new(speeds, direction);
            for _ in 0..STEPS {
                let mut random =
                    || Vector6::from_fn(|row, _| if row < 2 { 10.0 } else { 3e8 } * uniform(&mut state));
                let (left, right) = (random(), random());
                let strengths = system.left * (right - left);
                let (mut from_left, mut from_right) = (left, right);
                for k in 0..6 {
                    if system.values[k] < 0.0 {
                        from_left += strengths[k] * system.right.column(k);
                    } else if system.values[k] > 0.0 {
                        from_right -= strengths[k] * system.right.column(k);
                    }
                }
                let ours = star(face(&left, direction), face(&right, direction), speeds.z1(), speeds.z2());
                assert_close(ours, face(&from_left, direction), "from the left");
                assert_close(ours, face(&from_right, direction), "from the right");
            }
        }
    }
}

#[test]
fn equal_states_come_back_bitwise() {
    let mut state = 12;
    let (z1, z2) = (STEEL.z1(), STEEL.z2());
    for _ in 0..STEPS {
        let inner = random_face(&mut state);
        assert_eq!(star(inner, inner, z1, z2), inner);
        for outward in [Outward::Low, Outward::High] {
            assert_eq!(star_traction(inner, outward, inner.sigma_nn, inner.sigma_nt, z1, z2), inner);
            assert_eq!(star_velocity(inner, outward, inner.v_n, inner.v_t, z1, z2), inner);
            let sliding = FaceState { v_n: 0.0, sigma_nt: 0.0, ..inner };
            assert_eq!(star_symmetry(sliding, outward, z1, z2), sliding);
            let stresses = [inner.sigma_nn, inner.sigma_nt];
            assert_eq!(star_interface(inner, outward, inner.v_n, stresses, z2), inner);
        }
    }
}

/// Seen in a mirror across the face.
fn mirrored(face: FaceState) -> FaceState {
    FaceState { v_n: -face.v_n, sigma_nt: -face.sigma_nt, ..face }
}

#[test]
fn mirror_images_are_equal_bitwise() {
    let mut state = 13;
    let (z1, z2) = (PMMA.z1(), PMMA.z2());
    for _ in 0..STEPS {
        let (left, right) = (random_face(&mut state), random_face(&mut state));
        assert_eq!(star(mirrored(right), mirrored(left), z1, z2), mirrored(star(left, right, z1, z2)));
        let (high, low) = (Outward::High, Outward::Low);
        let traction = star_traction(left, high, 1e7, -2e6, z1, z2);
        assert_eq!(star_traction(mirrored(left), low, 1e7, 2e6, z1, z2), mirrored(traction));
        let velocity = star_velocity(left, high, 1.5, -0.5, z1, z2);
        assert_eq!(star_velocity(mirrored(left), low, -1.5, -0.5, z1, z2), mirrored(velocity));
        let symmetry = star_symmetry(left, high, z1, z2);
        assert_eq!(star_symmetry(mirrored(left), low, z1, z2), mirrored(symmetry));
        let interface = star_interface(left, high, 1.5, [-1e7, 2e6], z2);
        assert_eq!(star_interface(mirrored(left), low, -1.5, [-1e7, -2e6], z2), mirrored(interface));
    }
}

#[test]
fn boundaries_are_riemann_problems_with_a_suitable_outer_state() {
    let mut state = 14;
    for speeds in [STEEL, PMMA] {
        let (z1, z2) = (speeds.z1(), speeds.z2());
        for outward in [Outward::Low, Outward::High] {
            let with = |inner: FaceState, outer: FaceState| match outward {
                Outward::Low => star(outer, inner, z1, z2),
                Outward::High => star(inner, outer, z1, z2),
            };
            for _ in 0..STEPS {
                let inner = random_face(&mut state);
                assert_close(star_symmetry(inner, outward, z1, z2), with(inner, mirrored(inner)), "mirror");
                let free = FaceState { sigma_nn: -inner.sigma_nn, sigma_nt: -inner.sigma_nt, ..inner };
                assert_close(star_free(inner, outward, z1, z2), with(inner, free), "free");
                let fixed = FaceState { v_n: -inner.v_n, v_t: -inner.v_t, ..inner };
                assert_close(star_velocity(inner, outward, 0.0, 0.0, z1, z2), with(inner, fixed), "fixed");
                // Outer stresses 2 sigma* - sigma meet at sigma*, outer velocities 2 v* - v at v*.
                let at = random_face(&mut state);
                let loaded = FaceState {
                    sigma_nn: 2.0 * at.sigma_nn - inner.sigma_nn,
                    sigma_nt: 2.0 * at.sigma_nt - inner.sigma_nt,
                    ..inner
                };
                let traction = star_traction(inner, outward, at.sigma_nn, at.sigma_nt, z1, z2);
                assert_close(traction, with(inner, loaded), "traction");
                let driven =
                    FaceState { v_n: 2.0 * at.v_n - inner.v_n, v_t: 2.0 * at.v_t - inner.v_t, ..inner };
                let velocity = star_velocity(inner, outward, at.v_n, at.v_t, z1, z2);
                assert_close(velocity, with(inner, driven), "velocity");
                // The interface under the pressure that a traction boundary would have.
                let pressed = star_traction(inner, outward, at.sigma_nn, 0.0, z1, z2);
                assert_eq!(
                    star_interface(inner, outward, pressed.v_n, [at.sigma_nn, pressed.sigma_nt], z2),
                    pressed
                );
            }
        }
    }
}

#[test]
fn moduli_of_steel() {
    // The wave speeds of the paper mean Poisson's ratio 0.25 and E = 233 GPa, and so lambda = mu.
    let (lambda, mu) = (STEEL.lambda(), STEEL.shear_modulus());
    assert!((lambda / mu - 1.0).abs() < 2e-3);
    let young = mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu);
    assert!((young / 233e9 - 1.0).abs() < 2e-3);
    assert!((STEEL.alpha() - lambda / STEEL.p_modulus()).abs() < 1e-15);
}
