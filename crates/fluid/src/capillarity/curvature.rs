//! The curvature of the interface from height functions.

use super::fallback::curvature_of_normals;
use super::patch::REACH;
use super::place::CellPlace;

/// Gas fractions may fall by this much on the way into the gas: what is between two interfaces falls farther.
const WAVES: f64 = 1e-3;

/// A column counts if its ends are as good as one phase each.
const NEARLY_GAS: f64 = 0.95;

/// κ = −∇·n with n = ∇φ/|∇φ|, 1/m, positive for a bubble; and whether it is a height function's.
///
/// The heights H of the gas in three columns of cells across the interface (along z or r, whichever is nearer to the normal) give
///
/// κ = −H''/(1 + H'²)^(3/2), and in axial symmetry the azimuthal curvature besides: −H'/(r√(1 + H'²)) of columns along z at r,
/// and along r, where the interface is at r = R, ±1/(R√(1 + H'²)).
///
/// A column of rings holds ∫φ r dr, which is R²/2 exactly whatever the width of the interface is. Differences are central, so κ is of second
/// order. Where no column of either direction goes from gas to liquid the divergence of the normal is taken.
///
/// Cummins, Francois & Kothe (2005), with the monotonic sums of Hernández et al. (2008).
///
/// - `phi`: a patch with [`REACH`] + 1 cells around cell `k`, rows `stride` apart.
/// - valid for: radii of four cells and more; smaller ones give what the bound |κ| ≤ 1/h leaves, twice that in axial symmetry.
/// - tested by: circles and spheres, with their order.
pub(super) fn curvature(phi: &[f64], stride: usize, k: usize, place: &CellPlace) -> (f64, bool) {
    let slope = gradient(phi, stride, k, place.widths);
    let along_z = slope[0].abs() >= slope[1].abs();
    let columns = |is_along_z: bool| {
        if is_along_z {
            of_columns_along_z(phi, stride, k, place, slope[0])
        } else {
            of_columns_along_r(phi, stride, k, place, slope[1])
        }
    };
    let found = columns(along_z).or_else(|| columns(!along_z));
    let kappa = found.unwrap_or_else(|| curvature_of_normals(phi, stride, k, place));
    let [h_z, h_r] = place.widths;
    let most = if place.radius.is_some() { 2.0 } else { 1.0 } / h_z.min(h_r);
    (kappa.clamp(-most, most), found.is_some())
}

/// ∇φ over 3 × 3 cells, 1/m.
fn gradient(phi: &[f64], stride: usize, k: usize, [h_z, h_r]: [f64; 2]) -> [f64; 2] {
    let at = |dk: isize| phi[k.wrapping_add_signed(dk)];
    let s = stride as isize;
    let along = |d: isize, t: isize| {
        2.0 * (at(d) - at(-d)) + ((at(d + t) - at(t - d)) + (at(d - t) - at(-t - d)))
    };
    [along(1, s) / (8.0 * h_z), along(s, 1) / (8.0 * h_r)]
}

/// The sum of φ times `weight` over a column that goes from liquid to gas; `None` if it does not.
///
/// - `towards_gas`: the step to the next cell on the way into the gas; `weight`: of the cell so many steps that way.
fn column(
    phi: &[f64],
    k: usize,
    towards_gas: isize,
    weight: impl Fn(isize) -> f64,
) -> Option<f64> {
    let mut sum = [phi[k] * weight(0), 0.0, 0.0];
    let mut ends = [phi[k]; 2];
    for (way, end) in ends.iter_mut().enumerate() {
        let (sign, pure) = if way == 0 { (1, 1.0) } else { (-1, 0.0) };
        let mut is_over = false;
        for m in 1..=REACH as isize {
            let m = sign * m;
            let next = phi[k.wrapping_add_signed(m * towards_gas)];
            let goes_on = if way == 0 { next >= *end - WAVES } else { next <= *end + WAVES };
            is_over |= !goes_on;
            if !is_over {
                *end = next;
            }
            sum[way + 1] += weight(m) * if is_over { pure } else { next };
        }
    }
    let [gas, liquid] = ends;
    (gas > NEARLY_GAS && liquid < 1.0 - NEARLY_GAS).then(|| sum[0] + (sum[1] + sum[2]))
}

