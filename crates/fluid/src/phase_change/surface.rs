//! How much interface there is in a cell.

/// The area of the interface in a cell per its volume, 1/m, for cells that hold both phases.
///
/// |∇φ| integrated over a front is its area. Part of that integral lies in pure cells beside it, which cannot change phase: what φ steps by between
/// a cell of both phases and one of a single phase counts in full, between two of both half for each. Along an axis the areas of a front's
/// cells then add up to the front's, however many they are.
///
/// - `phi`: of the padded cells; `k`: the cell; `stride`: between cells along r; `inverse_h`: 1/h_z, 1/h_r; `holds_both`: whether a
///   cell of a gas fraction does.
/// - tested by: fronts along and across the grid, a circle.
pub(crate) fn area_density(
    phi: &[f64],
    k: usize,
    stride: usize,
    inverse_h: [f64; 2],
    holds_both: impl Fn(f64) -> bool,
) -> f64 {
    let slope = |step: usize, inverse_h: f64| {
        let towards = |other: usize| if holds_both(phi[other]) { 0.5 } else { 1.0 } * (phi[other] - phi[k]);
        (towards(k + step) - towards(k - step)) * inverse_h
    };
    slope(1, inverse_h[0]).hypot(slope(stride, inverse_h[1]))
}

/// The area of the front that a cell next to the gas evaporates for, per its volume, 1/m: its own, see [`area_density`], and that of the cells
/// ahead of it which do not evaporate.
///
/// Where φ falls from the cell to such a neighbour and on to the next, all of it counts, down to the liquid. So along an axis the areas still
/// add up to the front's.
///
/// - `phi`, `k`, `stride`, `inverse_h`, `holds_both`: as there; the cell and its neighbours have two cells around them.
/// - tested by: fronts along and across the grid, a circle.
pub(super) fn front_density(
    phi: &[f64],
    k: usize,
    stride: usize,
    inverse_h: [f64; 2],
    holds_both: impl Fn(f64) -> bool,
) -> f64 {
    let slope = |step: usize, inverse_h: f64| {
        let towards = |other: usize, next: usize| {
            let rise = phi[other] - phi[k];
            if !holds_both(phi[other]) {
                rise
            } else if rise >= 0.0 || borders_gas(phi, other, stride) {
                0.5 * rise
            } else if phi[next] < phi[other] {
                -phi[k]
            } else {
                rise
            }
        };
        (towards(k + step, k + 2 * step) - towards(k - step, k - 2 * step)) * inverse_h
    };
    slope(1, inverse_h[0]).hypot(slope(stride, inverse_h[1]))
}

/// Gas fraction from which on a cell counts as the gas's own.
const GAS: f64 = 0.9;

/// Whether liquid may evaporate in a cell: one beside it is nearly all gas, or none beside it has more.
///
/// Vapour makes its cell expand, and what lies beyond is pushed away. In a cell on the liquid's side of an interface it would
/// leave liquid behind in the cells on the gas's side, and the interface would become a foam that runs into superheated liquid. So the cell
/// next to the gas is emptied first; the heat comes there through the mixed cells ([`crate::Conduction`]).
///
/// - tested by: superheated liquid beside vapour, `tests/verification/superheated.rs`, which boils a fourth too fast without it, by either
///   law.
pub(super) fn borders_gas(phi: &[f64], k: usize, stride: usize) -> bool {
    let most = [k - 1, k + 1, k - stride, k + stride].into_iter().map(|k| phi[k]).fold(0.0, f64::max);
    most >= GAS || most <= phi[k]
}

#[cfg(test)]
mod tests {
    use super::super::holding::holds_both;
    use super::*;

    const N: usize = 64;

    /// The areas that are found on N² cells of the unit square with φ of a profile over the distance from a front: of all cells that hold
    /// both, and of those that evaporate.
    fn areas(distance: impl Fn(f64, f64) -> f64, width: f64) -> [f64; 2] {
        let h = 1.0 / N as f64;
        let stride = N + 4;
        let at = |k: usize| [(k % stride) as f64 - 1.5, (k / stride) as f64 - 1.5].map(|x| x * h);
        let profile = |d: f64| (0.5 - 0.5 * d / (width * h)).clamp(0.0, 1.0);
        let phi: Vec<f64> = (0..stride * stride)
            .map(|k| {
                let [x, y] = at(k);
                profile(distance(x, y))
            })
            .collect();
        let inner = |k: &usize| (2..N + 2).contains(&(k % stride)) && (2..N + 2).contains(&(k / stride));
        let mut sums = [0.0; 2];
        for k in (0..stride * stride).filter(inner).filter(|k| holds_both(phi[*k])) {
            sums[0] += area_density(&phi, k, stride, [N as f64; 2], holds_both) * h * h;
            if borders_gas(&phi, k, stride) {
                sums[1] += front_density(&phi, k, stride, [N as f64; 2], holds_both) * h * h;
            }
        }
        sums
    }

    #[test]
    fn fronts_have_their_area() {
        for width in [0.5, 1.0, 2.3] {
            // It is at a place where no cell is pure by chance.
            let straight = areas(|x, _| x - 0.5077, width);
            assert!((straight[0] - 1.0).abs() < 1e-12, "{width}: {straight:?}");
            let turn = 0.6 * std::f64::consts::PI;
            let circle = areas(|x, y| (x - 0.5).hypot(y - 0.5) - 0.3, width).map(|area| area / turn);
            let root = 2_f64.sqrt();
            let inclined = areas(|x, y| (x + y - 1.003) / root, width).map(|area| area / root);
            eprintln!(
                "{width} cells: straight {straight:.3?}, circle {circle:.3?}, at 45 degrees {inclined:.3?}"
            );
            let [wrong, wrong_at_45] = [circle, inclined].map(|area| area.map(|area| (area - 1.0).abs()));
            assert!(wrong[0] < 0.1 && wrong_at_45[0] < 0.15, "{width}: {circle:?} {inclined:?}");
            assert!((straight[1] - 1.0).abs() < 0.05, "{width}: {straight:?}");
            assert!(wrong[1] < 0.1 && wrong_at_45[1] < 0.15, "{width}: {circle:?} {inclined:?}");
        }
    }
}
