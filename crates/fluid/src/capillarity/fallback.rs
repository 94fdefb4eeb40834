//! The curvature where there are no height functions.

use super::place::CellPlace;

/// κ = −∇·n of the smoothed gas fraction, 1/m: what is left for bubbles of few cells, films and fragments.
///
/// φ is smoothed by the weights 1, 2, 1 along both axes; n = ∇φ/|∇φ| is made on the cells around, and its divergence from central
/// differences, with n_r/r in axial symmetry. Zero where φ is uniform.
///
/// - `phi`: a patch with three cells around cell `k`, rows `stride` apart.
pub(super) fn curvature_of_normals(phi: &[f64], stride: usize, k: usize, place: &CellPlace) -> f64 {
    let [h_z, h_r] = place.widths;
    let s = stride as isize;
    let smooth = |k: usize| {
        let at = |dk: isize| phi[k.wrapping_add_signed(dk)];
        let line = |dk: isize| 2.0 * at(dk) + (at(dk - 1) + at(dk + 1));
        (2.0 * line(0) + (line(-s) + line(s))) / 16.0
    };
    let normal = |dk: isize| {
        let at = |by: isize| smooth(k.wrapping_add_signed(dk + by));
        let (z, r) = ((at(1) - at(-1)) / (2.0 * h_z), (at(s) - at(-s)) / (2.0 * h_r));
        let size = z.hypot(r);
        if size > 0.0 { [z / size, r / size] } else { [0.0; 2] }
    };
    let along_z = (normal(1)[0] - normal(-1)[0]) / (2.0 * h_z);
    let along_r = (normal(s)[1] - normal(-s)[1]) / (2.0 * h_r);
    -(along_z + along_r + place.radius.map_or(0.0, |r| normal(0)[1] / r))
}