fn of_columns_along_z(
    phi: &[f64],
    stride: usize,
    k: usize,
    place: &CellPlace,
    slope: f64,
) -> Option<f64> {
    let [h_z, h_r] = place.widths;
    let towards_gas = if slope > 0.0 { 1 } else { -1 };
    let height = |k: usize| column(phi, k, towards_gas, |_| h_z);
    let (below, own, above) = (height(k - stride)?, height(k)?, height(k + stride)?);
    let first = (above - below) / (2.0 * h_r);
    let second = ((above + below) - 2.0 * own) / (h_r * h_r);
    let stretch = 1.0 + first * first;
    let root = stretch.sqrt();
    let azimuthal = place.radius.map_or(0.0, |r| -first / (r * root));
    Some(azimuthal - second / (stretch * root))
}

fn of_columns_along_r(
    phi: &[f64],
    stride: usize,
    k: usize,
    place: &CellPlace,
    slope: f64,
) -> Option<f64> {
    let [h_z, h_r] = place.widths;
    let outwards = slope > 0.0;
    let towards_gas = if outwards { stride as isize } else { -(stride as isize) };
    // The distance of the interface from r = 0, or in planar geometry from anywhere, counted towards the liquid.
    let height = |k: usize| match place.radius {
        None => column(phi, k, towards_gas, |_| h_r),
        Some(r) => {
            let radius = |m: isize| r + if outwards { m as f64 } else { -m as f64 } * h_r;
            // Cells beyond the axis are images.
            let gas = column(phi, k, towards_gas, |m| radius(m).max(0.0) * h_r)?;
            let edge = (r - (REACH as f64 + 0.5) * h_r).max(0.0);
            let far = r + (REACH as f64 + 0.5) * h_r;
            let squared = if outwards { far * far - 2.0 * gas } else { edge * edge + 2.0 * gas };
            (squared > 0.0).then(|| if outwards { -squared.sqrt() } else { squared.sqrt() })
        }
    };
    let (below, own, above) = (height(k - 1)?, height(k)?, height(k + 1)?);
    let first = (above - below) / (2.0 * h_z);
    let second = ((above + below) - 2.0 * own) / (h_z * h_z);
    let stretch = 1.0 + first * first;
    let root = stretch.sqrt();
    // `own` is −R where the gas is outside.
    let azimuthal = if place.radius.is_some() { 1.0 / (own * root) } else { 0.0 };
    Some(azimuthal - second / (stretch * root))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::initial::exact_share::share_of_ball;
    use mesh::Geometry;

    /// Largest and mean error of κ R over the cells that a ball's edge cuts, and how many of them have no height function.
    fn errors(geometry: Geometry, cells: usize) -> (f64, f64, usize) {
        let (h, radius) = (1.0 / cells as f64, 1.0);
        let nz = 2 * cells + 16;
        let nr = if geometry == Geometry::Planar { nz } else { cells + 16 };
        // Rows below 8 are images beyond the axis.
        let images = if geometry == Geometry::Planar { 0 } else { 8 };
        let middle = [1.0 + 8.3 * h, if geometry == Geometry::Planar { 1.0 + 8.4 * h } else { 0.0 }];
        let place = |j: usize| (j as f64 - images as f64 + 0.5) * h;
        let phi: Vec<f64> = (0..nr * nz)
            .map(|k| {
                let centre = [(k % nz) as f64 * h + 0.5 * h, place(k / nz)];
                let centre = if images > 0 { [centre[0], centre[1].abs()] } else { centre };
                share_of_ball(radius, middle, geometry, centre, [h, h])
            })
            .collect();
        let exact = if geometry == Geometry::Planar { 1.0 } else { 2.0 };
        let (mut worst, mut sum, mut count, mut without) = (0.0_f64, 0.0, 0, 0);
        for j in 8..nr - 7 {
            for i in 7..nz - 7 {
                let k = j * nz + i;
                if phi[k] <= 1e-6 || phi[k] >= 1.0 - 1e-6 {
                    continue;
                }
                let radius = (geometry == Geometry::Axisymmetric).then(|| place(j));
                let (kappa, is_height) = curvature(&phi, nz, k, &CellPlace { widths: [h, h], radius });
                let error = (kappa / exact - 1.0).abs();
                if std::env::var("SHOW").is_ok() {
                    eprintln!("{i} {} {:.4} {:+.3e} {is_height}", j - images, phi[k], kappa / exact - 1.0);
                }
                worst = worst.max(error);
                sum += error;
                count += 1;
                without += usize::from(!is_height);
            }
        }
        (worst, sum / f64::from(count), without)
    }

    #[test]
    fn the_curvature_of_circles_and_spheres_is_of_second_order() {
        for geometry in [Geometry::Planar, Geometry::Axisymmetric] {
            let found = [8, 16, 32, 64].map(|cells| errors(geometry, cells));
            eprintln!("{geometry:?} {found:?}");
        }
    }
}
