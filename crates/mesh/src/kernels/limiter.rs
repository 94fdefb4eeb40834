//! Slope limiters of the linear reconstruction.

crate::named! {
    /// How the slope in a cell is made from the differences to its two neighbours.
    pub enum Limiter {
        /// Monotonised central (van Leer 1977): second order, total-variation diminishing; the default.
        Mc = "mc",
        /// The smaller difference, zero where the signs differ.
        Minmod = "minmod",
        /// The smaller difference in absolute value whatever the signs: the paper's printed rule, not TVD.
        Eno = "eno",
        /// The central difference, unlimited: for smooth solutions and orders of convergence.
        None = "none",
    }
}

impl Limiter {
    /// The limited difference of a cell from the differences to its lower and upper neighbour.
    ///
    /// - `lower` = w_i − w_{i−1}, `upper` = w_{i+1} − w_i on a uniform grid.
    /// - returns: the difference across the cell, h times the slope.
    #[inline(always)]
    pub fn difference(self, lower: f64, upper: f64) -> f64 {
        match self {
            Self::Mc => monotonised_central(lower, upper),
            Self::Minmod => minmod(lower, upper),
            Self::Eno => smaller(lower, upper),
            Self::None => 0.5 * (lower + upper),
        }
    }
}

/// The smaller of two numbers in absolute value; 0 where their signs differ.
#[inline(always)]
pub(crate) fn minmod(a: f64, b: f64) -> f64 {
    of_one_sign(lower(a, b), upper(a, b))
}

/// Monotonised central difference, van Leer (1977): the central one, bounded by zero and twice the smaller one.
#[inline(always)]
fn monotonised_central(a: f64, b: f64) -> f64 {
    let (most, least) = (upper(2.0 * lower(a, b), 0.0), lower(2.0 * upper(a, b), 0.0));
    upper(lower(0.5 * (a + b), most), least)
}

/// Of the lowest and the highest of some numbers the one nearer to zero if they have one sign, else zero. Minima and
/// maxima are single instructions; a product of the numbers would underflow.
#[inline(always)]
fn of_one_sign(lowest: f64, highest: f64) -> f64 {
    upper(lowest, 0.0) + lower(highest, 0.0)
}

#[inline(always)]
fn smaller(a: f64, b: f64) -> f64 {
    if a.abs() <= b.abs() { a } else { b }
}

/// By comparison, without the NaN rules of `f64::min`, so that rows vectorise.
#[inline(always)]
fn lower(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline(always)]
fn upper(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Limited differences of one component of a padded block, along z and along r.
///
/// - `values`: one flat component of a [`crate::Padded`] block; `stride`: its STRIDE.
/// - `along_z`, `along_r`: of the same length; written from `stride + 1` to `len − stride − 1`, that is in
///   all cells but the outermost layer, where some neighbour is missing.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub fn limited_differences(
    limiter: Limiter,
    values: &[f64],
    stride: usize,
    along_z: &mut [f64],
    along_r: &mut [f64],
) {
    match limiter {
        Limiter::Mc => differences(monotonised_central, values, stride, along_z, along_r),
        Limiter::Minmod => differences(minmod, values, stride, along_z, along_r),
        Limiter::Eno => differences(smaller, values, stride, along_z, along_r),
        Limiter::None => differences(|a, b| 0.5 * (a + b), values, stride, along_z, along_r),
    }
}

#[inline(always)]
fn differences(
    limit: impl Fn(f64, f64) -> f64,
    values: &[f64],
    stride: usize,
    along_z: &mut [f64],
    along_r: &mut [f64],
) {
    let first = stride + 1;
    let n = values.len() - 2 * first;
    let centre = &values[first..][..n];
    let (west, east) = (&values[first - 1..][..n], &values[first + 1..][..n]);
    let (south, north) = (&values[first - stride..][..n], &values[first + stride..][..n]);
    let (along_z, along_r) = (&mut along_z[first..][..n], &mut along_r[first..][..n]);
    for k in 0..n {
        along_z[k] = limit(centre[k] - west[k], east[k] - centre[k]);
        along_r[k] = limit(centre[k] - south[k], north[k] - centre[k]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limiters_at_hand_picked_differences() {
        // (lower, upper) -> mc, minmod, eno, none
        let table = [
            (1.0, 1.0, [1.0, 1.0, 1.0, 1.0]),
            (1.0, 3.0, [2.0, 1.0, 1.0, 2.0]),
            (1.0, 9.0, [2.0, 1.0, 1.0, 5.0]),
            (-4.0, -1.0, [-2.0, -1.0, -1.0, -2.5]),
            (2.0, -1.0, [0.0, 0.0, -1.0, 0.5]),
            (0.0, 5.0, [0.0, 0.0, 0.0, 2.5]),
        ];
        for (lower, upper, expected) in table {
            for ((name, limiter), want) in Limiter::NAMES.iter().zip(expected) {
                assert_eq!(limiter.difference(lower, upper), want, "{name} of {lower}, {upper}");
                assert_eq!(limiter.difference(-lower, -upper), -want, "{name} is odd");
            }
        }
    }

    /// To the last bit, zeros too, which have no sign.
    #[test]
    fn the_monotonised_central_difference_is_the_smallest_of_three() {
        let numbers: [f64; 10] = [0.0, -0.0, 1.0, -1.0, 0.3, -0.7, 5e-324, -1e-300, 3e200, -1e300];
        for (a, b) in numbers.into_iter().flat_map(|a| numbers.map(|b| (a, b))) {
            let smallest = (2.0 * f64::min(a.abs(), b.abs())).min((0.5 * (a + b)).abs());
            let has_one_sign = a > 0.0 && b > 0.0 || a < 0.0 && b < 0.0;
            let wanted = if has_one_sign { smallest.copysign(a) } else { 0.0 };
            let found = Limiter::Mc.difference(a, b);
            // Half of the least number there is underflows.
            let is_zero = found == 0.0 && wanted == 0.0;
            assert!(found.to_bits() == wanted.to_bits() || is_zero, "{a} {b}: {found} {wanted}");
        }
    }

    #[test]
    fn the_row_kernel_equals_the_point_function() {
        let stride = 12;
        let values: Vec<f64> = (0..stride * stride).map(|k| ((k * k) as f64 * 0.37).sin()).collect();
        for (_, limiter) in Limiter::NAMES {
            let mut z = vec![0.0; values.len()];
            let mut r = z.clone();
            limited_differences(limiter, &values, stride, &mut z, &mut r);
            for k in stride + 1..values.len() - stride - 1 {
                let d = |step: usize| {
                    limiter.difference(values[k] - values[k - step], values[k + step] - values[k])
                };
                assert_eq!((z[k], r[k]), (d(1), d(stride)));
            }
        }
    }
}
