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

/// What the cells of one padded row are to the five-equation model: bit i is cell i of the row.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RowKinds {
    /// See [`Cells::is_at_interface`].
    pub at_interface: u64,
    /// See [`is_mixed`].
    pub mixed: u64,
}

/// The kinds of the cells of a block and of those around it; what lies beyond them is nothing.
///
/// - `kinds`: of the padded rows, of up to 64 cells each; written.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn find_interface(cells: &Cells<'_>, mixture: &Mixture, kinds: &mut [RowKinds]) {
    let stride = cells.stride;
    let (first, n) = (1, stride - 2);
    for j in 1..kinds.len() - 1 {
        let at = j * stride + first;
        let cut = |row: usize, at: usize| &cells.rows[row][at..][..n];
        let (p, phi, west, east) = (cut(3, at), cut(4, at), cut(4, at - 1), cut(4, at + 1));
        let (south, north) = (cut(4, at - stride), cut(4, at + stride));
        let mut found = RowKinds::default();
        for i in 0..n {
            let around = [west[i], east[i], south[i], north[i]];
            found.at_interface |= u64::from(is_at_interface(p[i], phi[i], around, mixture)) << i;
            found.mixed |= u64::from(is_mixed(phi[i])) << i;
        }
        kinds[j] = RowKinds { at_interface: found.at_interface << first, mixed: found.mixed << first };
    }
}
