//! Kernels over the cells of one padded block: primitive variables, predictor. Those of faces are in `riemann/hllc_rows.rs` and
//! `riemann/exact_rows.rs`.
//!
//! Every function walks flat rows (a structure of arrays, see [`mesh::Padded`]) with a body free of branches, so that the compiler
//! vectorises it; each is compiled for several instruction sets and the best one is chosen at run time.
//! Rust never contracts a·b + c, so the results do not depend on that choice.

use crate::Mixture;
use crate::reconstruction::{RowsMut, fraction};
use crate::state::primitive::{PHI, PRESSURE, RHO, V_R, V_Z};
use crate::state::{PrimitiveCell, primitive_of};

/// Time derivatives of the primitive variables.
///
/// Paper eqs. (7)–(9) in primitive form, with the geometric term of the axisymmetric divergence.
///
/// - `w`: ρ, v_z, v_r, p, φ; `share`: the gas's part of the mass; `d_z`, `d_r`: derivatives of `w`, per m; `inverse_r`: 1/r, or 0 in
///   planar geometry.
/// - returns: ∂w/∂t.  valid for ρ > 0.  errors: none.
#[inline(always)]
pub(crate) fn rates(
    w: PrimitiveCell,
    d_z: PrimitiveCell,
    d_r: PrimitiveCell,
    inverse_r: f64,
    share: f64,
    mixture: &Mixture,
) -> PrimitiveCell {
    let bulk_modulus = mixture.bulk_modulus(w[RHO], w[PRESSURE], w[PHI], share);
    rates_of(w, d_z, d_r, inverse_r, 1.0 / w[RHO], bulk_modulus)
}

/// [`rates`] with 1/ρ and ρc² at hand.
#[inline(always)]
fn rates_of(
    w: PrimitiveCell,
    d_z: PrimitiveCell,
    d_r: PrimitiveCell,
    inverse_r: f64,
    inverse_rho: f64,
    bulk_modulus: f64,
) -> PrimitiveCell {
    let [rho, v_z, v_r, ..] = w;
    let divergence = d_z[V_Z] + d_r[V_R] + v_r * inverse_r;
    let advected = |k: usize| v_z * d_z[k] + v_r * d_r[k];
    [
        -(advected(RHO) + rho * divergence),
        -(advected(V_Z) + d_z[PRESSURE] * inverse_rho),
        -(advected(V_R) + d_r[PRESSURE] * inverse_rho),
        -(advected(PRESSURE) + bulk_modulus * divergence),
        -advected(PHI),
    ]
}

/// What the predictor takes from a cell's equation of state. One division makes all three: it is what the time goes
/// into.
#[derive(Clone, Copy)]
struct CellLaw {
    inverse_rho: f64,
    /// ρc², see [`Mixture::bulk_modulus`].
    bulk_modulus: f64,
    /// p + π.
    excess: f64,
}

impl CellLaw {
    /// - `bound`: what covolumes take of β₁; 0, a constant, where there is none.
    #[inline(always)]
    fn at(rho: f64, p: f64, phi: f64, bound: f64, mixture: &Mixture) -> Self {
        let (all, b2) = (mixture.beta1(phi), mixture.beta2(phi));
        let (above, b1) = (1.0 + all, all - bound);
        let inverse = 1.0 / (rho * (b1 * above));
        let per_law = inverse * rho;
        Self {
            inverse_rho: inverse * (b1 * above),
            bulk_modulus: (above * p + b2) * (above * per_law),
            excess: p + b2 * (b1 * per_law),
        }
    }
}

/// Whether the four face states of a cell, `half` ± half the differences, are fit for Riemann problems:
///
/// - densities and p + π above a thousandth of the cell's own;
/// - impedances ρc above (Δt/h) ρc² of the cell. Where gas lies beyond a face of a mixed cell, a pressure p' in
///   the cell drives the flow p'/(ρc) through the face, and that changes the pressure by (Δt/h) ρc² p'/(ρc):
///   with slopes so steep that the face state is gas while the cell is still stiff, it would overshoot
///   manyfold in every step. Smooth flow never comes near: there the ratio is the Courant number.
///
/// `ratio` is Δt/h along the narrower width.
#[inline(always)]
fn admissible<const B: bool>(
    w: PrimitiveCell,
    law: CellLaw,
    half: PrimitiveCell,
    reach: PrimitiveCell,
    ratio: f64,
    bound_per_mass: f64,
    mixture: &Mixture,
) -> bool {
    let lowest_density = half[RHO] - reach[RHO];
    // Of a face with more gas than the cell the gas's part of the mass is not known; without a covolume it is softer.
    let bound = if B && reach[PHI] == 0.0 { lowest_density * bound_per_mass } else { 0.0 };
    let face = CellLaw::at(1.0, half[PRESSURE] - reach[PRESSURE], half[PHI] + reach[PHI], bound, mixture);
    let carried = ratio * law.bulk_modulus;
    let impedance_squared = lowest_density * face.bulk_modulus;
    (lowest_density > 1e-3 * w[RHO])
        & (face.excess > 1e-3 * law.excess)
        & (impedance_squared > carried * carried)
}

#[inline(always)]
fn scaled([a, b, c, d, e]: PrimitiveCell, factor: f64) -> PrimitiveCell {
    [a * factor, b * factor, c * factor, d * factor, e * factor]
}

