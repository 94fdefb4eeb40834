//! What bounds the liquid that begins to move: planes that have images, sides that have none, or nothing.

use mesh::{Domain, Side};

use super::error::RayleighError;
use crate::Boundary;

/// The plane z = const that everything has its image in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Floor {
    pub z: f64,
    /// 1 of a wall, −1 of a plane at the pressure of the liquid far away.
    pub sign: f64,
}

/// What a side without images is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum End {
    /// No gradient along its normal.
    Wall,
    /// The pressure far away.
    Reservoir,
}

/// The sides of a cylinder that have no images.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hull {
    /// z of its top, m, and its radius, m.
    pub top: f64,
    pub radius: f64,
    pub top_is: End,
    pub outer_is: End,
}

/// Where the liquid is, in a frame in which the plane with images is below it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Space {
    /// z of the frame is this minus z; z itself if not given.
    pub turned: Option<f64>,
    /// None in free space.
    pub floor: Option<Floor>,
    /// None where the liquid goes on to infinity.
    pub hull: Option<Hull>,
}

impl Space {
    /// All of space above a wall, or all of it.
    pub(super) fn above(wall: Option<f64>) -> Self {
        Self { floor: wall.map(|z| Floor { z, sign: 1.0 }), ..Self::default() }
    }

    /// What the sides of a domain make of it, in the order of [`Side::ALL`].
    ///
    /// Beside one wall z = const at most the liquid goes on beyond open sides to infinity. Beside more walls it would have no
    /// pressure there, or none that a finite flow can be driven with: open sides then hold the ambient pressure.
    pub(super) fn of(domain: &Domain, boundaries: [Boundary; 4]) -> Result<Self, RayleighError> {
        let kind = |side: Side| boundaries[side as usize];
        if [Side::ZMin, Side::ZMax, Side::RMax].into_iter().any(|side| kind(side) == Boundary::Periodic) {
            return Err(RayleighError::Periodic);
        }
        let [low, high, outer] = [Side::ZMin, Side::ZMax, Side::RMax].map(|side| !kind(side).is_open());
        let turned = (high && !low).then_some(domain.z[0] + domain.z[1]);
        let even = Floor { z: domain.z[0], sign: 1.0 };
        if low && high && outer {
            return Err(RayleighError::ClosedBox);
        }
        if !(outer || low && high) {
            return Ok(Self { turned, floor: (low || high).then_some(even), hull: None });
        }
        let end = |is_wall| if is_wall { End::Wall } else { End::Reservoir };
        let floor = if low || high { even } else { Floor { sign: -1.0, ..even } };
        let hull =
            Hull { top: domain.z[1], radius: domain.r[1], top_is: end(low && high), outer_is: end(outer) };
        Ok(Self { turned, floor: Some(floor), hull: Some(hull) })
    }

    /// Height in the frame, m, or from it.
    pub(super) fn height(&self, z: f64) -> f64 {
        self.turned.map_or(z, |sum| sum - z)
    }

    /// The names of the frame's lower and upper side.
    pub(super) fn names(&self) -> [&'static str; 2] {
        if self.turned.is_some() { ["z_max", "z_min"] } else { ["z_min", "z_max"] }
    }
}
