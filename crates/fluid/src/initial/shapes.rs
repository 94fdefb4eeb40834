//! Shapes in cells: what a cell has of one, and where it is sampled for that.

use mesh::Geometry;

use crate::Shape;

/// Points per direction at which a cell that a shape's edge may cut is sampled.
const SAMPLES: usize = 32;

/// The share of a cell's volume that a shape holds, by sampling where its edge may cut the cell.
pub(crate) fn share_within(shape: &Shape, geometry: Geometry, centre: [f64; 2], widths: [f64; 2]) -> f64 {
    if !may_cut(shape, centre, widths) {
        return if shape.contains(centre) { 1.0 } else { 0.0 };
    }
    let (mut within, mut all) = (0.0, 0.0);
    for (weight, point) in samples(geometry, centre, widths) {
        all += weight;
        within += if shape.contains(point) { weight } else { 0.0 };
    }
    within / all
}

/// The points of a cell at which it is sampled, with their weights.
pub(crate) fn samples(
    geometry: Geometry,
    centre: [f64; 2],
    widths: [f64; 2],
) -> impl Iterator<Item = (f64, [f64; 2])> {
    (0..SAMPLES * SAMPLES).map(move |sample| {
        let offset = |k: usize, h: f64| h * ((k as f64 + 0.5) / SAMPLES as f64 - 0.5);
        let (a, b) = (sample % SAMPLES, sample / SAMPLES);
        let point = [centre[0] + offset(a, widths[0]), centre[1] + offset(b, widths[1])];
        (if geometry == Geometry::Axisymmetric { point[1] } else { 1.0 }, point)
    })
}

impl Shape {
    /// Whether a point (z, r), m, is within it.
    pub fn contains(&self, [z, r]: [f64; 2]) -> bool {
        match self {
            Self::Sphere { centre, radius } => (z - centre[0]).hypot(r - centre[1]) < *radius,
            Self::Box { z: [z0, z1], r: [r0, r1] } => z >= *z0 && z < *z1 && r >= *r0 && r < *r1,
        }
    }
}

/// Whether a shape's edge may pass through the cell.
pub(crate) fn may_cut(shape: &Shape, [z, r]: [f64; 2], [hz, hr]: [f64; 2]) -> bool {
    match *shape {
        Shape::Sphere { centre, radius } => {
            ((z - centre[0]).hypot(r - centre[1]) - radius).abs() <= 0.5 * hz.hypot(hr)
        }
        Shape::Box { z: z_range, r: r_range } => {
            let near = |edge: f64, x: f64, h: f64| (edge - x).abs() < 0.5 * h * (1.0 - 1e-9);
            let spans = |range: [f64; 2], x: f64, h: f64| x + h > range[0] && x - h < range[1];
            (z_range.iter().any(|e| near(*e, z, hz)) && spans(r_range, r, hr))
                || (r_range.iter().any(|e| near(*e, r, hr)) && spans(z_range, z, hz))
        }
    }
}
