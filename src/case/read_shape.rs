//! Shapes in the (z, r) plane: of regions, pulses and the tracer.

use fluid::Shape;
use mesh::Geometry;

use super::GridCase;
use super::reader::{Faults, Given, Table};

/// The shapes of regions and pulses by name.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Sphere,
    Box,
    Plane,
}

/// Which of some shapes a table names.
pub(super) fn shape(
    table: &mut Table<'_>,
    names: &[(&'static str, Kind)],
    faults: &mut Faults,
) -> Option<Kind> {
    if !table.has("shape") {
        let all: Vec<String> = names.iter().map(|(name, _)| format!("\"{name}\"")).collect();
        table.missing("shape", format!("give `shape = ` one of {}", all.join(", ")), faults);
    }
    table.choice("shape", names, faults).map(|given| given.value)
}

/// A sphere has its centre on the axis of axisymmetric geometry.
pub(super) fn on_axis(centre: &Given<[f64; 2]>, geometry: Geometry, faults: &mut Faults) {
    if geometry == Geometry::Axisymmetric && centre.value[1] != 0.0 {
        let message =
            format!("a sphere in axisymmetric geometry must be on the axis, got r = {:?} m", centre.value[1]);
        faults.of(centre, message, format!("write [{:?}, 0.0]", centre.value[0]));
    }
}

/// A sphere or a box that has something of the fluid in it.
pub(super) fn body(
    table: &mut Table<'_>,
    grid: Option<&GridCase>,
    geometry: Geometry,
    faults: &mut Faults,
) -> Option<Shape> {
    let kind = shape(table, &[("sphere", Kind::Sphere), ("box", Kind::Box)], faults)?;
    if kind == Kind::Sphere {
        let centre = table.required_pair("centre", faults);
        let radius = table.required_positive("radius", faults);
        if let Some(centre) = &centre {
            on_axis(centre, geometry, faults);
            if let Some(grid) = grid.filter(|grid| !grid.contains(centre.value)) {
                let [z, r] = centre.value;
                let message = format!("the centre ({z:?}, {r:?}) m is outside the fluid");
                faults.of(centre, message, extent(grid));
            }
        }
        centre.zip(radius).map(|(centre, radius)| Shape::Sphere { centre: centre.value, radius })
    } else {
        let (z, r) = (table.range("z", faults), table.range("r", faults));
        if let (Some(z), Some(r), Some(grid)) = (&z, &r, grid) {
            for (range, domain) in [(z, grid.z), (r, grid.r)] {
                let [low, high] = range.value;
                if high <= domain[0] || low >= domain[1] {
                    let message = format!("the box [{low:?}, {high:?}] m lies outside the fluid");
                    faults.of(range, message, extent(grid));
                }
            }
        }
        z.zip(r).map(|(z, r)| Shape::Box { z: z.value, r: r.value })
    }
}

pub(super) fn extent(grid: &GridCase) -> String {
    let ([z0, z1], [r0, r1]) = (grid.z, grid.r);
    format!("the fluid is z = {z0:?} to {z1:?} m, r = {r0:?} to {r1:?} m")
}
