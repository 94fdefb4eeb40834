//! A bound from below on the flow stress that costs next to nothing, so that elastic cells cost next to nothing.

use multiversion::multiversion;

use super::hardening::Hardening;

/// Relative margin by which the bound with heat stays below the law, whose rounding is another.
const MARGIN: f64 = 1e-12;

/// The bound (a + h ε_p)(1 − o − k (T − T_r)), the last factor 1 up to T_r and never negative.
///
/// Exact for perfect and linear laws and for any law that has never yielded. Hardening of power laws and tables is left
/// out: who is beyond the bound is looked at closely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Screen {
    strength: f64,
    hardening: f64,
    reference: f64,
    offset: f64,
    per_kelvin: f64,
}

impl Screen {
    pub fn new(hardening: &Hardening) -> Self {
        let (strength, modulus) = match hardening {
            Hardening::Perfect(law) => (law.yield_strength, 0.0),
            Hardening::Linear(law) => (law.yield_strength, law.hardening_modulus),
            Hardening::JohnsonCook(law) => (law.yield_strength, 0.0),
            Hardening::Table(law) => (law.points().map(|[_, stress]| stress).next().unwrap_or(0.0), 0.0),
        };
        let cold = Self { strength, hardening: modulus, reference: 0.0, offset: 0.0, per_kelvin: 0.0 };
        let Some(softening) = hardening.softening() else { return cold };
        let m = softening.softening_exponent;
        // T*^m lies below T* for m >= 1, and below any of its tangents for m < 1: that at 1/8.
        let (offset, slope) = if m >= 1.0 {
            (0.0, 1.0)
        } else {
            let touch = 0.125_f64;
            ((1.0 - m) * touch.powf(m), m * touch.powf(m - 1.0))
        };
        let (offset, per_kelvin) = (offset + MARGIN, slope / softening.range());
        Self { reference: softening.reference_temperature, offset, per_kelvin, ..cold }
    }

    /// Whether a stress of this q² (Pa²) may lie outside; no number counts as outside.
    #[inline(always)]
    pub fn is_beyond(&self, von_mises_squared: f64, strain: f64) -> bool {
        let bound = self.strength + self.hardening * strain;
        !(von_mises_squared <= bound * bound)
    }

    /// The same for a law with heat.
    #[inline(always)]
    pub fn is_beyond_hot(&self, von_mises_squared: f64, strain: f64, temperature: f64) -> bool {
        let rise = temperature - self.reference;
        let left = (1.0 - self.offset - self.per_kelvin * rise).max(0.0);
        let left = if rise > 0.0 { left } else { 1.0 };
        let bound = (self.strength + self.hardening * strain) * left;
        !(von_mises_squared <= bound * bound)
    }
}

/// Whether any cell of some may lie outside: their stresses zz, zr, rr, φφ and plastic strains, of one length.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn any_beyond(screen: &Screen, stress: [&[f64]; 4], strain: &[f64]) -> bool {
    let n = strain.len();
    let [zz, zr, rr, phiphi] = stress.map(|row| &row[..n]);
    let mut any = false;
    for k in 0..n {
        let squared = crate::material::yield_criterion::von_mises_squared(zz[k], zr[k], rr[k], phiphi[k]);
        any |= screen.is_beyond(squared, strain[k]);
    }
    any
}

/// The same for a law with heat.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn any_beyond_hot(
    screen: &Screen,
    stress: [&[f64]; 4],
    strain: &[f64],
    temperature: &[f64],
) -> bool {
    let n = strain.len();
    let [zz, zr, rr, phiphi] = stress.map(|row| &row[..n]);
    let temperature = &temperature[..n];
    let mut any = false;
    for k in 0..n {
        let squared = crate::material::yield_criterion::von_mises_squared(zz[k], zr[k], rr[k], phiphi[k]);
        any |= screen.is_beyond_hot(squared, strain[k], temperature[k]);
    }
    any
}
