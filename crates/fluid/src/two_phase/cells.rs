//! The cells of a padded block, and which of them the five-equation model serves on its own.

use super::closure::{PURE, is_compliant, is_mixed};
use super::windows::{LANES, bits};
use crate::Mixture;
use crate::state::PrimitiveCell;
use crate::state::primitive::{PHI, PRESSURE};
use crate::step::update::row as row_of;

/// A state on a face: ρ, v_z, v_r, p, φ and the gas's part of the mass.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct FaceState {
    pub w: PrimitiveCell,
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
        let [rho, v_z, v_r, p, phi, gas] = self.rows.map(|row| row[k]);
        FaceState { w: [rho, v_z, v_r, p, phi], gas_share: gas / rho }
    }

    /// Whether a cell has face states of its own: those that give way as neither phase does, and pure ones beside one of
    /// the other phase.
    pub fn is_at_interface(&self, k: usize, mixture: &Mixture) -> bool {
        let phi = self.rows[PHI];
        let around = [phi[k - 1], phi[k + 1], phi[k - self.stride], phi[k + self.stride]];
        is_at_interface(self.rows[PRESSURE][k], phi[k], around, mixture)
    }
}

#[inline(always)]
fn is_at_interface(p: f64, phi: f64, around: [f64; 4], mixture: &Mixture) -> bool {
    is_compliant(p, phi, mixture) | is_beside_another(phi, around)
}

/// Whether one phase is beside the other.
#[inline(always)]
fn is_beside_another(phi: f64, around: [f64; 4]) -> bool {
    around.into_iter().fold(false, |found, other| found | ((other - phi).abs() > 0.5))
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
/// - returns: whether there may be others than cells of one phase.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn find_interface(cells: &Cells<'_>, mixture: &Mixture, kinds: &mut [RowKinds]) -> bool {
    let stride = cells.stride;
    let (first, n) = (1, stride - 2);
    if is_pure(cells.rows[PHI]) {
        kinds.fill(RowKinds::default());
        return false;
    }
    for j in 1..kinds.len() - 1 {
        let mut row = RowKinds::default();
        for start in (0..n).step_by(LANES).map(|start| start.min(n - LANES)) {
            let found = kinds_of_batch(cells, j * stride + first + start, mixture);
            row.at_interface |= found.at_interface << (first + start);
            row.mixed |= found.mixed << (first + start);
        }
        kinds[j] = row;
    }
    true
}

/// Whether all cells hold the same phase, as most blocks' do.
#[inline(always)]
fn is_pure(phi: &[f64]) -> bool {
    let (mut is_liquid, mut is_gas) = (true, true);
    for phi in phi {
        is_liquid &= *phi <= PURE;
        is_gas &= *phi >= 1.0 - PURE;
    }
    is_liquid | is_gas
}

/// The kinds of the cells from `at` on, the first one's in the lowest bit.
#[inline(always)]
fn kinds_of_batch(cells: &Cells<'_>, at: usize, mixture: &Mixture) -> RowKinds {
    let load = |row: usize, at: usize| row_of::<LANES>(cells.rows[row], at);
    let (phi, west, east) = (load(PHI, at), load(PHI, at - 1), load(PHI, at + 1));
    let (south, north) = (load(PHI, at - cells.stride), load(PHI, at + cells.stride));
    let mut at_interface = [false; LANES];
    let mut mixed = [false; LANES];
    for k in 0..LANES {
        at_interface[k] = is_beside_another(phi[k], [west[k], east[k], south[k], north[k]]);
        mixed[k] = is_mixed(phi[k]);
    }
    let mixed = bits(mixed);
    // Few rows hold both phases; whether they give way takes a division.
    if mixed != 0 {
        let p = load(PRESSURE, at);
        for k in 0..LANES {
            at_interface[k] |= is_compliant(p[k], phi[k], mixture);
        }
    }
    RowKinds { at_interface: u64::from(bits(at_interface)), mixed: u64::from(mixed) }
}
