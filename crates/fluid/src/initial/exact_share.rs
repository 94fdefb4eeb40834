//! The exact share of a ball in a cell that its edge cuts.

use mesh::Geometry;

use super::shapes::may_cut;
use crate::state::Contents;
use crate::{InitialCondition, Phase, Shape, TRACE_GAS};

/// The contents of a cell that the edge of one ball of gas or liquid cuts, with the exact share of the ball; as they are elsewhere.
///
/// Samples are right to a hundredth of a cell, and curvature is made of second differences of that.
pub(crate) fn with_exact_share(
    mut contents: Contents,
    initial: &InitialCondition,
    geometry: Geometry,
    centre: [f64; 2],
    widths: [f64; 2],
) -> Contents {
    let mut cutting = initial.regions.iter().filter(|region| may_cut(&region.shape, centre, widths));
    let (Some(region), None) = (cutting.next(), cutting.next()) else { return contents };
    let Shape::Sphere { centre: middle, radius } = region.shape else { return contents };
    if geometry == Geometry::Axisymmetric && middle[1] != 0.0 {
        return contents;
    }
    let share = share_of_ball(radius, middle, geometry, centre, widths);
    let sampled = contents.state.phi;
    let is_gas = region.state.phase == Phase::Gas;
    let phi = if is_gas { share } else { 1.0 - share };
    let (gas_around, liquid_around) =
        if is_gas { (&region.state, &initial.ambient) } else { (&initial.ambient, &region.state) };
    // What the samples have of each phase; of one that they have missed, what was asked for.
    let Contents { state, gas: gas_mass } = contents;
    let gas = if sampled > 0.0 { gas_mass / sampled } else { gas_around.density };
    let liquid =
        if sampled < 1.0 { (state.density - gas_mass) / (1.0 - sampled) } else { liquid_around.density };
    contents.gas = phi * gas;
    contents.state.density = contents.gas + (1.0 - phi) * liquid;
    contents.state.phi = phi;
    if sampled <= TRACE_GAS && phi > TRACE_GAS {
        contents.state.pressure = gas_around.pressure;
    }
    contents
}

/// The share of a ball about a place on the axis, or of a disc in planar geometry, in the cell at `centre`.
pub(crate) fn share_of_ball(
    radius: f64,
    middle: [f64; 2],
    geometry: Geometry,
    centre: [f64; 2],
    widths: [f64; 2],
) -> f64 {
    let [z, r] = [centre[0] - middle[0], centre[1] - middle[1]];
    match geometry {
        Geometry::Axisymmetric => ball_share(radius, z, centre[1], widths),
        Geometry::Planar => disc_share(radius, z, r, widths),
    }
}

/// The share of a ball about z = 0 on the axis in the ring of cells at (z, r): ∫∫ r dr dz within, over that of the cell.
fn ball_share(radius: f64, z: f64, r: f64, [h_z, h_r]: [f64; 2]) -> f64 {
    let (inner, outer) = ((r - 0.5 * h_r).max(0.0), r + 0.5 * h_r);
    // The half width of the ball at a radius.
    let half = |r: f64| (radius * radius - r * r).max(0.0).sqrt();
    let (narrow, wide) = (half(outer), half(inner));
    let [low, high] = [z - 0.5 * h_z, z + 0.5 * h_z];
    // The integral of ½ min(outer², max(inner², R² − z²)) − ½ inner² from 0 to z.
    let up_to = |z: f64| {
        let (size, full) = (z.abs(), 0.5 * (outer * outer - inner * inner));
        let (flat, end) = (size.min(narrow), size.min(wide));
        let cubic = |z: f64| 0.5 * (radius * radius - inner * inner) * z - z * z * z / 6.0;
        (full * flat + if end > flat { cubic(end) - cubic(flat) } else { 0.0 }).copysign(z)
    };
    ((up_to(high) - up_to(low)) / (0.5 * (outer * outer - inner * inner) * h_z)).clamp(0.0, 1.0)
}

/// The share of a disc about the origin in a cell at (z, r).
fn disc_share(radius: f64, z: f64, r: f64, [h_z, h_r]: [f64; 2]) -> f64 {
    let [bottom, top] = [r - 0.5 * h_r, r + 0.5 * h_r];
    let [low, high] = [z - 0.5 * h_z, z + 0.5 * h_z];
    let half = |r: f64| (radius * radius - r * r).max(0.0).sqrt();
    // ∫ √(R² − z²) dz from 0.
    let segment = |z: f64| 0.5 * (z * half(z) + radius * radius * (z / radius).clamp(-1.0, 1.0).asin());
    // Between these places along z the height min(top, y) − max(bottom, −y), y = √(R² − z²), is of one kind.
    let mut ends: Vec<f64> = [low, high, half(top), -half(top), half(bottom), -half(bottom), radius, -radius]
        .into_iter()
        .filter(|end| (low..=high).contains(end))
        .collect();
    ends.sort_by(f64::total_cmp);
    let area: f64 = (ends.windows(2))
        .map(|piece| {
            let (a, b) = (piece[0], piece[1]);
            let y = half(0.5 * (a + b));
            let curved = segment(b) - segment(a);
            let upper = if y < top { curved } else { top * (b - a) };
            let lower = if -y > bottom { -curved } else { bottom * (b - a) };
            let height = y.min(top) - (-y).max(bottom);
            if height > 0.0 { upper - lower } else { 0.0 }
        })
        .sum();
    (area / (h_z * h_r)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::initial::shapes::share_within;

    #[test]
    fn shares_are_those_of_samples_and_add_up_to_the_whole() {
        let (radius, n) = (0.37, 16);
        let h = [1.0 / n as f64, 1.25 / n as f64];
        for (geometry, middle) in [
            (Geometry::Axisymmetric, [0.48, 0.0]),
            (Geometry::Planar, [0.48, 0.0]),
            (Geometry::Planar, [0.51, 0.63]),
        ] {
            let ball = Shape::Sphere { centre: middle, radius };
            let mut whole = 0.0;
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let [z, r] = [(i as f64 + 0.5) * h[0], (j as f64 + 0.5) * h[1]];
                let (offset, across) = (z - middle[0], r - middle[1]);
                let share = if geometry == Geometry::Planar {
                    disc_share(radius, offset, across, h)
                } else {
                    ball_share(radius, offset, r, h)
                };
                let sampled = share_within(&ball, geometry, [z, r], h);
                assert!((share - sampled).abs() < 0.02, "{geometry:?} {i} {j}: {share} {sampled}");
                whole += share * h[0] * h[1] * if geometry == Geometry::Planar { 1.0 } else { r };
            }
            let exact = match geometry {
                Geometry::Axisymmetric => 2.0 / 3.0 * radius.powi(3),
                Geometry::Planar => {
                    std::f64::consts::PI * radius * radius * if middle[1] == 0.0 { 0.5 } else { 1.0 }
                }
            };
            approx::assert_relative_eq!(whole, exact, max_relative = 1e-12);
        }
    }
}
