//! The kernels of a step with and without gas.

use crate::state::COUNT;
use mesh::{Limiter, Padded};

use super::*;
use crate::reconstruction::Reconstruction;
use crate::reconstruction::dispersion::{AlongFaces, Dispersion};
use crate::reconstruction::predictor::{Predicted, Predictor, predict};
use crate::riemann::hllc_rows::hllc_faces;
use crate::state::primitive::{PRESSURE, VELOCITY};
use crate::step::face_rows::FaceRows;
use crate::step::update::{Metric, NewCells, update};

const N: usize = 8;
const LEN: usize = Padded::<N>::LEN;
const STRIDE: usize = Padded::<N>::STRIDE;

/// Liquid with waves along both axes, and one cell that keeps no slopes; conserved variables.
fn waves() -> Padded<N> {
    let wave = |k: usize| (k as f64 * 0.37).sin() + ((k / STRIDE) as f64 * 0.9).cos();
    let mut cells = Padded::<N>::zeros(COUNT);
    for k in 0..LEN {
        let (v_z, v_r) = (30.0 * wave(k), 20.0 * wave(k + 7));
        let rho = if k == LEN / 2 { 1e-3 } else { 1000.0 + 5.0 * wave(k + 3) };
        let internal = (5e7 * (1.0 + 0.3 * wave(k)) + 7.15 * 3e8) / 6.15;
        let cell = [rho, rho * v_z, rho * v_r, internal + 0.5 * rho * (v_z * v_z + v_r * v_r), 0.0];
        cell.into_iter().enumerate().for_each(|(c, value)| cells.component_mut(c)[k] = value);
    }
    cells
}

/// What a block of liquid goes through in a step, row by row; the gas fraction's rows hold zeros before it.
fn stepped(limiter: Limiter, with_gas: bool) -> Vec<Vec<f64>> {
    let mixture = Mixture::water_and_air();
    let mut cells = waves();
    let own = |c: usize| -> Vec<f64> {
        (0..N as isize).flat_map(|j| cells.component(c)[Padded::<N>::index(0, j)..][..N].to_vec()).collect()
    };
    let old: [Vec<f64>; COUNT] = std::array::from_fn(own);

    to_primitive(cells.split_mut(), with_gas, None, &mixture);
    let [mut s_z, mut s_r, mut half] = std::array::from_fn(|_| Padded::<N>::zeros(COUNT));
    let (mut keep, mut sound, inverse_r) = (vec![0.0; LEN], vec![0.0; LEN], vec![40.0; LEN]);
    let inverse_h = [3e4, 5e4];
    let predictor = Predictor {
        limiter,
        fraction_limiter: Limiter::Mc,
        stride: STRIDE,
        inverse_h,
        inverse_r: &inverse_r,
        gas_shares: &inverse_r,
        half_dt: 2e-9,
        mixture,
        with_gas,
        with_mixed: false,
    };
    predict(
        cells.split(),
        predictor,
        Predicted {
            s_z: s_z.split_mut(),
            s_r: s_r.split_mut(),
            half: half.split_mut(),
            keep: &mut keep,
            sound: &mut sound,
        },
    );
    let mut faces = [FaceRows::zeros(LEN, STRIDE), FaceRows::zeros(LEN, STRIDE)];
    let [rho, v_z, v_r, p, phi] = half.split();
    for (axis, faces) in faces.iter_mut().enumerate() {
        let (step, along, [d_rho, d_z, d_r, d_p, d_phi]) =
            if axis == 0 { (1, STRIDE, s_z.split()) } else { (STRIDE, 1, s_r.split()) };
        let across = [&s_r, &s_z][axis];
        let [states, differences] = if axis == 0 {
            [[rho, v_z, v_r, p, phi], [d_rho, d_z, d_r, d_p, d_phi]]
        } else {
            [[rho, v_r, v_z, p, phi], [d_rho, d_r, d_z, d_p, d_phi]]
        };
        let reconstruction = Reconstruction {
            half: states,
            differences,
            keep: &keep,
            sound: &sound,
            gas_shares: &sound,
            with_gas,
            dispersion: Dispersion { per_speed: 1e-4, aspect: 0.6, liquid_pi: 3e8 },
            along_faces: AlongFaces::new([VELOCITY[axis], PRESSURE].map(|c| across.component(c)), along),
        };
        let first = Padded::<N>::index(0, 0) - step;
        let last = Padded::<N>::index(N as isize - 1, N as isize - 1);
        hllc_faces(&reconstruction, step, STRIDE, first..last + 1, &mixture, false, faces);
    }
    let metric = Metric {
        stride: STRIDE,
        origin: Padded::<N>::index(0, 0),
        dt: 4e-9,
        inverse_h,
        face_weight: &[0.02; N + 1],
        inverse_weight: &[50.0; N],
    };
    let [mut new, mut speeds] = [vec![0.0; COUNT * N * N], vec![0.0; 3 * N * N]];
    let mut rows = new.chunks_exact_mut(N * N);
    let mut speed_rows = speeds.chunks_exact_mut(N * N);
    update::<N>(
        old.each_ref().map(|row| &row[..]),
        faces.each_ref(),
        &metric,
        (with_gas, None),
        &mixture,
        NewCells {
            conserved: std::array::from_fn(|_| rows.next().unwrap()),
            speeds: std::array::from_fn(|_| speed_rows.next().unwrap()),
        },
    );
    let padded = [&cells, &s_z, &s_r, &half].map(|rows| rows.split::<COUNT>().map(<[f64]>::to_vec)).concat();
    let fluxes = faces.iter().flat_map(|faces| faces.fluxes().map(<[f64]>::to_vec));
    padded.into_iter().chain(fluxes).chain([keep, new, speeds]).collect()
}

#[test]
fn liquid_steps_alike_whether_gas_is_looked_for_or_not() {
    for (name, limiter) in Limiter::NAMES {
        let (with, without) = (stepped(limiter, true), stepped(limiter, false));
        assert_eq!(with.len(), without.len());
        for (row, (with, without)) in with.iter().zip(&without).enumerate() {
            for (k, (a, b)) in with.iter().zip(without).enumerate() {
                // What lies beyond the block may be no state, and a sum of nothing has either sign.
                assert!(a == b || (a.is_nan() && b.is_nan()), "{name}, row {row}, {k}: {a} {b}");
            }
        }
        let [new, speeds] = [&with[with.len() - 2], &with[with.len() - 1]];
        assert!(new[..4 * N * N].iter().chain(&speeds[..2 * N * N]).all(|value| value.is_finite()), "{name}");
        let keep = &with[with.len() - 3];
        assert!(
            keep.contains(&0.0) && keep.contains(&1.0),
            "{name}: some cells keep their slopes, some do not"
        );
    }
}
