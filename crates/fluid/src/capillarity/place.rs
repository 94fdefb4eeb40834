//! Where a cell is, as its curvature needs to know.

/// A cell's widths and its distance from the axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellPlace {
    /// Widths h_z, h_r, m.
    pub widths: [f64; 2],
    /// Radius of the centre, m, negative beyond the axis; `None` in planar geometry.
    pub radius: Option<f64>,
}
