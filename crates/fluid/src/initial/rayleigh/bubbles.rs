//! The gas of an initial condition as spheres on the axis.

use mesh::Geometry;

use super::error::RayleighError;
use super::space::Space;
use crate::{InitialCondition, Phase, Shape};

/// A sphere of gas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bubble {
    /// Number of its region, from 0.
    pub region: usize,
    /// z in the frame of the [`Space`], m.
    pub centre: f64,
    pub radius: f64,
    /// Pressure of the gas minus that far away, Pa.
    pub excess: f64,
}

/// How two spheres lie to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Meeting {
    /// Apart, or touching in a point.
    Apart,
    /// One is within the other.
    Within,
    /// They meet in a circle: its z and r.
    Circle([f64; 2]),
}

impl Bubble {
    /// How it lies to the sphere of a radius about the centre (z, 0).
    pub(super) fn meets(&self, z: f64, radius: f64) -> Meeting {
        let offset = z - self.centre;
        let distance = offset.abs();
        if distance >= self.radius + radius {
            return Meeting::Apart;
        }
        if distance <= (self.radius - radius).abs() {
            return Meeting::Within;
        }
        let [own, other] = [self.radius, radius].map(|r| r * r);
        let along = (distance * distance + own - other) / (2.0 * distance);
        let across = (own - along * along).max(0.0).sqrt();
        Meeting::Circle([self.centre + along * offset.signum(), across])
    }

    /// Whether a point is within.
    pub(super) fn holds(&self, [z, r]: [f64; 2]) -> bool {
        (z - self.centre).hypot(r) < self.radius
    }
}

/// The largest difference of pressure to that far away, Pa.
pub(super) fn largest_excess(bubbles: &[Bubble]) -> f64 {
    bubbles.iter().fold(0.0, |largest: f64, bubble| largest.max(bubble.excess.abs()))
}

/// The gas regions as spheres; checks what the field needs of them.
pub(super) fn bubbles(
    initial: &InitialCondition,
    geometry: Geometry,
    space: &Space,
) -> Result<Vec<Bubble>, RayleighError> {
    if geometry == Geometry::Planar {
        return Err(RayleighError::Planar);
    }
    if initial.ambient.phase == Phase::Gas {
        return Err(RayleighError::GasAmbient);
    }
    let mut bubbles: Vec<Bubble> = Vec::new();
    let gas = initial.regions.iter().enumerate().filter(|(_, region)| region.state.phase == Phase::Gas);
    for (region, painted) in gas {
        let Shape::Sphere { centre: [z, 0.0], radius } = painted.shape else {
            return Err(RayleighError::NotASphere { region });
        };
        let excess = painted.state.pressure - initial.ambient.pressure;
        let bubble = Bubble { region, centre: space.height(z), radius, excess };
        is_in_space(&bubble, space)?;
        let at_odds = |other: &&Bubble| {
            (bubble.centre - other.centre).abs() <= radius + other.radius && other.excess != excess
        };
        if let Some(other) = bubbles.iter().find(at_odds) {
            return Err(RayleighError::Overlap { first: other.region, second: region });
        }
        bubbles.push(bubble);
    }
    if bubbles.is_empty() {
        return Err(RayleighError::NoGas);
    }
    Ok(bubbles)
}

/// Whether a bubble meets none of the sides that it may not.
fn is_in_space(bubble: &Bubble, space: &Space) -> Result<(), RayleighError> {
    let &Bubble { region, centre, radius, .. } = bubble;
    let [lower, upper] = space.names();
    let meets = |side| Err(RayleighError::MeetsSide { region, side });
    if let Some(floor) = space.floor {
        let height = centre - floor.z;
        if floor.sign > 0.0 && height < 0.0 {
            return Err(RayleighError::BeyondWall { region, depth: -height });
        }
        if floor.sign < 0.0 && height <= radius {
            return meets(lower);
        }
    }
    match space.hull {
        Some(hull) if centre + radius >= hull.top => meets(upper),
        Some(hull) if radius >= hull.radius => meets("r_max"),
        _ => Ok(()),
    }
}

/// Whether all bubbles are clear of each other and of the plane that has images.
pub(super) fn all_clear(bubbles: &[Bubble], space: &Space) -> bool {
    bubbles.iter().enumerate().all(|(k, bubble)| {
        space.floor.is_none_or(|floor| bubble.centre - floor.z > bubble.radius)
            && bubbles[..k]
                .iter()
                .all(|other| (bubble.centre - other.centre).abs() > bubble.radius + other.radius)
    })
}
