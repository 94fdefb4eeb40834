//! Multiresolution analysis of cell averages (Harten 1995; Müller 2003): projection, prediction, details.
//!
//! Projection is the volume-weighted mean of four children. Prediction is its right inverse of third order:
//! parabolas through the means of a cell and its neighbours, along z, along r and mixed, with the deviations
//! weighted so that their volume-weighted mean vanishes. A detail is a child's mean minus the predicted one.

/// The most components a field may have.
pub const MOST_COMPONENTS: usize = 8;

/// What the analysis must know of the fields.
pub trait Multiresolution: Sync {
    /// The sign with which a component is reflected at a side of the domain; `None` where it is continued.
    fn parity(&self, side: crate::Side, component: usize) -> Option<f64>;

    /// The share, in [0, 1], of the predicted deviations that the children of a cell may take so that they are
    /// admissible states. It is one for all components: prediction then stays one linear map, under which
    /// quantities that depend linearly on each other stay so.
    ///
    /// - `mean`: the cell's components; `deviations`: of its four children.
    fn share(&self, mean: &[f64], deviations: &[[f64; MOST_COMPONENTS]; 4]) -> f64;

    /// The size of a cell's detail relative to the fields' reference values.
    fn significance(&self, cell: &[f64], detail: &[f64]) -> f64;
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

    fn significance(&self, _: &[f64], detail: &[f64]) -> f64 {
        detail.iter().fold(0.0, |largest, d| d.abs().max(largest))
    }
}

/// Predicted deviations of the four children of cell `k` from its mean, in the order (lower z, lower r),
/// (upper z, lower r), (lower z, upper r), (upper z, upper r).
///
/// d_z = (ū_{i+1} − ū_{i−1})/8, d_r alike, d_zr = (ū_{++} − ū_{+−} − ū_{−+} + ū_{−−})/64: parabolas integrated over
/// the halves of the cell. Along r the deviations of the halves are −2(1 − s)d and 2 s d, where s is the lower
/// half's share of the volume: their weighted mean is zero, and s = ½ is the Cartesian case.
///
/// - `row`, `stride`: one component with neighbours `k ± 1`, `k ± stride`; `lower_share`: s.
/// - exact for quadratic polynomials in planar geometry; a uniform field has deviations that are exactly zero.
#[inline(always)]
pub(crate) fn deviations(row: &[f64], k: usize, stride: usize, lower_share: f64) -> [f64; 4] {
    let d_z = 0.125 * (row[k + 1] - row[k - 1]);
    let d_r = 0.125 * (row[k + stride] - row[k - stride]);
    let d_zr = (row[k + stride + 1] - row[k + stride - 1] - row[k - stride + 1] + row[k - stride - 1]) / 64.0;
    let (lower, upper) = (-2.0 * (1.0 - lower_share), 2.0 * lower_share);
    [
        -d_z + lower * (d_r - d_zr),
        d_z + lower * (d_r + d_zr),
        -d_z + upper * (d_r - d_zr),
        d_z + upper * (d_r + d_zr),
    ]
}
