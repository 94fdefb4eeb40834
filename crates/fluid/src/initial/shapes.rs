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

    /// From where to where it reaches along z and r, m.
    pub(crate) fn extent(&self) -> [[f64; 2]; 2] {
        match *self {
            Self::Sphere { centre, radius } => centre.map(|middle| [middle - radius, middle + radius]),
            Self::Box { z, r } => [z, r],
        }
    }

    /// Whether all of another shape is within it.
    pub(crate) fn holds(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Sphere { centre, radius }, Self::Sphere { centre: [z, r], radius: within }) => {
                (z - centre[0]).hypot(r - centre[1]) + within <= *radius
            }
            (Self::Sphere { centre, radius }, Self::Box { z, r }) => {
                let is_within = |z: f64, r: f64| (z - centre[0]).hypot(r - centre[1]) <= *radius;
                z.iter().all(|z| r.iter().all(|r| is_within(*z, *r)))
            }
            (Self::Box { .. }, _) => {
                let [[z, r], [other_z, other_r]] = [self, other].map(Self::extent);
                // A rectangle from the axis on has all of what is about the axis.
                let from = if r[0] == 0.0 { other_r[0].max(0.0) } else { other_r[0] };
                z[0] <= other_z[0] && other_z[1] <= z[1] && r[0] <= from && other_r[1] <= r[1]
            }
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
