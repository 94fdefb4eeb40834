//! How much interface there is in a cell.

use super::holding::HELD;

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

/// How much of the interface in a cell faces z and r: |n_z|, |n_r| of its normal n.
///
/// - arguments: as of [`area_density`].
pub(crate) fn facing(phi: &[f64], k: usize, stride: usize, inverse_h: [f64; 2]) -> [f64; 2] {
    // Three cells beside each other, as Parker & Youngs (1992) have it: a front's normal is that of its neighbours, too.
    let across = |step: usize, along: usize| {
        let rise = |k: usize| phi[k + step] - phi[k - step];
        2.0 * rise(k) + rise(k - along) + rise(k + along)
    };
    let slope = [across(1, stride) * inverse_h[0], across(stride, 1) * inverse_h[1]];
    let length = slope[0].hypot(slope[1]);
    slope.map(|along| if length > 0.0 { (along / length).abs() } else { 0.0 })
}

/// The area on which the liquid of a cell takes up vapour, 1/m: what φ steps by to cells of more gas. What it steps by from a cell of liquid
/// counts there (`terms/gas_slip.rs`), so that little liquid in a cell does not take up the heat for all that is behind.
///
/// - arguments: as of [`area_density`].
pub(super) fn condensing_area(phi: &[f64], k: usize, stride: usize, inverse_h: [f64; 2]) -> f64 {
    let rise = |other: usize| (phi[other] - phi[k]).max(0.0);
    let [z, r] = facing(phi, k, stride, inverse_h);
    (rise(k + 1) + rise(k - 1)) * z * inverse_h[0] + (rise(k + stride) + rise(k - stride)) * r * inverse_h[1]
}

/// Gas fraction from which on a cell counts as the gas's own.
const GAS: f64 = 0.9;

/// Whether liquid that boils at once may do so in a cell: one beside it is nearly all gas, or none beside it has more.
///
/// Vapour makes its cell expand, and what lies beyond is pushed away. In a cell on the liquid's side of an interface it would
/// leave liquid behind in the cells on the gas's side, and the interface would become a foam that runs into superheated liquid. So the cell
/// next to the gas is emptied first; the heat comes there through the mixed cells ([`crate::Conduction`]).
///
/// - tested by: superheated liquid beside vapour, `tests/verification/superheated.rs`, which boils 25 % too fast without it.
pub(super) fn borders_gas(phi: &[f64], k: usize, stride: usize) -> bool {
    let most = most_beside(phi, k, stride);
    most >= GAS || most <= phi[k]
}

/// Whether a cell next to this one holds gas that may change phase.
pub(super) fn lies_beside_gas(phi: &[f64], k: usize, stride: usize) -> bool {
    most_beside(phi, k, stride) > HELD
}

/// The largest gas fraction of the cells beside one.
fn most_beside(phi: &[f64], k: usize, stride: usize) -> f64 {
    [k - 1, k + 1, k - stride, k + stride].into_iter().map(|k| phi[k]).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::super::holding::holds_both;
    use super::*;

    const N: usize = 64;

    /// The area that is found on N² cells of the unit square with φ of a profile over the distance from a front.
    fn area(distance: impl Fn(f64, f64) -> f64, width: f64) -> f64 {
        let h = 1.0 / N as f64;
        let stride = N + 2;
        let at = |k: usize| [(k % stride) as f64 - 0.5, (k / stride) as f64 - 0.5].map(|x| x * h);
        let profile = |d: f64| (0.5 - 0.5 * d / (width * h)).clamp(0.0, 1.0);
        let phi: Vec<f64> = (0..stride * stride)
            .map(|k| {
                let [x, y] = at(k);
                profile(distance(x, y))
            })
            .collect();
        let inner = |k: &usize| (1..=N).contains(&(k % stride)) && (1..=N).contains(&(k / stride));
        let both = (0..stride * stride).filter(inner).filter(|k| holds_both(phi[*k]));
        both.map(|k| area_density(&phi, k, stride, [N as f64; 2], holds_both) * h * h).sum()
    }

    #[test]
    fn fronts_have_their_area() {
        for width in [0.5, 1.0, 2.3] {
            // Of a front along the grid, the round-off; it is at a place where no cell is pure by chance.
            let straight = area(|x, _| x - 0.5077, width);
            assert!((straight - 1.0).abs() < 1e-12, "{width}: {straight}");
            let circle = area(|x, y| (x - 0.5).hypot(y - 0.5) - 0.3, width) / (0.6 * std::f64::consts::PI);
            let inclined = area(|x, y| (x + y - 1.003) / 2_f64.sqrt(), width) / 2_f64.sqrt();
            eprintln!("{width} cells: circle {circle:.3}, front at 45 degrees {inclined:.3}");
            assert!(
                (circle - 1.0).abs() < 0.1 && (inclined - 1.0).abs() < 0.15,
                "{width}: {circle} {inclined}"
            );
        }
    }
}
