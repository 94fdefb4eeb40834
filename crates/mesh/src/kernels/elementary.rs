//! Logarithm and exponential without branches or tables, so that rows of them vectorise.
//!
//! The compiler does not vectorise calls of the mathematical library. These are as exact within the ranges given, and
//! the same on every machine.

/// ln 2 in two parts: the first times an integer below 2¹¹ is exact.
const LN2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];

/// ln(1 + `increment`), for which 1 + `increment` is also given as `ratio`.
///
/// No digits are lost for `increment` near 0, nor for one near −1, where `ratio` counts. Polynomial in
/// s = f/(2 + f) for 1 + f in [√½, √2): FreeBSD msun, `e_log.c` (Sun Microsystems 1993).
///
/// - valid for: normal `ratio` > 0; otherwise some number. errors: none.
/// - tested by: 3 units in the last place against the standard library.
#[inline(always)]
#[must_use]
pub fn ln_of(ratio: f64, increment: f64) -> f64 {
    const ROOT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
    const ONE: u64 = 0x3ff0_0000_0000_0000;
    const MANTISSA: u64 = 0x000f_ffff_ffff_ffff;
    // An integer below 2⁵² in the mantissa of 2⁵² is that number.
    const TWO_52: u64 = 0x4330_0000_0000_0000;
    let near = increment > -0.5;
    let whole = if near { 1.0 + increment } else { ratio };
    let bits = whole.to_bits().wrapping_add(ONE - ROOT_HALF);
    let exponent = f64::from_bits(TWO_52 | (bits >> 52)) - (4_503_599_627_370_496.0 + 1023.0);
    let scaled = f64::from_bits((bits & MANTISSA).wrapping_add(ROOT_HALF));
    let f = if near & (exponent == 0.0) { increment } else { scaled - 1.0 };
    let s = f / (2.0 + f);
    let z = s * s;
    let w = z * z;
    let even =
        w * (3.999_999_999_940_942e-1 + w * (2.222_219_843_214_978_4e-1 + w * 1.531_383_769_920_937_3e-1));
    let odd = z
        * (6.666_666_666_666_735e-1
            + w * (2.857_142_874_366_239e-1
                + w * (1.818_357_216_161_805e-1 + w * 1.479_819_860_511_658_6e-1)));
    let half_square = 0.5 * f * f;
    exponent * LN2[0] - ((half_square - (s * (half_square + (even + odd)) + exponent * LN2[1])) - f)
}

/// (eˣ, eˣ − 1), the second without loss of digits for small x.
///
/// eˣ = 2ᵏ eʳ with |r| ≤ ½ ln 2, Taylor series of eʳ − 1 to r¹³.
///
/// - valid for: |x| < 700; otherwise some number. errors: none.
/// - tested by: 3 units in the last place against the standard library.
#[inline(always)]
#[must_use]
pub fn exp_and_less_one(x: f64) -> (f64, f64) {
    // Added to a number below 2⁵¹, it leaves the nearest integer in the low bits.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    let shifted = x * std::f64::consts::LOG2_E + ROUND;
    let k = shifted - ROUND;
    let power = f64::from_bits((shifted.to_bits() << 52).wrapping_add(0x3ff0_0000_0000_0000));
    let r = (x - k * LN2[0]) - k * LN2[1];
    // 1/2!, 1/3!, …: even and odd terms apart, so that they do not wait for each other.
    let z = r * r;
    let even = 1.0 / 2.0
        + z * (1.0 / 24.0
            + z * (1.0 / 720.0 + z * (1.0 / 40_320.0 + z * (1.0 / 3_628_800.0 + z * (1.0 / 479_001_600.0)))));
    let odd = 1.0 / 6.0
        + z * (1.0 / 120.0
            + z * (1.0 / 5040.0
                + z * (1.0 / 362_880.0 + z * (1.0 / 39_916_800.0 + z * (1.0 / 6_227_020_800.0)))));
    let less_one = r + z * (even + r * odd);
    (power + power * less_one, power * less_one + (power - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(got: f64, want: f64, at: f64) {
        assert!((got - want).abs() <= 3.0 * f64::EPSILON * want.abs(), "{got} {want} at {at}");
    }

    #[test]
    fn logarithms_are_those_of_the_standard_library() {
        for step in 0..200_000 {
            let exponent = -280.0 + 0.0028 * f64::from(step);
            let ratio = 10_f64.powf(exponent);
            close(
                ln_of(ratio, ratio - 1.0),
                if ratio > 0.5 { (ratio - 1.0).ln_1p() } else { ratio.ln() },
                ratio,
            );
            for increment in [ratio.min(0.9), -ratio.min(0.9)] {
                close(ln_of(1.0 + increment, increment), increment.ln_1p(), increment);
            }
        }
        assert_eq!(ln_of(1.0, 0.0), 0.0);
    }

    #[test]
    fn exponentials_are_those_of_the_standard_library() {
        for step in -200_000..200_000 {
            for x in [f64::from(step) * 0.0034, 1e-300_f64.powf((f64::from(step) / 2e5).abs())] {
                let (exp, less_one) = exp_and_less_one(x);
                close(exp, x.exp(), x);
                close(less_one, x.exp_m1(), x);
            }
        }
        assert_eq!(exp_and_less_one(0.0), (1.0, 0.0));
    }
}
