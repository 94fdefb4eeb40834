//! `[[fluid.pulse]]`: pressure pulses in the liquid.

use fluid::{NobleAbelStiffenedGas, PhaseState, Pulse, PulseShape};
use mesh::Geometry;

use super::read_shape::{Kind, on_axis, shape};
use super::reader::{Faults, Given, Table, number, pair};

/// A pulse.
///
/// - `ambient`, `liquid`: as far as they could be read.
pub(super) fn pulse(
    mut table: Table<'_>,
    geometry: Geometry,
    liquid: Option<NobleAbelStiffenedGas>,
    ambient: Option<PhaseState>,
    faults: &mut Faults,
) -> Option<Pulse> {
    let kind = shape(&mut table, &[("sphere", Kind::Sphere), ("plane", Kind::Plane)], faults)?;
    let centre = centre(&mut table, kind, faults);
    let width = table.required_positive("width", faults);
    let amplitude = table.required("amplitude", faults);
    let shape = if kind == Kind::Sphere {
        if let Some(centre) = &centre {
            on_axis(centre, geometry, faults);
        }
        Some(PulseShape::Sphere)
    } else {
        let given = table.pair("direction", faults);
        let faulty = given.is_none() && table.has("direction");
        let direction = given.map(|given| unit(&given, geometry, faults));
        (!faulty).then_some(PulseShape::Plane { direction })
    };
    table.finish(faults);
    let (amplitude, centre) = (amplitude?, centre?);
    if let (Some(ambient), Some(liquid)) = (ambient, liquid) {
        let lowest = ambient.pressure + amplitude.value;
        if lowest + liquid.pi <= 0.0 {
            let message =
                format!("the pressure at the pulse's centre would be {lowest:?} Pa, where p + pi > 0 fails");
            faults.of(&amplitude, message, "give a smaller amplitude");
        }
    }
    Some(Pulse { shape: shape?, centre: centre.value, width: width?, amplitude: amplitude.value })
}

/// `[z, r]`, or for a plane only z.
fn centre(table: &mut Table<'_>, kind: Kind, faults: &mut Faults) -> Option<Given<[f64; 2]>> {
    let Some(given) = table.raw("centre") else {
        table.missing("centre", "give `centre = [z, r]` in m", faults);
        return None;
    };
    let unit = table.unit("centre");
    let value = if kind == Kind::Plane && !given.value.is_array() {
        number(&given, &unit, faults).map(|z| [z, 0.0])
    } else {
        pair(&given, &format!("{unit}, as [z, r]"), faults)
    };
    Some(Given { value: value?, path: given.path, span: given.span })
}

/// The direction at length one; a direction that has it already stays as it is, to the last bit.
fn unit(given: &Given<[f64; 2]>, geometry: Geometry, faults: &mut Faults) -> [f64; 2] {
    let [z, r] = given.value;
    let length = z.hypot(r);
    if length == 0.0 {
        faults.of(given, "has no length", "give [1.0, 0.0] for up, [-1.0, 0.0] for down");
    }
    if geometry == Geometry::Axisymmetric && r != 0.0 {
        let message = format!("a plane wave in axisymmetric geometry goes along z, got [{z:?}, {r:?}]");
        faults.of(given, message, "give [1.0, 0.0] or [-1.0, 0.0], or take geometry = \"planar\"");
    }
    if (length - 1.0).abs() < 1e-14 { [z, r] } else { [z / length, r / length] }
}
