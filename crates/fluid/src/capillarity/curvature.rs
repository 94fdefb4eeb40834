//! The curvature of the interface from height functions.

use super::fallback::curvature_of_normals;
use super::patch::REACH;
use super::place::CellPlace;

/// Gas fractions may fall by this much on the way into the gas: what is between two interfaces falls farther.
const WAVES: f64 = 1e-3;

/// A column counts if its ends are as good as one phase each.
const NEARLY_GAS: f64 = 0.95;

/// Over 1/(2 · this) of (a − b)/(a + b) on both sides of 45° columns of both directions count. With 1 the steep ones spoil a ball at rest.
const BLEND: f64 = 3.0;

/// κ = −∇·n with n = ∇φ/|∇φ|, 1/m, positive for a bubble, from height functions; `None` where no column goes from gas to liquid.
///
/// The heights H of the gas in columns of cells across the interface (along z or r, whichever is nearer to the normal, and both where
/// the normal is between them, see [`share_along_z`]) give
///
/// κ = −H''/(1 + H'²)^(3/2), and in axial symmetry the azimuthal curvature besides: −H'/(r√(1 + H'²)) of columns along z at r,
/// and along r, where the interface is at r = R, ±1/(R√(1 + H'²)).
///
/// Five columns give derivatives of fourth order, three of second where two of five do not go from gas to liquid. Heights are means over
/// the width of a column. Across rings they are means over s = r²/2, of which a smooth surface is a smooth function at the axis, too; and
/// a column of rings holds ∫φ r dr = R²/2.
///
/// Cummins, Francois & Kothe (2005), with the monotonic sums of Hernández et al. (2008).
///
/// - `phi`: a patch with [`REACH`] + 1 cells around cell `k`, rows `stride` apart.
/// - valid for: radii of four cells and more; smaller ones give what the bound |κ| ≤ 1/h leaves, twice that in axial symmetry.
/// - tested by: circles and spheres, with their order.
pub(super) fn of_heights(phi: &[f64], stride: usize, k: usize, place: &CellPlace) -> Option<f64> {
    let slope = gradient(phi, stride, k, place.widths);
    let columns = |is_along_z: bool| {
        if is_along_z {
            of_columns_along_z(phi, stride, k, place, slope[0])
        } else {
            of_columns_along_r(phi, stride, k, place, slope[1])
        }
    };
    let share = share_along_z(slope);
    let found = if share > 0.0 && share < 1.0 {
        match (columns(true), columns(false)) {
            (Some(z), Some(r)) => Some(share * z + (1.0 - share) * r),
            (z, r) => z.or(r),
        }
    } else {
        columns(share > 0.0).or_else(|| columns(share == 0.0))
    };
    found.map(|kappa| bounded(kappa, place))
}

/// κ where no column goes from gas to liquid, 1/m: the divergence of the normal.
///
/// - `phi`, `stride`, `k`: as for [`of_heights`].
pub(super) fn without_heights(phi: &[f64], stride: usize, k: usize, place: &CellPlace) -> f64 {
    bounded(curvature_of_normals(phi, stride, k, place), place)
}

/// |κ| is at most one over a cell's width, twice that in axial symmetry.
fn bounded(kappa: f64, place: &CellPlace) -> f64 {
    let [h_z, h_r] = place.widths;
    let most = if place.radius.is_some() { 2.0 } else { 1.0 } / h_z.min(h_r);
    kappa.clamp(-most, most)
}

/// How much of the curvature is that of columns along z; the rest is that of columns along r.
///
/// With a = |∂φ/∂z| and b = |∂φ/∂r| it is ½ + 3 (a − b)/(a + b), within 0 and 1: both count where a/b is between 5/7 and 7/5. A column
/// through a cell beside the interface meets it beside the point nearest to the cell, columns along z on the one side of that point and
/// along r on the other. So both together have no error of first order in the cell's distance. With the nearer one alone, waves on
/// an interface at 45° are 4 % too slow with 45 cells per wave, with both 2 %. Where the normal is nearer to one axis the columns
/// along the other are steep, and better left out.
fn share_along_z(slope: [f64; 2]) -> f64 {
    let [a, b] = slope.map(f64::abs);
    let sum = a + b;
    let way = if sum > 0.0 { (a - b) / sum } else { 0.0 };
    (0.5 + BLEND * way).clamp(0.0, 1.0)
}

/// ∇φ over 3 × 3 cells, 1/m.
fn gradient(phi: &[f64], stride: usize, k: usize, [h_z, h_r]: [f64; 2]) -> [f64; 2] {
    let at = |dk: isize| phi[k.wrapping_add_signed(dk)];
    let s = stride as isize;
    let along =
        |d: isize, t: isize| 2.0 * (at(d) - at(-d)) + ((at(d + t) - at(t - d)) + (at(d - t) - at(-t - d)));
    [along(1, s) / (8.0 * h_z), along(s, 1) / (8.0 * h_r)]
}

