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
#[inline(always)]
pub(super) fn curve(n: usize, s: &Sides, p: &Lane, shifted: &Lane, curve: &mut Curve) {
    let mut exponent = [0.0; LANES];
    for k in 0..n.min(LANES) {
        let x = (p[k] - s.p[k]) * s.inverse_base[k];
        let ratio = (shifted[k] + s.offset[k]) * s.inverse_base[k];
        exponent[k] = s.m[k] * ln_of(ratio, x);
    }
    let Curve { f, slope, curvature } = curve;
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
        let (power, less_one) = exp_and_less_one(exponent[k]);
        let slope_shock = scale * inverse * (1.0 + 0.5 * a * x) * lever;
        let slope_fan = per_gamma * power * (lever * inverse);
        let curvature_shock = -scale * (inverse * inverse) * a * (1.0 + 0.25 * a * x) * (lever * lever);
        let curvature_fan = -a * slope_fan * (lever * inverse);
        f[k] = if shock { scale * x } else { s.escape[k] * less_one };
        slope[k] = if shock { slope_shock } else { slope_fan };
        curvature[k] = if shock { curvature_shock } else { curvature_fan };
    }
}
