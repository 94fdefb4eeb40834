//! The cells of a padded block, and which of them the five-equation model serves on its own.

use super::closure::{is_compliant, is_mixed};
use crate::Mixture;

/// A state on a face: ρ, v_z, v_r, p, φ and the gas's part of the mass.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct FaceState {
    pub w: [f64; 5],
    /// m_g/ρ.
    pub gas_share: f64,
}

/// The cells of a padded block: ρ, v_z, v_r, p, φ, m_g.
#[derive(Clone, Copy)]
pub(crate) struct Cells<'a> {
    pub rows: [&'a [f64]; 6],
    /// Distance between cells that neighbour each other along r.
    pub stride: usize,
}

impl Cells<'_> {
    /// The cell's own state, as a face of a cell at first order has it.
    pub fn mean(&self, k: usize) -> FaceState {
        let w = [0, 1, 2, 3, 4].map(|c: usize| self.rows[c][k]);
        FaceState { w, gas_share: self.rows[5][k] / w[0] }
    }

    /// Whether a cell has face states of its own: those that give way as neither phase does, and pure ones beside one of
    /// the other phase.
    pub fn is_at_interface(&self, k: usize, mixture: &Mixture) -> bool {
        let phi = self.rows[4];
        let around = [phi[k - 1], phi[k + 1], phi[k - self.stride], phi[k + self.stride]];
        is_at_interface(self.rows[3][k], phi[k], around, mixture)
    }
}

#[inline(always)]
fn is_at_interface(p: f64, phi: f64, around: [f64; 4], mixture: &Mixture) -> bool {
    around.into_iter().fold(is_compliant(p, phi, mixture), |found, other| found | ((other - phi).abs() > 0.5))
}

/// What a cell is to the five-equation model.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CellKind {
    /// See [`Cells::is_at_interface`].
    pub is_at_interface: bool,
    /// See [`is_mixed`].
    pub is_mixed: bool,
}

/// The kinds of the cells of a block and of those around it; what lies beyond them is nothing.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn find_interface(cells: &Cells<'_>, mixture: &Mixture, kinds: &mut [CellKind]) {
    let stride = cells.stride;
    let n = kinds.len() - 2 * stride;
    let cut = |row: usize, at: usize| &cells.rows[row][at..][..n];
    let (p, phi) = (cut(3, stride), cut(4, stride));
    let (west, east) = (cut(4, stride - 1), cut(4, stride + 1));
    let (south, north) = (cut(4, 0), cut(4, 2 * stride));
    let kinds = &mut kinds[stride..][..n];
    for k in 0..n {
        let around = [west[k], east[k], south[k], north[k]];
        kinds[k] = CellKind {
            is_at_interface: is_at_interface(p[k], phi[k], around, mixture),
            is_mixed: is_mixed(phi[k]),
        };
    }
}
