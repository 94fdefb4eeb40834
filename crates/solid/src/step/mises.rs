//! Whether anything in rows of stresses may yield.

use mesh::maximum;
use multiversion::multiversion;

use crate::material::yield_criterion::von_mises_squared;

/// Of the squared flow stress: rounding must not keep a cell from its return.
pub(crate) const LEAST: f64 = 1.0 - 1e-9;

/// Cells looked at together. Rows of a tile, ghosts included, are whole multiples of it.
const LANES: usize = 8;

/// The largest squared von Mises stress in rows of σ_zz, σ_zr, σ_rr, σ_φφ, infinite if one is not a number.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn largest_mises(stress: [&[f64]; 4]) -> f64 {
    let n = stress[0].len();
    // Of arrays the compiler knows the length; of slices with an index into all four it makes no SIMD batches.
    let [zz, zr, rr, phiphi] = stress.map(|row| row[..n].as_chunks::<LANES>().0);
    let mut lanes = [0.0; LANES];
    for (((zz, zr), rr), phiphi) in zz.iter().zip(zr).zip(rr).zip(phiphi) {
        for lane in 0..LANES {
            let squared = von_mises_squared(zz[lane], zr[lane], rr[lane], phiphi[lane]);
            let squared = if squared < f64::MAX { squared } else { f64::INFINITY };
            lanes[lane] = if squared > lanes[lane] { squared } else { lanes[lane] };
        }
    }
    let [zz, zr, rr, phiphi] = stress.map(|row| &row[n - n % LANES..n]);
    let mut largest = maximum(&lanes);
    for (((zz, zr), rr), phiphi) in zz.iter().zip(zr).zip(rr).zip(phiphi) {
        let squared = von_mises_squared(*zz, *zr, *rr, *phiphi);
        let squared = if squared < f64::MAX { squared } else { f64::INFINITY };
        largest = if squared > largest { squared } else { largest };
    }
    largest
}
