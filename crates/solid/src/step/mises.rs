//! Whether anything in rows of stresses may yield.

use mesh::maximum;
use multiversion::multiversion;

use crate::material::yield_criterion::von_mises_squared;

/// Of the squared flow stress: rounding must not keep a cell from its return.
pub(crate) const LEAST: f64 = 1.0 - 1e-9;

/// The largest squared von Mises stress in rows of σ_zz, σ_zr, σ_rr, σ_φφ, infinite if one is not a number.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn largest_mises(stress: [&[f64]; 4]) -> f64 {
    const LANES: usize = 32;
    let n = stress[0].len();
    let [zz, zr, rr, phiphi] = stress.map(|row| &row[..n]);
    let mut lanes = [0.0; LANES];
    let whole = n - n % LANES;
    for first in (0..whole).step_by(LANES) {
        for lane in 0..LANES {
            let k = first + lane;
            let squared = von_mises_squared(zz[k], zr[k], rr[k], phiphi[k]);
            let squared = if squared < f64::MAX { squared } else { f64::INFINITY };
            lanes[lane] = if squared > lanes[lane] { squared } else { lanes[lane] };
        }
    }
    let mut largest = maximum(&lanes);
    for k in whole..n {
        let squared = von_mises_squared(zz[k], zr[k], rr[k], phiphi[k]);
        let squared = if squared < f64::MAX { squared } else { f64::INFINITY };
        largest = if squared > largest { squared } else { largest };
    }
    largest
}
