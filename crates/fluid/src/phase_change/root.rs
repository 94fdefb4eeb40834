//! The root of a function that falls.

/// The place within [low, high] where a falling function is zero; an end where it has one sign.
///
/// Regula falsi with the weights of Anderson & Björck (1973): the bracket is kept, so that any function ends, with values of which only
/// the sign is known, too.
///
/// - `close`: how small a bracket has to be.
/// - tested by: a logarithm, a step, ends.
pub(super) fn falling_root(low: f64, high: f64, close: f64, f: impl Fn(f64) -> f64) -> f64 {
    const TURNS: usize = 200;
    let (mut a, mut b) = (low, high);
    let (mut f_a, mut f_b) = (f(a), f(b));
    if !(f_a > 0.0) {
        return low;
    }
    if f_b >= 0.0 {
        return high;
    }
    for turn in 0..TURNS {
        if (b - a).abs() <= close {
            break;
        }
        let secant = a + (b - a) * f_a / (f_a - f_b);
        // Where the values are all but useless halves go on.
        let is_within = secant > a.min(b) && secant < a.max(b);
        let x = if is_within && turn % 8 != 7 { secant } else { 0.5 * (a + b) };
        let value = f(x);
        if value == 0.0 {
            return x;
        }
        if value > 0.0 {
            f_b *= weight(value, f_a);
            (a, f_a) = (x, value);
        } else {
            f_a *= weight(value, f_b);
            (b, f_b) = (x, value);
        }
    }
    0.5 * (a + b)
}

/// What the value at the end that stays is weighted with.
fn weight(value: f64, replaced: f64) -> f64 {
    let weight = 1.0 - value / replaced;
    if weight > 0.0 { weight } else { 0.5 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_found_and_ends_kept() {
        let root = falling_root(1e-8, 50.0, 1e-13, |x| -(x / 3.0).ln());
        approx::assert_relative_eq!(root, 3.0, max_relative = 1e-12);
        let step = falling_root(-1.0, 1.0, 1e-9, |x| if x < 0.3 { 1e3 } else { -1.0 });
        assert!((step - 0.3).abs() < 1e-8, "{step}");
        assert_eq!(falling_root(0.0, 1.0, 1e-9, |x| -1.0 - x), 0.0);
        assert_eq!(falling_root(0.0, 1.0, 1e-9, |x| 2.0 - x), 1.0);
        assert_eq!(falling_root(0.0, 1.0, 1e-9, |_| f64::NAN), 0.0);
    }
}
