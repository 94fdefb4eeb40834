//! The liquid's pressure about gas bubbles as the flow that is about to start has it.
//!
//! A liquid that begins to move from rest, and whose compressibility does not matter yet, obeys ρ ∂t v = −∇p and
//! div v = 0: its pressure is harmonic. With the gas's pressure on the bubbles and the ambient one far away the
//! bubble's wall starts with Rayleigh's acceleration, and no wave leaves it.

mod beneath;
mod bubbles;
mod charges;
mod error;
mod fit;
mod least_squares;
mod multipoles;
mod outline;
mod space;

use mesh::{Domain, Geometry};

use crate::{Boundary, Gravity, InitialCondition, InitialPressure};
pub use beneath::{Beneath, HarmonicBeneath};
use bubbles::{Bubble, all_clear, bubbles};
pub use error::RayleighError;
use fit::Fit;
use multipoles::Multipoles;
use space::Space;

/// The largest error, relative to the largest difference of pressure, with which the field still serves.
const BEARABLE: f64 = 1e-2;

/// The field beyond the bubbles.
#[derive(Clone, Debug, PartialEq)]
enum Flow {
    /// Of bubbles clear of each other and of the only wall.
    Clear(Multipoles),
    /// Of any others.
    Fitted(Fit),
}

/// The harmonic pressure about spheres of gas on the axis.
///
/// ∇²p = 0 with p = p_gas on the bubbles, ∂p/∂n = 0 on walls. In free space and above one wall p = p∞ far away, whatever open sides
/// cut off: bubbles clear of each other and of the wall have series of multipoles (`Multipoles`). Bubbles that the wall cuts,
/// or that touch it or overlap each other, have charges that cluster towards the edges (`Fit`). So have bubbles beside more walls,
/// and open sides are there at p∞: a tube's field does not fade towards infinity, and that between plates grows there.
///
/// Tests: Laplace's equation by differences, the gas's pressure on the surfaces, no gradient at the walls, one sphere
/// alone, image charges of spheres apart, in contact and intersecting.
#[derive(Clone, Debug, PartialEq)]
pub struct RayleighField {
    far: f64,
    space: Space,
    bubbles: Vec<Bubble>,
    flow: Flow,
    error: f64,
}

impl RayleighField {
    /// The field that an initial condition begins with; `None` if its pressure is to be uniform.
    ///
    /// Under gravity it is that of the pressure beyond the hydrostatic one, and on a bubble what the gas has beyond that at the
    /// bubble's centre: a bubble that is in equilibrium there has none. The ρgR by which the liquid's weight differs along its
    /// surface begins to act with the first steps.
    ///
    /// - `gravity`: of the liquid; the caller adds the hydrostatic pressure.
    /// - `boundaries`: what bounds the domain, in the order of [`mesh::Side::ALL`].
    /// - errors: [`RayleighError`] where there is no such field.
    pub fn of(
        initial: &InitialCondition,
        gravity: Option<Gravity>,
        domain: &Domain,
        boundaries: [Boundary; 4],
    ) -> Result<Option<Self>, RayleighError> {
        match initial.pressure {
            InitialPressure::Uniform => Ok(None),
            InitialPressure::Rayleigh => {
                Self::between(&initial.weightless(gravity), domain, boundaries).map(Some)
            }
        }
    }

    /// What it takes at the most while its linear system is solved: four equations for two unknowns, one of the ridge for each, and the
    /// triangle of the QR; of multipoles, a square.
    pub const MOST_BYTES: usize = {
        let fit = 4 * fit::MOST_UNKNOWNS * fit::MOST_UNKNOWNS;
        let multipoles = multipoles::MOST_UNKNOWNS * multipoles::MOST_UNKNOWNS;
        size_of::<f64>() * if fit > multipoles { fit } else { multipoles }
    };

    /// The field about the gas regions of an initial condition between the sides of a domain, whatever it says of its pressure.
    ///
    /// - `boundaries`: in the order of [`mesh::Side::ALL`]. Walls and the interface to a solid are rigid.
    /// - errors: [`RayleighError`] where there is no such field.
    pub fn between(
        initial: &InitialCondition,
        domain: &Domain,
        boundaries: [Boundary; 4],
    ) -> Result<Self, RayleighError> {
        if domain.geometry == Geometry::Planar {
            return Err(RayleighError::Planar);
        }
        Self::within(initial, domain.geometry, Space::of(domain, boundaries)?)
    }

    /// The field about the gas regions of an initial condition in free space or above a wall.
    ///
    /// - `wall`: z of the rigid wall below the bubbles, m.
    /// - errors: [`RayleighError`] where there is no such field.
    pub fn new(
        initial: &InitialCondition,
        geometry: Geometry,
        wall: Option<f64>,
    ) -> Result<Self, RayleighError> {
        Self::within(initial, geometry, Space::above(wall))
    }

    fn within(initial: &InitialCondition, geometry: Geometry, space: Space) -> Result<Self, RayleighError> {
        let bubbles = bubbles(initial, geometry, &space)?;
        let clear = (space.hull.is_none() && all_clear(&bubbles, &space)).then(|| {
            let (field, error) = Multipoles::about(&bubbles, space.floor.map(|floor| floor.z));
            (Flow::Clear(field), error)
        });
        let (flow, error) = match clear.filter(|(_, error)| *error < BEARABLE) {
            Some(clear) => clear,
            None => {
                let (field, error) = Fit::about(&bubbles, &space)?;
                (Flow::Fitted(field), error)
            }
        };
        if !(error < BEARABLE) {
            return Err(RayleighError::TooNear { error });
        }
        Ok(Self { far: initial.ambient.pressure, space, bubbles, flow, error })
    }

    /// Pressure at a point (z, r), Pa; within a bubble that of its gas.
    pub fn pressure(&self, [z, r]: [f64; 2]) -> f64 {
        let point = [self.space.height(z), r];
        let inside = self.bubbles.iter().find(|bubble| bubble.holds(point));
        let excess = || match &self.flow {
            Flow::Clear(field) => field.excess(point),
            Flow::Fitted(field) => field.excess(point),
        };
        self.far + inside.map_or_else(excess, |bubble| bubble.excess)
    }

    /// The monopole of each bubble, Pa m, in the order of the gas regions: far away in free space p − p∞ is the sum of these over
    /// the distances, and above a wall of their images', too. Of a bubble that the wall cuts it is that of the part above.
    pub fn monopoles(&self) -> Vec<f64> {
        match &self.flow {
            Flow::Clear(field) => field.monopoles(),
            Flow::Fitted(field) => field.monopoles(),
        }
    }

    /// p − p∞ on the wall at z_min, continued beneath it; `None` where there is no such wall, or where the pressure beyond another side
    /// would count, of which nothing is known.
    pub fn beneath(&self) -> Option<Beneath> {
        let Space { turned: None, floor: Some(floor), hull: None } = self.space else { return None };
        let excess = |r: f64| self.pressure([floor.z, r]) - self.far;
        (floor.sign > 0.0).then(|| Beneath::of(&self.bubbles, floor.z, excess))
    }

    /// Whether open sides hold the ambient pressure, as they do beside more walls than one along z.
    pub fn has_reservoirs(&self) -> bool {
        self.space.hull.is_some()
    }

    /// The largest error on the bubbles' surfaces, and on sides beside one wall, relative to the largest difference of pressure
    /// (of gradients on walls: times the largest radius).
    pub fn error(&self) -> f64 {
        self.error
    }
}

#[cfg(test)]
mod tests;
