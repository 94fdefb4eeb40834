//! Super-time-stepping: what spreads over many cells in a step does so in stages, between all blocks that it does so in.
//!
//! The stages are those of the Runge–Kutta–Legendre scheme of second order (`rkl2.rs`). They run ahead of the blocks' steps, from the states that waves
//! alone make at mid-step: their mean over the step is the step's to second order. What they leave is the mean flux through each
//! face ([`Spread`]), which the blocks' steps take in the place of their own. So flux registers, ledgers and the first-order repeats need not
//! know of them, and what leaves one cell enters the other.
//!
//! Blocks of two levels that step together are in stages together (`levels.rs`). Where levels have steps of their own, ghosts towards the other one
//! are fixed during the stages. That is right as long as what spreads does not get through the block: beyond that it would give or take in a step
//! what its neighbour cannot, and the register puts the difference into its outermost cells, which grows from step to step. So then no more passes
//! than one step is stable with.

mod block;
mod levels;
mod rkl2;
mod stages;
mod view;

use mesh::FaceState;

use super::TermBlock;
use crate::Boundary;

pub(crate) use block::SpreadBlock;
pub use stages::Spread;
pub(crate) use stages::spread_in;
pub(crate) use view::View;

/// A block as stages see it.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    /// Cells along a side.
    pub cells: usize,
    /// Flat index of cell (0, 0) of padded rows, and their stride.
    pub origin: usize,
    pub stride: usize,
    /// 1/h_z, 1/h_r.
    pub inverse_h: [f64; 2],
    /// 1/r of the padded cells, or 0 in planar geometry.
    pub inverse_r: Vec<f64>,
    /// What bounds the domain on the sides of the block; `None` where other blocks are.
    pub sides: [Option<Boundary>; 4],
    /// See [`TermBlock::wall`].
    pub wall: Option<Vec<FaceState>>,
}

/// Which spreading it is, and the rows that it takes.
pub(crate) struct Shape {
    /// See [`View`].
    pub kind: usize,
    /// How many variables spread.
    pub variables: usize,
    /// How many rows of constants there are.
    pub constants: usize,
    /// The axes of the rows of fluxes (0: z, 1: r), which are indexed by the cell below the face.
    pub axes: &'static [usize],
}

/// What spreads by fluxes that are linear in it.
///
/// Rows are padded, one after the other: of variables, of constants, of fluxes.
pub(crate) trait Spreading: Sync {
    /// Which one it is, and how many rows it takes.
    fn shape(&self) -> Shape;

    /// No less than the largest diffusivity in cells of these densities and gas fractions, m²/s.
    fn diffusivity(&self, density: &[f64], phi: &[f64]) -> f64;

    /// Takes constants and variables of a block, whose states at mid-step are those that waves alone make.
    ///
    /// - `work`: to work in; `kept`: gets the constants and the variables.
    /// - returns: no less than the largest rate at which anything decays in it, 1/s.
    fn begin(&self, block: &TermBlock<'_>, work: &mut Vec<f64>, kept: [&mut [f64]; 2]) -> f64;

    /// Whether the fluxes through a side of the domain are that side's own, which stages must not find.
    fn is_given(&self, _kind: Boundary) -> bool {
        false
    }

    /// The fluxes that the states at mid-step have and one step is stable with.
    ///
    /// - `work`: to work in; `fluxes`: gets them, row after row.
    fn bounded(&self, block: &TermBlock<'_>, work: &mut Vec<f64>, fluxes: &mut [f64]);

    /// The fluxes of these variables; their ghosts beyond the domain it may set.
    fn conduct(&self, frame: &Frame, constants: &[f64], values: &mut [f64], fluxes: &mut [f64]);

    /// The rates at which fluxes change the variables in the block's own cells.
    fn change(&self, frame: &Frame, constants: &[f64], fluxes: &[f64], rates: &mut [f64]);
}