/// The predictor of one cell, ready to move by all of a half step or a share of it.
pub(crate) struct Prediction<'a, const B: bool> {
    w: PrimitiveCell,
    law: CellLaw,
    /// ∂w/∂t times half the time step.
    change: PrimitiveCell,
    /// Half the larger difference of ρ, p and φ.
    reach: PrimitiveCell,
    /// Δt/h along the narrower width.
    ratio: f64,
    /// What covolumes take of β₁ per mass.
    bound_per_mass: f64,
    mixture: &'a Mixture,
}

impl<'a, const B: bool> Prediction<'a, B> {
    /// - `s_z`, `s_r`: the differences over the cell. `inverse_h`: 1/h, 1/m. `inverse_r`: 1/r, 1/m. `half_dt`: half the step, s.
    /// - `bound_per_mass`: what covolumes take of β₁ per mass, see [`Mixture::bound_beta1`].
    #[expect(clippy::too_many_arguments, reason = "all that one cell has, in registers")]
    #[inline(always)]
    pub fn new(
        w: PrimitiveCell,
        s_z: PrimitiveCell,
        s_r: PrimitiveCell,
        inverse_h: [f64; 2],
        inverse_r: f64,
        half_dt: f64,
        bound_per_mass: f64,
        mixture: &'a Mixture,
    ) -> Self {
        let bound = if B { w[RHO] * bound_per_mass } else { 0.0 };
        let law = CellLaw::at(w[RHO], w[PRESSURE], w[PHI], bound, mixture);
        let (d_z, d_r) = (scaled(s_z, inverse_h[0]), scaled(s_r, inverse_h[1]));
        let rate = rates_of(w, d_z, d_r, inverse_r, law.inverse_rho, law.bulk_modulus);
        let reach = |k: usize| {
            let (a, b) = (s_z[k].abs(), s_r[k].abs());
            0.5 * if a > b { a } else { b }
        };
        let [inverse_hz, inverse_hr] = inverse_h;
        Self {
            w,
            law,
            change: scaled(rate, half_dt),
            reach: [reach(RHO), 0.0, 0.0, reach(PRESSURE), reach(PHI)],
            ratio: 2.0 * half_dt * if inverse_hz > inverse_hr { inverse_hz } else { inverse_hr },
            bound_per_mass,
            mixture,
        }
    }

    /// c, m/s.
    #[inline(always)]
    fn sound_speed(&self) -> f64 {
        (self.law.bulk_modulus * self.law.inverse_rho).sqrt()
    }

    #[inline(always)]
    fn at(&self, share: f64) -> PrimitiveCell {
        let moved = |k: usize| self.w[k] + share * self.change[k];
        [moved(RHO), moved(V_Z), moved(V_R), moved(PRESSURE), moved(PHI)]
    }

    #[inline(always)]
    fn admissible(&self, share: f64) -> bool {
        let reach = scaled(self.reach, share);
        let half = self.at(share);
        admissible::<B>(self.w, self.law, half, reach, self.ratio, self.bound_per_mass, self.mixture)
    }

    /// The state at mid-step, and the share of its slopes that the cell keeps: all (1), or half of them (MC slopes
    /// are then no steeper than minmod's), or none (0, first order), whichever gives admissible face states.
    #[inline(always)]
    pub fn half_step(&self) -> (PrimitiveCell, f64) {
        let fallback = if self.admissible(0.5) { 0.5 } else { 0.0 };
        let keep = if self.admissible(1.0) { 1.0 } else { fallback };
        (self.at(keep), keep)
    }

    /// [`Prediction::half_step`] where all slopes are kept, and the cell's sound speed; where they are not, 0 tells so and the state
    /// counts for nothing.
    #[inline(always)]
    pub fn whole_half_step<const WITH_GAS: bool>(mut self) -> (PrimitiveCell, f64, f64) {
        self.change[PHI] = fraction::<WITH_GAS>(self.change[PHI]);
        (self.at(1.0), if self.admissible(1.0) { 1.0 } else { 0.0 }, self.sound_speed())
    }
}

/// Conserved to primitive variables, in place of rows of equal length; without gas the last row is left alone.
///
/// - `gas`: m_g, where there is a covolume and gas.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn to_primitive(rows: RowsMut<'_>, with_gas: bool, gas: Option<&[f64]>, mixture: &Mixture) {
    let [rho, a, b, c, phi] = rows;
    let n = rho.len();
    let (rho, phi) = (&rho[..n], &phi[..n]);
    let (a, b, c) = (&mut a[..n], &mut b[..n], &mut c[..n]);
    match (with_gas, gas, mixture.has_covolume()) {
        (true, Some(gas), true) => to_primitive_body::<true, true>(n, rho, a, b, c, phi, &gas[..n], mixture),
        (false, _, true) => to_primitive_body::<false, true>(n, rho, a, b, c, phi, rho, mixture),
        (true, ..) => to_primitive_body::<true, false>(n, rho, a, b, c, phi, rho, mixture),
        (false, ..) => to_primitive_body::<false, false>(n, rho, a, b, c, phi, rho, mixture),
    }
}

// A flat list of rows, as below.
#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias")]
#[inline(always)]
fn to_primitive_body<const WITH_GAS: bool, const B: bool>(
    n: usize,
    rho: &[f64],
    a: &mut [f64],
    b: &mut [f64],
    c: &mut [f64],
    phi: &[f64],
    gas: &[f64],
    mixture: &Mixture,
) {
    for k in 0..n {
        let gas = if WITH_GAS && B { gas[k] } else { 0.0 };
        let w = primitive_of::<B>([rho[k], a[k], b[k], c[k], fraction::<WITH_GAS>(phi[k])], gas, mixture);
        (a[k], b[k], c[k]) = (w[V_Z], w[V_R], w[PRESSURE]);
    }
}

#[cfg(test)]
mod tests;