/// The sum of φ times `weight` over a column that goes from liquid to gas; `None` if it does not.
///
/// - `towards_gas`: the step to the next cell on the way into the gas; `weight`: of the cell so many steps that way.
fn column(phi: &[f64], k: usize, towards_gas: isize, weight: impl Fn(isize) -> f64) -> Option<f64> {
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

fn of_columns_along_z(phi: &[f64], stride: usize, k: usize, place: &CellPlace, slope: f64) -> Option<f64> {
    let [h_z, h_r] = place.widths;
    let towards_gas = if slope > 0.0 { 1 } else { -1 };
    let height = |by: isize| column(phi, k.wrapping_add_signed(by * stride as isize), towards_gas, |_| h_z);
    let Some(r) = place.radius else {
        let [_, first, second] = derivatives(height, h_r)?;
        return Some(-second / (1.0 + first * first).powf(1.5));
    };
    let [first, second] = derivatives_of_rings(height, r.abs(), h_r)?;
    // H' = r H_s and H'' = H_s + r² H_ss.
    let (slope, bend) = (r * first, first + r * r * second);
    let stretch = 1.0 + slope * slope;
    Some(-(first + bend / stretch) / stretch.sqrt())
}

fn of_columns_along_r(phi: &[f64], stride: usize, k: usize, place: &CellPlace, slope: f64) -> Option<f64> {
    let [h_z, h_r] = place.widths;
    let outwards = slope > 0.0;
    let towards_gas = if outwards { stride as isize } else { -(stride as isize) };
    let Some(r) = place.radius else {
        let height = |by: isize| column(phi, k.wrapping_add_signed(by), towards_gas, |_| h_r);
        let [_, first, second] = derivatives(height, h_z)?;
        return Some(-second / (1.0 + first * first).powf(1.5));
    };
    // Cells beyond the axis are images.
    let radius = |m: isize| (r + if outwards { m as f64 } else { -m as f64 } * h_r).max(0.0);
    let edge = |cells: f64| (r + (REACH as f64 + 0.5) * cells * h_r).max(0.0);
    let squared = |by: isize| {
        let gas = column(phi, k.wrapping_add_signed(by), towards_gas, |m| radius(m) * h_r)?;
        Some(if outwards { edge(1.0).powi(2) - 2.0 * gas } else { edge(-1.0).powi(2) + 2.0 * gas })
    };
    // Of R², which is what columns of rings hold: a sphere's is a parabola.
    let [value, first, second] = derivatives(squared, h_z)?;
    if value <= 0.0 {
        return None;
    }
    let radius = value.sqrt();
    let slope = 0.5 * first / radius;
    let bend = (0.5 * second - slope * slope) / radius;
    let stretch = 1.0 + slope * slope;
    let kappa = (1.0 / radius - bend / stretch) / stretch.sqrt();
    Some(if outwards { -kappa } else { kappa })
}

/// A function's value and derivatives in the middle of cell 0, from its means over cells of width `h`: of fourth order from five of
/// them, of second from three where there are no more.
fn derivatives(mean: impl Fn(isize) -> Option<f64>, h: f64) -> Option<[f64; 3]> {
    let (below, own, above) = (mean(-1)?, mean(0)?, mean(1)?);
    let (rise, bend) = (above - below, (above + below) - 2.0 * own);
    let (first, second) = match (mean(-2), mean(2)) {
        (Some(low), Some(high)) => {
            let (wide_rise, wide_bend) = (high - low, (high + low) - 2.0 * own);
            ((34.0 * rise - 5.0 * wide_rise) / (48.0 * h), (12.0 * bend - wide_bend) / (8.0 * h * h))
        }
        _ => (0.5 * rise / h, bend / (h * h)),
    };
    Some([own - h * h / 24.0 * second, first, second])
}

/// The derivatives of a function of s = r²/2 at radius r, from its means over rings of width `h`, which are means over s.
///
/// The integral of the function over s is known on the rings' edges; the polynomial through it is differentiated. Next to the axis the
/// rings are those from the axis on.
fn derivatives_of_rings(mean: impl Fn(isize) -> Option<f64>, r: f64, h: f64) -> Option<[f64; 2]> {
    let row = (r / h - 0.5).round() as isize;
    [2, 1].into_iter().find_map(|half| {
        let first = (-half).max(-row);
        let count = 2 * half as usize + 1;
        let edge = |n: usize| 0.5 * (r + (first as f64 + n as f64 - 0.5) * h).powi(2);
        // The means are the first divided differences of the integral.
        let mut table = [0.0; 5];
        for n in 0..count {
            table[n] = mean(first + n as isize)?;
        }
        let mut newton = [0.0; 6];
        newton[1] = table[0];
        for order in 2..=count {
            for n in 0..=count - order {
                table[n] = (table[n + 1] - table[n]) / (edge(n + order) - edge(n));
            }
            newton[order] = table[0];
        }
        // Horner's rule for the polynomial and its three derivatives at s.
        let s = 0.5 * r * r;
        let mut found = [0.0; 4];
        for n in (0..=count).rev() {
            let x = s - edge(n);
            found = [
                found[0] * x + newton[n],
                found[1] * x + found[0],
                found[2] * x + 2.0 * found[1],
                found[3] * x + 3.0 * found[2],
            ];
        }
        Some([found[2], found[3]])
    })
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
                let place = CellPlace { widths: [h, h], radius };
                let found = of_heights(&phi, nz, k, &place);
                let kappa = found.unwrap_or_else(|| without_heights(&phi, nz, k, &place));
                let error = (kappa / exact - 1.0).abs();
                worst = worst.max(error);
                sum += error;
                count += 1;
                without += usize::from(found.is_none());
            }
        }
        (worst, sum / f64::from(count), without)
    }

    #[test]
    fn the_curvature_of_circles_and_spheres_is_of_fourth_order() {
        for geometry in [Geometry::Planar, Geometry::Axisymmetric] {
            let found = [8, 16, 32, 64].map(|cells| errors(geometry, cells));
            eprintln!("{geometry:?}: worst, mean, cells without heights {found:?}");
            for pair in found.windows(2).skip(1) {
                assert!(
                    (pair[0].0 / pair[1].0).log2() > 3.5 && (pair[0].1 / pair[1].1).log2() > 3.5,
                    "{found:?}"
                );
            }
            assert!(found[1].0 < 1.5e-3 && found.iter().all(|(.., without)| *without == 0), "{found:?}");
        }
    }
}
