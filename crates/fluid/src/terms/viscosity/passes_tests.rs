//! The loops against what they stand for, cell by cell and bit by bit.

use super::*;

const STRIDE: usize = 12;
const CELLS: usize = 8;
const ORIGIN: usize = 2 * STRIDE + 2;

/// Rows of padded cells that look like nothing in particular.
fn row(number: usize) -> Vec<f64> {
    (0..STRIDE * STRIDE).map(|k| ((k * (number + 3)) as f64 * 0.37 + number as f64).sin()).collect()
}

/// Viscosities of cells, all of them one or not.
fn viscosities_of(are_one: bool) -> [Vec<f64>; 2] {
    [0, 1].map(|number| row(number).into_iter().map(|x| if are_one { 1.5 } else { 1.1 + x }).collect())
}

fn bits(row: &[f64]) -> Vec<u64> {
    row.iter().map(|x| x.to_bits()).collect()
}

#[test]
fn what_passes_through_faces_is_what_cells_have_between_them() {
    for are_one in [false, true] {
        let [shear, bulk] = viscosities_of(are_one);
        let parts = Parts { shear: &shear, bulk: &bulk, are_one };
        let [mut normal, mut tangential, mut hoop] = [2, 3, 4].map(row);
        let (u, w) = (row(5), row(6));
        let stress = FaceStress { normal: &mut normal, shear: &mut tangential, hoop: &mut hoop };
        for step in [1, STRIDE] {
            let range = ORIGIN - step..ORIGIN + CELLS * STRIDE;
            let mut found = [7, 8, 9].map(row);
            let mut expected = found.clone();
            pass(parts, (range.clone(), step), [&u, &w], &stress, found.each_mut().map(|row| &mut row[..]));
            for k in range {
                let plain = Parts { are_one: false, ..parts };
                let [u, w] = [&u, &w].map(|v| plain.velocity(k, step, v));
                expected[0][k] -= stress.normal[k];
                expected[1][k] -= stress.shear[k];
                expected[2][k] -= stress.normal[k] * u + stress.shear[k] * w;
            }
            for (found, expected) in found.iter().zip(&expected) {
                assert_eq!(bits(found), bits(expected), "{are_one} {step}");
            }
        }
    }
}

#[test]
fn cells_are_accelerated_by_the_stresses_on_their_faces() {
    let inverse_h = [3.0, 7.0];
    let [z_normal, z_shear, r_normal, r_shear, r_hoop] = [2, 3, 4, 5, 6].map(row);
    let on_faces = ([&z_normal[..], &z_shear[..]], [&r_normal[..], &r_shear[..], &r_hoop[..]]);
    let density: Vec<f64> = row(7).into_iter().map(|x| 2.0 + x).collect();
    let inverse_r: Vec<f64> = row(8).into_iter().map(|x| 1.5 + x).collect();
    for are_one in [false, true] {
        let [shear, bulk] = viscosities_of(are_one);
        let parts = Parts { shear: &shear, bulk: &bulk, are_one };
        let force = |k: usize| {
            let below = k - STRIDE;
            let [low, high] = [-0.5, 0.5].map(|half| 1.0 + half * inverse_r[k] / inverse_h[1]);
            [
                inverse_h[0] * (z_normal[k] - z_normal[k - 1])
                    + inverse_h[1] * (high * r_shear[k] - low * r_shear[below]),
                inverse_h[0] * (z_shear[k] - z_shear[k - 1])
                    + inverse_h[1] * (r_normal[k] - r_normal[below])
                    + 0.5 * inverse_r[k] * parts.hoop(k, STRIDE, &r_normal, &r_hoop),
            ]
        };
        let cells = OfCells { parts, density: &density, inverse_r: &inverse_r, inverse_h, stride: STRIDE };
        let half_dt = 0.013;
        let mut gained = [9, 10].map(row);
        let mut expected = gained.clone();
        gain(cells, (CELLS, ORIGIN, half_dt), on_faces, gained.each_mut().map(|row| &mut row[..]));
        for first in (0..CELLS + 2).map(|j| ORIGIN + j * STRIDE - STRIDE - 1) {
            for k in first..first + CELLS + 2 {
                let gain = half_dt / density[k];
                (0..2).for_each(|axis| expected[axis][k] += gain * force(k)[axis]);
            }
        }
        let mut rates = [11, 12].map(row);
        let mut expected_rates = rates.clone();
        accelerations(cells, (CELLS, ORIGIN), on_faces, rates.each_mut().map(|row| &mut row[..]));
        for k in (0..CELLS * CELLS).map(|cell| ORIGIN + cell / CELLS * STRIDE + cell % CELLS) {
            (0..2).for_each(|axis| expected_rates[axis][k] = force(k)[axis] / density[k]);
        }
        for axis in 0..2 {
            assert_eq!(bits(&gained[axis]), bits(&expected[axis]), "{are_one} {axis}");
            assert_eq!(bits(&rates[axis]), bits(&expected_rates[axis]), "{are_one} {axis}");
        }
    }
}

#[test]
fn rows_are_uniform_and_have_their_least_wherever_it_is() {
    let mut row = vec![3.0; 147];
    assert!(is_uniform(&row) && is_uniform(&[]) && least(&row) == 3.0);
    for place in [0, 70, 146] {
        row[place] = 2.0;
        assert!(!is_uniform(&row) && least(&row) == 2.0, "{place}");
        row[place] = f64::NAN;
        assert!(!is_uniform(&row) && least(&row) == 3.0, "{place}");
        row[place] = 3.0;
    }
}
