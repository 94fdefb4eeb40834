//! How the two halves of a cell count along r, row by row, on all levels.

use crate::multiresolution::radial_weights;
use crate::{Domain, GHOSTS, Geometry};

/// Rows beyond the domain that a projection may ask for: the ghosts of a block seen from one level below.
const MARGIN: i64 = 2 * GHOSTS as i64;

/// A row of cells of one level, whose children are one level finer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RadialRow {
    /// The share of a cell's volume that lies in its lower half: ½ − h/(4r) with h the width of its children and r
    /// its centre; planar ½.
    pub lower_share: f64,
    /// What differences along r count in prediction, see [`radial_weights`]: for even and for odd components.
    pub weights: [[f64; 2]; 2],
}

/// The rows of all levels. They depend on the domain alone, so they are made once and not with every mesh.
#[derive(Clone, Debug)]
pub(crate) struct RadialTable {
    root_level: u8,
    /// By level of the children, from the roots' on; [`MARGIN`] rows before the domain's first.
    levels: Vec<Vec<RadialRow>>,
}

impl RadialTable {
    /// - `levels`: for the levels of the children, from `root_level` on, their width h along r, m, and the number of
    ///   rows of cells on the level below.
    pub fn new(domain: &Domain, root_level: u8, levels: impl Iterator<Item = (f64, usize)>) -> Self {
        let rows = |(h, rows): (f64, usize)| -> Vec<RadialRow> {
            (-MARGIN..rows as i64 + MARGIN)
                .map(|j| {
                    let lower_share = lower_share(domain, h, j);
                    let odd = radial_weights(lower_share, odd_factor(domain, h, j));
                    RadialRow { lower_share, weights: [radial_weights(lower_share, 1.0), odd] }
                })
                .collect()
        };
        Self { root_level, levels: levels.map(rows).collect() }
    }

    /// The rows from number `first` on, counted from the domain's r_min, under children of the level `fine`.
    #[inline]
    pub fn from(&self, fine: u8, first: i64) -> &[RadialRow] {
        &self.levels[usize::from(fine - self.root_level)][(first + MARGIN) as usize..]
    }
}

/// See [`RadialRow::lower_share`].
fn lower_share(domain: &Domain, h: f64, j: i64) -> f64 {
    match domain.geometry {
        Geometry::Planar => 0.5,
        Geometry::Axisymmetric => 0.5 - h / (4.0 * (domain.r[0] + (2.0 * j as f64 + 1.0) * h)),
    }
}

/// By what the central difference along r must be multiplied in prediction so that a field proportional to r is
/// exact: the means of its cells lie at x = r + h²/(4r) instead of r, with h the width of the children, so
/// 4h/(x_{j+1} − x_{j−1}); planar 1.
fn odd_factor(domain: &Domain, h: f64, j: i64) -> f64 {
    match domain.geometry {
        Geometry::Planar => 1.0,
        Geometry::Axisymmetric => {
            let place = |j: i64| {
                let r = domain.r[0] + (2.0 * j as f64 + 1.0) * h;
                r + h * h / (4.0 * r)
            };
            4.0 * h / (place(j + 1) - place(j - 1))
        }
    }
}
