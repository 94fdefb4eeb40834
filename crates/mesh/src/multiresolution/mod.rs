//! Multiresolution analysis of cell averages (Harten 1995; Müller 2003): projection, prediction, details.
//!
//! Projection is the volume-weighted mean of four children. Prediction is its right inverse of third order:
//! parabolas through the means of a cell and its neighbours, along z, along r and mixed, with the deviations
//! weighted so that their volume-weighted mean vanishes. A detail is a child's mean minus the predicted one.

pub(crate) mod adaptation;
pub(crate) mod details;
pub(crate) mod entering;
pub(crate) mod horizon;
pub(crate) mod initial;
pub(crate) mod marks;
pub(crate) mod patch;
pub(crate) mod project;
pub(crate) mod radial;
pub(crate) mod remap;

/// The most components of a field that details and admissible states depend on.
pub const MOST_COMPONENTS: usize = 8;
/// The most components of a field: those after the first [`MOST_COMPONENTS`] are only projected and predicted. More of the former
/// would cost every cell's analysis.
pub const MOST_IN_FIELD: usize = 12;

/// What a cell has of those components: zeros after the field's own.
pub type ComponentsOfCell = [f64; MOST_COMPONENTS];

/// What the analysis must know of the fields.
pub trait Multiresolution: Sync {
    /// The sign with which a component is reflected at a side of the domain; `None` where it is continued.
    fn parity(&self, side: crate::Side, component: usize) -> Option<f64>;

    /// Whether details in the cells next to a side of the domain ask for refinement. Beside an open boundary, which
    /// is not exact anyway, they need not.
    fn counts_beside(&self, _side: crate::Side) -> bool {
        true
    }

    /// The share, in [0, 1], of the predicted deviations that the children of a cell may take so that they are
    /// admissible states. It is one for all components: prediction then stays one linear map, under which
    /// quantities that depend linearly on each other stay so.
    ///
    /// - `mean`: the cell's first [`MOST_COMPONENTS`]; `deviations`: those of its four children.
    fn share(&self, mean: &[f64], deviations: &[[f64; MOST_COMPONENTS]; 4]) -> f64;

    /// The size of a cell's detail relative to the fields' reference values. It is asked for every cell, so it should
    /// be inlined, without branches and without calls that do not vectorise.
    fn significance(&self, cell: &ComponentsOfCell, detail: &ComponentsOfCell) -> f64;

    /// The same rule where of waves only those count that run in a direction: a unit vector (z, r), towards the
    /// [region of interest](crate::RegionOfInterest). `None`: all count wherever they run.
    fn towards(&self, _direction: [f64; 2]) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// The size of that part of a detail that counts everywhere, also beside sides whose details do not, see
    /// [`Multiresolution::counts_beside`]. Asked for few cells.
    fn significance_everywhere(&self, _cell: &ComponentsOfCell, _detail: &ComponentsOfCell) -> f64 {
        0.0
    }
}

/// A field without a meaning: everything is admissible, details count as they are.
#[cfg(test)]
pub(crate) struct Plain;

#[cfg(test)]
impl Multiresolution for Plain {
    fn parity(&self, _: crate::Side, _: usize) -> Option<f64> {
        None
    }

    fn share(&self, _: &[f64], _: &[[f64; MOST_COMPONENTS]; 4]) -> f64 {
        1.0
    }

    fn significance(&self, _: &ComponentsOfCell, detail: &ComponentsOfCell) -> f64 {
        detail.iter().fold(0.0, |largest, d| d.abs().max(largest))
    }
}

/// Predicted deviations of the four children of cell `k` from its mean, in the order (lower z, lower r),
/// (upper z, lower r), (lower z, upper r), (upper z, upper r).
///
/// d_z = (ū_{i+1} − ū_{i−1})/8, d_r alike, d_zr = (ū_{++} − ū_{+−} − ū_{−+} + ū_{−−})/64: parabolas integrated over
/// the halves of the cell. Along r the deviations of the halves are −2(1 − s)d and 2 s d, where s is the lower
/// half's share of the volume: their weighted mean is zero, and s = ½ is the Cartesian case. Fields that are odd in
/// r have d_r and d_zr times the factor of `radial.rs`, without which v_r = a r would not be exact.
///
/// - `row`, `stride`: one component with neighbours `k ± 1`, `k ± stride`; `radial`: see [`radial_weights`].
/// - exact for quadratic polynomials in planar geometry; a uniform field has deviations that are exactly zero.
#[inline(always)]
pub(crate) fn deviations(row: &[f64], k: usize, stride: usize, radial: [f64; 2]) -> [f64; 4] {
    let three = |k: usize| [row[k - 1], row[k], row[k + 1]];
    deviations_among([three(k - stride), three(k), three(k + stride)], radial)
}

/// What d_r counts in the lower and in the upper half of a cell: −2(1 − s) and 2 s, times the factor of odd fields.
pub(crate) fn radial_weights(lower_share: f64, factor: f64) -> [f64; 2] {
    [-2.0 * (1.0 - lower_share) * factor, 2.0 * lower_share * factor]
}

/// [`deviations`] from a cell and its neighbours, row after row.
#[inline(always)]
pub(crate) fn deviations_among([below, middle, above]: [[f64; 3]; 3], [lower, upper]: [f64; 2]) -> [f64; 4] {
    let d_z = 0.125 * (middle[2] - middle[0]);
    let d_r = 0.125 * (above[1] - below[1]);
    let d_zr = (above[2] - above[0] - below[2] + below[0]) / 64.0;
    [
        -d_z + lower * (d_r - d_zr),
        d_z + lower * (d_r + d_zr),
        -d_z + upper * (d_r - d_zr),
        d_z + upper * (d_r + d_zr),
    ]
}
