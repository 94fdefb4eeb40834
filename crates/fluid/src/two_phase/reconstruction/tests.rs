//! Face states of mixed cells against bounds and limits.

use super::*;
use crate::two_phase::FaceState;

/// Five cells and what windows look at beyond them.
const STRIDE: usize = 12;

fn rows(cell: impl Fn(f64, f64) -> [f64; 6]) -> [Vec<f64>; 6] {
    let at = |k: usize| cell((k % STRIDE) as f64 - 2.0, (k / STRIDE) as f64 - 2.0);
    std::array::from_fn(|c| (0..5 * STRIDE).map(|k| at(k)[c]).collect())
}

/// The states on the faces of the cell in the middle.
fn middle_of(rows: &[Vec<f64>; 6], limiter: Limiter, options: TwoPhaseOptions, dt: f64) -> FaceStates {
    let mixture = Mixture::water_and_air();
    let inverse_r = [0.0; 5 * STRIDE];
    let cells = Cells { rows: rows.each_ref().map(|row| &row[..]), stride: STRIDE };
    let rule = CellRule {
        limiter,
        inverse_h: [1e4, 1e4],
        inverse_r: &inverse_r,
        dt,
        mixture: &mixture,
        options,
        is_low_mach: false,
        velocity_gain: None,
        jumps: None,
        excess: None,
    };
    let mut states = FaceStates::default();
    face_states(&cells, &[Window { first: 2 * STRIDE + 2, step: 1, listed: 1 }], &rule, &mut states);
    states
}

fn states(rows: &[Vec<f64>; 6], options: TwoPhaseOptions, dt: f64) -> [FaceState; 4] {
    let states = middle_of(rows, Limiter::Mc, options, dt);
    [0, 1, 2, 3].map(|face| states.of(0, face))
}

/// Gas on the left of water at one pressure and velocity, with a mixed cell in between.
fn contact(z: f64, _: f64) -> [f64; 6] {
    let phi = if z < 0.0 {
        1.0
    } else if z == 0.0 {
        0.4
    } else {
        0.0
    };
    [phi * 1.2 + (1.0 - phi) * 1000.0, 200.0, 3.0, 1e5, phi, phi * 1.2]
}

#[test]
fn at_uniform_pressure_and_velocity_only_the_gas_fraction_differs() {
    for is_sharp in [true, false] {
        let options = TwoPhaseOptions { has_closure: true, is_sharp };
        for state in states(&rows(contact), options, 1e-7) {
            let [rho, v_z, v_r, p, phi] = state.w;
            assert_eq!((v_z, v_r), (200.0, 3.0));
            approx::assert_relative_eq!(p, 1e5, max_relative = 1e-14);
            approx::assert_relative_eq!(rho, phi * 1.2 + (1.0 - phi) * 1000.0, max_relative = 1e-13);
            approx::assert_relative_eq!(state.gas_share, phi * 1.2 / rho, max_relative = 1e-13);
        }
    }
}

#[test]
fn what_is_bounded_is_told() {
    let options = TwoPhaseOptions { has_closure: true, is_sharp: false };
    let bounded = |cell: &dyn Fn(f64) -> [f64; 6]| {
        let states = middle_of(&rows(|z, _| cell(z)), Limiter::None, options, 1e-12);
        states.bounded()[0].map(|lanes| lanes & 1)
    };
    let of =
        |rho_g: f64, p: f64, phi: f64| [phi * rho_g + (1.0 - phi) * 1000.0, 0.0, 0.0, p, phi, phi * rho_g];
    assert_eq!(bounded(&|_| of(1.2, 1e5, 0.4)), [0; 5]);
    // The central slope takes the face beyond the bound.
    assert_eq!(bounded(&|z| of(if z > 0.0 { 20.0 } else { 1.0 }, 1e5, 0.4)), [1, 0, 0, 0, 0]);
    assert_eq!(bounded(&|z| of(1.2, if z > 0.0 { 5e5 } else { 1e5 }, 0.4)), [0, 1, 0, 0, 0]);
    assert_eq!(bounded(&|z| of(1.2, 1e5, if z > 0.0 { 0.9 } else { 0.1 })), [0, 0, 1, 0, 0]);
}

#[test]
fn thinc_is_steeper_than_the_limiter() {
    let of = |is_sharp| states(&rows(contact), TwoPhaseOptions { has_closure: true, is_sharp }, 1e-12);
    let (sharp, smooth) = (of(true), of(false));
    assert!(
        sharp[0].w[primitive::PHI] > smooth[0].w[primitive::PHI]
            && sharp[1].w[primitive::PHI] < smooth[1].w[primitive::PHI],
        "{sharp:?} {smooth:?}"
    );
    // Along the interface there is nothing to sharpen.
    for state in [sharp[2], sharp[3]] {
        approx::assert_relative_eq!(state.w[primitive::PHI], 0.4, max_relative = 1e-5);
    }
}

#[test]
fn compression_goes_into_the_gas() {
    let squeezed = |z: f64, r: f64| {
        let mut cell = contact(0.0, r);
        cell[1] = -10.0 * z;
        cell
    };
    let options = TwoPhaseOptions { has_closure: true, is_sharp: false };
    let dt = 1e-9;
    let state = states(&rows(squeezed), options, dt)[2];
    // ∇·v = −1e5/s: the gas takes nearly all of it, φ̇ ≈ ∇·v (1 − φ) and ṗ = γ p/φ · 1e5.
    approx::assert_relative_eq!(state.w[primitive::PHI] - 0.4, -0.6 * 1e5 * 0.5 * dt, max_relative = 1e-3);
    approx::assert_relative_eq!(
        state.w[primitive::PRESSURE] - 1e5,
        1.4e5 / 0.4 * 1e5 * 0.5 * dt,
        max_relative = 1e-3
    );
    let frozen = states(&rows(squeezed), TwoPhaseOptions { has_closure: false, is_sharp: false }, dt)[2];
    assert_eq!(frozen.w[primitive::PHI], 0.4);
    assert!(frozen.w[primitive::PRESSURE] - 1e5 > 100.0 * (state.w[primitive::PRESSURE] - 1e5));
}
