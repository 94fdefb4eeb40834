//! The wave curves of rows of faces.

use mesh::{exp_and_less_one, ln_of};

use super::{LANES, Lane, Sides};

/// What a wave curve is at the iterate: f_K and its derivatives by P, times P and P².
#[derive(Clone, Copy)]
pub(super) struct Curve {
    pub f: Lane,
    pub slope: Lane,
    pub curvature: Lane,
}

impl Curve {
    pub const ZERO: Self = Self { f: [0.0; LANES], slope: [0.0; LANES], curvature: [0.0; LANES] };
}

/// The wave curve of one side, as `curve` of the scalar solver, in two loops: the logarithms, and what is made of them. In one, and
/// with both sides in it, the processor would not see the next faces before these are through.
///
/// - returns: whether all waves are weak.
#[inline(always)]
pub(super) fn curve(n: usize, s: &Sides, p: &Lane, shifted: &Lane, curve: &mut Curve) -> bool {
    if weak_curve(n, s, p, shifted, curve) {
        return true;
    }
    let Curve { f: weak_f, slope, curvature } = curve;
    let mut of_strong = [0.0; LANES];
    let f = &mut of_strong;
    let exponent = &mut *f;
    for k in 0..n.min(LANES) {
        let x = (p[k] - s.p[k]) * s.inverse_base[k];
        let ratio = (shifted[k] + s.offset[k]) * s.inverse_base[k];
        exponent[k] = s.m[k] * ln_of(ratio, x);
    }
    for k in 0..n.min(LANES) {
        let (m, inverse_base) = (s.m[k], s.inverse_base[k]);
        let a = 1.0 - m;
        let per_gamma = s.c[k] * (1.0 - 2.0 * m);
        let x = (p[k] - s.p[k]) * inverse_base;
        let ratio = (shifted[k] + s.offset[k]) * inverse_base;
        let lever = shifted[k] * inverse_base;
        let shock = x > 0.0;
        // Both waves are made, with one division between them, and one is chosen.
        let inverse = 1.0 / if shock { 1.0 + a * x } else { ratio };
        let scale = per_gamma * inverse.sqrt();
        let (power, less_one) = exp_and_less_one(f[k]);
        let slope_shock = scale * inverse * (1.0 + 0.5 * a * x) * lever;
        let slope_fan = per_gamma * power * (lever * inverse);
        let curvature_shock = -scale * (inverse * inverse) * a * (1.0 + 0.25 * a * x) * (lever * lever);
        let curvature_fan = -a * slope_fan * (lever * inverse);
        let is_weak = x.abs() < WEAK;
        let pick = |weak: f64, shock_: f64, fan: f64| {
            if is_weak {
                weak
            } else if shock {
                shock_
            } else {
                fan
            }
        };
        weak_f[k] = pick(weak_f[k], scale * x, s.escape[k] * less_one);
        slope[k] = pick(slope[k], slope_shock, slope_fan);
        curvature[k] = pick(curvature[k], curvature_shock, curvature_fan);
    }
    false
}

/// Changes of the pressure, as a share of p + π, below which a wave is weak.
const WEAK: f64 = 1.0 / 512.0;

/// [`curve`] of weak waves, by series in x = (p − p_K)/P_K: what they leave out of f is 2·10⁻¹⁷ of it, of its first derivative
/// 3·10⁻⁹, of the second 2·10⁻³, less than an acoustic guess asks of one step to be exact.
///
/// - returns: whether all waves are weak.
#[inline(always)]
fn weak_curve(n: usize, s: &Sides, p: &Lane, shifted: &Lane, curve: &mut Curve) -> bool {
    let Curve { f, slope, curvature } = curve;
    let mut strong = 0;
    for k in 0..n.min(LANES) {
        let m = s.m[k];
        let a = 1.0 - m;
        let per_gamma = s.c[k] * (1.0 - 2.0 * m);
        let x = (p[k] - s.p[k]) * s.inverse_base[k];
        let lever = shifted[k] * s.inverse_base[k];
        let shock = x > 0.0;
        // (1 + t)^-½ with t = ax, and ((1 + x)^m − 1)/(mx).
        let t = a * x;
        let of_shock = 1.0
            + t * (-1.0 / 2.0
                + t * (3.0 / 8.0 + t * (-5.0 / 16.0 + t * (35.0 / 128.0 + t * (-63.0 / 256.0)))));
        let next = |number: f64, inner: f64| 1.0 + x * ((m - number) * (1.0 / (number + 1.0))) * inner;
        let of_fan = next(1.0, next(2.0, next(3.0, next(4.0, next(5.0, 1.0)))));
        let bend = if shock { (9.0 / 8.0) * (a * a) } else { 0.5 * (a * (1.0 + a)) };
        f[k] = per_gamma * (x * if shock { of_shock } else { of_fan });
        slope[k] = per_gamma * (1.0 - x * (a - x * bend)) * lever;
        curvature[k] = per_gamma * (2.0 * (x * bend) - a) * (lever * lever);
        strong += u64::from(!(x.abs() < WEAK));
    }
    strong == 0
}
