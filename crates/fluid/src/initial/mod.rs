//! What fills the fluid's domain at t = 0.

pub(crate) mod exact_share;
pub(crate) mod fill;
pub(crate) mod mesh;
pub(crate) mod rayleigh;
pub(crate) mod shapes;

use std::borrow::Cow;

use crate::Gravity;

::mesh::named! {
    /// Which of the two fluids.
    pub enum Phase {
        /// The liquid, φ = 0.
        Liquid = "liquid",
        /// The gas, φ = 1.
        Gas = "gas",
    }
}

/// A uniform state of one phase.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhaseState {
    /// Which fluid.
    pub phase: Phase,
    /// Density, kg/m³.
    pub density: f64,
    /// Pressure, Pa.
    pub pressure: f64,
    /// Velocity (z, r), m/s.
    pub velocity: [f64; 2],
}

/// A shape in the (z, r) plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A ball (in planar geometry a disc) about `centre` = (z, r), m.
    Sphere {
        /// Centre (z, r), m.
        centre: [f64; 2],
        /// Radius, m.
        radius: f64,
    },
    /// The rectangle z × r, m.
    Box {
        /// Range in z, m.
        z: [f64; 2],
        /// Range in r, m.
        r: [f64; 2],
    },
}

/// A shape filled with a uniform state; regions are painted in order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Where.
    pub shape: Shape,
    /// With what.
    pub state: PhaseState,
}

/// A Gaussian pressure pulse p' = A exp(−d²/a²) laid over the liquid, density isentropic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse {
    /// Sphere (distance to `centre`) or plane (distance to the plane through `centre`).
    pub shape: PulseShape,
    /// Centre (z, r), m; a plane uses what its normal needs.
    pub centre: [f64; 2],
    /// Width a, m.
    pub width: f64,
    /// Amplitude A, Pa.
    pub amplitude: f64,
}

/// The shape of a [`Pulse`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PulseShape {
    /// Distance to the centre, fluid at rest.
    Sphere,
    /// Distance along z to the centre. With a `direction` (unit vector (z, r)) distance is measured along it
    /// and the pulse travels that way: v = p'/(ρc) along it.
    Plane {
        /// Direction of travel; `None`: at rest, splitting into two.
        direction: Option<[f64; 2]>,
    },
}

::mesh::named! {
    /// The pressure in the ambient liquid at t = 0.
    pub enum InitialPressure {
        /// That of the ambient state, up to the bubbles' walls.
        Uniform = "uniform",
        /// The harmonic field that ends at the gas's pressure on the bubbles, see [`crate::RayleighField`].
        Rayleigh = "rayleigh",
    }
}

/// Everything that fills the domain at t = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct InitialCondition {
    /// What is there before any region is painted.
    pub ambient: PhaseState,
    /// The pressure that the ambient liquid has about the regions.
    pub pressure: InitialPressure,
    /// Painted in order.
    pub regions: Vec<Region>,
    /// Added last.
    pub pulses: Vec<Pulse>,
}

impl InitialCondition {
    /// What it would be if the liquid had no weight: gas at the pressure that it has beyond the liquid's at its centre, from that
    /// of the ambient state on.
    pub fn weightless(&self, gravity: Option<Gravity>) -> Cow<'_, Self> {
        let Some(gravity) = gravity else { return Cow::Borrowed(self) };
        let mut weightless = self.clone();
        for region in weightless.regions.iter_mut().filter(|region| region.state.phase == Phase::Gas) {
            let z = match region.shape {
                Shape::Sphere { centre, .. } => centre[0],
                Shape::Box { z: [low, high], .. } => 0.5 * (low + high),
            };
            region.state.pressure -= gravity.head(self.ambient.density, z);
        }
        Cow::Owned(weightless)
    }
}

#[cfg(test)]
impl InitialCondition {
    /// Balls of gas on the axis, each with the z of its centre and its radius, in a liquid.
    pub(crate) fn of_balls(
        ambient: PhaseState,
        pressure: InitialPressure,
        balls: impl IntoIterator<Item = ([f64; 2], PhaseState)>,
    ) -> Self {
        let region = |([z, radius], state): ([f64; 2], PhaseState)| Region {
            shape: Shape::Sphere { centre: [z, 0.0], radius },
            state,
        };
        Self { ambient, pressure, regions: balls.into_iter().map(region).collect(), pulses: vec![] }
    }
}
