//! Reconstructed cells, and the states that they have on their faces.

pub(crate) mod capillary;
pub(crate) mod dispersion;
pub(crate) mod even;
pub(crate) mod predictor;

use std::ops::Range;

use crate::reconstruction::dispersion::{AlongFaces, Dispersion, Shares};
use crate::state::primitive::{PHI, PRESSURE, RHO, V_N, V_T};
use crate::state::{COUNT, PrimitiveCell};

/// Slices of the variables of cells, one after the other, as `state` names them.
pub(crate) type Rows<'a> = [&'a [f64]; COUNT];

/// [`Rows`] to be written.
pub(crate) type RowsMut<'a> = [&'a mut [f64]; COUNT];

/// A gas fraction, or that of the liquid where there is no gas: a constant there, from which the compiler makes kernels that
/// neither read nor carry it.
#[inline(always)]
pub(crate) fn fraction<const WITH_GAS: bool>(phi: f64) -> f64 {
    if WITH_GAS { phi } else { 0.0 }
}

/// `n` numbers of each row from `at` on.
#[inline(always)]
pub(crate) fn cut<'a>(rows: &Rows<'a>, at: usize, n: usize) -> Rows<'a> {
    let [a, b, c, d, e] = rows;
    [&a[at..][..n], &b[at..][..n], &c[at..][..n], &d[at..][..n], &e[at..][..n]]
}

/// The variables of cell `k`.
#[inline(always)]
pub(crate) fn at(rows: &Rows<'_>, k: usize) -> [f64; COUNT] {
    let [a, b, c, d, e] = rows;
    [a[k], b[k], c[k], d[k], e[k]]
}

/// The reconstructed cells on whose faces Riemann problems are solved.
#[derive(Clone, Copy)]
pub(crate) struct Reconstruction<'a> {
    /// Mid-step states ρ, normal velocity, tangential velocity, p, φ.
    pub half: Rows<'a>,
    /// Limited differences across the cells in the same order.
    pub differences: Rows<'a>,
    /// The share of its slopes that each cell keeps, see [`half_step`].
    pub keep: &'a [f64],
    /// The cells' sound speed at the beginning of the step, m/s.
    pub sound: &'a [f64],
    /// m_g/ρ of the cells; read where there is gas and a covolume.
    pub gas_shares: &'a [f64],
    /// Whether there is gas in any cell. Without it the rows of the gas fraction hold zeros.
    pub with_gas: bool,
    pub dispersion: Dispersion,
    pub along_faces: AlongFaces<'a>,
}

impl<'a> Reconstruction<'a> {
    /// The cells whose faces towards the cell `step` farther on have all neighbours that count; `stride` is that of the rows.
    pub fn lines(&self, step: usize, stride: usize) -> Range<usize> {
        stride..self.keep.len() - step - self.along_faces.step
    }

    /// `n` cells from `at` on.
    #[inline(always)]
    pub fn cut(&self, at: usize, n: usize) -> Self {
        Self {
            half: cut(&self.half, at, n),
            differences: cut(&self.differences, at, n),
            keep: &self.keep[at..][..n],
            sound: &self.sound[at..][..n],
            gas_shares: &self.gas_shares[at..][..n],
            with_gas: self.with_gas,
            dispersion: self.dispersion,
            along_faces: self.along_faces.cut(at, n),
        }
    }

    /// Whether cell `k` has states and fluxes of its own, as mixed cells of the five-equation model: its share is −0.
    pub fn is_own(&self, k: usize) -> bool {
        self.keep[k].to_bits() >> 63 == 1
    }

    /// m_g/ρ on the faces of cell `k`.
    #[inline(always)]
    pub fn gas_share<const WITH_GAS: bool>(&self, k: usize) -> f64 {
        if WITH_GAS { self.gas_shares[k] } else { 0.0 }
    }

    /// The state on the lower (`sign` = −1) or upper (+1) face of cell `k`.
    #[inline(always)]
    pub fn face_state(&self, k: usize, sign: f64) -> PrimitiveCell {
        let weight = 0.5 * sign * self.keep[k];
        let at = |c: usize| self.half[c][k] + weight * self.differences[c][k];
        [at(RHO), at(V_N), at(V_T), at(PRESSURE), at(PHI)]
    }
}

/// What v_n (component 0) or p (1) lacks on the face between cells `k`, of which both keep `kept` of their slopes and take
/// what is left out across and along it.
#[inline(always)]
fn left_out(
    lower: &Reconstruction<'_>,
    upper: &Reconstruction<'_>,
    component: usize,
    k: usize,
    shares: Shares,
    kept: [f64; 2],
) -> f64 {
    let row = [V_N, PRESSURE][component];
    let across = upper.differences[row][k] - lower.differences[row][k];
    let low = lower.along_faces.twice_second_difference(component, k);
    let high = upper.along_faces.twice_second_difference(component, k);
    shares.left_out(component, kept, across, 0.25 * (low + high))
}

/// The states on both sides of the face between cells `k` of `lower` and of `upper`.
///
/// Normal velocity and pressure are all that matters in a weak wave; density and the rest stay as they are.
#[inline(always)]
pub(crate) fn states_at_face<const WITH_GAS: bool>(
    lower: &Reconstruction<'_>,
    upper: &Reconstruction<'_>,
    k: usize,
) -> [PrimitiveCell; 2] {
    let dispersion = lower.dispersion;
    let takes = |cells: &Reconstruction<'_>| {
        let (p, phi) = (cells.half[PRESSURE][k], fraction::<WITH_GAS>(cells.half[PHI][k]));
        dispersion.takes(p, phi, cells.differences[PRESSURE][k])
    };
    let (low, high) = (takes(lower), takes(upper));
    let keep = lower.keep[k] * upper.keep[k];
    let kept = [if low[0] & high[0] { keep } else { 0.0 }, if low[1] & high[1] { keep } else { 0.0 }];
    let speed = |cells: &Reconstruction<'_>| cells.half[V_N][k].abs() + cells.sound[k];
    let shares = dispersion.shares(0.5 * (speed(lower) + speed(upper)));
    let velocity = left_out(lower, upper, 0, k, shares, kept);
    let pressure = left_out(lower, upper, 1, k, shares, kept);
    [lower.face_state(k, 1.0), upper.face_state(k, -1.0)]
        .map(|[rho, v_n, v_t, p, phi]| [rho, v_n + velocity, v_t, p + pressure, fraction::<WITH_GAS>(phi)])
}
