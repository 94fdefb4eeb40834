//! Elementary functions for rows of cells, free of branches, and powers near to known ones.

use mesh::{exp_and_less_one, ln_of};

/// Up to this, powers of 1 + x and eˣ are made of their series.
pub(super) const NEAR: f64 = 1.0 / 64.0;

/// Terms of (1 + x)ⁿ: for n up to as many, what is left out of it is below 1e-17.
pub(super) const TERMS: usize = 8;

/// The smaller number, by comparison, so that rows vectorise.
#[inline(always)]
pub(super) fn lower(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline(always)]
pub(super) fn upper(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[inline(always)]
pub(super) fn ln(x: f64) -> f64 {
    ln_of(x, x - 1.0)
}

/// The binomial coefficients of an exponent, from the first power on.
pub(super) fn binomial(exponent: f64) -> [f64; TERMS] {
    let mut coefficients = [exponent; TERMS];
    for k in 1..TERMS {
        coefficients[k] = coefficients[k - 1] * (exponent - k as f64) / (k + 1) as f64;
    }
    coefficients
}

/// ((1 + x)ⁿ − 1)/x.
#[inline(always)]
pub(super) fn series(binomial: &[f64; TERMS], x: f64) -> f64 {
    binomial[..TERMS - 1].iter().rev().fold(binomial[TERMS - 1], |sum, coefficient| coefficient + x * sum)
}

#[inline(always)]
pub(super) fn exp(x: f64) -> f64 {
    // Below, what is nearly nothing stays so: T*ᵐ of a cell that is hardly warm has such logarithms.
    exp_and_less_one(upper(x, -700.0)).0
}
